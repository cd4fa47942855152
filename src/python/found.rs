//! The solutions of an arm of `N` joints, with the robot that found them.

use std::sync::Arc;

use pyo3::prelude::*;

use super::arrays::vector;
use super::errors::{Fault, to_py};
use crate::error::Error;
use crate::kinematics::{Cost, MOST_SLOTS, Robot, Solution, Solutions, check_seed, check_weights};
use crate::report::Explanation;

/// More turns than any robot has inside its limits: a list this long means limits in degrees, or
/// none.
const MOST_TURNS: f64 = 1e6;

/// The solutions of a pose, or the list of their turns.
#[derive(Clone)]
pub(super) struct Found<const N: usize> {
    pub(super) robot: Arc<Robot<N>>,
    pub(super) solutions: Solutions<N>,
    /// The list of turns, where the solutions were turned.
    pub(super) turned: Option<Vec<Solution<N>>>,
    /// The angle of joint 7 [rad] that was passed with the pose.
    pub(super) q7: Option<f64>,
}

impl<const N: usize> PartialEq for Found<N> {
    fn eq(&self, other: &Self) -> bool {
        self.solutions == other.solutions
            && self.q7 == other.q7
            && self.turned == other.turned
            && is_same(&self.robot, &other.robot)
    }
}

/// Whether two robots are equal; one and the same is without a look at its numbers.
pub(super) fn is_same<const N: usize>(first: &Arc<Robot<N>>, second: &Arc<Robot<N>>) -> bool {
    Arc::ptr_eq(first, second) || first == second
}

impl<const N: usize> Found<N> {
    pub(super) fn new(robot: Arc<Robot<N>>, solutions: Solutions<N>) -> Self {
        Self { robot, solutions, turned: None, q7: None }
    }

    fn with(&self, solutions: Solutions<N>, turned: Option<Vec<Solution<N>>>) -> Self {
        Self { robot: Arc::clone(&self.robot), solutions, turned, q7: self.q7 }
    }

    pub(super) fn len(&self) -> usize {
        self.turned.as_ref().map_or_else(|| self.solutions.len(), Vec::len)
    }

    pub(super) fn entries(&self) -> Vec<Solution<N>> {
        self.turned.clone().unwrap_or_else(|| self.solutions.iter().copied().collect())
    }

    /// Calls `take` with the joint angles of every solution.
    #[inline]
    pub(super) fn with_rows<R>(&self, take: impl FnOnce(&[[f64; N]]) -> R) -> R {
        if let Some(turned) = &self.turned {
            return take(&turned.iter().map(|solution| solution.q).collect::<Vec<_>>());
        }
        // Most structures have half of the slots that there may be.
        if self.solutions.slot_count() <= MOST_SLOTS / 2 {
            take(self.put_rows(&mut [[0.0; N]; MOST_SLOTS / 2]))
        } else {
            take(self.put_rows(&mut [[0.0; N]; MOST_SLOTS]))
        }
    }

    #[inline]
    fn put_rows<'r>(&self, rows: &'r mut [[f64; N]]) -> &'r [[f64; N]] {
        let mut found = 0;
        for (row, solution) in rows.iter_mut().zip(&self.solutions) {
            *row = solution.q;
            found += 1;
        }
        &rows[..found]
    }

    /// Joint angles of each slot, NaN where it is empty.
    pub(super) fn q_by_slot(&self) -> Vec<[f64; N]> {
        let row = |slot: usize| self.solutions.slot(slot).map_or([f64::NAN; N], |found| found.q);
        (0..self.solutions.slot_count()).map(row).collect()
    }

    pub(super) fn within_limits(&self) -> Self {
        let inside = self
            .turned
            .as_ref()
            .map(|turned| turned.iter().copied().filter(Solution::is_within_limits).collect());
        self.with(self.solutions.within_limits(), inside)
    }

    pub(super) fn turns(&self) -> Result<Self, String> {
        if self.turned.is_some() {
            return Ok(self.clone());
        }
        let count = self.solutions.turn_total();
        if count > MOST_TURNS {
            return Err(format!(
                "the limits leave {count:.1e} turns, more than 1e6 (are they in radians?)"
            ));
        }
        Ok(self.with(self.solutions.clone(), Some(self.solutions.turns().collect())))
    }

    /// The outcome in a sentence.
    pub(super) fn explain(&self) -> Explanation {
        self.robot.explained_answer(&self.solutions, self.q7)
    }

    /// The cheapest solution inside the limits from `seed`, or the reason. Solutions that
    /// were turned keep their angles.
    pub(super) fn cheapest(
        &self,
        seed: &Bound<'_, PyAny>,
        weights: Option<&Bound<'_, PyAny>>,
        cost: Cost,
    ) -> PyResult<Solution<N>> {
        let py = seed.py();
        let (seed, weights) = read_seed(seed, weights)?;
        let total = |solution: &Solution<N>| cost.total(&solution.q, &seed, &weights);
        let cheapest = match &self.turned {
            Some(turned) => turned.iter().copied().min_by(|a, b| total(a).total_cmp(&total(b))),
            None => self.solutions.cheapest(&seed, &weights, cost),
        };
        cheapest.ok_or_else(|| to_py(py, &Error::Unreachable(self.explain())))
    }

    /// Keep the solutions that `accept` takes; an error of it ends the search.
    pub(super) fn filter(
        &self,
        mut accept: impl FnMut(&Solution<N>) -> PyResult<bool>,
    ) -> PyResult<Self> {
        let mut failure = None;
        let mut keep = |solution: &Solution<N>| {
            failure.is_none()
                && accept(solution).unwrap_or_else(|error| {
                    failure = Some(error);
                    false
                })
        };
        let kept = match &self.turned {
            Some(turned) => {
                let turned: Vec<_> =
                    turned.iter().copied().filter(|solution| keep(solution)).collect();
                self.with(
                    self.solutions
                        .filter(|solution| turned.iter().any(|kept| kept.slot == solution.slot)),
                    Some(turned),
                )
            }
            None => self.with(self.solutions.filter(keep), None),
        };
        failure.map_or(Ok(kept), Err)
    }
}

/// A seed and weights, checked.
pub(super) fn read_seed<const N: usize>(
    seed: &Bound<'_, PyAny>,
    weights: Option<&Bound<'_, PyAny>>,
) -> PyResult<([f64; N], [f64; N])> {
    let py = seed.py();
    let seed = vector::<N>(seed, "seed", Fault::Joints)?;
    check_seed("seed", &seed).map_err(|error| to_py(py, &error))?;
    Ok((seed, read_weights(weights)?))
}

/// Weights, checked; ones where none were given.
pub(super) fn read_weights<const N: usize>(
    weights: Option<&Bound<'_, PyAny>>,
) -> PyResult<[f64; N]> {
    let Some(given) = weights else { return Ok([1.0; N]) };
    let weights = vector::<N>(given, "weights", Fault::Joints)?;
    check_weights(&weights).map_err(|error| to_py(given.py(), &error))?;
    Ok(weights)
}
