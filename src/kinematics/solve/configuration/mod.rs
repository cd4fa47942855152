//! ABB's confdata: the configuration of a joint vector, and the joint vectors of a pose that have
//! one.

mod arm_angle;
mod arm_angle_search;
mod coaxial;
pub(crate) mod fault;
mod having;
mod rule;
mod six_axes;
mod spherical_wrist;
mod yumi;

use alloc::vec::Vec;

use rule::Quarters;

use crate::error::Error;
use crate::kinematics::answer::check::check_arm_angle;
use crate::kinematics::answer::request::ConfigurationRequest;
use crate::kinematics::answer::select::Cost;
use crate::kinematics::answer::select::Turns;
use crate::kinematics::answer::solutions::Solution;
use crate::kinematics::pose::{Pose, checked_pose};
use crate::kinematics::robot::Robot;
use crate::kinematics::solve::configuration::fault::NoConfiguration;
use crate::report::ConfigurationRule;
use crate::report::Explanation;

impl<const N: usize> Robot<N> {
    /// The solution inside the limits that has a configuration, which also selects the 2 pi
    /// equivalents of axes 1, 4 and 6. A [`Configuration`](crate::Configuration) is a request.
    ///
    /// An angle within [`CONFIGURATION_EDGE`](crate::thresholds::CONFIGURATION_EDGE) of the edge of
    /// a quarter turn matches either side of it; axis 5 near zero and a straight elbow match either
    /// branch. A joint that the pose leaves undetermined takes the side that the configuration
    /// names. For an arm with coupled axes the branches in front of the lower arm are tried first.
    ///
    /// The configuration of a GoFa may name two solutions of a pose: of these, the one nearest to
    /// the request's seed is returned. Only if none is inside the limits, one up to
    /// [`TAUGHT_BEYOND_LIMITS`](crate::thresholds::TAUGHT_BEYOND_LIMITS) beyond them is. A YuMi
    /// needs the arm angle in the request.
    ///
    /// # Errors
    ///
    /// As [`Robot::ik_nearest`]; [`Error::NoConfiguration`], which lists the configurations that
    /// exist; [`Error::InvalidJoints`] for a `cfx` that the arm does not have, for an arm angle
    /// that a YuMi's request lacks, and for numbers that are not finite; [`Error::InvalidModel`] as
    /// [`Robot::configuration_rule`], and for the arm angle of another arm.
    pub fn ik_configured(
        &self,
        pose: &Pose,
        request: impl Into<ConfigurationRequest<N>>,
    ) -> Result<Solution<N>, Error> {
        let request = request.into();
        request.check()?;
        self.configured_checked(checked_pose(pose)?, &request)
    }

    /// Every solution that [`Robot::ik_configured`] chooses among, its own first, then those
    /// farther from the seed: one, and of a GoFa perhaps two.
    ///
    /// # Errors
    ///
    /// As [`Robot::ik_configured`].
    pub fn ik_configured_all(
        &self,
        pose: &Pose,
        request: impl Into<ConfigurationRequest<N>>,
    ) -> Result<Vec<Solution<N>>, Error> {
        let request = request.into();
        request.check()?;
        self.configured_all_checked(checked_pose(pose)?, &request)
    }

    /// [`Robot::ik_configured`] of a request that is checked.
    #[doc(hidden)]
    pub fn configured_checked(
        &self,
        pose: Pose,
        request: &ConfigurationRequest<N>,
    ) -> Result<Solution<N>, Error> {
        let seed = request.seed.unwrap_or_else(|| self.limits().rest());
        match self.with_configurations()?.configured_near(&pose, request, &seed) {
            Err(Error::NoConfiguration(_)) if request.or_nearest => {
                self.nearest_checked(pose, &seed, &[1.0; N])
            }
            answer => answer,
        }
    }

    /// [`Robot::ik_configured_all`] of a request that is checked.
    #[doc(hidden)]
    pub fn configured_all_checked(
        &self,
        pose: Pose,
        request: &ConfigurationRequest<N>,
    ) -> Result<Vec<Solution<N>>, Error> {
        let seed = request.seed.unwrap_or_else(|| self.limits().rest());
        match self.with_configurations()?.configured_list(&pose, request, &seed) {
            Err(Error::NoConfiguration(_)) if request.or_nearest => {
                Ok(Vec::from([self.nearest_checked(pose, &seed, &[1.0; N])?]))
            }
            answer => answer,
        }
    }

    /// The arm angle of joint angles [rad], as a YuMi's controller has it in the `eax_a` of a
    /// robtarget; `None` where the arm leaves it undetermined.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidJoints`] when an angle is not finite; [`Error::InvalidModel`] for an arm
    /// that is not a YuMi of the catalog.
    pub fn arm_angle(&self, q: &[f64; N]) -> Result<Option<f64>, Error> {
        self.with_configurations()?.arm_angle_of(q)
    }

    /// Every joint vector that brings the tool to `pose` with an arm angle [rad], inside the limits
    /// or not.
    ///
    /// The search follows the arm's self-motion from all solutions at angles of the last joint,
    /// then of the first, one degree apart, then at one angle of ABB's axis 7. It may miss a
    /// self-motion that turns the two by less. Where two axes are one line, one joint vector
    /// represents those that share the sum of their angles, with its `free_joint`.
    ///
    /// # Errors
    ///
    /// As [`Robot::arm_angle`] and [`Robot::ik_with`].
    pub fn ik_arm_angle(&self, pose: &Pose, arm_angle: f64) -> Result<Vec<Solution<N>>, Error> {
        check_arm_angle(arm_angle)?;
        self.with_configurations()?.at_arm_angle(&checked_pose(pose)?, arm_angle)
    }

    /// All joint vectors inside the limits, 2 pi equivalents too, of a pose and an arm angle [rad],
    /// if the arm has one.
    #[doc(hidden)]
    pub fn ik_inside_at(
        &self,
        pose: &Pose,
        arm_angle: Option<f64>,
    ) -> Result<Vec<[f64; N]>, Error> {
        let solutions: Vec<Solution<N>> = match (self.with_redundancy(), arm_angle) {
            (None, _) => self.ik_with(pose, None)?.iter().copied().collect(),
            (Some(_), Some(angle)) => self.ik_arm_angle(pose, angle)?,
            (Some(_), None) => Vec::new(),
        };
        let turns = solutions.iter().flat_map(|solution| Turns::of(self.limits(), solution));
        Ok(turns.map(|turn| turn.q).collect())
    }

    /// The joint vector nearest to a seed [rad] inside the limits, of a pose and an arm angle
    /// [rad], if the arm has one.
    ///
    /// # Errors
    ///
    /// As [`Robot::ik_nearest`].
    #[doc(hidden)]
    pub fn ik_nearest_at(
        &self,
        pose: &Pose,
        seed: &[f64; N],
        arm_angle: Option<f64>,
    ) -> Result<[f64; N], Error> {
        let (Some(arm), Some(angle)) = (self.with_redundancy(), arm_angle) else {
            return Ok(self.ik_nearest(pose, seed, &[1.0; N])?.q);
        };
        let near = self.with_configurations()?.step_to(seed, pose, angle);
        if let Some(near) = near.filter(|q| self.limits().contains(q)) {
            return Ok(near);
        }
        let distance = |q: &[f64; N]| Cost::Distance.total(q, seed, &[1.0; N]);
        let inside = self.ik_inside_at(pose, arm_angle)?;
        let nearest = inside.into_iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let explained = || match arm.explain_along_redundancy(pose)? {
            Explanation::Found { .. } => Ok(Explanation::NoArmAngle { arm_angle: angle }),
            other => Ok::<_, Error>(other),
        };
        nearest.map_or_else(|| Err(Error::Unreachable(explained()?)), Ok)
    }

    /// Add the configurations of a solution's 2 pi equivalents inside the limits, each once, while
    /// there is room.
    fn list_turns(
        &self,
        rule: &ConfigurationRule,
        solution: &Solution<N>,
        none: &mut NoConfiguration,
    ) {
        let Some(q) = self.limits().wrapped_near(&solution.q, &solution.q) else { return };
        // 2 pi equivalents of the other axes have the same configurations.
        let counted = Quarters::of(rule).joints;
        let mut limits = *self.limits();
        for joint in (0..N).filter(|joint| !counted.contains(joint)) {
            let Some(narrowed) = limits.narrowed(&[(joint, [q[joint]; 2])]) else { return };
            limits = narrowed;
        }
        for turn in Turns::of(&limits, &Solution { q, ..*solution }) {
            let configuration = self.counted_by(rule, &turn.q);
            if none.existing.contains(&configuration) {
                continue;
            }
            if none.existing.len() == NoConfiguration::MOST {
                none.more = true;
                return;
            }
            none.existing.push(configuration);
        }
    }
}
