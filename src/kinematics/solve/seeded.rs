//! The solution nearest to a seed, for every number of joints that has an inverse.

use alloc::vec::Vec;

use crate::error::{Error, ModelFault};
use crate::kinematics::answer::check::{check_seed, check_weights};
use crate::kinematics::answer::select::Cost;
use crate::kinematics::answer::solutions::{Solution, Solutions};
use crate::kinematics::pose::{Pose, checked_pose, pose_from_rows};
use crate::kinematics::robot::Robot;
use crate::kinematics::solve::configuration::ConfigurationRequest;
use crate::kinematics::solve::nearest::Wanted;
use crate::kinematics::structure::any::AnyStructure as _;
use crate::kinematics::structure::arity::{Arity, Joints};
use crate::kinematics::structure::lanes::Choice;
use crate::report::Explanation;

/// Robots whose inverse can be solved near a seed: of six and of seven joints, each in its own way.
/// Sealed.
pub trait Inverse<const N: usize>: sealed::Sealed {
    /// The solution inside the limits that is nearest to a seed; the arguments are already checked.
    #[doc(hidden)]
    fn nearest_checked(
        &self,
        pose: Pose,
        seed: &[f64; N],
        weights: &[f64; N],
    ) -> Result<Solution<N>, Error>;

    /// [`Self::nearest_checked`] of rows of poses and seeds, for weights that were checked; NaN of a
    /// row that has none.
    #[doc(hidden)]
    fn nearest_rows(
        &self,
        poses: &[[f64; 16]],
        seeds: &[[f64; N]],
        weights: &[f64; N],
        q: &mut [[f64; N]],
    ) {
        for ((pose, seed), q) in poses.iter().zip(seeds).zip(q) {
            *q = self.nearest_row(pose, seed, weights);
        }
    }

    /// One row of [`Self::nearest_rows`] by itself.
    #[doc(hidden)]
    fn nearest_row(&self, pose: &[f64; 16], seed: &[f64; N], weights: &[f64; N]) -> [f64; N] {
        let checked = check_seed("seed", seed).and_then(|()| pose_from_rows(pose));
        let nearest = checked.and_then(|pose| self.nearest_checked(pose, seed, weights));
        nearest.map_or([f64::NAN; N], |nearest| nearest.q)
    }

    /// The outcome of the search in a sentence, for a pose that was checked.
    #[doc(hidden)]
    fn explain(&self, pose: &Pose) -> Result<Explanation, Error>;

    /// The outcome of a solve in a sentence, with what only the arm knows of it; of seven joints
    /// with the joint, from 1, whose angle [rad] was given.
    #[doc(hidden)]
    fn explained_answer(
        &self,
        solutions: &Solutions<N>,
        given: Option<(usize, f64)>,
    ) -> Explanation;

    /// The arm angle of joint angles, of an arm that has one.
    #[doc(hidden)]
    fn arm_angle_of(&self, q: &[f64; N]) -> Result<Option<f64>, Error>;

    /// The solution with the configuration of a request, of several the one nearest to a seed; the
    /// arguments are already checked.
    #[doc(hidden)]
    fn configured(
        &self,
        pose: &Pose,
        request: &ConfigurationRequest<N>,
        seed: &[f64; N],
    ) -> Result<Solution<N>, Error>;

    /// All of them, the nearest first.
    #[doc(hidden)]
    fn all_configured(
        &self,
        pose: &Pose,
        request: &ConfigurationRequest<N>,
        seed: &[f64; N],
    ) -> Result<Vec<Solution<N>>, Error>;
}

mod sealed {
    pub trait Sealed {}

    impl Sealed for crate::kinematics::robot::Robot<6> {}
    impl Sealed for crate::kinematics::robot::Robot<7> {}
}

impl Inverse<6> for Robot<6> {
    fn nearest_checked(
        &self,
        pose: Pose,
        seed: &[f64; 6],
        weights: &[f64; 6],
    ) -> Result<Solution<6>, Error> {
        let mut solutions = self.unsolved(pose);
        let nearest = if self.solve_in_lanes(&mut solutions, ()) {
            solutions.cheapest(seed, weights, Cost::Distance)
        } else {
            self.solve_at_rest(&mut solutions, ())?;
            if self.are_regular(&solutions) {
                solutions.cheapest(seed, weights, Cost::Distance)
            } else {
                let wanted = Wanted { limits: solutions.limits, seed, weights, accepts: &|_| true };
                self.nearest_at_singularity(&solutions, &wanted)?
            }
        };
        nearest.ok_or_else(|| Error::Unreachable(solutions.explain()))
    }

    fn nearest_rows(
        &self,
        poses: &[[f64; 16]],
        seeds: &[[f64; 6]],
        weights: &[f64; 6],
        q: &mut [[f64; 6]],
    ) {
        let choice = Choice::new(self.limits(), weights);
        self.solver().arm().nearest_rows(poses, seeds, choice, q, &mut |row, q, _| {
            q.fill(self.nearest_row(&poses[row], &seeds[row], weights));
        });
    }

    fn explain(&self, pose: &Pose) -> Result<Explanation, Error> {
        let solutions = self.ik_checked(*pose, ())?;
        if !solutions.iter().any(Solution::is_within_limits)
            && self.nearest_of(&solutions, &self.limits().rest(), &[1.0; 6])?.is_some()
        {
            return Ok(Explanation::Found { solutions: solutions.len(), inside: 1 });
        }
        Ok(self.with_approach(solutions.explain(), pose))
    }

    fn explained_answer(&self, solutions: &Solutions<6>, _: Option<(usize, f64)>) -> Explanation {
        self.with_approach(solutions.explain(), solutions.pose())
    }

    fn arm_angle_of(&self, _: &[f64; 6]) -> Result<Option<f64>, Error> {
        Err(ModelFault::NoArmAngle.into())
    }

    fn configured(
        &self,
        pose: &Pose,
        request: &ConfigurationRequest<6>,
        seed: &[f64; 6],
    ) -> Result<Solution<6>, Error> {
        self.configured_near(pose, request, seed)
    }

    fn all_configured(
        &self,
        pose: &Pose,
        request: &ConfigurationRequest<6>,
        seed: &[f64; 6],
    ) -> Result<Vec<Solution<6>>, Error> {
        self.configured_list(pose, request, seed)
    }
}

impl Inverse<7> for Robot<7> {
    fn nearest_checked(
        &self,
        pose: Pose,
        seed: &[f64; 7],
        weights: &[f64; 7],
    ) -> Result<Solution<7>, Error> {
        self.nearest_along_redundancy(&pose, seed, weights)
    }

    fn explain(&self, pose: &Pose) -> Result<Explanation, Error> {
        self.explain_along_redundancy(pose)
    }

    fn explained_answer(
        &self,
        solutions: &Solutions<7>,
        given: Option<(usize, f64)>,
    ) -> Explanation {
        let explanation = solutions.explain();
        let Explanation::NoRoots { .. } = explanation else { return explanation };
        let Some(Ok(given)) = given.map(|(joint, angle)| self.given(joint, angle)) else {
            return explanation;
        };
        given.six().with_approach(explanation, solutions.pose())
    }

    fn arm_angle_of(&self, q: &[f64; 7]) -> Result<Option<f64>, Error> {
        self.arm_angle(q)
    }

    fn configured(
        &self,
        pose: &Pose,
        request: &ConfigurationRequest<7>,
        seed: &[f64; 7],
    ) -> Result<Solution<7>, Error> {
        let list = self.configured_list(pose, request, seed)?;
        list.first().copied().ok_or(Error::Unreachable(Explanation::FilteredOut))
    }

    fn all_configured(
        &self,
        pose: &Pose,
        request: &ConfigurationRequest<7>,
        seed: &[f64; 7],
    ) -> Result<Vec<Solution<7>>, Error> {
        self.configured_list(pose, request, seed)
    }
}

impl<const N: usize> Robot<N>
where
    Self: Inverse<N>,
    Joints<N>: Arity<N>,
{
    /// The solution inside the limits that is nearest to `seed` [rad] among all 2 pi equivalents,
    /// all members of a self-motion and, for an arm of seven joints, all angles of joint 7.
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
        check_seed("seed", seed)?;
        check_weights(weights)?;
        self.nearest_checked(checked_pose(pose)?, seed, weights)
    }
}
