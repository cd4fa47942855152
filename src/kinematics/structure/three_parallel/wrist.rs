//! The wrist: the angles of joints 5 and 6, the direction of axis 5 in the plane of the arm, and the
//! plane rotated about axis 1 within its uncertainty.
//!
//! Near the shoulder singularity a rounding of the wrist's distance from axis 1 rotates the plane
//! by much more. For a pose at the edge of reach or at the wrist singularity, that edge or
//! singularity determines the plane.

use core::f64::consts::PI;

use nalgebra::Matrix3;
#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::geometry::ThreeParallel;
use crate::kinematics::pose::angles::wrap;
use crate::kinematics::structure::free_choice::{FreeChoice, SeedPolicy};
use crate::kinematics::structure::planar_arm::{Shoulder, Target};
use crate::kinematics::thresholds::{PATH_WRIST_SIN, SEEDED_FREE, WRIST_FREE_SIN};

/// One configuration of the wrist.
#[derive(Clone, Copy)]
pub(super) struct Wrist {
    pub(super) theta_5: f64,
    pub(super) theta_6: f64,
    /// Direction of axis 5 in the plane of the arm, phi = theta_2 + theta_3 + theta_4.
    pub(super) sin_phi: f64,
    pub(super) cos_phi: f64,
}

/// How joint 6 is chosen.
#[derive(Clone, Copy)]
pub(super) enum Turn {
    /// As the pose determines it, with theta_5 in 0 ..= pi, or half a turn from there.
    FromPose { flipped: bool },
    /// At this theta_6.
    Taken(f64),
    /// At this theta_6 or, as the pose does not determine it, at the nearest one with which the arm
    /// reaches.
    Free(f64),
}

/// `Rz(-theta_1) R`, which is `Ry(phi) Rz(theta_5) Ry(theta_6)` (eq. 33).
pub(super) fn seen_from_plane(shoulder: &Shoulder, rotation: &Matrix3<f64>) -> Matrix3<f64> {
    let (r0, r1, r2) = (rotation.row(0), rotation.row(1), rotation.row(2));
    Matrix3::from_rows(&[
        r0 * shoulder.cos_1 + r1 * shoulder.sin_1,
        r1 * shoulder.cos_1 - r0 * shoulder.sin_1,
        r2.into_owned(),
    ])
}

/// sin theta_5, not negative (eq. 34).
pub(super) fn sin_5(m: &Matrix3<f64>) -> f64 {
    m[(1, 0)].hypot(m[(1, 2)])
}

impl Turn {
    /// How far joint 6 may turn from there without moving the tool off the pose by more than
    /// rounding [rad].
    pub(super) fn uncertainty(self, m: &Matrix3<f64>) -> f64 {
        match self {
            Self::FromPose { .. } => (WRIST_FREE_SIN / sin_5(m)).min(PI),
            Self::Taken(_) => 0.0,
            Self::Free(_) => PI,
        }
    }

    /// theta_6 with its sine and cosine. `error` is how far rounding may rotate the plane of the
    /// arm: within that uncertainty a path keeps the theta_6 that it is heading for.
    fn theta_6(
        self,
        m: &Matrix3<f64>,
        free: &FreeChoice<6>,
        heading: f64,
        error: f64,
    ) -> (f64, (f64, f64)) {
        let flipped = match self {
            Self::Taken(theta_6) | Self::Free(theta_6) => return (theta_6, theta_6.sin_cos()),
            Self::FromPose { flipped } => flipped,
        };
        let sin_5 = sin_5(m);
        let (from_pose, sign) = (m[(1, 2)].atan2(m[(1, 0)]), if flipped { -1.0 } else { 1.0 });
        let from_pose = if flipped { from_pose + PI } else { from_pose };
        if free.policy == SeedPolicy::Path && sin_5 <= PATH_WRIST_SIN {
            let ahead = wrap(heading - from_pose);
            if sin_5 * ahead.sin().abs() <= error.max(SEEDED_FREE) && ahead.cos() > 0.0 {
                return (from_pose + ahead, heading.sin_cos());
            }
        }
        (from_pose, (sign * m[(1, 2)] / sin_5, sign * m[(1, 0)] / sin_5))
    }

    /// The wrist with joint 6 there (eq. 34 to 36). Computing theta_5 and phi from the sine and
    /// cosine of the chosen theta_6 keeps the residual at rounding near theta_5 = 0, whatever
    /// theta_6 is.
    pub(super) fn wrist(
        self,
        m: &Matrix3<f64>,
        free: &FreeChoice<6>,
        heading: f64,
        error: f64,
    ) -> Wrist {
        let (theta_6, (sin_6, cos_6)) = self.theta_6(m, free, heading, error);
        let projected = cos_6 * m[(1, 0)] + sin_6 * m[(1, 2)];
        let sin_5 = if projected.abs() <= WRIST_FREE_SIN { projected.max(0.0) } else { projected };
        let (sin_phi, cos_phi) =
            (cos_6 * m[(0, 2)] - sin_6 * m[(0, 0)], cos_6 * m[(2, 2)] - sin_6 * m[(2, 0)]);
        let length = sin_phi.hypot(cos_phi);
        Wrist {
            theta_5: sin_5.atan2(m[(1, 1)]),
            theta_6,
            sin_phi: sin_phi / length,
            cos_phi: cos_phi / length,
        }
    }
}

/// The planes within the uncertainty: those rotated from the shoulder's by angles in `open` [rad]
/// (eq. 42).
pub(super) struct PlaneUncertainty<'a> {
    shoulder: &'a Shoulder,
    wxy: [f64; 2],
    open: [f64; 2],
    /// (m10, m12), and the direction in which a rotation of the plane moves it, (m00, m02).
    determined: [f64; 2],
    moved: [f64; 2],
}

impl<'a> PlaneUncertainty<'a> {
    pub(super) fn of(arm: &ThreeParallel, shoulder: &'a Shoulder, target: &Target<'_>) -> Self {
        let m = seen_from_plane(shoulder, target.rotation);
        Self {
            shoulder,
            wxy: target.wxy,
            open: arm.planar.rotation_range(shoulder, target.wxy),
            determined: [m[(1, 0)], m[(1, 2)]],
            moved: [m[(0, 0)], m[(0, 2)]],
        }
    }

    /// The shoulder rotated by `angle` about axis 1, with the wrist unchanged.
    pub(super) fn rotated(&self, angle: f64) -> Shoulder {
        self.shoulder.rotated(angle, self.wxy)
    }

    /// The angles of the planes at either end, the one that is farther from axis 1 last.
    pub(super) fn ends(&self) -> [f64; 2] {
        self.open
    }

    /// The shoulder rotated to where the wrist is nearest to its singularity, and sin theta_5 there
    /// (eq. 43).
    pub(super) fn nearest_to_wrist(&self, target: &Target<'_>) -> (Shoulder, f64) {
        let Self { determined: [m10, m12], moved: [m00, m02], open: [least, most], .. } = *self;
        let to_wrist = (m10 * m00 + m12 * m02) / (m00 * m00 + m02 * m02);
        let nearest = self.rotated(to_wrist.clamp(least, most));
        let sin_5 = sin_5(&seen_from_plane(&nearest, target.rotation));
        (nearest, sin_5)
    }

    /// The rotation with which the pose determines joint 6 to be `theta_6`, or half a turn from it;
    /// `None` if that exceeds the uncertainty (eq. 44).
    pub(super) fn determining(&self, theta_6: f64) -> Option<f64> {
        let ([least, most], angle) = (self.open, self.towards(theta_6));
        (angle >= least && angle <= most).then_some(angle)
    }

    /// The shoulder rotated towards where the pose determines joint 6 to be `theta_6`, or half a
    /// turn from it, within the uncertainty.
    pub(super) fn nearest_to_determining(&self, theta_6: f64) -> Shoulder {
        let ([least, most], angle) = (self.open, self.towards(theta_6));
        if angle.is_nan() { *self.shoulder } else { self.rotated(angle.clamp(least, most)) }
    }

    /// The rotation with which the pose determines joint 6 to be `theta_6`, or half a turn from it
    /// (eq. 44); not finite where no rotation does.
    fn towards(&self, theta_6: f64) -> f64 {
        let (sin_6, cos_6) = theta_6.sin_cos();
        let Self { determined: [m10, m12], moved: [m00, m02], .. } = self;
        (m12 * cos_6 - m10 * sin_6) / (m02 * cos_6 - m00 * sin_6)
    }

    /// The greatest rotation, either way [rad].
    fn widest(&self) -> f64 {
        self.open[1].max(-self.open[0])
    }

    /// How far the direction of axis 5 may rotate within the uncertainty of the plane [rad].
    pub(super) fn phi_uncertainty(&self) -> f64 {
        let (open, sin_5) = (self.widest(), self.determined[0].hypot(self.determined[1]));
        if sin_5 > 2.0 * open { 2.0 * open / sin_5 } else { 2.0 }
    }

    /// How far the end of the planar arm may move within the uncertainty of the plane [m].
    pub(super) fn lever(&self, arm: &ThreeParallel) -> f64 {
        self.widest() * self.wxy[0].hypot(self.wxy[1]) + arm.d5 * self.phi_uncertainty()
    }
}
