//! The arm with a part of its wrist locked, and its motions at singularities: the wrist straight,
//! the elbow just not straight.

use core::f64::consts::PI;

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};
use nalgebra::{Matrix3, Rotation3, Vector3};

use super::SphericalWrist;
use super::arm::{forearm_to_flange, wrist_rotation};
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::pose::Pose;
use crate::kinematics::structure::end_frames::EndFrames;
use crate::kinematics::structure::free_choice::FreeChoice;
use crate::kinematics::structure::planar_arm::{Elbow, PlanarArm, Shoulder};
use crate::kinematics::structure::self_motions::{LockedWrist, SingularWrist};
use crate::kinematics::thresholds::{LEAST_LINK, LOCKED_CONVERGED};
use crate::report::FreeJoint;

/// How often the arm and a wrist with a locked part are solved in turn: each round shrinks the
/// error by the tool's length over the arm's.
const ROUNDS: usize = 60;

impl SphericalWrist {
    /// The joint vectors that bring a point of the tool to `point` with the wrist angles of `q`: up
    /// to four, with an unchanged wrist.
    ///
    /// With the wrist locked, forearm and tool are one link that ends at the point: the same arm
    /// with other a2, b and c3 (eq. 22).
    fn to_point(
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
        [0, 2, 4, 6].into_iter().filter_map(move |slot| {
            let [q1, q2, q3, ..] = branches.q[slot].or(branches.q[slot + 1])?;
            Some([q1, q2, q3, wrist[0], wrist[1], wrist[2]])
        })
    }

    /// The wrist angles with which the tool comes nearest to a rotation of the flange, with theta_4
    /// locked and perhaps theta_5: the approach axis in the plane that theta_5 moves it in, then
    /// the best rotation about it (eq. 23). They are exact if the plane contains that axis.
    fn with_nearest_wrist(
        &self,
        rotation: &Matrix3<f64>,
        q: &[f64; 6],
        locked: LockedWrist,
    ) -> [f64; 6] {
        if locked == LockedWrist::All {
            return *q;
        }
        let mut theta = self.theta(q);
        let [theta_1, theta_2, theta_3, ..] = theta;
        let ((sin_1, cos_1), (sin_23, cos_23)) = (theta_1.sin_cos(), (theta_2 + theta_3).sin_cos());
        let shoulder = Shoulder { sin_1, cos_1, x: 0.0, error: 0.0 };
        let elbow = Elbow { theta_2, theta_3, sin_23, cos_23 };
        // The flange's rotation in the forearm frame (eq. 14), turned back by theta_4.
        let n = forearm_to_flange(&shoulder, &elbow, rotation);
        let n = wrist_rotation(-theta[3], 0.0, 0.0) * n;
        if locked == LockedWrist::Axis4 {
            theta[4] = n[(0, 2)].atan2(n[(2, 2)]);
        }
        let (sin_5, cos_5) = theta[4].sin_cos();
        let cosine = n[(0, 0)] * cos_5 + n[(1, 1)] - n[(2, 0)] * sin_5;
        let sine = n[(1, 0)] - n[(0, 1)] * cos_5 + n[(2, 1)] * sin_5;
        theta[5] = sine.atan2(cosine);
        let [_, _, _, _, q5, q6] = self.joint_map.joints(theta);
        [q[0], q[1], q[2], q[3], q5, q6]
    }
}

impl SingularWrist<6> for SphericalWrist {
    fn wrist_pair(&self, q: &[f64; 6]) -> FreeJoint {
        self.free_wrist(self.theta(q)[4])
    }

    fn with_straight_wrist(&self, q: &[f64; 6], side: f64) -> [f64; 6] {
        let theta_5 = self.theta(q)[4];
        let straight = PI * (theta_5 / PI).round();
        let mut q = *q;
        q[4] += self.joint_map.signs[4] * (straight + side * 2.0 * f64::EPSILON - theta_5);
        q
    }

    fn with_bent_elbow(&self, q: &[f64; 6], behind: bool) -> [f64; 6] {
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

    fn axis_4_in_plane(&self, q: &[f64; 6]) -> f64 {
        let theta_4 = self.theta(q)[3];
        q[3] + self.joint_map.signs[3] * (PI * (theta_4 / PI).round() - theta_4)
    }

    /// Arm and wrist are solved in turn until both converge.
    fn with_locked_wrist(
        &self,
        end_frames: &EndFrames,
        limits: &JointLimits<6>,
        pose: &Pose,
        q: &[f64; 6],
        locked: LockedWrist,
    ) -> Option<[f64; 6]> {
        let rotation = end_frames.wrist_pose(pose).rotation;
        let (point, lever) = end_frames.tool_point(pose);
        let mut found = *q;
        for _ in 0..ROUNDS {
            let wrist = self.with_nearest_wrist(rotation.matrix(), &found, locked);
            let wrist = limits.wrapped_near(&wrist, &found)?;
            let distance =
                |q: &[f64; 6]| q.iter().zip(&wrist).map(|(a, b)| (a - b) * (a - b)).sum::<f64>();
            let next = self.to_point(&point, &lever, &wrist);
            let next = next.filter_map(|q| limits.wrapped_near(&q, &wrist));
            let next = next.min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
            let moved = next.iter().zip(&found).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            found = next;
            if moved < LOCKED_CONVERGED {
                break;
            }
        }
        Some(found)
    }
}
