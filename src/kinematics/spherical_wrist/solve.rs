//! The inverse: up to eight joint vectors of a wrist frame.

use core::f64::consts::PI;

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::SphericalWrist;
use super::arm::{Elbow, Shoulder, Shoulders};
use super::target::{FreeChoice, Target};
use super::wrist::{forearm_to_flange, wrist};
use crate::kinematics::angles::wrap;
use crate::kinematics::pose::Pose;
use crate::kinematics::solutions::{FreeJoint, SLOTS};
use crate::kinematics::status::{Reach, Status};
use crate::kinematics::thresholds::REACH_TOLERANCE;

/// The joint vectors of a wrist frame, in their slots.
pub(crate) struct Branches {
    pub(crate) q: [Option<[f64; 6]>; SLOTS],
    /// Singularities of each slot's branch, and MERGED where the slot gave its solution to another.
    pub(crate) flags: [Status; SLOTS],
    /// The joint that the pose leaves free in each slot.
    pub(crate) free: [Option<FreeJoint>; SLOTS],
    pub(crate) reach: Reach,
}

impl SphericalWrist {
    /// Every branch of the wrist frame `t_shoulder_wrist`.
    pub(crate) fn solve(&self, t_shoulder_wrist: &Pose, free: &FreeChoice) -> Branches {
        let w = t_shoulder_wrist.translation.vector;
        let mut target = Target {
            wxy: [w.x, w.y],
            wz: w.z,
            rotation: t_shoulder_wrist.rotation.matrix(),
            free,
            free_theta: self.theta(&free.q),
            tolerance: self.position_rounding(),
        };
        let shoulders = match self.shoulders(&target) {
            Ok(shoulders) => shoulders,
            Err(missed) => return Branches::empty(missed),
        };
        let branches = self.branches(&shoulders, &target);
        let shortfall = branches.reach.shortfall();
        if shortfall == 0.0 || shortfall > REACH_TOLERANCE {
            return branches;
        }
        // No branch reaches, the nearest one by less than anyone could see: it gets the stretched or folded arm.
        target.tolerance = shortfall;
        self.branches(&shoulders, &target)
    }

    fn branches(&self, shoulders: &Shoulders, target: &Target<'_>) -> Branches {
        let mut branches = Branches::empty(Reach::Reached);
        let mut fill = |base: usize, shoulder: &Shoulder| match self.fill(&mut branches, base, shoulder, target) {
            missed if missed == Reach::Reached || self.b == 0.0 => missed,
            missed => match self.fill(&mut branches, base, &self.eased(shoulder, target), target) {
                Reach::Reached => Reach::Reached,
                _ => missed,
            },
        };
        let (front, behind) = (fill(0, &shoulders.front), fill(4, &shoulders.behind));
        branches.reach = if behind.shortfall() < front.shortfall() { behind } else { front };
        if shoulders.merged {
            branches.merge_shoulders(shoulders.keep_behind, self.b == 0.0);
        }
        branches
    }

    /// Puts the four branches of one shoulder into slots `base` ..= `base` + 3 (eq. 13 and 18).
    fn fill(&self, branches: &mut Branches, base: usize, shoulder: &Shoulder, target: &Target<'_>) -> Reach {
        let elbows = match self.elbows(shoulder.x - self.a1, target.wz, target) {
            Ok(elbows) => elbows,
            Err(missed) => return missed,
        };
        let merged = if elbows.behind.is_none() { Status::ELBOW } else { Status::empty() };
        let error = shoulder.error + elbows.error;
        for (elbow, slot) in [(Some(elbows.front), base), (elbows.behind, base + 2)] {
            let Some(elbow) = elbow else {
                for twin in [slot, slot + 1] {
                    branches.flags[twin] = branches.flags[base] | Status::MERGED;
                }
                continue;
            };
            let Elbow { theta_2, theta_3, .. } = elbow;
            let shoulder = self.turned_for_wrist(shoulder, &elbow, target);
            let theta_1 = shoulder.sin_1.atan2(shoulder.cos_1);
            let wrist = wrist(&forearm_to_flange(&shoulder, &elbow, target.rotation), target, error);
            let [theta_4, theta_5, theta_6] = wrist.theta;
            let flags = if wrist.merged { merged | Status::WRIST } else { merged };
            // A free theta_4 that was given may leave theta_5 negative: then the flipped slot is the one that is kept.
            let (kept, flipped) = if theta_5 < 0.0 { (slot + 1, slot) } else { (slot, slot + 1) };
            branches.q[kept] = Some(self.joints([theta_1, theta_2, theta_3, theta_4, theta_5, theta_6]));
            branches.flags[kept] = flags;
            branches.flags[flipped] = flags;
            if elbows.free {
                branches.free[kept] = Some(FreeJoint::Upper);
                branches.free[flipped] = Some(FreeJoint::Upper);
            }
            if wrist.free {
                branches.free[kept] = Some(self.free_wrist(theta_5));
            }
            if wrist.merged {
                branches.flags[flipped] |= Status::MERGED;
            } else {
                branches.q[flipped] = Some(self.joints([theta_1, theta_2, theta_3, theta_4 + PI, -theta_5, theta_6 + PI]));
            }
        }
        Reach::Reached
    }

    /// What the pose leaves open at theta_5 = 0 or 180 deg, in terms of the joints.
    fn free_wrist(&self, theta_5: f64) -> FreeJoint {
        let sum = (theta_5.cos() > 0.0) == (self.signs[3] * self.signs[5] > 0.0);
        if sum { FreeJoint::WristSum } else { FreeJoint::WristDifference }
    }

    /// The joint angles of theta, in (-pi, pi] (eq. 19).
    pub(super) fn joints(&self, theta: [f64; 6]) -> [f64; 6] {
        core::array::from_fn(|i| wrap(self.signs[i] * (theta[i] + self.offsets[i])))
    }
}

impl Branches {
    fn empty(reach: Reach) -> Self {
        Self { q: [None; SLOTS], flags: [Status::empty(); SLOTS], free: [None; SLOTS], reach }
    }

    /// The wrist centre is on axis 1: an elbow that both shoulders have is one branch, turned. With b = 0, q1 is free.
    fn merge_shoulders(&mut self, keep_behind: bool, free: bool) {
        // Of two that differ by twice the distance from axis 1, one may be straight and the other bent by the root of that: the straight one
        // is the branch that declares its singularity.
        let straight = |slot: usize| self.flags[slot].contains(Status::ELBOW);
        let keep_behind = if straight(0) == straight(4) { keep_behind } else { straight(4) };
        for slot in 0..SLOTS {
            if self.q[slot].is_some() || self.flags[slot].contains(Status::MERGED) {
                self.flags[slot] |= Status::SHOULDER;
                if free {
                    self.free[slot] = self.free[slot].or(Some(FreeJoint::Base));
                }
            }
        }
        let exists = |branches: &Self, elbow: usize| branches.q[elbow].is_some() || !branches.flags[elbow].is_empty();
        for elbow in [0, 2] {
            let (kept, turned) = if keep_behind { (elbow + 4, elbow) } else { (elbow, elbow + 4) };
            let (kept, turned) = if exists(self, kept) { (kept, turned) } else { (turned, kept) };
            if !exists(self, kept) {
                continue;
            }
            for wrist in [0, 1] {
                self.q[turned + wrist] = None;
                self.flags[turned + wrist] = self.flags[kept + wrist] | Status::MERGED;
            }
        }
    }
}
