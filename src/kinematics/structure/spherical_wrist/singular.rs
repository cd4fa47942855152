//! The motions of a search near singularities: the wrist at its singularity, the elbow just not
//! straight.

use core::f64::consts::PI;

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::SphericalWrist;
use crate::kinematics::pose::Pose;
use crate::kinematics::structure::planar_arm::PlanarArm;
use crate::kinematics::structure::singular_wrist::SingularWrist;
use crate::report::FreeJoint;

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
    fn sin_5(&self, q: &[f64; 6]) -> f64 {
        self.theta(q)[4].sin()
    }

    fn wrist_pair(&self, q: &[f64; 6]) -> FreeJoint {
        self.free_wrist(self.theta(q)[4])
    }

    fn with_straight_wrist(&self, q: &[f64; 6], side: f64) -> [f64; 6] {
        self.with_straight_wrist(q, side)
    }

    fn with_bent_elbow(&self, q: &[f64; 6], behind: bool) -> [f64; 6] {
        self.with_bent_elbow(q, behind)
    }

    fn with_wrist_of(&self, t_shoulder_wrist: &Pose, q: &[f64; 6], flipped: bool) -> [f64; 6] {
        let m = self.rotation_in_forearm(t_shoulder_wrist.rotation.matrix(), q);
        self.with_wrist(&m, q, flipped)
    }
}
