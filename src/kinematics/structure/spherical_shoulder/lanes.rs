//! The arm in lanes: a block of poses side by side, and the four branches of one pose.

use super::branch::{Branch, Constants, branch};
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::lanes::{
    Block, Columns, Directions, FOUND_INSIDE, LaneKernel, Poses, RegularSlots, SlotColumns,
    half_turn, where_found,
};
use crate::kinematics::thresholds::MOST_ANGLE;
use crate::lanes::{Column, Flags, LANES};

/// Slots of the structure.
pub(super) const SLOTS: usize = 8;

/// Branches of elbow and wrist; each has two shoulders.
pub(super) const BRANCHES: usize = SLOTS / 2;

/// Columns of the directions of a block: one for each elbow, then five for each branch.
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
        let [theta_1, theta_2, theta_3, theta_4, theta_5, theta_6] = branch.theta;
        // The wrists of an elbow share theta_4.
        self.directions.set(THETA_4 + number / 2, lane, theta_4);
        self.directions.set(THETA_1 + number, lane, theta_1);
        self.directions.set(THETA_2 + number, lane, theta_2);
        self.directions.set(THETA_3 + number, lane, theta_3);
        self.directions.set(THETA_5 + number, lane, theta_5);
        self.directions.set(THETA_6 + number, lane, theta_6);
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

const ELBOW: [f64; BRANCHES] = [1.0, 1.0, -1.0, -1.0];
const WRIST: [f64; BRANCHES] = [1.0, -1.0, 1.0, -1.0];

impl LaneKernel<7, SLOTS> for Constants {
    const DIFFERENCES: &'static [usize] = &[];

    type Regular = RegularSlots<7, SLOTS>;
    type Block = ShoulderBlock;

    #[inline(always)]
    fn solve_one<const FUSED: bool>(
        &self,
        columns: &Columns<7>,
        t_shoulder_seven: &Frame,
        q7: f64,
    ) -> Option<RegularSlots<7, SLOTS>> {
        if q7.is_nan() || q7.abs() > MOST_ANGLE {
            return None;
        }
        let hand = self.hand::<FUSED>(t_shoulder_seven, q7);
        let (constants, columns) = (*self, columns.joints);
        let (mut directions, mut status, mut regular) =
            (Directions::<6, BRANCHES>::NEW, [0; BRANCHES], [0; BRANCHES]);
        for lane in 0..BRANCHES {
            let branch = branch::<FUSED>(&constants, &hand, ELBOW[lane], WRIST[lane]);
            directions.set_lane(lane, branch.theta);
            status[lane] = if branch.reached { FOUND_INSIDE } else { 0 };
            regular[lane] = u64::from(branch.regular);
        }
        if regular != [1; BRANCHES] || status == [0; BRANCHES] {
            return None;
        }
        directions.angles::<FUSED>();
        // With both shoulders (eq. 64).
        let mut slots = RegularSlots::NEW;
        let given = columns[6].limited(q7);
        for lane in 0..BRANCHES {
            let flipped = lane + BRANCHES;
            let [theta_1, theta_2, theta_3, theta_4, theta_5, theta_6] = directions.angles_of(lane);
            [slots.status[lane], slots.status[flipped]] = [status[lane] & given; 2];
            slots.wrap(lane, 0, theta_1, columns[0]);
            slots.wrap(lane, 1, theta_2, columns[1]);
            slots.wrap(lane, 2, theta_3, columns[2]);
            slots.wrap(flipped, 0, half_turn(theta_1), columns[0]);
            slots.wrap(flipped, 1, -theta_2, columns[1]);
            slots.wrap(flipped, 2, half_turn(theta_3), columns[2]);
            for slot in [lane, flipped] {
                slots.wrap(slot, 3, theta_4, columns[3]);
                slots.wrap(slot, 4, theta_5, columns[4]);
                slots.wrap(slot, 5, theta_6, columns[5]);
                slots.q[6][slot] = q7;
            }
        }
        Some(slots)
    }
}
