//! The functions of `irbkin.trajectory` that time a path of joints.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use super::arguments::{read_angle_limits, read_steps};
use super::errors::{Fault, exception};
use super::outputs::column;
use super::records::ToolSpeedLimits;
use super::signals::detached_until;
use super::targets::{check_meters, read_path_poses};
use super::trajectories::{check_turns, inside, read_each, read_rows};
use super::trajectory::PyTrajectory;
use irbkin::Interrupt;
use irbkin_motion::Error;
use irbkin_motion::trajectory::{self, Retiming, Trajectory, tool_lengths};

struct Path {
    q: Vec<f64>,
    max_velocity: Vec<f64>,
    max_acceleration: Vec<f64>,
}

impl Path {
    fn read(
        q: &Bound<'_, PyAny>,
        max_velocity: &Bound<'_, PyAny>,
        max_acceleration: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let (q, dof) = read_rows(q, "q")?;
        let none = f64::INFINITY;
        let max_velocity = read_each(Some(max_velocity), "max_velocity", dof, none)?;
        let max_acceleration = read_each(max_acceleration, "max_acceleration", dof, none)?;
        Ok(Self { q, max_velocity, max_acceleration })
    }

    fn rows(&self) -> usize {
        self.q.len() / self.max_velocity.len()
    }

    /// The lengths of the tool's path `T` up to each row.
    fn read_lengths(&self, tool: &Bound<'_, PyAny>) -> PyResult<Vec<f64>> {
        let poses = read_path_poses(tool)?;
        check_meters(&poses)?;
        let (found, wanted) = (poses.len(), self.rows());
        if found != wanted {
            let message = format!(
                "T must have shape ({wanted}, 4, 4), a pose for each row of q, got {found}"
            );
            return Err(Fault::Pose.error(message));
        }
        Ok(tool_lengths(&poses))
    }

    /// The trajectory with `steps` samples, or with as many as there are rows.
    fn timed(
        &self,
        py: Python<'_>,
        limits: Option<&Bound<'_, PyAny>>,
        steps: Option<&Bound<'_, PyAny>>,
        time: impl FnOnce(&Self, Interrupt<'_>) -> Result<Trajectory, Error> + Send,
    ) -> PyResult<PyTrajectory> {
        let steps = steps.map_or(Ok(self.rows().max(2)), read_steps)?;
        let limits = read_angle_limits(limits, self.max_velocity.len())?;
        let motion =
            detached_until(py, |interrupt| inside(time(self, interrupt)?, limits.as_deref()))?;
        let motion = motion.map_err(exception)?;
        check_turns("q", &self.q, self.max_velocity.len(), limits.as_deref())?;
        PyTrajectory::even(motion, steps)
    }
}

/// Move along a path in the shortest time within limits.
///
/// The path is a cubic spline through the samples. No joint exceeds a velocity, an acceleration
/// or a jerk anywhere; with `limits` its angle is checked between the samples too. Catalogs have no
/// accelerations: they are the caller's.
///
/// Args:
///     q: Samples of the path [rad], shape (m, n), of `robot.follow` for instance.
///     max_velocity: Limits [rad/s], a number or shape (n,); `robot.max_velocity` has a robot's.
///     max_acceleration: Limits [rad/s^2], a number or shape (n,).
///     max_jerk: Limits [rad/s^3] of a motion from rest to rest, a number or shape (n,). Without
///         them the accelerations jump.
///     T: With `max_tool_speed`, the poses of the tool at the samples, shape (m, 4, 4).
///     max_tool_speed: Speed along `T` [m/s] that is not exceeded: the tool has it where the limits
///         allow.
///     start_velocity: Velocities of the joints at the start [rad/s], shape (n,), in the direction
///         of the path: `dq` of a motion along it. Rest if not given.
///     end_velocity: Velocities of the joints at the end, in the same way.
///     limits: Lower and upper limits of the joint angles [rad], shape (n, 2), `robot.limits` for
///         instance: the motion must stay inside, between waypoints too.
///     steps: Number of samples of the answer; as many as `q` has where it is not given.
///
/// Returns:
///     The trajectory.
///
/// Raises:
///     InvalidMotionError: No rows, a limit that is not positive, a path that no limit binds, a
///         duration that is not between 1e-9 and 1e9 s, a velocity at an end that is not along the
///         path or too fast for it, a joint that leaves `limits` (the message has the joint, the
///         time, its angle and the limit) or, with `max_tool_speed`, a part of the path on which
///         the tool only turns, or a step of a joint above 0.1 rad, between whose samples the tool
///         would leave `T`.
///     InvalidJointsError: A wrong shape, an angle that is not finite, or angles in degrees without
///         `limits`.
///     InvalidPoseError: A pose is not a rigid transform or in millimeters, or `T` has another
///         number of poses.
///     TypeError: `max_velocity` is None.
#[pyfunction]
#[pyo3(signature = (q, max_velocity, max_acceleration, *, max_jerk=None, T=None,
    max_tool_speed=None, start_velocity=None, end_velocity=None, limits=None, steps=None))]
pub(super) fn retime(
    q: &Bound<'_, PyAny>,
    max_velocity: &Bound<'_, PyAny>,
    max_acceleration: &Bound<'_, PyAny>,
    max_jerk: Option<&Bound<'_, PyAny>>,
    T: Option<&Bound<'_, PyAny>>,
    max_tool_speed: Option<f64>,
    start_velocity: Option<&Bound<'_, PyAny>>,
    end_velocity: Option<&Bound<'_, PyAny>>,
    limits: Option<&Bound<'_, PyAny>>,
    steps: Option<&Bound<'_, PyAny>>,
) -> PyResult<PyTrajectory> {
    let path = Path::read(q, max_velocity, Some(max_acceleration))?;
    let dof = path.max_velocity.len();
    let jerk = max_jerk.map(|_| read_each(max_jerk, "max_jerk", dof, 0.0)).transpose()?;
    let start = read_each(start_velocity, "start_velocity", dof, 0.0)?;
    let end = read_each(end_velocity, "end_velocity", dof, 0.0)?;
    let lengths = T.map(|tool| path.read_lengths(tool)).transpose()?;
    let tool = match (lengths.as_deref(), max_tool_speed) {
        (None, None) => None,
        (Some(lengths), Some(speed)) => Some((lengths, speed)),
        _ => return Err(PyValueError::new_err("give T and max_tool_speed together, or neither")),
    };
    path.timed(q.py(), limits, steps, |Path { q, max_velocity, max_acceleration }, interrupt| {
        let (start_velocity, end_velocity) = (Some(&start[..]), Some(&end[..]));
        let max_jerk = jerk.as_deref();
        let within = Retiming::within(max_velocity, max_acceleration);
        Retiming { max_jerk, start_velocity, end_velocity, tool, ..within }
            .along_until(q, interrupt)
    })
}

/// Move along a path at a constant speed of the tool, which moves at both ends.
///
/// The joints are a cubic spline over the length of the tool's path, a polygon through its poses.
/// `retime` with `max_tool_speed` begins and ends at rest, and is slower where limits demand it.
///
/// Args:
///     q: As of `retime`.
///     T: Poses of the tool at the samples, shape (m, 4, 4).
///     speed: Speed of the tool along `T` [m/s].
///     max_velocity: As of `retime`.
///     max_acceleration: Limits [rad/s^2], a number or shape (n,); none where it is not given.
///     limits: As of `retime`.
///     steps: Number of samples of the answer; as many as `q` has where it is not given.
///
/// Returns:
///     The trajectory.
///
/// Raises:
///     InvalidMotionError: A joint does not allow the speed: the message names it, the sample and
///         the speed that it allows; the speed or a limit is not positive, a joint leaves
///         `limits`, or the tool only turns on a part of the path.
///     InvalidJointsError, InvalidPoseError: As `retime`.
#[pyfunction]
#[pyo3(signature = (q, T, speed, max_velocity, max_acceleration=None, *, limits=None, steps=None))]
pub(super) fn at_tool_speed(
    q: &Bound<'_, PyAny>,
    T: &Bound<'_, PyAny>,
    speed: f64,
    max_velocity: &Bound<'_, PyAny>,
    max_acceleration: Option<&Bound<'_, PyAny>>,
    limits: Option<&Bound<'_, PyAny>>,
    steps: Option<&Bound<'_, PyAny>>,
) -> PyResult<PyTrajectory> {
    let path = Path::read(q, max_velocity, max_acceleration)?;
    let lengths = path.read_lengths(T)?;
    path.timed(q.py(), limits, steps, |Path { q, max_velocity, max_acceleration }, _| {
        trajectory::at_tool_speed(q, &lengths, speed, max_velocity, max_acceleration)
    })
}

/// Return the highest constant speed of the tool that the limits of the joints allow, and which
/// joint limits it.
///
/// Args:
///     q: As of `retime`.
///     T: Poses of the tool at the samples, shape (m, 4, 4).
///     max_velocity: As of `retime`.
///     max_acceleration: Limits [rad/s^2], a number or shape (n,); none where it is not given.
///
/// Returns:
///     ToolSpeedLimits(speed [m/s], joint, fastest [m/s], fastest_joint, fastest_index): speed and
///     joint for each sample, shape (m,), and the fastest constant speed of the whole path, between
///     the samples too, which `at_tool_speed` takes.
///
/// Raises:
///     InvalidMotionError: No rows, a limit that is not positive, or a part of the path on which
///         the tool only turns.
///     InvalidJointsError, InvalidPoseError: As `retime`.
#[pyfunction]
#[pyo3(signature = (q, T, max_velocity, max_acceleration=None))]
pub(super) fn tool_speed_limits(
    q: &Bound<'_, PyAny>,
    T: &Bound<'_, PyAny>,
    max_velocity: &Bound<'_, PyAny>,
    max_acceleration: Option<&Bound<'_, PyAny>>,
) -> PyResult<ToolSpeedLimits> {
    let py = q.py();
    let path = Path::read(q, max_velocity, max_acceleration)?;
    let lengths = path.read_lengths(T)?;
    let Path { q, max_velocity, max_acceleration } = &path;
    let found = || trajectory::tool_speed_limits(q, &lengths, max_velocity, max_acceleration);
    let limits = py.detach(found).map_err(exception)?;
    let joints = limits.joint.iter().map(|joint| i64::try_from(*joint).unwrap_or_default());
    Ok(ToolSpeedLimits {
        joint: column(py, joints),
        speed: column(py, limits.speed),
        fastest: limits.fastest,
        fastest_joint: limits.fastest_joint,
        fastest_index: limits.fastest_row,
    })
}
