//! Methods of `irbkin.Robot` that take joint vectors.

use numpy::PyArrayDyn;
use pyo3::prelude::*;

use super::answers::singularity_record;
use super::arguments::read_frame;
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
    ///
    /// Returns:
    ///     Homogeneous matrices, shape (..., n + 1, 4, 4), translation [m].
    ///
    /// Raises:
    ///     InvalidJointsError: A wrong shape, or a single joint vector that is not finite.
    fn link_frames<'py>(&self, q: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        self.arm().link_frames(q)
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
    ///
    /// Returns:
    ///     Singularity; numbers for (n,), arrays of shape (...) for (..., n). NaN where an arm has
    ///     no such singularity.
    ///
    /// Raises:
    ///     InvalidJointsError: A wrong shape, or a single joint vector that is not finite.
    fn singularity<'py>(&self, q: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let rows = self.arm().joints(q)?;
        let records = self.arm().singularity(q.py(), rows.data()?)?;
        singularity_record(q.py(), &records, (!rows.is_single()).then_some(&rows.lead))
    }

    /// ABB's confdata of joint vectors: quarter turns of axes 1, 4 and 6, and the slot.
    ///
    /// Args:
    ///     q: Joint angles [rad], shape (..., 6).
    ///
    /// Returns:
    ///     Configuration(cf1, cf4, cf6, cfx): integers for one joint vector, int32 arrays of shape
    ///     (...) for many. cf is floor(angle / 90 deg). cfx is the slot, 0 for an arm with coupled
    ///     axes 2 and 3, whose controller does not use it.
    ///
    /// Raises:
    ///     InvalidJointsError: A wrong shape, or an angle that is not finite.
    ///     InvalidModelError: The arm has no spherical wrist: its controller counts otherwise.
    fn configuration<'py>(&self, q: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        configurations::configuration(self.arm(), q)
    }
}
