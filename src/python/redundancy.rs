//! Arguments that fix a joint of a redundant arm: q7, and the angle of a joint that is given.

use pyo3::exceptions::PyTypeError;
use pyo3::intern;
use pyo3::prelude::*;

use super::arm::{Arm, on};
use super::arrays::{Argument, Rows, together};
use super::errors::{Fault, shape_text, to_py};
use crate::kinematics::Robot;

/// Poses, shape (..., 4, 4), and the angles of a joint for each, of an argument with its name: none
/// for six joints, and where a joint of seven is locked.
pub(super) fn read_poses_with_q7<'py>(
    arm: &Arm,
    poses: &Bound<'py, PyAny>,
    (field, angles): (&'static str, Option<&Bound<'py, PyAny>>),
) -> PyResult<(Rows<'py>, Vec<f64>)> {
    let py = poses.py();
    on!(arm, robot => known_structure(py, robot)?);
    match arm {
        Arm::Six(_) => no_q7(angles.is_some())?,
        Arm::Seven(robot) if robot.locked_joint().is_none() => {
            needed_q7(py, robot, angles)?;
        }
        Arm::Seven(_) => {}
    }
    let mut poses = Rows::read(poses, &[4, 4], "T", Fault::Pose)?;
    let angles = match angles {
        Some(angles) => read_angles(angles, field, &mut poses)?.data()?.to_vec(),
        None => Vec::new(),
    };
    Ok((poses, angles))
}

/// An angle of a joint for each pose; both are broadcast.
fn read_angles<'py>(
    angles: &Bound<'py, PyAny>,
    field: &'static str,
    poses: &mut Rows<'py>,
) -> PyResult<Rows<'py>> {
    let mut rows = Rows::read(angles, &[], field, Fault::Joints)?;
    together(
        angles.py(),
        &mut [
            Argument { field: "T", fault: Fault::Pose, rows: poses },
            Argument { field, fault: Fault::Joints, rows: &mut rows },
        ],
    )?;
    Ok(rows)
}

/// An arm of six joints has no joint 7.
pub(super) fn no_q7(given: bool) -> PyResult<()> {
    if given {
        Err(PyTypeError::new_err(
            "q7 is joint 7 of an arm of seven joints: this one has six (for the solution nearest \
             to a seed take ik_nearest(T, seed))",
        ))
    } else {
        Ok(())
    }
}

/// The angle of one joint [rad]; a seed is not one.
pub(super) fn one_angle(angle: &Bound<'_, PyAny>, field: &str) -> PyResult<f64> {
    angle.extract().map_err(|_| {
        let got =
            match angle.getattr(intern!(angle.py(), "shape")).and_then(|sizes| sizes.extract()) {
                Ok::<Vec<usize>, _>(sizes) => format!("an array of shape {}", shape_text(&sizes)),
                Err(_) => angle.get_type().name().map_or_else(
                    |_| "another object".to_owned(),
                    |name| format!("an object of type {name}"),
                ),
            };
        let of = if field == "q7" { "joint 7" } else { "its joint" };
        PyTypeError::new_err(format!(
            "{field} must be one real number, the angle of {of} [rad], got {got} (for the solution \
             nearest to a seed take ik_nearest(T, seed))"
        ))
    })
}

/// An arm whose structure is unknown has no inverse.
fn known_structure<const N: usize>(py: Python<'_>, robot: &Robot<N>) -> PyResult<()> {
    robot.known_inverse().map(|_| ()).map_err(|error| to_py(py, &error))
}

/// Joint 7, without which an arm of seven joints has no finite number of solutions.
pub(super) fn needed_q7<T>(py: Python<'_>, robot: &Robot<7>, q7: Option<T>) -> PyResult<T> {
    known_structure(py, robot)?;
    q7.ok_or_else(|| {
        PyTypeError::new_err(
            "an arm of seven joints needs q7, the angle of joint 7 [rad], or another joint as \
             given={3: 0.2}; or take ik_nearest",
        )
    })
}

/// Of q7 and given, one says all.
pub(super) fn no_q7_beside_given(q7: Option<&Bound<'_, PyAny>>) -> PyResult<()> {
    match q7 {
        Some(_) => Err(PyTypeError::new_err("q7 and given: pass one of them")),
        None => Ok(()),
    }
}
