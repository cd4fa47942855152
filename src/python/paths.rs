//! Paths followed from seeds.

use std::num::NonZeroUsize;
use std::ops::Range;

use numpy::PyArrayDyn;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use super::arrays::{Argument, Rows, addresses, together};
use super::classes::break_reason_class;
use super::errors::{Fault, index_in, shape_text, to_py};
use super::nearest::single_seed;
use super::outputs::{Writable, output, writable};
use super::records::{Break, FollowResult};
use super::signals::detached;
use crate::kinematics::{
    BreakReason, FollowOptions, Followed, Pose, Robot, check_seed, pose_from_rows,
};

/// Poses that are read between two looks at the signals.
const POSES_AT_A_TIME: usize = 1 << 18;

/// Paths of poses, shape (..., m, 4, 4), each followed from its seed.
pub(super) fn follow<'py>(
    robot: &Robot<6>,
    paths: &Bound<'py, PyAny>,
    seeds: &Bound<'py, PyAny>,
    options: &FollowOptions,
    out: Option<&Bound<'py, PyAny>>,
    threads: Option<NonZeroUsize>,
) -> PyResult<FollowResult> {
    let py = paths.py();
    let mut rows = Rows::read(paths, &[4, 4], "T", Fault::Pose)?;
    let mut seeds = Rows::read(seeds, &[6], "seed", Fault::Joints)?;
    single_seed::<6>(py, &seeds)?;
    let Some(length) = rows.split_last() else {
        return Err(Fault::Pose.error(
            py,
            format!("T must have shape (..., m, 4, 4), got {}", shape_text(rows.shape())),
        ));
    };
    together(
        py,
        &mut [
            Argument { field: "T", fault: Fault::Pose, rows: &mut rows },
            Argument { field: "seed", fault: Fault::Joints, rows: &mut seeds },
        ],
    )?;
    let shape = rows.shape_with(&[length]);
    let answers = Answers::of(py, out, &shape, &[rows.addresses(), seeds.addresses()])?;
    let poses = read_path(py, &rows, &shape)?;
    let starts = checked_seeds(py, &seeds)?;
    let followed =
        detached(py, threads, |pace| pace.follow(robot, &poses, length, starts, options))?;
    answers.filled(py, &rows.lead, &followed)
}

/// The poses of one path, shape (m, 4, 4), as they are given.
pub(super) fn one_path<'py>(path: &Bound<'py, PyAny>, field: &str) -> PyResult<Rows<'py>> {
    let mut rows = Rows::read(path, &[4, 4], field, Fault::Pose)?;
    if rows.split_last().is_some() && rows.is_single() {
        return Ok(rows);
    }
    let got = shape_text(rows.shape());
    Err(Fault::Pose.error(path.py(), format!("{field} must have shape (m, 4, 4), got {got}")))
}

/// The poses of one path `T`, shape (m, 4, 4), checked.
pub(super) fn read_path_poses(path: &Bound<'_, PyAny>) -> PyResult<Vec<Pose>> {
    let rows = one_path(path, "T")?;
    read_path(path.py(), &rows, &rows.shape()[..1])
}

/// Every pose of paths of the shape `shape`, checked.
pub(super) fn read_path(py: Python<'_>, rows: &Rows<'_>, shape: &[usize]) -> PyResult<Vec<Pose>> {
    let rows = rows.data()?.as_chunks::<16>().0;
    let mut poses = Vec::with_capacity(rows.len());
    for row in rows {
        if poses.len().is_multiple_of(POSES_AT_A_TIME) {
            py.check_signals()?;
        }
        poses.push(pose_from_rows(row).map_err(|error| {
            Fault::Pose.error(py, format!("T{:?}: {error}", index_in(shape, poses.len())))
        })?);
    }
    Ok(poses)
}

fn checked_seeds<'a>(py: Python<'_>, seeds: &'a Rows<'_>) -> PyResult<&'a [[f64; 6]]> {
    let rows = seeds.data()?.as_chunks::<6>().0;
    for (path, seed) in rows.iter().enumerate() {
        check_seed("seed", seed).map_err(|error| {
            let place = index_in(&seeds.lead, path);
            if place.is_empty() {
                return to_py(py, &error);
            }
            Fault::Joints.error(py, format!("seed{place:?}: {error}"))
        })?;
    }
    Ok(rows)
}

/// The arrays that followed paths are written to.
struct Answers<'py> {
    q: Bound<'py, PyArrayDyn<f64>>,
    q_view: Writable<'py, f64>,
    errors: Bound<'py, PyArrayDyn<f64>>,
    errors_view: Writable<'py, f64>,
}

impl<'py> Answers<'py> {
    /// Arrays for poses of the shape `shape`.
    fn of(
        py: Python<'py>,
        out: Option<&Bound<'py, PyAny>>,
        shape: &[usize],
        inputs: &[Range<usize>],
    ) -> PyResult<Self> {
        let (q, errors) = match out {
            None => (None, None),
            Some(out) => match out.cast::<PyTuple>().map(|pair| (pair, pair.len())) {
                Ok((pair, 2)) => (Some(pair.get_item(0)?), Some(pair.get_item(1)?)),
                _ => {
                    return Err(PyTypeError::new_err(
                        "out must be a tuple of two arrays: (q, orientation_error)",
                    ));
                }
            },
        };
        let q = output(py, q.as_ref(), &[shape, &[6]].concat())?;
        let errors = output(py, errors.as_ref(), shape)?;
        let (q_view, errors_view) =
            (writable(&q, inputs)?, writable(&errors, &[inputs, &[addresses(&q)]].concat())?);
        Ok(Self { q, q_view, errors, errors_view })
    }

    /// `irbkin.FollowResult` of paths with the leading dimensions `lead`.
    fn filled(
        mut self,
        py: Python<'_>,
        lead: &[usize],
        followed: &[Followed],
    ) -> PyResult<FollowResult> {
        let rows = self.q_view.as_slice_mut()?.as_chunks_mut::<6>().0.iter_mut();
        for (row, q) in rows.zip(followed.iter().flat_map(|path| &path.q)) {
            *row = q.unwrap_or([f64::NAN; 6]);
        }
        let errors = followed.iter().flat_map(|path| &path.orientation_error);
        for (to, error) in self.errors_view.as_slice_mut()?.iter_mut().zip(errors) {
            *to = error.unwrap_or(f64::NAN);
        }
        let mut breaks = Vec::new();
        for (path, followed) in followed.iter().enumerate() {
            for broken in &followed.breaks {
                breaks.push(Break {
                    pose_index: broken.pose_index,
                    reason: broken.to_string(),
                    path: PyTuple::new(py, index_in(lead, path))?.unbind(),
                    kind: break_kind(py, &broken.reason)?.unbind(),
                });
            }
        }
        Ok(FollowResult {
            q: self.q.into_any().unbind(),
            orientation_error: self.errors.into_any().unbind(),
            breaks: PyTuple::new(py, breaks)?.unbind(),
        })
    }
}

/// `irbkin.BreakReason` of a break.
fn break_kind<'py>(py: Python<'py>, reason: &BreakReason) -> PyResult<Bound<'py, PyAny>> {
    break_reason_class(py)?.getattr(match reason {
        BreakReason::Unreachable(_) => "UNREACHABLE",
        BreakReason::Jump { .. } => "JUMP",
        BreakReason::Locked => "LOCKED",
        BreakReason::Stopped { .. } => "STOPPED",
    })
}
