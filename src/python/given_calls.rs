//! `ik` and `ik_batch` of a seven-axis robot with a joint given.

use std::num::NonZeroUsize;

use pyo3::prelude::*;

use super::given::{Asked, PyGiven};
use super::robot::PyRobot;
use super::solutions::PySolutions;

/// The solutions of one pose with a joint given.
pub(super) fn ik<'py>(
    robot: &PyRobot,
    pose: &Bound<'py, PyAny>,
    asked: Asked<'py>,
) -> PyResult<Bound<'py, PySolutions>> {
    let py = pose.py();
    PyGiven::of(py, robot, asked)?.solutions(py, pose)
}

/// The solutions of many poses with a joint given.
pub(super) fn ik_batch<'py>(
    robot: &PyRobot,
    poses: &Bound<'py, PyAny>,
    asked: Asked<'py>,
    out: Option<&Bound<'py, PyAny>>,
    threads: Option<NonZeroUsize>,
) -> PyResult<Bound<'py, PyAny>> {
    let py = poses.py();
    match asked {
        Asked::Joint(1, angles) => {
            PyGiven::prepared(robot, 1, 0.0, py)?.batch(poses, Some(&angles), out, threads)
        }
        asked => PyGiven::of(py, robot, asked)?.batch(poses, None, out, threads),
    }
}
