//! The solutions of a pose with their robot, and what was kept of them.

use std::fmt::Write as _;
use std::sync::Arc;

use crate::errors::exception;
use pyo3::prelude::*;

use super::solution::Member;
use irbkin::internal::{Cost, MOST_SLOTS};
use irbkin::{Error, Explanation, Joints, Robot, Solution, Solutions};
use irbkin_motion::Arm;
use irbkin_motion::cell::{Cell, Nearest};

/// More turns than any robot has inside its limits: a list this long means limits in degrees, or
/// none.
const MOST_TURNS: f64 = 1e6;

/// The solutions of a pose, or the list of their turns.
#[derive(Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(bound(serialize = "", deserialize = "Robot<N>: Joints<N>"))]
pub(super) struct Found<const N: usize> {
    pub(super) robot: Arc<Arm<N>>,
    pub(super) solutions: Solutions<N>,
    /// The list of turns, where the solutions were turned.
    pub(super) turned: Option<Vec<Solution<N>>>,
    /// The angle of joint 7 [rad] that was passed with the pose.
    pub(super) q7: Option<f64>,
    /// Solutions that a cell took away, and the cell.
    pub(super) colliding: Option<(Arc<Cell>, Vec<Solution<N>>)>,
}

impl<const N: usize> Found<N> {
    pub(super) fn new(robot: Arc<Arm<N>>, solutions: Solutions<N>) -> Self {
        Self { robot, solutions, turned: None, q7: None, colliding: None }
    }

    fn with(&self, solutions: Solutions<N>, turned: Option<Vec<Solution<N>>>) -> Self {
        let Self { robot, q7, colliding, .. } = self.clone();
        Self { robot, solutions, turned, q7, colliding }
    }

    pub(super) fn len(&self) -> usize {
        self.turned.as_ref().map_or_else(|| self.solutions.len(), Vec::len)
    }

    pub(super) fn entries(&self) -> Vec<Solution<N>> {
        self.turned.clone().unwrap_or_else(|| self.solutions.iter().copied().collect())
    }

    pub(super) fn member(&self, solution: Solution<N>) -> Member<N> {
        Member { robot: Arc::clone(&self.robot), pose: *self.solutions.pose(), solution }
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
        seed: &[f64; N],
        weights: &[f64; N],
        cost: Cost,
    ) -> Result<Member<N>, Error> {
        let total = |solution: &Solution<N>| cost.total(&solution.q, seed, weights);
        let cheapest = match &self.turned {
            Some(turned) => turned.iter().copied().min_by(|a, b| total(a).total_cmp(&total(b))),
            None => self.solutions.cheapest(seed, weights, cost),
        };
        cheapest.map(|found| self.member(found)).ok_or_else(|| Error::Unreachable(self.explain()))
    }

    /// Keep the solutions that `accept` takes; an error of it ends the search.
    pub(super) fn filter(
        &self,
        mut accept: impl FnMut(Member<N>) -> PyResult<bool>,
    ) -> PyResult<Self> {
        let mut kept = Vec::new();
        for solution in self.entries() {
            if accept(self.member(solution))? {
                kept.push(solution);
            }
        }
        Ok(self.keep(kept))
    }

    pub(super) fn filter_free(&self, cell: &Arc<Cell>) -> PyResult<Self> {
        let entries = self.entries();
        let q: Vec<_> = entries.iter().map(|solution| solution.q).collect();
        let free = cell.checker(&self.robot).map_err(exception)?.free_postures(&q);
        let mut free = free.into_iter();
        let (kept, colliding): (Vec<_>, Vec<_>) =
            entries.into_iter().partition(|_| free.next().unwrap_or_default());
        let mut found = self.keep(kept);
        if !colliding.is_empty() {
            found.colliding = Some((Arc::clone(cell), colliding));
        }
        Ok(found)
    }

    fn keep(&self, kept: Vec<Solution<N>>) -> Self {
        let is_kept = |one: &Solution<N>| kept.iter().any(|kept| kept.slot == one.slot);
        let solutions = self.solutions.filter(is_kept);
        self.with(solutions, self.turned.is_some().then_some(kept))
    }

    /// The outcome, and what each solution touches that a cell took away.
    pub(super) fn explained(&self) -> String {
        let mut text = format!("{}{}", self.explain(), self.solutions.reservation());
        let Some((cell, colliding)) = &self.colliding else { return text };
        let Ok(checker) = cell.checker(&self.robot) else { return text };
        for solution in colliding {
            if let Some((Nearest { link, near, .. }, depth)) = checker.collision(&solution.q) {
                let (slot, depth) = (solution.slot, 1e3 * depth);
                let _ = write!(
                    text,
                    "; slot {slot} collides: link {link} and {near}, {depth:.1} mm deep"
                );
            }
        }
        text
    }
}
