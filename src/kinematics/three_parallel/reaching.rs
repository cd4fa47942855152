//! An arm that brings its wrist to where the pose wants it, and what rounding leaves open of that.

use core::f64::consts::PI;

use nalgebra::Matrix3;
#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::ThreeParallel;
use super::wrist::{Turn, Wrist, seen_from_plane, sin_5};
use crate::kinematics::angles::wrap;
use crate::kinematics::free_choice::FreeChoice;
use crate::kinematics::planar_arm::{Elbows, PlanarArm, Shoulder};
use crate::kinematics::status::Reach;
use crate::kinematics::thresholds::WRIST_FREE_SIN;

/// What a solve is asked.
pub(super) struct Target<'a> {
    pub(super) wxy: [f64; 2],
    pub(super) wz: f64,
    pub(super) rotation: &'a Matrix3<f64>,
    pub(super) free: &'a FreeChoice<6>,
    pub(super) free_theta: [f64; 6],
    /// How far beyond reach the arm's end may be and still get the stretched or folded arm [m].
    pub(super) tolerance: f64,
}

/// A shoulder and a wrist with the elbows between them.
pub(super) struct Reaching {
    pub(super) shoulder: Shoulder,
    pub(super) wrist: Wrist,
    pub(super) elbows: Elbows,
}

impl ThreeParallel {
    /// The arm with this shoulder and joint 6 there; where that is out of reach, with both moved towards reach as far as the pose leaves
    /// them open: joint 6 by `open` [rad], the shoulder by rounding.
    pub(super) fn reaching(&self, shoulder: &Shoulder, turn: Turn, open: f64, target: &Target<'_>) -> Result<Reaching, Reach> {
        let missed = match self.at(*shoulder, turn, target) {
            Ok(reaching) => return Ok(reaching),
            Err((missed, wrist)) => (missed, wrist),
        };
        let nearer = |a: (Reach, Wrist), b: (Reach, Wrist)| if b.0.shortfall() < a.0.shortfall() { b } else { a };
        let m = seen_from_plane(shoulder, target.rotation);
        let missed = match self.turned_into_reach(shoulder, &m, &missed.1, open, target) {
            None => missed,
            Some(theta_6) => match self.at(*shoulder, Turn::Taken(theta_6), target) {
                Ok(reaching) => return Ok(reaching),
                Err(turned) => nearer(missed, turned),
            },
        };
        let Wrist { sin_phi, cos_phi, .. } = missed.1;
        let (behind, above) = (self.planar.a1 + self.d5 * sin_phi, target.wz - self.d5 * cos_phi);
        let eased = self.planar.eased(shoulder, target.wxy, behind, above);
        self.at(eased, turn, target).map_err(|eased| nearer(missed, eased).0)
    }

    /// How far joint 6 may be turned without the tool's leaving the pose by more than rounding [rad].
    pub(super) fn open(shoulder: &Shoulder, m: &Matrix3<f64>) -> f64 {
        ((WRIST_FREE_SIN + shoulder.error) / sin_5(m)).min(PI)
    }

    /// The elbows of the end of the planar arm (eq. 37, 38), or how far it is out of reach.
    fn at(&self, shoulder: Shoulder, turn: Turn, target: &Target<'_>) -> Result<Reaching, (Reach, Wrist)> {
        let m = seen_from_plane(&shoulder, target.rotation);
        let wrist = turn.wrist(&m, target.free, target.free_theta[5], WRIST_FREE_SIN + shoulder.error);
        let end = [shoulder.x - self.planar.a1 - self.d5 * wrist.sin_phi, target.wz - self.d5 * wrist.cos_phi];
        match self.planar.elbows(end, target.tolerance, target.free_theta[1], target.free.trust) {
            Ok(elbows) => Ok(Reaching { shoulder, wrist, elbows }),
            Err(missed) => Err((missed, wrist)),
        }
    }

    /// theta_6 moved by `open` at most to where the end of the planar arm is in reach, or nearest to it: at sin theta_5 = 0 it runs on a
    /// circle about the wrist (eq. 39).
    fn turned_into_reach(&self, shoulder: &Shoulder, m: &Matrix3<f64>, wrist: &Wrist, open: f64, target: &Target<'_>) -> Option<f64> {
        let PlanarArm { a1, c2, k, .. } = self.planar;
        let (x, z) = (shoulder.x - a1, target.wz);
        let (size, both) = (x.hypot(z), 2.0 * self.d5 * x.hypot(z));
        if both == 0.0 {
            return None;
        }
        let cosine = |r: f64| ((size * size + self.d5 * self.d5 - r * r) / both).clamp(-1.0, 1.0);
        let (least, most) = (cosine(c2 - k).acos(), cosine(c2 + k).acos());
        let from_line = wrap(wrist.sin_phi.atan2(wrist.cos_phi) - x.atan2(z));
        let turned = from_line.abs().clamp(least, most).copysign(from_line) - from_line;
        // phi + theta_6 is fixed at theta_5 = 0, phi - theta_6 at 180 deg.
        let turned = if m[(1, 1)] > 0.0 { -turned } else { turned };
        (turned.abs() <= open).then_some(wrist.theta_6 + turned)
    }
}
