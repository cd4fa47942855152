//! The answer of a solve: solutions, each in its slot.

use super::slot::{MOST_SLOTS, Slot, SlotStatus};
use super::status::{SingularityKind, Status};
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::pose::Pose;
use crate::report::{Explanation, FreeJoint, Reach};

/// One joint vector that brings the tool to the pose.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Solution<const N: usize> {
    /// Joint angles [rad], each in (-pi, pi] or its 2 pi equivalent inside the limits.
    #[cfg_attr(feature = "serde", serde(with = "serde_big_array::BigArray"))]
    pub q: [f64; N],
    /// The slot that the solution is in.
    pub slot: Slot,
    /// Found, inside the limits or not, and the singularities that the solution is at.
    pub status: Status,
    /// The joint that the pose leaves undetermined, at a singularity.
    pub free_joint: Option<FreeJoint>,
}

impl<const N: usize> Solution<N> {
    /// Whether every joint is inside its limits.
    #[must_use]
    pub fn is_within_limits(&self) -> bool {
        self.status.contains(Status::WITHIN_LIMITS)
    }

    /// The singularities that the solution is at.
    #[must_use]
    pub fn singularities(&self) -> SingularityKind {
        self.status.singularities()
    }
}

/// The content of a slot.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) enum Place<const N: usize> {
    /// The branch does not exist.
    Empty,
    /// The branch coincides with another slot's, which holds the solution. Its flags are its
    /// singularities and MERGED.
    Merged(Status),
    Found(Solution<N>),
}

impl<const N: usize> Place<N> {
    #[inline(always)]
    pub(crate) fn found(&self) -> Option<&Solution<N>> {
        match self {
            Self::Found(solution) => Some(solution),
            Self::Empty | Self::Merged(_) => None,
        }
    }

    fn status(&self) -> Status {
        match self {
            Self::Empty => Status::empty(),
            Self::Merged(flags) => *flags,
            Self::Found(solution) => solution.status,
        }
    }
}

/// Every solution of a pose or, if it has no solution, the reason.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Solutions<const N: usize> {
    places: [Place<N>; MOST_SLOTS],
    slot_count: usize,
    pub(crate) reach: Reach,
    pub(crate) is_certified: bool,
    pub(crate) pose: Pose,
    #[doc(hidden)]
    pub limits: JointLimits<N>,
    /// The reason why the last selection is empty.
    pub(crate) emptied: Option<Explanation>,
}

impl<const N: usize> Solutions<N> {
    /// An answer without solutions, for a structure with `slot_count` slots.
    #[inline]
    pub(crate) fn none(slot_count: usize, pose: Pose, limits: JointLimits<N>) -> Self {
        let places = [Place::Empty; MOST_SLOTS];
        let reach = Reach::Reached;
        Self { places, slot_count, reach, is_certified: true, pose, limits, emptied: None }
    }

    /// Number of solutions, inside the limits or not.
    #[must_use]
    pub fn len(&self) -> usize {
        self.iter().count()
    }

    /// Whether there is no solution.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Number of slots: eight, or sixteen for a general chain of six joints.
    #[must_use]
    pub fn slot_count(&self) -> usize {
        self.slot_count
    }

    /// The solutions in slot order.
    #[must_use]
    pub fn iter(&self) -> Iter<'_, N> {
        Iter(self.places().iter())
    }

    /// The solution in a slot, from 0; `None` if the slot is empty.
    #[must_use]
    pub fn slot(&self, slot: usize) -> Option<&Solution<N>> {
        self.places().get(slot)?.found()
    }

    /// The status of each slot; empty flags if the branch does not exist.
    #[must_use]
    pub fn status(&self) -> SlotStatus {
        let uncertified = if self.is_certified { Status::empty() } else { Status::UNCERTIFIED };
        SlotStatus::new(self.places.map(|place| place.status() | uncertified), self.slot_count)
    }

    #[inline]
    pub(crate) fn places(&self) -> &[Place<N>] {
        &self.places[..self.slot_count]
    }

    /// The content of the first `S` slots, with `S` known to the compiler.
    #[inline]
    pub(crate) fn first_places<const S: usize>(&mut self) -> &mut [Place<N>] {
        const { assert!(S <= MOST_SLOTS, "an answer has room for every slot of a structure") };
        &mut self.places[..S]
    }

    #[inline]
    pub(crate) fn places_mut(&mut self) -> &mut [Place<N>] {
        &mut self.places[..self.slot_count]
    }

    /// Whether every solution is in its own slot.
    #[doc(hidden)]
    pub fn is_consistent(&self) -> bool {
        let is_own = |(slot, place): (usize, &Place<N>)| {
            place.found().is_none_or(|solution| solution.slot.index() == slot)
        };
        self.slot_count <= MOST_SLOTS && self.places.iter().enumerate().all(is_own)
    }

    /// Whether the arm gets to the pose, limits not regarded.
    #[must_use]
    pub fn reach(&self) -> Reach {
        self.reach
    }

    /// Whether these are certain to be all solutions of the pose, limits not regarded: for a
    /// structure with a closed form always, for a refined one never; for others where their number
    /// equals the roots of a polynomial, and no self-motion is among them.
    #[must_use]
    pub fn is_certified(&self) -> bool {
        self.is_certified
    }

    /// The pose that was solved.
    #[must_use]
    pub fn pose(&self) -> &Pose {
        &self.pose
    }

    /// The joint limits that the solutions were checked against.
    #[must_use]
    pub fn limits(&self) -> &JointLimits<N> {
        &self.limits
    }

    /// Summarize the outcome in a sentence.
    #[must_use]
    pub fn explain(&self) -> Explanation {
        if let Some(explanation) = self.emptied {
            return explanation;
        }
        if self.reach == Reach::NoRoots {
            return Explanation::NoRoots { certified: self.is_certified, approach: None };
        }
        if self.reach != Reach::Reached {
            return Explanation::OutOfReach(self.reach);
        }
        let solutions = self.len();
        let inside = self.iter().filter(|solution| solution.is_within_limits()).count();
        if inside > 0 {
            return Explanation::Found { solutions, inside };
        }
        // The solution whose worst joint, or linkage, exceeds its limits least.
        let worst = |solution: &Solution<N>| {
            (0..N)
                .map(|joint| (Some(joint + 1), self.limits.least_excess(joint, solution.q[joint])))
                .fold((None, self.limits.linkage_excess(&solution.q)), |worst, joint| {
                    if joint.1 > worst.1 { joint } else { worst }
                })
        };
        match self.iter().map(worst).min_by(|a, b| a.1.total_cmp(&b.1)) {
            Some((Some(joint), excess)) => Explanation::OutsideLimits { solutions, joint, excess },
            Some((None, excess)) if excess > 0.0 => {
                Explanation::OutsideLinkage { solutions, excess }
            }
            Some((None, excess)) => Explanation::OutsideLimits { solutions, joint: 1, excess },
            None => Explanation::FilteredOut,
        }
    }
}

/// Iterator over the solutions of an answer, in slot order.
#[derive(Clone, Debug)]
pub struct Iter<'a, const N: usize>(core::slice::Iter<'a, Place<N>>);

impl<'a, const N: usize> Iterator for Iter<'a, N> {
    type Item = &'a Solution<N>;

    #[inline]
    fn next(&mut self) -> Option<Self::Item> {
        self.0.by_ref().find_map(Place::found)
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        (0, self.0.size_hint().1)
    }
}

impl<'a, const N: usize> IntoIterator for &'a Solutions<N> {
    type Item = &'a Solution<N>;
    type IntoIter = Iter<'a, N>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}
