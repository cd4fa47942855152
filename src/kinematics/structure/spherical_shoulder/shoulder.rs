//! Joints 1, 2 and 3: the remaining rotation of the shoulder.

use nalgebra::Matrix3;

use super::links::Elbow;
use super::target::Target;
use super::wrist::Wrist;
use crate::kinematics::structure::zyz::{First, Zyz, zyz};
use crate::kinematics::thresholds::REGULAR_WRIST_SIN;

/// The angles of the shoulder (eq. 63 and 64). `error` is how far rounding may rotate the upper
/// arm.
pub(super) fn shoulder(elbow: &Elbow, wrist: &Wrist, target: &Target<'_>, error: f64) -> Zyz {
    let upper_arm = target.rotation * upper_arm_to_hand(elbow, wrist).transpose();
    let first = First { joint: 1, theta: target.free_theta[0], policy: target.free.policy };
    // Even if elbow and wrist are more uncertain than that, the upper arm is not, once they are
    // chosen.
    zyz(&upper_arm, &first, error.min(REGULAR_WRIST_SIN))
}

/// `Ry(theta_4) Rz(theta_5) Ry(theta_6)`.
fn upper_arm_to_hand(elbow: &Elbow, wrist: &Wrist) -> Matrix3<f64> {
    let (s4, c4) = (elbow.sin_4, elbow.cos_4);
    let (s5, c5) = (wrist.fifth.sin, wrist.fifth.cos);
    let (s6, c6) = (wrist.sixth.sin, wrist.sixth.cos);
    Matrix3::new(
        c4 * (c5 * c6) - s4 * s6,
        -c4 * s5,
        c4 * (c5 * s6) + s4 * c6,
        s5 * c6,
        c5,
        s5 * s6,
        -s4 * (c5 * c6) - c4 * s6,
        s4 * s5,
        c4 * c6 - s4 * (c5 * s6),
    )
}
