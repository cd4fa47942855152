//! The answer of a solve: up to eight solutions, each in its slot.

use crate::kinematics::answer::status::{Explanation, Reach, Status};
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::pose::Pose;

/// Number of slots of every closed-form arm.
pub const SLOTS: usize = 8;

/// A joint that a singular pose leaves free: the solution is one of a family.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FreeJoint {
    /// The wrist centre is on axis 1: q1 is free, q2 and q3 are fixed, the wrist follows.
    Base,
    /// The wrist centre is on axis 2: q2 is free, q1 and q3 are fixed, the wrist follows.
    Upper,
    /// The same of an arm with coupled axes 2 and 3: q3 goes with q2.
    UpperCoupled,
    /// Axes 4 and 6 are one: q4 is free, q4 + q6 is fixed.
    WristSum,
    /// Axes 4 and 6 are one: q4 is free, q4 - q6 is fixed.
    WristDifference,
    /// Axes 2, 3, 4 and 6 of a three-parallel arm are parallel: q6 is free, q1 and q5 are fixed, the arm follows.
    Parallel,
    /// Axes 1 and 3 of a seven-axis arm are one: q1 is free, q1 + q3 is fixed.
    ShoulderSum,
    /// Axes 1 and 3 of a seven-axis arm are one: q1 is free, q1 - q3 is fixed.
    ShoulderDifference,
    /// The shoulder of a seven-axis arm is on axis 5: q5 is free, q4 and q6 are fixed, the shoulder's joints follow.
    Forearm,
    /// The shoulder of a seven-axis arm is on axis 6: q6 is free, q4 and q5 are fixed, the shoulder's joints follow.
    Hand,
}

impl FreeJoint {
    /// Number of the free joint, from 1.
    #[must_use]
    pub fn joint(self) -> usize {
        match self {
            Self::Base | Self::ShoulderSum | Self::ShoulderDifference => 1,
            Self::Upper | Self::UpperCoupled => 2,
            Self::WristSum | Self::WristDifference => 4,
            Self::Forearm => 5,
            Self::Parallel | Self::Hand => 6,
        }
    }

    /// The joint whose sum with the free one, or difference from it (a sign of -1), is all that is fixed: its number, from 1, and the sign.
    pub(crate) fn partner(self) -> Option<(usize, f64)> {
        match self {
            Self::WristSum => Some((6, 1.0)),
            Self::WristDifference => Some((6, -1.0)),
            Self::ShoulderSum => Some((3, 1.0)),
            Self::ShoulderDifference => Some((3, -1.0)),
            Self::Base
            | Self::Upper
            | Self::UpperCoupled
            | Self::Parallel
            | Self::Forearm
            | Self::Hand => None,
        }
    }

    /// Numbers of the joints, from 1, that stand still along a family that moves more than a partner.
    pub(crate) fn still(self) -> &'static [usize] {
        match self {
            Self::Base => &[2, 3],
            Self::Upper => &[1, 3],
            Self::UpperCoupled => &[1],
            Self::Parallel => &[1, 5],
            Self::Forearm => &[4, 6],
            Self::Hand => &[4, 5],
            Self::WristSum
            | Self::WristDifference
            | Self::ShoulderSum
            | Self::ShoulderDifference => &[],
        }
    }

    /// The branches on which a family goes on, each by what its slots differ in from that of a solution of it. The free joint may flip what
    /// turns with it or bring another singularity; the two elbows of a stretched arm are one solution and go apart along the family.
    pub(crate) fn branches(self) -> &'static [&'static [usize]] {
        match self {
            Self::ShoulderSum | Self::ShoulderDifference => &[&[0, 4]],
            Self::Forearm | Self::Hand => &[&[0, 1, 4, 5]],
            Self::Parallel => &[&[0, 1], &[2, 3]],
            Self::Base
            | Self::Upper
            | Self::UpperCoupled
            | Self::WristSum
            | Self::WristDifference => &[&[0, 1]],
        }
    }

    /// What stays fixed along the family.
    #[must_use]
    pub fn fixed(self) -> &'static str {
        match self {
            Self::Base => "q2, q3",
            Self::Upper => "q1, q3",
            Self::UpperCoupled => "q1, q3 - q2",
            Self::WristSum => "q4 + q6",
            Self::WristDifference => "q4 - q6",
            Self::Parallel => "q1, q5",
            Self::ShoulderSum => "q1 + q3",
            Self::ShoulderDifference => "q1 - q3",
            Self::Forearm => "q4, q6",
            Self::Hand => "q4, q5",
        }
    }
}

/// One joint vector that brings the tool to the pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solution<const N: usize> {
    /// Joint angles [rad]: in (-pi, pi], or the full turn of it that is inside the limits.
    pub q: [f64; N],
    /// The slot, 0 ..= 7. For spherical-wrist arms: 4 (wrist centre behind axis 1) + 2 (behind the lower arm) + 1 (q5 < 0).
    pub slot: u8,
    /// Found, inside the limits or not, and the singularities that the pose stands at.
    pub status: Status,
    /// The joint that the pose leaves free, at a singularity.
    pub free: Option<FreeJoint>,
}

impl<const N: usize> Solution<N> {
    /// Whether every joint is inside its limits.
    #[must_use]
    pub fn within_limits(&self) -> bool {
        self.status.contains(Status::WITHIN_LIMITS)
    }

    /// The singularities that the pose stands at.
    #[must_use]
    pub fn kinds(&self) -> Status {
        self.status & Status::KINDS
    }
}

/// Every solution of a pose, and why there is none where there is none.
#[derive(Clone, Debug, PartialEq)]
pub struct Solutions<const N: usize> {
    pub(crate) slots: [Option<Solution<N>>; SLOTS],
    pub(crate) merged: [Status; SLOTS],
    pub(crate) reach: Reach,
    pub(crate) pose: Pose,
    pub(crate) limits: JointLimits<N>,
    /// Why the last selection left nothing.
    pub(crate) emptied: Option<Explanation>,
}

impl<const N: usize> Solutions<N> {
    /// Number of solutions, limits not regarded.
    #[must_use]
    pub fn len(&self) -> usize {
        self.iter().count()
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The solutions in the order of their slots.
    pub fn iter(&self) -> impl Iterator<Item = &Solution<N>> {
        self.slots.iter().flatten()
    }

    /// The solution in a slot.
    #[must_use]
    pub fn slot(&self, slot: usize) -> Option<&Solution<N>> {
        self.slots.get(slot)?.as_ref()
    }

    /// What the solve says of each slot; empty flags where the branch does not exist.
    #[must_use]
    pub fn status(&self) -> [Status; SLOTS] {
        core::array::from_fn(|i| {
            self.slots[i].as_ref().map_or(self.merged[i], |solution| solution.status)
        })
    }

    /// Whether the wrist centre gets to where the pose wants it.
    #[must_use]
    pub fn reach(&self) -> Reach {
        self.reach
    }

    /// The pose that was solved.
    #[must_use]
    pub fn pose(&self) -> &Pose {
        &self.pose
    }

    /// The limits that the solutions were held against.
    #[must_use]
    pub fn limits(&self) -> &JointLimits<N> {
        &self.limits
    }

    /// The outcome in a sentence.
    #[must_use]
    pub fn explain(&self) -> Explanation {
        if let Some(explanation) = self.emptied {
            return explanation;
        }
        if self.reach != Reach::Reached {
            return Explanation::OutOfReach(self.reach);
        }
        let solutions = self.len();
        let inside = self.iter().filter(|solution| solution.within_limits()).count();
        if inside > 0 {
            return Explanation::Found { solutions, inside };
        }
        // The solution whose worst joint, or rod, is the least outside.
        let worst = |solution: &Solution<N>| {
            (0..N)
                .map(|joint| (Some(joint + 1), self.limits.excess(joint, solution.q[joint])))
                .fold((None, self.limits.rod_excess(&solution.q)), |worst, joint| {
                    if joint.1 > worst.1 { joint } else { worst }
                })
        };
        match self.iter().map(worst).min_by(|a, b| a.1.total_cmp(&b.1)) {
            Some((Some(joint), excess)) => Explanation::OutsideLimits { solutions, joint, excess },
            Some((None, excess)) if excess > 0.0 => Explanation::OutsideRod { solutions, excess },
            Some((None, excess)) => Explanation::OutsideLimits { solutions, joint: 1, excess },
            None => Explanation::FilteredOut,
        }
    }
}

impl<'a, const N: usize> IntoIterator for &'a Solutions<N> {
    type Item = &'a Solution<N>;
    type IntoIter = core::iter::Flatten<core::slice::Iter<'a, Option<Solution<N>>>>;

    fn into_iter(self) -> Self::IntoIter {
        self.slots.iter().flatten()
    }
}
