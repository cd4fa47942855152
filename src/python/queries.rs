//! Methods of `irbkin.Robot` that take joint vectors.

use std::num::NonZeroUsize;

use numpy::PyArrayDyn;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyFloat, PyTuple};

use super::arguments::{read_frame, thread_count};
use super::arm::{Arm, on};
use super::arrays::{Rows, addresses};
use super::configured;
use super::outputs::{checked_out, output, writable};
use super::records::{self, Margin, Singularity};
use super::robot::PyRobot;
use super::signals::detached;
use crate::kinematics::{self, Status};

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
    ) -> PyResult<Singularity> {
        let threads = thread_count(threads)?;
        let rows = self.arm().joints(q)?;
        if !rows.is_single() {
            return singularities(self.arm(), &rows, out, threads);
        }
        if out.is_some() {
            return Err(PyTypeError::new_err("out is for many joint vectors, shape (..., n)"));
        }
        on!(self.arm(), robot => match rows.data()?.first_chunk() {
            Some(q) => one_singularity(rows.py(), &robot.singularity(q)),
            None => Err(PyTypeError::new_err("q is empty")),
        })
    }

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
    fn margin(&self, q: &Bound<'_, PyAny>, threads: isize) -> PyResult<Margin> {
        let (py, threads) = (q.py(), thread_count(threads)?);
        let rows = self.arm().joints(q)?;
        let data = rows.data()?;
        let [limits, singularities] =
            [(); 2].map(|()| PyArrayDyn::<f64>::zeros(py, rows.lead.clone(), false));
        let (mut to_limits, mut to_singularities) =
            (writable(&limits, &[])?, writable(&singularities, &[])?);
        let (limits_out, singularities_out) =
            (to_limits.as_slice_mut()?, to_singularities.as_slice_mut()?);
        detached(
            py,
            threads,
            |batch| on!(self.arm(), robot => batch.margin(robot, data, limits_out, singularities_out)),
        )?;
        Ok(Margin {
            limits: limits.into_any().unbind(),
            singularities: singularities.into_any().unbind(),
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
    ///     does not use it; docs/guide/abb.md has the rules of GoFa and YuMi. In a batch, a row
    ///     that is not finite, or has an angle beyond 1e5 rad, has -2147483648, the least int32, in
    ///     all four: `ik_configured` gives NaN for it.
    ///
    /// Raises:
    ///     InvalidJointsError: A wrong shape, or a single joint vector that is not finite.
    ///     InvalidModelError: The arm has no spherical wrist and is not a GoFa or YuMi of the
    ///         catalog: its controller counts otherwise.
    fn configuration<'py>(&self, q: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        configured::configuration(self.arm(), q)
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
    ///     InvalidModelError: The arm is not a YuMi of the catalog.
    fn arm_angle<'py>(&self, q: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        configured::arm_angle(self.arm(), q)
    }
}

/// The numbers of a record in the order of its fields; NaN where an arm has no such singularity.
fn numbers(record: &kinematics::Singularity) -> [f64; 5] {
    let [wrist, elbow, shoulder] =
        record.distances.map_or([f64::NAN; 3], |d| [d.wrist, d.elbow, d.shoulder]);
    [wrist, elbow, shoulder, record.min_singular_value, record.manipulability]
}

/// `irbkin.records.Singularity` of one joint vector.
fn one_singularity(py: Python<'_>, record: &kinematics::Singularity) -> PyResult<Singularity> {
    let kinds = records::kinds(py, record.kinds)?.unbind();
    let [wrist, elbow, shoulder, min_singular_value, manipulability] =
        numbers(record).map(|number| PyFloat::new(py, number).into_any().unbind());
    Ok(Singularity { wrist, elbow, shoulder, min_singular_value, manipulability, kinds })
}

/// `irbkin.records.Singularity` of arrays with the leading dimensions of `q`.
fn singularities<'py>(
    arm: &Arm,
    q: &Rows<'py>,
    out: Option<&Bound<'py, PyAny>>,
    threads: Option<NonZeroUsize>,
) -> PyResult<Singularity> {
    let (py, data) = (q.py(), q.data()?);
    let out = out.map(six_arrays).transpose()?;
    let mut memory = vec![q.addresses()];
    let (mut columns, mut views) = (Vec::new(), Vec::new());
    for field in 0..5 {
        let column = output(py, out.as_ref().map(|out| &out[field]), &q.lead)?;
        views.push(writable(&column, &memory)?);
        memory.push(addresses(&column));
        columns.push(column.into_any().unbind());
    }
    let kinds = match &out {
        Some(out) => checked_out(&out[5], &q.lead, "uint8")?,
        None => PyArrayDyn::zeros(py, q.lead.clone(), false),
    };
    let mut kinds_view = writable(&kinds, &memory)?;
    let mut found = vec![None; q.lead.iter().product()];
    let records = &mut found[..];
    detached(py, threads, |batch| on!(arm, robot => batch.singularity(robot, data, records)))?;
    for (to, record) in kinds_view.as_slice_mut()?.iter_mut().zip(&found) {
        *to = record.map_or(Status::INVALID.bits(), |record| record.kinds.bits());
    }
    for (field, view) in views.iter_mut().enumerate() {
        for (to, record) in view.as_slice_mut()?.iter_mut().zip(&found) {
            *to = record.as_ref().map_or(f64::NAN, |record| numbers(record)[field]);
        }
    }
    let kinds = kinds.into_any().unbind();
    let columns = <[_; 5]>::try_from(columns);
    let [wrist, elbow, shoulder, min_singular_value, manipulability] =
        columns.map_err(|_| PyTypeError::new_err("a singularity has five numbers"))?;
    Ok(Singularity { wrist, elbow, shoulder, min_singular_value, manipulability, kinds })
}

/// The arrays of a `Singularity` or of a tuple.
fn six_arrays<'py>(out: &Bound<'py, PyAny>) -> PyResult<Vec<Bound<'py, PyAny>>> {
    if out.is_instance_of::<PyTuple>() || out.is_instance_of::<Singularity>() {
        let arrays = out.try_iter()?.collect::<PyResult<Vec<_>>>()?;
        if arrays.len() == 6 {
            return Ok(arrays);
        }
    }
    Err(PyTypeError::new_err("out must be a Singularity, or a tuple of its six arrays"))
}
