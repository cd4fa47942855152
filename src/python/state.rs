//! The bytes and the hashes of values.
//!
//! An answer is kept as it was solved: another instruction set would solve its pose with other
//! rounding.

use std::hash::{DefaultHasher, Hash, Hasher};

use pyo3::prelude::*;
use pyo3::types::PyBytes;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::errors::Fault;
use super::found::Found;
use crate::kinematics::{Pose, Robot, Solution, Solutions, pose_to_rows};

/// Function and arguments that restore a pickled value.
pub(super) type Reduced<'py> = (Bound<'py, PyAny>, (&'static str, Bound<'py, PyBytes>));

/// Write a value of the class `class` for pickle.
pub(super) fn reduced<'py>(
    py: Python<'py>,
    class: &'static str,
    value: &impl Serialize,
) -> PyResult<Reduced<'py>> {
    let failed = |error| Fault::Model.error(py, format!("{class} cannot be pickled: {error}"));
    let bytes = postcard::to_allocvec(value).map_err(failed)?;
    Ok((py.import("irbkin._core")?.getattr("_restore")?, (class, PyBytes::new(py, &bytes))))
}

/// Read a value of the class `class`, as [`reduced`] wrote it.
pub(super) fn read<T: DeserializeOwned>(py: Python<'_>, class: &str, bytes: &[u8]) -> PyResult<T> {
    postcard::from_bytes(bytes).map_err(|error| damaged(py, class, &error.to_string()))
}

/// The error of bytes that are not a value of the class `class`.
pub(super) fn damaged(py: Python<'_>, class: &str, cause: &str) -> PyErr {
    Fault::Model.error(py, format!("the pickled {class} is damaged: {cause}"))
}

/// An answer with its robot.
#[derive(Serialize, Deserialize)]
#[serde(bound = "")]
pub(super) struct Answer<const N: usize> {
    pub(super) robot: Robot<N>,
    pub(super) solutions: Solutions<N>,
    pub(super) turned: Option<Vec<Solution<N>>>,
    pub(super) q7: Option<f64>,
}

impl<const N: usize> From<&Found<N>> for Answer<N> {
    fn from(found: &Found<N>) -> Self {
        Self {
            robot: Robot::clone(&found.robot),
            solutions: found.solutions.clone(),
            turned: found.turned.clone(),
            q7: found.q7,
        }
    }
}

/// A solution with its robot and pose.
#[derive(Serialize, Deserialize)]
#[serde(bound = "")]
pub(super) struct One<const N: usize> {
    pub(super) robot: Robot<N>,
    pub(super) pose: Pose,
    pub(super) solution: Solution<N>,
}

/// Hash a robot by value.
pub(super) fn hash_of_robot<const N: usize>(robot: &Robot<N>) -> u64 {
    let rows = robot.mdh().rows.iter().flat_map(|row| row.to_array());
    let frames = [robot.base(), robot.tool()].into_iter().flat_map(pose_to_rows);
    let limits = robot.limits().to_array().into_iter().flatten();
    hash_of(robot.name(), rows.chain(frames).chain(limits))
}

/// Hash numbers and a name.
pub(super) fn hash_of(name: &str, numbers: impl IntoIterator<Item = f64>) -> u64 {
    let mut hasher = DefaultHasher::new();
    name.hash(&mut hasher);
    for number in numbers {
        // 0.0 equals -0.0.
        (number + 0.0).to_bits().hash(&mut hasher);
    }
    hasher.finish()
}
