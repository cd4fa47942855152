//! One pose in lanes: its eight slots side by side.

use super::branch::{branch, facing};
use super::solver::ParallelSolver;
use crate::kinematics::answer::solutions::SLOTS;
use crate::kinematics::pose::Pose;
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::lanes::{Directions, FOUND_INSIDE, PlainSlots, half_turn};
use crate::lanes::Kernel;

/// A pose to be solved.
pub(crate) struct Single<'a> {
    pub(crate) solver: &'a ParallelSolver,
    pub(crate) pose: &'a Pose,
}

const SHOULDER: [f64; SLOTS] = [1.0, 1.0, 1.0, 1.0, -1.0, -1.0, -1.0, -1.0];
const ELBOW: [f64; SLOTS] = [1.0, 1.0, -1.0, -1.0, 1.0, 1.0, -1.0, -1.0];
const WRIST: [f64; SLOTS] = [1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0, -1.0];

impl Kernel for Single<'_> {
    /// Nothing where a branch is not plain, or none reaches: another way has to say more.
    type Answer = Option<PlainSlots<6>>;
    const WIDE: bool = true;

    #[inline(always)]
    fn run<const FUSED: bool>(self) -> Self::Answer {
        let Self { solver, pose } = self;
        let columns = *solver.columns.as_ref()?;
        let frame = solver.surroundings.seen.of::<FUSED>(&Frame::of(pose));
        let (constants, wz) = (solver.constants, frame.origin[2]);
        let (mut directions, mut slots, mut plain) =
            (Directions::<6, SLOTS>::NEW, PlainSlots::NEW, [0; SLOTS]);
        for slot in 0..SLOTS {
            let facing = facing::<FUSED>(&constants, &frame, SHOULDER[slot]);
            let branch = branch::<FUSED>(&constants, &facing, wz, WRIST[slot], ELBOW[slot]);
            directions.set(0, slot, facing.theta_1);
            directions.set(1, slot, branch.theta_2);
            directions.set(2, slot, branch.theta_23);
            directions.set(3, slot, facing.phi);
            directions.set(4, slot, facing.theta_5);
            directions.set(5, slot, facing.theta_6);
            slots.status[slot] = if branch.reached { FOUND_INSIDE } else { 0 };
            plain[slot] = u64::from(branch.plain);
        }
        if plain != [1; SLOTS] || slots.status == [0; SLOTS] {
            return None;
        }
        directions.angles::<FUSED>();
        let angle = &directions.angle;
        for slot in 0..SLOTS {
            let flipped = WRIST[slot] < 0.0;
            let (theta_2, theta_23, phi, theta_6) =
                (angle[1][slot], angle[2][slot], angle[3][slot], angle[5][slot]);
            slots.settle(slot, 0, angle[0][slot], columns[0]);
            slots.settle(slot, 1, theta_2, columns[1]);
            slots.settle(slot, 2, theta_23 - theta_2, columns[2]);
            slots.settle(
                slot,
                3,
                if flipped { half_turn(phi) } else { phi } - theta_23,
                columns[3],
            );
            slots.settle(slot, 4, WRIST[slot] * angle[4][slot], columns[4]);
            slots.settle(slot, 5, if flipped { half_turn(theta_6) } else { theta_6 }, columns[5]);
        }
        Some(slots)
    }
}
