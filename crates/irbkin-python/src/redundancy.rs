//! The joint of seven that a caller fixes: q7, and an arm with a locked one.

use std::sync::Arc;

use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyMapping};

use super::arm::{SharedArm, changed, on};
use super::arrays::{Rows, together};
use super::errors::{Fault, exception};
use super::outputs::describe;
use super::robot::PyRobot;
use irbkin::Robot;
use irbkin_motion::Arm;

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
        Ok(locked(self, joint, &angle)?.into())
    }

    /// The other six joints of an arm with a locked one as a robot, with the arm's base, tool,
    /// limits and velocities; None if no joint is locked. Its joints are numbered 1 to 6.
    #[getter]
    fn six_joints(&self) -> PyResult<Option<Self>> {
        Ok(on!(self.arm(), robot => robot.six_joints())
            .map_err(exception)?
            .map(|six| SharedArm::from(Arm::from(six)).into()))
    }
}

impl PyRobot {
    pub(super) fn unlocked(&self) -> PyResult<SharedArm> {
        on!(self.arm(), arm => changed(arm, |robot| Ok(robot.unlocked())))
    }
}

/// The joint, from 1, and the angle or angles of `{3: 0.2}`.
pub(super) fn read_pair<'py>(
    arm: &SharedArm,
    given: &Bound<'py, PyAny>,
) -> PyResult<(usize, Bound<'py, PyAny>)> {
    if !matches!(arm, SharedArm::Seven(_)) {
        return Err(PyTypeError::new_err(
            "given is for arms of seven joints: the pose alone determines every joint of this one",
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
    let missing = || {
        Fault::Joints.error(format_args!("given: there is no joint {number}, it must be 1 to 7"))
    };
    let joint = usize::try_from(number).ok().filter(|joint| (1..=7).contains(joint));
    Ok((joint.ok_or_else(missing)?, angle))
}

/// The arm with a joint, from 1, locked at an angle. The first one of a joint is kept: another
/// angle is prepared from it in a fraction of the time.
pub(super) fn locked(
    robot: &PyRobot,
    joint: usize,
    angle: &Bound<'_, PyAny>,
) -> PyResult<SharedArm> {
    let SharedArm::Seven(arm) = robot.arm() else {
        return Err(PyTypeError::new_err("given is for arms of seven joints"));
    };
    let prepared = &robot.locked[joint - 1];
    let like = prepared.get().unwrap_or(arm);
    let angle = one_angle(angle, "given")?;
    let locked = Arm::clone(like).map(|robot| robot.locked(joint, angle)).map_err(exception)?;
    let locked = Arc::new(locked);
    // Another thread may have been faster, with another angle.
    let _ = prepared.set(Arc::clone(&locked));
    Ok(SharedArm::Seven(locked))
}

/// Poses, shape (..., 4, 4), and the angle of joint 7 for each, broadcast, where it is not locked.
pub(super) fn read_poses_with_q7<'py>(
    arm: &SharedArm,
    poses: &Bound<'py, PyAny>,
    angles: Option<&Bound<'py, PyAny>>,
) -> PyResult<(Rows<'py>, Vec<f64>)> {
    on!(arm, robot => robot.check_structure()).map_err(exception)?;
    match arm {
        SharedArm::Five(_) | SharedArm::Six(_) => no_q7(arm, angles.is_some())?,
        SharedArm::Seven(robot) if robot.locked_joint().is_none() => {
            needed_q7(robot, angles)?;
        }
        SharedArm::Seven(_) => {}
    }
    let mut poses = Rows::read(poses, &[4, 4], "T", Fault::Pose)?;
    let Some(angles) = angles else { return Ok((poses, Vec::new())) };
    let mut angles = Rows::read(angles, &[], "q7", Fault::Joints)?;
    together(&mut [&mut poses, &mut angles])?;
    let angles = angles.data()?.to_vec();
    Ok((poses, angles))
}

/// An arm of five or six joints has no joint 7.
pub(super) fn no_q7(arm: &SharedArm, given: bool) -> PyResult<()> {
    if !given {
        return Ok(());
    }
    let count = if arm.dof() == 5 { "five" } else { "six" };
    Err(PyTypeError::new_err(format!(
        "q7 is joint 7 of an arm of seven joints: this one has {count} (for the solution nearest to \
         a seed take ik_nearest(T, seed))"
    )))
}

/// The angle of one joint [rad]; a seed is not one.
pub(super) fn one_angle(angle: &Bound<'_, PyAny>, field: &str) -> PyResult<f64> {
    angle.extract().map_err(|_| {
        let got = describe(angle);
        let of = if field == "q7" { "joint 7" } else { "its joint" };
        PyTypeError::new_err(format!(
            "{field} must be one real number, the angle of {of} [rad], got {got} (for the solution \
             nearest to a seed take ik_nearest(T, seed))"
        ))
    })
}

/// Joint 7, without which an arm of seven joints has no finite number of solutions.
pub(super) fn needed_q7<T>(robot: &Robot<7>, q7: Option<T>) -> PyResult<T> {
    robot.check_structure().map_err(exception)?;
    q7.ok_or_else(|| {
        PyTypeError::new_err(
            "an arm of seven joints needs q7, the angle of joint 7 [rad]; take locked({3: 0.2}) for \
             another joint, or ik_nearest",
        )
    })
}
