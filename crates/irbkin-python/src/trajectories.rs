//! The functions of `irbkin.trajectory`: motions of joints over time.

use std::f64::consts::{FRAC_PI_2, TAU};

use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyFloat;

use super::arguments::{
    PROFILES, SPLINES, SYNCHRONIZATIONS, one_of, read_angle_limits, read_steps,
};
use super::arrays::{Rows, copied_numbers, numbers};
use super::errors::{Fault, exception, shape_text};
use super::trajectory::PyTrajectory;
use irbkin::thresholds::FARTHEST_OUTSIDE;
use irbkin_motion::Error;
use irbkin_motion::trajectory::{AxisLimits, AxisState, Trajectory, joint_within};

/// Joints of an arm, at least: external axes, which turn on and on, are fewer.
const LEAST_JOINTS: usize = 4;

/// How far an angle may be off zero, and the sine of twice an angle of quarter turns, by rounding
/// [rad, 1].
const ROUNDING: f64 = 1e-6;

/// Joint vectors, shape (m, n): the numbers, and n.
pub(super) fn read_rows(
    value: &Bound<'_, PyAny>,
    field: &'static str,
) -> PyResult<(Vec<f64>, usize)> {
    let fits = |shape: &[usize]| matches!(shape, [_, dof] if *dof > 0);
    let rows = Rows::shaped(value, || "(m, n)", field, Fault::Joints, fits)?;
    Ok((rows.data()?.to_vec(), rows.lead[1]))
}

/// A number for each joint, or one for all; `default` where none is given.
pub(super) fn read_each(
    value: Option<&Bound<'_, PyAny>>,
    field: &'static str,
    dof: usize,
    default: f64,
) -> PyResult<Vec<f64>> {
    let Some(value) = value else { return Ok(vec![default; dof]) };
    if value.is_none() {
        return Err(PyTypeError::new_err(format!(
            "{field} is None: the speeds of this arm are unknown, give yours for each of the {dof} \
             joints [rad/s]"
        )));
    }
    // The short ways: one number needs no array, and an array of them no record of a borrow.
    if let Ok(one) = value.cast::<PyFloat>() {
        return Ok(vec![one.value(); dof]);
    }
    if let Some(numbers) = copied_numbers(value).filter(|numbers| numbers.len() == dof) {
        return Ok(numbers);
    }
    let rows = Rows::read(value, &[], field, Fault::Motion)?;
    match (&rows.lead[..], rows.data()?) {
        ([], [one]) => Ok(vec![*one; dof]),
        ([found], numbers) if *found == dof => Ok(numbers.to_vec()),
        (sizes, _) => Err(Fault::Motion.error(format_args!(
            "{field} must be a number or have shape ({dof},), got {}",
            shape_text(sizes)
        ))),
    }
}

pub(super) fn read_limits<const N: usize>(
    given: Option<&Bound<'_, PyAny>>,
    field: &'static str,
) -> PyResult<Option<[f64; N]>> {
    Ok(given
        .map(|_| read_each(given, field, N, 0.0))
        .transpose()?
        .and_then(|all| all.try_into().ok()))
}

/// A motion that stays inside limits of joint angles, if they are given.
pub(super) fn inside(motion: Trajectory, limits: Option<&[[f64; 2]]>) -> Result<Trajectory, Error> {
    limits.map_or(Ok(()), |limits| motion.inside(limits)).map(|()| motion)
}

/// Ask back for joint vectors in degrees: an angle beyond four turns, where most angles but zero are
/// beyond one. Whole quarter turns are in radians, a path of steps below one may be of samples, and
/// `limits` answer the question.
pub(super) fn check_turns(
    field: &'static str,
    q: &[f64],
    dof: usize,
    limits: Option<&[[f64; 2]]>,
) -> PyResult<()> {
    let mut steps = q.iter().zip(q.iter().skip(dof)).map(|(from, to)| (to - from).abs());
    let is_sampled = q.len() > dof && steps.all(|step| step < FRAC_PI_2);
    if limits.is_some() || dof < LEAST_JOINTS || is_sampled {
        return Ok(());
    }
    let is_far =
        |angle: &f64| angle.abs() > FARTHEST_OUTSIDE && (2.0 * angle).sin().abs() > ROUNDING;
    for (index, row) in q.chunks_exact(dof).enumerate() {
        let beyond = |least: f64| row.iter().filter(|angle| angle.abs() > least).count();
        let far = row.iter().position(is_far);
        if let Some(joint) = far.filter(|_| 2 * beyond(TAU) > beyond(ROUNDING)) {
            let place = if q.len() > dof { format!("row {index} of ") } else { String::new() };
            return Err(Fault::Joints.error(format_args!(
                "{place}{field}: joint {} is {:.2} rad, beyond {FARTHEST_OUTSIDE:.2} rad (did you \
                 pass degrees? otherwise give limits)",
                joint + 1,
                row[joint]
            )));
        }
    }
    Ok(())
}

/// Limits of the joints; infinite where none is given.
fn read_axis_limits(
    [velocity, acceleration, jerk]: [Option<&Bound<'_, PyAny>>; 3],
    dof: usize,
) -> PyResult<Vec<AxisLimits>> {
    let velocity = read_each(velocity, "max_velocity", dof, f64::INFINITY)?;
    let acceleration = read_each(acceleration, "max_acceleration", dof, f64::INFINITY)?;
    let jerk = read_each(jerk, "max_jerk", dof, f64::INFINITY)?;
    let all = velocity.into_iter().zip(acceleration).zip(jerk);
    let limits = |((velocity, acceleration), jerk)| AxisLimits { velocity, acceleration, jerk };
    Ok(all.map(limits).collect())
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
///     limits: Lower and upper limits of the joint angles [rad], shape (n, 2), `robot.limits` for
///         instance: the motion must stay inside, between waypoints too.
///
/// Returns:
///     The trajectory, which meets both ends. With a duration and limits it is checked against
///     them.
///
/// Raises:
///     InvalidMotionError: A limit or the duration is not positive, the duration is too short for
///         a limit, a joint moves and no limit binds it or leaves `limits`, or the profile cannot
///         have what is given for an end.
///     InvalidJointsError: A wrong shape, or angles in degrees without `limits`.
#[pyfunction]
#[pyo3(signature = (q0, q1, *, steps=50, duration=None, profile="quintic", start_velocity=None,
    end_velocity=None, start_acceleration=None, end_acceleration=None, max_velocity=None,
    max_acceleration=None, max_jerk=None, synchronization="time", limits=None))]
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
    limits: Option<&Bound<'_, PyAny>>,
) -> PyResult<PyTrajectory> {
    let profile = one_of("profile", profile, &PROFILES)?;
    let synchronization = one_of("synchronization", synchronization, &SYNCHRONIZATIONS)?;
    let read = |q, field| numbers(q, "(n,)", field, Fault::Joints);
    let (start, end) = (read(q0, "q0")?, read(q1, "q1")?);
    let (dof, found) = (start.len(), end.len());
    if found != dof {
        let message = format!("q1 must have shape ({dof},) as q0 has, got ({found},)");
        return Err(Fault::Joints.error(message));
    }
    let states = |q: &[f64], velocity, acceleration| {
        let states = q.iter().zip(velocity).zip(acceleration);
        let state = |((&position, velocity), acceleration): ((&f64, f64), f64)| AxisState {
            position,
            velocity,
            acceleration,
        };
        states.map(state).collect::<Vec<_>>()
    };
    let velocity = read_each(start_velocity, "start_velocity", dof, 0.0)?;
    let acceleration = read_each(start_acceleration, "start_acceleration", dof, 0.0)?;
    let from = states(&start, velocity, acceleration);
    let velocity = read_each(end_velocity, "end_velocity", dof, 0.0)?;
    let to = states(&end, velocity, read_each(end_acceleration, "end_acceleration", dof, 0.0)?);
    let given = max_velocity.or(max_acceleration).or(max_jerk).is_some();
    let angles = read_angle_limits(limits, dof)?;
    let limits = read_axis_limits([max_velocity, max_acceleration, max_jerk], dof)?;
    let motion = if given && duration.is_none() {
        let is_at_rest = |state: &AxisState| {
            [state.velocity, state.acceleration].into_iter().all(AxisState::is_rest)
        };
        if !from.iter().chain(&to).all(is_at_rest) {
            let message = "limits without a duration are for motions from rest to rest: give \
                           duration for velocities or accelerations at the ends, or use \
                           trajectory.state_to_state";
            return Err(Fault::Motion.error(message));
        }
        joint_within(profile, &start, &end, &limits, synchronization)
    } else {
        irbkin_motion::trajectory::joint(profile, &from, &to, duration.unwrap_or(1.0))
            .and_then(|motion| motion.within(&limits).map(|()| motion))
    };
    let motion = inside(motion.map_err(exception)?, angles.as_deref()).map_err(exception)?;
    check_turns("q0", &start, dof, angles.as_deref())?;
    check_turns("q1", &end, dof, angles.as_deref())?;
    PyTrajectory::even(motion, steps)
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
///     limits: Lower and upper limits of the joint angles [rad], shape (n, 2), `robot.limits` for
///         instance: the motion must stay inside, between waypoints too.
///
/// Returns:
///     The trajectory, which passes every waypoint.
///
/// Raises:
///     InvalidMotionError: Fewer than two waypoints, waypoints that repeat the one before without
///         `t`, times that do not increase, a limit that is exceeded or not positive, or a joint
///         that leaves `limits`: the message has the joint, the time, its angle and the limit.
///     InvalidJointsError: A wrong shape, or angles in degrees without `limits`.
#[pyfunction]
#[pyo3(signature = (q, *, t=None, steps=100, duration=None, profile="quintic", max_velocity=None,
    max_acceleration=None, max_jerk=None, limits=None))]
pub(super) fn spline(
    q: &Bound<'_, PyAny>,
    t: Option<&Bound<'_, PyAny>>,
    #[pyo3(from_py_with = read_steps)] steps: usize,
    duration: Option<f64>,
    profile: &str,
    max_velocity: Option<&Bound<'_, PyAny>>,
    max_acceleration: Option<&Bound<'_, PyAny>>,
    max_jerk: Option<&Bound<'_, PyAny>>,
    limits: Option<&Bound<'_, PyAny>>,
) -> PyResult<PyTrajectory> {
    let py = q.py();
    let kind = one_of("profile", profile, &SPLINES)?;
    let (points, dof) = read_rows(q, "q")?;
    let given = max_velocity.or(max_acceleration).or(max_jerk).is_some();
    let angles = read_angle_limits(limits, dof)?;
    let limits = read_axis_limits([max_velocity, max_acceleration, max_jerk], dof)?;
    if t.is_some() && duration.is_some() {
        return Err(PyValueError::new_err("give t or duration, not both"));
    }
    let times = t.map(|t| numbers(t, "(n,)", "t", Fault::Joints)).transpose()?;
    let duration = duration.or(if given { None } else { Some(1.0) });
    let motion = py.detach(|| {
        irbkin_motion::trajectory::through(kind, &points, dof, times.as_deref(), duration, &limits)
            .and_then(|motion| inside(motion, angles.as_deref()))
    });
    let motion = motion.map_err(exception)?;
    check_turns("q", &points, dof, angles.as_deref())?;
    PyTrajectory::even(motion, steps)
}
