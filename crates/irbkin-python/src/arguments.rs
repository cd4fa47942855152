//! Arguments that are one of a few words, a count, or limits of joints.

use std::num::NonZeroUsize;

use pyo3::exceptions::{PyOverflowError, PyValueError};
use pyo3::prelude::*;

use super::arrays::Rows;
use super::errors::Fault;
use irbkin::JacobianFrame;
use irbkin::follow::SingularityMode;
use irbkin_motion::internal::MOST_SAMPLES;
use irbkin_motion::paths::ArcOrientation;
use irbkin_motion::plan::{PlanOrder, ToolAxis};
use irbkin_motion::stream::OnViolation;
use irbkin_motion::trajectory::{Profile, SplineKind, Synchronization};

/// Look up the value that a word names.
pub(super) fn one_of<T: Copy>(field: &str, word: &str, words: &[(&str, T)]) -> PyResult<T> {
    if let Some((_, value)) = words.iter().find(|(name, _)| *name == word) {
        return Ok(*value);
    }
    let known: Vec<String> = words.iter().map(|(name, _)| format!("{name:?}")).collect();
    let known = match known.split_last() {
        Some((last, others @ [_, ..])) => format!("{} or {last}", others.join(", ")),
        _ => known.concat(),
    };
    Err(PyValueError::new_err(format!("{field} must be {known}, got \"{word}\"")))
}

pub(super) const FRAMES: [(&str, JacobianFrame); 2] =
    [("base", JacobianFrame::Base), ("tool", JacobianFrame::Tool)];

pub(super) const SINGULARITY_MODES: [(&str, SingularityMode); 4] = [
    ("through", SingularityMode::Through),
    ("error", SingularityMode::Error),
    ("wrist", SingularityMode::Wrist),
    ("lock_axis4", SingularityMode::LockAxis4),
];

pub(super) const PROFILES: [(&str, Profile); 4] = [
    ("quintic", Profile::Quintic),
    ("cubic", Profile::Cubic),
    ("trapezoid", Profile::Trapezoid),
    ("s_curve", Profile::SCurve),
];

pub(super) const SPLINES: [(&str, SplineKind); 2] =
    [("quintic", SplineKind::Quintic), ("cubic", SplineKind::Cubic)];

pub(super) const SYNCHRONIZATIONS: [(&str, Synchronization); 2] =
    [("time", Synchronization::Time), ("phase", Synchronization::Phase)];

pub(super) const VIOLATIONS: [(&str, OnViolation); 2] =
    [("brake", OnViolation::Brake), ("limit", OnViolation::Limit)];

pub(super) const ORIENTATIONS: [(&str, ArcOrientation); 3] = [
    ("path", ArcOrientation::Path),
    ("object", ArcOrientation::Object),
    ("via", ArcOrientation::Via),
];

pub(super) const ORDERS: [(&str, PlanOrder); 2] =
    [("bottleneck", PlanOrder::Bottleneck), ("sum", PlanOrder::Sum)];

pub(super) const AXES: [(&str, ToolAxis); 3] =
    [("x", ToolAxis::X), ("y", ToolAxis::Y), ("z", ToolAxis::Z)];

/// A number of samples or poses: its bounds are checked where it is used, if it has a sign that
/// counts can have and a size that is one.
pub(super) fn read_steps(steps: &Bound<'_, PyAny>) -> PyResult<usize> {
    let message = || format!("steps must be 2 to {MOST_SAMPLES}, got {steps}");
    steps.extract().map_err(|error| or_overflow(steps, error, || Fault::Motion.error(message())))
}

/// The seed of random samples.
pub(super) fn read_seed(seed: &Bound<'_, PyAny>) -> PyResult<u64> {
    let message = || format!("seed is {seed}, it must be 0 to {}", u64::MAX);
    seed.extract().map_err(|error| or_overflow(seed, error, || PyValueError::new_err(message())))
}

pub(super) fn read_threads(threads: &Bound<'_, PyAny>) -> PyResult<isize> {
    let most = isize::MAX;
    let message = || format!("threads must be 0 (one per core) to {most}, got {threads}");
    threads
        .extract()
        .map_err(|error| or_overflow(threads, error, || PyValueError::new_err(message())))
}

/// An error of reading a number: `overflow` if it is too large for its type.
fn or_overflow(value: &Bound<'_, PyAny>, error: PyErr, overflow: impl FnOnce() -> PyErr) -> PyErr {
    if error.is_instance_of::<PyOverflowError>(value.py()) { overflow() } else { error }
}

/// A number of threads; 0 is one a core.
pub(super) fn thread_count(threads: isize) -> PyResult<Option<NonZeroUsize>> {
    match usize::try_from(threads) {
        Ok(0) => Ok(std::thread::available_parallelism().ok()),
        Ok(count) => Ok(NonZeroUsize::new(count)),
        Err(_) => Err(PyValueError::new_err(format!(
            "threads must be 0 (one per core) or more, got {threads}"
        ))),
    }
}

/// Lower and upper limits of joint angles, shape (n, 2), if they are given.
pub(super) fn read_angle_limits(
    value: Option<&Bound<'_, PyAny>>,
    dof: usize,
) -> PyResult<Option<Vec<[f64; 2]>>> {
    let Some(value) = value else { return Ok(None) };
    let rows = Rows::exact(value, &[dof, 2], "limits", Fault::Motion)?;
    Ok(Some(rows.data()?.as_chunks().0.to_vec()))
}
