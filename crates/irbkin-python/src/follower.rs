//! `irbkin.Follower`: the joints along a path of poses, one pose at a time.

use std::sync::Arc;

use crate::errors::exception;
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use super::arm::{ByJoints, each, on};
use super::records::{self, break_reason};
use super::robot::PyRobot;
use super::targets::{read_seed, read_single_pose, read_weights};
use irbkin::follow::{Break, BreakReason, Follower};
use irbkin::internal::Progress;
use irbkin::{Error, Pose};
use irbkin_motion::Arm;

/// A path that is followed pose by pose, as `Robot.follow` does a whole one: each step is the
/// solution inside the limits that continues the previous joints, turns considered.
///
/// For control loops: a step takes a few microseconds. A Follower changes with each step.
///
/// Args:
///     robot: The arm.
///     seed: Joint vector from which the path starts [rad], shape (n,).
///     weights: Cost of moving each joint, shape (n,); ones when not given.
///
/// Raises:
///     InvalidJointsError: A seed or weight that is not finite, a weight that is negative, or a
///         wrong shape.
#[pyclass(name = "Follower", module = "irbkin")]
pub(super) struct PyFollower(ByJoints<Steps<6>, Steps<7>, Steps<5>>);

/// A follower that owns its robot.
struct Steps<const N: usize> {
    robot: Arc<Arm<N>>,
    weights: [f64; N],
    at: Progress<N>,
    /// Number of steps taken.
    count: usize,
    /// Why the last step was not continuous.
    last_break: Option<Break>,
}

impl<const N: usize> Steps<N> {
    fn new(
        robot: &Arc<Arm<N>>,
        seed: &Bound<'_, PyAny>,
        weights: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let (seed, weights) = (read_seed(seed)?, read_weights(weights)?);
        let at = Follower::new(robot, &seed, &weights).map_err(exception)?.progress();
        Ok(Self { robot: Arc::clone(robot), weights, at, count: 0, last_break: None })
    }

    fn step(&mut self, pose: &Pose) -> Result<[f64; N], Error> {
        let mut follower = Follower::resumed(&self.robot, &self.weights, self.at);
        let (solution, reason) = follower.step(pose)?;
        self.at = follower.progress();
        self.last_break = reason.map(|reason| Break { pose_index: self.count, reason });
        self.count += 1;
        match (solution, reason) {
            (None, Some(BreakReason::Unreachable(explanation))) => {
                Err(Error::Unreachable(explanation))
            }
            _ => Ok(self.at.q),
        }
    }
}

#[pymethods]
impl PyFollower {
    #[new]
    #[pyo3(signature = (robot, seed, weights=None))]
    fn new(
        robot: &Bound<'_, PyRobot>,
        seed: &Bound<'_, PyAny>,
        weights: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        Ok(Self(each!(robot.get().arm(), robot => Steps::new(robot, seed, weights)?)))
    }

    /// Return the joints at the next pose of the path.
    ///
    /// Args:
    ///     T: Pose of the tool, shape (4, 4), translation [m].
    ///
    /// Returns:
    ///     Joint vector [rad], shape (n,). If `last_break` is then not None, the joints arrive
    ///     there by a jump.
    ///
    /// Raises:
    ///     UnreachableError: No solution inside the limits; the message says what is missing. The
    ///         next step starts anew from the last joints.
    ///     InvalidPoseError, InvalidModelError: As `Robot.ik`; the step does not count.
    fn step<'py>(&mut self, T: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let pose = read_single_pose(T, "step")?;
        on!(&mut self.0, steps => {
            Ok(PyArray1::from_slice(T.py(), &steps.step(&pose).map_err(exception)?))
        })
    }

    /// The joints of the last step that reached its pose [rad], shape (n,); before it, the seed.
    #[getter]
    fn q<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        on!(&self.0, steps => PyArray1::from_slice(py, &steps.at.q))
    }

    /// Why the joints could not follow in the last step, an `irbkin.records.Break` whose
    /// `pose_index` counts the steps from 0; None if they did.
    #[getter]
    fn last_break(&self, py: Python<'_>) -> PyResult<Option<records::Break>> {
        let last_break = on!(&self.0, steps => steps.last_break);
        last_break.map(|last_break| break_record(py, &last_break, PyTuple::empty(py))).transpose()
    }
}

/// `irbkin.records.Break` of a break in a path that has an index among several.
pub(super) fn break_record(
    py: Python<'_>,
    broken: &Break,
    path: Bound<'_, PyTuple>,
) -> PyResult<records::Break> {
    Ok(records::Break {
        pose_index: broken.pose_index,
        reason: broken.to_string(),
        path: path.unbind(),
        kind: break_reason(py, &broken.reason)?.unbind(),
    })
}
