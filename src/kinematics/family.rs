//! The solution next to a seed, and the family of solutions along a joint that a singular pose leaves free.

use core::f64::consts::{PI, TAU};

use super::free_choice::FreeChoice;
use super::limits::JointLimits;
use super::pose::{Pose, checked_pose};
use super::robot::Robot;
use super::select::{Cost, check_joints};
use super::solutions::{FreeJoint, SLOTS, Solution, Solutions};
use super::status::{Explanation, Status};
use super::thresholds::SOLUTION_OFF;
use crate::error::{Error, JointFault};

/// Steps of a turn in which a free joint that moves the whole wrist is searched for a place inside the limits.
const STEPS: u32 = 360;

impl<const N: usize> Robot<N> {
    /// The solution of the same pose whose free joint stands at `value` [rad]; `None` where no joint is free.
    ///
    /// The tool stays to rounding at the singularity, and next to it within twice the pose's distance from it: at most 3e-9 rad or m.
    ///
    /// # Errors
    ///
    /// As [`Robot::ik`], [`Error::InvalidJoints`] when the value is not finite or the solution is none of the pose, and
    /// [`Error::Unreachable`] when the arm does not reach with the free joint there.
    pub fn with_free(&self, pose: &Pose, solution: &Solution<N>, value: f64) -> Result<Option<Solution<N>>, Error> {
        let Some(free) = solution.free else { return Ok(None) };
        let off = self.residual(&solution.q, pose).largest();
        if off > SOLUTION_OFF {
            return Err(JointFault::NotOfPose { off }.into());
        }
        check_joints("value", &[value]).map_err(|_| JointFault::NotFinite { field: "value", joint: free.joint(), value })?;
        let moved = self.with_free_at(&checked_pose(pose)?, solution, free, value)?;
        moved.map(Some).ok_or(Error::Unreachable(Explanation::FreeOutOfReach { joint: free.joint(), value }))
    }

    /// [`Self::with_free`] for a pose and a solution of it that were checked; `None` where the arm does not reach.
    fn with_free_at(&self, pose: &Pose, solution: &Solution<N>, free: FreeJoint, value: f64) -> Result<Option<Solution<N>>, Error> {
        let (joint, slot) = (free.joint(), usize::from(solution.slot));
        let mut q = solution.q;
        q[joint - 1] = value;
        let solutions = self.solve(*pose, &FreeChoice::forced(q, joint, slot >= SLOTS / 2))?;
        // The same branch, or the one that it becomes: the free joint may flip what turns with it, straighten the elbow or bring another
        // singularity.
        let others: &[usize] = match free {
            FreeJoint::ShoulderSum | FreeJoint::ShoulderDifference => &[0, 4],
            FreeJoint::Forearm | FreeJoint::Hand => &[0, 1, 4, 5],
            FreeJoint::Parallel => &[0, 1, 2, 3],
            FreeJoint::Base | FreeJoint::Upper | FreeJoint::WristSum | FreeJoint::WristDifference => &[0, 1],
        };
        let moved = others.iter().find_map(|other| solutions.slot(slot ^ other));
        Ok(moved.map(|moved| {
            let mut moved = *moved;
            moved.q[joint - 1] = value;
            moved.status.set(Status::WITHIN_LIMITS, self.limits().contain(&moved.q));
            moved
        }))
    }

    /// The solution inside the limits that is nearest to `seed`; where the one with the seed's free joint has another joint outside them,
    /// the nearest of its family.
    pub(super) fn nearest_of(&self, solutions: &Solutions<N>, seed: &[f64; N], weights: &[f64; N]) -> Result<Option<Solution<N>>, Error> {
        let nearest = solutions.cheapest(seed, weights, Cost::Distance);
        if nearest.is_some() {
            return Ok(nearest);
        }
        self.nearest_in_families(solutions, solutions.into_iter(), seed, weights)
    }

    /// Where a solution of a family is outside the limits and another one of it, which is `allowed` [rad, m] off the pose at most, is not,
    /// that one takes its slot.
    pub(super) fn bring_families_inside(&self, solutions: &mut Solutions<N>, allowed: f64) -> Result<(), Error> {
        for slot in 0..SLOTS {
            let Some(outside) = solutions.slots[slot].filter(|solution| solution.free.is_some() && !solution.within_limits()) else {
                continue;
            };
            let rest = self.resting(outside.q[N - 1]);
            let inside = self.nearest_in_families(solutions, [&outside].into_iter(), &rest, &[1.0; N])?;
            if let Some(inside) = inside.filter(|inside| self.residual(&inside.q, solutions.pose()).largest() <= allowed) {
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
        solutions: &Solutions<N>,
        among: impl Iterator<Item = &'a Solution<N>> + Clone,
        seed: &[f64; N],
        weights: &[f64; N],
    ) -> Result<Option<Solution<N>>, Error> {
        // A branch that was merged with another meets the pose as well; any other place in the family to its distance from the singularity.
        let twins = self.nearest_among(solutions, among.clone(), seed, weights, twin)?;
        if twins.is_some() {
            return Ok(twins);
        }
        self.nearest_among(solutions, among, seed, weights, |solution, free| {
            edges(self.limits(), &solution.q, free).into_iter().flatten().chain(steps(free))
        })
    }

    /// The nearest to `seed` inside the limits of the solutions that have their free joint at one of the values.
    fn nearest_among<'a, I: IntoIterator<Item = f64>>(
        &self,
        solutions: &Solutions<N>,
        among: impl Iterator<Item = &'a Solution<N>>,
        seed: &[f64; N],
        weights: &[f64; N],
        values: impl Fn(&Solution<N>, FreeJoint) -> I,
    ) -> Result<Option<Solution<N>>, Error> {
        let mut best: Option<(f64, Solution<N>)> = None;
        for solution in among {
            let Some(free) = solution.free else { continue };
            for value in values(solution, free) {
                let Some(moved) = self.with_free_at(solutions.pose(), solution, free, value)? else { continue };
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

/// The angle of the free joint at which the branch stands that was merged with this one, where it is of the same family.
fn twin<const N: usize>(solution: &Solution<N>, free: FreeJoint) -> Option<f64> {
    let turned = free.partner().is_some() || free == FreeJoint::Parallel;
    turned.then(|| solution.q[free.joint() - 1] + PI)
}

/// The angles of a free joint at which it or its partner comes to a limit. Where any angle keeps both inside, one of these does: the angles
/// inside are intervals, and these are their ends.
fn edges<const N: usize>(limits: &JointLimits<N>, q: &[f64; N], free: FreeJoint) -> Option<[f64; 4]> {
    let (partner, sign) = free.partner()?;
    let (own, other) = (free.joint() - 1, partner - 1);
    let ([low, high], [other_low, other_high]) = (limits.to_array()[own], limits.to_array()[other]);
    let fixed = q[own] + sign * q[other];
    Some([low, high, fixed - sign * other_low, fixed - sign * other_high].map(|edge| if edge.is_finite() { edge } else { q[own] }))
}

/// The angles at which a free joint is tried whose family moves more than a partner.
fn steps(free: FreeJoint) -> impl Iterator<Item = f64> {
    let steps = if free.partner().is_some() { 0 } else { STEPS };
    (0..steps).map(|step| TAU * f64::from(step) / f64::from(STEPS))
}
