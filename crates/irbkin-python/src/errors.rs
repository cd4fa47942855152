//! The exceptions of errors of the core and of arguments.

use std::fmt::Display;

use pyo3::exceptions::{PyBaseException, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use super::records::Configuration;
use irbkin::Error as ArmError;
use irbkin::internal::{MotionFault, PlanFault};
use irbkin_abb::Error;
use irbkin_abb::rapid::text::fault::FrameFault;

/// The kind of invalid input, which determines the exception.
#[derive(Clone, Copy)]
pub(super) enum Fault {
    Pose,
    Joints,
    Model,
    Motion,
    Rapid,
}

impl Fault {
    /// The exception for this input with a message.
    #[cold]
    pub(super) fn error(self, message: impl Display) -> PyErr {
        let class = match self {
            Self::Pose => "InvalidPoseError",
            Self::Joints => "InvalidJointsError",
            Self::Model => "InvalidModelError",
            Self::Motion => "InvalidMotionError",
            Self::Rapid => "RapidError",
        };
        raised(class, message)
    }
}

/// An exception of a class of `irbkin.errors`.
#[cold]
pub(super) fn raised(class: &str, message: impl Display) -> PyErr {
    Python::attach(|py| {
        let class = py.import("irbkin.errors").and_then(|errors| errors.getattr(class));
        let error = class.and_then(|class| class.call1((message.to_string(),)));
        error.map_or_else(|failure| failure, PyErr::from_value)
    })
}

/// An exception with attributes.
pub(super) fn with_attributes(
    error: PyErr,
    set: impl FnOnce(&Bound<'_, PyBaseException>) -> PyResult<()>,
) -> PyErr {
    match Python::attach(|py| set(error.value(py))) {
        Ok(()) => error,
        Err(failure) => failure,
    }
}

/// The exception of an error of the core.
#[cold]
pub(super) fn exception(error: impl Into<Error>) -> PyErr {
    let error = error.into();
    let class = match &error {
        Error::Arm(error) => match class_of(error) {
            Some(class) => class,
            None => return PyValueError::new_err(error.to_string()),
        },
        Error::Frame(FrameFault::Pose { .. }) => "InvalidPoseError",
        Error::InvalidMessage(_) => "StreamError",
        _ => "RapidError",
    };
    with_attributes(raised(class, &error), |value| match error {
        // The configurations that exist.
        Error::Arm(ArmError::NoConfiguration(fault)) => {
            let existing = fault.existing.into_iter().map(Configuration::from);
            value.setattr("configurations", PyTuple::new(value.py(), existing.collect::<Vec<_>>())?)
        }
        Error::Rapid(fault) => {
            value.setattr("line", fault.line)?;
            value.setattr("column", fault.column)
        }
        _ => Ok(()),
    })
}

/// The class of an exception of an arm; a `ValueError` has none.
fn class_of(error: &ArmError) -> Option<&'static str> {
    Some(match error {
        ArmError::InvalidPose(_) | ArmError::InvalidPlan(PlanFault::Pose { .. }) => {
            "InvalidPoseError"
        }
        ArmError::InvalidJoints(_)
        | ArmError::InvalidMotion(MotionFault::Row { .. })
        | ArmError::InvalidPlan(PlanFault::EndOff { .. } | PlanFault::EndOutside { .. }) => {
            "InvalidJointsError"
        }
        ArmError::InvalidModel(_) | ArmError::InvalidBody(_) | ArmError::WrongLength { .. } => {
            "InvalidModelError"
        }
        ArmError::InvalidMotion(_) | ArmError::InvalidPlan(_) => "InvalidMotionError",
        ArmError::UnknownRobot(_) => "UnknownRobotError",
        ArmError::Unreachable(_)
        | ArmError::NoMotion(_)
        | ArmError::Collides { .. }
        | ArmError::NoConfiguration(_) => "UnreachableError",
        _ => return None,
    })
}

/// The error of a solve from a seed [rad]: one outside the limits whose seed is beyond two turns
/// asks for degrees.
pub(super) fn of_seed(error: ArmError, seed: &[f64]) -> PyErr {
    let large = seed.iter().position(|angle| angle.abs() > 2.0 * std::f64::consts::TAU);
    match (&error, large) {
        (ArmError::Unreachable(_), Some(i)) => raised(
            "UnreachableError",
            format!("{error} (seed: joint {} is {} rad, did you pass degrees?)", i + 1, seed[i]),
        ),
        _ => exception(error),
    }
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

fn listed(sizes: &[usize]) -> String {
    sizes.iter().map(usize::to_string).collect::<Vec<_>>().join(", ")
}

/// The index of an element by its number in row-major order.
pub(super) fn index_in(shape: &[usize], mut number: usize) -> Vec<usize> {
    let mut index = shape.to_vec();
    for size in index.iter_mut().rev() {
        (number, *size) = (number / *size, number % *size);
    }
    index
}
