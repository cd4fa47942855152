//! A block of poses in lanes.

use super::branch::{branch, facing};
use super::solver::ParallelSolver;
use crate::kinematics::answer::solutions::SLOTS;
use crate::kinematics::structure::lanes::{
    AnswerRow, Block, BlockSolver, Direction, Directions, FOUND_INSIDE, Poses, SlotColumns,
    StatusRow, half_turn,
};
use crate::lanes::{Column, Flags, LANES};

/// Directions whose angles a block needs: theta_1, theta_5, theta_6 and phi of each shoulder, theta_2 and theta_23 of each slot.
const DIRECTIONS: usize = 4 * 2 + 2 * SLOTS;

/// What becomes of a block of poses.
pub(crate) struct ParallelBlock {
    directions: Directions<DIRECTIONS, LANES>,
    slots: SlotColumns<6>,
    plain: Flags,
}

impl BlockSolver<6> for ParallelSolver {
    type Block = ParallelBlock;

    fn in_lanes(&self) -> bool {
        self.columns.is_some()
    }
}

impl Block<6> for ParallelBlock {
    type Solver = ParallelSolver;

    const NEW: Self =
        Self { directions: Directions::NEW, slots: SlotColumns::NEW, plain: [0; LANES] };

    #[inline(always)]
    fn solve<const FUSED: bool>(
        &mut self,
        solver: &ParallelSolver,
        poses: &mut Poses,
        _given: &Column,
    ) {
        let Some(columns) = &solver.columns else { return };
        self.plain = poses.check();
        poses.seen_from_shoulder::<FUSED>(solver.surroundings.seen);
        let constants = solver.constants;
        for lane in 0..LANES {
            let frame = poses.frame(lane);
            let wz = frame.origin[2];
            let (front, behind) = (
                facing::<FUSED>(&constants, &frame, 1.0),
                facing::<FUSED>(&constants, &frame, -1.0),
            );
            self.put_shoulder(lane, 0, [front.theta_1, front.theta_5, front.theta_6, front.phi]);
            self.put_shoulder(
                lane,
                1,
                [behind.theta_1, behind.theta_5, behind.theta_6, behind.phi],
            );
            self.put(lane, 0, &branch::<FUSED>(&constants, &front, wz, 1.0, 1.0));
            self.put(lane, 1, &branch::<FUSED>(&constants, &front, wz, -1.0, 1.0));
            self.put(lane, 2, &branch::<FUSED>(&constants, &front, wz, 1.0, -1.0));
            self.put(lane, 3, &branch::<FUSED>(&constants, &front, wz, -1.0, -1.0));
            self.put(lane, 4, &branch::<FUSED>(&constants, &behind, wz, 1.0, 1.0));
            self.put(lane, 5, &branch::<FUSED>(&constants, &behind, wz, -1.0, 1.0));
            self.put(lane, 6, &branch::<FUSED>(&constants, &behind, wz, 1.0, -1.0));
            self.put(lane, 7, &branch::<FUSED>(&constants, &behind, wz, -1.0, -1.0));
        }
        self.directions.angles::<FUSED>();
        self.thetas();
        self.slots.settle(columns);
    }

    #[inline(never)]
    fn write(&self, q: &mut [AnswerRow<6>; LANES], status: &mut [StatusRow; LANES]) {
        self.slots.write(q, status);
    }

    fn is_plain(&self, lane: usize) -> bool {
        self.plain[lane] != 0
    }
}

impl ParallelBlock {
    #[inline(always)]
    fn put_shoulder(
        &mut self,
        lane: usize,
        shoulder: usize,
        [theta_1, theta_5, theta_6, phi]: [Direction; 4],
    ) {
        self.directions.set(shoulder, lane, theta_1);
        self.directions.set(2 + shoulder, lane, theta_5);
        self.directions.set(4 + shoulder, lane, theta_6);
        self.directions.set(6 + shoulder, lane, phi);
    }

    #[inline(always)]
    fn put(&mut self, lane: usize, slot: usize, branch: &super::branch::Branch) {
        self.directions.set(8 + slot, lane, branch.theta_2);
        self.directions.set(8 + SLOTS + slot, lane, branch.theta_23);
        self.slots.status[slot][lane] = if branch.reached { FOUND_INSIDE } else { 0 };
        self.plain[lane] &= u64::from(branch.plain);
    }

    /// theta of every slot (eq. 40). Where an arm does not reach, none is a number.
    #[inline(always)]
    fn thetas(&mut self) {
        let (angle, q) = (&self.directions.angle, &mut self.slots.q);
        for slot in 0..SLOTS {
            let (shoulder, flipped) = (slot / 4, slot % 2 == 1);
            for lane in 0..LANES {
                let (theta_5, theta_6, phi) = (
                    angle[2 + shoulder][lane],
                    angle[4 + shoulder][lane],
                    angle[6 + shoulder][lane],
                );
                let (theta_2, theta_23) = (angle[8 + slot][lane], angle[8 + SLOTS + slot][lane]);
                let missing = 0.0 * theta_2;
                q[0][slot][lane] = angle[shoulder][lane] + missing;
                q[1][slot][lane] = theta_2;
                q[2][slot][lane] = theta_23 - theta_2;
                q[3][slot][lane] = if flipped { half_turn(phi) } else { phi } - theta_23;
                q[4][slot][lane] = if flipped { -theta_5 } else { theta_5 } + missing;
                q[5][slot][lane] = if flipped { half_turn(theta_6) } else { theta_6 } + missing;
            }
        }
    }
}
