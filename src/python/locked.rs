//! Arms of seven joints with one of them locked.

use std::num::NonZeroUsize;
use std::sync::Arc;

use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyMapping};

use super::arm::{Arm, on};
use super::arrays::Rows;
use super::errors::{Fault, to_py};
use super::outputs::{output, writable};
use super::paths;
use super::records::FollowResult;
use super::redundancy::one_angle;
use super::robot::PyRobot;
use crate::kinematics::{FollowOptions, Robot};

#[pymethods]
impl PyRobot {
    /// Return the same arm of seven joints with one of them locked: its `ik`, `ik_batch`,
    /// `ik_nearest`, `follow` and `check_pose` take poses alone, and its answers have seven angles.
    ///
    /// The robot prepares a joint once, in milliseconds, and each other angle of one between the
    /// first and the last in a tenth of one. Slots and structure belong to the other six
    /// joints or, if joint 7 is locked, to the arm. A joint that was locked before is released.
    ///
    /// Args:
    ///     given: A joint and its angle [rad], as {3: 0.2}: joints count from 1.
    ///
    /// Raises:
    ///     InvalidJointsError: There is no such joint, or its angle is not finite.
    ///     InvalidModelError: The other six joints do not move the tool in six independent ways.
    ///     TypeError, ValueError: The arm has six joints; given does not map one joint.
    fn locked(&self, given: &Bound<'_, PyAny>) -> PyResult<Self> {
        let (joint, angle) = read_pair(self.arm(), given)?;
        locked(self, joint, &angle).map(|robot| Arm::from(robot).into())
    }

    /// Return the same arm without a locked joint.
    fn unlocked(&self) -> Self {
        released(self)
    }

    /// The joint that is locked, from 1, and its angle [rad], as (3, 0.2); None if none is.
    #[getter]
    fn locked_joint(&self) -> Option<(usize, f64)> {
        on!(self.arm(), robot => robot.locked_joint())
    }

    /// The other six joints of an arm with a locked one as a robot, with the arm's base, tool,
    /// limits and velocities; None if no joint is locked. Its joints are numbered 1 to 6.
    #[getter]
    fn six_joints(&self, py: Python<'_>) -> PyResult<Option<Self>> {
        let six = on!(self.arm(), robot => robot.six_joints());
        Ok(six.map_err(|error| to_py(py, &error))?.map(|six| Arm::from(six).into()))
    }
}

/// The arm without a locked joint.
pub(super) fn released(robot: &PyRobot) -> PyRobot {
    on!(robot.arm(), robot => Arm::from(Robot::clone(robot).unlocked())).into()
}

/// The joint, from 1, and the angle or angles of `{3: 0.2}`.
pub(super) fn read_pair<'py>(
    arm: &Arm,
    given: &Bound<'py, PyAny>,
) -> PyResult<(usize, Bound<'py, PyAny>)> {
    let py = given.py();
    if matches!(arm, Arm::Six(_)) {
        return Err(PyTypeError::new_err(
            "given is for arms of seven joints: the pose alone determines the six of this one",
        ));
    }
    let Ok(pairs) = given.cast::<PyMapping>() else {
        return Err(PyTypeError::new_err(format!(
            "given must map a joint, from 1, to its angle [rad], as {{3: 0.2}}, got {}",
            given.get_type().name()?
        )));
    };
    let pairs = pairs.items()?;
    if pairs.len() != 1 {
        return Err(PyValueError::new_err(format!(
            "given has {} joints: a pose determines six of seven, give one",
            pairs.len()
        )));
    }
    let (joint, angle): (Bound<'py, PyAny>, Bound<'py, PyAny>) = pairs.get_item(0)?.extract()?;
    // A bool is a number for Python.
    let number = joint.extract::<i64>().ok().filter(|_| !joint.is_instance_of::<PyBool>());
    let number = number.ok_or_else(|| {
        PyTypeError::new_err(format!("given: {joint} is not the number of a joint, from 1"))
    })?;
    let missing =
        || Fault::Joints.error(py, format!("given: there is no joint {number}, it must be 1 to 7"));
    let joint = usize::try_from(number).ok().filter(|joint| (1..=7).contains(joint));
    Ok((joint.ok_or_else(missing)?, angle))
}

/// The arm with a joint, from 1, locked at an angle. The first one of a joint is kept: another
/// angle is prepared from it in a fraction of the time.
pub(super) fn locked(
    robot: &PyRobot,
    joint: usize,
    angle: &Bound<'_, PyAny>,
) -> PyResult<Arc<Robot<7>>> {
    let Arm::Seven(arm) = robot.arm() else {
        return Err(PyTypeError::new_err("given is for arms of seven joints"));
    };
    let prepared = &robot.locked[joint - 1];
    let like = prepared.get().unwrap_or(arm);
    let locked = like.locked(joint, one_angle(angle, "given")?);
    let locked = Arc::new(locked.map_err(|error| to_py(angle.py(), &error))?);
    // Another thread may have been faster, with another angle.
    let _ = prepared.set(Arc::clone(&locked));
    Ok(locked)
}

/// Follow paths of poses with the other six joints of an arm with a locked one.
pub(super) fn follow<'py>(
    robot: &Robot<7>,
    six: &Robot<6>,
    paths: &Bound<'py, PyAny>,
    seed: &Bound<'py, PyAny>,
    options: &FollowOptions,
    out: Option<&Bound<'py, PyAny>>,
    threads: Option<NonZeroUsize>,
) -> PyResult<FollowResult> {
    let py = paths.py();
    let seeds = Rows::read(seed, &[7], "seed", Fault::Joints)?;
    if out.is_some() {
        return Err(PyTypeError::new_err("out is for arms of six joints"));
    }
    let starts = converted(py, &seeds, |q: &[f64; 7]| robot.others(q))?;
    let followed = paths::follow(six, paths, &starts, options, None, threads)?;
    let rows = Rows::read(followed.q.bind(py), &[6], "q", Fault::Joints)?;
    let q = converted(py, &rows, |six: &[f64; 6]| robot.with_others(six))?;
    drop(rows);
    Ok(FollowResult { q: q.unbind(), ..followed })
}

/// Rows of joint vectors, each converted to one of another length.
fn converted<'py, const M: usize, const N: usize>(
    py: Python<'py>,
    rows: &Rows<'py>,
    convert: impl Fn(&[f64; M]) -> [f64; N],
) -> PyResult<Bound<'py, PyAny>> {
    let answer = output(py, None, &rows.shape_with(&[N]))?;
    let mut view = writable(&answer, &[rows.addresses()])?;
    let from = rows.data()?.as_chunks::<M>().0;
    for (to, from) in view.as_slice_mut()?.as_chunks_mut::<N>().0.iter_mut().zip(from) {
        *to = convert(from);
    }
    drop(view);
    Ok(answer.into_any())
}
