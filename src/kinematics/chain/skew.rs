//! Two nearly parallel axes, skew in both directions, as a table has them: with a common normal,
//! which may be far away (docs/calibrate.md, eq. 7 to 9).

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use crate::kinematics::pose::angles::sign_of;
use crate::kinematics::thresholds::FARTHEST_NORMAL;

/// The factors of `Rx(alpha) Tx(a) Ry(beta)` as a table has them (eq. 7):
/// `Rz(before.0) Tz(before.1) Rx(alpha) Tx(a) Rz(behind.0) Tz(behind.1)`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Unskewed {
    /// Turn [rad] and shift [m] about and along the axis before.
    pub(super) before: (f64, f64),
    pub(super) alpha: f64,
    pub(super) a: f64,
    /// Turn [rad] and shift [m] about and along the axis behind.
    pub(super) behind: (f64, f64),
}

impl Unskewed {
    /// `None` if there is nothing to remove, or if the axes are so nearly parallel that their
    /// common normal is farther than [`FARTHEST_NORMAL`] away: then they are taken as they are
    /// without beta.
    pub(super) fn new(alpha: f64, a: f64, beta: f64) -> Option<Self> {
        let (sin_alpha, cos_alpha) = alpha.sin_cos();
        let (sin_beta, cos_beta) = beta.sin_cos();
        let sin = sin_beta.hypot(sin_alpha * cos_beta);
        let cos = cos_alpha * cos_beta;
        // (8): from the origin behind to the foot of the common normal.
        let foot = a * sin_beta / (sin * sin);
        let is_near = foot.abs() <= FARTHEST_NORMAL;
        if sin_beta == 0.0 || !is_near {
            return None;
        }
        // (9): the unit common normal (x, y, 0), less than a right angle from the row's x.
        let sign = sign_of(sin_alpha * cos_beta);
        let (x, y) = (sign * sin_alpha * cos_beta / sin, sign * sin_beta / sin);
        let turn = (-y * cos_alpha).atan2(x * cos_beta + y * sin_alpha * sin_beta);
        Some(Self {
            before: (y.atan2(x), -foot * cos),
            alpha: (sign * sin).atan2(cos),
            a: a * x,
            behind: (turn, foot),
        })
    }
}
