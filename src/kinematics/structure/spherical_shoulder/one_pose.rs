//! One pose in lanes: its four branches of elbow and wrist side by side.

use super::block::{BRANCHES, SLOTS, ShoulderBlock};
use super::branch::{Constants, branch};
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::lanes::{
    Columns, Directions, FOUND_INSIDE, JointColumn, LaneKernel, RegularSlots, half_turn,
};
use crate::kinematics::thresholds::MOST_ANGLE;

const ELBOW: [f64; BRANCHES] = [1.0, 1.0, -1.0, -1.0];
const WRIST: [f64; BRANCHES] = [1.0, -1.0, 1.0, -1.0];

/// Columns of the directions.
const THETA_1: usize = 0;
const THETA_2: usize = 1;
const THETA_3: usize = 2;
const THETA_4: usize = 3;
const THETA_5: usize = 4;
const THETA_6: usize = 5;

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
            directions.set(THETA_1, lane, branch.theta_1);
            directions.set(THETA_2, lane, branch.theta_2);
            directions.set(THETA_3, lane, branch.theta_3);
            directions.set(THETA_4, lane, branch.theta_4);
            directions.set(THETA_5, lane, branch.theta_5);
            directions.set(THETA_6, lane, branch.theta_6);
            status[lane] = if branch.reached { FOUND_INSIDE } else { 0 };
            regular[lane] = u64::from(branch.regular);
        }
        if regular != [1; BRANCHES] || status == [0; BRANCHES] {
            return None;
        }
        directions.angles::<FUSED>();
        Some(wrapped(&columns, &directions.angle, status, q7))
    }
}

/// Joint angles of the slots, with both shoulders (eq. 64).
#[inline(always)]
fn wrapped(
    columns: &[JointColumn; 7],
    angle: &[[f64; BRANCHES]; 6],
    status: [u64; BRANCHES],
    q7: f64,
) -> RegularSlots<7, SLOTS> {
    let mut slots = RegularSlots::NEW;
    let given = columns[6].limited(q7);
    for lane in 0..BRANCHES {
        let flipped = lane + BRANCHES;
        let (theta_1, theta_2, theta_3) =
            (angle[THETA_1][lane], angle[THETA_2][lane], angle[THETA_3][lane]);
        [slots.status[lane], slots.status[flipped]] = [status[lane] & given; 2];
        slots.wrap(lane, 0, theta_1, columns[0]);
        slots.wrap(lane, 1, theta_2, columns[1]);
        slots.wrap(lane, 2, theta_3, columns[2]);
        slots.wrap(flipped, 0, half_turn(theta_1), columns[0]);
        slots.wrap(flipped, 1, -theta_2, columns[1]);
        slots.wrap(flipped, 2, half_turn(theta_3), columns[2]);
        for slot in [lane, flipped] {
            slots.wrap(slot, 3, angle[THETA_4][lane], columns[3]);
            slots.wrap(slot, 4, angle[THETA_5][lane], columns[4]);
            slots.wrap(slot, 5, angle[THETA_6][lane], columns[5]);
            slots.q[6][slot] = q7;
        }
    }
    slots
}
