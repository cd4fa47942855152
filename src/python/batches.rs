//! Every joint vector of many poses, and the room that they leave.

use std::num::NonZeroUsize;

use numpy::PyArrayDyn;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use super::arm::{Arm, on};
use super::arrays::{Rows, addresses};
use super::outputs::{checked_out, output, writable};
use super::records::{IkBatch, IkMargin};
use super::redundancy::read_poses_with_q7;
use super::signals::detached;
use crate::batch::Margins;

/// `irbkin.IkBatch` of poses, shape (..., 4, 4), and of the angles of a joint of seven for each,
/// with the name of the argument.
pub(super) fn ik<'py>(
    arm: &Arm,
    poses: &Bound<'py, PyAny>,
    angles: (&'static str, Option<&Bound<'py, PyAny>>),
    out: Option<&Bound<'py, PyAny>>,
    threads: Option<NonZeroUsize>,
) -> PyResult<IkBatch> {
    let py = poses.py();
    let (poses, angles) = read_poses_with_q7(arm, poses, angles)?;
    let answers = batch_output(py, out, &poses, [arm.slot_count(), arm.dof()])?;
    let (q, status) = answers;
    let (data, mut q_view, mut status_view) = (
        poses.data()?,
        writable(&q, &[poses.addresses()])?,
        writable(&status, &[poses.addresses(), addresses(&q)])?,
    );
    let (q_slice, status_slice) = (q_view.as_slice_mut()?, status_view.as_slice_mut()?);
    detached(
        py,
        threads,
        |batch| on!(arm, robot => batch.ik_with(robot, data, &angles, q_slice, status_slice)),
    )?;
    Ok(IkBatch { q: q.into_any().unbind(), status: status.into_any().unbind() })
}

type BatchArrays<'py> = (Bound<'py, PyArrayDyn<f64>>, Bound<'py, PyArrayDyn<u8>>);

/// The arrays that a batch is written to.
fn batch_output<'py>(
    py: Python<'py>,
    out: Option<&Bound<'py, PyAny>>,
    poses: &Rows<'_>,
    [slots, dof]: [usize; 2],
) -> PyResult<BatchArrays<'py>> {
    let (q_shape, status_shape) = (poses.shape_with(&[slots, dof]), poses.shape_with(&[slots]));
    if let Some(record) = out.and_then(|out| out.cast::<IkBatch>().ok()) {
        let IkBatch { q, status } = record.get();
        return Ok((
            output(py, Some(q.bind(py)), &q_shape)?,
            checked_out(status.bind(py), &status_shape, "uint8")?,
        ));
    }
    match out.and_then(|out| out.cast::<PyTuple>().ok()) {
        Some(pair) if pair.len() == 2 => Ok((
            output(py, Some(&pair.get_item(0)?), &q_shape)?,
            checked_out(&pair.get_item(1)?, &status_shape, "uint8")?,
        )),
        Some(pair) => Err(PyTypeError::new_err(format!(
            "out must be (q, status), got a tuple of {}",
            pair.len()
        ))),
        None => Ok((output(py, out, &q_shape)?, PyArrayDyn::zeros(py, status_shape, false))),
    }
}

/// `irbkin.IkMargin` of poses, shape (..., 4, 4), and of joint 7 for each where the arm has seven.
pub(super) fn ik_margin<'py>(
    arm: &Arm,
    poses: &Bound<'py, PyAny>,
    q7: Option<&Bound<'py, PyAny>>,
    threads: Option<NonZeroUsize>,
) -> PyResult<IkMargin> {
    let py = poses.py();
    let (poses, angles) = read_poses_with_q7(arm, poses, ("q7", q7))?;
    let data = poses.data()?;
    let [margin, singularities] =
        [(); 2].map(|()| PyArrayDyn::<f64>::zeros(py, poses.lead.clone(), false));
    let count = PyArrayDyn::<u8>::zeros(py, poses.lead.clone(), false);
    let (mut to_margin, mut to_singularities, mut to_count) =
        (writable(&margin, &[])?, writable(&singularities, &[])?, writable(&count, &[])?);
    let answers = Margins {
        margin: to_margin.as_slice_mut()?,
        singularities: to_singularities.as_slice_mut()?,
        solutions: to_count.as_slice_mut()?,
    };
    detached(
        py,
        threads,
        |batch| on!(arm, robot => batch.ik_margin(robot, data, &angles, answers)),
    )?;
    Ok(IkMargin {
        margin: margin.into_any().unbind(),
        singularities: singularities.into_any().unbind(),
        solutions: count.into_any().unbind(),
    })
}
