//! The solutions of six-axis arms that have a configuration.

use alloc::vec::Vec;

use super::request::ConfigurationRequest;
use crate::error::{Error, ModelFault, NoConfiguration};
use crate::kinematics::answer::check::check_seed;
use crate::kinematics::answer::solutions::{Solution, Solutions};
use crate::kinematics::pose::{Pose, checked_pose};
use crate::kinematics::robot::Robot;
use crate::report::{Configuration, ConfigurationRule};

impl Robot<6> {
    /// [`Robot::ik_configured`] or, if no solution has that configuration, the solution nearest to
    /// `seed` [rad].
    ///
    /// Many programs contain `[0, 0, 0, 0]` without having computed it.
    ///
    /// # Errors
    ///
    /// As [`Robot::ik_configured`] and [`Robot::ik_nearest`]; never [`Error::NoConfiguration`].
    pub fn ik_configured_or_nearest(
        &self,
        pose: &Pose,
        wanted: Configuration,
        seed: &[f64; 6],
    ) -> Result<Solution<6>, Error> {
        check_seed("seed", seed)?;
        let request = ConfigurationRequest::from(wanted).or_nearest(*seed);
        self.configured_checked(checked_pose(pose)?, &request)
    }

    /// The solution nearest to a seed that has the configuration of a request.
    pub(in crate::kinematics::solve) fn configured_near(
        &self,
        pose: &Pose,
        request: &ConfigurationRequest<6>,
        seed: &[f64; 6],
    ) -> Result<Solution<6>, Error> {
        let (rule, wanted) = (self.rule_for(request)?, request.configuration);
        if let (ConfigurationRule::SphericalWrist, Some(arm)) = (rule, self.spherical_wrist()) {
            return self.configured_wrist(arm, *pose, wanted);
        }
        let solutions = self.ik_checked(*pose, ())?;
        let having = self.having(&rule, &solutions.iter().copied(), wanted);
        match having.and_then(|having| having.nearest(seed)) {
            Some(nearest) => Ok(nearest),
            None => Err(self.no_configuration(&rule, &solutions, wanted)?),
        }
    }

    /// Every solution that has the configuration of a request, the nearest to a seed first.
    pub(in crate::kinematics::solve) fn configured_list(
        &self,
        pose: &Pose,
        request: &ConfigurationRequest<6>,
        seed: &[f64; 6],
    ) -> Result<Vec<Solution<6>>, Error> {
        let (rule, wanted) = (self.rule_for(request)?, request.configuration);
        if rule == ConfigurationRule::SphericalWrist {
            return Ok(Vec::from([self.configured_near(pose, request, seed)?]));
        }
        let solutions = self.ik_checked(*pose, ())?;
        match self.having(&rule, &solutions.iter().copied(), wanted) {
            Some(having) => Ok(having.all(seed)),
            None => Err(self.no_configuration(&rule, &solutions, wanted)?),
        }
    }

    /// The rule of the arm, for a request that fits it.
    fn rule_for(&self, request: &ConfigurationRequest<6>) -> Result<ConfigurationRule, Error> {
        let rule = self.configuration_rule()?;
        request.configuration.check(self.is_coupled())?;
        match request.arm_angle {
            Some(_) => Err(ModelFault::NoArmAngle.into()),
            None => Ok(rule),
        }
    }

    /// The reason why no solution has a configuration: the configurations that exist, or that no
    /// solution is inside the limits.
    pub(super) fn no_configuration(
        &self,
        rule: &ConfigurationRule,
        solutions: &Solutions<6>,
        wanted: Configuration,
    ) -> Result<Error, Error> {
        let mut none = NoConfiguration {
            wanted,
            existing: Vec::new(),
            more: false,
            free: solutions.iter().find_map(|found| found.free_joint),
        };
        for solution in solutions {
            self.list_turns(rule, solution, &mut none);
        }
        if none.existing.is_empty() {
            // Another member of a self-motion than its representative may be inside.
            let Some(inside) = self.nearest_of(solutions, &self.limits().rest(), &[1.0; 6])? else {
                return Ok(Error::Unreachable(solutions.explain()));
            };
            self.list_turns(rule, &inside, &mut none);
        }
        Ok(Error::NoConfiguration(none))
    }
}
