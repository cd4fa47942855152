//! A block of poses in lanes.

use super::branch::{Branch, Constants, branch};
use crate::kinematics::structure::lanes::{
    Block, Columns, Directions, FOUND_INSIDE, Poses, SlotColumns, half_turn, where_found,
};
use crate::kinematics::thresholds::MOST_ANGLE;
use crate::lanes::{Column, Flags, LANES};

/// Slots of the structure.
pub(super) const SLOTS: usize = 8;

/// Branches of elbow and wrist; each has two shoulders.
pub(super) const BRANCHES: usize = SLOTS / 2;

/// Columns of the directions: one for each elbow, then five for each branch.
const THETA_4: usize = 0;
const THETA_1: usize = THETA_4 + 2;
const THETA_2: usize = THETA_1 + BRANCHES;
const THETA_3: usize = THETA_2 + BRANCHES;
const THETA_5: usize = THETA_3 + BRANCHES;
const THETA_6: usize = THETA_5 + BRANCHES;
const DIRECTIONS: usize = THETA_6 + BRANCHES;

/// A block of poses with its solutions.
pub(crate) struct ShoulderBlock {
    /// Sines and cosines, of any length.
    directions: Directions<DIRECTIONS, LANES>,
    slots: SlotColumns<7, SLOTS>,
    regular: Flags,
}

impl Block<Constants, 7, SLOTS> for ShoulderBlock {
    type Slots = SlotColumns<7, SLOTS>;

    const NEW: Self =
        Self { directions: Directions::NEW, slots: SlotColumns::NEW, regular: [0; LANES] };

    #[inline(always)]
    fn solve<const FUSED: bool>(
        &mut self,
        kernel: &Constants,
        columns: &Columns<7>,
        frames: &mut Poses,
        q7: Column,
    ) -> Flags {
        let constants = *kernel;
        for lane in 0..LANES {
            frames.set_frame(lane, constants.hand::<FUSED>(&frames.frame(lane), q7[lane]));
            self.regular[lane] = u64::from(q7[lane].abs() <= MOST_ANGLE);
        }
        for lane in 0..LANES {
            let hand = frames.frame(lane);
            self.put(lane, 0, &branch::<FUSED>(&constants, &hand, 1.0, 1.0));
            self.put(lane, 1, &branch::<FUSED>(&constants, &hand, 1.0, -1.0));
            self.put(lane, 2, &branch::<FUSED>(&constants, &hand, -1.0, 1.0));
            self.put(lane, 3, &branch::<FUSED>(&constants, &hand, -1.0, -1.0));
        }
        self.directions.angles::<FUSED>();
        self.thetas();
        self.slots.wrap_given(&columns.joints, &q7);
        self.regular
    }

    #[inline(always)]
    fn slots(&self) -> &SlotColumns<7, SLOTS> {
        &self.slots
    }
}

impl ShoulderBlock {
    #[inline(always)]
    fn put(&mut self, lane: usize, number: usize, branch: &Branch) {
        // The wrists of an elbow share theta_4.
        self.directions.set(THETA_4 + number / 2, lane, branch.theta_4);
        self.directions.set(THETA_1 + number, lane, branch.theta_1);
        self.directions.set(THETA_2 + number, lane, branch.theta_2);
        self.directions.set(THETA_3 + number, lane, branch.theta_3);
        self.directions.set(THETA_5 + number, lane, branch.theta_5);
        self.directions.set(THETA_6 + number, lane, branch.theta_6);
        let status = if branch.reached { FOUND_INSIDE } else { 0 };
        self.slots.status[number][lane] = status;
        self.slots.status[number + BRANCHES][lane] = status;
        self.regular[lane] &= u64::from(branch.regular);
    }

    /// theta of every slot (eq. 64).
    #[inline(always)]
    fn thetas(&mut self) {
        let (angle, status) = (&self.directions.angle, &self.slots.status);
        let q = &mut self.slots.q;
        for number in 0..BRANCHES {
            let flipped = number + BRANCHES;
            for lane in 0..LANES {
                let [theta_1, theta_2, theta_3] = [
                    angle[THETA_1 + number][lane],
                    angle[THETA_2 + number][lane],
                    angle[THETA_3 + number][lane],
                ];
                [q[0][number][lane], q[1][number][lane], q[2][number][lane]] =
                    [theta_1, theta_2, theta_3];
                [q[0][flipped][lane], q[1][flipped][lane], q[2][flipped][lane]] =
                    [half_turn(theta_1), -theta_2, half_turn(theta_3)];
                let theta_4 = where_found(status[number][lane], angle[THETA_4 + number / 2][lane]);
                [q[3][number][lane], q[3][flipped][lane]] = [theta_4; 2];
                [q[4][number][lane], q[4][flipped][lane]] = [angle[THETA_5 + number][lane]; 2];
                [q[5][number][lane], q[5][flipped][lane]] = [angle[THETA_6 + number][lane]; 2];
            }
        }
    }
}
