//! Axes 2 and 3 coupled by a parallelogram: a linkage holds the forearm's pitch while axis 2 turns.
//!
//! The controller of such an arm tells axis 3 from the base, not from the upper arm: its q3 is that
//! of the serial chain plus q2 (docs/spherical_wrist.md, eq. 25).

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;
#[cfg(not(feature = "std"))]
use nalgebra::RealField as _;

use crate::kinematics::thresholds::MOST_ANGLE;

/// The serial chain's joint angles of a controller's [rad].
#[inline(always)]
pub(crate) fn uncoupled<const N: usize>(mut q: [f64; N]) -> [f64; N] {
    if let [_, q2, q3, ..] = &mut q[..] {
        *q3 = if q2.abs().max(q3.abs()) > MOST_ANGLE { far(*q3, *q2) } else { *q3 - *q2 };
    }
    q
}

/// The difference of angles of so many turns that it would be rounded to a part of a turn, in [-pi,
/// pi] [rad].
#[cold]
fn far(angle: f64, other: f64) -> f64 {
    let ((sin, cos), (other_sin, other_cos)) = (angle.sin_cos(), other.sin_cos());
    (sin * other_cos - cos * other_sin).atan2(cos * other_cos + sin * other_sin)
}

/// The controller's joint angles of a serial chain's [rad].
pub(crate) fn coupled<const N: usize>(mut q: [f64; N]) -> [f64; N] {
    if let [_, q2, q3, ..] = &mut q[..] {
        *q3 += *q2;
    }
    q
}
