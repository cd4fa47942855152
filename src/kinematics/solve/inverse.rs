//! The inverse of a robot with a closed form: every joint vector of a pose, and of many.

use crate::error::{Error, JointFault, ModelFault};
use crate::kinematics::answer::select::{Cost, check_joints, check_weights};
use crate::kinematics::answer::solutions::{SLOTS, Solution, Solutions};
#[cfg(feature = "python")]
use crate::kinematics::answer::status::Explanation;
use crate::kinematics::answer::status::{Reach, Status};
use crate::kinematics::pose::angles::resized;
use crate::kinematics::pose::{Pose, checked_pose, pose_from_rows};
use crate::kinematics::robot::Robot;
use crate::kinematics::solve::nearest::Wanted;
use crate::kinematics::solve::self_motion::meets;
use crate::kinematics::structure::any::Geometry;
use crate::kinematics::structure::free_choice::FreeChoice;
use crate::kinematics::structure::lanes::{AnswerRow, Blocks, PoseRow, StatusRow};
use crate::kinematics::structure::spherical_shoulder;
use crate::kinematics::structure::spherical_wrist;
use crate::kinematics::structure::three_parallel;
use crate::kinematics::thresholds::MOST_LENGTH;
use crate::lanes::run;

impl Robot<6> {
    /// Every joint vector that brings the tool to `pose`.
    ///
    /// A pose out of reach has no solutions and tells so by [`Solutions::reach`]; at a singularity a joint that the pose leaves free
    /// reads zero, or the middle of its limits where zero is outside them; joint 6 of three parallel axes the angle nearest to that with which
    /// the arm reaches. Derivations: docs/ik_derivation.md, docs/three_parallel.md.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidPose`] when the pose is not finite or no rigid transform; [`Error::InvalidModel`] when the arm has no closed form.
    pub fn ik(&self, pose: &Pose) -> Result<Solutions<6>, Error> {
        self.ik_checked(checked_pose(pose)?, 0.0)
    }

    /// The solution inside the limits that is nearest to `seed` [rad], 2 pi equivalents considered; of a self-motion the
    /// nearest member.
    ///
    /// # Errors
    ///
    /// As [`Robot::ik`], [`Error::InvalidJoints`] for a seed or weight that is not finite, and [`Error::Unreachable`] when no solution
    /// is inside the limits.
    pub fn ik_nearest(
        &self,
        pose: &Pose,
        seed: &[f64; 6],
        weights: &[f64; 6],
    ) -> Result<Solution<6>, Error> {
        check_joints("seed", seed)?;
        check_weights(weights)?;
        self.ik_nearest_checked(checked_pose(pose)?, seed, weights)
    }

    /// The outcome of [`Robot::ik_nearest`] in a sentence, for a pose that was checked.
    #[cfg(feature = "python")]
    pub(crate) fn explain(&self, pose: &Pose) -> Result<Explanation, Error> {
        let solutions = self.ik_checked(*pose, 0.0)?;
        if !solutions.iter().any(Solution::within_limits)
            && self.nearest_of(&solutions, &self.resting(0.0), &[1.0; 6])?.is_some()
        {
            return Ok(Explanation::Found { solutions: solutions.len(), inside: 1 });
        }
        Ok(solutions.explain())
    }
}

impl Robot<7> {
    /// Every joint vector that brings the tool to `pose` with joint 7 at `q7` [rad].
    ///
    /// Otherwise as [`Robot::<6>::ik`]. Derivation: docs/seven_axes.md.
    ///
    /// # Errors
    ///
    /// As [`Robot::<6>::ik`], and [`Error::InvalidJoints`] when `q7` is not finite.
    pub fn ik(&self, pose: &Pose, q7: f64) -> Result<Solutions<7>, Error> {
        check_given(q7)?;
        self.ik_checked(checked_pose(pose)?, q7)
    }
}

/// What arms of six and of seven joints both do, each in its way.
pub(crate) trait Inverse<const N: usize> {
    /// Every joint vector of many poses, in lanes: rows of pose elements in, and joint 7 of each for an arm of seven joints; slots and
    /// their status out.
    fn ik_rows(
        &self,
        poses: &[PoseRow],
        given: &[f64],
        q: &mut [AnswerRow<N>],
        status: &mut [StatusRow],
    );

    /// [`Robot::ik_nearest`] for arguments that were checked where they came in.
    fn ik_nearest_checked(
        &self,
        pose: Pose,
        seed: &[f64; N],
        weights: &[f64; N],
    ) -> Result<Solution<N>, Error>;
}

impl Inverse<6> for Robot<6> {
    fn ik_rows(
        &self,
        poses: &[PoseRow],
        given: &[f64],
        q: &mut [AnswerRow<6>],
        status: &mut [StatusRow],
    ) {
        let careful = |row: usize, q: &mut AnswerRow<6>, status: &mut StatusRow| {
            self.ik_row(&poses[row], 0.0, q, status)
        };
        match self.geometry() {
            Geometry::SphericalWrist(solver) => {
                run(Blocks { solver, poses, given, q, status, careful })
            }
            Geometry::ThreeParallel(solver) => {
                run(Blocks { solver, poses, given, q, status, careful })
            }
            _ => self.ik_rows_carefully(poses, given, q, status),
        }
    }

    fn ik_nearest_checked(
        &self,
        pose: Pose,
        seed: &[f64; 6],
        weights: &[f64; 6],
    ) -> Result<Solution<6>, Error> {
        let mut solutions = self.unsolved(pose);
        let nearest = if self.solve_in_lanes(&mut solutions, 0.0) {
            solutions.cheapest(seed, weights, Cost::Distance)
        } else {
            self.solve_at_rest(&mut solutions, 0.0)?;
            let wanted = Wanted { limits: solutions.limits, seed, weights, accepts: &|_| true };
            self.nearest_at_singularity(&solutions, &wanted)?
        };
        nearest.ok_or_else(|| Error::Unreachable(solutions.explain()))
    }
}

impl Inverse<7> for Robot<7> {
    fn ik_rows(
        &self,
        poses: &[PoseRow],
        given: &[f64],
        q: &mut [AnswerRow<7>],
        status: &mut [StatusRow],
    ) {
        let careful = |row: usize, q: &mut AnswerRow<7>, status: &mut StatusRow| {
            self.ik_row(&poses[row], given[row], q, status)
        };
        match self.geometry() {
            Geometry::SphericalShoulder(solver) => {
                run(Blocks { solver, poses, given, q, status, careful })
            }
            _ => self.ik_rows_carefully(poses, given, q, status),
        }
    }

    fn ik_nearest_checked(
        &self,
        pose: Pose,
        seed: &[f64; 7],
        weights: &[f64; 7],
    ) -> Result<Solution<7>, Error> {
        self.nearest_along_redundancy(&pose, seed, weights)
    }
}

impl<const N: usize> Robot<N> {
    /// [`Robot::ik`] for arguments that were checked where they came in.
    pub(crate) fn ik_checked(&self, pose: Pose, given: f64) -> Result<Solutions<N>, Error> {
        let mut solutions = self.unsolved(pose);
        self.ik_into(&mut solutions, given)?;
        Ok(solutions)
    }

    fn ik_rows_carefully(
        &self,
        poses: &[PoseRow],
        given: &[f64],
        q: &mut [AnswerRow<N>],
        status: &mut [StatusRow],
    ) {
        for (row, (q, status)) in q.iter_mut().zip(status).enumerate() {
            self.ik_row(&poses[row], given.get(row).copied().unwrap_or(0.0), q, status);
        }
    }

    /// One row by itself.
    #[cold]
    fn ik_row(&self, pose: &PoseRow, given: f64, q: &mut AnswerRow<N>, status: &mut StatusRow) {
        q.fill([f64::NAN; N]);
        let pose = check_given(given).and_then(|()| pose_from_rows(pose));
        let Ok(solutions) = pose.and_then(|pose| self.ik_checked(pose, given)) else {
            status.fill(Status::INVALID.bits());
            return;
        };
        *status = solutions.status().map(|status| status.bits());
        for solution in &solutions {
            q[usize::from(solution.slot)] = solution.q;
        }
    }

    /// An answer without solutions, to solve in the place where it stands.
    #[inline]
    pub(crate) fn unsolved(&self, pose: Pose) -> Solutions<N> {
        let empty = [Status::empty(); SLOTS];
        Solutions {
            slots: [None; SLOTS],
            merged: empty,
            reach: Reach::Reached,
            pose,
            limits: *self.limits(),
            emptied: None,
        }
    }

    /// [`Robot::ik_checked`] of an unsolved answer's pose, without moving the answer about. An arm of seven joints has joint 7 at `given`.
    pub(crate) fn ik_into(&self, solutions: &mut Solutions<N>, given: f64) -> Result<(), Error> {
        if self.solve_in_lanes(solutions, given) {
            return Ok(());
        }
        self.solve_at_rest(solutions, given)
    }

    /// [`Self::ik_into`] of a pose that is not regular.
    #[cold]
    pub(in crate::kinematics) fn solve_at_rest(
        &self,
        solutions: &mut Solutions<N>,
        given: f64,
    ) -> Result<(), Error> {
        self.solve_carefully(solutions, &FreeChoice::rest(self.resting(given)))?;
        self.bring_families_inside(solutions, meets(&solutions.pose))?;
        self.bring_one_inside(solutions)
    }

    /// Whether a pose is far enough from every singularity for the lanes to solve it.
    pub(in crate::kinematics) fn is_regular(&self, pose: &Pose) -> bool {
        self.solve_in_lanes(&mut self.unsolved(*pose), 0.0)
    }

    /// Where joints rest, joint 7 of an arm of seven joints at `given`.
    pub(in crate::kinematics) fn resting(&self, given: f64) -> [f64; N] {
        let mut rest = self.limits().rest();
        if let Some(last) = rest.get_mut(6) {
            *last = given;
        }
        rest
    }

    pub(in crate::kinematics) fn solve(
        &self,
        pose: Pose,
        free: &FreeChoice<N>,
    ) -> Result<Solutions<N>, Error> {
        let mut solutions = self.unsolved(pose);
        if !(free.leaves_plain_poses_alone() && self.solve_in_lanes(&mut solutions, free.given())) {
            self.solve_carefully(&mut solutions, free)?;
        }
        Ok(solutions)
    }

    /// Whatever the pose, one branch after the other.
    #[cold]
    fn solve_carefully(
        &self,
        solutions: &mut Solutions<N>,
        free: &FreeChoice<N>,
    ) -> Result<(), Error> {
        let branches =
            self.geometry().branches(&solutions.pose, free).map_err(ModelFault::NoClosedForm)?;
        for (slot, place) in solutions.slots.iter_mut().enumerate() {
            let Some(q) = branches.q[slot] else { continue };
            let mut q = self.limits().settle(q);
            // A joint that was told its angle keeps it.
            if let Some(last) = q.get_mut(6) {
                *last = free.given();
            }
            let mut status = branches.flags[slot] | Status::FOUND;
            status.set(Status::WITHIN_LIMITS, self.limits().contain(&q));
            #[expect(clippy::cast_possible_truncation, reason = "eight slots")]
            let solution = Solution { q, slot: slot as u8, status, free: branches.free[slot] };
            *place = Some(solution);
        }
        solutions.merged = branches
            .flags
            .map(|flags| if flags.contains(Status::MERGED) { flags } else { Status::empty() });
        solutions.reach = branches.reach;
        Ok(())
    }

    /// Solves a pose that is plain, and tells whether it was.
    #[inline]
    pub(in crate::kinematics) fn solve_in_lanes(
        &self,
        solutions: &mut Solutions<N>,
        given: f64,
    ) -> bool {
        let pose = &solutions.pose;
        if pose.translation.vector.iter().any(|coordinate| coordinate.abs() > MOST_LENGTH) {
            return false;
        }
        match self.geometry() {
            Geometry::SphericalWrist(solver) => match run(spherical_wrist::Single { solver, pose })
            {
                Some(plain) => put(&mut solutions.slots, |slot| plain.slot(slot)),
                None => return false,
            },
            Geometry::ThreeParallel(solver) => match run(three_parallel::Single { solver, pose }) {
                Some(plain) => put(&mut solutions.slots, |slot| plain.slot(slot)),
                None => return false,
            },
            Geometry::SphericalShoulder(solver) => {
                match run(spherical_shoulder::Single { solver, pose, q7: given }) {
                    Some(plain) => put(&mut solutions.slots, |slot| plain.slot(slot)),
                    None => return false,
                }
            }
            Geometry::Serial(_) => return false,
        }
        true
    }
}

/// Puts the joint angles and flags of plain slots where they belong.
#[inline]
fn put<const M: usize, const N: usize>(
    slots: &mut [Option<Solution<N>>; SLOTS],
    plain: impl Fn(usize) -> Option<([f64; M], u8)>,
) {
    for (slot, place) in slots.iter_mut().enumerate() {
        let Some((q, status)) = plain(slot) else { continue };
        #[expect(clippy::cast_possible_truncation, reason = "eight slots")]
        let solution = Solution {
            q: resized(&q),
            slot: slot as u8,
            status: Status::from_bits_retain(status),
            free: None,
        };
        *place = Some(solution);
    }
}

/// Joint 7 of an arm of seven joints must be an angle.
pub(crate) fn check_given(q7: f64) -> Result<(), Error> {
    if q7.is_finite() {
        Ok(())
    } else {
        Err(JointFault::NotFinite { field: "q7", joint: 7, value: q7 }.into())
    }
}

#[cfg(test)]
mod tests;
