//! `irbkin.Solutions`: the answer of a solve.

use std::sync::Arc;

use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::{PyIndexError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyIterator, PySlice, PyTuple};

use super::arm::{ByJoints, on};
use super::cell::PyCell;
use super::outputs::matrix;
use super::records;
use super::solution::{Member, PySolution, as_array};
use super::state::{Reduced, hash_of, reduced};
use super::table;
use super::targets::{read_seed, read_weights};
use crate::cell::{Cell, Nearest, Placed};
use crate::error::Error;
use crate::kinematics::{
    Cost, MOST_SLOTS, Robot, Solution, Solutions, Status, check_near, pose_to_rows,
};
use crate::report::Explanation;

/// More turns than any robot has inside its limits: a list this long means limits in degrees, or
/// none.
const MOST_TURNS: f64 = 1e6;

/// The solutions of a pose, or the list of their turns.
#[derive(Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(bound = "")]
pub(super) struct Found<const N: usize> {
    pub(super) robot: Arc<Robot<N>>,
    pub(super) solutions: Solutions<N>,
    /// The list of turns, where the solutions were turned.
    pub(super) turned: Option<Vec<Solution<N>>>,
    /// The angle of joint 7 [rad] that was passed with the pose.
    pub(super) q7: Option<f64>,
    /// Solutions that a cell took away, and the cell.
    pub(super) colliding: Option<(Arc<Cell>, Vec<Solution<N>>)>,
}

impl<const N: usize> Found<N> {
    pub(super) fn new(robot: Arc<Robot<N>>, solutions: Solutions<N>) -> Self {
        Self { robot, solutions, turned: None, q7: None, colliding: None }
    }

    fn with(&self, solutions: Solutions<N>, turned: Option<Vec<Solution<N>>>) -> Self {
        let Self { robot, q7, colliding, .. } = self.clone();
        Self { robot, solutions, turned, q7, colliding }
    }

    fn len(&self) -> usize {
        self.turned.as_ref().map_or_else(|| self.solutions.len(), Vec::len)
    }

    fn entries(&self) -> Vec<Solution<N>> {
        self.turned.clone().unwrap_or_else(|| self.solutions.iter().copied().collect())
    }

    fn member(&self, solution: Solution<N>) -> Member<N> {
        Member { robot: Arc::clone(&self.robot), pose: *self.solutions.pose(), solution }
    }

    /// Calls `take` with the joint angles of every solution.
    #[inline]
    fn with_rows<R>(&self, take: impl FnOnce(&[[f64; N]]) -> R) -> R {
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
    fn q_by_slot(&self) -> Vec<[f64; N]> {
        let row = |slot: usize| self.solutions.slot(slot).map_or([f64::NAN; N], |found| found.q);
        (0..self.solutions.slot_count()).map(row).collect()
    }

    fn within_limits(&self) -> Self {
        let inside = self
            .turned
            .as_ref()
            .map(|turned| turned.iter().copied().filter(Solution::is_within_limits).collect());
        self.with(self.solutions.within_limits(), inside)
    }

    fn turns(&self) -> Result<Self, String> {
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
    fn explain(&self) -> Explanation {
        self.robot.explained_answer(&self.solutions, self.q7)
    }

    /// The cheapest solution inside the limits from `seed`, or the reason. Solutions that
    /// were turned keep their angles.
    fn cheapest(
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
    fn filter(&self, mut accept: impl FnMut(Member<N>) -> PyResult<bool>) -> PyResult<Self> {
        let mut kept = Vec::new();
        for solution in self.entries() {
            if accept(self.member(solution))? {
                kept.push(solution);
            }
        }
        Ok(self.keep(kept))
    }

    /// Keep the solutions that do not collide.
    fn filter_free(&self, cell: &Arc<Cell>) -> PyResult<Self> {
        let entries = self.entries();
        let q: Vec<_> = entries.iter().map(|solution| solution.q).collect();
        let free = cell.free_postures(&mut Placed::of(&self.robot)?, &q);
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
    fn explained(&self) -> String {
        let mut text = format!("{}{}", self.explain(), self.solutions.reservation());
        let Some((cell, colliding)) = &self.colliding else { return text };
        let Ok(placed) = Placed::of(&self.robot) else { return text };
        for solution in colliding {
            if let Some((Nearest { link, near, .. }, depth)) = cell.collision(&placed, &solution.q)
            {
                let (slot, depth) = (solution.slot, 1e3 * depth);
                text +=
                    &format!("; slot {slot} collides: link {link} and {near}, {depth:.1} mm deep");
            }
        }
        text
    }
}

/// All solutions of a pose in the order of their slots, or the reason why there are none.
///
/// Holds each `Solution`: `solutions[0]`, `solutions[-1]`, iteration, `len`, `in`; a slice is a
/// tuple of `Solution`. `numpy.asarray(solutions)` is `solutions.q`. `print(solutions)` shows a
/// table in degrees. Frozen, hashable, equal by value to the same answer of the same robot and
/// pose, picklable.
#[derive(PartialEq, serde::Serialize, serde::Deserialize)]
#[expect(clippy::unsafe_derive_deserialize, reason = "the unsafe methods are pyo3's")]
#[pyclass(name = "Solutions", module = "irbkin", frozen, weakref, sequence, freelist = 8)]
pub(super) struct PySolutions {
    pub(super) found: ByJoints<Found<6>, Found<7>>,
}

impl From<Found<6>> for PySolutions {
    fn from(found: Found<6>) -> Self {
        Self { found: ByJoints::Six(found) }
    }
}

impl From<Found<7>> for PySolutions {
    fn from(found: Found<7>) -> Self {
        Self { found: ByJoints::Seven(found) }
    }
}

#[pymethods]
impl PySolutions {
    /// Joint angles of every solution [rad], shape (k, n), inside the limits or not.
    #[getter]
    fn q<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        on!(&self.found, found => found.with_rows(|rows| matrix(py, rows)))
    }

    /// Joint angles of every solution [deg], shape (k, n), inside the limits or not.
    #[getter]
    fn q_deg<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let degrees: Vec<f64> = on!(&self.found, found => found.with_rows(|rows| {
            rows.as_flattened().iter().map(|angle| angle.to_degrees()).collect()
        }));
        let dof = on!(&self.found, found => found.robot.limits().to_array().len());
        let count = degrees.len() / dof;
        PyArray1::from_vec(py, degrees).reshape([count, dof])
    }

    /// Joint angles of each slot [rad], shape (slots, n), NaN where the slot is empty; `status` has
    /// the flags of its rows.
    #[getter]
    fn q_by_slot<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        on!(&self.found, found => matrix(py, &found.q_by_slot()))
    }

    /// Flags of each slot, `irbkin.Status`, shape (slots,), uint8, as the rows of
    /// `q_by_slot`.
    #[getter]
    fn status<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u8>> {
        let status = on!(&self.found, found => found.solutions.status());
        PyArray1::from_iter(py, status.iter().map(Status::bits))
    }

    /// Whether these are certain to be all solutions of the pose, limits not regarded. Always where
    /// the structure has a closed form, never where it is a refined one. For other arms: their
    /// number equals the roots of a polynomial, and no joint moves freely.
    #[getter]
    fn certified(&self) -> bool {
        on!(&self.found, found => found.solutions.is_certified())
    }

    /// Whether the arm reaches the pose, limits not regarded, or is too short or too long for it:
    /// an `irbkin.Reach`.
    #[getter]
    fn reach<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        records::reach(py, on!(&self.found, found => found.solutions.reach()))
    }

    /// Distance missing to reach [m]: of the wrist center from where the arm can bring it; 0 when
    /// it is reached, NaN where it is not known: when `reach` is `Reach.NO_ROOTS`.
    #[getter]
    fn shortfall(&self) -> f64 {
        on!(&self.found, found => found.solutions.reach().shortfall())
    }

    /// Return the outcome in a sentence: how many solutions, or why there are none. For an arm
    /// without a closed form that has none, how near it gets is then searched, which takes
    /// milliseconds. Of solutions that a cell took away, it names what each touches.
    fn explain(&self) -> String {
        on!(&self.found, found => found.explained())
    }

    /// Return the solutions inside the joint limits.
    fn within_limits(&self) -> Self {
        on!(&self.found, found => found.within_limits().into())
    }

    /// Return every 2 pi equivalent of every solution that is inside the limits. A joint without
    /// limits keeps its own angle.
    ///
    /// Raises:
    ///     ValueError: There are more than a million.
    fn turns(&self) -> PyResult<Self> {
        on!(&self.found, found => found.turns().map(Self::from).map_err(PyValueError::new_err))
    }

    /// Return the solution inside the limits that is nearest to `seed`, 2 pi equivalents
    /// considered: least root of the sum of weights * difference^2.
    ///
    /// Args:
    ///     seed: Joint vector [rad], shape (n,).
    ///     weights: Cost of moving each joint, shape (n,); ones when not given.
    ///
    /// Raises:
    ///     UnreachableError: None is inside the limits; the message is `explain()`.
    ///     InvalidJointsError: The seed or the weights are not finite or have a wrong shape.
    #[pyo3(signature = (seed, weights=None))]
    fn nearest(
        &self,
        seed: &Bound<'_, PyAny>,
        weights: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<PySolution> {
        self.cheapest(seed, weights, Cost::Distance)
    }

    /// Return the solution inside the limits that moves the joints the least from `seed`, 2 pi
    /// equivalents considered: least sum of weights * |difference|. Arguments and errors are those
    /// of `nearest`.
    #[pyo3(signature = (seed, weights=None))]
    fn least_motion(
        &self,
        seed: &Bound<'_, PyAny>,
        weights: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<PySolution> {
        self.cheapest(seed, weights, Cost::Travel)
    }

    /// Return the solutions for which `accept(solution)` is true, or that do not collide in a cell.
    ///
    /// Args:
    ///     accept: Called with each `Solution`, which is also the sequence of its joint angles
    ///         [rad]; an exception of it is passed on. Or a `Cell`.
    fn filter(&self, accept: &Bound<'_, PyAny>) -> PyResult<Self> {
        on!(&self.found, found => {
            if let Ok(cell) = accept.cast::<PyCell>() {
                return found.filter_free(&cell.get().0).map(Self::from);
            }
            let accepts = |one| accept.call1((PySolution::from(one),))?.is_truthy();
            found.filter(accepts).map(Self::from)
        })
    }

    #[pyo3(signature = (dtype=None, copy=None))]
    fn __array__<'py>(
        &self,
        py: Python<'py>,
        dtype: Option<&Bound<'py, PyAny>>,
        copy: Option<bool>,
    ) -> PyResult<Bound<'py, PyAny>> {
        as_array(&self.q(py), dtype, copy)
    }

    fn __len__(&self) -> usize {
        on!(&self.found, found => found.len())
    }

    fn __getitem__<'py>(&self, index: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        if index.is_instance_of::<PySlice>() {
            return self.members(index.py())?.into_any().get_item(index);
        }
        let at: isize = index.extract()?;
        let member: PySolution = on!(&self.found, found => {
            let entries = found.entries();
            let from_front = if at < 0 { at + entries.len().cast_signed() } else { at };
            let solution = usize::try_from(from_front).ok().and_then(|i| entries.get(i).copied());
            let none = || PyIndexError::new_err(format!(
                "solution {at} of {}: {}", entries.len(), found.solutions.explain()
            ));
            found.member(solution.ok_or_else(none)?).into()
        });
        member.into_bound_py_any(index.py())
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyIterator>> {
        self.members(py)?.try_iter()
    }

    fn __eq__(&self, other: &Bound<'_, Self>) -> bool {
        self == other.get()
    }

    fn __hash__(&self) -> u64 {
        on!(&self.found, found => {
            let pose = pose_to_rows(found.solutions.pose());
            found.with_rows(|rows| hash_of("", pose.into_iter().chain(rows.iter().flatten().copied())))
        })
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced(py, "Solutions", self)
    }

    fn __repr__(&self) -> String {
        format!("Solutions({})", self.outcome())
    }

    /// The table: a line on the outcome, then slot, angles [deg], limits and singularities of each
    /// solution.
    fn __str__(&self) -> String {
        let outcome = self.outcome();
        on!(&self.found, found => table::text(&outcome, &found.entries(), found.robot.limits()))
    }
}

impl PySolutions {
    fn outcome(&self) -> String {
        on!(&self.found, found => format!("{}{}", found.explain(), found.solutions.reservation()))
    }

    fn cheapest(
        &self,
        seed: &Bound<'_, PyAny>,
        weights: Option<&Bound<'_, PyAny>>,
        cost: Cost,
    ) -> PyResult<PySolution> {
        on!(&self.found, found => {
            let (seed, weights) = (read_seed(seed)?, read_weights(weights)?);
            check_near("seed", &seed, &found.solutions.limits, &weights)?;
            Ok(found.cheapest(&seed, &weights, cost)?.into())
        })
    }

    fn members<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let members: Vec<PySolution> = on!(&self.found, found => {
            found.entries().into_iter().map(|one| found.member(one).into()).collect()
        });
        PyTuple::new(py, members)
    }
}
