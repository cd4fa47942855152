//! Choosing among the solutions of a pose.

use core::f64::consts::TAU;

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use super::check::{check_seed_near, check_weights};
use super::solutions::{Place, Solution, Solutions};
use super::status::Status;
use crate::error::Error;
use crate::kinematics::chain::limits::JointLimits;
use crate::report::Explanation;

impl<const N: usize> Solutions<N> {
    /// The solutions inside the joint limits.
    #[must_use]
    pub fn within_limits(&self) -> Self {
        self.retain(self.explain(), Solution::is_within_limits)
    }

    /// The solutions that `accept` returns true for, a collision test for instance.
    #[must_use]
    pub fn filter(&self, accept: impl FnMut(&Solution<N>) -> bool) -> Self {
        let explanation = if self.is_empty() { self.explain() } else { Explanation::FilteredOut };
        self.retain(explanation, accept)
    }

    /// The solutions that `accept` returns true for; `explanation` is reported if none is left.
    fn retain(
        &self,
        explanation: Explanation,
        mut accept: impl FnMut(&Solution<N>) -> bool,
    ) -> Self {
        let mut kept = self.clone();
        for place in kept.places_mut() {
            if place.found().is_some_and(|solution| !accept(solution)) {
                *place = Place::Empty;
            }
        }
        kept.emptied = kept.is_empty().then_some(explanation);
        kept
    }

    /// Every 2 pi equivalent of every solution whose joints are all inside their limits. A joint
    /// without limits contributes its own angle only.
    pub fn turns(&self) -> impl Iterator<Item = Solution<N>> + '_ {
        self.iter().flat_map(|solution| Turns::of(&self.limits, solution))
    }

    /// Number of items of [`Self::turns`] as a float, which cannot overflow.
    #[doc(hidden)]
    pub fn turn_total(&self) -> f64 {
        let of_solution = |solution: &Solution<N>| {
            let turns = (0..N).map(|joint| {
                let turns = self.limits.countable_turns(joint, solution.q[joint]);
                turns.map_or(0.0, |(first, last)| last - first + 1.0)
            });
            turns.product::<f64>()
        };
        self.iter()
            .filter(|solution| self.limits.linkage_excess(&solution.q) == 0.0)
            .map(of_solution)
            .sum()
    }

    /// The solution inside the limits that is nearest to `seed` [rad] among all 2 pi equivalents.
    /// The distance is the square root of the sum of `weights * difference^2`.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidJoints`] for a seed or weight that is not finite or a negative weight,
    /// [`Error::Unreachable`] when no solution is inside the limits.
    pub fn nearest(&self, seed: &[f64; N], weights: &[f64; N]) -> Result<Solution<N>, Error> {
        self.chosen(seed, weights, Cost::Distance)
    }

    /// The solution inside the limits that moves the joints least from `seed` [rad] among all 2 pi
    /// equivalents. The cost is the sum of `weights *
    ///
    /// difference
    ///
    /// `.
    ///
    /// # Errors
    ///
    /// As [`Self::nearest`].
    pub fn least_motion(&self, seed: &[f64; N], weights: &[f64; N]) -> Result<Solution<N>, Error> {
        self.chosen(seed, weights, Cost::Travel)
    }

    fn chosen(
        &self,
        seed: &[f64; N],
        weights: &[f64; N],
        cost: Cost,
    ) -> Result<Solution<N>, Error> {
        check_seed_near(seed, &self.limits, weights)?;
        check_weights(weights)?;
        self.cheapest(seed, weights, cost).ok_or_else(|| Error::Unreachable(self.explain()))
    }

    /// The cost is a sum over the joints, so the nearest turn is chosen for each joint separately.
    #[doc(hidden)]
    pub fn cheapest(&self, seed: &[f64; N], weights: &[f64; N], cost: Cost) -> Option<Solution<N>> {
        let mut best: Option<(f64, Solution<N>)> = None;
        for solution in self {
            if let Some(q) = self.limits.wrapped_near(&solution.q, seed) {
                let total = cost.total(&q, seed, weights);
                if best.as_ref().is_none_or(|(least, _)| total < *least) {
                    best = Some((
                        total,
                        Solution {
                            q,
                            status: solution.status | Status::WITHIN_LIMITS,
                            ..*solution
                        },
                    ));
                }
            }
        }
        best.map(|(_, solution)| solution)
    }
}

/// The cost of moving a joint.
#[derive(Clone, Copy)]
#[doc(hidden)]
pub enum Cost {
    /// The squared difference.
    Distance,
    /// The absolute difference.
    Travel,
}

impl Cost {
    /// The cost of moving from `seed` to `q`.
    #[doc(hidden)]
    pub fn total<const N: usize>(self, q: &[f64; N], seed: &[f64; N], weights: &[f64; N]) -> f64 {
        let cost = |difference: f64| match self {
            Self::Distance => difference * difference,
            Self::Travel => difference.abs(),
        };
        (0..N).map(|joint| weights[joint] * cost(q[joint] - seed[joint])).sum()
    }
}

/// Enumerates the 2 pi equivalents of one solution, the last joint fastest.
pub(crate) struct Turns<const N: usize> {
    base: Solution<N>,
    first: [f64; N],
    last: [f64; N],
    next: Option<[f64; N]>,
}

impl<const N: usize> Turns<N> {
    pub(crate) fn of(limits: &JointLimits<N>, solution: &Solution<N>) -> Self {
        let mut turns = Self { base: *solution, first: [0.0; N], last: [0.0; N], next: None };
        if limits.linkage_excess(&solution.q) > 0.0 {
            return turns;
        }
        for joint in 0..N {
            let Some((first, last)) = limits.countable_turns(joint, solution.q[joint]) else {
                return turns;
            };
            (turns.first[joint], turns.last[joint]) = (first, last);
        }
        turns.next = Some(turns.first);
        turns
    }
}

impl<const N: usize> Iterator for Turns<N> {
    type Item = Solution<N>;

    fn next(&mut self) -> Option<Solution<N>> {
        let turns = self.next?;
        let mut following = turns;
        self.next = (0..N).rev().find_map(|joint| {
            if following[joint] < self.last[joint] {
                following[joint] += 1.0;
                return Some(following);
            }
            following[joint] = self.first[joint];
            None
        });
        let mut solution = self.base;
        solution.q = core::array::from_fn(|joint| solution.q[joint] + TAU * turns[joint]);
        solution.status |= Status::WITHIN_LIMITS;
        Some(solution)
    }
}
