//! The answers of a solve, as Python sees them.

use std::sync::Arc;

use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::{PyIndexError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyIterator, PyList};

use super::arrays::{matrix, vector};
use super::errors::{self, Fault, to_py};
use crate::error::Error;
use crate::kinematics::{Cost, Pose, Robot, SLOTS, Solution, Solutions, Status, check_joints, check_weights};

/// More turns than any robot has inside its limits: a list this long means limits in degrees, or none.
const MOST_TURNS: f64 = 1e6;

/// One joint vector that brings the tool to the pose.
///
/// It is also the sequence of its joint angles: `solution[0]` is J1, `numpy.asarray(solution)` is `solution.q`.
#[pyclass(name = "Solution", module = "irbkin", frozen)]
pub(super) struct PySolution {
    robot: Arc<Robot<6>>,
    pose: Pose,
    solution: Solution<6>,
}

#[pymethods]
impl PySolution {
    /// Joint angles [rad], shape (n,).
    #[getter]
    fn q<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, &self.solution.q)
    }

    /// The slot, 0 .. 7; for spherical-wrist arms ABB's cfx.
    #[getter]
    fn slot(&self) -> u8 {
        self.solution.slot
    }

    /// Whether every joint is inside its limits.
    #[getter]
    fn within_limits(&self) -> bool {
        self.solution.within_limits()
    }

    /// The singularities at which the pose stands.
    #[getter]
    fn kinds<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        errors::kinds(py, self.solution.status)
    }

    /// The joint that the pose leaves free, at a singularity, and what stays fixed: FreeJoint(joint, fixed), or None.
    #[getter]
    fn free<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        self.solution.free.map(|free| errors::free_joint_class(py)?.call1((free.joint(), free.fixed()))).transpose()
    }

    /// The solution of the same pose with the free joint at another angle.
    ///
    /// Args:
    ///     value: Angle of the free joint [rad].
    ///
    /// Returns:
    ///     The solution; the tool stays to rounding at the singularity, and within 3e-9 rad or m next to it.
    ///
    /// Raises:
    ///     InvalidJointsError: No joint is free, or the value is not finite.
    fn with_free(&self, py: Python<'_>, value: f64) -> PyResult<Self> {
        let moved = self.robot.with_free(&self.pose, &self.solution, value).map_err(|error| to_py(py, &error))?;
        let moved = moved.ok_or_else(|| Fault::Joints.error(py, format!("no joint is free: {}", self.__repr__())))?;
        Ok(Self { robot: Arc::clone(&self.robot), pose: self.pose, solution: moved })
    }

    /// All flags of the slot.
    #[getter]
    fn status<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        errors::status(py, self.solution.status)
    }

    /// Distance of the tool from the pose: the larger of the position's [m] and the rotation's [rad].
    #[getter]
    fn residual(&self) -> f64 {
        self.robot.residual(&self.solution.q, &self.pose).largest()
    }

    #[pyo3(signature = (dtype=None, copy=None))]
    fn __array__<'py>(&self, py: Python<'py>, dtype: Option<&Bound<'py, PyAny>>, copy: Option<bool>) -> PyResult<Bound<'py, PyAny>> {
        as_array(self.q(py).into_any(), dtype, copy)
    }

    fn __len__(&self) -> usize {
        self.solution.q.len()
    }

    fn __getitem__<'py>(&self, py: Python<'py>, index: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        self.q(py).get_item(index)
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyIterator>> {
        PyList::new(py, self.solution.q)?.try_iter()
    }

    fn __repr__(&self) -> String {
        let angles = self.solution.q.map(|angle| format!("{:.3}", angle.to_degrees())).join(", ");
        let limits = if self.within_limits() { "inside limits" } else { "outside limits" };
        format!("Solution(slot {}: [{angles}] deg, {limits})", self.solution.slot)
    }
}

/// Every solution of a pose, in the order of the slots, and why there is none where there is none.
#[pyclass(name = "Solutions", module = "irbkin", frozen)]
pub(super) struct PySolutions {
    robot: Arc<Robot<6>>,
    solutions: Solutions<6>,
    /// The list of turns, where the solutions were turned.
    turned: Option<Vec<Solution<6>>>,
}

impl PySolutions {
    pub(super) fn new(robot: Arc<Robot<6>>, solutions: Solutions<6>) -> Self {
        Self { robot, solutions, turned: None }
    }

    pub(super) fn solutions_mut(&mut self) -> &mut Solutions<6> {
        &mut self.solutions
    }

    fn with(&self, solutions: Solutions<6>, turned: Option<Vec<Solution<6>>>) -> Self {
        Self { robot: Arc::clone(&self.robot), solutions, turned }
    }

    fn entries(&self) -> Vec<Solution<6>> {
        self.turned.clone().unwrap_or_else(|| self.solutions.iter().copied().collect())
    }

    fn wrap(&self, solution: Solution<6>) -> PySolution {
        PySolution { robot: Arc::clone(&self.robot), pose: *self.solutions.pose(), solution }
    }

    /// The cheapest solution inside the limits from `seed`, or why there is none. Solutions that were turned stand as they are.
    fn cheapest(&self, seed: &Bound<'_, PyAny>, weights: Option<&Bound<'_, PyAny>>, cost: Cost) -> PyResult<PySolution> {
        let py = seed.py();
        let (seed, weights) = read_seed(seed, weights)?;
        let total = |solution: &Solution<6>| cost.total(&solution.q, &seed, &weights);
        let cheapest = match &self.turned {
            Some(turned) => turned.iter().copied().min_by(|a, b| total(a).total_cmp(&total(b))),
            None => self.solutions.cheapest(&seed, &weights, cost),
        };
        cheapest.map(|solution| self.wrap(solution)).ok_or_else(|| to_py(py, &Error::Unreachable(self.solutions.explain())))
    }
}

#[pymethods]
impl PySolutions {
    /// Joint angles of every solution [rad], shape (k, n), limits not regarded.
    #[getter]
    fn q<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        if let Some(turned) = &self.turned {
            return matrix(py, &turned.iter().map(|solution| solution.q).collect::<Vec<_>>());
        }
        let mut rows = [[0.0; 6]; SLOTS];
        let mut found = 0;
        for (row, solution) in rows.iter_mut().zip(&self.solutions) {
            *row = solution.q;
            found += 1;
        }
        matrix(py, &rows[..found])
    }

    /// Joint angles of each slot [rad], shape (8, n), NaN where the slot is empty.
    #[getter]
    fn slots<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        let rows: [[f64; 6]; SLOTS] = core::array::from_fn(|slot| self.solutions.slot(slot).map_or([f64::NAN; 6], |solution| solution.q));
        matrix(py, &rows)
    }

    /// `irbkin.Status` of each slot, shape (8,), uint8.
    #[getter]
    fn status<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u8>> {
        PyArray1::from_slice(py, &self.solutions.status().map(|status: Status| status.bits()))
    }

    /// Whether the wrist centre gets to where the pose wants it.
    #[getter]
    fn reach<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        errors::reach(py, self.solutions.reach())
    }

    /// How far the wrist centre is from where the arm can bring it [m]; 0 when it is reached.
    #[getter]
    fn shortfall(&self) -> f64 {
        self.solutions.reach().shortfall()
    }

    /// The outcome in a sentence.
    fn explain(&self) -> String {
        self.solutions.explain().to_string()
    }

    /// Those inside the joint limits.
    fn within_limits(&self) -> Self {
        let inside = self.turned.as_ref().map(|turned| turned.iter().copied().filter(Solution::within_limits).collect());
        self.with(self.solutions.within_limits(), inside)
    }

    /// Every full turn of every joint of every solution that is inside the limits. A joint without limits has only its own angle.
    ///
    /// Raises:
    ///     ValueError: There are more than a million.
    fn turns(&self) -> PyResult<Self> {
        if self.turned.is_some() {
            return Ok(self.with(self.solutions.clone(), self.turned.clone()));
        }
        let count = self.solutions.turn_count();
        if count > MOST_TURNS {
            return Err(PyValueError::new_err(format!("the limits leave {count:.1e} turns, more than 1e6 (are they in radians?)")));
        }
        Ok(self.with(self.solutions.clone(), Some(self.solutions.turns().collect())))
    }

    /// The solution inside the limits that is nearest to `seed`, turns considered: least root of the sum of weights * difference^2.
    ///
    /// Args:
    ///     seed: Joint vector [rad], shape (n,).
    ///     weights: Cost of moving each joint, shape (n,); ones when not given.
    ///
    /// Raises:
    ///     UnreachableError: None is inside the limits; the message is `explain()`.
    #[pyo3(signature = (seed, weights=None))]
    fn nearest(&self, seed: &Bound<'_, PyAny>, weights: Option<&Bound<'_, PyAny>>) -> PyResult<PySolution> {
        self.cheapest(seed, weights, Cost::Distance)
    }

    /// The solution inside the limits that moves the joints the least from `seed`, turns considered: least sum of weights * |difference|.
    ///
    /// Args:
    ///     seed: Joint vector [rad], shape (n,).
    ///     weights: Cost of moving each joint, shape (n,); ones when not given.
    ///
    /// Raises:
    ///     UnreachableError: None is inside the limits; the message is `explain()`.
    #[pyo3(signature = (seed, weights=None))]
    fn least_motion(&self, seed: &Bound<'_, PyAny>, weights: Option<&Bound<'_, PyAny>>) -> PyResult<PySolution> {
        self.cheapest(seed, weights, Cost::Travel)
    }

    /// Those for which `accept(solution)` is true; a solution is also the sequence of its joint angles.
    fn filter(&self, accept: &Bound<'_, PyAny>) -> PyResult<Self> {
        let mut failure = None;
        let mut keep = |solution: &Solution<6>| {
            failure.is_none()
                && match accept.call1((self.wrap(*solution),)).and_then(|answer| answer.is_truthy()) {
                    Ok(accepted) => accepted,
                    Err(error) => {
                        failure = Some(error);
                        false
                    }
                }
        };
        let kept = match &self.turned {
            Some(turned) => {
                let turned: Vec<_> = turned.iter().copied().filter(|solution| keep(solution)).collect();
                self.with(self.solutions.filter(|solution| turned.iter().any(|kept| kept.slot == solution.slot)), Some(turned))
            }
            None => self.with(self.solutions.filter(keep), None),
        };
        failure.map_or(Ok(kept), Err)
    }

    #[pyo3(signature = (dtype=None, copy=None))]
    fn __array__<'py>(&self, py: Python<'py>, dtype: Option<&Bound<'py, PyAny>>, copy: Option<bool>) -> PyResult<Bound<'py, PyAny>> {
        as_array(self.q(py).into_any(), dtype, copy)
    }

    fn __len__(&self) -> usize {
        self.turned.as_ref().map_or_else(|| self.solutions.len(), Vec::len)
    }

    fn __getitem__(&self, index: isize) -> PyResult<PySolution> {
        let entries = self.entries();
        let from_front = if index < 0 { index + entries.len().cast_signed() } else { index };
        let solution = usize::try_from(from_front).ok().and_then(|i| entries.get(i).copied());
        solution
            .map(|solution| self.wrap(solution))
            .ok_or_else(|| PyIndexError::new_err(format!("solution {index} of {}: {}", entries.len(), self.solutions.explain())))
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyIterator>> {
        PyList::new(py, self.entries().into_iter().map(|solution| self.wrap(solution)).collect::<Vec<_>>())?.try_iter()
    }

    fn __repr__(&self) -> String {
        format!("Solutions({})", self.explain())
    }
}

/// A seed and weights, checked.
pub(super) fn read_seed(seed: &Bound<'_, PyAny>, weights: Option<&Bound<'_, PyAny>>) -> PyResult<([f64; 6], [f64; 6])> {
    let py = seed.py();
    let seed = vector::<6>(seed, "seed", Fault::Joints)?;
    check_joints("seed", &seed).map_err(|error| to_py(py, &error))?;
    Ok((seed, read_weights(weights)?))
}

/// Weights, checked; ones where none were given.
pub(super) fn read_weights(weights: Option<&Bound<'_, PyAny>>) -> PyResult<[f64; 6]> {
    let Some(given) = weights else { return Ok([1.0; 6]) };
    let weights = vector::<6>(given, "weights", Fault::Joints)?;
    check_weights(&weights).map_err(|error| to_py(given.py(), &error))?;
    Ok(weights)
}

/// What NumPy's array protocol wants of `__array__`.
fn as_array<'py>(array: Bound<'py, PyAny>, dtype: Option<&Bound<'py, PyAny>>, copy: Option<bool>) -> PyResult<Bound<'py, PyAny>> {
    if copy == Some(false) {
        return Err(PyValueError::new_err("the joint angles cannot be seen without a copy"));
    }
    match dtype {
        Some(dtype) => array.call_method1("astype", (dtype,)),
        None => Ok(array),
    }
}
