//! The joint vectors of a YuMi with an arm angle, and with a configuration.

use core::f64::consts::{PI, TAU};

use alloc::vec::Vec;

use super::arm_angle::ArmAngle;
use super::arm_angle_search::{Found, MOST, Search};
use super::request::ConfigurationRequest;
use super::rule::Quarters;
use crate::error::{Error, JointFault, ModelFault, NoConfiguration};
use crate::kinematics::answer::check::{check_arm_angle, check_seed};
use crate::kinematics::answer::solutions::Solution;
use crate::kinematics::pose::{Pose, checked_pose};
use crate::kinematics::robot::Robot;
use crate::kinematics::solve::self_motion_curve::SelfMotion;
use crate::kinematics::thresholds::{CONFIGURATION_EDGE, TAUGHT_BEYOND_LIMITS};
use crate::report::{Configuration, ConfigurationRule, Explanation};

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
    /// The search follows the arm's self-motion from all solutions at angles of the last joint,
    /// then of the first, one degree apart. It may miss a self-motion that turns both by less.
    ///
    /// # Errors
    ///
    /// As [`Robot::arm_angle`] and [`Robot::ik_with`].
    pub fn ik_arm_angle(&self, pose: &Pose, arm_angle: f64) -> Result<Vec<Solution<7>>, Error> {
        check_arm_angle(arm_angle)?;
        let found = self.at_arm_angle_anywhere(&checked_pose(pose)?, arm_angle)?;
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
                self.having(&rule, &found.iter().flatten().copied(), wanted).is_some()
            };
            if !has_it(&found) {
                found = self.at_arm_angle(pose, arm_angle, first, Some(&found))?;
            }
            if let Some(having) = self.having(&rule, &found.iter().flatten().copied(), wanted) {
                return Ok(having.all(seed));
            }
        }
        // A self-motion that turns little inside the ranges may still be met from outside them.
        let found = self.at_arm_angle_anywhere(pose, arm_angle)?;
        match self.having(&rule, &found.iter().flatten().copied(), wanted) {
            Some(having) => Ok(having.all(seed)),
            None => Err(self.no_configuration_at(&rule, pose, wanted, arm_angle, &found)?),
        }
    }

    /// The reason why no joint vector has a configuration and an arm angle.
    fn no_configuration_at(
        &self,
        rule: &ConfigurationRule,
        pose: &Pose,
        wanted: Configuration,
        arm_angle: f64,
        found: &Found,
    ) -> Result<Error, Error> {
        let mut none = NoConfiguration { wanted, existing: Vec::new(), more: false, free: None };
        for solution in found.iter().flatten() {
            self.list_turns(rule, solution, &mut none);
        }
        if !none.existing.is_empty() {
            return Ok(Error::NoConfiguration(none));
        }
        Ok(Error::Unreachable(match self.explain_along_redundancy(pose)? {
            Explanation::Found { .. } => Explanation::NoArmAngle { arm_angle },
            other => other,
        }))
    }

    /// The joint vectors of a pose that have an arm angle, with any angle of the last joint and of
    /// the first.
    fn at_arm_angle_anywhere(&self, pose: &Pose, wanted: f64) -> Result<Found, Error> {
        let turn = [-PI, PI];
        let found = self.at_arm_angle(pose, wanted, turn, None)?;
        self.at_arm_angle(pose, wanted, turn, Some(&found))
    }

    /// The joint vectors of a pose that have an arm angle, with the last joint in a range, at most
    /// a turn; or, with what that search has found, with the first joint in a range.
    fn at_arm_angle(
        &self,
        pose: &Pose,
        wanted: f64,
        [from, to]: [f64; 2],
        before: Option<&Found>,
    ) -> Result<Found, Error> {
        let reference = self.arm_angle_reference()?;
        let found = before.copied().unwrap_or([None; MOST]);
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
