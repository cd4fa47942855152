//! `Robot.go`: a motion that is proven free in a cell.

use std::time::Instant;

use pyo3::prelude::*;

use super::arguments::read_seed;
use super::arm::on;
use super::arrays::{matrix4, vector};
use super::cell::PyCell;
use super::errors::{Fault, exception, raised, with_attributes};
use super::robot::PyRobot;
use super::signals::detached_until;
use super::targets::shape_of;
use super::trajectories::read_limits;
use super::trajectory::PyTrajectory;
use irbkin::Interrupt;
use irbkin::pose::from_rows as pose_from_rows;
use irbkin_motion::Error;
use irbkin_motion::cell::Cell;
use irbkin_motion::go::{End, GoOptions};
use irbkin_motion::internal::{GoFault, check_positive};

#[pymethods]
impl PyRobot {
    /// Move from joint angles or a pose to joint angles or a pose, from rest to rest, without
    /// touching anything: the motion is proven free at every instant (`Cell.check_path`).
    ///
    /// A pose is left or reached by any of its solutions inside the limits, at the turns of the
    /// joints that are near the other end; of seven joints with joint 7 at 24 angles. If the joints
    /// can move evenly to a goal, they do. Otherwise a path is sought by samples from both ends
    /// (RRT-Connect), shortened, its corners rounded as far as that is free, and timed. One seed
    /// gives one motion. A locked joint stays at its angle.
    ///
    /// Args:
    ///     start: Joint angles [rad], shape (n,), or a pose of the tool, shape (4, 4).
    ///     goal: The same.
    ///     cell: What is around the arm; when not given, the arm stays clear of itself.
    ///     seconds: How long is sought [s].
    ///     seed: Which samples are taken, a whole number from 0 on.
    ///     max_velocity: Limits [rad/s], a number or shape (n,); the robot's when not given,
    ///         1 rad/s where they are unknown.
    ///     max_acceleration: Limits [rad/s^2], a number or shape (n,); when not given, those that
    ///         reach the velocities in 0.5 s.
    ///     steps: Number of samples of the answer.
    ///
    /// Returns:
    ///     The `irbkin.trajectory.Trajectory`.
    ///
    /// Raises:
    ///     UnreachableError: `proven` is True where no motion can be: the start or every solution
    ///         of the goal collides (the message names the two that touch and the depth), is not
    ///         reached, or is outside the limits. It is False where none was found in the time, or
    ///         where not all solutions of the pose were tried.
    ///     InvalidPoseError, InvalidJointsError: A wrong shape, or an element that is not finite.
    ///     InvalidMotionError: A limit or a time that is not positive.
    ///     InvalidModelError: The robot has no body.
    #[pyo3(signature = (start, goal, cell=None, *, seconds=2.0, seed=0, max_velocity=None, max_acceleration=None, steps=100))]
    fn go(
        &self,
        start: &Bound<'_, PyAny>,
        goal: &Bound<'_, PyAny>,
        cell: Option<&Bound<'_, PyCell>>,
        seconds: f64,
        #[pyo3(from_py_with = read_seed)] seed: u64,
        max_velocity: Option<&Bound<'_, PyAny>>,
        max_acceleration: Option<&Bound<'_, PyAny>>,
        steps: usize,
    ) -> PyResult<PyTrajectory> {
        check_positive("seconds", seconds).map_err(exception)?;
        let alone = Cell::default();
        let cell = cell.map_or(&alone, |cell| &cell.get().cell);
        let py = start.py();
        let motion = on!(self.arm(), robot => {
            let (start, goal) = (read_end(start, "start")?, read_end(goal, "goal")?);
            let options = GoOptions {
                seed,
                max_velocity: read_limits(max_velocity, "max_velocity")?,
                max_acceleration: read_limits(max_acceleration, "max_acceleration")?,
            };
            let begun = Instant::now();
            detached_until(py, |interrupt| {
                let ends = || begun.elapsed().as_secs_f64() >= seconds || interrupt.is_raised();
                robot.go(&start, &goal, cell, &options, Interrupt::when(&ends))
            })?
        });
        let motion = motion.map_err(|error| refused(error, seconds))?;
        Ok(PyTrajectory::even(motion, steps)?.with_names(self.file_joint_names()))
    }
}

/// The exception of an error, after a search of `seconds`.
fn refused(error: Error, seconds: f64) -> PyErr {
    let Error::NoMotion(fault) = error else { return exception(error) };
    let message = match &fault {
        GoFault::NotFound { .. } => format!("{fault} ({seconds} s were given)"),
        _ => fault.to_string(),
    };
    with_attributes(raised("UnreachableError", message), |value| {
        value.setattr("proven", fault.is_proven())
    })
}

/// An end of the motion: joint angles or a pose.
fn read_end<const N: usize>(value: &Bound<'_, PyAny>, field: &'static str) -> PyResult<End<N>> {
    if shape_of(value).is_some_and(|shape| shape.len() > 1) {
        return Ok(End::Pose(
            pose_from_rows(&matrix4(value, field, Fault::Pose)?).map_err(exception)?,
        ));
    }
    Ok(End::Joints(vector(value, field, Fault::Joints)?))
}
