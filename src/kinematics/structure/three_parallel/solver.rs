//! An arm between the frames in which poses are given: what a solve needs.

use super::ThreeParallel;
use super::branch::Constants;
use crate::kinematics::chain::Chain;
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::structure::end_frames::Surroundings;
use crate::kinematics::structure::lanes::JointColumn;

/// The geometry, with what stands before and behind it and what is asked of its joints.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ParallelSolver {
    pub(crate) arm: ThreeParallel,
    pub(crate) surroundings: Surroundings,
    pub(super) constants: Constants,
    /// `None` where the limits ask for more than what lanes do.
    pub(super) columns: Option<[JointColumn; 6]>,
}

impl ParallelSolver {
    /// The solver of `arm` between the base and the tool of its chain, with limits (lower, upper) of six joints [rad].
    pub(crate) fn new<const N: usize>(
        arm: ThreeParallel,
        chain: &Chain<N>,
        limits: &JointLimits<N>,
    ) -> Self {
        let arm = arm.standing_between(chain.base(), chain.tool());
        Self {
            surroundings: Surroundings::new(&arm.placement, chain),
            constants: Constants::of(&arm),
            columns: JointColumn::of(
                &arm.placement.signs,
                &arm.placement.offsets,
                &limits.to_array(),
                &[2, 3],
            ),
            arm,
        }
    }
}
