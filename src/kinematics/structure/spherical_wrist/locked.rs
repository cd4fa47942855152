//! The arm with its wrist locked, or with axis 4 locked: solved by a path that may deviate in
//! orientation.

use core::f64::consts::PI;

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};
use nalgebra::{Matrix3, Rotation3, Vector3};

use super::SphericalWrist;
use super::wrist::{forearm_to_flange, wrist_rotation};
use crate::kinematics::pose::Pose;
use crate::kinematics::structure::free_choice::FreeChoice;
use crate::kinematics::structure::planar_arm::{Elbow, PlanarArm, Shoulder};
use crate::kinematics::thresholds::LEAST_LINK;

impl SphericalWrist {
    /// The joint vectors that bring a point of the tool to `point` with the wrist angles of `q`: up
    /// to four, with an unchanged wrist.
    ///
    /// With the wrist locked, forearm and tool are one link that ends at the point: the same arm
    /// with other a2, b and c3 (eq. 22).
    pub(crate) fn to_point(
        &self,
        point: &Vector3<f64>,
        tool_in_wrist: &Vector3<f64>,
        q: &[f64; 6],
    ) -> impl Iterator<Item = [f64; 6]> {
        let theta = self.theta(q);
        let lever = wrist_rotation(theta[3], theta[4], theta[5]) * tool_in_wrist;
        let (a2, c3) = (self.planar.a2 + lever.x, self.planar.c3 + lever.z);
        // An offset due to rounding is zero: it would change how the shoulder's branches meet.
        let b = self.planar.b + lever.y;
        let b = if b.abs() <= self.planar.position_rounding() { 0.0 } else { b };
        let arm = Self {
            planar: PlanarArm { a2, b, c3, k: a2.hypot(c3).max(LEAST_LINK), ..self.planar },
            ..self.clone()
        };
        let still = Pose::from_parts((*point).into(), Rotation3::identity());
        let branches = arm.solve_wrist(&still, &FreeChoice::seed(*q));
        // Slots that differ in their last bit differ in the wrist of the point, which is not used.
        let wrist = [q[3], q[4], q[5]];
        [0, 2, 4, 6]
            .into_iter()
            .filter_map(move |slot| branches.q[slot].or(branches.q[slot + 1]))
            .map(move |found| {
                let [q1, q2, q3, ..] = found;
                [q1, q2, q3, wrist[0], wrist[1], wrist[2]]
            })
    }

    /// The wrist angles that give the flange the rotation `m` in the forearm frame (eq. 15 to 17),
    /// or the flipped ones.
    pub(crate) fn with_wrist(&self, m: &Matrix3<f64>, q: &[f64; 6], flipped: bool) -> [f64; 6] {
        let theta_4 = m[(1, 2)].atan2(m[(0, 2)]) + if flipped { PI } else { 0.0 };
        let mut q = *q;
        q[3] += self.joint_map.signs[3] * (theta_4 - self.theta(&q)[3]);
        self.with_axis_4_locked(m, &q)
    }

    /// The wrist angles with which the tool comes nearest to the rotation `m` of the flange in the
    /// forearm frame, with theta_4 locked: the approach axis in the plane that theta_5 moves it in,
    /// then the best rotation about it (eq. 23). They are exact if the plane contains that axis.
    pub(crate) fn with_axis_4_locked(&self, m: &Matrix3<f64>, q: &[f64; 6]) -> [f64; 6] {
        let mut theta = self.theta(q);
        let n = wrist_rotation(-theta[3], 0.0, 0.0) * m;
        theta[4] = n[(0, 2)].atan2(n[(2, 2)]);
        self.with_best_turn(theta, &n, q)
    }

    /// The same with theta_5 locked too: only the best rotation.
    pub(crate) fn with_axes_4_and_5_locked(&self, m: &Matrix3<f64>, q: &[f64; 6]) -> [f64; 6] {
        let theta = self.theta(q);
        self.with_best_turn(theta, &(wrist_rotation(-theta[3], 0.0, 0.0) * m), q)
    }

    /// The rotation about the approach axis that comes nearest to `n` with theta_5 unchanged (eq.
    /// 23).
    fn with_best_turn(&self, mut theta: [f64; 6], n: &Matrix3<f64>, q: &[f64; 6]) -> [f64; 6] {
        let (sin_5, cos_5) = theta[4].sin_cos();
        let cosine = n[(0, 0)] * cos_5 + n[(1, 1)] - n[(2, 0)] * sin_5;
        let sine = n[(1, 0)] - n[(0, 1)] * cos_5 + n[(2, 1)] * sin_5;
        theta[5] = sine.atan2(cosine);
        let [_, _, _, _, q5, q6] = self.joint_map.joints(theta);
        [q[0], q[1], q[2], q[3], q5, q6]
    }

    /// The flange's rotation in the forearm frame, for the arm angles of `q` (eq. 14).
    pub(crate) fn rotation_in_forearm(
        &self,
        rotation: &Matrix3<f64>,
        q: &[f64; 6],
    ) -> Matrix3<f64> {
        let [theta_1, theta_2, theta_3, ..] = self.theta(q);
        let ((sin_1, cos_1), (sin_23, cos_23)) = (theta_1.sin_cos(), (theta_2 + theta_3).sin_cos());
        let shoulder = Shoulder { sin_1, cos_1, x: 0.0, error: 0.0 };
        forearm_to_flange(&shoulder, &Elbow { theta_2, theta_3, sin_23, cos_23 }, rotation)
    }
}
