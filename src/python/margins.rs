//! Methods of `irbkin.Robot` that measure room: to limits, and to singularities.

use numpy::{PyArrayDyn, PyArrayMethods};
use pyo3::prelude::*;

use super::arguments::thread_count;
use super::arm::on;
use super::classes;
use super::redundancy::read_poses_with_q7;
use super::robot::PyRobot;
use super::signals::detached;
use crate::batch::Margins;

#[pymethods]
#[expect(non_snake_case, reason = "T is the name that users pass")]
impl PyRobot {
    /// How far joint vectors are from limits and singularities, as parts of the farthest that they
    /// can be.
    ///
    /// Args:
    ///     q: Joint angles [rad], shape (..., n).
    ///     threads: Number of threads; 0 for one a core.
    ///
    /// Returns:
    ///     Margin: two arrays of shape (...), 1 in the middle, 0 at a limit or a singularity,
    ///     negative outside limits. Of many rows, one with a NaN or inf gives NaN.
    ///
    /// Raises:
    ///     InvalidJointsError: A wrong shape, or a single row with a NaN or inf.
    #[pyo3(signature = (q, *, threads=1))]
    fn margin<'py>(&self, q: &Bound<'py, PyAny>, threads: isize) -> PyResult<Bound<'py, PyAny>> {
        let (py, threads) = (q.py(), thread_count(threads)?);
        let rows = self.arm().joints(q)?;
        let data = rows.data()?;
        let limits = PyArrayDyn::zeros(py, rows.lead.clone(), false);
        let singularities = PyArrayDyn::zeros(py, rows.lead.clone(), false);
        let (mut to_limits, mut to_singularities) = (limits.readwrite(), singularities.readwrite());
        let (limits_out, singularities_out) =
            (to_limits.as_slice_mut()?, to_singularities.as_slice_mut()?);
        detached(
            py,
            threads,
            |pace| on!(self.arm(), robot => pace.margin(robot, data, limits_out, singularities_out)),
        )?;
        classes::margin_class(py)?.call1((limits, singularities))
    }

    /// How much room the solutions of poses leave to limits and singularities: `ik_batch` and
    /// `margin` in one call, which keeps the best of each pose.
    ///
    /// Args:
    ///     T: Poses of the tool, shape (..., 4, 4), translation [m].
    ///     q7: Angle of joint 7 [rad], shape (...), of an arm of seven joints.
    ///     threads: Number of threads; 0 for one a core.
    ///
    /// Returns:
    ///     IkMargin: the largest margin of the solutions inside the limits, their largest distance
    ///     from singularities, and their number, arrays of shape (...).
    ///
    /// Raises:
    ///     InvalidPoseError: A wrong shape. A matrix that is no pose has no solution.
    ///     InvalidModelError: The first six joints do not move the tool in six independent ways.
    ///     TypeError: `q7` of an arm of six joints, or none of one of seven.
    #[pyo3(signature = (T, q7=None, *, threads=1))]
    fn ik_margin<'py>(
        &self,
        T: &Bound<'py, PyAny>,
        q7: Option<&Bound<'py, PyAny>>,
        threads: isize,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (py, arm, threads) = (T.py(), self.arm(), thread_count(threads)?);
        let (poses, angles) = read_poses_with_q7(arm, T, ("q7", q7))?;
        let data = poses.data()?;
        let margin = PyArrayDyn::<f64>::zeros(py, poses.lead.clone(), false);
        let singularities = PyArrayDyn::<f64>::zeros(py, poses.lead.clone(), false);
        let count = PyArrayDyn::<u8>::zeros(py, poses.lead.clone(), false);
        let (mut to_margin, mut to_singularities, mut to_count) =
            (margin.readwrite(), singularities.readwrite(), count.readwrite());
        let answers = Margins {
            margin: to_margin.as_slice_mut()?,
            singularities: to_singularities.as_slice_mut()?,
            solutions: to_count.as_slice_mut()?,
        };
        detached(
            py,
            threads,
            |pace| on!(arm, robot => pace.ik_margin(robot, data, &angles, answers)),
        )?;
        classes::ik_margin_class(py)?.call1((margin, singularities, count))
    }
}
