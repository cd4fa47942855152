//! Methods of `irbkin.Robot` that take joint vectors.

use numpy::PyArrayDyn;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;

use super::answers::{singularity_arrays, singularity_record};
use super::arguments::{read_frame, thread_count};
use super::arm::on;
use super::configurations;
use super::robot::PyRobot;

#[pymethods]
impl PyRobot {
    /// Forward kinematics: the pose of the tool.
    ///
    /// Args:
    ///     q: Joint angles [rad], shape (..., n).
    ///     out: Array to write to, shape (..., 4, 4), float64, C-contiguous; it is returned.
    ///
    /// Returns:
    ///     Homogeneous matrices, shape (..., 4, 4), translation [m]. In a batch, a row with a NaN
    ///     or inf gives NaN.
    ///
    /// Raises:
    ///     InvalidJointsError: A wrong shape, or a single joint vector that is not finite.
    #[pyo3(signature = (q, out=None))]
    fn fk<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.arm().fk(q, out)
    }

    /// Every frame of the modified Denavit-Hartenberg table after its joint, then the tool.
    ///
    /// Args:
    ///     q: Joint angles [rad], shape (..., n).
    ///     out: Array to write to, shape (..., n + 1, 4, 4), float64, C-contiguous; it is returned.
    ///
    /// Returns:
    ///     Homogeneous matrices, shape (..., n + 1, 4, 4), translation [m]. In a batch, a row with
    ///     a NaN or inf gives NaN.
    ///
    /// Raises:
    ///     InvalidJointsError: A wrong shape, or a single joint vector that is not finite.
    #[pyo3(signature = (q, out=None))]
    fn link_frames<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        self.arm().link_frames(q, out)
    }

    /// Geometric Jacobian of the tool.
    ///
    /// Args:
    ///     q: Joint angles [rad], shape (..., n).
    ///     frame: "base", the frame in which poses are given, or "tool".
    ///     out: Array to write to, shape (..., 6, n), float64, C-contiguous; it is returned.
    ///
    /// Returns:
    ///     Shape (..., 6, n): three linear rows [m/rad], then three angular [1].
    ///
    /// Raises:
    ///     InvalidJointsError: A wrong shape, or a single joint vector that is not finite.
    ///     ValueError: Another frame.
    #[pyo3(signature = (q, frame="base", out=None))]
    fn jacobian<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        frame: &str,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let frame = read_frame(frame)?;
        self.arm().jacobian(q, frame, out)
    }

    /// How far joint vectors are from the singularities.
    ///
    /// Args:
    ///     q: Joint angles [rad], shape (..., n).
    ///     out: Where to write the answer of a batch: a Singularity, or a tuple, of arrays (...),
    ///         five of float64 and one of uint8.
    ///     threads: Number of threads; 0 for one a core.
    ///
    /// Returns:
    ///     Singularity; numbers for (n,), arrays of shape (...) for (..., n). NaN where an arm has
    ///     no such singularity. In a batch, a row with a NaN or inf gives NaN, and its `kinds` are
    ///     `irbkin.Status.INVALID`, 64.
    ///
    /// Raises:
    ///     InvalidJointsError: A wrong shape, or a single joint vector that is not finite.
    ///     TypeError: `out` for a single joint vector, or of another kind.
    #[pyo3(signature = (q, *, out=None, threads=1))]
    fn singularity<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
        threads: isize,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (py, threads) = (q.py(), thread_count(threads)?);
        let rows = self.arm().joints(q)?;
        if !rows.is_single() {
            return singularity_arrays(py, self.arm(), &rows, out, threads);
        }
        if out.is_some() {
            return Err(PyTypeError::new_err("out is for many joint vectors, shape (..., n)"));
        }
        on!(self.arm(), robot => match rows.data()?.first_chunk() {
            Some(q) => singularity_record(py, &robot.singularity(q)),
            None => Err(PyTypeError::new_err("q is empty")),
        })
    }

    /// ABB's confdata of joint vectors: quarter turns of axes 1, 4 and 6, and the branch.
    ///
    /// Args:
    ///     q: Joint angles [rad], shape (..., n).
    ///
    /// Returns:
    ///     Configuration(cf1, cf4, cf6, cfx): integers for one joint vector, int32 arrays of shape
    ///     (...) for many. cf is floor(angle / 90 deg), of a YuMi the nearest whole number. cfx is
    ///     the slot of a spherical wrist, 0 for an arm with coupled axes 2 and 3, whose controller
    ///     does not use it; docs/abb.md has the rules of GoFa and YuMi. In a batch, a row that is
    ///     not finite, or has an angle beyond 1e5 rad, has -2147483648, the least int32, in all
    ///     four: `ik_configured` gives NaN for it.
    ///
    /// Raises:
    ///     InvalidJointsError: A wrong shape, or a single joint vector that is not finite.
    ///     InvalidModelError: The arm has no spherical wrist and is no GoFa or YuMi of the catalog:
    ///         its controller counts otherwise.
    fn configuration<'py>(&self, q: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        configurations::configuration(self.arm(), q)
    }

    /// The arm angle of a YuMi's joint vectors: eax_a of a robtarget.
    ///
    /// Args:
    ///     q: Joint angles [rad], shape (..., 7), in the order of the axes from the base: 1, 2, 7,
    ///         3, 4, 5, 6.
    ///
    /// Returns:
    ///     Arm angles [rad]: a number for one joint vector, shape (...) for many; NaN where axis 3
    ///     points from the shoulder to the wrist, and for a row of a batch that is not finite.
    ///
    /// Raises:
    ///     InvalidJointsError: A wrong shape, or a single joint vector that is not finite.
    ///     InvalidModelError: The arm is no YuMi of the catalog.
    fn arm_angle<'py>(&self, q: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        configurations::arm_angle(self.arm(), q)
    }
}
