//! The inverse of a robot with a closed form: every joint vector of a pose, and of many.

use super::free_choice::FreeChoice;
use super::pose::{Pose, checked_pose, pose_from_rows};
use super::robot::Robot;
use super::solutions::{SLOTS, Solution, Solutions};
use super::spherical_wrist::{AnswerRow, Blocks, PoseRow, Single, StatusRow, WristSolver};
use super::status::{Reach, Status};
use crate::error::Error;
use crate::lanes::run;

impl Robot<6> {
    /// Every joint vector that brings the tool to `pose`.
    ///
    /// A pose out of reach has no solutions and tells so by [`Solutions::reach`]; at a singularity a joint that the pose leaves free
    /// reads zero, or the middle of its limits where zero is outside them. Derivation: docs/ik_derivation.md.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidPose`] when the pose is not finite or no rigid transform; [`Error::InvalidModel`] when the arm has no closed form.
    pub fn ik(&self, pose: &Pose) -> Result<Solutions<6>, Error> {
        self.ik_checked(checked_pose(pose)?)
    }

    /// [`Robot::ik`] for a pose that was checked where it came in.
    pub(crate) fn ik_checked(&self, pose: Pose) -> Result<Solutions<6>, Error> {
        let mut solutions = self.unsolved(pose);
        self.ik_into(&mut solutions)?;
        Ok(solutions)
    }

    /// Every joint vector of many poses, in lanes: rows of pose elements in, slots and their status out.
    pub(crate) fn ik_rows(&self, poses: &[PoseRow], q: &mut [AnswerRow], status: &mut [StatusRow]) -> Result<(), Error> {
        let careful = |pose: &PoseRow, q: &mut AnswerRow, status: &mut StatusRow| self.ik_row(pose, q, status);
        run(Blocks { solver: self.solver()?, poses, q, status, careful });
        Ok(())
    }

    /// One row by itself.
    #[cold]
    fn ik_row(&self, pose: &PoseRow, q: &mut AnswerRow, status: &mut StatusRow) {
        q.fill(f64::NAN);
        let Ok(solutions) = pose_from_rows(pose).and_then(|pose| self.ik_checked(pose)) else {
            status.fill(Status::INVALID.bits());
            return;
        };
        *status = solutions.status().map(|status| status.bits());
        for solution in &solutions {
            q.as_chunks_mut::<6>().0[usize::from(solution.slot)] = solution.q;
        }
    }

    /// An answer without solutions, to solve in the place where it stands.
    #[inline]
    pub(crate) fn unsolved(&self, pose: Pose) -> Solutions<6> {
        let empty = [Status::empty(); SLOTS];
        Solutions { slots: [None; SLOTS], merged: empty, reach: Reach::Reached, pose, limits: *self.limits(), emptied: None }
    }

    /// [`Robot::ik_checked`] of an unsolved answer's pose, without moving the answer about.
    pub(crate) fn ik_into(&self, solutions: &mut Solutions<6>) -> Result<(), Error> {
        let solver = self.solver()?;
        if solve_in_lanes(solver, solutions) {
            return Ok(());
        }
        self.solve_carefully(solver, solutions, &FreeChoice::rest(self.limits().rest()));
        self.bring_families_inside(solutions)
    }

    pub(super) fn solve(&self, pose: Pose, free: &FreeChoice<6>) -> Result<Solutions<6>, Error> {
        let (solver, mut solutions) = (self.solver()?, self.unsolved(pose));
        if !(free.leaves_plain_poses_alone() && solve_in_lanes(solver, &mut solutions)) {
            self.solve_carefully(solver, &mut solutions, free);
        }
        Ok(solutions)
    }

    /// Whatever the pose, one branch after the other.
    #[cold]
    fn solve_carefully(&self, solver: &WristSolver, solutions: &mut Solutions<6>, free: &FreeChoice<6>) {
        let branches = solver.arm.solve(&solver.wrist_pose(&solutions.pose), free);
        for (slot, place) in solutions.slots.iter_mut().enumerate() {
            let Some(q) = branches.q[slot] else { continue };
            let q = self.limits().settle(q);
            let mut status = branches.flags[slot] | Status::FOUND;
            status.set(Status::WITHIN_LIMITS, self.limits().contain(&q));
            #[expect(clippy::cast_possible_truncation, reason = "eight slots")]
            let solution = Solution { q, slot: slot as u8, status, free: branches.free[slot] };
            *place = Some(solution);
        }
        solutions.merged = branches.flags.map(|flags| if flags.contains(Status::MERGED) { flags } else { Status::empty() });
        solutions.reach = branches.reach;
    }
}

/// Solves a pose that is plain, and tells whether it was.
#[inline]
fn solve_in_lanes(solver: &WristSolver, solutions: &mut Solutions<6>) -> bool {
    let Some(plain) = run(Single { solver, pose: &solutions.pose }) else { return false };
    for (slot, place) in solutions.slots.iter_mut().enumerate() {
        let Some((q, status)) = plain.slot(slot) else { continue };
        #[expect(clippy::cast_possible_truncation, reason = "eight slots")]
        let solution = Solution { q, slot: slot as u8, status: Status::from_bits_retain(status), free: None };
        *place = Some(solution);
    }
    true
}

#[cfg(test)]
mod tests;
