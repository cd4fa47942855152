//! The exceptions of errors of the core and of arguments.

use std::fmt::Display;

use pyo3::exceptions::{PyBaseException, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use super::records::Configuration;
use irbkin::Error as RobotError;
use irbkin_abb::Error;
use irbkin_abb::rapid::text::fault::FrameFault;
use irbkin_motion::Error as MotionError;
use irbkin_motion::internal::{MotionFault, PlanFault};

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

pub(super) fn with_attributes(
    error: PyErr,
    set: impl FnOnce(&Bound<'_, PyBaseException>) -> PyResult<()>,
) -> PyErr {
    Python::attach(|py| set(error.value(py))).err().unwrap_or(error)
}

/// The exception of an error of the core.
#[cold]
pub(super) fn exception(error: impl Into<Error>) -> PyErr {
    let error = error.into();
    let class = match &error {
        Error::Robot(error) => class_of_robot(error),
        Error::Motion(error) => class_of_motion(error),
        Error::Frame(FrameFault::Pose { .. }) => Some("InvalidPoseError"),
        Error::InvalidMessage(_) => Some("StreamError"),
        _ => Some("RapidError"),
    };
    let Some(class) = class else { return PyValueError::new_err(error.to_string()) };
    with_attributes(raised(class, &error), |value| match error {
        // The configurations that exist.
        Error::Robot(RobotError::NoConfiguration(fault)) => {
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

/// The class of the exception of a robot's error; a `ValueError` has none.
fn class_of_robot(error: &RobotError) -> Option<&'static str> {
    Some(match error {
        RobotError::InvalidPose(_) => "InvalidPoseError",
        RobotError::InvalidJoints(_) => "InvalidJointsError",
        RobotError::InvalidModel(_) | RobotError::WrongLength { .. } => "InvalidModelError",
        RobotError::UnknownRobot(_) => "UnknownRobotError",
        RobotError::Unreachable(_) | RobotError::NoConfiguration(_) => "UnreachableError",
        _ => return None,
    })
}

/// The class of the exception of an error of motions, bodies and cells.
fn class_of_motion(error: &MotionError) -> Option<&'static str> {
    Some(match error {
        MotionError::Robot(error) => return class_of_robot(error),
        MotionError::InvalidPlan(PlanFault::Pose { .. }) => "InvalidPoseError",
        MotionError::InvalidMotion(MotionFault::Row { .. })
        | MotionError::InvalidPlan(
            PlanFault::EndOff { .. } | PlanFault::EndOutside { .. } | PlanFault::Position { .. },
        ) => "InvalidJointsError",
        MotionError::InvalidPlan(PlanFault::NoCarrier)
        | MotionError::InvalidBody(_)
        | MotionError::InvalidUrdf(_) => "InvalidModelError",
        MotionError::InvalidMotion(_) | MotionError::InvalidPlan(_) => "InvalidMotionError",
        MotionError::NoMotion(_) | MotionError::Collides { .. } => "UnreachableError",
        _ => return None,
    })
}

/// The error of a solve from a seed [rad]: one outside the limits whose seed is beyond two turns
/// asks for degrees.
pub(super) fn of_seed(error: MotionError, seed: &[f64]) -> PyErr {
    let large = seed.iter().position(|angle| angle.abs() > 2.0 * std::f64::consts::TAU);
    match (&error, large) {
        (MotionError::Robot(RobotError::Unreachable(_)), Some(i)) => raised(
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
