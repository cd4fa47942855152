//! Every joint vector of many poses.

use std::num::NonZeroUsize;

use pyo3::prelude::*;

use super::answers::{BatchArrays, batch_output};
use super::arm::Arm;
use super::arrays::{Rows, addresses};
use super::classes;
use super::outputs::writable;
use super::redundancy::read_poses_with_q7;
use super::signals::detached;
use crate::batch::Pace;
use crate::error::Error;

/// `irbkin.IkBatch` of poses, shape (..., 4, 4), and of joint 7 for each where the arm has seven.
pub(super) fn ik<'py>(
    arm: &Arm,
    poses: &Bound<'py, PyAny>,
    q7: Option<&Bound<'py, PyAny>>,
    out: Option<&Bound<'py, PyAny>>,
    threads: Option<NonZeroUsize>,
) -> PyResult<Bound<'py, PyAny>> {
    let py = poses.py();
    let (poses, given) = read_poses_with_q7(arm, poses, q7)?;
    let answers = batch_output(py, out, &poses, [arm.slot_count(), arm.dof()])?;
    filled(py, &poses, answers, threads, |pace, poses, q, status| match arm {
        Arm::Six(robot) => pace.ik(robot, poses, q, status),
        Arm::Seven(robot) => pace.ik_with(robot, poses, &given, q, status),
    })
}

/// `irbkin.IkBatch` of poses, whose arrays `solve` writes from those of the poses.
pub(super) fn filled<'py>(
    py: Python<'py>,
    poses: &Rows<'py>,
    (q, status): BatchArrays<'py>,
    threads: Option<NonZeroUsize>,
    solve: impl FnOnce(&mut Pace<'_>, &[f64], &mut [f64], &mut [u8]) -> Result<(), Error> + Send,
) -> PyResult<Bound<'py, PyAny>> {
    let (data, mut q_view, mut status_view) = (
        poses.data()?,
        writable(&q, &[poses.addresses()])?,
        writable(&status, &[poses.addresses(), addresses(&q)])?,
    );
    let (q_slice, status_slice) = (q_view.as_slice_mut()?, status_view.as_slice_mut()?);
    detached(py, threads, |pace| solve(pace, data, q_slice, status_slice))?;
    classes::ik_batch_class(py)?.call1((q, status))
}
