//! The arm with a part of its wrist locked, and its motions at singularities: the wrist straight,
//! the elbow just not straight.

use core::f64::consts::PI;

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};
use nalgebra::{Matrix3, Rotation3, Vector3};

use super::SphericalWrist;
use super::arm::{forearm_to_flange, wrist_rotation};
use crate::kinematics::pose::Pose;
use crate::kinematics::structure::free_choice::FreeChoice;
use crate::kinematics::structure::planar_arm::{Elbow, PlanarArm, Shoulder};
use crate::kinematics::structure::singular_wrist::SingularWrist;
use crate::kinematics::thresholds::LEAST_LINK;
use crate::report::FreeJoint;

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

    /// The wrist angles with which the tool comes nearest to the rotation `m` of the flange in the
    /// forearm frame, with theta_4 locked: the approach axis in the plane that theta_5 moves it in,
    /// then the best rotation about it (eq. 23). They are exact if the plane contains that axis.
    pub(crate) fn with_axis_4_locked(&self, m: &Matrix3<f64>, q: &[f64; 6]) -> [f64; 6] {
        let mut theta = self.theta(q);
        let n = wrist_rotation(-theta[3], 0.0, 0.0) * m;
        theta[4] = n[(0, 2)].atan2(n[(2, 2)]);
        self.with_best_turn(theta, &n, q)
    }

    /// [`Self::with_axis_4_locked`] with theta_5 locked too: only the best rotation.
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

impl SphericalWrist {
    /// `q` with joint 5 at its singularity, on one or the other side of it by the least amount that
    /// is still distinguished.
    pub(crate) fn with_straight_wrist(&self, q: &[f64; 6], side: f64) -> [f64; 6] {
        let theta_5 = self.theta(q)[4];
        let straight = PI * (theta_5 / PI).round();
        let mut q = *q;
        q[4] += self.joint_map.signs[4] * (straight + side * 2.0 * f64::EPSILON - theta_5);
        q
    }

    /// `q` with an elbow that is just not straight, behind the lower arm or in front of it.
    pub(crate) fn with_bent_elbow(&self, q: &[f64; 6], behind: bool) -> [f64; 6] {
        let PlanarArm { c2, k, .. } = self.planar;
        let elbow = self.planar.elbow_angle(self.theta(q)[2]);
        let straight = PI * (elbow / PI).round();
        let r = (c2 + k * straight.cos()).abs();
        let bend = 1.1 * (self.planar.straight_m2(r).sqrt() / (c2 * k));
        let side = if behind { -straight.cos() } else { straight.cos() };
        let mut q = *q;
        q[2] += self.joint_map.signs[2] * (straight + side * bend - elbow);
        q
    }
}

impl SingularWrist<6> for SphericalWrist {
    fn wrist_pair(&self, q: &[f64; 6]) -> FreeJoint {
        self.free_wrist(self.theta(q)[4])
    }

    fn with_straight_wrist(&self, q: &[f64; 6], side: f64) -> [f64; 6] {
        self.with_straight_wrist(q, side)
    }
}
