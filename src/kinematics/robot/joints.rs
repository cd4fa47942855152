//! The part of a robot that depends on its number of joints, stated once for each number.

use alloc::sync::Arc;
use alloc::vec::Vec;
use core::fmt;

use crate::error::{Error, ModelFault};
use crate::kinematics::answer::request::ConfigurationRequest;
use crate::kinematics::answer::solutions::Solution;
use crate::kinematics::chain::Chain;
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::pose::Pose;
use crate::kinematics::structure::inverse::{Inverse, Solved};
use crate::kinematics::structure::known::Known;
use crate::kinematics::structure::spherical_wrist::OpwParameters;
use crate::report::Explanation;

/// A robot of a number of joints that arms have: 1 to 12, of which 5, 6 and 7 have an inverse.
///
/// Code that is generic over the number of joints needs it to build a robot, and for nothing else:
/// `where Robot<N>: Joints<N>`. It is implemented here only.
pub trait Joints<const N: usize>: Sized + 'static {
    #[doc(hidden)]
    const COUNT: &'static Count<Self, N>;
}

/// The part of a robot `R` of `N` joints that depends on `N`.
pub struct Count<R, const N: usize> {
    pub(super) known: Known<N>,
    /// The chain and the inverse of an ortho-parallel arm with a spherical wrist.
    pub(super) of_opw: Option<fn(&OpwParameters) -> Solved<N>>,
    /// The inverse of a calibrated chain, the second, by way of a nominal one, the first.
    pub(super) refined: Option<Refine<N>>,
    pub(super) configured: Option<fn(&R) -> &dyn Configured<N>>,
    pub(super) redundancy: Option<fn(&R) -> &dyn Redundancy<N>>,
}

type Refine<const N: usize> =
    fn(&dyn Inverse<N>, [&Chain<N>; 2], &JointLimits<N>) -> Arc<dyn Inverse<N>>;

impl<R, const N: usize> Count<R, N> {
    /// A chain without an inverse.
    pub(super) const CHAIN: Self = Self {
        known: Known { closed_forms: &[], others: &[] },
        of_opw: None,
        refined: None,
        configured: None,
        redundancy: None,
    };
}

impl<R, const N: usize> fmt::Debug for Count<R, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{N} joints")
    }
}

/// Solutions by their configuration, and of a `YuMi` by their arm angle.
pub(crate) trait Configured<const N: usize> {
    /// All solutions with the configuration of a request, the nearest to a seed first.
    fn configured_list(
        &self,
        pose: &Pose,
        request: &ConfigurationRequest<N>,
        seed: &[f64; N],
    ) -> Result<Vec<Solution<N>>, Error>;

    /// The solution with the configuration of a request, of several the one nearest to a seed.
    fn configured_near(
        &self,
        pose: &Pose,
        request: &ConfigurationRequest<N>,
        seed: &[f64; N],
    ) -> Result<Solution<N>, Error> {
        let list = self.configured_list(pose, request, seed)?;
        list.first().copied().ok_or(Error::Unreachable(Explanation::FilteredOut))
    }

    /// The arm angle of joint angles [rad].
    fn arm_angle_of(&self, _q: &[f64; N]) -> Result<Option<f64>, Error> {
        Err(ModelFault::NoArmAngle.into())
    }

    /// All joint vectors of a pose and an arm angle that are checked.
    fn at_arm_angle(&self, _pose: &Pose, _arm_angle: f64) -> Result<Vec<Solution<N>>, Error> {
        Err(ModelFault::NoArmAngle.into())
    }

    /// The joints of a pose and an arm angle that are a small step from others.
    fn step_to(&self, _from: &[f64; N], _pose: &Pose, _arm_angle: f64) -> Option<[f64; N]> {
        None
    }
}

/// Solutions along the self-motion of a pose.
pub(crate) trait Redundancy<const N: usize> {
    /// The solution inside the limits that is nearest to `seed`, among those that are accepted.
    fn nearest_along_redundancy(
        &self,
        pose: &Pose,
        seed: &[f64; N],
        weights: &[f64; N],
        accepts: &dyn Fn(&[f64; N]) -> bool,
    ) -> Result<Solution<N>, Error>;

    /// The solution inside the limits that is nearest to `seed` along the curve that passes there.
    fn continued_along_redundancy(
        &self,
        pose: &Pose,
        seed: &[f64; N],
        weights: &[f64; N],
    ) -> Result<Option<Solution<N>>, Error>;

    /// The outcome of a solve over every angle of the joint, in a sentence.
    fn explain_along_redundancy(&self, pose: &Pose) -> Result<Explanation, Error>;
}
