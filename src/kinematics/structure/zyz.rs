//! The angles of a rotation about z, y and z again, where the first may be open: the wrist of a
//! six-axis arm, the shoulder of a seven-axis one.

use core::f64::consts::PI;

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};
use nalgebra::{Matrix3, Vector3};

use crate::kinematics::pose::angles::wrap;
use crate::kinematics::structure::free_choice::SeedPolicy;
use crate::kinematics::structure::lanes::Direction;
use crate::kinematics::thresholds::{PATH_WRIST_SIN, SEEDED_FREE, WRIST_FREE_SIN, WRIST_MERGE_SIN};
use crate::lanes::mul_add;

/// One set of angles, the second in 0 ..= pi unless the first was given; the other set is its flip.
#[derive(Clone, Copy)]
pub(crate) struct Zyz {
    pub(crate) theta: [f64; 3],
    pub(crate) merged: bool,
    /// Singular by its own angle, whatever is known of what stands before it.
    pub(crate) free: bool,
}

/// What to take for the first angle where the rotation leaves it open.
pub(crate) struct First {
    /// Number of its joint, from 1.
    pub(crate) joint: usize,
    pub(crate) theta: f64,
    pub(crate) policy: SeedPolicy,
}

/// `Rz(theta[0]) Ry(theta[1]) Rz(theta[2])` of the rotation `m`. Taking the last two with the sine
/// and cosine of the first that was chosen keeps the residual at rounding next to a second of zero,
/// whatever the first is. `error` is how far rounding may turn the rotation: a second angle below
/// it is none.
pub(crate) fn zyz(m: &Matrix3<f64>, first: &First, error: f64) -> Zyz {
    let column: Vector3<f64> = m.column(2).into();
    let sin_second = column.x.hypot(column.y);
    let merged = sin_second <= WRIST_MERGE_SIN.max(error);
    let silent =
        first.policy.forces(first.joint) || sin_second <= first.policy.radius().max(WRIST_FREE_SIN);
    let (theta_first, (sin, cos)) = if silent {
        let free = first.theta;
        (free, free.sin_cos())
    } else {
        told(&column, sin_second, merged, error, first)
    };
    let projected = cos * column.x + sin * column.y;
    let signed = if projected.abs() <= WRIST_FREE_SIN { projected.max(0.0) } else { projected };
    let theta_second = signed.atan2(column.z);
    let theta_last = (cos * m[(1, 0)] - sin * m[(0, 0)]).atan2(cos * m[(1, 1)] - sin * m[(0, 1)]);
    Zyz {
        theta: [theta_first, theta_second, theta_last],
        merged,
        free: sin_second <= WRIST_MERGE_SIN,
    }
}

/// The first angle as the pose tells it, and its sine and cosine. Of merged branches, the one
/// nearer to the seed or to zero is kept: half a turn away it may be outside a limit. A path keeps
/// the angle that it is heading for as far as what the pose knows does not contradict it.
fn told(
    column: &Vector3<f64>,
    sin_second: f64,
    merged: bool,
    error: f64,
    first: &First,
) -> (f64, (f64, f64)) {
    let told = column.y.atan2(column.x);
    let flips = merged && (first.theta - told).cos() < 0.0;
    let (told, sign) = if flips { (told + PI, -1.0) } else { (told, 1.0) };
    if first.policy != SeedPolicy::Path || sin_second > PATH_WRIST_SIN {
        return (told, (sign * column.y / sin_second, sign * column.x / sin_second));
    }
    let ahead = wrap(first.theta - told);
    let kept = if sin_second > WRIST_MERGE_SIN {
        // The one that is heading there may be the flip, half a turn away.
        let ahead = ahead - PI * (ahead / PI).round();
        if sin_second * ahead.sin().abs() <= error { told + ahead } else { told }
    } else {
        // Where the pose begins to tell, it pulls: no leap from what a silent one left open.
        let open = (error.max(SEEDED_FREE) / sin_second).min(1.0).asin();
        told + ahead.clamp(-open, open)
    };
    (kept, kept.sin_cos())
}

/// The directions of the three angles of a rotation times any length, without a division: what
/// lanes take the arc tangents of (eq. 15 to 17). `m0` and `m1` are the first two rows of the
/// rotation, `m22` its last element; the second angle is in 0 ..= pi.
#[inline(always)]
pub(crate) fn zyz_directions<const FUSED: bool>(
    m0: [f64; 3],
    m1: [f64; 3],
    m22: f64,
) -> [Direction; 3] {
    let sin_second = mul_add::<FUSED>(m0[2], m0[2], m1[2] * m1[2]).sqrt();
    let last = [
        mul_add::<FUSED>(m0[2], m1[0], -(m1[2] * m0[0])),
        mul_add::<FUSED>(m0[2], m1[1], -(m1[2] * m0[1])),
    ];
    [[m1[2], m0[2]], [sin_second, m22], last]
}
