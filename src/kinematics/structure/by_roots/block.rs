//! Regular poses in lanes: one, and a block of them.

use core::slice;

use super::method::{ByRoots, SLOTS};
use super::regular::solve;
use super::solved::Solved;
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::lanes::{
    AnswerRow, Block, BlockSlots, Columns, LaneKernel, Poses, StatusRow,
};
use crate::lanes::{Column, Flags, LANES};

/// A way to the solutions at roots, as a kernel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RootKernel<M>(pub(crate) M);

impl<M: ByRoots> LaneKernel<6, SLOTS> for RootKernel<M> {
    const DIFFERENCES: &'static [usize] = &[];
    const WIDE: bool = false;

    type Regular = Solved;
    type Block = RegularBlock;

    /// A regular pose leaves nothing to choose.
    fn for_path(&self) -> Option<Self> {
        Some(self.clone())
    }

    #[inline(always)]
    fn solve_one<const FUSED: bool>(
        &self,
        columns: &Columns<6>,
        t_first_last: &Frame,
        _: f64,
    ) -> Option<Solved> {
        let Self(method) = self;
        let mut solved = Solved::NEW;
        if !method.is_beyond(t_first_last) {
            solve(method, &columns.row, &[*t_first_last], slice::from_mut(&mut solved));
            if !solved.is_regular {
                return None;
            }
        }
        if solved.q.is_empty() {
            solved.missed = Some(method.reach(t_first_last));
        }
        Some(solved)
    }
}

/// A block of poses with their solutions.
pub(crate) struct RegularBlock {
    solved: [Solved; LANES],
    /// Which of these each lane has; none out of reach.
    places: [Option<usize>; LANES],
}

impl<M: ByRoots> Block<RootKernel<M>, 6, SLOTS> for RegularBlock {
    type Slots = Self;

    const NEW: Self = Self { solved: [Solved::NEW; LANES], places: [None; LANES] };

    #[inline(always)]
    fn solve<const FUSED: bool>(
        &mut self,
        RootKernel(method): &RootKernel<M>,
        columns: &Columns<6>,
        poses: &mut Poses,
        _: Column,
    ) -> Flags {
        let (frames, count, places) = different(method, poses);
        solve(method, &columns.row, &frames[..count], &mut self.solved[..count]);
        self.places = places;
        let mut are_regular = [0; LANES];
        for (lane, is_regular) in are_regular.iter_mut().enumerate() {
            *is_regular = u64::from(self.of(lane).is_none_or(|solved| solved.is_regular));
        }
        are_regular
    }

    #[inline(always)]
    fn slots(&self) -> &Self {
        self
    }
}

impl RegularBlock {
    #[inline(always)]
    fn of(&self, lane: usize) -> Option<&Solved> {
        self.places[lane].map(|place| &self.solved[place])
    }
}

impl BlockSlots<6, SLOTS> for RegularBlock {
    fn write(&self, q: &mut [AnswerRow<6, SLOTS>; LANES], status: &mut [StatusRow<SLOTS>; LANES]) {
        for (lane, (q, status)) in q.iter_mut().zip(status).enumerate() {
            let (all, flags) =
                self.of(lane).map_or((&[][..], &[][..]), |Solved { q, status, .. }| (q, status));
            let (filled, rest) = q.split_at_mut(all.len());
            filled.copy_from_slice(all);
            rest.fill([f64::NAN; 6]);
            let (filled, rest) = status.split_at_mut(flags.len());
            filled.copy_from_slice(flags);
            rest.fill(0);
        }
    }

    #[inline(always)]
    fn used(&self) -> usize {
        let used = |lane| self.of(lane).map_or(0, |solved| solved.q.len());
        (0..LANES).map(used).max().unwrap_or(0)
    }

    #[inline(always)]
    fn angles(&self, slot: usize, joint: usize) -> Column {
        let mut angles = [f64::NAN; LANES];
        for (lane, angle) in angles.iter_mut().enumerate() {
            if let Some(q) = self.of(lane).and_then(|solved| solved.q.get(slot)) {
                *angle = q[joint];
            }
        }
        angles
    }

    #[inline(always)]
    fn status(&self, slot: usize) -> Flags {
        let mut flags = [0; LANES];
        for (lane, flags) in flags.iter_mut().enumerate() {
            if let Some(status) = self.of(lane).and_then(|solved| solved.status.get(slot)) {
                *flags = u64::from(*status);
            }
        }
        flags
    }
}

/// The poses of a block that may be in reach, those that repeat the one before left out; how many
/// there are, and which of them each lane has.
fn different(
    method: &impl ByRoots,
    poses: &Poses,
) -> ([Frame; LANES], usize, [Option<usize>; LANES]) {
    let (mut frames, mut count, mut places) = ([Frame::IDENTITY; LANES], 0, [None; LANES]);
    for (lane, place) in places.iter_mut().enumerate() {
        let frame = poses.frame(lane);
        if method.is_beyond(&frame) {
            continue;
        }
        if count == 0 || frames[count - 1] != frame {
            frames[count] = frame;
            count += 1;
        }
        *place = Some(count - 1);
    }
    (frames, count, places)
}
