//! `irbkin.trajectory.Trajectory`.

use std::sync::Arc;

use numpy::{PyArray1, PyArrayDyn, PyArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyFloat;

use super::arguments::{read_angle_limits, read_steps};
use super::arrays::Rows;
use super::errors::{Fault, exception};
use super::outputs::{array, column, read_only};
use super::records::{MotionPeaks, TrajectorySample};
use super::state::{Reduced, reduced};
use irbkin_motion::trajectory::{AxisLimits, AxisState, Trajectory};

/// Joint angles, velocities and accelerations over time.
///
/// The arrays are samples of it; `sample` gives the motion at any time, exactly. Between its knots
/// each joint is a polynomial in time.
#[pyclass(name = "Trajectory", module = "irbkin.trajectory", frozen)]
pub(super) struct PyTrajectory {
    pub(super) motion: Arc<Trajectory>,
    /// Names of the joints, of a robot with a file.
    #[pyo3(get, name = "_joint_names")]
    names: Option<Vec<String>>,
    /// Times of the samples [s].
    times: Vec<f64>,
    /// Arrays of the samples, made when one of them is read first.
    samples: PyOnceLock<[Py<PyArrayDyn<f64>>; 4]>,
}

impl PyTrajectory {
    pub(super) fn new(motion: Trajectory, times: Vec<f64>) -> Self {
        Self { motion: Arc::new(motion), names: None, times, samples: PyOnceLock::new() }
    }

    pub(super) fn with_names(self, names: Option<Vec<String>>) -> Self {
        Self { names, ..self }
    }

    /// `steps` samples, evenly over the duration.
    pub(super) fn even(motion: Trajectory, steps: usize) -> PyResult<Self> {
        let times = motion.times(steps).map_err(exception)?;
        Ok(Self::new(motion, times))
    }

    /// Times, angles, velocities and accelerations of the samples.
    fn samples(&self, py: Python<'_>) -> PyResult<&[Py<PyArrayDyn<f64>>; 4]> {
        self.samples.get_or_try_init(py, || {
            let times = &self.times;
            let t = PyArray1::from_slice(py, times).to_dyn().clone();
            let [q, dq, ddq] = states(py, &self.motion, times, &[times.len(), self.motion.dof()])?;
            Ok([t, q, dq, ddq].map(read_only))
        })
    }
}

/// Joint angles, velocities and accelerations at times, as arrays of a shape.
fn states<'py>(
    py: Python<'py>,
    motion: &Trajectory,
    times: &[f64],
    shape: &[usize],
) -> PyResult<[Bound<'py, PyArrayDyn<f64>>; 3]> {
    let arrays = [(); 3].map(|()| PyArrayDyn::<f64>::zeros(py, shape, false));
    let [mut q, mut dq, mut ddq] = arrays.each_ref().map(PyArrayMethods::readwrite);
    let (q, dq, ddq) = (q.as_slice_mut()?, dq.as_slice_mut()?, ddq.as_slice_mut()?);
    py.detach(|| motion.sample(times, q, dq, ddq)).map_err(exception)?;
    Ok(arrays)
}

#[pymethods]
impl PyTrajectory {
    /// Times of the samples [s], shape (m,).
    #[getter]
    fn t(&self, py: Python<'_>) -> PyResult<&Py<PyArrayDyn<f64>>> {
        Ok(&self.samples(py)?[0])
    }

    /// Joint angles of the samples [rad], shape (m, n).
    #[getter]
    fn q(&self, py: Python<'_>) -> PyResult<&Py<PyArrayDyn<f64>>> {
        Ok(&self.samples(py)?[1])
    }

    /// Joint velocities of the samples [rad/s], shape (m, n).
    #[getter]
    fn dq(&self, py: Python<'_>) -> PyResult<&Py<PyArrayDyn<f64>>> {
        Ok(&self.samples(py)?[2])
    }

    /// Joint accelerations of the samples [rad/s^2], shape (m, n).
    #[getter]
    fn ddq(&self, py: Python<'_>) -> PyResult<&Py<PyArrayDyn<f64>>> {
        Ok(&self.samples(py)?[3])
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
    fn sample(&self, py: Python<'_>, t: &Bound<'_, PyAny>) -> PyResult<TrajectorySample> {
        let times = Rows::read(t, &[], "t", Fault::Motion)?;
        let shape = times.shape_with(&[self.motion.dof()]);
        let states = states(py, &self.motion, times.data()?, &shape)?;
        let [q, dq, ddq] = states.map(|array| array.into_any().unbind());
        Ok(TrajectorySample { q, dq, ddq })
    }

    /// The largest velocity, acceleration and jerk of each joint, exact between samples too.
    ///
    /// Returns:
    ///     MotionPeaks(velocity, acceleration, jerk) [rad/s, rad/s^2, rad/s^3], arrays of shape
    ///     (n,). A jump of the acceleration at a knot does not count as jerk.
    fn peaks(&self, py: Python<'_>) -> MotionPeaks {
        let peaks = self.motion.peaks();
        MotionPeaks {
            velocity: column(py, peaks.iter().map(|peaks| peaks.velocity)),
            acceleration: column(py, peaks.iter().map(|peaks| peaks.acceleration)),
            jerk: column(py, peaks.iter().map(|peaks| peaks.jerk)),
        }
    }

    /// Return the least and the greatest angle of each joint, exact between samples too.
    ///
    /// Returns:
    ///     Angles [rad], shape (n, 2), as `robot.limits` has them.
    fn range(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        let range = self.motion.range();
        array(py, range.as_flattened().iter().copied(), &[range.len(), 2])
    }

    /// Refuse the motion if a joint leaves limits by more than 1e-9 rad, between samples too.
    ///
    /// Args:
    ///     limits: Lower and upper limits of the joint angles [rad], shape (n, 2).
    ///
    /// Raises:
    ///     InvalidMotionError: The joint that leaves them farthest, with the time, its angle and
    ///         the limit; or a wrong shape.
    fn check_limits(&self, limits: &Bound<'_, PyAny>) -> PyResult<()> {
        let limits = read_angle_limits(Some(limits), self.motion.dof())?.unwrap_or_default();
        self.motion.inside(&limits).map_err(exception)
    }

    /// Joint angles at any time: `sample(t).q`.
    ///
    /// Args:
    ///     t: Times [s], shape (...). Before the start and after the end the joints rest.
    ///
    /// Returns:
    ///     Joint angles [rad], shape (..., n).
    ///
    /// Raises:
    ///     InvalidMotionError: A time is NaN.
    fn __call__(&self, py: Python<'_>, t: &Bound<'_, PyAny>) -> PyResult<Py<PyAny>> {
        Ok(self.sample(py, t)?.q)
    }

    /// Return the motion with other samples, evenly over the duration, both ends included.
    ///
    /// Args:
    ///     steps: Number of samples.
    ///     dt: Instead of `steps`, the largest time between two samples [s]: they are `dt` apart
    ///         or, unless that divides the duration, a little less.
    ///
    /// Raises:
    ///     InvalidMotionError: Fewer than two or more than ten million samples, or `dt` is not
    ///         positive.
    ///     TypeError: Not one of both is given, or steps is not a whole number.
    #[pyo3(signature = (steps=None, *, dt=None))]
    fn resampled(&self, steps: Option<&Bound<'_, PyAny>>, dt: Option<f64>) -> PyResult<Self> {
        let motion = (*self.motion).clone();
        let steps = match (steps, dt) {
            (Some(steps), None) => whole_steps(steps)?,
            (None, Some(dt)) => motion.steps_of(dt).map_err(exception)?,
            _ => return Err(PyTypeError::new_err("resampled takes steps, or dt [s]")),
        };
        Ok(Self::even(motion, steps)?.with_names(self.names.clone()))
    }

    /// Return the motion at another pace.
    ///
    /// Args:
    ///     factor: What every time is multiplied by; 2 is half the speed.
    ///
    /// Raises:
    ///     InvalidMotionError: The factor is not positive and finite.
    fn stretched(&self, factor: f64) -> PyResult<Self> {
        let motion = (*self.motion).clone().stretched(factor).map_err(exception)?;
        let times = self.times.iter().map(|time| time * factor).collect();
        Ok(Self::new(motion, times).with_names(self.names.clone()))
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
    fn slice(&self, start: f64, end: f64) -> PyResult<Self> {
        let motion = self.motion.slice(start, end).map_err(exception)?;
        let inner = self.times.iter().filter(|time| (start < **time) & (**time < end));
        let times = [0.0].into_iter().chain(inner.map(|time| time - start));
        let times = times.chain([motion.duration()]).collect();
        Ok(Self::new(motion, times).with_names(self.names.clone()))
    }

    /// This motion, then another one that begins where it ends.
    fn __add__(&self, next: &Bound<'_, Self>) -> PyResult<Self> {
        let next = next.get();
        let motion = (*self.motion).clone().then(&next.motion).map_err(exception)?;
        let offset = self.motion.duration();
        let mut times = self.times.clone();
        times.extend(next.times.iter().skip(1).map(|time| offset + time));
        Ok(Self::new(motion, times).with_names(self.names.clone()))
    }

    fn __len__(&self) -> usize {
        self.times.len()
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        let other = other.cast::<Self>().map(Bound::get);
        other.is_ok_and(|other| self.motion == other.motion && self.times == other.times)
    }

    fn __hash__(&self) -> u64 {
        self.motion.duration().to_bits() ^ self.motion.knots().len() as u64
    }

    fn __repr__(&self) -> String {
        format!(
            "Trajectory({} samples of {} joints, {:.6} s)",
            self.times.len(),
            self.motion.dof(),
            self.motion.duration()
        )
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced(py, "Trajectory", &(&*self.motion, &self.times, &self.names))
    }
}

/// A number of samples; a time between them goes by another name.
fn whole_steps(steps: &Bound<'_, PyAny>) -> PyResult<usize> {
    if steps.is_instance_of::<PyFloat>() {
        return Err(PyTypeError::new_err(format!(
            "steps must be a whole number, got {steps}: pass dt={steps} for a time between samples [s]"
        )));
    }
    read_steps(steps)
}

/// A motion between two states of joints, by way of rest; their limits of velocity, acceleration
/// and jerk.
#[pyfunction(name = "_between")]
pub(super) fn between(
    start: Vec<[f64; 3]>,
    end: Vec<[f64; 3]>,
    limits: Vec<[f64; 3]>,
) -> PyResult<PyTrajectory> {
    let [start, end] = [start, end].map(|rows| {
        let state = |[position, velocity, acceleration]: [f64; 3]| AxisState {
            position,
            velocity,
            acceleration,
        };
        rows.into_iter().map(state).collect::<Vec<_>>()
    });
    let limit =
        |[velocity, acceleration, jerk]: [f64; 3]| AxisLimits { velocity, acceleration, jerk };
    let limits: Vec<_> = limits.into_iter().map(limit).collect();
    let motion = irbkin_motion::trajectory::state::between(&start, &end, &limits);
    PyTrajectory::even(motion.map_err(exception)?, 2)
}
