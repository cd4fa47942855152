//! The plane of the arm, rotated about axis 1 within its uncertainty.
//!
//! Near the shoulder singularity a rounding of the wrist's distance from axis 1 rotates the plane
//! by much more. For a pose at the edge of reach or at the wrist singularity, that edge or
//! singularity determines the plane.

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::ThreeParallel;
use super::wrist::{seen_from_plane, sin_5};
use crate::kinematics::structure::planar_arm::{Shoulder, Target};

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
    /// (eq. 44); not finite if there is none.
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
