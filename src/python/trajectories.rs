//! The functions of `irbkin.trajectory`: motions of joints over time.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyFloat;

use super::arguments::{read_profile, read_spline, read_steps, read_synchronization};
use super::arrays::{Rows, copied_numbers};
use super::errors::{Fault, shape_text, to_py};
use super::trajectory::PyTrajectory;
use crate::trajectory::{AxisLimits, AxisState, joint_within};

/// Numbers of one dimension.
fn read_vector(value: &Bound<'_, PyAny>, field: &'static str) -> PyResult<Vec<f64>> {
    if let Some(numbers) = copied_numbers(value) {
        return Ok(numbers);
    }
    let rows = Rows::read(value, &[], field, Fault::Joints)?;
    if rows.lead.len() != 1 {
        let message = format!("{field} must have shape (n,), got {}", shape_text(&rows.lead));
        return Err(Fault::Joints.error(value.py(), message));
    }
    Ok(rows.data()?.to_vec())
}

/// Joint vectors, shape (m, n): the numbers, and n.
pub(super) fn read_rows(
    value: &Bound<'_, PyAny>,
    field: &'static str,
) -> PyResult<(Vec<f64>, usize)> {
    let rows = Rows::read(value, &[], field, Fault::Joints)?;
    match rows.lead[..] {
        [_, dof] if dof > 0 => Ok((rows.data()?.to_vec(), dof)),
        _ => {
            let message = format!("{field} must have shape (m, n), got {}", shape_text(&rows.lead));
            Err(Fault::Joints.error(value.py(), message))
        }
    }
}

/// A number for each joint.
pub(super) enum Each {
    Same(f64),
    Own(Vec<f64>),
}

impl Each {
    fn of(&self, joint: usize) -> f64 {
        match self {
            Self::Same(number) => *number,
            Self::Own(numbers) => numbers[joint],
        }
    }

    pub(super) fn vector(self, dof: usize) -> Vec<f64> {
        match self {
            Self::Same(number) => vec![number; dof],
            Self::Own(numbers) => numbers,
        }
    }
}

/// A number for each joint, or one for all; `default` where none is given.
pub(super) fn read_each(
    value: Option<&Bound<'_, PyAny>>,
    field: &'static str,
    dof: usize,
    default: f64,
) -> PyResult<Each> {
    let Some(value) = value else { return Ok(Each::Same(default)) };
    // The short ways: one number needs no array, and an array of them no record of a borrow.
    if let Ok(one) = value.cast::<PyFloat>() {
        return Ok(Each::Same(one.value()));
    }
    if let Some(numbers) = copied_numbers(value).filter(|numbers| numbers.len() == dof) {
        return Ok(Each::Own(numbers));
    }
    let rows = Rows::read(value, &[], field, Fault::Motion)?;
    match (&rows.lead[..], rows.data()?) {
        ([], [one]) => Ok(Each::Same(*one)),
        ([found], numbers) if *found == dof => Ok(Each::Own(numbers.to_vec())),
        (sizes, _) => {
            let (one, got) = (shape_text(&[dof]), shape_text(sizes));
            let message = format!("{field} must be a number or have shape {one}, got {got}");
            Err(Fault::Motion.error(value.py(), message))
        }
    }
}

/// Limits of the joints; infinite where none is given.
fn read_limits(given: [Option<&Bound<'_, PyAny>>; 3], dof: usize) -> PyResult<Vec<AxisLimits>> {
    let fields = ["max_velocity", "max_acceleration", "max_jerk"];
    let [velocity, acceleration, jerk] =
        [0, 1, 2].map(|which| read_each(given[which], fields[which], dof, f64::INFINITY));
    let (velocity, acceleration, jerk) = (velocity?, acceleration?, jerk?);
    let limits = (0..dof).map(|joint| AxisLimits {
        velocity: velocity.of(joint),
        acceleration: acceleration.of(joint),
        jerk: jerk.of(joint),
    });
    Ok(limits.collect())
}

/// Move from one joint vector to another.
///
/// Args:
///     q0: Joint angles at the start [rad], shape (n,).
///     q1: Joint angles at the end [rad], shape (n,).
///     steps: Number of samples, both ends included.
///     duration: Duration [s]; 1 where neither it nor a limit is given, the shortest that the
///         limits allow where only limits are given.
///     profile: "quintic", "cubic", "trapezoid" (constant acceleration, a third of the duration
///         each) or "s_curve" (the same with constant jerk).
///     start_velocity: Velocities at the start [rad/s], of a quintic or a cubic; zero.
///     end_velocity: Velocities at the end [rad/s], of a quintic or a cubic; zero.
///     start_acceleration: Accelerations at the start [rad/s^2], of a quintic; zero.
///     end_acceleration: Accelerations at the end [rad/s^2], of a quintic; zero.
///     max_velocity: Limits [rad/s], a number or shape (n,).
///     max_acceleration: Limits [rad/s^2], a number or shape (n,).
///     max_jerk: Limits [rad/s^3], a number or shape (n,).
///     synchronization: With limits alone: "time", each joint has a profile of its own, slowed down
///         to the slowest; or "phase", a straight line in joint space.
///
/// Returns:
///     The trajectory, which meets both ends. With a duration and limits it is checked against
///     them.
///
/// Raises:
///     InvalidMotionError: A limit or the duration is not positive, the duration is too short for
///         a limit, a joint moves and no limit binds it, or the profile cannot have what is given
///         for an end.
///     InvalidJointsError: A wrong shape.
#[pyfunction]
#[pyo3(signature = (q0, q1, *, steps=50, duration=None, profile="quintic", start_velocity=None,
    end_velocity=None, start_acceleration=None, end_acceleration=None, max_velocity=None,
    max_acceleration=None, max_jerk=None, synchronization="time"))]
#[expect(clippy::too_many_arguments, reason = "keywords of one call")]
pub(super) fn joint(
    q0: &Bound<'_, PyAny>,
    q1: &Bound<'_, PyAny>,
    #[pyo3(from_py_with = read_steps)] steps: usize,
    duration: Option<f64>,
    profile: &str,
    start_velocity: Option<&Bound<'_, PyAny>>,
    end_velocity: Option<&Bound<'_, PyAny>>,
    start_acceleration: Option<&Bound<'_, PyAny>>,
    end_acceleration: Option<&Bound<'_, PyAny>>,
    max_velocity: Option<&Bound<'_, PyAny>>,
    max_acceleration: Option<&Bound<'_, PyAny>>,
    max_jerk: Option<&Bound<'_, PyAny>>,
    synchronization: &str,
) -> PyResult<PyTrajectory> {
    let py = q0.py();
    let profile = read_profile(profile)?;
    let synchronization = read_synchronization(synchronization)?;
    let (start, end) = (read_vector(q0, "q0")?, read_vector(q1, "q1")?);
    let dof = start.len();
    if end.len() != dof {
        let message = format!("q1 must have shape ({dof},) as q0 has, got ({},)", end.len());
        return Err(Fault::Joints.error(py, message));
    }
    let v0 = read_each(start_velocity, "start_velocity", dof, 0.0)?;
    let a0 = read_each(start_acceleration, "start_acceleration", dof, 0.0)?;
    let v1 = read_each(end_velocity, "end_velocity", dof, 0.0)?;
    let a1 = read_each(end_acceleration, "end_acceleration", dof, 0.0)?;
    let states = |q: &[f64], v: &Each, a: &Each| -> Vec<AxisState> {
        let joints = q.iter().enumerate();
        let state = |(joint, position): (usize, &f64)| AxisState {
            position: *position,
            velocity: v.of(joint),
            acceleration: a.of(joint),
        };
        joints.map(state).collect()
    };
    let (from, to) = (states(&start, &v0, &a0), states(&end, &v1, &a1));
    let given = max_velocity.or(max_acceleration).or(max_jerk).is_some();
    let limits = read_limits([max_velocity, max_acceleration, max_jerk], dof)?;
    let motion = if given && duration.is_none() {
        let is_at_rest = |state: &AxisState| state.velocity == 0.0 && state.acceleration == 0.0;
        if !from.iter().chain(&to).all(is_at_rest) {
            let message = "limits without a duration are for motions from rest to rest: give \
                           duration for velocities or accelerations at the ends, or use \
                           trajectory.state_to_state";
            return Err(Fault::Motion.error(py, message.to_owned()));
        }
        joint_within(profile, &start, &end, &limits, synchronization)
    } else {
        crate::trajectory::joint(profile, &from, &to, duration.unwrap_or(1.0))
            .and_then(|motion| motion.within(&limits).map(|()| motion))
    };
    PyTrajectory::even(py, motion.map_err(|error| to_py(py, &error))?, steps)
}

/// Move through many joint vectors on a smooth curve, at rest at both ends.
///
/// Args:
///     q: Waypoints [rad], shape (m, n).
///     t: Times of the waypoints [s], shape (m,), increasing. The trajectory begins at 0: only
///         their differences count. Without them they are spaced by the distances of the waypoints.
///     steps: Number of samples.
///     duration: Duration without `t` [s]; 1 where no limit is given.
///     profile: "quintic" (zero acceleration at both ends, four continuous derivatives) or "cubic"
///         (two).
///     max_velocity: Limits [rad/s], a number or shape (n,): without `t` and `duration` the curve
///         is as fast as they allow.
///     max_acceleration: Limits [rad/s^2], in the same way.
///     max_jerk: Limits [rad/s^3], in the same way.
///
/// Returns:
///     The trajectory, which passes every waypoint.
///
/// Raises:
///     InvalidMotionError: Fewer than two waypoints, waypoints that repeat the one before without
///         `t`, times that do not increase, a limit that is exceeded or not positive.
///     InvalidJointsError: A wrong shape.
#[pyfunction]
#[pyo3(signature = (q, *, t=None, steps=100, duration=None, profile="quintic", max_velocity=None,
    max_acceleration=None, max_jerk=None))]
#[expect(clippy::too_many_arguments, reason = "keywords of one call")]
pub(super) fn spline(
    q: &Bound<'_, PyAny>,
    t: Option<&Bound<'_, PyAny>>,
    #[pyo3(from_py_with = read_steps)] steps: usize,
    duration: Option<f64>,
    profile: &str,
    max_velocity: Option<&Bound<'_, PyAny>>,
    max_acceleration: Option<&Bound<'_, PyAny>>,
    max_jerk: Option<&Bound<'_, PyAny>>,
) -> PyResult<PyTrajectory> {
    let py = q.py();
    let kind = read_spline(profile)?;
    let (points, dof) = read_rows(q, "q")?;
    let given = max_velocity.or(max_acceleration).or(max_jerk).is_some();
    let limits = read_limits([max_velocity, max_acceleration, max_jerk], dof)?;
    if t.is_some() && duration.is_some() {
        return Err(PyValueError::new_err("give t or duration, not both"));
    }
    let times = t.map(|t| read_vector(t, "t")).transpose()?;
    let motion = crate::trajectory::through(
        kind,
        &points,
        dof,
        times.as_deref(),
        duration.or(if given { None } else { Some(1.0) }),
        &limits,
    );
    PyTrajectory::even(py, motion.map_err(|error| to_py(py, &error))?, steps)
}
