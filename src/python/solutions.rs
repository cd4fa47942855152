//! The answers of a solve, as Python sees them.

use std::sync::Arc;

use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::{PyIndexError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyIterator, PyList};

use super::arrays::matrix;
use super::classes;
use super::errors::{Fault, to_py};
use super::found::Found;
use super::records;
use crate::kinematics::{Arity, Cost, Joints, Pose, Robot, Solution, Status};

/// A solution, with the robot and the pose that it is of.
pub(super) struct Member<const N: usize>
where
    Joints<N>: Arity<N>,
{
    robot: Arc<Robot<N>>,
    pose: Pose,
    solution: Solution<N>,
}

impl<const N: usize> Member<N>
where
    Joints<N>: Arity<N>,
{
    fn of(found: &Found<N>, solution: Solution<N>) -> Self {
        Self { robot: Arc::clone(&found.robot), pose: *found.solutions.pose(), solution }
    }

    fn with_free_joint(&self, py: Python<'_>, value: f64) -> PyResult<Self> {
        let moved = self
            .robot
            .with_free_joint(&self.pose, &self.solution, value)
            .map_err(|error| to_py(py, &error))?;
        let moved = moved.ok_or_else(|| {
            Fault::Joints.error(py, format!("no joint is free: {}", self.sentence()))
        })?;
        Ok(Self { robot: Arc::clone(&self.robot), pose: self.pose, solution: moved })
    }

    fn sentence(&self) -> String {
        let angles = self.solution.q.map(|angle| format!("{:.3}", angle.to_degrees())).join(", ");
        let limits =
            if self.solution.is_within_limits() { "inside limits" } else { "outside limits" };
        format!("Solution(slot {}: [{angles}] deg, {limits})", self.solution.slot)
    }
}

/// One joint vector that brings the tool to the pose.
///
/// It is also the sequence of its joint angles: `solution[0]` is J1, `numpy.asarray(solution)` is
/// `solution.q`.
#[pyclass(name = "Solution", module = "irbkin", frozen)]
pub(super) struct PySolution {
    of: AnyMember,
}

enum AnyMember {
    Six(Member<6>),
    Seven(Member<7>),
}

/// Every solution of a pose, in the order of the slots, and why there is none where there is none.
#[pyclass(name = "Solutions", module = "irbkin", frozen, freelist = 8)]
pub(super) struct PySolutions {
    found: AnyFound,
}

enum AnyFound {
    Six(Found<6>),
    Seven(Found<7>),
}

/// Runs the same expression on an answer, whatever its number of joints.
macro_rules! on {
    ($any:ident, $answer:expr, $inner:ident => $body:expr) => {
        match $answer {
            $any::Six($inner) => $body,
            $any::Seven($inner) => $body,
        }
    };
}

impl From<Member<6>> for PySolution {
    fn from(member: Member<6>) -> Self {
        Self { of: AnyMember::Six(member) }
    }
}

impl From<Member<7>> for PySolution {
    fn from(member: Member<7>) -> Self {
        Self { of: AnyMember::Seven(member) }
    }
}

impl From<Found<6>> for PySolutions {
    fn from(found: Found<6>) -> Self {
        Self { found: AnyFound::Six(found) }
    }
}

impl From<Found<7>> for PySolutions {
    fn from(found: Found<7>) -> Self {
        Self { found: AnyFound::Seven(found) }
    }
}

#[pymethods]
impl PySolution {
    /// Joint angles [rad], shape (n,).
    #[getter]
    fn q<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        on!(AnyMember, &self.of, member => PyArray1::from_slice(py, &member.solution.q))
    }

    /// The slot, 0 .. 7; for spherical-wrist arms ABB's cfx.
    #[getter]
    fn slot(&self) -> usize {
        on!(AnyMember, &self.of, member => member.solution.slot.index())
    }

    /// Whether every joint is inside its limits.
    #[getter]
    fn is_within_limits(&self) -> bool {
        on!(AnyMember, &self.of, member => member.solution.is_within_limits())
    }

    /// The singularities at which the pose stands.
    #[getter]
    fn singularities<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        records::kinds(py, self.flags().singularities())
    }

    /// The joint that the pose leaves free, at a singularity, and what stays fixed:
    /// FreeJoint(joint, fixed), or None.
    #[getter]
    fn free_joint<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        let free = on!(AnyMember, &self.of, member => member.solution.free_joint);
        free.map(|free| classes::free_joint_class(py)?.call1((free.joint(), free.fixed())))
            .transpose()
    }

    /// The solution of the same pose with the free joint at another angle.
    ///
    /// Args:
    ///     value: Angle of the free joint [rad].
    ///
    /// Returns:
    ///     The solution; the tool stays to rounding at the singularity, and within 3e-9 rad or m
    ///     next to it.
    ///
    /// Raises:
    ///     InvalidJointsError: No joint is free, or the value is not finite.
    ///     UnreachableError: The arm does not reach the pose with the free joint there.
    fn with_free_joint(&self, py: Python<'_>, value: f64) -> PyResult<Self> {
        on!(AnyMember, &self.of, member => member.with_free_joint(py, value).map(Self::from))
    }

    /// All flags of the slot.
    #[getter]
    fn status<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        records::status(py, self.flags())
    }

    /// Distance of the tool from the pose: the larger of the position's [m] and the rotation's
    /// [rad].
    #[getter]
    fn residual(&self) -> f64 {
        on!(AnyMember, &self.of, member => member.robot.residual(&member.solution.q, &member.pose).largest())
    }

    #[pyo3(signature = (dtype=None, copy=None))]
    fn __array__<'py>(
        &self,
        py: Python<'py>,
        dtype: Option<&Bound<'py, PyAny>>,
        copy: Option<bool>,
    ) -> PyResult<Bound<'py, PyAny>> {
        as_array(self.q(py).into_any(), dtype, copy)
    }

    fn __len__(&self) -> usize {
        on!(AnyMember, &self.of, member => member.solution.q.len())
    }

    fn __getitem__<'py>(
        &self,
        py: Python<'py>,
        index: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.q(py).get_item(index)
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyIterator>> {
        on!(AnyMember, &self.of, member => PyList::new(py, member.solution.q))?.try_iter()
    }

    fn __repr__(&self) -> String {
        on!(AnyMember, &self.of, member => member.sentence())
    }
}

impl PySolution {
    fn flags(&self) -> Status {
        on!(AnyMember, &self.of, member => member.solution.status)
    }
}

#[pymethods]
impl PySolutions {
    /// Joint angles of every solution [rad], shape (k, n), limits not regarded.
    #[getter]
    fn q<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        on!(AnyFound, &self.found, found => found.with_rows(|rows| matrix(py, rows)))
    }

    /// Joint angles of each slot [rad], shape (8, n), NaN where the slot is empty.
    #[getter]
    fn q_by_slot<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        on!(AnyFound, &self.found, found => matrix(py, &found.q_by_slot()))
    }

    /// `irbkin.Status` of each slot, shape (8,), uint8.
    #[getter]
    fn status<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u8>> {
        let status = on!(AnyFound, &self.found, found => found.solutions.status());
        PyArray1::from_iter(py, status.iter().map(Status::bits))
    }

    /// Whether the wrist center gets to where the pose wants it.
    #[getter]
    fn reach<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        records::reach(py, on!(AnyFound, &self.found, found => found.solutions.reach()))
    }

    /// How far the wrist center is from where the arm can bring it [m]; 0 when it is reached.
    #[getter]
    fn shortfall(&self) -> f64 {
        on!(AnyFound, &self.found, found => found.solutions.reach().shortfall())
    }

    /// The outcome in a sentence.
    fn explain(&self) -> String {
        on!(AnyFound, &self.found, found => found.solutions.explain().to_string())
    }

    /// Those inside the joint limits.
    fn within_limits(&self) -> Self {
        on!(AnyFound, &self.found, found => found.within_limits().into())
    }

    /// Every full turn of every joint of every solution that is inside the limits. A joint without
    /// limits has only its own angle.
    ///
    /// Raises:
    ///     ValueError: There are more than a million.
    fn turns(&self) -> PyResult<Self> {
        on!(AnyFound, &self.found, found => found.turns().map(Self::from).map_err(PyValueError::new_err))
    }

    /// The solution inside the limits that is nearest to `seed`, turns considered: least root of
    /// the sum of weights * difference^2.
    ///
    /// Args:
    ///     seed: Joint vector [rad], shape (n,).
    ///     weights: Cost of moving each joint, shape (n,); ones when not given.
    ///
    /// Raises:
    ///     UnreachableError: None is inside the limits; the message is `explain()`.
    #[pyo3(signature = (seed, weights=None))]
    fn nearest(
        &self,
        seed: &Bound<'_, PyAny>,
        weights: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<PySolution> {
        on!(AnyFound, &self.found, found => Ok(Member::of(found, found.cheapest(seed, weights, Cost::Distance)?).into()))
    }

    /// The solution inside the limits that moves the joints the least from `seed`, turns
    /// considered: least sum of weights * |difference|.
    ///
    /// Args:
    ///     seed: Joint vector [rad], shape (n,).
    ///     weights: Cost of moving each joint, shape (n,); ones when not given.
    ///
    /// Raises:
    ///     UnreachableError: None is inside the limits; the message is `explain()`.
    #[pyo3(signature = (seed, weights=None))]
    fn least_motion(
        &self,
        seed: &Bound<'_, PyAny>,
        weights: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<PySolution> {
        on!(AnyFound, &self.found, found => Ok(Member::of(found, found.cheapest(seed, weights, Cost::Travel)?).into()))
    }

    /// Those for which `accept(solution)` is true; a solution is also the sequence of its joint
    /// angles.
    fn filter(&self, accept: &Bound<'_, PyAny>) -> PyResult<Self> {
        on!(AnyFound, &self.found, found => {
            let accepts = |solution: &Solution<_>| accept.call1((PySolution::from(Member::of(found, *solution)),))?.is_truthy();
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
        as_array(self.q(py).into_any(), dtype, copy)
    }

    fn __len__(&self) -> usize {
        on!(AnyFound, &self.found, found => found.len())
    }

    fn __getitem__(&self, index: isize) -> PyResult<PySolution> {
        on!(AnyFound, &self.found, found => {
            let entries = found.entries();
            let from_front = if index < 0 { index + entries.len().cast_signed() } else { index };
            let solution = usize::try_from(from_front).ok().and_then(|i| entries.get(i).copied());
            solution
                .map(|solution| Member::of(found, solution).into())
                .ok_or_else(|| PyIndexError::new_err(format!("solution {index} of {}: {}", entries.len(), found.solutions.explain())))
        })
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyIterator>> {
        let members: Vec<PySolution> = on!(AnyFound, &self.found, found => found.entries().into_iter().map(|solution| Member::of(found, solution).into()).collect());
        PyList::new(py, members)?.try_iter()
    }

    fn __repr__(&self) -> String {
        format!("Solutions({})", self.explain())
    }
}

/// What NumPy's array protocol wants of `__array__`.
fn as_array<'py>(
    array: Bound<'py, PyAny>,
    dtype: Option<&Bound<'py, PyAny>>,
    copy: Option<bool>,
) -> PyResult<Bound<'py, PyAny>> {
    if copy == Some(false) {
        return Err(PyValueError::new_err("the joint angles cannot be seen without a copy"));
    }
    match dtype {
        Some(dtype) => array.call_method1("astype", (dtype,)),
        None => Ok(array),
    }
}
