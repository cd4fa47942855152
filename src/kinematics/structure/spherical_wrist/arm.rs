//! The arm where the pose leaves its shoulder open and a path does not.

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use core::f64::consts::PI;

use super::SphericalWrist;
use super::wrist::{forearm_to_flange, wrist};
use crate::kinematics::pose::angles::wrap;
use crate::kinematics::structure::free_choice::Trust;
use crate::kinematics::structure::planar_arm::{Elbow, Shoulder, Target};
use crate::kinematics::structure::zyz::Zyz;
use crate::kinematics::thresholds::SEEDED_FREE;

impl SphericalWrist {
    /// The shoulder and the wrist of one branch of the arm; on a path, where the pose leaves the shoulder's angle open, those that move the
    /// joints less: with the angle that joint 1 is heading for, or turned so that joint 4 has the one that it is heading for.
    pub(super) fn shoulder_and_wrist(
        &self,
        shoulder: &Shoulder,
        elbow: &Elbow,
        target: &Target<'_>,
        error: f64,
    ) -> (Shoulder, Zyz) {
        let with_wrist = |shoulder: Shoulder| {
            (shoulder, wrist(&forearm_to_flange(&shoulder, elbow, target.rotation), target, error))
        };
        let straight = with_wrist(*shoulder);
        let Some(turned) = self.turned_for_wrist(shoulder, elbow, target).map(with_wrist) else {
            return straight;
        };
        let motion = |(shoulder, wrist): &(Shoulder, Zyz)| {
            let [heading_1, _, _, heading_4, heading_5, heading_6] = target.free_theta;
            let [theta_4, theta_5, theta_6] = wrist.theta;
            let apart = |theta: f64, heading: f64| wrap(theta - heading).powi(2);
            let kept =
                apart(theta_4, heading_4) + apart(theta_5, heading_5) + apart(theta_6, heading_6);
            let flipped = apart(theta_4 + PI, heading_4)
                + apart(-theta_5, heading_5)
                + apart(theta_6 + PI, heading_6);
            apart(shoulder.sin_1.atan2(shoulder.cos_1), heading_1) + kept.min(flipped)
        };
        if motion(&turned) < motion(&straight) { turned } else { straight }
    }

    /// On a path, a shoulder whose angle the pose leaves open, turned so that the wrist can keep the joint 4 that it is heading for.
    ///
    /// With theta_23 and theta_4 known, `R = Rz(theta_1) A Ry(theta_5) Rz(theta_6)` has the height of the approach axis on both sides:
    /// `A20 sin theta_5 + A22 cos theta_5 = R22` (eq. 24), and theta_1 from its direction.
    fn turned_for_wrist(
        &self,
        shoulder: &Shoulder,
        elbow: &Elbow,
        target: &Target<'_>,
    ) -> Option<Shoulder> {
        if target.free.trust != Trust::Path || self.planar.b != 0.0 {
            return None;
        }
        let [_, _, _, theta_4, theta_5, _] = target.free_theta;
        let (sin_4, cos_4) = theta_4.sin_cos();
        let (a20, a22) = (-elbow.sin_23 * cos_4, elbow.cos_23);
        let height = target.rotation[(2, 2)] / a20.hypot(a22);
        if height.abs() > 1.0 {
            return None;
        }
        let (middle, spread) = (a20.atan2(a22), height.acos());
        let nearer = |a: f64, b: f64| if (theta_5 - a).cos() > (theta_5 - b).cos() { a } else { b };
        let (sin_5, cos_5) = nearer(middle + spread, middle - spread).sin_cos();
        let (x, y) = (elbow.cos_23 * cos_4 * sin_5 + elbow.sin_23 * cos_5, sin_4 * sin_5);
        let (to_x, to_y) = (target.rotation[(0, 2)], target.rotation[(1, 2)]);
        let (sin, cos) = (to_y * x - to_x * y, to_x * x + to_y * y);
        let norm = sin.hypot(cos);
        let turned = Shoulder { sin_1: sin / norm, cos_1: cos / norm, ..*shoulder };
        let turn = (turned.sin_1 * shoulder.cos_1 - turned.cos_1 * shoulder.sin_1)
            .hypot(1.0 - turned.sin_1 * shoulder.sin_1 - turned.cos_1 * shoulder.cos_1);
        // The wrist centre must not move by more than rounding or, where q1 is free, than the seed's radius.
        let open = if shoulder.x.abs() <= SEEDED_FREE {
            SEEDED_FREE
        } else {
            self.planar.position_rounding()
        };
        (norm > 0.0 && turn < 0.1 && turn * shoulder.x.abs() <= open).then_some(turned)
    }
}
