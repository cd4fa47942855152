//! The wrist: the angles of joints 4, 5 and 6 that give the flange its rotation in the forearm
//! frame.

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;
use nalgebra::Matrix3;

use crate::kinematics::pose::angles::constant_sin_cos;
use crate::kinematics::structure::planar_arm::{Elbow, Shoulder, Target};
use crate::kinematics::structure::zyz::{First, Zyz, zyz};

/// The wrist angles (eq. 15 to 17). `error` is how far rounding may rotate the forearm: a theta_5
/// below it is treated as zero.
pub(super) fn wrist(m: &Matrix3<f64>, target: &Target<'_>, error: f64) -> Zyz {
    zyz(m, &First { joint: 4, theta: target.free_theta[3], policy: target.free.policy }, error)
}

/// `Ry(-theta_23) Rz(-theta_1) R`, which is `Rz(theta_4) Ry(theta_5) Rz(theta_6)` (eq. 14).
pub(super) fn forearm_to_flange(
    shoulder: &Shoulder,
    elbow: &Elbow,
    rotation: &Matrix3<f64>,
) -> Matrix3<f64> {
    let (r0, r1, r2) = (rotation.row(0), rotation.row(1), rotation.row(2));
    let n0 = r0 * shoulder.cos_1 + r1 * shoulder.sin_1;
    let n1 = r1 * shoulder.cos_1 - r0 * shoulder.sin_1;
    Matrix3::from_rows(&[
        n0 * elbow.cos_23 - r2 * elbow.sin_23,
        n1,
        n0 * elbow.sin_23 + r2 * elbow.cos_23,
    ])
}

/// `Rz(theta_4) Ry(theta_5) Rz(theta_6)`; exact if theta_4 is locked at a quarter turn.
pub(super) fn wrist_rotation(theta_4: f64, theta_5: f64, theta_6: f64) -> Matrix3<f64> {
    let about_z =
        |(sin, cos): (f64, f64)| Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0);
    let (sin_5, cos_5) = theta_5.sin_cos();
    let about_y = Matrix3::new(cos_5, 0.0, sin_5, 0.0, 1.0, 0.0, -sin_5, 0.0, cos_5);
    about_z(constant_sin_cos(theta_4)) * about_y * about_z(theta_6.sin_cos())
}
