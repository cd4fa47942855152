//! An angle with its sine and cosine.

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use crate::kinematics::pose::angles::wrap;
use crate::kinematics::structure::free_choice::SeedPolicy;
use crate::kinematics::thresholds::SEEDED_FREE;

#[derive(Clone, Copy, Debug)]
pub(super) struct Turn {
    pub(super) theta: f64,
    pub(super) sin: f64,
    pub(super) cos: f64,
}

impl Turn {
    pub(super) fn of(theta: f64) -> Self {
        let (sin, cos) = theta.sin_cos();
        Self { theta, sin, cos }
    }

    /// The angle of the direction (cos, sin), of any length; `None` for length zero.
    pub(super) fn towards(sin: f64, cos: f64) -> Self {
        let norm = sin.hypot(cos);
        if norm == 0.0 {
            return Self { theta: 0.0, sin: 0.0, cos: 1.0 };
        }
        Self { theta: sin.atan2(cos), sin: sin / norm, cos: cos / norm }
    }

    /// Of two angles that a pose determines for a joint with lever at most `lever` [m], the one
    /// nearer to the angle `free`. A path keeps `free` as far as that moves the pose within its
    /// uncertainty: no leap from the angle that an undetermined pose left.
    pub(super) fn from_pose(twins: [Self; 2], free: f64, lever: f64, policy: SeedPolicy) -> Self {
        let [a, b] = twins;
        let nearer = if (b.theta - free).cos() > (a.theta - free).cos() { b } else { a };
        if policy != SeedPolicy::Path {
            return nearer;
        }
        let open = (SEEDED_FREE / lever).min(1.0).asin();
        Self::of(nearer.theta + wrap(free - nearer.theta).clamp(-open, open))
    }
}
