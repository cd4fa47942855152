//! Joints that singular poses leave undetermined.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

/// A joint that a singular pose leaves free: the solution is one of a self-motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum FreeJoint {
    /// The wrist center is on axis 1: q1 is free, q2 and q3 are fixed, the wrist follows.
    Base,
    /// The wrist center is on axis 2: q2 is free, q1 and q3 are fixed, the wrist follows.
    Upper,
    /// As `Upper`, for an arm with coupled axes 2 and 3: q3 moves with q2.
    UpperCoupled,
    /// As `UpperCoupled`, of axes 2 and 3 that turn in opposite senses: q3 moves against q2.
    UpperOpposed,
    /// Axes 4 and 6 are one: q4 is free, q4 + q6 is fixed.
    WristSum,
    /// Axes 4 and 6 are one: q4 is free, q4 - q6 is fixed.
    WristDifference,
    /// Axes 2, 3, 4 and 6 of a three-parallel arm are parallel: q6 is free, q1 and q5 are fixed,
    /// the arm follows.
    Parallel,
    /// Axes 1 and 3 of a seven-axis arm are one: q1 is free, q1 + q3 is fixed.
    ShoulderSum,
    /// Axes 1 and 3 of a seven-axis arm are one: q1 is free, q1 - q3 is fixed.
    ShoulderDifference,
    /// The shoulder of a seven-axis arm is on axis 5: q5 is free, q4 and q6 are fixed, the
    /// shoulder's joints follow.
    Forearm,
    /// The shoulder of a seven-axis arm is on axis 6: q6 is free, q4 and q5 are fixed, the
    /// shoulder's joints follow.
    Hand,
    /// Axes 4 and 6 of a YuMi, its joints 5 and 7, are one: q5 is free, q5 + q7 is fixed, and so is
    /// the arm angle.
    LastSum,
    /// A chain without a closed form moves with its ends standing still: the first joint that moves
    /// is free.
    Chain {
        /// Which joints move, one bit each, the first joint the lowest.
        moving: u8,
    },
}

/// How the arm moves along a self-motion, the tool standing still.
struct SelfMotion {
    /// Number of the free joint, from 1.
    joint: usize,
    /// The words for the fixed joints, but for a chain.
    fixed: &'static str,
    rest: Rest,
    /// The branches that it runs through, each by the bits in which its slots differ from a
    /// solution of it. The free joint may flip what turns with it or bring another singularity; the
    /// two elbows of a stretched arm are one solution and go apart along the self-motion.
    branches: &'static [&'static [usize]],
}

/// The motion of the other joints.
enum Rest {
    /// One of them moves: its number, from 1, and the sign with which its sum with the free one is
    /// fixed.
    Partner(usize, f64),
    /// All move but these, from 1.
    Still(&'static [usize]),
}

const ONE_BRANCH: &[&[usize]] = &[&[0, 1]];

/// Joints of a chain that moves with its ends standing still.
const JOINTS: usize = 6;

impl FreeJoint {
    /// All but the ones of a chain.
    #[cfg(test)]
    const ALL: [Self; 12] = [
        Self::Base,
        Self::Upper,
        Self::UpperCoupled,
        Self::UpperOpposed,
        Self::WristSum,
        Self::WristDifference,
        Self::Parallel,
        Self::ShoulderSum,
        Self::ShoulderDifference,
        Self::Forearm,
        Self::Hand,
        Self::LastSum,
    ];

    #[cfg(test)]
    pub(crate) fn all() -> impl Iterator<Item = Self> {
        Self::ALL.into_iter().chain((1..1 << JOINTS).map(|moving| Self::Chain { moving }))
    }

    /// The free joint of an arm that is folded onto axis 2, with the factor of q2 in its q3.
    pub(crate) fn upper(coupling: f64) -> Self {
        match coupling {
            0.0 => Self::Upper,
            _ if coupling > 0.0 => Self::UpperCoupled,
            _ => Self::UpperOpposed,
        }
    }

    /// The free joint of a chain of which these joints move; `None` if all stand still.
    pub(crate) fn of_chain(moving: [bool; JOINTS]) -> Option<Self> {
        let bits = moving.iter().rev().fold(0, |bits, moves| 2 * bits + u8::from(*moves));
        (bits > 0).then_some(Self::Chain { moving: bits })
    }

    const fn motion(self) -> SelfMotion {
        let (joint, fixed, rest) = match self {
            Self::Base => (1, "q2, q3", Rest::Still(&[2, 3])),
            Self::Upper => (2, "q1, q3", Rest::Still(&[1, 3])),
            Self::UpperCoupled => (2, "q1, q3 - q2", Rest::Still(&[1])),
            Self::UpperOpposed => (2, "q1, q3 + q2", Rest::Still(&[1])),
            Self::WristSum => (4, "q4 + q6", Rest::Partner(6, 1.0)),
            Self::WristDifference => (4, "q4 - q6", Rest::Partner(6, -1.0)),
            Self::Parallel => (6, "q1, q5", Rest::Still(&[1, 5])),
            Self::ShoulderSum => (1, "q1 + q3", Rest::Partner(3, 1.0)),
            Self::ShoulderDifference => (1, "q1 - q3", Rest::Partner(3, -1.0)),
            Self::Forearm => (5, "q4, q6", Rest::Still(&[4, 6])),
            Self::Hand => (6, "q4, q5", Rest::Still(&[4, 5])),
            Self::LastSum => (5, "q5 + q7", Rest::Partner(7, 1.0)),
            Self::Chain { moving } => (moving.trailing_zeros() as usize + 1, "", Rest::Still(&[])),
        };
        let branches: &[&[usize]] = match self {
            Self::ShoulderSum | Self::ShoulderDifference => &[&[0, 4]],
            Self::Forearm | Self::Hand => &[&[0, 1, 4, 5]],
            Self::Parallel => &[&[0, 1], &[2, 3]],
            Self::Chain { .. } => &[&[0]],
            _ => ONE_BRANCH,
        };
        SelfMotion { joint, fixed, rest, branches }
    }

    /// Number of the free joint, from 1.
    #[must_use]
    pub const fn joint(self) -> usize {
        self.motion().joint
    }

    /// Name what stays fixed along the self-motion: "q2, q3", "q4 + q6", "nothing".
    #[must_use]
    pub fn fixed(self) -> String {
        let Self::Chain { moving } = self else { return self.motion().fixed.into() };
        let still = (0..JOINTS).filter(|joint| moving >> joint & 1 == 0);
        let still: Vec<_> = still.map(|joint| format!("q{}", joint + 1)).collect();
        if still.is_empty() { "nothing".into() } else { still.join(", ") }
    }

    /// The joint whose sum with the free one, or difference from it (a sign of -1), is all that is
    /// fixed: its number, from 1, and the sign.
    pub(crate) const fn partner(self) -> Option<(usize, f64)> {
        match self.motion().rest {
            Rest::Partner(joint, sign) => Some((joint, sign)),
            Rest::Still(_) => None,
        }
    }

    /// Numbers of the joints, from 1, that stand still along a self-motion of more than a partner;
    /// none of a chain.
    pub(crate) const fn still(self) -> &'static [usize] {
        match self.motion().rest {
            Rest::Partner(..) => &[],
            Rest::Still(joints) => joints,
        }
    }

    /// The branches that the self-motion runs through, by what their slots differ in.
    pub(crate) const fn branches(self) -> &'static [&'static [usize]] {
        self.motion().branches
    }
}

#[cfg(test)]
mod tests {
    use super::FreeJoint;

    #[test]
    fn each_has_its_own_joint_and_words() {
        for (index, free) in FreeJoint::ALL.into_iter().enumerate() {
            for other in &FreeJoint::ALL[..index] {
                assert!((free.joint(), free.fixed()) != (other.joint(), other.fixed()));
            }
        }
        let chain = |moving| FreeJoint::of_chain(moving).unwrap();
        let ends = chain([true, false, false, false, false, true]);
        assert_eq!((ends.joint(), ends.fixed()), (1, "q2, q3, q4, q5".into()));
        assert_eq!(chain([true; 6]).fixed(), "nothing");
        assert_eq!(chain([false, true, true, true, true, true]).joint(), 2);
        assert_eq!(FreeJoint::of_chain([false; 6]), None);
        assert_eq!(FreeJoint::all().count(), 12 + 63);
    }
}
