//! The joint vectors of a YuMi with an arm angle, and with a configuration.

use core::f64::consts::TAU;

use alloc::vec::Vec;

use super::arm_angle::ArmAngle;
use super::arm_angle_search::{MOST, Members, Search};
use super::having::BEYOND;
use super::rule::Quarters;
use crate::error::{Error, JointFault, ModelFault};
use crate::kinematics::answer::check::check_seed;
use crate::kinematics::answer::request::ConfigurationRequest;
use crate::kinematics::answer::solutions::Solution;
use crate::kinematics::pose::Pose;
use crate::kinematics::robot::Robot;
use crate::kinematics::robot::joints::{Configured, Redundancy as _};
use crate::kinematics::solve::configuration::fault::NoConfiguration;
use crate::kinematics::solve::self_motion_curve::Joints;
use crate::kinematics::solve::self_motion_curve::SelfMotion;
use crate::kinematics::thresholds::{CONFIGURATION_EDGE, TAUGHT_BEYOND_LIMITS};
use crate::report::{Configuration, ConfigurationRule, Explanation};

/// The joint, from 1, that is searched besides the last and the first: ABB's axis 7. Where axis 3
/// is at -90 deg, axes 7 and 4 are one line and turn with the last and the first joint standing
/// still.
const BETWEEN: usize = 3;

/// Largest step of a joint that counts as one on the way [rad].
const LARGEST_STEP: f64 = 0.2;

/// A turn of a joint [rad]. Its ends are no angle at which axes of the arm are parallel.
const AROUND: [f64; 2] = [1.0 - TAU, 1.0];

impl Configured<7> for Robot<7> {
    fn arm_angle_of(&self, q: &[f64; 7]) -> Result<Option<f64>, Error> {
        let reference = self.arm_angle_reference()?;
        check_seed("q", q)?;
        let pose = self.fk(q);
        let angle = ArmAngle::of(self, reference, &pose);
        Ok(angle.and_then(|angle| angle.at(q)).map(|(angle, _)| angle))
    }

    fn at_arm_angle(&self, pose: &Pose, arm_angle: f64) -> Result<Vec<Solution<7>>, Error> {
        Ok(self.at_arm_angle_anywhere(pose, arm_angle)?.into_iter().flatten().collect())
    }

    fn step_to(&self, from: &[f64; 7], pose: &Pose, wanted: f64) -> Option<[f64; 7]> {
        let angle = ArmAngle::of(self, self.arm_angle_reference().ok()?, pose)?;
        let curve = SelfMotion { robot: self, pose, rounding: self.rounding() };
        let q = curve.newton(Joints::from(*from), |q| angle.seventh(q, wanted))?.joints();
        let is_small = from.iter().zip(&q).all(|(from, to)| (to - from).abs() <= LARGEST_STEP);
        (is_small && angle.is_of(&q, wanted)).then_some(q)
    }

    fn configured_list(
        &self,
        pose: &Pose,
        request: &ConfigurationRequest<7>,
        seed: &[f64; 7],
    ) -> Result<Vec<Solution<7>>, Error> {
        let (rule, wanted) = (self.configuration_rule()?, request.configuration);
        wanted.check(false)?;
        let arm_angle = request.arm_angle.ok_or(JointFault::MissingArmAngle)?;
        let mut found = [None; MOST];
        let having = |found: &Members| self.having_at(&rule, pose, found, request, seed);
        let [first, _, last] = Quarters::of(&rule).ranges(wanted, CONFIGURATION_EDGE);
        let limits = self.limits().widened(TAUGHT_BEYOND_LIMITS).narrowed(&[first, last]);
        if let Some([first, .., last]) = limits.map(|limits| limits.to_array()) {
            for (joint, range) in [(7, last), (BETWEEN, AROUND), (1, first)] {
                self.search_arm_angle(pose, arm_angle, joint, range, &mut found)?;
                if joint != 7
                    && let Some(all) = having(&found)
                {
                    return Ok(all);
                }
            }
        }
        // A self-motion that turns little inside the ranges may still be met from outside them.
        let found = self.at_arm_angle_anywhere(pose, arm_angle)?;
        match having(&found) {
            Some(all) => Ok(all),
            None => Err(self.no_configuration_at(&rule, pose, wanted, arm_angle, &found)?),
        }
    }
}

impl Robot<7> {
    /// Return the joint vectors of a pose and arm angle that have a configuration, the nearest to
    /// a seed first; of a self-motion the member nearest to it.
    fn having_at(
        &self,
        rule: &ConfigurationRule,
        pose: &Pose,
        found: &Members,
        request: &ConfigurationRequest<7>,
        seed: &[f64; 7],
    ) -> Option<Vec<Solution<7>>> {
        let (wanted, arm_angle) = (request.configuration, request.arm_angle?);
        let angle = ArmAngle::of(self, self.arm_angle_reference().ok()?, pose)?;
        let has_arm_angle = |q: &[f64; 7]| angle.is_of(q, arm_angle);
        let curve = SelfMotion { robot: self, pose, rounding: self.rounding() };
        BEYOND.into_iter().find_map(|beyond| {
            let inside = [0.0, CONFIGURATION_EDGE].map(|edge| {
                let ranges = Quarters::of(rule).ranges(wanted, edge);
                self.limits().widened(beyond).narrowed(&ranges)
            });
            let member = |solution: &Solution<7>| {
                let nearest = |limits| curve.member_nearest(solution, limits, seed, has_arm_angle);
                let is_free = solution.free_joint.is_some();
                let member = is_free.then(|| inside.iter().flatten().find_map(nearest)).flatten();
                member.unwrap_or(*solution)
            };
            let members = found.iter().flatten().map(member);
            self.having(rule, &members, wanted, beyond).map(|having| having.all(seed))
        })
    }

    /// The reason why no joint vector has a configuration and an arm angle.
    fn no_configuration_at(
        &self,
        rule: &ConfigurationRule,
        pose: &Pose,
        wanted: Configuration,
        arm_angle: f64,
        found: &Members,
    ) -> Result<Error, Error> {
        let free = found.iter().flatten().find_map(|solution| solution.free_joint);
        let mut none = NoConfiguration { wanted, existing: Vec::new(), more: false, free };
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

    /// The joint vectors of a pose that have an arm angle, by every search.
    fn at_arm_angle_anywhere(&self, pose: &Pose, wanted: f64) -> Result<Members, Error> {
        let mut found = [None; MOST];
        for joint in [7, 1, BETWEEN] {
            self.search_arm_angle(pose, wanted, joint, AROUND, &mut found)?;
        }
        Ok(found)
    }

    /// Search the joint vectors of a pose that have an arm angle, with sections of a joint, from 1,
    /// in a range of at most a turn.
    fn search_arm_angle(
        &self,
        pose: &Pose,
        wanted: f64,
        joint: usize,
        [from, to]: [f64; 2],
        found: &mut Members,
    ) -> Result<(), Error> {
        let reference = self.arm_angle_reference()?;
        if self.lock().is_some() {
            return Err(ModelFault::NoArmAngle.into());
        }
        let Some(angle) = ArmAngle::of(self, reference, pose) else { return Ok(()) };
        let locked = (joint != 7).then(|| self.locked(joint, from)).transpose()?;
        let curve = SelfMotion { robot: self, pose, rounding: self.rounding() };
        let mut search = Search { curve, angle, wanted, locked, found: *found };
        search.run([from, to.min(from + TAU)])?;
        *found = search.found;
        Ok(())
    }

    pub(super) fn arm_angle_reference(&self) -> Result<[f64; 3], Error> {
        match self.own_rule() {
            Some(ConfigurationRule::ArmAngle { reference }) => Ok(reference),
            _ => Err(ModelFault::NoArmAngle.into()),
        }
    }
}
