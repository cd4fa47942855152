//! `irbkin.stream.Guard`: set points for a control loop.

use std::sync::{Mutex, MutexGuard, PoisonError};

use pyo3::basic::CompareOp;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyTuple};

use super::arguments::{VIOLATIONS, one_of};
use super::arm::{ByJoints, each, on};
use super::arrays::{matrix4, vector};
use super::cell::PyCell;
use super::errors::{Fault, exception};
use super::outputs::array;
use super::record::{self, record, record_methods};
use super::records::Array;
use super::robot::PyRobot;
use super::targets::shape_of;
use super::trajectories::read_limits;
use irbkin::pose::from_rows as pose_from_rows;
use irbkin::{Error, Pose};
use irbkin_motion::cell::Cell;
use irbkin_motion::stream::{Guard, GuardOptions};

record! {
    "irbkin.stream";
    /// A set point of a `Guard`.
    Step {
        /// Joint angles [rad], shape (n,).
        q: Array,
        /// Velocities [rad/s], shape (n,).
        dq: Array,
        /// Accelerations [rad/s^2], shape (n,).
        ddq: Array,
        /// Whether the reference is followed as it is.
        accepted: bool,
        /// What the guard is doing: "following" the reference or going towards it, "braking", or
        /// "holding" its place.
        state: String,
        /// Why the reference is not followed as it is, with the joint, the value and the bound; None
        /// if it is.
        reason: Option<String>,
    }
}

/// A guard in front of a control loop: in each cycle a reference, or none, and a set point within
/// bounds. This is no safety function.
///
/// Every set point is inside the limits of the joints and within the bounds, and so is the motion
/// to it: the cubic of the joint angles and velocities at both ends. After every cycle a braking
/// motion exists that is so too. Both are proven free in the cell (docs/guide/stream.md). The first
/// set points are at rest at `start`; a set point follows its reference one cycle later. Steps of
/// several threads follow one another.
///
/// Args:
///     robot: The arm.
///     cycle: Time from one set point to the next [s], at most 0.5.
///     start: Joint vector at which the arm rests [rad], shape (n,).
///     max_velocity: Limits [rad/s], a number or shape (n,); the robot's when not given.
///     max_acceleration: Limits [rad/s^2], a number or shape (n,).
///     max_jerk: Limits [rad/s^3], a number or shape (n,); none when not given.
///     cell: What is around the arm; when not given, the arm stays clear of itself. False proves
///         nothing.
///     margin: How far the arm stays from obstacles, beyond the margin of the cell [m].
///     max_tool_speed: Limit of the speed of the tool center point [m/s]; none when not given.
///     on_violation: "brake" refuses a reference that does not fit, and brakes; "limit" goes
///         towards it as far and as fast as the bounds allow. In "brake", too, the guard goes on
///         towards references that stay near, as those with noise, jitter or rounding do.
///     hold: For how long None goes on towards the last reference, before it brakes [s].
///
/// Raises:
///     InvalidMotionError: A cycle or a limit that is not positive, a cycle above 0.5 s, a hold
///         below 0 or above 10 s.
///     InvalidModelError: Neither `max_velocity` nor limits of the robot; no body; a negative
///         margin.
///     InvalidJointsError: A start of a wrong shape or that is not finite.
///     UnreachableError: The start is outside the limits or collides.
///     ValueError: Another `on_violation`.
#[pyclass(name = "Guard", module = "irbkin.stream", frozen)]
pub(super) struct PyGuard {
    guard: ByJoints<Mutex<Guard<6>>, Mutex<Guard<7>>, Mutex<Guard<5>>>,
    robot: Py<PyRobot>,
}

#[pymethods]
impl PyGuard {
    #[new]
    #[pyo3(signature = (robot, *, cycle, start, max_velocity=None, max_acceleration, max_jerk=None, cell=None, margin=0.0, max_tool_speed=None, on_violation="brake", hold=0.0))]
    fn new(
        robot: &Bound<'_, PyRobot>,
        cycle: f64,
        start: &Bound<'_, PyAny>,
        max_velocity: Option<&Bound<'_, PyAny>>,
        max_acceleration: &Bound<'_, PyAny>,
        max_jerk: Option<&Bound<'_, PyAny>>,
        cell: Option<&Bound<'_, PyAny>>,
        margin: f64,
        max_tool_speed: Option<f64>,
        on_violation: &str,
        hold: f64,
    ) -> PyResult<Self> {
        let on_violation = one_of("on_violation", on_violation, &VIOLATIONS)?;
        let cell = read_cell(cell)?;
        let guard = each!(robot.get().arm(), arm => {
            let max_acceleration = read_limits(Some(max_acceleration), "max_acceleration")?;
            let options = GuardOptions {
                cycle,
                max_acceleration: max_acceleration.unwrap_or([f64::INFINITY; _]),
                max_velocity: read_limits(max_velocity, "max_velocity")?,
                max_jerk: read_limits(max_jerk, "max_jerk")?,
                margin,
                max_tool_speed,
                on_violation,
                hold,
            };
            let start = vector(start, "start", Fault::Joints)?;
            Mutex::new(Guard::new(arm, &start, cell.as_ref(), &options).map_err(exception)?)
        });
        Ok(Self { guard, robot: robot.clone().unbind() })
    }

    /// Return the next set point.
    ///
    /// Args:
    ///     reference: Joint vector [rad], shape (n,); or a pose of the tool, shape (4, 4),
    ///         translation [m], which is solved nearest to the last reference on its branch; or
    ///         None if none came in this cycle: the guard goes on for its `hold`, then it brakes.
    ///
    /// Returns:
    ///     The `irbkin.stream.Step`. Numbers that are not finite are refused in its `reason`.
    ///
    /// Raises:
    ///     InvalidJointsError, InvalidPoseError: A wrong shape; the guard stays as it is.
    #[pyo3(signature = (reference))]
    fn step(&self, reference: &Bound<'_, PyAny>) -> PyResult<Step> {
        on!(&self.guard, guard => taken(guard, reference))
    }

    /// The arm, an `irbkin.Robot`.
    #[getter]
    fn robot(&self, py: Python<'_>) -> Py<PyRobot> {
        self.robot.clone_ref(py)
    }

    /// Time from one set point to the next [s].
    #[getter]
    fn cycle(&self) -> f64 {
        on!(&self.guard, guard => locked(guard).cycle())
    }

    /// The state: "following", "braking" or "holding".
    #[getter]
    fn state(&self) -> &'static str {
        on!(&self.guard, guard => locked(guard).state().name())
    }

    /// For how long None goes on towards the last reference [s].
    #[getter]
    fn hold(&self) -> f64 {
        on!(&self.guard, guard => locked(guard).hold())
    }

    /// The last set point [rad], shape (n,).
    #[getter]
    fn q(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        on!(&self.guard, guard => {
            let q = locked(guard).q();
            array(py, q, &[q.len()])
        })
    }

    fn __repr__(&self) -> String {
        on!(&self.guard, guard => {
            let guard = locked(guard);
            let proven = if guard.proves_free() { "" } else { ", proves nothing free" };
            let (name, cycle) = (guard.arm().name(), guard.cycle());
            let comma = if name.is_empty() { "" } else { ", " };
            format!("<Guard: {name}{comma}cycle {cycle} s, {}{proven}>", guard.state().name())
        })
    }
}

/// The cell in which motions are proven free; None is the arm alone, False none.
fn read_cell(cell: Option<&Bound<'_, PyAny>>) -> PyResult<Option<Cell>> {
    let Some(cell) = cell else { return Ok(Some(Cell::default())) };
    if cell.cast::<PyBool>().is_ok_and(|proves| !proves.is_true()) {
        return Ok(None);
    }
    let cell = cell.cast::<PyCell>().map_err(|_| {
        PyTypeError::new_err(
            "cell must be an irbkin.Cell, None for the arm alone, or False to prove nothing",
        )
    })?;
    Ok(Some(Cell::clone(&cell.get().cell)))
}

/// The guard, for one thread at a time. No code of Python runs while it is locked: a thread that
/// holds the interpreter never waits.
fn locked<const N: usize>(guard: &Mutex<Guard<N>>) -> MutexGuard<'_, Guard<N>> {
    guard.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A reference that is not None.
enum Reference<const N: usize> {
    Joints([f64; N]),
    Pose(Pose),
    NotRigid,
}

impl<const N: usize> Reference<N> {
    fn read(reference: &Bound<'_, PyAny>) -> PyResult<Self> {
        if shape_of(reference).is_none_or(|shape| shape.len() < 2) {
            return Ok(Self::Joints(vector(reference, "reference", Fault::Joints)?));
        }
        match pose_from_rows(&matrix4(reference, "reference", Fault::Pose)?) {
            Ok(pose) => Ok(Self::Pose(pose)),
            Err(Error::InvalidPose(_)) => Ok(Self::NotRigid),
            Err(error) => Err(exception(error)),
        }
    }
}

/// The next set point.
fn taken<const N: usize>(guard: &Mutex<Guard<N>>, reference: &Bound<'_, PyAny>) -> PyResult<Step> {
    let py = reference.py();
    let reference = (!reference.is_none()).then(|| Reference::read(reference)).transpose()?;
    let (step, reason) = {
        let mut guard = locked(guard);
        let step = match reference {
            None => guard.step_none(),
            Some(Reference::Joints(q)) => guard.step(&q),
            Some(Reference::Pose(pose)) => guard.step_pose(&pose),
            Some(Reference::NotRigid) => guard.step_not_rigid(),
        };
        (step, step.reason.map(|reason| guard.words(&reason)))
    };
    Ok(Step {
        q: array(py, step.q, &[N])?,
        dq: array(py, step.dq, &[N])?,
        ddq: array(py, step.ddq, &[N])?,
        accepted: step.accepted,
        state: step.state.name().to_owned(),
        reason,
    })
}
