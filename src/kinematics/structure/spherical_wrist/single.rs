//! One pose in lanes: its four branches of the arm side by side.

use super::block::BRANCHES;
use super::branch::{Constants, branch};
use super::solver::{Columns, WristSolver};
use crate::kinematics::pose::Pose;
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::lanes::{Directions, FOUND_INSIDE, JointColumn, half_turn};
use crate::lanes::{Kernel, mul_add};

/// A pose to be solved.
pub(crate) struct Single<'a> {
    pub(crate) solver: &'a WristSolver,
    pub(crate) pose: &'a Pose,
}

/// Joint angles and status of the slots of a plain pose.
pub(crate) struct PlainSlots {
    arm: [[f64; BRANCHES]; 3],
    /// With the wrist unflipped and flipped.
    wrist: [[[f64; BRANCHES]; 3]; 2],
    status: [[u64; BRANCHES]; 2],
}

impl PlainSlots {
    /// The joint angles and the flags of a slot, where there is a solution.
    #[expect(clippy::cast_possible_truncation, reason = "flags of a byte")]
    pub(crate) fn slot(&self, slot: usize) -> Option<([f64; 6], u8)> {
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

impl Kernel for Single<'_> {
    /// Nothing where a branch is not plain, or none reaches: another way has to say more.
    type Answer = Option<PlainSlots>;
    const WIDE: bool = true;

    #[inline(always)]
    fn run<const FUSED: bool>(self) -> Self::Answer {
        let Self { solver, pose } = self;
        let columns = solver.columns.as_ref()?;
        let frame = solver.surroundings.seen.of::<FUSED>(&Frame::of(pose));
        let mut lanes = if solver.arm.planar.b == 0.0 {
            Lanes::of::<FUSED, false>(&solver.constants, &frame)
        } else {
            Lanes::of::<FUSED, true>(&solver.constants, &frame)
        }?;
        lanes.directions.angles::<FUSED>();
        Some(lanes.settled::<FUSED>(columns))
    }
}

const SHOULDER: [f64; BRANCHES] = [1.0, 1.0, -1.0, -1.0];
const ELBOW: [f64; BRANCHES] = [1.0, -1.0, 1.0, -1.0];

/// The branches of a pose: theta_1, theta_2, theta_23, theta_4, theta_5, theta_6.
struct Lanes {
    directions: Directions<6, BRANCHES>,
    status: [u64; BRANCHES],
}

impl Lanes {
    #[inline(always)]
    fn of<const FUSED: bool, const LATERAL: bool>(arm: &Constants, frame: &Frame) -> Option<Self> {
        let (arm, frame) = (*arm, *frame);
        let mut lanes = Self { directions: Directions::NEW, status: [0; BRANCHES] };
        let mut plain = [0; BRANCHES];
        for lane in 0..BRANCHES {
            let branch = branch::<FUSED, LATERAL>(&arm, &frame, SHOULDER[lane], ELBOW[lane]);
            lanes.directions.set(0, lane, branch.theta_1);
            lanes.directions.set(1, lane, branch.theta_2);
            lanes.directions.set(2, lane, branch.theta_23);
            lanes.directions.set(3, lane, branch.theta_4);
            lanes.directions.set(4, lane, branch.theta_5);
            lanes.directions.set(5, lane, branch.theta_6);
            lanes.status[lane] = if branch.reached { FOUND_INSIDE } else { 0 };
            plain[lane] = u64::from(branch.plain);
        }
        (plain == [1; BRANCHES] && lanes.status != [0; BRANCHES]).then_some(lanes)
    }

    #[inline(always)]
    fn settled<const FUSED: bool>(&self, columns: &Columns) -> PlainSlots {
        let (Columns { joints: columns, serial, rod }, angle) = (*columns, &self.directions.angle);
        let mut slots = PlainSlots {
            arm: [[0.0; BRANCHES]; 3],
            wrist: [[[0.0; BRANCHES]; 3]; 2],
            status: [[0; BRANCHES]; 2],
        };
        for lane in 0..BRANCHES {
            let (theta_2, theta_4, theta_5, theta_6) =
                (angle[1][lane], angle[3][lane], angle[4][lane], angle[5][lane]);
            let (q1, in_1) = columns[0].settled(angle[0][lane]);
            let (q2, in_2) = columns[1].settled(theta_2);
            let (q3, in_3) = columns[2].settled(mul_add::<FUSED>(-serial, theta_2, angle[2][lane]));
            let arm = &mut slots.arm;
            [arm[0][lane], arm[1][lane], arm[2][lane]] = [q1, q2, q3];
            let reached = self.status[lane]
                & if in_1 & in_2 & in_3 { u64::MAX } else { JointColumn::OUTSIDE };
            let (q4, in_4) = columns[3].settled(theta_4);
            let (q5, in_5) = columns[4].settled(theta_5);
            let (q6, in_6) = columns[5].settled(theta_6);
            let [wrist, flipped] = &mut slots.wrist;
            [wrist[0][lane], wrist[1][lane], wrist[2][lane]] = [q4, q5, q6];
            slots.status[0][lane] =
                reached & if in_4 & in_5 & in_6 { u64::MAX } else { JointColumn::OUTSIDE };
            let (q4, in_4) = columns[3].settled(half_turn(theta_4));
            let (q5, in_5) = columns[4].settled(-theta_5);
            let (q6, in_6) = columns[5].settled(half_turn(theta_6));
            [flipped[0][lane], flipped[1][lane], flipped[2][lane]] = [q4, q5, q6];
            slots.status[1][lane] =
                reached & if in_4 & in_5 & in_6 { u64::MAX } else { JointColumn::OUTSIDE };
        }
        if let Some(rod) = rod {
            for lane in 0..BRANCHES {
                let left = rod.left_of(angle[2][lane] - angle[1][lane]);
                slots.status[0][lane] &= left;
                slots.status[1][lane] &= left;
            }
        }
        slots
    }
}
