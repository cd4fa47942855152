//! Regular poses in lanes: one, and a block of them.

use super::method::{ByRoots, SLOTS};
use super::regular::{Regular, Solved};
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::lanes::{
    Block, Columns, FOUND_INSIDE, LaneKernel, Poses, RegularSlots, SlotColumns,
};
use crate::lanes::{Flags, LANES};

/// A way to the solutions at roots, as a kernel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RootKernel<M>(pub(crate) M);

impl<M: ByRoots> LaneKernel<6, SLOTS> for RootKernel<M> {
    const DIFFERENCES: &'static [usize] = &[];
    const WIDE: bool = false;

    type Redundancy = ();
    type Regular = RegularSlots<6, SLOTS>;
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
        (): (),
    ) -> Option<RegularSlots<6, SLOTS>> {
        let Self(method) = self;
        if !method.may_be_regular(t_first_last) {
            return None;
        }
        let mut regular = Regular::new();
        let solved = regular.solve(method, &[*t_first_last]).first()?;
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
pub(crate) struct RegularBlock {
    slots: SlotColumns<6, SLOTS>,
}

impl<M: ByRoots> Block<RootKernel<M>, 6, SLOTS> for RegularBlock {
    type Slots = SlotColumns<6, SLOTS>;

    const NEW: Self = Self { slots: SlotColumns::NEW };

    #[inline(always)]
    fn solve<const FUSED: bool>(
        &mut self,
        RootKernel(method): &RootKernel<M>,
        columns: &Columns<6>,
        poses: &mut Poses,
        (): (),
    ) -> Flags {
        let (frames, count, places) = different(method, poses);
        let mut regular = Regular::new();
        let solved = regular.solve(method, &frames[..count]);
        let mut are_regular = [0; LANES];
        for (lane, place) in places.into_iter().enumerate() {
            let solved = place.map(|place: usize| &solved[place]);
            are_regular[lane] = u64::from(solved.is_some_and(|solved| solved.is_regular));
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
        are_regular
    }

    #[inline(always)]
    fn slots(&self) -> &SlotColumns<6, SLOTS> {
        &self.slots
    }
}

/// The poses of a block that may be regular, those that repeat the one before left out; how many
/// there are, and which of them each lane has.
fn different(
    method: &impl ByRoots,
    poses: &Poses,
) -> ([Frame; LANES], usize, [Option<usize>; LANES]) {
    let (mut frames, mut count, mut places) = ([Frame::IDENTITY; LANES], 0, [None; LANES]);
    for (lane, place) in places.iter_mut().enumerate() {
        let frame = poses.frame(lane);
        if !method.may_be_regular(&frame) {
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
