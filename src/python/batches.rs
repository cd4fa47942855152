//! Every joint vector of many poses.

use std::num::NonZeroUsize;

use pyo3::prelude::*;

use super::answers::batch_output;
use super::arm::{Arm, on};
use super::arrays::addresses;
use super::classes;
use super::outputs::writable;
use super::redundancy::read_poses_with_q7;
use super::signals::detached;

/// `irbkin.IkBatch` of poses, shape (..., 4, 4), and of the angles of a joint of seven for each,
/// with the name of the argument.
pub(super) fn ik<'py>(
    arm: &Arm,
    poses: &Bound<'py, PyAny>,
    angles: (&'static str, Option<&Bound<'py, PyAny>>),
    out: Option<&Bound<'py, PyAny>>,
    threads: Option<NonZeroUsize>,
) -> PyResult<Bound<'py, PyAny>> {
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
        |pace| on!(arm, robot => pace.ik_with(robot, data, &angles, q_slice, status_slice)),
    )?;
    classes::ik_batch_class(py)?.call1((q, status))
}
