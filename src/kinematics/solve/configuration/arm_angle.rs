//! The arm angle of a YuMi: the seventh number that, with a pose, determines its joints.
//!
//! Reference: Elias and Wen, Redundancy Parameterization of the ABB YuMi Robot Arm,
//! arXiv:2505.23111, 2025. docs/abb.md has the equations.

use core::f64::consts::{PI, TAU};

use alloc::vec::Vec;

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};
use nalgebra::{Point3, Vector3};

use super::arm_angle_search::{Found, MOST, Search};
use super::request::ConfigurationRequest;
use super::rule::Quarters;
use crate::error::{Error, JointFault, ModelFault, NoConfiguration};
use crate::kinematics::answer::check::{check_angle, check_seed};
use crate::kinematics::answer::solutions::Solution;
use crate::kinematics::pose::{Pose, checked_pose};
use crate::kinematics::robot::Robot;
use crate::kinematics::solve::self_motion_curve::{Joints, SelfMotion};
use crate::kinematics::thresholds::{CONFIGURATION_EDGE, TAUGHT_BEYOND_LIMITS};
use crate::report::{Configuration, ConfigurationRule, Explanation};

/// What the arm angle of a pose is measured by (docs/abb.md, eq. A4).
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
    /// That of a pose; `None` if the wrist is at the shoulder, or straight along the reference.
    fn of(robot: &'a Robot<7>, reference: [f64; 3], pose: &Pose) -> Option<Self> {
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

impl Robot<7> {
    /// The arm angle of joint angles [rad], as a YuMi's controller has it in the `eax_a` of a
    /// robtarget; `None` where the arm leaves it undetermined.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidJoints`] when an angle is not finite; [`Error::InvalidModel`] for an arm
    /// that is not a YuMi of the catalog.
    pub fn arm_angle(&self, q: &[f64; 7]) -> Result<Option<f64>, Error> {
        let reference = self.arm_angle_reference()?;
        check_seed("q", q)?;
        let pose = self.fk(q);
        let angle = ArmAngle::of(self, reference, &pose);
        Ok(angle.and_then(|angle| angle.at(q)).map(|(angle, _)| angle))
    }

    /// Every joint vector that brings the tool to `pose` with an arm angle [rad], inside the limits
    /// or not.
    ///
    /// The search follows the arm's self-motion from all solutions at angles of the last joint, then
    /// of the first joint, one degree apart. It may miss a self-motion that turns both by less.
    ///
    /// # Errors
    ///
    /// As [`Robot::arm_angle`] and [`Robot::ik_with`].
    pub fn ik_arm_angle(&self, pose: &Pose, arm_angle: f64) -> Result<Vec<Solution<7>>, Error> {
        check_angle("arm_angle", 7, arm_angle)?;
        let (pose, turn) = (checked_pose(pose)?, [-PI, PI]);
        let found = self.at_arm_angle(&pose, arm_angle, turn, None)?;
        let found = self.at_arm_angle(&pose, arm_angle, turn, Some(found))?;
        Ok(found.into_iter().flatten().collect())
    }

    /// Every joint vector that has the configuration and the arm angle of a request, the nearest to
    /// a seed first.
    pub(in crate::kinematics::solve) fn configured_list(
        &self,
        pose: &Pose,
        request: &ConfigurationRequest<7>,
        seed: &[f64; 7],
    ) -> Result<Vec<Solution<7>>, Error> {
        let (rule, wanted) = (self.configuration_rule()?, request.configuration);
        wanted.check(false)?;
        let arm_angle = request.arm_angle.ok_or(JointFault::MissingArmAngle)?;
        let [first, _, last] = Quarters::of(&rule).ranges(wanted, CONFIGURATION_EDGE);
        let limits = self.limits().widened(TAUGHT_BEYOND_LIMITS).narrowed(&[first, last]);
        if let Some([first, .., last]) = limits.map(|limits| limits.to_array()) {
            let mut found = self.at_arm_angle(pose, arm_angle, last, None)?;
            let has_it = |found: &Found| {
                self.having(&rule, found.iter().flatten().copied(), wanted).is_some()
            };
            if !has_it(&found) {
                found = self.at_arm_angle(pose, arm_angle, first, Some(found))?;
            }
            if let Some(having) = self.having(&rule, found.iter().flatten().copied(), wanted) {
                return Ok(having.all(seed));
            }
        }
        Err(self.no_configuration_at(&rule, pose, wanted, arm_angle)?)
    }

    /// The reason why no joint vector has a configuration and an arm angle.
    fn no_configuration_at(
        &self,
        rule: &ConfigurationRule,
        pose: &Pose,
        wanted: Configuration,
        arm_angle: f64,
    ) -> Result<Error, Error> {
        let mut none = NoConfiguration { wanted, existing: Vec::new(), more: false, free: None };
        for solution in self.ik_arm_angle(pose, arm_angle)? {
            self.list_turns(rule, &solution, &mut none);
        }
        if !none.existing.is_empty() {
            return Ok(Error::NoConfiguration(none));
        }
        Ok(Error::Unreachable(match self.explain_along_redundancy(pose)? {
            Explanation::Found { .. } => Explanation::NoArmAngle { arm_angle },
            other => other,
        }))
    }

    /// The joint vectors of a pose that have an arm angle, with the last joint in a range, at most
    /// a turn; or, with what that search has found, with the first joint in a range.
    fn at_arm_angle(
        &self,
        pose: &Pose,
        wanted: f64,
        [from, to]: [f64; 2],
        before: Option<Found>,
    ) -> Result<Found, Error> {
        let reference = self.arm_angle_reference()?;
        let found = before.unwrap_or([None; MOST]);
        let Some(angle) = ArmAngle::of(self, reference, pose) else { return Ok(found) };
        let first = before.map(|_| self.given(1, 0.0)).transpose()?;
        let curve = SelfMotion { robot: self, pose, rounding: self.rounding() };
        let mut search = Search { curve, angle, wanted, first, found };
        search.run([from, to.min(from + TAU)])?;
        Ok(search.found)
    }

    fn arm_angle_reference(&self) -> Result<[f64; 3], Error> {
        match self.own_rule() {
            Some(ConfigurationRule::ArmAngle { reference }) => Ok(reference),
            _ => Err(ModelFault::NoArmAngle.into()),
        }
    }
}
