//! The inverse of a robot: every joint vector of one pose, and of many.

use crate::error::{Error, JointFault, ModelFault};
use crate::kinematics::answer::check::check_angle;
use crate::kinematics::answer::solutions::Solutions;
use crate::kinematics::answer::status::Status;
use crate::kinematics::pose::{Pose, checked_pose, pose_from_rows};
use crate::kinematics::robot::Robot;
use crate::kinematics::solve::self_motion::meets;
use crate::kinematics::structure::free_choice::{FreeChoice, SeedPolicy};
use crate::kinematics::structure::inverse::{Inverse, Rows};
use crate::kinematics::structure::lanes::PoseRow;
use crate::kinematics::thresholds::MOST_LENGTH;
use crate::report::UnknownStructure;

impl Robot<6> {
    /// Every joint vector that brings the tool to `pose`.
    ///
    /// A pose out of reach has no solutions; [`Solutions::reach`] gives the reason. At a
    /// singularity, a joint that the pose leaves undetermined is zero, or the middle of its limits
    /// if zero is outside them; joint 6 of three parallel axes takes the angle nearest to that with
    /// which the arm reaches. Derivations: docs/theory/spherical_wrist.md,
    /// docs/theory/three_parallel.md.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidPose`] when the pose is not finite or not a rigid transform;
    /// [`Error::InvalidModel`] when the structure of the arm is unknown.
    pub fn ik(&self, pose: &Pose) -> Result<Solutions<6>, Error> {
        self.ik_with(pose, None)
    }
}

impl Robot<5> {
    /// Every joint vector that brings the tool to `pose`, turned about axis 1 by no more than
    /// [`Robot::heading_tolerance`].
    ///
    /// Otherwise as [`Robot::<6>::ik`]; with a tool parallel to axis 1 the heading is exact.
    /// Derivation: docs/theory/pan_roll.md.
    ///
    /// # Errors
    ///
    /// As [`Robot::<6>::ik`].
    pub fn ik(&self, pose: &Pose) -> Result<Solutions<5>, Error> {
        self.ik_with(pose, None)
    }
}

impl Robot<7> {
    /// Every joint vector that brings the tool to `pose` with joint 7 at `q7` [rad], or with the
    /// joint of [`Robot::locked`] at its angle where `q7` is `None`.
    ///
    /// Otherwise as [`Robot::<6>::ik`]. Derivation: docs/theory/spherical_shoulder.md.
    ///
    /// # Errors
    ///
    /// As [`Robot::<6>::ik`], and [`Error::InvalidJoints`] when `q7` is not finite, exceeds
    /// [`MOST_ANGLE`](crate::thresholds::MOST_ANGLE), or is missing though no joint is locked.
    pub fn ik(&self, pose: &Pose, q7: impl Into<Option<f64>>) -> Result<Solutions<7>, Error> {
        self.ik_with(pose, q7)
    }
}

impl<const N: usize> Robot<N> {
    /// [`Robot::<6>::ik`] or [`Robot::<7>::ik`] for a caller that is generic over the number of
    /// joints: `q7` is `None` for six.
    ///
    /// # Errors
    ///
    /// As [`Robot::<6>::ik`] and [`Robot::<7>::ik`].
    pub fn ik_with(&self, pose: &Pose, q7: impl Into<Option<f64>>) -> Result<Solutions<N>, Error> {
        let (q7, pose) = (q7.into(), checked_pose(pose)?);
        match (q7, self.lock()) {
            (None, Some(lock)) => self.ik_checked(pose, lock.angle),
            (Some(q7), Some(_)) => self.clone().unlocked().ik_with(&pose, q7),
            (Some(_), None) if N < 7 => Err(JointFault::NoJoint { joint: 7, dof: N }.into()),
            (q7, None) => {
                let q7 = q7.unwrap_or(f64::NAN);
                self.check_locked(q7)?;
                self.ik_checked(pose, q7)
            }
        }
    }

    /// Check the angle of the joint that a caller locks, of seven [rad].
    #[doc(hidden)]
    pub fn check_locked(&self, angle: f64) -> Result<(), Error> {
        match self.lock() {
            None if N > 6 => check_angle("q7", N, angle),
            None => Ok(()),
            Some(_) => check_angle("locked", self.locked_index() + 1, angle),
        }
    }

    /// [`Robot::ik_with`] with arguments that are already checked: `locked` is the angle of the
    /// locked joint [rad], which six joints ignore.
    pub(crate) fn ik_checked(&self, pose: Pose, locked: f64) -> Result<Solutions<N>, Error> {
        // Solved in place: an answer has about a thousand bytes.
        let mut answer = Ok(self.unsolved(pose));
        if let Ok(solutions) = &mut answer
            && let Err(error) = self.ik_into(solutions, locked)
        {
            answer = Err(error);
        }
        answer
    }

    /// Every joint vector of many poses: rows of pose elements in, slots and their status out.
    #[doc(hidden)]
    pub fn ik_rows(&self, rows: Rows<'_>) {
        let (poses, locked) = (rows.poses, rows.locked);
        let Some(inverse) = self.inverse() else { return };
        inverse.solve_rows(rows, &mut |row, q, status| {
            let locked = locked.get(row).copied().unwrap_or(f64::NAN);
            self.ik_row(&poses[row], locked, q, status);
        });
    }

    #[cold]
    fn ik_row(&self, pose: &PoseRow, locked: f64, q: &mut [[f64; N]], status: &mut [u8]) {
        q.fill([f64::NAN; N]);
        let pose = self.check_locked(locked).and_then(|()| pose_from_rows(pose));
        let Ok(solutions) = pose.and_then(|pose| self.ik_checked(pose, locked)) else {
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
    #[doc(hidden)]
    pub fn unsolved(&self, pose: Pose) -> Solutions<N> {
        Solutions::none(self.slot_count(), pose, *self.limits())
    }

    /// [`Robot::ik_checked`] for the pose of an unsolved answer, in place.
    #[doc(hidden)]
    pub fn ik_into(&self, solutions: &mut Solutions<N>, locked: f64) -> Result<(), Error> {
        if self.solve_in_lanes(solutions, locked) {
            return Ok(());
        }
        self.solve_singular(solutions, locked)
    }

    /// [`Self::ik_into`] for a pose that is not regular.
    #[cold]
    pub(in crate::kinematics) fn solve_singular(
        &self,
        solutions: &mut Solutions<N>,
        locked: f64,
    ) -> Result<(), Error> {
        // What is next to a singularity is left to the six others of a joint before the last.
        if let Some(lock) = self.lock().filter(|lock| lock.joint.joint() != 6) {
            let pose = lock.joint.seen(&solutions.pose, locked);
            let mut six = lock.six.unsolved(pose);
            lock.six.solve_singular(&mut six, f64::NAN)?;
            lock.joint.extend(&six, locked, solutions);
            return Ok(());
        }
        self.solve_scalar(solutions, &FreeChoice::rest(self.resting(locked)))?;
        self.bring_self_motions_inside(solutions, meets(&solutions.pose))?;
        self.bring_one_inside(solutions)
    }

    /// Whether a pose is far enough from every singularity to be solved in lanes.
    pub(in crate::kinematics) fn is_regular(&self, pose: &Pose, locked: f64) -> bool {
        self.solve_in_lanes(&mut self.unsolved(*pose), locked)
    }

    /// The default angles of undetermined joints; a locked joint keeps its angle.
    pub(in crate::kinematics) fn resting(&self, locked: f64) -> [f64; N] {
        let mut rest = self.limits().rest();
        if N > 6 {
            rest[self.locked_index()] = locked;
        }
        rest
    }

    /// Every joint vector of a pose; the free choice has the angle of a locked joint.
    pub(in crate::kinematics) fn solve(
        &self,
        pose: Pose,
        free: &FreeChoice<N>,
    ) -> Result<Solutions<N>, Error> {
        let mut solutions = self.unsolved(pose);
        let locked = free.q[self.locked_index()];
        let is_solved = match free.policy {
            SeedPolicy::Pose | SeedPolicy::Seed => self.solve_in_lanes(&mut solutions, locked),
            SeedPolicy::Path => {
                let inverse = self.inverse();
                inverse.is_some_and(|inverse| inverse.solve_on_path(&mut solutions, locked))
            }
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
        let inverse = self.known_inverse()?;
        inverse.solve(solutions, free.q[self.locked_index()], free);
        Ok(())
    }

    /// Check that the structure is known.
    #[doc(hidden)]
    pub fn check_structure(&self) -> Result<(), Error> {
        self.known_inverse().map(|_| ())
    }

    /// The inverse, or the reason why the structure is unknown.
    pub(in crate::kinematics) fn known_inverse(&self) -> Result<&dyn Inverse<N>, Error> {
        self.inverse().ok_or_else(|| {
            let reason = self.missing_form().unwrap_or(UnknownStructure::joint_count(N));
            ModelFault::UnknownStructure(reason).into()
        })
    }

    /// Solve a regular pose; return whether the pose is regular.
    #[inline]
    pub(in crate::kinematics) fn solve_in_lanes(
        &self,
        solutions: &mut Solutions<N>,
        locked: f64,
    ) -> bool {
        let position = &solutions.pose.translation.vector;
        if position.iter().any(|coordinate| coordinate.abs() > MOST_LENGTH) {
            return false;
        }
        self.inverse().is_some_and(|inverse| inverse.solve_in_lanes(solutions, locked))
    }
}

#[cfg(test)]
mod tests;
