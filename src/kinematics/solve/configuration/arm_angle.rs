//! The arm angle of a YuMi: the seventh number that, with a pose, determines its joints.
//!
//! Reference: Elias and Wen, Redundancy Parameterization of the ABB YuMi Robot Arm,
//! arXiv:2505.23111, 2025. docs/guide/abb.md has the equations.

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};
use nalgebra::{Point3, Vector3};

use crate::kinematics::pose::Pose;
use crate::kinematics::pose::angles::wrap;
use crate::kinematics::robot::Robot;
use crate::kinematics::solve::self_motion_curve::Joints;
use crate::kinematics::thresholds::ARM_ANGLE_OFF;

/// The measure of the arm angle of a pose (docs/guide/abb.md, eq. A4).
pub(super) struct ArmAngle<'a> {
    robot: &'a Robot<7>,
    /// The unit vector from shoulder to wrist.
    toward_wrist: Vector3<f64>,
    /// Where the arm angle is zero: square to the plane of `toward_wrist` and the reference.
    zero: Vector3<f64>,
    /// Where it is a quarter turn: in that plane.
    quarter: Vector3<f64>,
}

impl<'a> ArmAngle<'a> {
    /// Return the measure for a pose; `None` if the wrist is at the shoulder, or straight along the
    /// reference.
    pub(super) fn of(robot: &'a Robot<7>, reference: [f64; 3], pose: &Pose) -> Option<Self> {
        let t_world_last = pose * (robot.mdh().flange * robot.tool()).inverse();
        let wrist = t_world_last * Point3::new(0.0, 0.0, -robot.mdh().rows[6].d);
        let [first, ..] = robot.link_frames(&[0.0; 7]).0;
        let along = wrist.coords - first.translation.vector;
        let toward_wrist = along.try_normalize(0.0)?;
        let reference = robot.base().rotation * Vector3::from(reference);
        // -er . (e x (e x h)) = h . (er - e (e . er)) and er . (e x h) = h . (er x e).
        let zero = reference.cross(&toward_wrist);
        let quarter = reference - toward_wrist * toward_wrist.dot(&reference);
        (zero.norm() > 0.0).then_some(Self { robot, toward_wrist, zero, quarter })
    }

    /// How far the arm angle of a joint vector is from a wanted one [rad]; `None` where it has none.
    pub(super) fn off(&self, q: &[f64; 7], wanted: f64) -> Option<f64> {
        self.at(q).map(|(angle, _)| wrap(angle - wanted))
    }

    /// The gradient of the arm angle, and how far it is from a wanted one [rad], for Newton's method.
    pub(super) fn seventh(&self, q: &Joints, wanted: f64) -> (Joints, f64) {
        match self.at(&(*q).into()) {
            Some((angle, gradient)) => (gradient, wrap(wanted - angle)),
            None => (Joints::zeros(), f64::NAN),
        }
    }

    /// Whether a joint vector has a wanted arm angle.
    pub(super) fn is_of(&self, q: &[f64; 7], wanted: f64) -> bool {
        self.off(q, wanted).is_some_and(|off| off.abs() <= ARM_ANGLE_OFF)
    }

    /// The arm angle of joint angles that reach the pose, and its gradient; `None` if axis 3 points
    /// from the shoulder to the wrist.
    pub(super) fn at(&self, q: &[f64; 7]) -> Option<(f64, Joints)> {
        let (frames, _) = self.robot.link_frames(q);
        let axis = |frame: &Pose| frame.rotation * Vector3::z();
        let elbow = axis(&frames[3]);
        let (sine, cosine) = (elbow.dot(&self.quarter), elbow.dot(&self.zero));
        let size = sine * sine + cosine * cosine;
        let mut gradient = Joints::zeros();
        for (joint, frame) in frames.iter().enumerate().take(3) {
            let turned = axis(frame).cross(&elbow);
            let (d_sine, d_cosine) = (turned.dot(&self.quarter), turned.dot(&self.zero));
            gradient[joint] = (cosine * d_sine - sine * d_cosine) / size;
        }
        let is_determined = elbow.cross(&self.toward_wrist).norm() > f64::EPSILON;
        is_determined.then(|| (sine.atan2(cosine), gradient))
    }
}
