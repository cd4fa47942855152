//! `irbkin.trajectory`: motions of joints over time.

use std::sync::Arc;

use numpy::{PyArray1, PyArray2, PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::intern;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use super::arrays::Rows;
use super::classes;
use super::errors::{Fault, to_py};
use crate::trajectory::{
    AxisLimits, AxisState, Profile, SplineKind, Synchronization, Trajectory, joint_within,
};

/// Joint angles, velocities and accelerations over time.
///
/// The arrays are samples of it; `sample` gives the motion at any time, exactly. Between its knots
/// each joint is a polynomial in time.
#[pyclass(name = "Trajectory", module = "irbkin.trajectory", frozen)]
pub(super) struct PyTrajectory {
    motion: Arc<Trajectory>,
    t: Py<PyArray1<f64>>,
    states: [Py<PyArray2<f64>>; 3],
}

impl PyTrajectory {
    fn new(py: Python<'_>, motion: Trajectory, times: Vec<f64>) -> PyResult<Self> {
        let shape = [times.len(), motion.dof()];
        let states = states(py, &motion, &times, &shape)?;
        let t = PyArray1::from_vec(py, times);
        read_only(t.as_any())?;
        let matrices = states.map(|array| -> PyResult<Py<PyArray2<f64>>> {
            read_only(array.as_any())?;
            Ok(array.reshape(shape)?.unbind())
        });
        let [q, dq, ddq] = matrices;
        Ok(Self { motion: Arc::new(motion), t: t.unbind(), states: [q?, dq?, ddq?] })
    }

    /// `steps` samples, evenly over the duration.
    fn even(py: Python<'_>, motion: Trajectory, steps: usize) -> PyResult<Self> {
        if steps < 2 {
            return Err(PyValueError::new_err(format!("steps must be 2 or more, got {steps}")));
        }
        let times = evenly(motion.duration(), steps);
        Self::new(py, motion, times)
    }

    fn times(&self, py: Python<'_>) -> PyResult<Vec<f64>> {
        Ok(self.t.bind(py).to_vec()?)
    }
}

/// So many times from 0 to the duration, both exact.
#[expect(clippy::cast_precision_loss, reason = "a count of samples")]
fn evenly(duration: f64, steps: usize) -> Vec<f64> {
    let last = steps - 1;
    (0..steps)
        .map(|step| if step == last { duration } else { duration * (step as f64 / last as f64) })
        .collect()
}

fn read_only(array: &Bound<'_, PyAny>) -> PyResult<()> {
    let py = array.py();
    array.getattr(intern!(py, "flags"))?.setattr(intern!(py, "writeable"), false)
}

/// Joint angles, velocities and accelerations at times, as arrays of a shape.
fn states<'py>(
    py: Python<'py>,
    motion: &Trajectory,
    times: &[f64],
    shape: &[usize],
) -> PyResult<[Bound<'py, PyArrayDyn<f64>>; 3]> {
    let [q, dq, ddq] = [(); 3].map(|()| PyArrayDyn::<f64>::zeros(py, shape, false));
    {
        let (mut q, mut dq, mut ddq) = (q.readwrite(), dq.readwrite(), ddq.readwrite());
        let (q, dq, ddq) = (q.as_slice_mut()?, dq.as_slice_mut()?, ddq.as_slice_mut()?);
        py.detach(|| motion.sample(times, q, dq, ddq)).map_err(|error| to_py(py, &error))?;
    }
    Ok([q, dq, ddq])
}

#[pymethods]
impl PyTrajectory {
    /// Times of the samples [s], shape (m,).
    #[getter]
    fn t<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.t.bind(py).clone()
    }

    /// Joint angles of the samples [rad], shape (m, n).
    #[getter]
    fn q<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        self.states[0].bind(py).clone()
    }

    /// Joint velocities of the samples [rad/s], shape (m, n).
    #[getter]
    fn dq<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        self.states[1].bind(py).clone()
    }

    /// Joint accelerations of the samples [rad/s^2], shape (m, n).
    #[getter]
    fn ddq<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        self.states[2].bind(py).clone()
    }

    /// Number of joints.
    #[getter]
    fn dof(&self) -> usize {
        self.motion.dof()
    }

    /// Duration [s].
    #[getter]
    fn duration(&self) -> f64 {
        self.motion.duration()
    }

    /// Times at which one polynomial ends and the next begins [s], both ends included, shape (k,).
    #[getter]
    fn knots<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, self.motion.knots())
    }

    /// Joint angles, velocities and accelerations at any time.
    ///
    /// Args:
    ///     t: Times [s], shape (...). Before the start and after the end the joints rest.
    ///
    /// Returns:
    ///     TrajectorySample(q, dq, ddq) [rad, rad/s, rad/s^2], arrays of shape (..., n).
    ///
    /// Raises:
    ///     InvalidMotionError: A time is NaN.
    fn sample<'py>(&self, py: Python<'py>, t: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let times = Rows::read(t, &[], "t", Fault::Motion)?;
        let shape = times.shape_with(&[self.motion.dof()]);
        let states = states(py, &self.motion, times.data()?, &shape)?;
        classes::trajectory_sample_class(py)?.call1(PyTuple::new(py, states)?)
    }

    /// The largest velocity, acceleration and jerk of each joint, exact between samples too.
    ///
    /// Returns:
    ///     MotionPeaks(velocity, acceleration, jerk) [rad/s, rad/s^2, rad/s^3], arrays of shape
    ///     (n,). A jump of the acceleration at a knot does not count as jerk.
    fn peaks<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let peaks = self.motion.peaks();
        let columns = [
            PyArray1::from_iter(py, peaks.iter().map(|peaks| peaks.velocity)),
            PyArray1::from_iter(py, peaks.iter().map(|peaks| peaks.acceleration)),
            PyArray1::from_iter(py, peaks.iter().map(|peaks| peaks.jerk)),
        ];
        classes::motion_peaks_class(py)?.call1(PyTuple::new(py, columns)?)
    }

    /// The same motion with other samples.
    ///
    /// Args:
    ///     steps: Number of samples, evenly over the duration.
    fn resampled(&self, py: Python<'_>, steps: usize) -> PyResult<Self> {
        Self::even(py, (*self.motion).clone(), steps)
    }

    /// The same way at another pace.
    ///
    /// Args:
    ///     factor: What every time is multiplied by; 2 is half the speed.
    ///
    /// Raises:
    ///     InvalidMotionError: The factor is not positive and finite.
    fn stretched(&self, py: Python<'_>, factor: f64) -> PyResult<Self> {
        let motion = (*self.motion).clone().stretched(factor).map_err(|error| to_py(py, &error))?;
        let times = self.times(py)?.into_iter().map(|time| time * factor).collect();
        Self::new(py, motion, times)
    }

    /// The part between two times, which begins at t = 0.
    ///
    /// Args:
    ///     start: Its start [s].
    ///     end: Its end [s].
    ///
    /// Returns:
    ///     The part, with the samples that lie in it and both ends.
    ///
    /// Raises:
    ///     InvalidMotionError: Unless 0 <= start < end <= duration.
    fn slice(&self, py: Python<'_>, start: f64, end: f64) -> PyResult<Self> {
        let motion = self.motion.slice(start, end).map_err(|error| to_py(py, &error))?;
        let inner = self.times(py)?.into_iter().filter(|time| start < *time && *time < end);
        let times = [0.0].into_iter().chain(inner.map(|time| time - start));
        let times = times.chain([motion.duration()]).collect();
        Self::new(py, motion, times)
    }

    /// This motion, then another one that begins where it ends.
    fn __add__(&self, py: Python<'_>, next: &Bound<'_, Self>) -> PyResult<Self> {
        let next = next.get();
        let motion = (*self.motion).clone();
        let motion = motion.then(&next.motion).map_err(|error| to_py(py, &error))?;
        let offset = self.motion.duration();
        let mut times = self.times(py)?;
        times.extend(next.times(py)?.into_iter().skip(1).map(|time| offset + time));
        Self::new(py, motion, times)
    }

    fn __len__(&self, py: Python<'_>) -> usize {
        self.t.bind(py).len()
    }

    fn __eq__(&self, py: Python<'_>, other: &Bound<'_, PyAny>) -> PyResult<bool> {
        let Ok(other) = other.cast::<Self>() else { return Ok(false) };
        let other = other.get();
        Ok(self.motion == other.motion && self.times(py)? == other.times(py)?)
    }

    fn __hash__(&self) -> u64 {
        self.motion.duration().to_bits() ^ self.motion.knots().len() as u64
    }

    fn __repr__(&self, py: Python<'_>) -> String {
        format!(
            "Trajectory({} samples of {} joints, {:.6} s)",
            self.t.bind(py).len(),
            self.motion.dof(),
            self.motion.duration()
        )
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, TrajectoryState)> {
        let restore = py.import("irbkin._core")?.getattr("_restore_trajectory")?;
        let (dof, knots, terms) = self.motion.to_parts();
        Ok((restore, (dof, knots.to_vec(), terms.as_flattened().to_vec(), self.times(py)?)))
    }
}

type TrajectoryState = (usize, Vec<f64>, Vec<f64>, Vec<f64>);

/// A pickled trajectory.
#[pyfunction(name = "_restore_trajectory")]
pub(super) fn restore_trajectory(
    py: Python<'_>,
    dof: usize,
    knots: Vec<f64>,
    terms: &Bound<'_, PyAny>,
    times: Vec<f64>,
) -> PyResult<PyTrajectory> {
    let motion = Trajectory::from_parts(dof, knots, &terms.extract::<Vec<f64>>()?)
        .map_err(|error| to_py(py, &error))?;
    PyTrajectory::new(py, motion, times)
}

/// Numbers of one dimension.
fn read_vector(value: &Bound<'_, PyAny>, field: &'static str) -> PyResult<Vec<f64>> {
    let rows = Rows::read(value, &[], field, Fault::Joints)?;
    if rows.lead.len() != 1 {
        let shape = &rows.lead;
        let message = format!("{field} must have shape (n,), got {shape:?}");
        return Err(Fault::Joints.error(value.py(), message));
    }
    Ok(rows.data()?.to_vec())
}

/// Joint vectors, shape (m, n): the numbers, and n.
fn read_rows(value: &Bound<'_, PyAny>, field: &'static str) -> PyResult<(Vec<f64>, usize)> {
    let rows = Rows::read(value, &[], field, Fault::Joints)?;
    match rows.lead[..] {
        [_, dof] if dof > 0 => Ok((rows.data()?.to_vec(), dof)),
        _ => {
            let message = format!("{field} must have shape (m, n), got {:?}", rows.lead);
            Err(Fault::Joints.error(value.py(), message))
        }
    }
}

/// A number for each joint, or one for all; `default` where none is given.
fn read_each(
    value: Option<&Bound<'_, PyAny>>,
    field: &'static str,
    dof: usize,
    default: f64,
) -> PyResult<Vec<f64>> {
    let Some(value) = value else { return Ok(vec![default; dof]) };
    let rows = Rows::read(value, &[], field, Fault::Motion)?;
    match (&rows.lead[..], rows.data()?) {
        ([], [one]) => Ok(vec![*one; dof]),
        ([found], numbers) if *found == dof => Ok(numbers.to_vec()),
        (shape, _) => {
            let message = format!("{field} must be a number or have shape [{dof}], got {shape:?}");
            Err(Fault::Motion.error(value.py(), message))
        }
    }
}

fn read_profile(profile: &str) -> PyResult<Profile> {
    match profile {
        "quintic" => Ok(Profile::Quintic),
        "cubic" => Ok(Profile::Cubic),
        "trapezoid" => Ok(Profile::Trapezoid),
        "s_curve" => Ok(Profile::SCurve),
        _ => Err(PyValueError::new_err(format!(
            "profile must be \"quintic\", \"cubic\", \"trapezoid\" or \"s_curve\", got \"{profile}\""
        ))),
    }
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
    steps: usize,
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
    let synchronization = match synchronization {
        "time" => Synchronization::Time,
        "phase" => Synchronization::Phase,
        _ => {
            return Err(PyValueError::new_err(format!(
                "synchronization must be \"time\" or \"phase\", got \"{synchronization}\""
            )));
        }
    };
    let (start, end) = (read_vector(q0, "q0")?, read_vector(q1, "q1")?);
    let dof = start.len();
    if end.len() != dof {
        let message = format!("q1 must have shape [{dof}] as q0 has, got [{}]", end.len());
        return Err(Fault::Joints.error(py, message));
    }
    let ends = [
        read_each(start_velocity, "start_velocity", dof, 0.0)?,
        read_each(start_acceleration, "start_acceleration", dof, 0.0)?,
        read_each(end_velocity, "end_velocity", dof, 0.0)?,
        read_each(end_acceleration, "end_acceleration", dof, 0.0)?,
    ];
    let given = max_velocity.or(max_acceleration).or(max_jerk).is_some();
    let none = f64::INFINITY;
    let velocity = read_each(max_velocity, "max_velocity", dof, none)?;
    let acceleration = read_each(max_acceleration, "max_acceleration", dof, none)?;
    let jerk = read_each(max_jerk, "max_jerk", dof, none)?;
    let limits: Vec<AxisLimits> = (0..dof)
        .map(|joint| AxisLimits {
            velocity: velocity[joint],
            acceleration: acceleration[joint],
            jerk: jerk[joint],
        })
        .collect();
    let motion = if given && duration.is_none() {
        if ends.iter().flatten().any(|number| *number != 0.0) {
            let message = "limits without a duration are for motions from rest to rest: give \
                           duration for velocities or accelerations at the ends";
            return Err(Fault::Motion.error(py, message.to_owned()));
        }
        joint_within(profile, &start, &end, &limits, synchronization)
    } else {
        let [v0, a0, v1, a1] = &ends;
        let state = |q: &[f64], v: &[f64], a: &[f64], joint: usize| AxisState {
            position: q[joint],
            velocity: v[joint],
            acceleration: a[joint],
        };
        let from: Vec<_> = (0..dof).map(|joint| state(&start, v0, a0, joint)).collect();
        let to: Vec<_> = (0..dof).map(|joint| state(&end, v1, a1, joint)).collect();
        crate::trajectory::joint(profile, &from, &to, duration.unwrap_or(1.0))
            .and_then(|motion| motion.within(&limits).map(|()| motion))
    };
    PyTrajectory::even(py, motion.map_err(|error| to_py(py, &error))?, steps)
}

/// Move through many joint vectors on a smooth curve, at rest at both ends.
///
/// Args:
///     q: Waypoints [rad], shape (m, n).
///     t: Times of the waypoints [s], shape (m,), increasing. Without them they are spaced by the
///         distances of the waypoints.
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
    steps: usize,
    duration: Option<f64>,
    profile: &str,
    max_velocity: Option<&Bound<'_, PyAny>>,
    max_acceleration: Option<&Bound<'_, PyAny>>,
    max_jerk: Option<&Bound<'_, PyAny>>,
) -> PyResult<PyTrajectory> {
    let py = q.py();
    let kind = match profile {
        "quintic" => SplineKind::Quintic,
        "cubic" => SplineKind::Cubic,
        _ => {
            return Err(PyValueError::new_err(format!(
                "profile must be \"quintic\" or \"cubic\", got \"{profile}\""
            )));
        }
    };
    let (points, dof) = read_rows(q, "q")?;
    let given = max_velocity.or(max_acceleration).or(max_jerk).is_some();
    let none = f64::INFINITY;
    let velocity = read_each(max_velocity, "max_velocity", dof, none)?;
    let acceleration = read_each(max_acceleration, "max_acceleration", dof, none)?;
    let jerk = read_each(max_jerk, "max_jerk", dof, none)?;
    let limits: Vec<AxisLimits> = (0..dof)
        .map(|joint| AxisLimits {
            velocity: velocity[joint],
            acceleration: acceleration[joint],
            jerk: jerk[joint],
        })
        .collect();
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

/// Move along a path in the shortest time within limits, from rest to rest.
///
/// The path is a cubic spline through the samples. No joint exceeds a limit anywhere, between the
/// samples too. Catalogs have no accelerations: they are the caller's.
///
/// Args:
///     q: Samples of the path [rad], shape (m, n), of `robot.follow` for instance.
///     max_velocity: Limits [rad/s], a number or shape (n,); `robot.max_velocity` has a robot's.
///     max_acceleration: Limits [rad/s^2], a number or shape (n,).
///     steps: Number of samples of the answer; as many as `q` has where it is not given.
///
/// Returns:
///     The trajectory.
///
/// Raises:
///     InvalidMotionError: A limit is not positive, or no limit binds the path.
///     InvalidJointsError: A wrong shape, or an angle that is not finite.
#[pyfunction]
#[pyo3(signature = (q, max_velocity, max_acceleration, *, steps=None))]
pub(super) fn retime(
    q: &Bound<'_, PyAny>,
    max_velocity: &Bound<'_, PyAny>,
    max_acceleration: &Bound<'_, PyAny>,
    steps: Option<usize>,
) -> PyResult<PyTrajectory> {
    let py = q.py();
    let (points, dof) = read_rows(q, "q")?;
    let none = f64::INFINITY;
    let velocity = read_each(Some(max_velocity), "max_velocity", dof, none)?;
    let acceleration = read_each(Some(max_acceleration), "max_acceleration", dof, none)?;
    let motion = py.detach(|| crate::trajectory::retime(&points, &velocity, &acceleration));
    let steps = steps.unwrap_or((points.len() / dof).max(2));
    PyTrajectory::even(py, motion.map_err(|error| to_py(py, &error))?, steps)
}
