//! The angle that a solve chooses for an undetermined joint.

use crate::kinematics::thresholds::SEEDED_FREE;

/// The angle to choose for a joint that the pose does not determine.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FreeChoice<const N: usize> {
    /// Joint angles [rad]: the undetermined joint takes its angle from here, and of the merged
    /// branches of a wrist the one nearer to them is kept.
    pub(crate) q: [f64; N],
    pub(crate) policy: SeedPolicy,
}

/// How far the pose is trusted near a singularity, compared with the given joint angles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum SeedPolicy {
    /// To rounding.
    Pose,
    /// To [`SEEDED_FREE`].
    Seed,
    /// As far as the pose determines the joint: the seed decides within the uncertainty. For poses
    /// that follow one another.
    Path,
    /// One joint, from 1, takes the given angle even if the pose determines it.
    Forced {
        joint: usize,
        /// Whether a free q1 belongs to the shoulder with the wrist center behind it.
        behind: bool,
    },
}

impl SeedPolicy {
    /// Distance from a singularity within which the pose does not determine the joint, beyond
    /// rounding [rad, m].
    pub(crate) fn radius(self) -> f64 {
        match self {
            Self::Pose | Self::Forced { .. } => 0.0,
            Self::Seed | Self::Path => SEEDED_FREE,
        }
    }

    pub(crate) fn forces(self, joint: usize) -> bool {
        matches!(self, Self::Forced { joint: forced, .. } if forced == joint)
    }
}

impl<const N: usize> FreeChoice<N> {
    /// The default angle for an undetermined joint, and only if rounding hides it.
    pub(crate) fn rest(q: [f64; N]) -> Self {
        Self { q, policy: SeedPolicy::Pose }
    }

    /// The seed's angle for an undetermined joint.
    pub(crate) fn seed(q: [f64; N]) -> Self {
        Self { q, policy: SeedPolicy::Seed }
    }

    /// The angle that continues a path, within the uncertainty of the pose.
    pub(crate) fn path(q: [f64; N]) -> Self {
        Self { q, policy: SeedPolicy::Path }
    }

    /// The angle of joint `joint`, from 1, in `q`; for other joints only if rounding hides them.
    pub(crate) fn forced(q: [f64; N], joint: usize, behind: bool) -> Self {
        Self { q, policy: SeedPolicy::Forced { joint, behind } }
    }
}
