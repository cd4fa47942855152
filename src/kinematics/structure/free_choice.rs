//! What a solve takes for a joint that the pose leaves open.

use crate::kinematics::thresholds::SEEDED_FREE;

/// What to take for a joint that the pose does not determine.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FreeChoice<const N: usize> {
    /// Joint angles [rad], of which the free one's is taken; of the merged branches of a wrist, the
    /// one nearer to them.
    pub(crate) q: [f64; N],
    pub(crate) policy: SeedPolicy,
}

/// How far the pose is trusted next to a singularity, against the joint angles that were given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum SeedPolicy {
    /// To rounding.
    Pose,
    /// To [`SEEDED_FREE`].
    Seed,
    /// As far as it says anything: what it does not contradict is taken from the seed. For poses
    /// that follow one another.
    Path,
    /// One joint, from 1, is taken from the angles whatever the pose says.
    Forced {
        joint: usize,
        /// Whether a free q1 is that of the shoulder that has the wrist center behind it.
        behind: bool,
    },
}

impl SeedPolicy {
    /// How close to a singularity the pose counts as silent, beyond rounding [rad, m].
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
    /// The angle where a joint rests, for a free joint and only where rounding hides it.
    pub(crate) fn rest(q: [f64; N]) -> Self {
        Self { q, policy: SeedPolicy::Pose }
    }

    /// The seed's angle for a free joint.
    pub(crate) fn seed(q: [f64; N]) -> Self {
        Self { q, policy: SeedPolicy::Seed }
    }

    /// The angle that continues a path, wherever the pose does not contradict it.
    pub(crate) fn path(q: [f64; N]) -> Self {
        Self { q, policy: SeedPolicy::Path }
    }

    /// Whether only a pose next to a singularity is asked for more than it says by itself.
    pub(crate) fn leaves_regular_poses_alone(&self) -> bool {
        matches!(self.policy, SeedPolicy::Pose | SeedPolicy::Seed)
    }

    /// The angle that `q` has for joint `joint`, from 1; for another one only where rounding hides
    /// it.
    pub(crate) fn forced(q: [f64; N], joint: usize, behind: bool) -> Self {
        Self { q, policy: SeedPolicy::Forced { joint, behind } }
    }
}
