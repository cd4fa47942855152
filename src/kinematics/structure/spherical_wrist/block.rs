//! A block of poses in lanes.

use super::branch::{Branch, Constants, branch};
use super::solver::{Columns, WristSolver};
use crate::kinematics::answer::solutions::SLOTS;
use crate::kinematics::structure::lanes::{
    AnswerRow, Block, BlockSolver, Directions, FOUND_INSIDE, Poses, StatusRow, half_turn,
};
use crate::lanes::{Column, Flags, LANES, mul_add};

/// Branches of the arm: two shoulders with two elbows each.
pub(super) const BRANCHES: usize = SLOTS / 2;

/// Directions whose angles a block needs: one for each shoulder, five for each branch.
const DIRECTIONS: usize = 2 + 5 * BRANCHES;

/// A column for each branch.
type Branches = [Column; BRANCHES];

/// What becomes of a block of poses.
pub(crate) struct WristBlock {
    /// Sine and cosine of theta_1, for each shoulder, and of theta_2, theta_23, theta_4, theta_5, theta_6, for each branch, of any length.
    directions: Directions<DIRECTIONS, LANES>,
    /// theta, later q, of the unflipped slots.
    q: [Branches; 6],
    /// theta, later q, of joints 4 to 6 with the wrist flipped.
    flipped: [Branches; 3],
    /// Of the unflipped and of the flipped slots.
    status: [[Flags; BRANCHES]; 2],
    plain: Flags,
}

impl BlockSolver<6> for WristSolver {
    type Block = WristBlock;

    fn in_lanes(&self) -> bool {
        self.columns.is_some()
    }
}

impl Block<6> for WristBlock {
    type Solver = WristSolver;

    const NEW: Self = Self {
        directions: Directions::NEW,
        q: [[[0.0; LANES]; BRANCHES]; 6],
        flipped: [[[0.0; LANES]; BRANCHES]; 3],
        status: [[[0; LANES]; BRANCHES]; 2],
        plain: [0; LANES],
    };

    #[inline(always)]
    fn solve<const FUSED: bool>(
        &mut self,
        solver: &WristSolver,
        poses: &mut Poses,
        _given: &Column,
    ) {
        let Some(columns) = &solver.columns else { return };
        self.plain = poses.check();
        poses.seen_from_shoulder::<FUSED>(solver.surroundings.seen);
        if solver.arm.planar.b == 0.0 {
            self.branches::<FUSED, false>(solver.constants, poses);
        } else {
            self.branches::<FUSED, true>(solver.constants, poses);
        }
        self.directions.angles::<FUSED>();
        self.settle::<FUSED>(columns);
    }

    #[inline(never)]
    #[expect(clippy::cast_possible_truncation, reason = "flags of a byte")]
    fn write(&self, q: &mut [AnswerRow<6>; LANES], status: &mut [StatusRow; LANES]) {
        for slot in 0..SLOTS {
            let columns = self.columns_of(slot);
            for k in 0..3 {
                let (left, right) = (columns[2 * k], columns[2 * k + 1]);
                for lane in 0..LANES {
                    q[lane].as_flattened_mut().as_chunks_mut::<2>().0[3 * slot + k] =
                        [left[lane], right[lane]];
                }
            }
            for lane in 0..LANES {
                status[lane][slot] = self.status[slot % 2][slot / 2][lane] as u8;
            }
        }
    }

    fn is_plain(&self, lane: usize) -> bool {
        self.plain[lane] != 0
    }
}

impl WristBlock {
    #[inline(always)]
    fn branches<const FUSED: bool, const LATERAL: bool>(&mut self, arm: Constants, poses: &Poses) {
        for lane in 0..LANES {
            let frame = poses.frame(lane);
            self.put(lane, 0, &branch::<FUSED, LATERAL>(&arm, &frame, 1.0, 1.0));
            self.put(lane, 1, &branch::<FUSED, LATERAL>(&arm, &frame, 1.0, -1.0));
            self.put(lane, 2, &branch::<FUSED, LATERAL>(&arm, &frame, -1.0, 1.0));
            self.put(lane, 3, &branch::<FUSED, LATERAL>(&arm, &frame, -1.0, -1.0));
        }
    }

    #[inline(always)]
    fn put(&mut self, lane: usize, number: usize, branch: &Branch) {
        // The elbows of a shoulder share theta_1.
        self.directions.set(number / 2, lane, branch.theta_1);
        self.directions.set(2 + number, lane, branch.theta_2);
        self.directions.set(6 + number, lane, branch.theta_23);
        self.directions.set(10 + number, lane, branch.theta_4);
        self.directions.set(14 + number, lane, branch.theta_5);
        self.directions.set(18 + number, lane, branch.theta_6);
        self.status[0][number][lane] = if branch.reached { FOUND_INSIDE } else { 0 };
        self.plain[lane] &= u64::from(branch.plain);
    }

    #[inline(always)]
    fn settle<const FUSED: bool>(&mut self, columns: &Columns) {
        let Columns { joints: columns, serial, rod } = columns;
        let angle = &self.directions.angle;
        for number in 0..BRANCHES {
            self.q[0][number] = angle[number / 2];
            self.q[1][number] = angle[2 + number];
            for lane in 0..LANES {
                self.q[2][number][lane] =
                    mul_add::<FUSED>(-serial, angle[2 + number][lane], angle[6 + number][lane]);
                self.flipped[0][number][lane] = half_turn(angle[10 + number][lane]);
                self.flipped[1][number][lane] = -angle[14 + number][lane];
                self.flipped[2][number][lane] = half_turn(angle[18 + number][lane]);
            }
            self.q[3][number] = angle[10 + number];
            self.q[4][number] = angle[14 + number];
            self.q[5][number] = angle[18 + number];
        }
        for joint in 0..3 {
            columns[joint]
                .settle(self.q[joint].as_flattened_mut(), self.status[0].as_flattened_mut());
        }
        if let Some(rod) = rod {
            for number in 0..BRANCHES {
                for lane in 0..LANES {
                    self.status[0][number][lane] &=
                        rod.left_of(angle[6 + number][lane] - angle[2 + number][lane]);
                }
            }
        }
        self.status[1] = self.status[0];
        for joint in 3..6 {
            columns[joint]
                .settle(self.q[joint].as_flattened_mut(), self.status[0].as_flattened_mut());
            columns[joint].settle(
                self.flipped[joint - 3].as_flattened_mut(),
                self.status[1].as_flattened_mut(),
            );
        }
    }

    #[inline(always)]
    fn columns_of(&self, slot: usize) -> [&Column; 6] {
        let (branch, flip) = (slot / 2, slot % 2);
        let (q, flipped) = (&self.q, &self.flipped);
        let wrist = if flip == 0 {
            [&q[3][branch], &q[4][branch], &q[5][branch]]
        } else {
            [&flipped[0][branch], &flipped[1][branch], &flipped[2][branch]]
        };
        [&q[0][branch], &q[1][branch], &q[2][branch], wrist[0], wrist[1], wrist[2]]
    }
}
