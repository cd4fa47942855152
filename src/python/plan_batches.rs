//! `Robot.plan_batch`: the best joint paths along many paths at once.

use std::sync::{Mutex, PoisonError};

use pyo3::prelude::*;
use pyo3::types::PyTuple;

use super::arguments::thread_count;
use super::arrays::Rows;
use super::classes::{invalid_model_error, irbkin_error};
use super::errors::{Fault, shape_text};
use super::freedoms::{Costs, read_options};
use super::paths::{one_path, read_path};
use super::plans::{answer, asked, read_times};
use super::robot::PyRobot;
use super::signals::detached_while;
use crate::batch::{Batch, PlanJob};
use crate::plan::PlanOptions;

#[pymethods]
impl PyRobot {
    /// `plan` of many paths at once, on several threads.
    ///
    /// A path that has no plan, or is not a path, does not end the call: its exception is in its
    /// place. The answer of a path does not depend on the others or on the number of threads.
    ///
    /// Args:
    ///     paths: p paths, each of shape (m, 4, 4); their lengths may differ.
    ///     rotation: As for `plan`, of all paths.
    ///     times: p arrays, the times of the poses of each path [s], shape (m,).
    ///     start: Joint vector at the first pose [rad], shape (6,), or one for each path, (p, 6);
    ///         with the values of k external axes behind it, (6 + k,) or (p, 6 + k).
    ///     end: The same at the last pose.
    ///     closed: As for `plan`, of all paths.
    ///     weights: As for `plan`, of all paths.
    ///     accept: As for `plan`. Threads ask it one at a time.
    ///     carrier: As for `plan`, of all paths.
    ///     tolerance: As for `plan`, of all paths.
    ///     order: As for `plan`, of all paths.
    ///     limit_cost: As for `plan`, of all paths.
    ///     singularity_cost: As for `plan`, of all paths.
    ///     threads: Number of threads; 0 for one a core.
    ///
    /// Returns:
    ///     One answer for each path, in order: a Plan, or the PathError, InvalidPoseError,
    ///     InvalidJointsError or InvalidMotionError that `plan` raises for it.
    ///
    /// Raises:
    ///     InvalidPoseError: A path that has a wrong shape; the message has its index.
    ///     InvalidJointsError: A start, end or weights of a wrong shape.
    ///     InvalidMotionError: Times of a wrong shape or number, or a rotation that is empty.
    ///     InvalidModelError: The arm has seven joints.
    ///     Exception: Whatever `accept` raises.
    #[pyo3(signature = (paths, *, rotation=None, times=None, start=None, end=None, closed=false, weights=None, accept=None, carrier=None, tolerance=None, order="bottleneck", limit_cost=0.0, singularity_cost=0.0, threads=1))]
    #[expect(clippy::too_many_arguments, reason = "keywords of Python")]
    fn plan_batch<'py>(
        &self,
        paths: &Bound<'py, PyAny>,
        rotation: Option<&Bound<'py, PyAny>>,
        times: Option<&Bound<'py, PyAny>>,
        start: Option<&Bound<'py, PyAny>>,
        end: Option<&Bound<'py, PyAny>>,
        closed: bool,
        weights: Option<&Bound<'py, PyAny>>,
        accept: Option<&Bound<'py, PyAny>>,
        carrier: Option<&Bound<'py, PyAny>>,
        tolerance: Option<&Bound<'py, PyAny>>,
        order: &str,
        limit_cost: f64,
        singularity_cost: f64,
        threads: isize,
    ) -> PyResult<Bound<'py, PyTuple>> {
        let py = paths.py();
        let (robot, threads) = (self.arm().six_joints(py, "plan_batch")?, thread_count(threads)?);
        let costs = Costs { weights, order, limit: limit_cost, singularity: singularity_cost };
        let all = read_options(rotation, closed, carrier, tolerance, &costs)?;
        let axes = all.external.len();
        let rows = read_rows(paths)?;
        let times = read_all_times(py, times, rows.len())?;
        let (start, end) = (
            Ends::read(start, "start", rows.len(), axes)?,
            Ends::read(end, "end", rows.len(), axes)?,
        );
        // The error of each path, in its place, and the paths that are planned.
        let mut faults = Vec::with_capacity(rows.len());
        let mut jobs = Vec::with_capacity(rows.len());
        for (index, path) in rows.iter().enumerate() {
            match read_path(py, path, &path.shape()[..1]) {
                Ok(path) => {
                    let (start, start_external) = start.of(index)?;
                    let (end, end_external) = end.of(index)?;
                    let options = PlanOptions {
                        times: times.as_ref().map(|times| times[index].clone()),
                        start,
                        end,
                        start_external,
                        end_external,
                        ..all.clone()
                    };
                    jobs.push(PlanJob { path, options });
                    faults.push(None);
                }
                Err(error) => faults.push(Some(in_place(py, error)?)),
            }
        }
        let accept = accept.map(|accept| accept.clone().unbind());
        let failure = Mutex::new(None);
        let ask = |q: &[[f64; 6]]| {
            let accept = accept.as_ref()?;
            let fail =
                |error| *failure.lock().unwrap_or_else(PoisonError::into_inner) = Some(error);
            Python::attach(|py| asked(accept.bind(py), q)).map_err(fail).ok()
        };
        let has_failed = || failure.lock().is_ok_and(|failure| failure.is_some());
        let planned = detached_while(py, |go_on| {
            let mut go_on = || !has_failed() && go_on();
            let accept = accept.is_some().then_some(&ask as _);
            Batch::until(threads, &mut go_on).plan(robot, &jobs, accept)
        })?;
        if let Some(failure) = failure.into_inner().unwrap_or_else(PoisonError::into_inner) {
            return Err(failure);
        }
        let mut planned = planned.iter();
        let mut answers = Vec::with_capacity(faults.len());
        for fault in faults {
            let found = if fault.is_none() { planned.next() } else { None };
            answers.extend(match found {
                Some(planned) => Some(answer(py, planned).or_else(|error| in_place(py, error))?),
                None => fault,
            });
        }
        PyTuple::new(py, answers)
    }
}

/// The paths, each of the right shape.
fn read_rows<'py>(paths: &Bound<'py, PyAny>) -> PyResult<Vec<Rows<'py>>> {
    let paths = paths.try_iter()?.enumerate();
    paths.map(|(index, path)| one_path(&path?, &format!("paths[{index}]"))).collect()
}

/// The times of each of `count` paths.
fn read_all_times(
    py: Python<'_>,
    times: Option<&Bound<'_, PyAny>>,
    count: usize,
) -> PyResult<Option<Vec<Vec<f64>>>> {
    let Some(times) = times else { return Ok(None) };
    let mut all = Vec::with_capacity(count);
    for (index, times) in times.try_iter()?.enumerate() {
        all.push(read_times(&times?, &format!("times[{index}]"))?);
    }
    if all.len() == count {
        return Ok(Some(all));
    }
    let message = format!("times must be {count} arrays, one for each path, got {}", all.len());
    Err(Fault::Motion.error(py, message))
}

/// Joint vectors at one end: one for all paths, or one for each.
struct Ends<'py> {
    rows: Option<Rows<'py>>,
}

impl<'py> Ends<'py> {
    fn read(
        q: Option<&Bound<'py, PyAny>>,
        field: &str,
        count: usize,
        axes: usize,
    ) -> PyResult<Self> {
        let Some(q) = q else { return Ok(Self { rows: None }) };
        let width = 6 + axes;
        let rows = Rows::read(q, &[width], field, Fault::Joints)?;
        if rows.is_single() || rows.lead == [count] {
            return Ok(Self { rows: Some(rows) });
        }
        let got = shape_text(rows.shape());
        let message =
            format!("{field} must have shape ({width},) or ({count}, {width}), got {got}");
        Err(Fault::Joints.error(q.py(), message))
    }

    /// Return the start of the path `index`, and the values of the external axes.
    fn of(&self, index: usize) -> PyResult<(Option<[f64; 6]>, Vec<f64>)> {
        let Some(rows) = &self.rows else { return Ok((None, Vec::new())) };
        let row = if rows.is_single() { 0 } else { index };
        let width = rows.shape().last().copied().unwrap_or_default();
        let values = rows.data()?.get(row * width..(row + 1) * width).unwrap_or_default();
        let (q, external) = values.split_at(values.len().min(6));
        Ok((q.try_into().ok(), external.to_vec()))
    }
}

/// An exception as the answer of one path; one that is not about the path is raised.
fn in_place(py: Python<'_>, error: PyErr) -> PyResult<Bound<'_, PyAny>> {
    let is_of_path = error.is_instance(py, irbkin_error(py)?)
        && !error.is_instance(py, invalid_model_error(py)?);
    if is_of_path { Ok(error.into_value(py).into_bound(py).into_any()) } else { Err(error) }
}
