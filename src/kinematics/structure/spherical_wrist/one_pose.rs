//! One pose in lanes: its four branches of the arm side by side.

use super::block::{BRANCHES, WristBlock};
use super::branch::{Constants, branch};
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::lanes::{
    Columns, Directions, FOUND_INSIDE, JointColumn, LaneKernel, RegularPose, half_turn,
};
use crate::lanes::mul_add;

impl LaneKernel<6, 8> for Constants {
    const DIFFERENCES: &'static [usize] = &[2];

    type Regular = WristSlots;
    type Block = WristBlock;

    fn for_path(&self) -> Option<Self> {
        Some(self.on_path())
    }

    #[inline(always)]
    fn solve_one<const FUSED: bool>(
        &self,
        columns: &Columns<6>,
        t_shoulder_wrist: &Frame,
        _: f64,
    ) -> Option<WristSlots> {
        let mut branches = if self.b == 0.0 {
            Branches::of::<FUSED, false>(self, t_shoulder_wrist)
        } else {
            Branches::of::<FUSED, true>(self, t_shoulder_wrist)
        }?;
        branches.directions.angles::<FUSED>();
        Some(branches.wrapped::<FUSED>(columns))
    }
}

/// Joint angles and status of the slots of a regular pose.
pub(crate) struct WristSlots {
    arm: [[f64; BRANCHES]; 3],
    /// The wrist angles, unflipped and flipped.
    wrist: [[[f64; BRANCHES]; 3]; 2],
    status: [[u64; BRANCHES]; 2],
}

impl RegularPose<6> for WristSlots {
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "flags of a byte")]
    fn slot(&self, slot: usize) -> Option<([f64; 6], u8)> {
        let (branch, flip) = (slot / 2, slot % 2);
        let (arm, wrist, status) = (&self.arm, &self.wrist[flip], self.status[flip][branch]);
        let q = [
            arm[0][branch],
            arm[1][branch],
            arm[2][branch],
            wrist[0][branch],
            wrist[1][branch],
            wrist[2][branch],
        ];
        (status != 0).then_some((q, status as u8))
    }
}

const SHOULDER: [f64; BRANCHES] = [1.0, 1.0, -1.0, -1.0];
const ELBOW: [f64; BRANCHES] = [1.0, -1.0, 1.0, -1.0];

/// Columns of the directions.
const THETA_1: usize = 0;
const THETA_2: usize = 1;
const THETA_23: usize = 2;
const THETA_4: usize = 3;
const THETA_5: usize = 4;
const THETA_6: usize = 5;

/// The branches of a pose, one per lane.
struct Branches {
    directions: Directions<6, BRANCHES>,
    status: [u64; BRANCHES],
}

impl Branches {
    #[inline(always)]
    fn of<const FUSED: bool, const LATERAL: bool>(arm: &Constants, frame: &Frame) -> Option<Self> {
        let (arm, frame) = (*arm, *frame);
        let mut branches = Self { directions: Directions::NEW, status: [0; BRANCHES] };
        let mut regular = [0; BRANCHES];
        for lane in 0..BRANCHES {
            let branch = branch::<FUSED, LATERAL>(&arm, &frame, SHOULDER[lane], ELBOW[lane]);
            branches.directions.set(THETA_1, lane, branch.theta_1);
            branches.directions.set(THETA_2, lane, branch.theta_2);
            branches.directions.set(THETA_23, lane, branch.theta_23);
            branches.directions.set(THETA_4, lane, branch.theta_4);
            branches.directions.set(THETA_5, lane, branch.theta_5);
            branches.directions.set(THETA_6, lane, branch.theta_6);
            branches.status[lane] = if branch.reached { FOUND_INSIDE } else { 0 };
            regular[lane] = u64::from(branch.regular);
        }
        (regular == [1; BRANCHES] && branches.status != [0; BRANCHES]).then_some(branches)
    }

    /// Joint angles of the slots, with both wrists (eq. 18 to 20).
    #[inline(always)]
    fn wrapped<const FUSED: bool>(&self, columns: &Columns<6>) -> WristSlots {
        let (Columns { joints: columns, uncoupled, linkage, .. }, angle) =
            (*columns, &self.directions.angle);
        let mut slots = WristSlots {
            arm: [[0.0; BRANCHES]; 3],
            wrist: [[[0.0; BRANCHES]; 3]; 2],
            status: [[0; BRANCHES]; 2],
        };
        for lane in 0..BRANCHES {
            let (theta_2, theta_23) = (angle[THETA_2][lane], angle[THETA_23][lane]);
            let (theta_4, theta_5, theta_6) =
                (angle[THETA_4][lane], angle[THETA_5][lane], angle[THETA_6][lane]);
            let (q1, in_1) = columns[0].wrapped(angle[THETA_1][lane]);
            let (q2, in_2) = columns[1].wrapped(theta_2);
            let (q3, in_3) = columns[2].wrapped(mul_add::<FUSED>(-uncoupled, theta_2, theta_23));
            let arm = &mut slots.arm;
            [arm[0][lane], arm[1][lane], arm[2][lane]] = [q1, q2, q3];
            let reached = self.status[lane]
                & if in_1 & in_2 & in_3 { u64::MAX } else { JointColumn::OUTSIDE };
            let (q4, in_4) = columns[3].wrapped(theta_4);
            let (q5, in_5) = columns[4].wrapped(theta_5);
            let (q6, in_6) = columns[5].wrapped(theta_6);
            let [wrist, flipped] = &mut slots.wrist;
            [wrist[0][lane], wrist[1][lane], wrist[2][lane]] = [q4, q5, q6];
            slots.status[0][lane] =
                reached & if in_4 & in_5 & in_6 { u64::MAX } else { JointColumn::OUTSIDE };
            let (q4, in_4) = columns[3].wrapped(half_turn(theta_4));
            let (q5, in_5) = columns[4].wrapped(-theta_5);
            let (q6, in_6) = columns[5].wrapped(half_turn(theta_6));
            [flipped[0][lane], flipped[1][lane], flipped[2][lane]] = [q4, q5, q6];
            slots.status[1][lane] =
                reached & if in_4 & in_5 & in_6 { u64::MAX } else { JointColumn::OUTSIDE };
        }
        if let Some(linkage) = linkage {
            for lane in 0..BRANCHES {
                let left = linkage.left_of(angle[THETA_23][lane] - angle[THETA_2][lane]);
                slots.status[0][lane] &= left;
                slots.status[1][lane] &= left;
            }
        }
        slots
    }
}
