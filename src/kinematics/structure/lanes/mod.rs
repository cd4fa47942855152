//! Poses in lanes: a block of rows in, the slots of each out, whatever the form of the arm.

mod columns;
mod directions;
mod poses;
mod slots;

pub(crate) use columns::JointColumn;
pub(crate) use directions::{Direction, Directions};
pub(crate) use poses::{PoseRow, Poses};
pub(crate) use slots::{PlainSlots, SlotColumns};

use crate::kinematics::answer::solutions::SLOTS;
use crate::kinematics::answer::status::Status;
use crate::lanes::{Column, Kernel, LANES};

/// The joint angles and the status of the slots of a pose.
pub(crate) type AnswerRow<const N: usize> = [[f64; N]; SLOTS];
pub(crate) type StatusRow = [u8; SLOTS];

pub(crate) const FOUND_INSIDE: u64 = Status::FOUND.union(Status::WITHIN_LIMITS).bits() as u64;

/// An arm that solves blocks of poses.
pub(crate) trait BlockSolver<const N: usize> {
    /// What becomes of a block of poses.
    type Block: Block<N, Solver = Self>;

    /// Whether lanes do all that is asked of the joints.
    fn in_lanes(&self) -> bool;
}

/// What becomes of a block of poses.
pub(crate) trait Block<const N: usize> {
    /// The arm that solves it.
    type Solver;

    /// Room for a block.
    const NEW: Self;

    /// Solves poses; of an arm of seven joints, with the angle of joint 7 `given` for each.
    fn solve<const FUSED: bool>(
        &mut self,
        solver: &Self::Solver,
        poses: &mut Poses,
        given: &Column,
    );

    /// Writes them as rows.
    fn write(&self, q: &mut [AnswerRow<N>; LANES], status: &mut [StatusRow; LANES]);

    /// Whether what was written is all there is to say of a pose.
    fn is_plain(&self, lane: usize) -> bool;
}

/// Rows to be solved; `careful` solves one by itself, by its number.
pub(crate) struct Blocks<'a, S, F, const N: usize> {
    pub(crate) solver: &'a S,
    pub(crate) poses: &'a [PoseRow],
    /// Joint 7 of each pose; nothing for an arm of six joints.
    pub(crate) given: &'a [f64],
    pub(crate) q: &'a mut [AnswerRow<N>],
    pub(crate) status: &'a mut [StatusRow],
    pub(crate) careful: F,
}

impl<S: BlockSolver<N>, F: FnMut(usize, &mut AnswerRow<N>, &mut StatusRow), const N: usize> Kernel
    for Blocks<'_, S, F, N>
{
    type Answer = ();
    const WIDE: bool = true;

    #[inline(always)]
    fn run<const FUSED: bool>(mut self) {
        if !self.solver.in_lanes() {
            for (row, (q, status)) in self.q.iter_mut().zip(self.status).enumerate() {
                (self.careful)(row, q, status);
            }
            return;
        }
        let (blocks, rest) = self.poses.as_chunks::<LANES>();
        let (q_blocks, q_rest) = self.q.as_chunks_mut::<LANES>();
        let (status_blocks, status_rest) = self.status.as_chunks_mut::<LANES>();
        let (mut block, mut next) = (S::Block::NEW, Poses::NEW);
        if let Some(first) = blocks.first() {
            next.read(first);
        }
        for (i, (q, status)) in q_blocks.iter_mut().zip(status_blocks).enumerate() {
            let mut poses = next;
            // Read before the block at hand is solved: what is written number by number cannot be read at once in vectors.
            if let Some(following) = blocks.get(i + 1) {
                next.read(following);
            }
            block.solve::<FUSED>(self.solver, &mut poses, &column(self.given, i));
            block.write(q, status);
            for lane in (0..LANES).filter(|lane| !block.is_plain(*lane)) {
                (self.careful)(LANES * i + lane, &mut q[lane], &mut status[lane]);
            }
        }
        if let Some(last) = rest.last() {
            let mut rows = [*last; LANES];
            rows[..rest.len()].copy_from_slice(rest);
            next.read(&rows);
            block.solve::<FUSED>(self.solver, &mut next, &column(self.given, blocks.len()));
            let (mut q, mut status) = ([[[0.0; N]; SLOTS]; LANES], [[0; SLOTS]; LANES]);
            block.write(&mut q, &mut status);
            for lane in (0..rest.len()).filter(|lane| !block.is_plain(*lane)) {
                (self.careful)(LANES * blocks.len() + lane, &mut q[lane], &mut status[lane]);
            }
            q_rest.copy_from_slice(&q[..rest.len()]);
            status_rest.copy_from_slice(&status[..rest.len()]);
        }
    }
}

/// The numbers of a block; zeros behind the last.
#[inline(always)]
fn column(numbers: &[f64], block: usize) -> Column {
    let mut column = [0.0; LANES];
    for (to, from) in column.iter_mut().zip(numbers.iter().skip(LANES * block)) {
        *to = *from;
    }
    column
}

/// The angle half a turn on.
#[inline(always)]
pub(crate) fn half_turn(angle: f64) -> f64 {
    angle + if angle > 0.0 { -core::f64::consts::PI } else { core::f64::consts::PI }
}
