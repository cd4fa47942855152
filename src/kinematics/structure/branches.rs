//! The joint vectors of a pose as a structure computes them: without limits, in their slots.

use crate::kinematics::answer::slot::Slot;
use crate::kinematics::answer::solutions::{Place, Solution};
use crate::kinematics::answer::status::Status;
use crate::kinematics::chain::limits::JointLimits;
use crate::report::{FreeJoint, Reach};

/// The joint vectors of a pose, in the `S` slots of a structure.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Branches<const N: usize, const S: usize = 8> {
    pub(crate) q: [Option<[f64; N]>; S],
    /// Singularities of each slot's branch, and MERGED if another slot holds its solution.
    pub(crate) flags: [Status; S],
    /// The joint that the pose leaves undetermined in each slot.
    pub(crate) free: [Option<FreeJoint>; S],
    pub(crate) reach: Reach,
    /// Whether these are certain to be all.
    pub(crate) is_certified: bool,
    /// How far beyond reach the stretched or folded arm in each slot is [m].
    pub(crate) beyond: [f64; S],
}

impl<const N: usize, const S: usize> Branches<N, S> {
    pub(crate) fn empty(reach: Reach) -> Self {
        Self {
            q: [None; S],
            flags: [Status::empty(); S],
            free: [None; S],
            reach,
            is_certified: true,
            beyond: [0.0; S],
        }
    }

    /// Whether a slot holds a solution or is merged into another.
    pub(crate) fn exists(&self, slot: usize) -> bool {
        self.q[slot].is_some() || self.flags[slot].contains(Status::MERGED)
    }

    /// The content of a slot of the answer: the joint vector wrapped into the limits.
    #[inline]
    pub(crate) fn place(&self, slot: usize, limits: &JointLimits<N>, locked: f64) -> Place<N> {
        let (flags, free) = (self.flags[slot], self.free[slot]);
        let Some(q) = self.q[slot] else {
            return if flags.contains(Status::MERGED) {
                Place::Merged(flags)
            } else {
                Place::Empty
            };
        };
        let mut q = limits.wrap(q);
        // A locked joint 7 keeps its angle.
        if N > 6 {
            q[6] = locked;
        }
        let mut status = flags | Status::FOUND;
        status.set(Status::WITHIN_LIMITS, limits.contains(&q));
        Place::Found(Solution { q, slot: Slot::new(slot), status, free_joint: free })
    }

    /// Merge the shoulders: the wrist center is on axis 1, or on the edge of the cylinder about it,
    /// so that a branch of both shoulders is the same, rotated. With `free`, q1 is undetermined.
    pub(crate) fn merge_shoulders(&mut self, keep_behind: bool, free: bool) {
        for front in 0..S / 2 {
            let behind = front + S / 2;
            // Of two branches that differ by twice the distance from axis 1, one may be straight
            // and the other bent by the root of that: the straight one reports the singularity.
            let straight = |slot: usize| self.flags[slot].contains(Status::ELBOW);
            let keep_behind =
                if straight(front) == straight(behind) { keep_behind } else { straight(behind) };
            let (kept, turned) = if keep_behind { (behind, front) } else { (front, behind) };
            let (kept, turned) = if self.exists(kept) { (kept, turned) } else { (turned, kept) };
            if !self.exists(kept) {
                continue;
            }
            self.flags[kept] |= Status::SHOULDER;
            if free {
                self.free[kept] = self.free[kept].or(Some(FreeJoint::Base));
            }
            (self.q[turned], self.free[turned]) = (None, self.free[kept]);
            self.flags[turned] = self.flags[kept] | Status::MERGED;
        }
    }
}
