//! The Z-Y-Z angles of a rotation, of which the first may be undetermined: the wrist of a six-axis
//! arm, the shoulder of a seven-axis one.

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
    /// Singular by its own angle, regardless of the uncertainty of the joints before it.
    pub(crate) free: bool,
}

/// The first angle to choose if the rotation leaves it undetermined.
pub(crate) struct First {
    /// Number of its joint, from 1.
    pub(crate) joint: usize,
    pub(crate) theta: f64,
    pub(crate) policy: SeedPolicy,
}

/// `Rz(theta[0]) Ry(theta[1]) Rz(theta[2])` of the rotation `m`. Computing the last two from the
/// sine and cosine of the chosen first keeps the residual at rounding near a second of zero,
/// whatever the first is. `error` is how far rounding may turn the rotation: a second angle below
/// it is treated as zero.
pub(crate) fn zyz(m: &Matrix3<f64>, first: &First, error: f64) -> Zyz {
    let column: Vector3<f64> = m.column(2).into();
    let sin_second = column.x.hypot(column.y);
    let merged = sin_second <= WRIST_MERGE_SIN.max(error);
    let undetermined =
        first.policy.forces(first.joint) || sin_second <= first.policy.radius().max(WRIST_FREE_SIN);
    let (theta_first, (sin, cos)) = if undetermined {
        let free = first.theta;
        (free, free.sin_cos())
    } else {
        first_angle(&column, sin_second, merged, error, first)
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

/// The first angle as the pose determines it, and its sine and cosine. Of merged branches, the one
/// nearer to the seed or to zero is kept: half a turn away it may be outside a limit. A path keeps
/// the angle that it is heading for within the uncertainty of the pose.
fn first_angle(
    column: &Vector3<f64>,
    sin_second: f64,
    merged: bool,
    error: f64,
    first: &First,
) -> (f64, (f64, f64)) {
    let first_angle = column.y.atan2(column.x);
    let flips = merged && (first.theta - first_angle).cos() < 0.0;
    let (first_angle, sign) = if flips { (first_angle + PI, -1.0) } else { (first_angle, 1.0) };
    if first.policy != SeedPolicy::Path || sin_second > PATH_WRIST_SIN {
        return (first_angle, (sign * column.y / sin_second, sign * column.x / sin_second));
    }
    let ahead = wrap(first.theta - first_angle);
    let kept = if sin_second > WRIST_MERGE_SIN {
        // The angle that is heading there may belong to the flip, half a turn away.
        let ahead = ahead - PI * (ahead / PI).round();
        if sin_second * ahead.sin().abs() <= error { first_angle + ahead } else { first_angle }
    } else {
        // As theta_1 becomes determined, approach it within its uncertainty: no leap from the angle
        // that an undetermined pose left.
        let open = (error.max(SEEDED_FREE) / sin_second).min(1.0).asin();
        first_angle + ahead.clamp(-open, open)
    };
    (kept, kept.sin_cos())
}

/// The directions of the three angles of a rotation times any length, without a division: the lanes
/// take their arc tangents (eq. 15 to 17). `m0` and `m1` are the first two rows of the rotation,
/// `m22` its last element; the second angle is in 0 ..= pi.
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
