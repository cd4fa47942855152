//! The solution next to a seed, and the family of solutions along a joint that a singular pose leaves free.

use crate::kinematics::structure::arity::{Arity, Joints};
use core::f64::consts::{PI, TAU};

use crate::error::{Error, JointFault};
use crate::kinematics::answer::check::check_angle;
use crate::kinematics::answer::select::Cost;
use crate::kinematics::answer::solutions::{Place, Solution, Solutions};
use crate::kinematics::answer::status::Status;
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::pose::{Pose, checked_pose};
use crate::kinematics::robot::Robot;
use crate::kinematics::structure::free_choice::FreeChoice;
use crate::kinematics::structure::redundancy::Redundancy;
use crate::kinematics::thresholds::{POSITION_ROUNDING, SEEDED_FREE, SOLUTION_OFF};
use crate::report::Explanation;
use crate::report::FreeJoint;

/// Steps of a turn in which a free joint that moves the whole wrist is searched for a place inside the limits.
const STEPS: u32 = 360;

/// The angle of one of them [rad].
const STEP: f64 = TAU / STEPS as f64;

/// Probes between two steps: each leaves 62 % of the way, all of them a rounding.
const NARROWINGS: u32 = 70;

/// Where an interval is cut so that the larger part is cut alike: the golden section.
const GOLDEN: f64 = 0.381_966_011_250_105_1;

/// Places between steps that are looked at in a family.
const PLACES: usize = 16;

impl<const N: usize> Robot<N>
where
    Joints<N>: Arity<N>,
{
    /// The solution of the same pose whose free joint stands at `value` [rad]; `None` where no joint is free.
    ///
    /// The tool stays to rounding at the singularity, and next to it within twice the pose's distance from it: at most 3e-9 rad or m.
    ///
    /// # Errors
    ///
    /// As [`Robot::ik`], [`Error::InvalidJoints`] when the value is not finite or too large or the solution is none of the pose, and
    /// [`Error::Unreachable`] when the arm does not reach with the free joint there.
    pub fn with_free(
        &self,
        pose: &Pose,
        solution: &Solution<N>,
        value: f64,
    ) -> Result<Option<Solution<N>>, Error> {
        let Some(free) = solution.free else { return Ok(None) };
        let off = self.residual(&solution.q, pose).largest();
        if off > SOLUTION_OFF {
            return Err(JointFault::NotOfPose { off }.into());
        }
        check_angle("value", free.joint(), value)?;
        let moved = self.with_free_at(&checked_pose(pose)?, solution, free, value)?;
        moved
            .map(Some)
            .ok_or(Error::Unreachable(Explanation::FreeOutOfReach { joint: free.joint(), value }))
    }

    /// [`Self::with_free`] for a pose and a solution of it that were checked; `None` where the arm does not reach.
    fn with_free_at(
        &self,
        pose: &Pose,
        solution: &Solution<N>,
        free: FreeJoint,
        value: f64,
    ) -> Result<Option<Solution<N>>, Error> {
        let solutions = self.solve_with_free(pose, solution, free, value)?;
        // The same branch, or the one that it becomes.
        Ok(free
            .branches()
            .iter()
            .find_map(|branch| self.member(&solutions, solution, free, value, branch, |_| true)))
    }

    fn solve_with_free(
        &self,
        pose: &Pose,
        solution: &Solution<N>,
        free: FreeJoint,
        value: f64,
    ) -> Result<Solutions<N>, Error> {
        let mut q = solution.q;
        q[free.joint() - 1] = value;
        self.solve(
            *pose,
            &FreeChoice::forced(q, free.joint(), solution.slot.index() >= self.slot_count() / 2),
        )
    }

    /// Of the solutions with the free joint at `value`, the one on this branch of the family of `solution`, in a slot that `may_take` it.
    fn member(
        &self,
        solutions: &Solutions<N>,
        solution: &Solution<N>,
        free: FreeJoint,
        value: f64,
        branch: &[usize],
        may_take: impl Fn(usize) -> bool,
    ) -> Option<Solution<N>> {
        let slots = branch.iter().map(|other| solution.slot.index() ^ other);
        let mut moved =
            *slots.filter(|slot| may_take(*slot)).find_map(|slot| solutions.slot(slot))?;
        moved.q[free.joint() - 1] = value;
        moved.status.set(Status::WITHIN_LIMITS, self.limits().contain(&moved.q));
        Some(moved)
    }

    /// The solution inside the limits of `solutions` that is nearest to `seed`; where the one with the seed's free joint has another joint outside them,
    /// the nearest of its family.
    pub(in crate::kinematics) fn nearest_of(
        &self,
        solutions: &Solutions<N>,
        seed: &[f64; N],
        weights: &[f64; N],
    ) -> Result<Option<Solution<N>>, Error> {
        let nearest = solutions.cheapest(seed, weights, Cost::Distance);
        if nearest.is_some() {
            return Ok(nearest);
        }
        // One that meets the pose, or else one that meets it to its distance from the singularity.
        for allowed in [meets(solutions.pose()), SOLUTION_OFF] {
            let nearest =
                self.nearest_in_families(solutions, solutions.into_iter(), seed, weights, allowed)?;
            if nearest.is_some() {
                return Ok(nearest);
            }
        }
        Ok(None)
    }

    /// Where a solution of a family is outside the limits and another one of it, which is `allowed` [rad, m] off the pose at most, is not,
    /// that one takes its slot.
    pub(in crate::kinematics) fn bring_families_inside(
        &self,
        solutions: &mut Solutions<N>,
        allowed: f64,
    ) -> Result<(), Error> {
        for slot in 0..solutions.slot_count() {
            let Some(outside) = solutions
                .slot(slot)
                .copied()
                .filter(|solution| solution.free.is_some() && !solution.within_limits())
            else {
                continue;
            };
            let rest = self.resting(Redundancy::of(&outside.q));
            if let Some(inside) = self.nearest_in_families(
                solutions,
                [&outside].into_iter(),
                &rest,
                &[1.0; N],
                allowed,
            )? {
                let to = inside.slot.index();
                let places = solutions.places_mut();
                places.swap(slot, to);
                places[to] = Place::Found(inside);
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
        allowed: f64,
    ) -> Result<Option<Solution<N>>, Error> {
        // What stands still along a family may be outside the limits for good.
        let inside =
            |joint: usize, angle: f64| solutions.limits().overrun(joint, angle) <= SOLUTION_OFF;
        let families = among
            .filter_map(|solution| {
                Some(Family { robot: self, solutions, solution, free: solution.free?, allowed })
            })
            // No member of a family moves the rod.
            .filter(|family| solutions.limits().rod_overrun(&family.solution.q) <= SOLUTION_OFF)
            .filter(|family| {
                family
                    .free
                    .still()
                    .iter()
                    .all(|joint| inside(joint - 1, family.solution.q[joint - 1]))
            });
        let mut nearest = Nearest { limits: solutions.limits(), seed, weights, best: None };
        // A branch that was merged with another meets the pose as well.
        for family in families.clone() {
            nearest.look_at(&family, family.twin())?;
        }
        if nearest.best.is_none() {
            for family in families.clone() {
                nearest
                    .look_at(&family, family.edges().into_iter().flatten().chain(family.steps()))?;
            }
        }
        if nearest.best.is_none() {
            for family in families {
                nearest.look_between_steps(&family)?;
            }
        }
        Ok(nearest.best.map(|(_, solution)| solution))
    }
}

/// How far a solution that meets this pose may be off it [rad, m]: by what a seed may cost or, of lengths so great that their rounding is
/// more, by theirs.
pub(in crate::kinematics) fn meets(pose: &Pose) -> f64 {
    SEEDED_FREE.max(4.0 * POSITION_ROUNDING * pose.translation.vector.norm())
}

/// The family of one of the solutions of a pose.
struct Family<'a, const N: usize>
where
    Joints<N>: Arity<N>,
{
    robot: &'a Robot<N>,
    solutions: &'a Solutions<N>,
    solution: &'a Solution<N>,
    free: FreeJoint,
    /// How far a solution may be off the pose [rad, m].
    allowed: f64,
}

impl<const N: usize> Family<'_, N>
where
    Joints<N>: Arity<N>,
{
    /// Its solutions with the free joint at `value`, one on each branch, in slots that no other solution of the pose has.
    fn at(&self, value: f64) -> Result<[Option<Solution<N>>; 2], Error> {
        let solutions =
            self.robot.solve_with_free(self.solutions.pose(), self.solution, self.free, value)?;
        let vacant =
            |slot| slot == self.solution.slot.index() || self.solutions.slot(slot).is_none();
        let mut members = [None; 2];
        for (place, branch) in members.iter_mut().zip(self.free.branches()) {
            let member =
                self.robot.member(&solutions, self.solution, self.free, value, branch, vacant);
            *place = member.filter(|member| {
                self.robot.residual(&member.q, self.solutions.pose()).largest() <= self.allowed
            });
        }
        Ok(members)
    }

    /// The angle of the free joint.
    fn own(&self) -> f64 {
        self.solution.q[self.free.joint() - 1]
    }

    /// The angle of the free joint at which the branch stands that was merged with this one, where it is of the same family.
    fn twin(&self) -> Option<f64> {
        let turned = self.free.merged_half_a_turn_away();
        turned.then(|| self.own() + PI)
    }

    /// The angles of the free joint at which it or its partner comes to a limit. Where any angle keeps both inside, one of these does: the
    /// angles inside are intervals, and these are their ends.
    fn edges(&self) -> Option<[f64; 4]> {
        let (partner, sign) = self.free.partner()?;
        let limits = self.solutions.limits().to_array();
        let ([low, high], [other_low, other_high]) =
            (limits[self.free.joint() - 1], limits[partner - 1]);
        let own = self.own();
        let fixed = own + sign * self.solution.q[partner - 1];
        Some(
            [low, high, fixed - sign * other_low, fixed - sign * other_high]
                .map(|edge| if edge.is_finite() { edge } else { own }),
        )
    }

    /// The angles at which a free joint is tried whose family moves more than a partner: from that of the solution on, which may be where
    /// reach ends.
    fn steps(&self) -> impl Iterator<Item = f64> {
        let (steps, own) = (if self.free.partner().is_some() { 0 } else { STEPS }, self.own());
        (0..steps).map(move |step| own + f64::from(step) * STEP)
    }
}

/// The solution inside the limits that is nearest to a seed, of those that were looked at.
struct Nearest<'a, const N: usize> {
    limits: &'a JointLimits<N>,
    seed: &'a [f64; N],
    weights: &'a [f64; N],
    /// With what it costs.
    best: Option<(f64, Solution<N>)>,
}

impl<const N: usize> Nearest<'_, N>
where
    Joints<N>: Arity<N>,
{
    fn look_at(
        &mut self,
        family: &Family<'_, N>,
        values: impl IntoIterator<Item = f64>,
    ) -> Result<(), Error> {
        for value in values {
            for moved in family.at(value)?.into_iter().flatten() {
                let Some(q) = self.limits.turned_to(&moved.q, self.seed) else { continue };
                let cost = Cost::Distance.total(&q, self.seed, self.weights);
                if self.best.as_ref().is_none_or(|(least, _)| cost < *least) {
                    self.best = Some((
                        cost,
                        Solution { q, status: moved.status | Status::WITHIN_LIMITS, ..moved },
                    ));
                }
            }
        }
        Ok(())
    }

    /// Looks where a step and its neighbours show that the joints are the least outside the limits between them.
    fn look_between_steps(&mut self, family: &Family<'_, N>) -> Result<(), Error> {
        for branch in 0..family.free.branches().len() {
            // Out of reach is farther outside than any angle.
            let outside = |value: f64| {
                Ok(family.at(value)?[branch]
                    .map_or(f64::INFINITY, |moved| self.limits.worst_overrun(&moved.q)))
            };
            let mut found = [None; PLACES];
            let mut places = found.iter_mut();
            let (mut before, mut here) = (outside(family.own() - STEP)?, outside(family.own())?);
            for value in family.steps() {
                let next = outside(value + STEP)?;
                if here.is_finite() && here <= before && here <= next {
                    let Some(place) = places.next() else { break };
                    *place = Some(least(&outside, value, here)?);
                }
                (before, here) = (here, next);
            }
            self.look_at(family, found.into_iter().flatten())?;
        }
        Ok(())
    }
}

/// Where `outside` is least within a step of `value`, or the first place found where it is not positive.
fn least(
    outside: &impl Fn(f64) -> Result<f64, Error>,
    value: f64,
    mut least: f64,
) -> Result<f64, Error> {
    let (mut low, mut best, mut high) = (value - STEP, value, value + STEP);
    for _ in 0..NARROWINGS {
        if least <= 0.0 {
            break;
        }
        let probe = if high - best > best - low {
            best + GOLDEN * (high - best)
        } else {
            best - GOLDEN * (best - low)
        };
        let found = outside(probe)?;
        if found < least {
            *(if probe > best { &mut low } else { &mut high }) = best;
            (best, least) = (probe, found);
        } else {
            *(if probe > best { &mut high } else { &mut low }) = probe;
        }
    }
    Ok(best)
}
