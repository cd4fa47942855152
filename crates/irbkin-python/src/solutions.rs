//! `irbkin.Solutions`: the answer of a solve.

use std::sync::Arc;

use crate::errors::exception;
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::{PyIndexError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyIterator, PySlice, PyTuple};

use super::arm::{ByJoints, each, on};
use super::cell::PyCell;
use super::found::Found;
use super::outputs::matrix;
use super::records;
use super::robot::PyRobot;
use super::solution::{PySolution, as_array};
use super::state::{Reduced, hash_of, reduced};
use super::table;
use super::targets::{read_seed, read_weights};
use irbkin::Status;
use irbkin::internal::{Cost, check_near};
use irbkin::pose::to_rows as pose_to_rows;

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
    pub(super) found: ByJoints<Found<6>, Found<7>, Found<5>>,
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
        Self { found: each!(&self.found, found => found.within_limits()) }
    }

    /// Return every 2 pi equivalent of every solution that is inside the limits. A joint without
    /// limits keeps its own angle.
    ///
    /// Raises:
    ///     ValueError: There are more than a million.
    fn turns(&self) -> PyResult<Self> {
        let turns = each!(&self.found, found => found.turns().map_err(PyValueError::new_err)?);
        Ok(Self { found: turns })
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
        let accepts = |one: PySolution| accept.call1((one,))?.is_truthy();
        let kept = each!(&self.found, found => match accept.cast::<PyCell>() {
            Ok(cell) => found.filter_free(&cell.get().cell)?,
            Err(_) => found.filter(|one| accepts(one.into()))?,
        });
        Ok(Self { found: kept })
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

    /// The table: a line on the outcome, then of each solution slot, angles [deg], limits, margin
    /// to the nearest limit [deg] with its joint, confdata where the arm has it, singularities.
    fn __str__(&self) -> String {
        let outcome = self.outcome();
        on!(&self.found, found => table::text(&outcome, &found.entries(), &found.robot))
    }
}

impl PySolutions {
    /// The robot that they are of.
    pub(super) fn robot(&self) -> PyRobot {
        each!(&self.found, found => Arc::clone(&found.robot)).into()
    }

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
            check_near("seed", &seed, &found.solutions.limits, &weights).map_err(exception)?;
            Ok(found.cheapest(&seed, &weights, cost).map_err(exception)?.into())
        })
    }

    fn members<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let members: Vec<PySolution> = on!(&self.found, found => {
            found.entries().into_iter().map(|one| found.member(one).into()).collect()
        });
        PyTuple::new(py, members)
    }
}
