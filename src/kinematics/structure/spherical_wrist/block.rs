//! A block of poses in lanes.

use super::branch::{Branch, Constants, branch};
use crate::kinematics::structure::lanes::{
    AnswerRow, Block, BlockSlots, Columns, Directions, FOUND_INSIDE, Poses, StatusRow, half_turn,
};
use crate::lanes::{Column, Flags, LANES, mul_add};

/// Slots of the structure.
const SLOTS: usize = 8;

/// Branches of the arm: two shoulders with two elbows each. Each has two wrists.
pub(super) const BRANCHES: usize = SLOTS / 2;

/// Columns of the directions: one for each shoulder, then five for each branch.
const THETA_1: usize = 0;
const THETA_2: usize = THETA_1 + 2;
const THETA_23: usize = THETA_2 + BRANCHES;
const THETA_4: usize = THETA_23 + BRANCHES;
const THETA_5: usize = THETA_4 + BRANCHES;
const THETA_6: usize = THETA_5 + BRANCHES;
const DIRECTIONS: usize = THETA_6 + BRANCHES;

/// A column for each branch.
type Branches = [Column; BRANCHES];

/// A block of poses with its solutions.
pub(crate) struct WristBlock {
    /// Sines and cosines, of any length.
    directions: Directions<DIRECTIONS, LANES>,
    /// theta, later q, of the unflipped slots.
    q: [Branches; 6],
    /// theta, later q, of joints 4 to 6 with the wrist flipped.
    flipped: [Branches; 3],
    /// The status of the unflipped and of the flipped slots.
    status: [[Flags; BRANCHES]; 2],
    regular: Flags,
}

impl Block<Constants, 6, SLOTS> for WristBlock {
    type Slots = Self;

    const NEW: Self = Self {
        directions: Directions::NEW,
        q: [[[0.0; LANES]; BRANCHES]; 6],
        flipped: [[[0.0; LANES]; BRANCHES]; 3],
        status: [[[0; LANES]; BRANCHES]; 2],
        regular: [0; LANES],
    };

    #[inline(always)]
    fn solve<const FUSED: bool>(
        &mut self,
        kernel: &Constants,
        columns: &Columns<6>,
        wrists: &mut Poses,
        _: Column,
    ) -> Flags {
        self.regular = [1; LANES];
        if kernel.b == 0.0 {
            self.branches::<FUSED, false>(*kernel, wrists);
        } else {
            self.branches::<FUSED, true>(*kernel, wrists);
        }
        self.directions.angles::<FUSED>();
        self.wrap::<FUSED>(columns);
        self.regular
    }

    #[inline(always)]
    fn slots(&self) -> &Self {
        self
    }
}

impl BlockSlots<6, SLOTS> for WristBlock {
    #[inline(never)]
    #[expect(clippy::cast_possible_truncation, reason = "flags of a byte")]
    fn write(&self, q: &mut [AnswerRow<6, SLOTS>; LANES], status: &mut [StatusRow<SLOTS>; LANES]) {
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

    #[inline(always)]
    fn angles(&self, slot: usize, joint: usize) -> Column {
        let (branch, flip) = (slot / 2, slot % 2);
        if flip == 0 || joint < 3 { self.q[joint][branch] } else { self.flipped[joint - 3][branch] }
    }

    #[inline(always)]
    fn status(&self, slot: usize) -> Flags {
        self.status[slot % 2][slot / 2]
    }
}

impl WristBlock {
    #[inline(always)]
    fn branches<const FUSED: bool, const LATERAL: bool>(&mut self, arm: Constants, wrists: &Poses) {
        for lane in 0..LANES {
            let frame = wrists.frame(lane);
            self.put(lane, 0, &branch::<FUSED, LATERAL>(&arm, &frame, 1.0, 1.0));
            self.put(lane, 1, &branch::<FUSED, LATERAL>(&arm, &frame, 1.0, -1.0));
            self.put(lane, 2, &branch::<FUSED, LATERAL>(&arm, &frame, -1.0, 1.0));
            self.put(lane, 3, &branch::<FUSED, LATERAL>(&arm, &frame, -1.0, -1.0));
        }
    }

    #[inline(always)]
    fn put(&mut self, lane: usize, number: usize, branch: &Branch) {
        // The elbows of a shoulder share theta_1.
        self.directions.set(THETA_1 + number / 2, lane, branch.theta_1);
        self.directions.set(THETA_2 + number, lane, branch.theta_2);
        self.directions.set(THETA_23 + number, lane, branch.theta_23);
        self.directions.set(THETA_4 + number, lane, branch.theta_4);
        self.directions.set(THETA_5 + number, lane, branch.theta_5);
        self.directions.set(THETA_6 + number, lane, branch.theta_6);
        self.status[0][number][lane] = if branch.reached { FOUND_INSIDE } else { 0 };
        self.regular[lane] &= u64::from(branch.regular);
    }

    /// Joint angles of the slots, with both wrists (eq. 18 to 20).
    #[inline(always)]
    fn wrap<const FUSED: bool>(&mut self, columns: &Columns<6>) {
        let Columns { joints: columns, uncoupled, linkage, .. } = columns;
        let angle = &self.directions.angle;
        for number in 0..BRANCHES {
            let (theta_2, theta_23) = (&angle[THETA_2 + number], &angle[THETA_23 + number]);
            self.q[0][number] = angle[THETA_1 + number / 2];
            self.q[1][number] = *theta_2;
            for lane in 0..LANES {
                self.q[2][number][lane] =
                    mul_add::<FUSED>(-uncoupled, theta_2[lane], theta_23[lane]);
                self.flipped[0][number][lane] = half_turn(angle[THETA_4 + number][lane]);
                self.flipped[1][number][lane] = -angle[THETA_5 + number][lane];
                self.flipped[2][number][lane] = half_turn(angle[THETA_6 + number][lane]);
            }
            self.q[3][number] = angle[THETA_4 + number];
            self.q[4][number] = angle[THETA_5 + number];
            self.q[5][number] = angle[THETA_6 + number];
        }
        for joint in 0..3 {
            columns[joint]
                .wrap(self.q[joint].as_flattened_mut(), self.status[0].as_flattened_mut());
        }
        if let Some(linkage) = linkage {
            for number in 0..BRANCHES {
                for lane in 0..LANES {
                    let uncoupled_3 =
                        angle[THETA_23 + number][lane] - angle[THETA_2 + number][lane];
                    self.status[0][number][lane] &= linkage.left_of(uncoupled_3);
                }
            }
        }
        self.status[1] = self.status[0];
        for joint in 3..6 {
            columns[joint]
                .wrap(self.q[joint].as_flattened_mut(), self.status[0].as_flattened_mut());
            columns[joint].wrap(
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
