//! Every solution of a pose: seeds from the roots of the resultant, brought to the pose by the
//! closure of the chain.
//!
//! Docs: offset_wrist.md, section 5.

use super::geometry::OffsetWrist;
use super::seeds::{Seeds, seeds};
use crate::kinematics::structure::closure::{Accepted, Candidates, Closure, Target};
use crate::kinematics::structure::end_frames::Frame;
use crate::lanes::LANES;

/// The solutions of a pose.
pub(super) struct Found {
    pub(super) accepted: Accepted,
    /// Whether they are all, by the number of roots.
    pub(super) is_certified: bool,
}

impl OffsetWrist {
    /// Every solution for a frame 6 in the shoulder frame, by its angles theta.
    pub(super) fn find<const FUSED: bool>(&self, last: &Frame) -> Found {
        let target = self.closure.target(last);
        let mut accepted = Accepted::NONE;
        let mut seeds = seeds::<FUSED>(self, last);
        converge::<FUSED>(&self.closure, &target, &seeds, &mut accepted);
        if !seeds.agrees(&accepted) {
            seeds.examine_all(self, last);
            converge::<FUSED>(&self.closure, &target, &seeds, &mut accepted);
        }
        Found { is_certified: seeds.agrees(&accepted), accepted }
    }
}

/// Brings the seeds to the target, eight at once.
fn converge<const FUSED: bool>(
    closure: &Closure,
    target: &Target,
    seeds: &Seeds,
    accepted: &mut Accepted,
) {
    for block in seeds.as_slice().chunks(LANES) {
        let mut candidates = Candidates::NEW;
        for (lane, seed) in block.iter().enumerate() {
            candidates.put(lane, seed);
        }
        closure.converge::<FUSED>(target, &mut candidates);
        accepted.take(closure, target, &candidates, block.len());
    }
}
