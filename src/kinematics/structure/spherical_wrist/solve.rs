//! The inverse: up to eight joint vectors of a wrist frame.

use core::f64::consts::PI;

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::SphericalWrist;
use super::arm::{ArmBranch, ElbowUncertainty};
use crate::kinematics::answer::status::Status;
use crate::kinematics::pose::Pose;
use crate::kinematics::structure::branches::Branches;
use crate::kinematics::structure::free_choice::FreeChoice;
use crate::kinematics::structure::planar_arm::{Elbow, Shoulder, Shoulders, Target};
use crate::kinematics::thresholds::REACH_TOLERANCE;
use crate::report::FreeJoint;
use crate::report::Reach;

impl SphericalWrist {
    /// Every branch of the wrist frame `t_shoulder_wrist`.
    pub(super) fn solve_wrist(&self, t_shoulder_wrist: &Pose, free: &FreeChoice<6>) -> Branches<6> {
        let target = self.planar.target(t_shoulder_wrist, free, self.theta(&free.q));
        match self.planar.shoulders(target.wxy, target.free_theta[0], free.policy) {
            Ok(shoulders) => self.branches(&shoulders, &target),
            Err(missed) => Branches::empty(missed),
        }
    }

    fn branches(&self, shoulders: &Shoulders, target: &Target<'_>) -> Branches<6> {
        let Shoulders { front, behind, merged, keep_behind } = shoulders;
        let mut branches = Branches::empty(Reach::Reached);
        let sides = [(0, front), (4, behind)];
        let missed =
            sides.map(|(base, shoulder)| self.fill_or_eased(&mut branches, base, shoulder, target));
        branches.reach = missed[0].nearer(missed[1]);
        // Beyond reach by less than the tolerance: that shoulder gets the stretched or folded arm;
        // of two shoulders that are one, to rounding or to that distance, only if neither reaches.
        let nearest = branches.reach;
        for ((base, shoulder), missed) in sides.into_iter().zip(missed) {
            let one = *merged || self.planar.is_one_shoulder(shoulder, missed.shortfall());
            let shortfall = if one { nearest } else { missed }.shortfall();
            if shortfall > 0.0 && shortfall <= REACH_TOLERANCE {
                let beyond = target.beyond(shortfall);
                let filled = self.fill_or_eased(&mut branches, base, shoulder, &beyond);
                branches.reach = branches.reach.nearer(filled);
            }
        }
        if *merged {
            branches.merge_shoulders(*keep_behind, self.planar.b == 0.0);
        }
        branches
    }

    /// The branches of one shoulder; in the plane within its uncertainty if it just misses.
    fn fill_or_eased(
        &self,
        branches: &mut Branches<6>,
        base: usize,
        shoulder: &Shoulder,
        target: &Target<'_>,
    ) -> Reach {
        let missed = self.fill(branches, base, shoulder, target);
        if missed == Reach::Reached || self.planar.b == 0.0 {
            return missed;
        }
        let eased = self.planar.eased(shoulder, target.wxy, self.planar.a1, target.wz);
        match self.fill(branches, base, &eased, target) {
            Reach::Reached => Reach::Reached,
            _ => missed,
        }
    }

    /// Fill slots `base` ..= `base` + 3 with the four branches of one shoulder (eq. 13 and 18).
    fn fill(
        &self,
        branches: &mut Branches<6>,
        base: usize,
        shoulder: &Shoulder,
        target: &Target<'_>,
    ) -> Reach {
        let end = [shoulder.x - self.planar.a1, target.wz];
        let elbows = match self.planar.elbows(
            end,
            target.tolerance,
            target.free_theta[1],
            target.free.policy,
        ) {
            Ok(elbows) => elbows,
            Err(missed) => return missed,
        };
        let merged = if elbows.behind.is_none() { Status::ELBOW } else { Status::empty() };
        let open = ElbowUncertainty {
            error: shoulder.error + elbows.error,
            straight: elbows.behind.is_none(),
        };
        for (elbow, slot) in [(Some(elbows.front), base), (elbows.behind, base + 2)] {
            let Some(elbow) = elbow else {
                for twin in [slot, slot + 1] {
                    branches.flags[twin] = branches.flags[base] | Status::MERGED;
                }
                continue;
            };
            let ArmBranch { shoulder, elbow, wrist } =
                self.arm_branch(shoulder, &elbow, target, open);
            let Elbow { theta_2, theta_3, .. } = elbow;
            let theta_1 = shoulder.sin_1.atan2(shoulder.cos_1);
            let [theta_4, theta_5, theta_6] = wrist.theta;
            let flags = if wrist.merged { merged | Status::WRIST } else { merged };
            // A free theta_4 that is given may make theta_5 negative: the flipped slot is then
            // kept.
            let (kept, flipped) = if theta_5 < 0.0 { (slot + 1, slot) } else { (slot, slot + 1) };
            branches.q[kept] =
                Some(self.joint_map.joints([theta_1, theta_2, theta_3, theta_4, theta_5, theta_6]));
            branches.flags[kept] = flags;
            branches.flags[flipped] = flags;
            if elbows.free {
                let upper = FreeJoint::upper(self.joint_map.coupling);
                (branches.free[kept], branches.free[flipped]) = (Some(upper), Some(upper));
            }
            if wrist.free {
                branches.free[kept] = Some(self.free_wrist(theta_5));
            }
            if wrist.merged {
                branches.flags[flipped] |= Status::MERGED;
            } else {
                branches.q[flipped] = Some(self.joint_map.joints([
                    theta_1,
                    theta_2,
                    theta_3,
                    theta_4 + PI,
                    -theta_5,
                    theta_6 + PI,
                ]));
            }
        }
        Reach::Reached
    }

    /// The joints that the pose leaves undetermined at theta_5 = 0 or 180 deg.
    pub(super) fn free_wrist(&self, theta_5: f64) -> FreeJoint {
        let sum =
            (theta_5.cos() > 0.0) == (self.joint_map.signs[3] * self.joint_map.signs[5] > 0.0);
        if sum { FreeJoint::WristSum } else { FreeJoint::WristDifference }
    }
}
