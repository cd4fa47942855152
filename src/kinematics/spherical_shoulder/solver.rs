//! An arm between the frames in which poses are given: what a solve needs.

use nalgebra::{Rotation3, Vector3};

use super::SphericalShoulder;
use crate::kinematics::branches::Branches;
use crate::kinematics::chain::Chain;
use crate::kinematics::free_choice::FreeChoice;
use crate::kinematics::pose::Pose;

/// The geometry, with what stands before and behind it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SevenSolver {
    pub(crate) arm: SphericalShoulder,
    t_shoulder_world: Pose,
    t_tool_seven: Pose,
    t_seven_hand: Pose,
}

impl SevenSolver {
    /// The solver of `arm` between the base and the tool of its chain.
    pub(crate) fn new(arm: SphericalShoulder, chain: &Chain<7>) -> Self {
        let arm = arm.standing_between(chain.base(), chain.tool());
        Self {
            t_shoulder_world: (chain.base() * arm.placement.t_base_shoulder).inverse(),
            t_tool_seven: (arm.placement.t_wrist_flange * chain.tool()).inverse(),
            t_seven_hand: arm.t_hand_seven.inverse(),
            arm,
        }
    }

    /// The hand of a tool pose, seen from the shoulder, with joint 7 at `q7` (eq. 1).
    pub(crate) fn hand_pose(&self, pose: &Pose, q7: f64) -> Pose {
        let theta_7 = self.arm.theta(&[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, q7])[6];
        let unturned = Rotation3::from_axis_angle(&Vector3::z_axis(), -theta_7);
        self.t_shoulder_world * pose * self.t_tool_seven * unturned * self.t_seven_hand
    }

    /// Every joint vector that brings the tool to `pose`, with joint 7 at `free.q[6]`; limits are not regarded.
    pub(crate) fn solve(&self, pose: &Pose, free: &FreeChoice<7>) -> Branches<7> {
        self.arm.solve_hand(&self.hand_pose(pose, free.q[6]), free)
    }
}
