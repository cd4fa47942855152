//! The exceptions of errors of the core and of arguments.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use super::classes::{
    invalid_joints_error, invalid_model_error, invalid_motion_error, invalid_pose_error,
    rapid_error, unknown_name_error, unknown_robot_error, unreachable_error,
};
use super::records;
use crate::error::{Error, FrameFault, MotionFault, NoConfiguration, PlanFault, RapidFault};

/// The kind of invalid input, which determines the exception.
#[derive(Clone, Copy)]
pub(super) enum Fault {
    Pose,
    Joints,
    Model,
    Motion,
}

impl Fault {
    /// The exception for this input with a message.
    pub(super) fn error(self, py: Python<'_>, message: String) -> PyErr {
        let class = match self {
            Self::Pose => invalid_pose_error(py),
            Self::Joints => invalid_joints_error(py),
            Self::Model => invalid_model_error(py),
            Self::Motion => invalid_motion_error(py),
        };
        raised(class, message)
    }
}

pub(super) fn raised(class: PyResult<&Bound<'_, PyAny>>, message: String) -> PyErr {
    class
        .and_then(|class| class.call1((message,)))
        .map_or_else(|failure| failure, PyErr::from_value)
}

/// The Python exception of a core error.
pub(super) fn to_py(py: Python<'_>, error: &Error) -> PyErr {
    let class = match error {
        Error::InvalidPose(_)
        | Error::Frame(FrameFault::Pose { .. })
        | Error::InvalidPlan(PlanFault::Pose { .. }) => invalid_pose_error(py),
        Error::InvalidJoints(_)
        | Error::InvalidMotion(MotionFault::Row { .. })
        | Error::InvalidPlan(PlanFault::EndOff { .. } | PlanFault::EndOutside { .. }) => {
            invalid_joints_error(py)
        }
        Error::InvalidModel(_) | Error::WrongLength { .. } => invalid_model_error(py),
        Error::InvalidMotion(_) | Error::InvalidPlan(_) => invalid_motion_error(py),
        Error::UnknownRobot(_) => unknown_robot_error(py),
        Error::Unreachable(_) => unreachable_error(py),
        Error::NoConfiguration(fault) => return no_configuration(py, fault),
        Error::Rapid(fault) => return broken_text(py, fault),
        Error::Frame(_) => rapid_error(py),
        Error::NoInstructionSet { .. } => return PyValueError::new_err(error.to_string()),
    };
    raised(class, error.to_string())
}

/// The error of a solve from a seed [rad]: one outside the limits whose seed is beyond two turns
/// asks for degrees.
pub(super) fn of_seed(py: Python<'_>, error: &Error, seed: &[f64]) -> PyErr {
    let large = seed.iter().position(|angle| angle.abs() > 2.0 * std::f64::consts::TAU);
    match (error, large) {
        (Error::Unreachable(_), Some(i)) => raised(
            unreachable_error(py),
            format!("{error} (seed: joint {} is {} rad, did you pass degrees?)", i + 1, seed[i]),
        ),
        _ => to_py(py, error),
    }
}

/// A `RapidError` that has no place in a text.
pub(super) fn rapid_fault(py: Python<'_>, message: String) -> PyErr {
    raised(rapid_error(py), message)
}

/// An `UnknownNameError`, which is a `KeyError`.
pub(super) fn unknown_name(py: Python<'_>, message: String) -> PyErr {
    raised(unknown_name_error(py), message)
}

/// With the line and the column as attributes.
fn broken_text(py: Python<'_>, fault: &RapidFault) -> PyErr {
    let error = rapid_fault(py, fault.to_string());
    let value = error.value(py);
    let placed =
        value.setattr("line", fault.line).and_then(|()| value.setattr("column", fault.column));
    placed.map_or_else(|failure| failure, |()| error)
}

/// With the configurations that exist as an attribute.
fn no_configuration(py: Python<'_>, fault: &NoConfiguration) -> PyErr {
    let error = raised(unreachable_error(py), fault.to_string());
    let existing = fault
        .existing
        .iter()
        .map(|existing| records::configuration(py, existing))
        .collect::<PyResult<Vec<_>>>();
    let told = existing.and_then(|existing| {
        error.value(py).setattr("configurations", PyTuple::new(py, existing)?)
    });
    told.map_or_else(|failure| failure, |()| error)
}

/// A shape as NumPy prints it: (5, 4, 4), (6,), ().
pub(super) fn shape_text(sizes: &[usize]) -> String {
    match sizes {
        [one] => format!("({one},)"),
        _ => format!("({})", listed(sizes)),
    }
}

/// A shape with any leading dimensions: (..., 4, 4), (...).
pub(super) fn shape_of_rows(tail: &[usize]) -> String {
    if tail.is_empty() { "(...)".to_owned() } else { format!("(..., {})", listed(tail)) }
}

/// The index of an element by its number in row-major order.
pub(super) fn index_in(shape: &[usize], mut number: usize) -> Vec<usize> {
    let mut index: Vec<usize> = shape
        .iter()
        .rev()
        .map(|size| {
            let at = number % size;
            number /= size;
            at
        })
        .collect();
    index.reverse();
    index
}

fn listed(sizes: &[usize]) -> String {
    sizes.iter().map(usize::to_string).collect::<Vec<_>>().join(", ")
}
