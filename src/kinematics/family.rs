//! The solution next to a seed, and the family of solutions along a joint that a singular pose leaves free.

use core::f64::consts::{PI, TAU};

use super::free_choice::FreeChoice;
use super::limits::JointLimits;
use super::pose::{Pose, checked_pose};
use super::robot::Robot;
use super::select::{Cost, check_joints, check_weights};
use super::solutions::{FreeJoint, SLOTS, Solution, Solutions};
use super::status::Status;
use super::thresholds::SOLUTION_OFF;
use crate::error::{Error, JointFault};

/// Steps of a turn in which a free joint that moves the whole wrist is searched for a place inside the limits.
const STEPS: u32 = 360;

impl Robot<6> {
    /// The solution inside the limits that is nearest to `seed` [rad], turns considered; free joints keep the seed's angle.
    ///
    /// # Errors
    ///
    /// As [`Robot::ik`], [`Error::InvalidJoints`] for a seed or weight that is not finite, and [`Error::Unreachable`] when no solution
    /// is inside the limits.
    pub fn ik_nearest(&self, pose: &Pose, seed: &[f64; 6], weights: &[f64; 6]) -> Result<Solution<6>, Error> {
        check_joints("seed", seed)?;
        check_weights(weights)?;
        self.ik_nearest_checked(checked_pose(pose)?, seed, weights)
    }

    /// [`Robot::ik_nearest`] for arguments that were checked where they came in.
    pub(crate) fn ik_nearest_checked(&self, pose: Pose, seed: &[f64; 6], weights: &[f64; 6]) -> Result<Solution<6>, Error> {
        let solutions = self.solve(pose, &FreeChoice::seed(*seed))?;
        let nearest = self.nearest_of(&solutions, seed, weights)?;
        nearest.ok_or_else(|| Error::Unreachable(solutions.explain()))
    }

    /// The solution of the same pose whose free joint stands at `value` [rad]; `None` where no joint is free.
    ///
    /// The tool stays to rounding at the singularity, and next to it within twice the pose's distance from it: at most 3e-9 rad or m.
    ///
    /// # Errors
    ///
    /// As [`Robot::ik`], and [`Error::InvalidJoints`] when the value is not finite or the solution is none of the pose.
    pub fn with_free(&self, pose: &Pose, solution: &Solution<6>, value: f64) -> Result<Option<Solution<6>>, Error> {
        let Some(free) = solution.free else { return Ok(None) };
        let off = self.residual(&solution.q, pose).largest();
        if off > SOLUTION_OFF {
            return Err(JointFault::NotOfPose { off }.into());
        }
        let joint = free.joint();
        let mut q = solution.q;
        q[joint - 1] = value;
        check_joints("value", &q)?;
        let slot = usize::from(solution.slot);
        let solutions = self.solve(checked_pose(pose)?, &FreeChoice::forced(q, joint, slot >= SLOTS / 2))?;
        let moved = solutions.slot(slot).or_else(|| solutions.slot(slot ^ 1));
        Ok(moved.map(|moved| {
            let mut moved = *moved;
            moved.q[joint - 1] = value;
            moved.status.set(Status::WITHIN_LIMITS, self.limits().contain(&moved.q));
            moved
        }))
    }

    /// The solution inside the limits that is nearest to `seed`; where the one with the seed's free joint has another joint outside them,
    /// the nearest of its family.
    pub(super) fn nearest_of(&self, solutions: &Solutions<6>, seed: &[f64; 6], weights: &[f64; 6]) -> Result<Option<Solution<6>>, Error> {
        let nearest = solutions.cheapest(seed, weights, Cost::Distance);
        if nearest.is_some() {
            return Ok(nearest);
        }
        self.nearest_in_families(solutions, solutions.into_iter(), seed, weights)
    }

    /// Where a solution of a family is outside the limits and another one of it is not, that one takes its slot.
    pub(super) fn bring_families_inside(&self, solutions: &mut Solutions<6>) -> Result<(), Error> {
        for slot in 0..SLOTS {
            let Some(outside) = solutions.slots[slot].filter(|solution| solution.free.is_some() && !solution.within_limits()) else {
                continue;
            };
            let rest = self.limits().rest();
            if let Some(inside) = self.nearest_in_families(solutions, [&outside].into_iter(), &rest, &[1.0; 6])? {
                let to = usize::from(inside.slot);
                solutions.merged.swap(slot, to);
                solutions.slots[slot] = None;
                solutions.slots[to] = Some(inside);
            }
        }
        Ok(())
    }

    fn nearest_in_families<'a>(
        &self,
        solutions: &Solutions<6>,
        among: impl Iterator<Item = &'a Solution<6>> + Clone,
        seed: &[f64; 6],
        weights: &[f64; 6],
    ) -> Result<Option<Solution<6>>, Error> {
        // A branch that was merged with another meets the pose as well; any other place in the family to its distance from the singularity.
        let twins = self.nearest_among(solutions, among.clone(), seed, weights, |solution, free| match free {
            FreeJoint::WristSum | FreeJoint::WristDifference => Candidates::One(solution.q[3] + PI),
            FreeJoint::Base | FreeJoint::Upper => Candidates::None,
        })?;
        if twins.is_some() {
            return Ok(twins);
        }
        self.nearest_among(solutions, among, seed, weights, |solution, free| match free {
            FreeJoint::WristSum => Candidates::Edges(edges(self.limits(), &solution.q, 1.0)),
            FreeJoint::WristDifference => Candidates::Edges(edges(self.limits(), &solution.q, -1.0)),
            FreeJoint::Base | FreeJoint::Upper => Candidates::Turn,
        })
    }

    /// The nearest to `seed` inside the limits of the solutions that have their free joint at one of the candidates.
    fn nearest_among<'a>(
        &self,
        solutions: &Solutions<6>,
        among: impl Iterator<Item = &'a Solution<6>>,
        seed: &[f64; 6],
        weights: &[f64; 6],
        candidates: impl Fn(&Solution<6>, FreeJoint) -> Candidates,
    ) -> Result<Option<Solution<6>>, Error> {
        let mut best: Option<(f64, Solution<6>)> = None;
        for solution in among {
            let Some(free) = solution.free else { continue };
            let candidates = candidates(solution, free);
            for value in (0..STEPS).map_while(|step| candidates.get(step)) {
                let Some(moved) = self.with_free(solutions.pose(), solution, value)? else { continue };
                let Some(q) = self.limits().turned_to(&moved.q, seed) else { continue };
                let cost = Cost::Distance.total(&q, seed, weights);
                if best.as_ref().is_none_or(|(least, _)| cost < *least) {
                    best = Some((cost, Solution { q, status: moved.status | Status::WITHIN_LIMITS, ..moved }));
                }
            }
        }
        Ok(best.map(|(_, solution)| solution))
    }
}

/// Where a free joint is tried.
enum Candidates {
    None,
    One(f64),
    Edges([f64; 4]),
    Turn,
}

impl Candidates {
    fn get(&self, step: u32) -> Option<f64> {
        match self {
            Self::None => None,
            Self::One(angle) => (step == 0).then_some(*angle),
            Self::Edges(angles) => angles.get(step as usize).copied(),
            Self::Turn => Some(TAU * f64::from(step) / f64::from(STEPS)),
        }
    }
}

/// The angles of joint 4 at which it or joint 6 comes to a limit, q4 + `sign` q6 being fixed. Where any angle keeps both inside, one of
/// these does: the angles inside are intervals, and these are their ends.
fn edges(limits: &JointLimits<6>, q: &[f64; 6], sign: f64) -> [f64; 4] {
    let [_, _, _, [low_4, high_4], _, [low_6, high_6]] = limits.to_array();
    let fixed = q[3] + sign * q[5];
    [low_4, high_4, fixed - sign * low_6, fixed - sign * high_6].map(|edge| if edge.is_finite() { edge } else { q[3] })
}
