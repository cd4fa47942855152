//! The circle about the wrist on which the end of the planar arm runs where sin theta_5 = 0 (eq.
//! 39).

use core::f64::consts::PI;

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::ThreeParallel;
use crate::kinematics::pose::angles::wrap;
use crate::kinematics::structure::planar_arm::PlanarArm;

/// Axis 5 on its way about the wrist: its angle from the line between axis 2 and the wrist, and
/// between which angles, on either side of the line, the end of the planar arm is in reach [rad].
pub(super) struct Circle {
    pub(super) from_line: f64,
    pub(super) least: f64,
    pub(super) most: f64,
}

impl Circle {
    /// About a wrist at (x, z) from axis 2, with the direction of axis 5; none where no place on it
    /// is nearer to axis 2 than another.
    pub(super) fn about(
        arm: &ThreeParallel,
        [x, z]: [f64; 2],
        [sin_phi, cos_phi]: [f64; 2],
    ) -> Option<Self> {
        let PlanarArm { c2, k, .. } = arm.planar;
        let (size, both) = (x.hypot(z), 2.0 * arm.d5 * x.hypot(z));
        let cosine = |r: f64| ((size * size + arm.d5 * arm.d5 - r * r) / both).clamp(-1.0, 1.0);
        (both > 0.0).then(|| Self {
            from_line: wrap(sin_phi.atan2(cos_phi) - x.atan2(z)),
            least: cosine(c2 - k).acos(),
            most: cosine(c2 + k).acos(),
        })
    }

    /// How far axis 5 is from the edges of reach [rad].
    pub(super) fn edges(&self) -> [f64; 2] {
        [self.least, self.most].map(|edge| edge.copysign(self.from_line) - self.from_line)
    }
}

impl ThreeParallel {
    /// [`Structure::corners`](super::Structure::corners) of joint 6.
    pub(super) fn corners_of_six(&self, q: &[f64; 6]) -> Option<[f64; 6]> {
        let [_, theta_2, theta_3, theta_4, theta_5, _] = self.joint_map.theta(q);
        let PlanarArm { c2, k, .. } = self.planar;
        let (theta_23, phi) = (theta_2 + theta_3, theta_2 + theta_3 + theta_4);
        let wrist = [
            c2 * theta_2.sin() + k * theta_23.sin() + self.d5 * phi.sin(),
            c2 * theta_2.cos() + k * theta_23.cos() + self.d5 * phi.cos(),
        ];
        let Circle { from_line, least, most } = Circle::about(self, wrist, [phi.sin(), phi.cos()])?;
        // phi + theta_6 is fixed at theta_5 = 0, phi - theta_6 at 180 deg.
        let sign = -self.joint_map.signs[5] * theta_5.cos().signum();
        Some([0.0, PI, least, -least, most, -most].map(|at| q[5] + sign * (at - from_line)))
    }
}
