//! An arm of seven joints has one more than a pose needs: which angle of joint 7 brings the others nearest to a seed.
//!
//! docs/seven_axes.md, section 5, has the method and what it promises.

use core::cmp::Ordering;
use core::f64::consts::PI;

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::free_choice::FreeChoice;
use super::pose::{Pose, checked_pose};
use super::robot::Robot;
use super::select::{Cost, check_joints, check_weights};
use super::solutions::{Solution, Solutions};
use super::status::Explanation;
use crate::error::Error;

/// Distance of two angles of joint 7 between which nothing is looked at by itself [rad].
const SPACING: f64 = 0.06;

/// Step at which the search for the best angle of joint 7 ends [rad]: the cost is a square, which steps below the root of rounding do not change.
const LEAST_STEP: f64 = 1e-9;

impl Robot<7> {
    /// The solution inside the limits that is nearest to `seed` [rad] along the redundancy: of every angle of joint 7, with turns considered.
    ///
    /// # Errors
    ///
    /// As [`Robot::<6>::ik_nearest`].
    pub fn ik_nearest(&self, pose: &Pose, seed: &[f64; 7], weights: &[f64; 7]) -> Result<Solution<7>, Error> {
        check_joints("seed", seed)?;
        check_weights(weights)?;
        self.nearest_along_redundancy(&checked_pose(pose)?, seed, weights)
    }

    pub(super) fn nearest_along_redundancy(&self, pose: &Pose, seed: &[f64; 7], weights: &[f64; 7]) -> Result<Solution<7>, Error> {
        let best = Search { robot: self, pose, seed, weights }.best()?;
        match best.solution.filter(|_| best.rank.outside == 0.0) {
            Some(solution) => Ok(solution),
            None => Err(Error::Unreachable(best.explanation)),
        }
    }

    /// The outcome of a solve over every angle of joint 7, in a sentence.
    #[cfg(feature = "python")]
    pub(crate) fn explain(&self, pose: &Pose) -> Result<Explanation, Error> {
        let (seed, weights) = (self.limits().rest(), [1.0; 7]);
        Ok(Search { robot: self, pose, seed: &seed, weights: &weights }.best()?.explanation)
    }
}

/// What is asked along the redundancy.
struct Search<'a> {
    robot: &'a Robot<7>,
    pose: &'a Pose,
    seed: &'a [f64; 7],
    weights: &'a [f64; 7],
}

/// How good an angle of joint 7 is: first by reach, then by limits, then by the distance from the seed.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
struct Rank {
    /// How far the pose is out of reach [m].
    shortfall: f64,
    /// How far the joint that is outside its limits the most is outside them [rad].
    outside: f64,
    /// Weighted square of the distance from the seed.
    cost: f64,
}

/// An angle of joint 7 with its best solution.
#[derive(Clone, Copy)]
struct Candidate {
    q7: f64,
    rank: Rank,
    solution: Option<Solution<7>>,
    explanation: Explanation,
}

impl Candidate {
    fn is_better_than(&self, other: &Self) -> bool {
        self.rank.partial_cmp(&other.rank) == Some(Ordering::Less)
    }
}

impl Search<'_> {
    /// The best angle of joint 7 inside its limits.
    fn best(&self) -> Result<Candidate, Error> {
        let (low, high) = self.range();
        let first = self.descend(self.at(self.seed[6].clamp(low, high))?, 0.5 * SPACING, low, high)?;
        // Joint 7 alone makes farther ones cost more than the one at hand.
        let window = if first.rank.outside > 0.0 || first.rank.shortfall > 0.0 { f64::INFINITY } else { first.rank.cost };
        let window = (window / self.weights[6]).sqrt();
        let (low, high) = (low.max(self.seed[6] - window), high.min(self.seed[6] + window));
        if high - low <= SPACING { Ok(first) } else { self.best_of_grid(first, low, high) }
    }

    /// The best of the minima that a grid of angles of joint 7 shows, and of `best`.
    fn best_of_grid(&self, mut best: Candidate, low: f64, high: f64) -> Result<Candidate, Error> {
        let intervals = ((high - low) / SPACING).ceil().max(2.0);
        let step = (high - low) / intervals;
        let (mut before, mut here) = (None, self.at(low)?);
        let mut number = 1.0;
        loop {
            let next = if number <= intervals { Some(self.at((low + number * step).min(high))?) } else { None };
            let better = |other: &Option<Candidate>| other.as_ref().is_none_or(|other| !other.is_better_than(&here));
            if better(&before) && better(&next) {
                let found = self.descend(here, 0.5 * step, low, high)?;
                if found.is_better_than(&best) {
                    best = found;
                }
            }
            let Some(next) = next else { return Ok(best) };
            (before, here) = (Some(here), next);
            number += 1.0;
        }
    }

    /// Down from an angle of joint 7 to the bottom of its valley, by steps that shrink.
    fn descend(&self, mut best: Candidate, mut step: f64, low: f64, high: f64) -> Result<Candidate, Error> {
        while step > LEAST_STEP {
            let (left, right) = (self.at((best.q7 - step).max(low))?, self.at((best.q7 + step).min(high))?);
            let valley = bottom(&left, &best, &right, step).map(|q7| self.at(q7.clamp(low, high))).transpose()?;
            let before = best.q7;
            for candidate in [Some(left), Some(right), valley].into_iter().flatten() {
                if candidate.is_better_than(&best) {
                    best = candidate;
                }
            }
            // The parabola shrinks the valley to the square of its width, halving only to the half.
            let moved = (best.q7 - before).abs();
            step = if moved >= step { step } else { (0.25 * step).min((4.0 * moved).max(0.01 * step)) };
        }
        Ok(best)
    }

    /// The best solution with joint 7 at an angle.
    fn at(&self, q7: f64) -> Result<Candidate, Error> {
        let mut seed = *self.seed;
        seed[6] = q7;
        let solutions = self.robot.solve(*self.pose, &FreeChoice::seed(seed))?;
        let mut best = Candidate {
            q7,
            rank: Rank { shortfall: solutions.reach().shortfall(), outside: f64::INFINITY, cost: f64::INFINITY },
            solution: None,
            explanation: solutions.explain(),
        };
        if let Some(solution) = self.robot.nearest_of(&solutions, self.seed, self.weights)? {
            let cost = Cost::Distance.total(&solution.q, self.seed, self.weights);
            (best.rank.outside, best.rank.cost, best.solution) = (0.0, cost, Some(solution));
        } else {
            best.rank.outside = self.least_outside(&solutions);
        }
        Ok(best)
    }

    /// How far the solution that is outside the limits the least is outside them.
    fn least_outside(&self, solutions: &Solutions<7>) -> f64 {
        let outside = |solution: &Solution<7>| (0..7).map(|joint| self.robot.limits().excess(joint, solution.q[joint])).fold(0.0, f64::max);
        solutions.iter().map(outside).fold(f64::INFINITY, f64::min)
    }

    /// Between which angles joint 7 is looked for: its limits, or half a turn to both sides of the seed where it has none.
    fn range(&self) -> (f64, f64) {
        let [low, high] = self.robot.limits().to_array()[6];
        let low = if low.is_finite() { low } else { self.seed[6].min(high) - PI };
        (low, if high.is_finite() { high } else { self.seed[6].max(low) + PI })
    }
}

/// Where the parabola through the costs of three angles has its bottom.
fn bottom(left: &Candidate, here: &Candidate, right: &Candidate, step: f64) -> Option<f64> {
    let inside = |candidate: &Candidate| candidate.rank.outside == 0.0 && candidate.rank.shortfall == 0.0;
    let (slope, bend) = (right.rank.cost - left.rank.cost, left.rank.cost + right.rank.cost - 2.0 * here.rank.cost);
    (inside(left) && inside(here) && inside(right) && bend > 0.0).then(|| here.q7 - 0.5 * step * slope / bend)
}
