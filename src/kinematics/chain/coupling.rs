//! Axes 2 and 3 coupled by a parallelogram linkage: it keeps the forearm's pitch while axis 2
//! turns.
//!
//! The controller of such an arm measures q3 from the base, not from the upper arm: its q3 is q3 of
//! the serial chain plus q2 (docs/theory/spherical_wrist.md, eq. 25).

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;
#[cfg(not(feature = "std"))]
use nalgebra::RealField as _;

use crate::kinematics::thresholds::MOST_ANGLE;

/// Convert the controller's joint angles to the serial chain's [rad].
#[inline(always)]
pub(crate) fn uncoupled<const N: usize>(mut q: [f64; N]) -> [f64; N] {
    if let [_, q2, q3, ..] = &mut q[..] {
        *q3 = if q2.abs().max(q3.abs()) > MOST_ANGLE { far(*q3, *q2) } else { *q3 - *q2 };
    }
    q
}

/// The difference of two angles with so many turns that it would be rounded by a fraction of a
/// turn, in [-pi, pi] [rad].
#[cold]
fn far(angle: f64, other: f64) -> f64 {
    let ((sin, cos), (other_sin, other_cos)) = (angle.sin_cos(), other.sin_cos());
    (sin * other_cos - cos * other_sin).atan2(cos * other_cos + sin * other_sin)
}

/// Convert the serial chain's joint angles to the controller's [rad].
pub(crate) fn coupled<const N: usize>(mut q: [f64; N]) -> [f64; N] {
    if let [_, q2, q3, ..] = &mut q[..] {
        *q3 += *q2;
    }
    q
}
