//! `irbkin.Solution`: one joint vector of an answer.

use std::sync::Arc;

use numpy::PyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyIterator, PyTuple};

use super::arm::{ByJoints, on};
use super::errors::{Fault, exception};
use super::records::{self, Configuration, FreeJoint};
use super::state::{Reduced, hash_of, reduced};
use irbkin::{Joints, Pose, Robot, Solution, Status};
use irbkin_motion::Arm;

/// A solution, with the robot and the pose that it is of.
#[derive(Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(bound(serialize = "", deserialize = "Robot<N>: Joints<N>"))]
pub(super) struct Member<const N: usize> {
    pub(super) robot: Arc<Arm<N>>,
    pub(super) pose: Pose,
    pub(super) solution: Solution<N>,
}

impl<const N: usize> Member<N> {
    fn with_free_joint(&self, value: f64) -> PyResult<Self> {
        let moved =
            self.robot.with_free_joint(&self.pose, &self.solution, value).map_err(exception)?;
        let fixed = || Fault::Joints.error(format_args!("no joint is free: {}", self.sentence()));
        Ok(Self { solution: moved.ok_or_else(fixed)?, ..self.clone() })
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
/// `solution[0]` is the angle of J1, `numpy.asarray(solution)` is `solution.q`. Frozen, hashable,
/// equal by value to a solution of the same robot and pose, picklable.
#[derive(PartialEq, serde::Serialize, serde::Deserialize)]
#[expect(clippy::unsafe_derive_deserialize, reason = "the unsafe methods are pyo3's")]
#[pyclass(name = "Solution", module = "irbkin", eq, frozen, weakref, sequence)]
pub(super) struct PySolution {
    pub(super) of: ByJoints<Member<6>, Member<7>, Member<5>>,
}

impl From<Member<6>> for PySolution {
    fn from(member: Member<6>) -> Self {
        Self { of: ByJoints::Six(member) }
    }
}

impl From<Member<7>> for PySolution {
    fn from(member: Member<7>) -> Self {
        Self { of: ByJoints::Seven(member) }
    }
}

impl From<Member<5>> for PySolution {
    fn from(member: Member<5>) -> Self {
        Self { of: ByJoints::Five(member) }
    }
}

#[pymethods]
impl PySolution {
    /// Joint angles [rad], shape (n,).
    #[getter]
    fn q<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        on!(&self.of, member => PyArray1::from_slice(py, &member.solution.q))
    }

    /// Joint angles [deg], shape (n,).
    #[getter]
    fn q_deg<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        on!(&self.of, member => PyArray1::from_slice(py, &member.solution.q.map(f64::to_degrees)))
    }

    /// Index of the slot, from 0; for spherical-wrist arms ABB's cfx.
    #[getter]
    fn slot(&self) -> usize {
        on!(&self.of, member => member.solution.slot.index())
    }

    /// Whether every joint is inside its limits.
    #[getter]
    fn is_within_limits(&self) -> bool {
        on!(&self.of, member => member.solution.is_within_limits())
    }

    /// ABB's confdata, as `Robot.configuration` of it; None of an arm that has none.
    #[getter]
    fn configuration(&self) -> Option<Configuration> {
        let found = on!(&self.of, member => member.robot.configuration(&member.solution.q).ok());
        found.map(Configuration::from)
    }

    /// Singularities of the pose on this branch: an `irbkin.SingularityKind`, 0 for none.
    #[getter]
    fn singularities<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        records::kinds(py, self.flags().singularities())
    }

    /// The joint that a singular pose leaves undetermined and what stays fixed along its
    /// self-motion, as FreeJoint(joint, fixed); None at a regular pose.
    #[getter]
    fn free_joint(&self) -> Option<FreeJoint> {
        let free = on!(&self.of, member => member.solution.free_joint);
        free.map(|free| FreeJoint { joint: free.joint(), fixed: free.fixed() })
    }

    /// Return the solution of the same pose with the free joint at another angle.
    ///
    /// Args:
    ///     value: Angle of the free joint [rad].
    ///
    /// Returns:
    ///     The solution. The tool stays at the pose to rounding at the singularity, and within 3e-9
    ///     rad or m next to it.
    ///
    /// Raises:
    ///     InvalidJointsError: No joint is free, or the value is not finite.
    ///     UnreachableError: The arm does not reach the pose with the free joint at that angle.
    fn with_free_joint(&self, value: f64) -> PyResult<Self> {
        on!(&self.of, member => member.with_free_joint(value).map(Self::from))
    }

    /// Flags of the slot, an `irbkin.Status`.
    #[getter]
    fn status<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        records::status(py, self.flags())
    }

    /// Distance of the tool from the pose: the larger of the position's [m] and the rotation's
    /// [rad].
    #[getter]
    fn residual(&self) -> f64 {
        on!(&self.of, member => member.robot.residual(&member.solution.q, &member.pose).largest())
    }

    /// How far the pose is turned about axis 1, upwards, for an arm of five axes to reach it [rad],
    /// in (-pi, pi]; 0 of other arms.
    #[getter]
    fn heading_error(&self) -> f64 {
        match &self.of {
            ByJoints::Five(member) => member.robot.heading_error(&member.solution.q, &member.pose),
            ByJoints::Six(_) | ByJoints::Seven(_) => 0.0,
        }
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
        on!(&self.of, member => member.solution.q.len())
    }

    fn __getitem__<'py>(&self, index: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        self.q(index.py()).get_item(index)
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyIterator>> {
        self.angles(py)?.try_iter()
    }

    fn __hash__(&self) -> u64 {
        on!(&self.of, member => hash_of(&member.solution.slot.to_string(), member.solution.q))
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced(py, "Solution", self)
    }

    fn __repr__(&self) -> String {
        on!(&self.of, member => member.sentence())
    }
}

impl PySolution {
    fn flags(&self) -> Status {
        on!(&self.of, member => member.solution.status)
    }

    fn angles<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        on!(&self.of, member => PyTuple::new(py, member.solution.q))
    }
}

/// Answer `__array__` of NumPy's array protocol.
pub(super) fn as_array<'py>(
    array: &Bound<'py, PyAny>,
    dtype: Option<&Bound<'py, PyAny>>,
    copy: Option<bool>,
) -> PyResult<Bound<'py, PyAny>> {
    if copy == Some(false) {
        return Err(PyValueError::new_err("the joint angles cannot be seen without a copy"));
    }
    dtype.map_or(Ok(array.clone()), |dtype| array.call_method1("astype", (dtype,)))
}
