//! Solutions of targets, which have an arm angle if the arm is a `YuMi`.

use alloc::vec::Vec;
use core::any::Any;

use super::arm_angle::ArmAngle;
use crate::error::Error;
use crate::kinematics::answer::select::{Cost, Turns};
use crate::kinematics::answer::solutions::Solution;
use crate::kinematics::pose::Pose;
use crate::kinematics::robot::Robot;
use crate::kinematics::solve::self_motion_curve::{Joints, SelfMotion};
use crate::kinematics::structure::inverse::of_count;
use crate::report::Explanation;

/// Largest step of a joint that counts as one on the way [rad].
const LARGEST_STEP: f64 = 0.2;

impl<const N: usize> Robot<N> {
    /// All joint vectors inside the limits, 2 pi equivalents too, of a pose and an arm angle [rad],
    /// if the arm has one.
    pub(crate) fn ik_inside_at(
        &self,
        pose: &Pose,
        arm_angle: Option<f64>,
    ) -> Result<Vec<[f64; N]>, Error> {
        let arm: &dyn Any = self;
        let solutions = if let Some(six) = arm.downcast_ref::<Robot<6>>() {
            let solutions = six.ik(pose)?;
            of_count(solutions.iter().copied().collect::<Vec<_>>())
        } else if let (Some(seven), Some(angle)) = (arm.downcast_ref::<Robot<7>>(), arm_angle) {
            of_count(seven.ik_arm_angle(pose, angle)?)
        } else {
            None
        };
        let solutions: Vec<Solution<N>> = solutions.unwrap_or_default();
        let turns = solutions.iter().flat_map(|solution| Turns::of(self.limits(), solution));
        Ok(turns.map(|turn| turn.q).collect())
    }

    /// The joint vector nearest to a seed [rad] inside the limits, of a pose and an arm angle
    /// [rad], if the arm has one.
    ///
    /// # Errors
    ///
    /// As [`Robot::ik_nearest`].
    pub(crate) fn ik_nearest_at(
        &self,
        pose: &Pose,
        seed: &[f64; N],
        arm_angle: Option<f64>,
    ) -> Result<[f64; N], Error> {
        let arm: &dyn Any = self;
        let (Some(seven), Some(angle)) = (arm.downcast_ref::<Robot<7>>(), arm_angle) else {
            return Ok(self.ik_nearest(pose, seed, &[1.0; N])?.q);
        };
        let near = of_count(*seed).and_then(|seed| seven.step_to(&seed, pose, angle));
        if let Some(near) = near.and_then(of_count).filter(|q| self.limits().contains(q)) {
            return Ok(near);
        }
        let distance = |q: &[f64; N]| Cost::Distance.total(q, seed, &[1.0; N]);
        let inside = self.ik_inside_at(pose, arm_angle)?;
        let nearest = inside.into_iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let explained = || match seven.explain_along_redundancy(pose)? {
            Explanation::Found { .. } => Ok(Explanation::NoArmAngle { arm_angle: angle }),
            other => Ok::<_, Error>(other),
        };
        nearest.map_or_else(|| Err(Error::Unreachable(explained()?)), Ok)
    }
}

impl Robot<7> {
    /// The joints of a pose and an arm angle that are a small step from others.
    pub(in crate::kinematics) fn step_to(
        &self,
        from: &[f64; 7],
        pose: &Pose,
        wanted: f64,
    ) -> Option<[f64; 7]> {
        let angle = ArmAngle::of(self, self.arm_angle_reference().ok()?, pose)?;
        let curve = SelfMotion { robot: self, pose, rounding: self.rounding() };
        let q = curve.newton(Joints::from(*from), |q| angle.seventh(q, wanted))?.joints();
        let is_small = from.iter().zip(&q).all(|(from, to)| (to - from).abs() <= LARGEST_STEP);
        (is_small && angle.is_of(&q, wanted)).then_some(q)
    }
}
