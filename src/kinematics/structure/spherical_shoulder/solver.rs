//! An arm between the frames in which poses are given: what a solve needs.

use nalgebra::{Rotation3, Vector3};

use super::SphericalShoulder;
use super::branch::Constants;
use crate::kinematics::chain::Chain;
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::pose::Pose;
use crate::kinematics::structure::branches::Branches;
use crate::kinematics::structure::end_frames::{Frame, Surroundings};
use crate::kinematics::structure::free_choice::FreeChoice;
use crate::kinematics::structure::lanes::JointColumn;
use crate::lanes::sin_cos;

/// The geometry, with what stands before and behind it and what is asked of its joints.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SevenSolver {
    pub(crate) arm: SphericalShoulder,
    /// Up to the frame of joint 7 after its turn.
    pub(super) surroundings: Surroundings,
    t_seven_hand: Pose,
    pub(super) hand: Frame,
    pub(super) constants: Constants,
    /// `None` where the limits ask for more than what lanes do.
    pub(super) columns: Option<[JointColumn; 7]>,
}

impl SevenSolver {
    /// The solver of `arm` between the base and the tool of its chain, with limits (lower, upper) of seven joints [rad].
    pub(crate) fn new<const N: usize>(
        arm: SphericalShoulder,
        chain: &Chain<N>,
        limits: &JointLimits<N>,
    ) -> Self {
        let arm = arm.standing_between(chain.base(), chain.tool());
        let t_seven_hand = arm.t_hand_seven.inverse();
        Self {
            surroundings: Surroundings::new(&arm.placement, chain),
            t_seven_hand,
            hand: Frame::of(&t_seven_hand),
            constants: Constants::of(&arm.links),
            columns: JointColumn::of(
                &arm.placement.signs,
                &arm.placement.offsets,
                &limits.to_array(),
                &[],
            ),
            arm,
        }
    }

    /// The hand of a tool pose, seen from the shoulder, with joint 7 at `q7` (eq. 52).
    pub(crate) fn hand_pose(&self, pose: &Pose, q7: f64) -> Pose {
        let unturned = Rotation3::from_axis_angle(&Vector3::z_axis(), -self.theta_7(q7));
        self.surroundings.wrist_pose(pose) * unturned * self.t_seven_hand
    }

    /// Sign and offset of joint 7.
    pub(super) fn joint_7(&self) -> (f64, f64) {
        (self.arm.placement.signs[6], self.arm.placement.offsets[6])
    }

    fn theta_7(&self, q7: f64) -> f64 {
        let (sign, offset) = self.joint_7();
        sign * q7 - offset
    }

    /// Every joint vector that brings the tool to `pose`, with joint 7 at `free.q[6]`; limits are not regarded.
    pub(crate) fn solve(&self, pose: &Pose, free: &FreeChoice<7>) -> Branches<7> {
        self.arm.solve_hand(&self.hand_pose(pose, free.q[6]), free)
    }
}

/// The hand (eq. 52) of a frame of joint 7 that was seen from the shoulder.
#[inline(always)]
pub(super) fn hand_frame<const FUSED: bool>(
    seven: &Frame,
    (sign, offset): (f64, f64),
    q7: f64,
    hand: &Frame,
) -> Frame {
    let (sin_7, cos_7) = sin_cos::<FUSED>(sign * q7 - offset);
    seven.unturned::<FUSED>(sin_7, cos_7).times::<FUSED>(hand)
}
