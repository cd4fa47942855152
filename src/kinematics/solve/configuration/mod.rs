//! ABB's confdata: the configuration of a joint vector, and the joint vectors of a pose that have
//! one.

mod arm_angle;
mod arm_angle_search;
mod coaxial;
mod having;
#[cfg(feature = "rapid")]
mod near_arm_angle;
mod request;
mod rule;
mod six_axes;
mod spherical_wrist;
mod yumi;

pub use request::ConfigurationRequest;

use alloc::vec::Vec;
use core::any::Any;

use rule::Quarters;

use crate::error::{Error, ModelFault, NoConfiguration};
use crate::kinematics::answer::select::Turns;
use crate::kinematics::answer::solutions::Solution;
use crate::kinematics::pose::{Pose, checked_pose};
use crate::kinematics::robot::Robot;
use crate::kinematics::structure::inverse::of_count;
use crate::report::{ConfigurationRule, Explanation};

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
    pub(crate) fn configured_checked(
        &self,
        pose: Pose,
        request: &ConfigurationRequest<N>,
    ) -> Result<Solution<N>, Error> {
        let seed = request.seed.unwrap_or_else(|| self.limits().rest());
        match self.configured(&pose, request, &seed) {
            Err(Error::NoConfiguration(_)) if request.or_nearest => {
                self.nearest_checked(pose, &seed, &[1.0; N])
            }
            answer => answer,
        }
    }

    /// [`Robot::ik_configured_all`] of a request that is checked.
    pub(crate) fn configured_all_checked(
        &self,
        pose: Pose,
        request: &ConfigurationRequest<N>,
    ) -> Result<Vec<Solution<N>>, Error> {
        let seed = request.seed.unwrap_or_else(|| self.limits().rest());
        match self.all_configured(&pose, request, &seed) {
            Err(Error::NoConfiguration(_)) if request.or_nearest => {
                Ok(Vec::from([self.nearest_checked(pose, &seed, &[1.0; N])?]))
            }
            answer => answer,
        }
    }

    /// The solution with the configuration of a request, of several the one nearest to a seed.
    fn configured(
        &self,
        pose: &Pose,
        request: &ConfigurationRequest<N>,
        seed: &[f64; N],
    ) -> Result<Solution<N>, Error> {
        let arm: &dyn Any = self;
        if let (Some(six), Some(request), Some(seed)) =
            (arm.downcast_ref::<Robot<6>>(), of_count(*request), of_count(*seed))
            && let Some(found) = of_count(six.configured_near(pose, &request, &seed))
        {
            return found;
        }
        let list = self.all_configured(pose, request, seed)?;
        list.first().copied().ok_or(Error::Unreachable(Explanation::FilteredOut))
    }

    /// All solutions with the configuration of a request, the nearest to a seed first.
    fn all_configured(
        &self,
        pose: &Pose,
        request: &ConfigurationRequest<N>,
        seed: &[f64; N],
    ) -> Result<Vec<Solution<N>>, Error> {
        let arm: &dyn Any = self;
        let found = if let (Some(six), Some(request), Some(seed)) =
            (arm.downcast_ref::<Robot<6>>(), of_count(*request), of_count(*seed))
        {
            of_count(six.configured_list(pose, &request, &seed))
        } else if let (Some(seven), Some(request), Some(seed)) =
            (arm.downcast_ref::<Robot<7>>(), of_count(*request), of_count(*seed))
        {
            of_count(seven.configured_list(pose, &request, &seed))
        } else {
            None
        };
        let structure = self.structure();
        found.unwrap_or(Err(ModelFault::NoConfiguration { structure, snap: None }.into()))
    }

    /// The arm angle of joint angles, of an arm that has one.
    #[cfg(feature = "rapid")]
    pub(crate) fn arm_angle_of(&self, q: &[f64; N]) -> Result<Option<f64>, Error> {
        let arm: &dyn Any = self;
        match (arm.downcast_ref::<Robot<7>>(), of_count(*q)) {
            (Some(seven), Some(q)) => seven.arm_angle(&q),
            _ => Err(ModelFault::NoArmAngle.into()),
        }
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
