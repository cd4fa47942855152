//! A block of poses in lanes.

use super::branch::{Branch, branch};
use super::solver::{SevenSolver, hand_frame};
use crate::kinematics::answer::solutions::SLOTS;
use crate::kinematics::structure::lanes::{
    AnswerRow, Block, BlockSolver, Directions, FOUND_INSIDE, Poses, SlotColumns, StatusRow,
    half_turn,
};
use crate::kinematics::thresholds::MOST_ANGLE;
use crate::lanes::{Column, Flags, LANES};

/// Branches of elbow and wrist; the shoulder flips each.
pub(super) const BRANCHES: usize = SLOTS / 2;

/// Directions whose angles a block needs: one for each elbow, five for each branch.
const DIRECTIONS: usize = 2 + 5 * BRANCHES;

/// What becomes of a block of poses.
pub(crate) struct SevenBlock {
    /// Sine and cosine of theta_4, for each elbow, and of theta_1, theta_2, theta_3, theta_5, theta_6, for each branch, of any length.
    directions: Directions<DIRECTIONS, LANES>,
    slots: SlotColumns<7>,
    plain: Flags,
}

impl BlockSolver<7> for SevenSolver {
    type Block = SevenBlock;

    fn in_lanes(&self) -> bool {
        self.columns.is_some()
    }
}

impl Block<7> for SevenBlock {
    type Solver = SevenSolver;

    const NEW: Self =
        Self { directions: Directions::NEW, slots: SlotColumns::NEW, plain: [0; LANES] };

    #[inline(always)]
    fn solve<const FUSED: bool>(
        &mut self,
        solver: &SevenSolver,
        poses: &mut Poses,
        given: &Column,
    ) {
        let Some(columns) = &solver.columns else { return };
        self.plain = poses.check();
        poses.seen_from_shoulder::<FUSED>(solver.surroundings.seen);
        let (constants, hands, joint_7) = (solver.constants, solver.hand, solver.joint_7());
        for lane in 0..LANES {
            poses.set_frame(
                lane,
                hand_frame::<FUSED>(&poses.frame(lane), joint_7, given[lane], &hands),
            );
            self.plain[lane] &= u64::from(given[lane].abs() <= MOST_ANGLE);
        }
        for lane in 0..LANES {
            let hand = poses.frame(lane);
            self.put(lane, 0, &branch::<FUSED>(&constants, &hand, 1.0, 1.0));
            self.put(lane, 1, &branch::<FUSED>(&constants, &hand, 1.0, -1.0));
            self.put(lane, 2, &branch::<FUSED>(&constants, &hand, -1.0, 1.0));
            self.put(lane, 3, &branch::<FUSED>(&constants, &hand, -1.0, -1.0));
        }
        self.directions.angles::<FUSED>();
        self.thetas();
        self.slots.settle_given(columns, given);
    }

    #[inline(never)]
    fn write(&self, q: &mut [AnswerRow<7>; LANES], status: &mut [StatusRow; LANES]) {
        self.slots.write(q, status);
    }

    fn is_plain(&self, lane: usize) -> bool {
        self.plain[lane] != 0
    }
}

impl SevenBlock {
    #[inline(always)]
    fn put(&mut self, lane: usize, number: usize, branch: &Branch) {
        // The wrists of an elbow share theta_4.
        self.directions.set(number / 2, lane, branch.theta_4);
        self.directions.set(2 + number, lane, branch.theta_1);
        self.directions.set(6 + number, lane, branch.theta_2);
        self.directions.set(10 + number, lane, branch.theta_3);
        self.directions.set(14 + number, lane, branch.theta_5);
        self.directions.set(18 + number, lane, branch.theta_6);
        let status = if branch.reached { FOUND_INSIDE } else { 0 };
        self.slots.status[number][lane] = status;
        self.slots.status[number + BRANCHES][lane] = status;
        self.plain[lane] &= u64::from(branch.plain);
    }

    /// theta of every slot (eq. 64). Where an arm does not reach, none is a number.
    #[inline(always)]
    fn thetas(&mut self) {
        let (angle, q) = (&self.directions.angle, &mut self.slots.q);
        for number in 0..BRANCHES {
            let flipped = number + BRANCHES;
            for lane in 0..LANES {
                let [theta_1, theta_2, theta_3] =
                    [angle[2 + number][lane], angle[6 + number][lane], angle[10 + number][lane]];
                [q[0][number][lane], q[1][number][lane], q[2][number][lane]] =
                    [theta_1, theta_2, theta_3];
                [q[0][flipped][lane], q[1][flipped][lane], q[2][flipped][lane]] =
                    [half_turn(theta_1), -theta_2, half_turn(theta_3)];
                let theta_4 = angle[number / 2][lane] + 0.0 * theta_1;
                [q[3][number][lane], q[3][flipped][lane]] = [theta_4; 2];
                [q[4][number][lane], q[4][flipped][lane]] = [angle[14 + number][lane]; 2];
                [q[5][number][lane], q[5][flipped][lane]] = [angle[18 + number][lane]; 2];
            }
        }
    }
}
