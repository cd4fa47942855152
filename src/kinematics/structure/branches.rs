//! The joint vectors of a pose as a closed form gives them: without limits, in their slots.

use crate::kinematics::answer::solutions::{FreeJoint, SLOTS};
use crate::kinematics::answer::status::{Reach, Status};
use crate::kinematics::pose::angles::resized;

/// The joint vectors of a pose, in their slots.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Branches<const N: usize> {
    pub(crate) q: [Option<[f64; N]>; SLOTS],
    /// Singularities of each slot's branch, and MERGED where the slot gave its solution to another.
    pub(crate) flags: [Status; SLOTS],
    /// The joint that the pose leaves free in each slot.
    pub(crate) free: [Option<FreeJoint>; SLOTS],
    pub(crate) reach: Reach,
}

impl<const N: usize> Branches<N> {
    pub(crate) fn empty(reach: Reach) -> Self {
        Self { q: [None; SLOTS], flags: [Status::empty(); SLOTS], free: [None; SLOTS], reach }
    }

    /// Whether a slot holds a solution or gave it to another.
    pub(crate) fn exists(&self, slot: usize) -> bool {
        self.q[slot].is_some() || self.flags[slot].contains(Status::MERGED)
    }

    /// The wrist centre is on axis 1, or on the edge of the cylinder about it: a branch that both shoulders have is one, turned. With
    /// `free`, q1 is free.
    pub(crate) fn merge_shoulders(&mut self, keep_behind: bool, free: bool) {
        for front in 0..SLOTS / 2 {
            let behind = front + SLOTS / 2;
            // Of two that differ by twice the distance from axis 1, one may be straight and the other bent by the root of that: the
            // straight one is the branch that declares its singularity.
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

    /// The same branches of an arm of `M` joints, which the caller knows to be as many.
    pub(crate) fn resized<const M: usize>(&self) -> Branches<M> {
        let Self { q, flags, free, reach } = *self;
        Branches { q: q.map(|q| q.map(|q| resized(&q))), flags, free, reach }
    }
}
