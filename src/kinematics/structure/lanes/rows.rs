//! Rows of poses through a kernel, a block of lanes at a time.

use super::{AnswerRow, Block, BlockSlots, Choice, Columns, LaneKernel, PoseRow, Poses, StatusRow};
use crate::kinematics::structure::end_frames::Seen;
use crate::lanes::{Column, Flags, Kernel, LANES};

/// The solutions of rows to write.
pub(crate) enum Wanted<'a, const N: usize, const S: usize> {
    /// All of them, each in its slot.
    Slots { q: &'a mut [AnswerRow<N, S>], status: &'a mut [StatusRow<S>] },
    /// The one nearest to a seed.
    Nearest { choice: Choice<N>, seeds: &'a [[f64; N]], q: &'a mut [[f64; N]] },
}

/// Rows to be solved; `by_itself` solves one that is not regular, by its number.
pub(crate) struct Blocks<'a, K: LaneKernel<N, S>, F, const N: usize, const S: usize> {
    pub(crate) kernel: &'a K,
    pub(crate) columns: &'a Columns<N>,
    pub(crate) seen: Seen,
    pub(crate) poses: &'a [PoseRow],
    pub(crate) locked: &'a [f64],
    pub(crate) wanted: Wanted<'a, N, S>,
    pub(crate) by_itself: F,
}

impl<K, F, const N: usize, const S: usize> Kernel for Blocks<'_, K, F, N, S>
where
    K: LaneKernel<N, S>,
    F: FnMut(usize, &mut [[f64; N]], &mut [u8]),
{
    type Answer = ();
    const WIDE: bool = K::WIDE;

    #[inline(always)]
    fn run<const FUSED: bool>(self) {
        let Self { kernel, columns, seen, poses, locked, mut wanted, mut by_itself } = self;
        let arm = Lanes { kernel, columns, seen, locked };
        let (blocks, rest) = poses.as_chunks::<LANES>();
        let (mut block, mut next) = (K::Block::NEW, Poses::NEW);
        let mut rows = [[0.0; 16]; LANES];
        if let Some(last) = rest.last() {
            rows = [*last; LANES];
            rows[..rest.len()].copy_from_slice(rest);
        }
        if let Some(first) = blocks.first().or((!rest.is_empty()).then_some(&rows)) {
            next.read(first);
        }
        for i in 0..poses.len().div_ceil(LANES) {
            let mut poses = next;
            // Read before the block at hand is solved: what is written number by number cannot be
            // read at once in vectors.
            if let Some(following) = blocks.get(i + 1) {
                next.read(following);
            } else if i + 1 == blocks.len() && !rest.is_empty() {
                next.read(&rows);
            }
            let regular = arm.solve::<FUSED>(&mut block, &mut poses, i);
            wanted.write::<K>(&block, i, regular, &mut by_itself);
        }
    }
}

impl<const N: usize, const S: usize> Wanted<'_, N, S> {
    /// Writes the rows of block `number`, of which those at the end may be missing.
    #[inline(always)]
    fn write<K: LaneKernel<N, S>>(
        &mut self,
        block: &K::Block,
        number: usize,
        regular: Flags,
        by_itself: &mut impl FnMut(usize, &mut [[f64; N]], &mut [u8]),
    ) {
        let first = LANES * number;
        match self {
            Self::Slots { q, status } => {
                let (q, status) = (&mut q[first..], &mut status[first..]);
                match (q.first_chunk_mut::<LANES>(), status.first_chunk_mut::<LANES>()) {
                    (Some(q), Some(status)) => block.slots().write(q, status),
                    _ => write_some::<K, N, S>(block, q, status),
                }
                let rows = q.iter_mut().zip(status).zip(regular).enumerate();
                for (lane, ((q, status), _)) in rows.filter(|(_, (_, regular))| *regular == 0) {
                    by_itself(first + lane, q, status);
                }
            }
            Self::Nearest { choice, seeds, q } => {
                let (seeds, q) = (&seeds[first..], &mut q[first..]);
                let count = seeds.len().min(LANES);
                let (mut those, mut nearest) = ([[0.0; N]; LANES], [[0.0; N]; LANES]);
                those[..count].copy_from_slice(&seeds[..count]);
                let certain = choice.nearest(block.slots(), &those, &mut nearest);
                for (lane, q) in q.iter_mut().take(LANES).enumerate() {
                    if regular[lane] & certain[lane] == 0 {
                        by_itself(first + lane, core::slice::from_mut(q), &mut []);
                    } else {
                        *q = nearest[lane];
                    }
                }
            }
        }
    }
}

/// Writes the first rows of a block, as many as there is room for.
#[cold]
fn write_some<K: LaneKernel<N, S>, const N: usize, const S: usize>(
    block: &K::Block,
    q: &mut [AnswerRow<N, S>],
    status: &mut [StatusRow<S>],
) {
    let (mut all, mut flags) = ([[[0.0; N]; S]; LANES], [[0; S]; LANES]);
    block.slots().write(&mut all, &mut flags);
    q.copy_from_slice(&all[..q.len()]);
    status.copy_from_slice(&flags[..status.len()]);
}

/// The means to solve a block. A type, because a closure is not inlined into a kernel for certain,
/// and then not compiled for its instructions.
struct Lanes<'a, K: LaneKernel<N, S>, const N: usize, const S: usize> {
    kernel: &'a K,
    columns: &'a Columns<N>,
    seen: Seen,
    locked: &'a [f64],
}

impl<K: LaneKernel<N, S>, const N: usize, const S: usize> Lanes<'_, K, N, S> {
    /// Checks block number `number` of the poses and solves it; returns which poses are regular.
    #[inline(always)]
    fn solve<const FUSED: bool>(
        &self,
        block: &mut K::Block,
        poses: &mut Poses,
        number: usize,
    ) -> Flags {
        let sound = poses.check();
        poses.seen_from_shoulder::<FUSED>(self.seen);
        let locked = column_of(self.locked, number);
        let mut regular = block.solve::<FUSED>(self.kernel, self.columns, poses, locked);
        for lane in 0..LANES {
            regular[lane] &= sound[lane];
        }
        regular
    }
}

/// The numbers of a block, of one for each pose; zeros where there are none.
#[inline(always)]
fn column_of(rows: &[f64], block: usize) -> Column {
    let mut column = [0.0; LANES];
    for (to, from) in column.iter_mut().zip(rows.iter().skip(LANES * block)) {
        *to = *from;
    }
    column
}
