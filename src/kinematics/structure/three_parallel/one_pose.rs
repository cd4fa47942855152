//! One pose in lanes: its eight slots side by side.

use super::block::{ParallelBlock, SLOTS};
use super::branch::{Constants, branch, facing};
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::lanes::{
    Columns, Directions, FOUND_INSIDE, LaneKernel, RegularSlots, half_turn,
};

const SHOULDER: [f64; SLOTS] = [1.0, 1.0, 1.0, 1.0, -1.0, -1.0, -1.0, -1.0];
const ELBOW: [f64; SLOTS] = [1.0, 1.0, -1.0, -1.0, 1.0, 1.0, -1.0, -1.0];
const WRIST: [f64; SLOTS] = [1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0, -1.0];

/// Columns of the directions.
const THETA_1: usize = 0;
const THETA_2: usize = 1;
const THETA_23: usize = 2;
const PHI: usize = 3;
const THETA_5: usize = 4;
const THETA_6: usize = 5;

impl LaneKernel<6, SLOTS> for Constants {
    const DIFFERENCES: &'static [usize] = &[2, 3];

    type Regular = RegularSlots<6, SLOTS>;
    type Block = ParallelBlock;

    fn for_path(&self) -> Option<Self> {
        Some(self.on_path())
    }

    #[inline(always)]
    fn solve_one<const FUSED: bool>(
        &self,
        columns: &Columns<6>,
        t_shoulder_wrist: &Frame,
        _: f64,
    ) -> Option<RegularSlots<6, SLOTS>> {
        let (constants, columns, frame) = (*self, columns.joints, *t_shoulder_wrist);
        let wz = frame.origin[2];
        let (mut directions, mut slots, mut regular) =
            (Directions::<6, SLOTS>::NEW, RegularSlots::NEW, [0; SLOTS]);
        for slot in 0..SLOTS {
            let facing = facing::<FUSED>(&constants, &frame, SHOULDER[slot]);
            let branch = branch::<FUSED>(&constants, &facing, wz, WRIST[slot], ELBOW[slot]);
            directions.set(THETA_1, slot, facing.theta_1);
            directions.set(THETA_2, slot, branch.theta_2);
            directions.set(THETA_23, slot, branch.theta_23);
            directions.set(PHI, slot, facing.phi);
            directions.set(THETA_5, slot, facing.theta_5);
            directions.set(THETA_6, slot, facing.theta_6);
            slots.status[slot] = if branch.reached { FOUND_INSIDE } else { 0 };
            regular[slot] = u64::from(branch.regular);
        }
        if regular != [1; SLOTS] || slots.status == [0; SLOTS] {
            return None;
        }
        directions.angles::<FUSED>();
        let angle = &directions.angle;
        for slot in 0..SLOTS {
            let flipped = WRIST[slot] < 0.0;
            let (theta_2, theta_23) = (angle[THETA_2][slot], angle[THETA_23][slot]);
            let (phi, theta_6) = (angle[PHI][slot], angle[THETA_6][slot]);
            let phi = if flipped { half_turn(phi) } else { phi };
            slots.wrap(slot, 0, angle[THETA_1][slot], columns[0]);
            slots.wrap(slot, 1, theta_2, columns[1]);
            slots.wrap(slot, 2, theta_23 - theta_2, columns[2]);
            slots.wrap(slot, 3, phi - theta_23, columns[3]);
            slots.wrap(slot, 4, WRIST[slot] * angle[THETA_5][slot], columns[4]);
            slots.wrap(slot, 5, if flipped { half_turn(theta_6) } else { theta_6 }, columns[5]);
        }
        Some(slots)
    }
}
