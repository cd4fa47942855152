//! The solution nearest to a seed, and the outcome of a search in a sentence.

use core::f64::consts::PI;

use nalgebra::{IsometryMatrix3, Rotation3, Unit, Vector3};

use crate::error::Error;
use crate::kinematics::answer::check::{check_seed, check_seed_near, check_weights};
use crate::kinematics::answer::select::Cost;
use crate::kinematics::answer::slot::Slot;
use crate::kinematics::answer::solutions::{Solution, Solutions};
use crate::kinematics::answer::status::Status;
use crate::kinematics::pose::{Pose, checked_pose, pose_from_rows};
use crate::kinematics::robot::{Definition, Lock, Robot};
use crate::kinematics::solve::correction::DETERMINED;
use crate::kinematics::solve::nearest::Wanted;
use crate::kinematics::solve::self_motion::meets;
use crate::kinematics::structure::free_choice::FreeChoice;
use crate::kinematics::structure::lanes::Choice;
use crate::kinematics::structure::locked::others;
use crate::kinematics::thresholds::SOLUTION_OFF;
use crate::report::Explanation;

impl<const N: usize> Robot<N> {
    /// The solution inside the limits that is nearest to `seed` [rad] among all 2 pi equivalents,
    /// all members of a self-motion and, for an arm of seven joints, all angles of joint 7; or all
    /// that have a locked joint at its angle. A seed at the pose that exceeds limits by rounding, at
    /// most [`START_TOLERANCE`](crate::thresholds::START_TOLERANCE), is the answer, at these limits.
    ///
    /// # Errors
    ///
    /// As [`Robot::ik_with`], [`Error::InvalidJoints`] for a seed or weight that is not finite, and
    /// [`Error::Unreachable`] when no solution is inside the limits.
    pub fn ik_nearest(
        &self,
        pose: &Pose,
        seed: &[f64; N],
        weights: &[f64; N],
    ) -> Result<Solution<N>, Error> {
        check_seed_near(seed, self.limits(), weights)?;
        check_weights(weights)?;
        self.nearest_checked(checked_pose(pose)?, seed, weights)
    }

    /// [`Self::ik_nearest`] with arguments that are checked.
    #[doc(hidden)]
    pub fn nearest_checked(
        &self,
        pose: Pose,
        seed: &[f64; N],
        weights: &[f64; N],
    ) -> Result<Solution<N>, Error> {
        self.known_inverse()?;
        if let Some(lock) = self.lock() {
            return self.nearest_locked(lock, &pose, seed, weights);
        }
        if let Some(there) = self.at_limits(&pose, seed) {
            return Ok(there);
        }
        if let Some(arm) = self.redundancy() {
            return arm.nearest_along_redundancy(&pose, seed, weights, &|_| true);
        }
        let mut solutions = self.unsolved(pose);
        let nearest = if self.solve_in_lanes(&mut solutions, f64::NAN) {
            solutions.cheapest(seed, weights, Cost::Distance)
        } else {
            self.solve_singular(&mut solutions, f64::NAN)?;
            if self.are_regular(&solutions) {
                solutions.cheapest(seed, weights, Cost::Distance)
            } else {
                let wanted = Wanted { limits: solutions.limits, seed, weights, accepts: &|_| true };
                self.nearest_at_singularity(&solutions, &wanted)?
            }
        };
        let nearest = match self.definition() {
            Definition::Refined { .. } => self.nearest_of_seed(&solutions, nearest, seed, weights),
            _ => nearest,
        };
        nearest.ok_or_else(|| Error::Unreachable(solutions.explain()))
    }

    /// A seed at the pose that exceeds limits by rounding, at these limits: the arm is there, so
    /// another branch would be a swing.
    pub(crate) fn at_limits(&self, pose: &Pose, seed: &[f64; N]) -> Option<Solution<N>> {
        let q = self.limits().rounded_in(seed)?;
        let is_there = self.residual(seed, pose).largest() <= SOLUTION_OFF
            && self.limits().linkage_excess(&q) == 0.0;
        let status = Status::FOUND | Status::WITHIN_LIMITS;
        let slot = self.slot_of(&q).unwrap_or(Slot::new(0));
        is_there.then_some(Solution { q, slot, status, free_joint: None })
    }

    /// [`Self::ik_nearest`] among the solutions that satisfy a condition. Of seven joints none of
    /// which is locked, among those that the search along the redundancy passes.
    #[doc(hidden)]
    pub fn nearest_accepted(
        &self,
        pose: &Pose,
        seed: &[f64; N],
        weights: &[f64; N],
        accepts: &dyn Fn(&[f64; N]) -> bool,
    ) -> Result<Solution<N>, Error> {
        let pose = checked_pose(pose)?;
        if let Some(arm) = self.redundancy() {
            return arm.nearest_along_redundancy(&pose, seed, weights, accepts);
        }
        let locked = self.locked_joint().map_or(f64::NAN, |(_, angle)| angle);
        let solutions = self.ik_checked(pose, locked)?;
        let accepts = |solution: &Solution<N>| accepts(&solution.q);
        let wanted = Wanted { limits: *self.limits(), seed, weights, accepts: &accepts };
        let nearest = self.nearest_at_singularity(&solutions, &wanted)?;
        nearest.ok_or_else(|| Error::Unreachable(solutions.explain()))
    }

    /// The nearer of a solution and the one on the branch of the seed, which need not be a branch of
    /// the nominal arm: by Newton's method, as [`Robot::follow`] does.
    fn nearest_of_seed(
        &self,
        solutions: &Solutions<N>,
        nearest: Option<Solution<N>>,
        seed: &[f64; N],
        weights: &[f64; N],
    ) -> Option<Solution<N>> {
        /// Most that a joint moves on a regular branch, for each m or rad of the tool [1].
        const REGULAR: f64 = 10.0;
        let (pose, limits) = (&solutions.pose, &solutions.limits);
        let near = REGULAR * self.residual(seed, pose).largest();
        let is_near = |q: &[f64; N]| (0..N).all(|joint| (q[joint] - seed[joint]).abs() <= near);
        if nearest.is_some_and(|nearest| is_near(&nearest.q)) {
            return nearest;
        }
        let (q, off) = self.corrected(pose, *seed, limits, &[], DETERMINED);
        let cost = |q: &[f64; N]| Cost::Distance.total(q, seed, weights);
        let is_nearer = nearest.is_none_or(|nearest| cost(&q) < cost(&nearest.q));
        if off > meets(pose) || !limits.contains(&q) || !is_nearer {
            return nearest;
        }
        let slot = self.slot_of(&q).or(nearest.map(|nearest| nearest.slot));
        let status = Status::FOUND | Status::WITHIN_LIMITS;
        Some(Solution { q, slot: slot.unwrap_or(Slot::new(0)), status, free_joint: None })
    }

    /// [`Self::nearest_checked`] of the other six joints, for an arm with a locked joint.
    fn nearest_locked(
        &self,
        lock: &Lock<N>,
        pose: &Pose,
        seed: &[f64; N],
        weights: &[f64; N],
    ) -> Result<Solution<N>, Error> {
        let unreachable = || {
            let solutions = self.ik_checked(*pose, lock.angle);
            solutions.map_or_else(|error| error, |none| Error::Unreachable(none.explain()))
        };
        if self.limits().excess(lock.joint.joint(), lock.angle) > 0.0 {
            return Err(unreachable());
        }
        let [seed, weights] = [seed, weights].map(|all| others(all, lock.joint.joint()));
        let seen = lock.joint.seen(pose, lock.angle);
        match lock.six.nearest_checked(seen, &seed, &weights) {
            Ok(six) => {
                let found = lock.joint.solution(&six, lock.angle, self.limits());
                let own = (lock.joint.joint() == 6).then(|| self.slot_of(&found.q)).flatten();
                Ok(Solution { slot: own.unwrap_or(found.slot), ..found })
            }
            // With the arm's numbers of joints.
            Err(Error::Unreachable(_)) => Err(unreachable()),
            Err(error) => Err(error),
        }
    }

    /// The solution inside the limits that continues a path whose joints head for `heading`: of six
    /// joints the nearest one, of seven the nearest along the self-motion that passes there.
    pub(in crate::kinematics) fn continued(
        &self,
        pose: &Pose,
        heading: &[f64; N],
        weights: &[f64; N],
    ) -> Result<Option<Solution<N>>, Error> {
        if let Some(arm) = self.redundancy() {
            return arm.continued_along_redundancy(pose, heading, weights);
        }
        let solutions = self.solve(*pose, &FreeChoice::path(*heading))?;
        Ok(solutions.cheapest(heading, weights, Cost::Distance))
    }

    /// [`Self::nearest_checked`] of rows of poses and seeds, for weights that are checked; NaN of a
    /// row that has no solution.
    pub(crate) fn nearest_rows(
        &self,
        poses: &[[f64; 16]],
        seeds: &[[f64; N]],
        weights: &[f64; N],
        q: &mut [[f64; N]],
    ) {
        let choice = Choice::new(self.limits(), weights);
        let mut by_itself = |row: usize, q: &mut [[f64; N]], _: &mut [u8]| {
            q.fill(self.nearest_row(&poses[row], &seeds[row], weights));
        };
        match self.inverse().filter(|_| N == 6) {
            Some(inverse) => {
                inverse.nearest_rows(poses, seeds, choice, q, &mut by_itself);
                for (row, seed) in seeds.iter().enumerate() {
                    if self.limits().rounded_in(seed).is_some() {
                        q[row] = self.nearest_row(&poses[row], seed, weights);
                    }
                }
            }
            None => {
                for (row, q) in q.iter_mut().enumerate() {
                    by_itself(row, core::slice::from_mut(q), &mut []);
                }
            }
        }
    }

    /// One row of [`Self::nearest_rows`] by itself.
    pub(crate) fn nearest_row(
        &self,
        pose: &[f64; 16],
        seed: &[f64; N],
        weights: &[f64; N],
    ) -> [f64; N] {
        let checked =
            check_seed_near(seed, self.limits(), weights).and_then(|()| pose_from_rows(pose));
        let nearest = checked.and_then(|pose| self.nearest_checked(pose, seed, weights));
        nearest.map_or([f64::NAN; N], |nearest| nearest.q)
    }

    /// The outcome of a search in a sentence, for a pose that is checked.
    #[doc(hidden)]
    pub fn explain(&self, pose: &Pose) -> Result<Explanation, Error> {
        if let Some(lock) = self.lock() {
            let explanation = self.ik_checked(*pose, lock.angle)?.explain();
            let seen = lock.joint.seen(pose, lock.angle);
            return Ok(lock.six.with_approach(explanation, &seen));
        }
        if let Some(arm) = self.redundancy() {
            return arm.explain_along_redundancy(pose);
        }
        let solutions = self.ik_checked(*pose, f64::NAN)?;
        if !solutions.iter().any(Solution::is_within_limits)
            && self.nearest_of(&solutions, &self.limits().rest(), &[1.0; N])?.is_some()
        {
            return Ok(Explanation::Found { solutions: solutions.len(), inside: 1 });
        }
        Ok(self.with_approach(solutions.explain(), pose))
    }

    /// The outcome of a solve in a sentence, with the nearest approach; of seven joints with joint
    /// 7 at `q7` [rad], unless a joint is locked.
    #[doc(hidden)]
    pub fn explained_answer(&self, solutions: &Solutions<N>, q7: Option<f64>) -> Explanation {
        let explanation = solutions.explain();
        let Explanation::NoRoots { .. } = explanation else { return explanation };
        let locked;
        let arm = match (N, q7) {
            (7, Some(q7)) => {
                let Ok(arm) = self.clone().with_lock(Some((7, q7))) else { return explanation };
                locked = arm;
                &locked
            }
            _ => self,
        };
        match arm.lock() {
            Some(lock) => {
                let seen = lock.joint.seen(solutions.pose(), lock.angle);
                lock.six.with_approach(explanation, &seen)
            }
            None if N == 7 => explanation,
            None => self.with_approach(explanation, solutions.pose()),
        }
    }
}

impl Robot<5> {
    /// The solution inside the limits that brings the tool to the point of `pose` and keeps the roll
    /// of `seed`, with the elevation nearest to the seed's at which the arm reaches; of several the
    /// nearest one. The rotation of `pose` is not regarded.
    ///
    /// # Errors
    ///
    /// As [`Robot::ik_nearest`].
    pub fn ik_nearest_position(
        &self,
        pose: &Pose,
        seed: &[f64; 5],
        weights: &[f64; 5],
    ) -> Result<Solution<5>, Error> {
        /// Step of the elevation [rad].
        const STEP: f64 = PI / 90.0;
        /// Halvings of the step to the edge of reach: to 1e-13 rad.
        const HALVINGS: u32 = 38;
        check_seed("seed", seed)?;
        let point = checked_pose(pose)?.translation;
        let arm = self.clone().with_heading_tolerance(PI)?;
        let at_seed = self.fk(seed).rotation;
        let axis_2 = Unit::new_unchecked(self.link_frames(seed).0[1].rotation * Vector3::z());
        let raised = |angle: f64| {
            let rotation = Rotation3::from_axis_angle(&axis_2, angle) * at_seed;
            arm.ik_nearest(&IsometryMatrix3::from_parts(point, rotation), seed, weights)
        };
        let level = raised(0.0);
        if level.is_ok() {
            return level;
        }
        // Not by the tolerances of reach and limits: from there the next call must get on.
        let limits = self.limits().to_array();
        let well_inside = |angle: f64| {
            let found = raised(angle).ok()?;
            let off = self.fk(&found.q).translation.vector - point.vector;
            let is_inside =
                found.q.iter().zip(limits).all(|(q, [low, high])| (low..=high).contains(q));
            (is_inside && off.norm() <= meets(pose)).then_some(found)
        };
        for step in 1..=90 {
            for side in [STEP, -STEP] {
                let mut far = f64::from(step) * side;
                let mut near = far - side;
                let Some(mut best) = well_inside(far) else { continue };
                for _ in 0..HALVINGS {
                    let middle = 0.5 * (near + far);
                    match well_inside(middle) {
                        Some(found) => (far, best) = (middle, found),
                        None => near = middle,
                    }
                }
                return Ok(best);
            }
        }
        level
    }
}
