//! The wrist: the angles of joints 4, 5 and 6 that give the flange its rotation in the forearm.

use core::f64::consts::PI;

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};
use nalgebra::{Matrix3, Vector3};

use super::target::Target;
use crate::kinematics::angles::{constant_sin_cos, wrap};
use crate::kinematics::free_choice::Trust;
use crate::kinematics::planar_arm::{Elbow, Shoulder};
use crate::kinematics::thresholds::{PATH_WRIST_SIN, SEEDED_FREE, WRIST_FREE_SIN, WRIST_MERGE_SIN};

/// One branch of the wrist, with theta_5 in 0 ..= pi unless theta_4 was given; the other one is its flip.
pub(super) struct Wrist {
    pub(super) theta: [f64; 3],
    pub(super) merged: bool,
    /// Singular by its own angle, whatever is known of the forearm.
    pub(super) free: bool,
}

/// The wrist angles (eq. 15 to 17). Taking theta_6 and theta_5 with the sine and cosine of the theta_4 that was chosen keeps the
/// residual at rounding next to theta_5 = 0, whatever theta_4 is. `error` is how far rounding may turn the forearm: a theta_5 below it
/// is none.
pub(super) fn wrist(m: &Matrix3<f64>, target: &Target<'_>, error: f64) -> Wrist {
    let column: Vector3<f64> = m.column(2).into();
    let sin_5 = column.x.hypot(column.y);
    let merged = sin_5 <= WRIST_MERGE_SIN.max(error);
    let trust = target.free.trust;
    let silent = trust.forces(4) || sin_5 <= trust.radius().max(WRIST_FREE_SIN);
    let (theta_4, (sin_4, cos_4)) = if silent {
        let free = target.free_theta[3];
        (free, free.sin_cos())
    } else {
        told_theta_4(&column, sin_5, merged, error, target)
    };
    let projected = cos_4 * column.x + sin_4 * column.y;
    let sin_5_signed = if projected.abs() <= WRIST_FREE_SIN { projected.max(0.0) } else { projected };
    let theta_5 = sin_5_signed.atan2(column.z);
    let theta_6 = (cos_4 * m[(1, 0)] - sin_4 * m[(0, 0)]).atan2(cos_4 * m[(1, 1)] - sin_4 * m[(0, 1)]);
    Wrist { theta: [theta_4, theta_5, theta_6], merged, free: sin_5 <= WRIST_MERGE_SIN }
}

/// theta_4 as the pose tells it, and its sine and cosine. Of merged branches, the one nearer to the seed or to zero is kept: half a turn
/// away it may be outside a limit. A path keeps the theta_4 that it is heading for as far as what the pose knows of the forearm does not
/// contradict it.
fn told_theta_4(column: &Vector3<f64>, sin_5: f64, merged: bool, error: f64, target: &Target<'_>) -> (f64, (f64, f64)) {
    let told = column.y.atan2(column.x);
    let flips = merged && (target.free_theta[3] - told).cos() < 0.0;
    let (told, sign) = if flips { (told + PI, -1.0) } else { (told, 1.0) };
    if target.free.trust != Trust::Path || sin_5 > PATH_WRIST_SIN {
        return (told, (sign * column.y / sin_5, sign * column.x / sin_5));
    }
    let ahead = wrap(target.free_theta[3] - told);
    let kept = if sin_5 > WRIST_MERGE_SIN {
        // The one that is heading there may be the flip, half a turn away.
        let ahead = ahead - PI * (ahead / PI).round();
        if sin_5 * ahead.sin().abs() <= error { told + ahead } else { told }
    } else {
        // Where the pose begins to tell, it pulls: no leap from what a silent one left open.
        let open = (error.max(SEEDED_FREE) / sin_5).min(1.0).asin();
        told + ahead.clamp(-open, open)
    };
    (kept, kept.sin_cos())
}

/// `Ry(-theta_23) Rz(-theta_1) R`, which is `Rz(theta_4) Ry(theta_5) Rz(theta_6)` (eq. 14).
pub(super) fn forearm_to_flange(shoulder: &Shoulder, elbow: &Elbow, rotation: &Matrix3<f64>) -> Matrix3<f64> {
    let (r0, r1, r2) = (rotation.row(0), rotation.row(1), rotation.row(2));
    let n0 = r0 * shoulder.cos_1 + r1 * shoulder.sin_1;
    let n1 = r1 * shoulder.cos_1 - r0 * shoulder.sin_1;
    Matrix3::from_rows(&[n0 * elbow.cos_23 - r2 * elbow.sin_23, n1, n0 * elbow.sin_23 + r2 * elbow.cos_23])
}

/// `Rz(theta_4) Ry(theta_5) Rz(theta_6)`; exact where theta_4 is held at a quarter turn.
pub(super) fn wrist_rotation(theta_4: f64, theta_5: f64, theta_6: f64) -> Matrix3<f64> {
    let about_z = |(sin, cos): (f64, f64)| Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0);
    let (sin_5, cos_5) = theta_5.sin_cos();
    let about_y = Matrix3::new(cos_5, 0.0, sin_5, 0.0, 1.0, 0.0, -sin_5, 0.0, cos_5);
    about_z(constant_sin_cos(theta_4)) * about_y * about_z(theta_6.sin_cos())
}
