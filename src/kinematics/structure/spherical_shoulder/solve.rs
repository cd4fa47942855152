//! The inverse: up to eight joint vectors of a hand frame.

use core::f64::consts::PI;

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::SphericalShoulder;
use super::elbow::Elbow;
use super::elbow::Target;
use super::wrist::shoulder;
use super::wrist::{Wrist, Wrists};
use crate::kinematics::answer::status::Status;
use crate::kinematics::pose::Pose;
use crate::kinematics::structure::branches::Branches;
use crate::kinematics::structure::free_choice::FreeChoice;
use crate::kinematics::thresholds::REACH_TOLERANCE;
use crate::report::FreeJoint;
use crate::report::Reach;

/// The bits of a slot (eq. 65).
const SHOULDER: usize = 4;
const ELBOW: usize = 2;
const WRIST: usize = 1;

impl SphericalShoulder {
    /// Every branch of the hand frame `t_shoulder_hand`, with joint 7 at `free.q[6]`.
    pub(crate) fn solve_hand(&self, t_shoulder_hand: &Pose, free: &FreeChoice<7>) -> Branches<7> {
        let mut target =
            Target::new(t_shoulder_hand, free, self.theta(&free.q), self.links.position_rounding());
        let mut branches = self.branches(&target);
        // Out of reach by less than the tolerance: return the stretched or folded arm.
        let shortfall = branches.reach.shortfall();
        if shortfall > 0.0 && shortfall <= REACH_TOLERANCE {
            target.tolerance = target.tolerance.max(shortfall);
            branches = self.branches(&target);
        }
        branches
    }

    fn branches(&self, target: &Target<'_>) -> Branches<7> {
        let mut branches = Branches::empty(Reach::Reached);
        let elbows = match self.links.elbows(target) {
            Ok(elbows) => elbows,
            Err(missed) => return Branches::empty(missed),
        };
        branches.reach = self.fill_or_beyond(&mut branches, 0, &elbows.forwards, target);
        if let Some(backwards) = &elbows.backwards {
            let missed = self.fill_or_beyond(&mut branches, ELBOW, backwards, target);
            if missed.shortfall() < branches.reach.shortfall() {
                branches.reach = missed;
            }
        } else {
            merge(
                &mut branches,
                [0, WRIST, SHOULDER, SHOULDER + WRIST].map(|slot| (slot, slot + ELBOW)),
            );
        }
        branches
    }

    /// The branches of one elbow, whether or not the other reaches; with the wrist at its edge if
    /// it misses by less than the tolerance.
    fn fill_or_beyond(
        &self,
        branches: &mut Branches<7>,
        base: usize,
        elbow: &Elbow,
        target: &Target<'_>,
    ) -> Reach {
        let missed = self.fill(branches, base, elbow, target);
        let shortfall = missed.shortfall();
        if shortfall == 0.0 || shortfall > REACH_TOLERANCE {
            return missed;
        }
        let tolerance = target.tolerance.max(shortfall);
        self.fill(branches, base, elbow, &Target { tolerance, ..*target })
    }

    /// Fill slots `base`, + 1, + 4 and + 5 with the branches of one elbow.
    fn fill(
        &self,
        branches: &mut Branches<7>,
        base: usize,
        elbow: &Elbow,
        target: &Target<'_>,
    ) -> Reach {
        let (elbow, wrists) = match self.wrists(elbow, target) {
            Ok(reached) => reached,
            Err(shortfall) => return Reach::TooFar { shortfall },
        };
        let mut flags = Status::empty();
        flags.set(Status::ELBOW, elbow.straight);
        flags.set(Status::WRIST, wrists.second.is_none());
        for wrist in [Some(wrists.first), wrists.second].into_iter().flatten() {
            let slot = if wrist.fifth.cos < 0.0 { base + WRIST } else { base };
            self.place(branches, slot, flags, &elbow, (&wrist, &wrists), target);
        }
        if wrists.second.is_none() {
            let kept = if branches.exists(base + WRIST) { base + WRIST } else { base };
            merge(branches, [(kept, kept ^ WRIST), (kept + SHOULDER, (kept ^ WRIST) + SHOULDER)]);
        }
        Reach::Reached
    }

    /// Both branches of the wrist, with the elbow for which they were found.
    fn wrists(&self, elbow: &Elbow, target: &Target<'_>) -> Result<(Elbow, Wrists), f64> {
        let elbow = self.links.bent_for_seed(elbow, target).unwrap_or(*elbow);
        let missed = match self.links.wrists(&elbow, target) {
            Ok(wrists) => return Ok((elbow, wrists)),
            Err(missed) => missed,
        };
        let eased = self.links.eased(&elbow, target).ok_or(missed)?;
        let wrists = self.links.wrists(&eased, target).map_err(|_| missed)?;
        Ok((eased, wrists))
    }

    /// Fill slots `slot` and + 4 with both shoulders of one elbow and wrist.
    fn place(
        &self,
        branches: &mut Branches<7>,
        slot: usize,
        mut flags: Status,
        elbow: &Elbow,
        (wrist, wrists): (&Wrist, &Wrists),
        target: &Target<'_>,
    ) {
        let error = elbow.error * self.links.forearm / target.r.max(self.links.position_rounding())
            + wrists.error;
        let shoulder = shoulder(elbow, wrist, target, error);
        flags.set(Status::SHOULDER, shoulder.merged);
        // Of a surface of solutions, no joint alone leads to all.
        if usize::from(shoulder.free) + wrists.freedom > 1 {
            branches.is_certified = false;
        }
        let [theta_1, theta_2, theta_3] = shoulder.theta;
        let joints = |theta_1, theta_2, theta_3| {
            let hand = [elbow.sin_4.atan2(elbow.cos_4), wrist.fifth.theta, wrist.sixth.theta];
            let mut q = self.joint_map.joints([
                theta_1,
                theta_2,
                theta_3,
                hand[0],
                hand[1],
                hand[2],
                target.free_theta[6],
            ]);
            q[6] = target.free.q[6];
            q
        };
        // A free theta_1 that is given may make theta_2 negative: the flipped slot is then kept.
        let (kept, flipped) =
            if theta_2 < 0.0 { (slot + SHOULDER, slot) } else { (slot, slot + SHOULDER) };
        branches.q[kept] = Some(joints(theta_1, theta_2, theta_3));
        branches.free[kept] =
            if shoulder.free { Some(self.free_shoulder(theta_2)) } else { wrists.free };
        (branches.flags[kept], branches.flags[flipped]) = (flags, flags);
        if shoulder.merged {
            branches.flags[flipped] |= Status::MERGED;
        } else {
            branches.q[flipped] = Some(joints(theta_1 + PI, -theta_2, theta_3 + PI));
            branches.free[flipped] = wrists.free;
        }
    }

    /// The joints that the pose leaves undetermined at theta_2 = 0 or 180 deg.
    fn free_shoulder(&self, theta_2: f64) -> FreeJoint {
        let sum =
            (theta_2.cos() > 0.0) == (self.joint_map.signs[0] * self.joint_map.signs[2] > 0.0);
        if sum { FreeJoint::ShoulderSum } else { FreeJoint::ShoulderDifference }
    }
}

/// Flag slots whose solution another slot holds.
fn merge<const N: usize>(branches: &mut Branches<7>, pairs: [(usize, usize); N]) {
    for (kept, merged) in pairs {
        if branches.exists(kept) {
            branches.flags[merged] = branches.flags[kept] | Status::MERGED;
        }
    }
}
