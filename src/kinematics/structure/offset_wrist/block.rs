//! Regular poses in lanes: one, and a block of them.

use super::SLOTS;
use super::geometry::Constants;
use super::regular::{Eight, One, Solved};
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::lanes::{
    AnswerRow, Block, Columns, FOUND_INSIDE, LaneKernel, Poses, RegularSlots, SlotColumns,
    StatusRow,
};
use crate::lanes::{Column, Flags, LANES};

impl LaneKernel<6, SLOTS> for Constants {
    const DIFFERENCES: &'static [usize] = &[];
    const WIDE: bool = false;

    type Redundancy = ();
    type Regular = RegularSlots<6, SLOTS>;
    type Block = OffsetBlock;

    /// A regular pose leaves nothing to choose.
    fn for_path(self) -> Option<Self> {
        Some(self)
    }

    #[inline(always)]
    fn solve_one<const FUSED: bool>(
        &self,
        columns: &Columns<6>,
        t_first_last: &Frame,
        (): (),
    ) -> Option<RegularSlots<6, SLOTS>> {
        if self.lengths.is_parallel_at(t_first_last) {
            return None;
        }
        let mut one = One::NEW;
        let solved = one.solve(self, &[*t_first_last]).first()?;
        if !solved.is_regular || solved.as_slice().is_empty() {
            return None;
        }
        let mut slots = RegularSlots::NEW;
        for (slot, theta) in solved.as_slice().iter().enumerate() {
            slots.status[slot] = FOUND_INSIDE;
            for joint in 0..6 {
                slots.wrap(slot, joint, theta[joint], columns.joints[joint]);
            }
        }
        Some(slots)
    }
}

/// A block of poses with their solutions.
pub(crate) struct OffsetBlock {
    regular: Eight,
    slots: SlotColumns<6, SLOTS>,
}

impl Block<Constants, 6, SLOTS> for OffsetBlock {
    const NEW: Self = Self { regular: Eight::NEW, slots: SlotColumns::NEW };

    #[inline(always)]
    fn solve<const FUSED: bool>(
        &mut self,
        kernel: &Constants,
        columns: &Columns<6>,
        poses: &mut Poses,
        (): (),
    ) -> Flags {
        let (frames, count, places) = different(kernel, poses);
        let solved = self.regular.solve(kernel, &frames[..count]);
        let mut regular = [0; LANES];
        for (lane, place) in places.into_iter().enumerate() {
            let solved = place.map(|place: usize| &solved[place]);
            regular[lane] = u64::from(solved.is_some_and(|solved| solved.is_regular));
            let mut all = solved.map_or(&[][..], Solved::as_slice).iter();
            for slot in 0..SLOTS {
                let theta = all.next();
                self.slots.status[slot][lane] = if theta.is_some() { FOUND_INSIDE } else { 0 };
                let theta = theta.unwrap_or(&[f64::NAN; 6]);
                for joint in 0..6 {
                    self.slots.q[joint][slot][lane] = theta[joint];
                }
            }
        }
        self.slots.wrap(&columns.joints);
        regular
    }

    #[inline(never)]
    fn write(&self, q: &mut [AnswerRow<6, SLOTS>; LANES], status: &mut [StatusRow<SLOTS>; LANES]) {
        self.slots.write(q, status);
    }

    #[inline(always)]
    fn angles(&self, slot: usize, joint: usize) -> &Column {
        &self.slots.q[joint][slot]
    }

    #[inline(always)]
    fn status(&self, slot: usize) -> &Flags {
        &self.slots.status[slot]
    }
}

/// The poses of a block that may be regular, those that repeat the one before left out; how many
/// there are, and which of them each lane has.
fn different(
    constants: &Constants,
    poses: &Poses,
) -> ([Frame; LANES], usize, [Option<usize>; LANES]) {
    let (mut frames, mut count, mut places) = ([Frame::IDENTITY; LANES], 0, [None; LANES]);
    for (lane, place) in places.iter_mut().enumerate() {
        let frame = poses.frame(lane);
        if constants.lengths.is_parallel_at(&frame) {
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
