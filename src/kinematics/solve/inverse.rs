//! The inverse of a robot: every joint vector of one pose, and of many.

use crate::error::{Error, ModelFault};
use crate::kinematics::answer::solutions::Solutions;
use crate::kinematics::answer::status::Status;
use crate::kinematics::pose::{Pose, checked_pose, pose_from_rows};
use crate::kinematics::robot::Robot;
use crate::kinematics::solve::self_motion::meets;
use crate::kinematics::structure::any::AnyStructure;
use crate::kinematics::structure::arity::{Arity, Joints, RedundancyOf};
use crate::kinematics::structure::arm::Rows;
use crate::kinematics::structure::free_choice::{FreeChoice, SeedPolicy};
use crate::kinematics::structure::lanes::PoseRow;
use crate::kinematics::structure::redundancy::Redundancy;
use crate::kinematics::thresholds::MOST_LENGTH;

impl Robot<6> {
    /// Every joint vector that brings the tool to `pose`.
    ///
    /// A pose out of reach has no solutions; [`Solutions::reach`] gives the reason. At a
    /// singularity, a joint that the pose leaves undetermined is zero, or the middle of its limits
    /// if zero is outside them; joint 6 of three parallel axes takes the angle nearest to that with
    /// which the arm reaches. Derivations: docs/spherical_wrist.md, docs/three_parallel.md.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidPose`] when the pose is not finite or not a rigid transform;
    /// [`Error::InvalidModel`] when the structure of the arm is unknown.
    pub fn ik(&self, pose: &Pose) -> Result<Solutions<6>, Error> {
        self.ik_with(pose, ())
    }
}

impl Robot<7> {
    /// Every joint vector that brings the tool to `pose` with joint 7 at `q7` [rad].
    ///
    /// Otherwise as [`Robot::<6>::ik`]. Derivation: docs/spherical_shoulder.md.
    ///
    /// # Errors
    ///
    /// As [`Robot::<6>::ik`], and [`Error::InvalidJoints`] when `q7` is not finite or exceeds
    /// [`MOST_ANGLE`].
    pub fn ik(&self, pose: &Pose, q7: f64) -> Result<Solutions<7>, Error> {
        self.ik_with(pose, q7)
    }
}

impl<const N: usize> Robot<N>
where
    Joints<N>: Arity<N>,
{
    /// [`Robot::<6>::ik`] or [`Robot::<7>::ik`] for a caller that is generic over the number of
    /// joints. `redundancy` is `()` for six joints and the angle of joint 7 [rad] for seven.
    ///
    /// # Errors
    ///
    /// As [`Robot::<6>::ik`] and [`Robot::<7>::ik`].
    pub fn ik_with(&self, pose: &Pose, redundancy: RedundancyOf<N>) -> Result<Solutions<N>, Error> {
        redundancy.check()?;
        self.ik_checked(checked_pose(pose)?, redundancy)
    }

    /// [`Robot::ik_with`] with arguments that are already checked.
    pub(crate) fn ik_checked(
        &self,
        pose: Pose,
        redundancy: RedundancyOf<N>,
    ) -> Result<Solutions<N>, Error> {
        // Solved in place: an answer has about a thousand bytes.
        let mut answer = Ok(self.unsolved(pose));
        if let Ok(solutions) = &mut answer
            && let Err(error) = self.ik_into(solutions, redundancy)
        {
            answer = Err(error);
        }
        answer
    }

    /// Every joint vector of many poses: rows of pose elements in, slots and their status out.
    pub(crate) fn ik_rows(&self, rows: Rows<'_, RedundancyOf<N>>) {
        let (poses, redundancy) = (rows.poses, rows.redundancy);
        self.solver().arm().solve_rows(rows, &mut |row, q, status| {
            self.ik_row(&poses[row], redundancy[row], q, status);
        });
    }

    /// Solve one row by itself.
    #[cold]
    fn ik_row(
        &self,
        pose: &PoseRow,
        redundancy: RedundancyOf<N>,
        q: &mut [[f64; N]],
        status: &mut [u8],
    ) {
        q.fill([f64::NAN; N]);
        let pose = redundancy.check().and_then(|()| pose_from_rows(pose));
        let Ok(solutions) = pose.and_then(|pose| self.ik_checked(pose, redundancy)) else {
            status.fill(Status::INVALID.bits());
            return;
        };
        for (to, from) in status.iter_mut().zip(&*solutions.status()) {
            *to = from.bits();
        }
        for solution in &solutions {
            q[solution.slot.index()] = solution.q;
        }
    }

    /// An answer without solutions, to be solved in place.
    #[inline]
    pub(crate) fn unsolved(&self, pose: Pose) -> Solutions<N> {
        Solutions::none(self.solver().slot_count(), pose, *self.limits())
    }

    /// [`Robot::ik_checked`] for the pose of an unsolved answer, in place.
    pub(crate) fn ik_into(
        &self,
        solutions: &mut Solutions<N>,
        redundancy: RedundancyOf<N>,
    ) -> Result<(), Error> {
        if self.solve_in_lanes(solutions, redundancy) {
            return Ok(());
        }
        self.solve_at_rest(solutions, redundancy)
    }

    /// [`Self::ik_into`] for a pose that is not regular.
    #[cold]
    pub(in crate::kinematics) fn solve_at_rest(
        &self,
        solutions: &mut Solutions<N>,
        redundancy: RedundancyOf<N>,
    ) -> Result<(), Error> {
        self.solve_scalar(solutions, &FreeChoice::rest(self.resting(redundancy)))?;
        self.bring_self_motions_inside(solutions, meets(&solutions.pose))?;
        self.bring_one_inside(solutions)
    }

    /// Whether a pose is far enough from every singularity to be solved in lanes.
    pub(in crate::kinematics) fn is_regular(
        &self,
        pose: &Pose,
        redundancy: RedundancyOf<N>,
    ) -> bool {
        self.solve_in_lanes(&mut self.unsolved(*pose), redundancy)
    }

    /// The default angles of undetermined joints; a joint whose angle is given keeps it.
    pub(in crate::kinematics) fn resting(&self, redundancy: RedundancyOf<N>) -> [f64; N] {
        let mut rest = self.limits().rest();
        redundancy.put(&mut rest);
        rest
    }

    /// Every joint vector of a pose; the redundancy parameter is that of the free choice.
    pub(in crate::kinematics) fn solve(
        &self,
        pose: Pose,
        free: &FreeChoice<N>,
    ) -> Result<Solutions<N>, Error> {
        let mut solutions = self.unsolved(pose);
        let redundancy = Redundancy::of(&free.q);
        let is_solved = match free.policy {
            SeedPolicy::Pose | SeedPolicy::Seed => self.solve_in_lanes(&mut solutions, redundancy),
            SeedPolicy::Path => self.solver().arm().solve_on_path(&mut solutions, redundancy),
            SeedPolicy::Forced { .. } => false,
        };
        if !is_solved {
            self.solve_scalar(&mut solutions, free)?;
        }
        Ok(solutions)
    }

    /// Solve any pose, one branch after the other.
    #[cold]
    pub(in crate::kinematics) fn solve_scalar(
        &self,
        solutions: &mut Solutions<N>,
        free: &FreeChoice<N>,
    ) -> Result<(), Error> {
        let redundancy = Redundancy::of(&free.q);
        let solved = self.solver().arm().solve(solutions, redundancy, free);
        solved.map_err(|reason| ModelFault::UnknownStructure(reason).into())
    }

    /// Solve a regular pose; return whether the pose is regular.
    #[inline]
    pub(in crate::kinematics) fn solve_in_lanes(
        &self,
        solutions: &mut Solutions<N>,
        redundancy: RedundancyOf<N>,
    ) -> bool {
        let position = &solutions.pose.translation.vector;
        if position.iter().any(|coordinate| coordinate.abs() > MOST_LENGTH) {
            return false;
        }
        self.solver().solve_in_lanes(solutions, redundancy)
    }
}

#[cfg(test)]
mod tests;
