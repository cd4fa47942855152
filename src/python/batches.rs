//! Every joint vector of many poses.

use std::num::NonZeroUsize;

use pyo3::exceptions::PyTypeError;
use pyo3::intern;
use pyo3::prelude::*;

use super::answers::{BatchArrays, batch_output};
use super::arm::Arm;
use super::arrays::{Rows, addresses};
use super::broadcast::{Argument, together};
use super::classes;
use super::errors::{Fault, to_py};
use super::outputs::writable;
use super::signals::detached;
use super::wording::shape;
use crate::batch::Pace;
use crate::error::{Error, ModelFault};
use crate::kinematics::{Arity, Joints, Robot};

/// `irbkin.IkBatch` of poses, shape (..., 4, 4), and of joint 7 for each where the arm has seven.
pub(super) fn ik<'py>(
    arm: &Arm,
    poses: &Bound<'py, PyAny>,
    q7: Option<&Bound<'py, PyAny>>,
    out: Option<&Bound<'py, PyAny>>,
    threads: Option<NonZeroUsize>,
) -> PyResult<Bound<'py, PyAny>> {
    let py = poses.py();
    let (poses, given) = read_poses(arm, poses, q7)?;
    let answers = batch_output(py, out, &poses, [arm.slot_count(), arm.dof()])?;
    filled(py, &poses, answers, threads, |pace, poses, q, status| match arm {
        Arm::Six(robot) => pace.ik(robot, poses, q, status),
        Arm::Seven(robot) => pace.ik_with(robot, poses, &given, q, status),
    })
}

/// `irbkin.IkBatch` of poses, whose arrays `solve` writes from those of the poses.
pub(super) fn filled<'py>(
    py: Python<'py>,
    poses: &Rows<'py>,
    (q, status): BatchArrays<'py>,
    threads: Option<NonZeroUsize>,
    solve: impl FnOnce(&mut Pace<'_>, &[f64], &mut [f64], &mut [u8]) -> Result<(), Error> + Send,
) -> PyResult<Bound<'py, PyAny>> {
    let (data, mut q_view, mut status_view) = (
        poses.data()?,
        writable(&q, &[poses.addresses()])?,
        writable(&status, &[poses.addresses(), addresses(&q)])?,
    );
    let (q_slice, status_slice) = (q_view.as_slice_mut()?, status_view.as_slice_mut()?);
    detached(py, threads, |pace| solve(pace, data, q_slice, status_slice))?;
    classes::ik_batch_class(py)?.call1((q, status))
}

/// Poses, shape (..., 4, 4), and joint 7 of each where the arm has seven.
pub(super) fn read_poses<'py>(
    arm: &Arm,
    poses: &Bound<'py, PyAny>,
    q7: Option<&Bound<'py, PyAny>>,
) -> PyResult<(Rows<'py>, Vec<f64>)> {
    let py = poses.py();
    let given = match arm {
        Arm::Six(robot) => {
            no_q7(q7.is_some())?;
            known_structure(py, robot)?;
            None
        }
        Arm::Seven(robot) => Some(needed_q7(py, robot, q7)?),
    };
    let mut poses = Rows::read(poses, &[4, 4], "T", Fault::Pose)?;
    let given = match given {
        Some(q7) => read_angles(q7, "q7", &mut poses)?.data()?.to_vec(),
        None => Vec::new(),
    };
    Ok((poses, given))
}

/// An angle of a joint for each pose; both are broadcast.
pub(super) fn read_angles<'py>(
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
                Ok::<Vec<usize>, _>(sizes) => format!("an array of shape {}", shape(&sizes)),
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
fn known_structure<const N: usize>(py: Python<'_>, robot: &Robot<N>) -> PyResult<()>
where
    Joints<N>: Arity<N>,
{
    match robot.unknown_structure() {
        Some(reason) => Err(to_py(py, &ModelFault::UnknownStructure(reason).into())),
        None => Ok(()),
    }
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
