//! The solutions of six-axis arms that have a configuration.

use alloc::vec::Vec;

use super::having::{BEYOND, EDGE_ROUNDING};
use super::rule::Quarters;
use crate::error::{Error, ModelFault};
use crate::kinematics::answer::request::ConfigurationRequest;
use crate::kinematics::answer::solutions::{Solution, Solutions};
use crate::kinematics::pose::Pose;
use crate::kinematics::pose::angles::wrap;
use crate::kinematics::robot::Robot;
use crate::kinematics::robot::joints::Configured;
use crate::kinematics::solve::configuration::fault::NoConfiguration;
use crate::kinematics::solve::nearest::Wanted;
use crate::kinematics::thresholds::CONFIGURATION_EDGE;
use crate::report::{Configuration, ConfigurationRule};

impl Configured<6> for Robot<6> {
    fn configured_near(
        &self,
        pose: &Pose,
        request: &ConfigurationRequest<6>,
        seed: &[f64; 6],
    ) -> Result<Solution<6>, Error> {
        let (rule, wanted) = (self.rule_for(request)?, request.configuration);
        if rule == ConfigurationRule::SphericalWrist && self.singular_wrist().is_some() {
            return self.configured_wrist(*pose, wanted);
        }
        let solutions = self.ik_checked(*pose, f64::NAN)?;
        let near = self.having_near(&rule, &solutions, wanted, seed)?;
        let members = with_near(&solutions, near);
        for beyond in BEYOND {
            let having = self.having(&rule, &members, wanted, beyond);
            if let Some(nearest) = having.and_then(|having| having.nearest(seed)) {
                return Ok(nearest);
            }
        }
        Err(self.no_configuration(&rule, &solutions, wanted)?)
    }

    fn configured_list(
        &self,
        pose: &Pose,
        request: &ConfigurationRequest<6>,
        seed: &[f64; 6],
    ) -> Result<Vec<Solution<6>>, Error> {
        let (rule, wanted) = (self.rule_for(request)?, request.configuration);
        if rule == ConfigurationRule::SphericalWrist {
            return Ok(Vec::from([self.configured_near(pose, request, seed)?]));
        }
        let solutions = self.ik_checked(*pose, f64::NAN)?;
        let near = self.having_near(&rule, &solutions, wanted, seed)?;
        let members = with_near(&solutions, near);
        for beyond in BEYOND {
            if let Some(having) = self.having(&rule, &members, wanted, beyond) {
                return Ok(having.all(seed));
            }
        }
        Err(self.no_configuration(&rule, &solutions, wanted)?)
    }
}

impl Robot<6> {
    /// Of a singular pose, the joint vector inside the limits that has a configuration and is
    /// nearest to a seed: perhaps another member of a self-motion than its representative, or one
    /// that rounding has moved over a limit.
    fn having_near(
        &self,
        rule: &ConfigurationRule,
        solutions: &Solutions<6>,
        wanted: Configuration,
        seed: &[f64; 6],
    ) -> Result<Option<Solution<6>>, Error> {
        if self.are_regular(solutions) && solutions.is_certified() {
            return Ok(None);
        }
        for edge in [0.0, CONFIGURATION_EDGE] {
            let ranges = Quarters::of(rule).ranges(wanted, edge);
            let Some(limits) = self.limits().narrowed(&ranges) else { continue };
            let edge = edge.max(EDGE_ROUNDING);
            let accepts = |found: &Solution<6>| self.has_sides(rule, &found.q, wanted, edge);
            let asked = Wanted { limits, seed, weights: &[1.0; 6], accepts: &accepts };
            let found = self.nearest_at_singularity(solutions, &asked)?;
            if found.is_some() {
                return Ok(found);
            }
        }
        Ok(None)
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

/// The solutions of a pose and one near some of them, which replaces its equals and the
/// representative of its self-motion.
fn with_near(
    solutions: &Solutions<6>,
    near: Option<Solution<6>>,
) -> impl Iterator<Item = Solution<6>> + Clone + '_ {
    let is_replaced = move |solution: &Solution<6>| {
        near.is_some_and(|near| {
            let mut pairs = solution.q.iter().zip(near.q);
            (solution.free_joint.is_some() && solution.slot == near.slot)
                || pairs.all(|(one, other)| wrap(one - other).abs() <= EDGE_ROUNDING)
        })
    };
    solutions.iter().copied().filter(move |solution| !is_replaced(solution)).chain(near)
}
