//! Passes rows of poses through a kernel, one block of lanes at a time.

use super::{AnswerRow, Columns, LaneKernel, PoseRow, Poses, StatusRow};
use crate::kinematics::structure::end_frames::Seen;
use crate::kinematics::structure::redundancy::Redundancy;
use crate::lanes::{Flags, Kernel, LANES};

/// A block of poses with its solutions.
pub(crate) trait Block<K: LaneKernel<N, S>, const N: usize, const S: usize> {
    /// Room for a block.
    const NEW: Self;

    /// Solve for the last frames of the structure in its first frame; return which are regular.
    /// Must be `#[inline(always)]`.
    fn solve<const FUSED: bool>(
        &mut self,
        kernel: &K,
        columns: &Columns<N>,
        frames: &mut Poses,
        redundancy: <K::Redundancy as Redundancy>::Lanes,
    ) -> Flags;

    /// Write the slots as rows.
    fn write(&self, q: &mut [AnswerRow<N, S>; LANES], status: &mut [StatusRow<S>; LANES]);
}

/// Rows to be solved; `by_itself` solves a row that is not regular, by index.
pub(crate) struct Blocks<'a, K: LaneKernel<N, S>, F, const N: usize, const S: usize> {
    pub(crate) kernel: &'a K,
    pub(crate) columns: &'a Columns<N>,
    pub(crate) seen: Seen,
    pub(crate) poses: &'a [PoseRow],
    pub(crate) redundancy: &'a [K::Redundancy],
    pub(crate) q: &'a mut [AnswerRow<N, S>],
    pub(crate) status: &'a mut [StatusRow<S>],
    pub(crate) by_itself: F,
}

impl<K, F, const N: usize, const S: usize> Kernel for Blocks<'_, K, F, N, S>
where
    K: LaneKernel<N, S>,
    F: FnMut(usize, &mut [[f64; N]], &mut [u8]),
{
    type Answer = ();
    const WIDE: bool = true;

    #[inline(always)]
    fn run<const FUSED: bool>(self) {
        let Self { kernel, columns, seen, poses, redundancy, q, status, mut by_itself } = self;
        let arm = Lanes { kernel, columns, seen, redundancy };
        let (blocks, rest) = poses.as_chunks::<LANES>();
        let (q_blocks, q_rest) = q.as_chunks_mut::<LANES>();
        let (status_blocks, status_rest) = status.as_chunks_mut::<LANES>();
        let (mut block, mut next) = (K::Block::NEW, Poses::NEW);
        if let Some(first) = blocks.first() {
            next.read(first);
        }
        for (i, (q, status)) in q_blocks.iter_mut().zip(status_blocks).enumerate() {
            let mut poses = next;
            // The next block is read before the current one is solved: numbers that were just
            // written one by one cannot be loaded as vectors at once.
            if let Some(following) = blocks.get(i + 1) {
                next.read(following);
            }
            let regular = arm.solve::<FUSED>(&mut block, &mut poses, i);
            block.write(q, status);
            for lane in (0..LANES).filter(|lane| regular[*lane] == 0) {
                by_itself(LANES * i + lane, &mut q[lane], &mut status[lane]);
            }
        }
        if let Some(last) = rest.last() {
            let mut rows = [*last; LANES];
            rows[..rest.len()].copy_from_slice(rest);
            next.read(&rows);
            let regular = arm.solve::<FUSED>(&mut block, &mut next, blocks.len());
            let (mut q, mut status) = ([[[0.0; N]; S]; LANES], [[0; S]; LANES]);
            block.write(&mut q, &mut status);
            for lane in (0..rest.len()).filter(|lane| regular[*lane] == 0) {
                by_itself(LANES * blocks.len() + lane, &mut q[lane], &mut status[lane]);
            }
            q_rest.copy_from_slice(&q[..rest.len()]);
            status_rest.copy_from_slice(&status[..rest.len()]);
        }
    }
}

/// The parameters of a block solve. A type, because a closure is not reliably inlined into a
/// kernel, and would then not be compiled for its instruction set.
struct Lanes<'a, K: LaneKernel<N, S>, const N: usize, const S: usize> {
    kernel: &'a K,
    columns: &'a Columns<N>,
    seen: Seen,
    redundancy: &'a [K::Redundancy],
}

impl<K: LaneKernel<N, S>, const N: usize, const S: usize> Lanes<'_, K, N, S> {
    /// Check and solve block number `number` of the poses; return which poses are regular.
    #[inline(always)]
    fn solve<const FUSED: bool>(
        &self,
        block: &mut K::Block,
        poses: &mut Poses,
        number: usize,
    ) -> Flags {
        let sound = poses.check();
        poses.seen_from_shoulder::<FUSED>(self.seen);
        let redundancy = K::Redundancy::lanes(self.redundancy, number);
        let mut regular = block.solve::<FUSED>(self.kernel, self.columns, poses, redundancy);
        for lane in 0..LANES {
            regular[lane] &= sound[lane];
        }
        regular
    }
}
