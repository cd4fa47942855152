//! The self-motion of a singular pose: its solutions along an undetermined joint.

use crate::error::{Error, JointFault};
use crate::kinematics::answer::check::check_angle;
use crate::kinematics::answer::solutions::Solution;
use crate::kinematics::answer::status::Status;
use crate::kinematics::pose::{Pose, checked_pose};
use crate::kinematics::robot::Robot;
use crate::kinematics::structure::free_choice::FreeChoice;
use crate::kinematics::thresholds::{POSITION_ROUNDING, SEEDED_FREE, SOLUTION_OFF};
use crate::report::{Explanation, FreeJoint};

impl<const N: usize> Robot<N> {
    /// The solution of the same pose with its free joint at `value` [rad]; `None` if no joint is
    /// undetermined.
    ///
    /// At the singularity the tool stays in place to rounding; near it, within twice the pose's
    /// distance from it: at most 3e-9 rad or m.
    ///
    /// # Errors
    ///
    /// As [`Robot::ik`], [`Error::InvalidJoints`] when the value is not finite or the solution does
    /// not reach the pose, and [`Error::Unreachable`] when the arm does not reach the pose with the
    /// free joint there.
    pub fn with_free_joint(
        &self,
        pose: &Pose,
        solution: &Solution<N>,
        value: f64,
    ) -> Result<Option<Solution<N>>, Error> {
        let Some(free) = solution.free_joint else { return Ok(None) };
        let off = self.residual(&solution.q, pose).largest();
        if off > SOLUTION_OFF {
            return Err(JointFault::NotOfPose { off, bound: SOLUTION_OFF }.into());
        }
        check_angle("value", free.joint(), value)?;
        let moved = self.with_free_joint_at(&checked_pose(pose)?, solution, free, value)?;
        moved
            .map(Some)
            .ok_or(Error::Unreachable(Explanation::FreeOutOfReach { joint: free.joint(), value }))
    }

    /// [`Self::with_free_joint`] for a pose and a solution of it that are already checked; `None`
    /// if the arm does not reach.
    fn with_free_joint_at(
        &self,
        pose: &Pose,
        solution: &Solution<N>,
        free: FreeJoint,
        value: f64,
    ) -> Result<Option<Solution<N>>, Error> {
        let joint = free.joint() - 1;
        let found = if let FreeJoint::Chain { .. } = free {
            self.known_inverse()?;
            let motions = self.self_motions(pose);
            let member = motions.and_then(|(of, pose)| of.member(&pose, &solution.q, joint, value));
            member.map(|q| Solution { q: self.limits().wrap(q), ..*solution })
        } else if let Some((partner, sign)) = free.partner().filter(|_| self.own_rule().is_some()) {
            // Of a YuMi, whose other joints are no closed form.
            let mut q = solution.q;
            q[partner - 1] += sign * (q[joint] - value);
            Some(Solution { q: self.limits().wrap(q), ..*solution })
        } else {
            // Every solution with the joint at the angle, even if the pose determines it.
            let mut q = solution.q;
            q[joint] = value;
            let is_behind = solution.slot.index() >= self.slot_count() / 2;
            let forced = FreeChoice::forced(q, free.joint(), is_behind);
            let solutions = self.solve(*pose, &forced)?;
            // Its branch, or the one that it becomes.
            let mut slots = free.branches().iter().copied().flatten();
            slots.find_map(|other| solutions.slot(solution.slot.index() ^ other).copied())
        };
        Ok(found.map(|mut moved| {
            moved.q[joint] = value;
            moved.status.set(Status::WITHIN_LIMITS, self.limits().contains(&moved.q));
            moved
        }))
    }
}

/// How far a solution that reaches this pose may be off it [rad, m]: the tolerance of a seeded
/// solve or, for very long lengths, their rounding.
pub(in crate::kinematics) fn meets(pose: &Pose) -> f64 {
    SEEDED_FREE.max(4.0 * POSITION_ROUNDING * pose.translation.vector.norm())
}
