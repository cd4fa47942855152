//! Arguments that are one of a few words, or a count.

use std::num::NonZeroUsize;

use pyo3::exceptions::{PyOverflowError, PyValueError};
use pyo3::prelude::*;

use super::errors::Fault;
use crate::kinematics::thresholds::MOST_SAMPLES;
use crate::kinematics::{JacobianFrame, SingularityMode};
use crate::paths::ArcOrientation;
use crate::trajectory::{Profile, SplineKind, Synchronization};

/// Look up the value that a word names.
pub(super) fn one_of<T: Copy>(field: &str, word: &str, words: &[(&str, T)]) -> PyResult<T> {
    if let Some((_, value)) = words.iter().find(|(name, _)| *name == word) {
        return Ok(*value);
    }
    let mut known = String::new();
    for (index, (name, _)) in words.iter().enumerate() {
        known += match index {
            0 => "",
            _ if index + 1 == words.len() => " or ",
            _ => ", ",
        };
        known += "\"";
        known += name;
        known += "\"";
    }
    Err(PyValueError::new_err(format!("{field} must be {known}, got \"{word}\"")))
}

/// The frame of a Jacobian.
pub(super) fn read_frame(frame: &str) -> PyResult<JacobianFrame> {
    one_of("frame", frame, &[("base", JacobianFrame::Base), ("tool", JacobianFrame::Tool)])
}

/// Behavior of a path at the wrist singularity.
pub(super) fn read_singularity_mode(singularity_mode: &str) -> PyResult<SingularityMode> {
    let words = [
        ("through", SingularityMode::Through),
        ("error", SingularityMode::Error),
        ("wrist", SingularityMode::Wrist),
        ("lock_axis4", SingularityMode::LockAxis4),
    ];
    one_of("singularity_mode", singularity_mode, &words)
}

/// The profile of a motion between two joint vectors.
pub(super) fn read_profile(profile: &str) -> PyResult<Profile> {
    let words = [
        ("quintic", Profile::Quintic),
        ("cubic", Profile::Cubic),
        ("trapezoid", Profile::Trapezoid),
        ("s_curve", Profile::SCurve),
    ];
    one_of("profile", profile, &words)
}

/// The curve through waypoints.
pub(super) fn read_spline(profile: &str) -> PyResult<SplineKind> {
    let words = [("quintic", SplineKind::Quintic), ("cubic", SplineKind::Cubic)];
    one_of("profile", profile, &words)
}

/// How joints arrive together.
pub(super) fn read_synchronization(synchronization: &str) -> PyResult<Synchronization> {
    let words = [("time", Synchronization::Time), ("phase", Synchronization::Phase)];
    one_of("synchronization", synchronization, &words)
}

/// Course of the orientation along an arc.
pub(super) fn read_orientation(orientation: &str) -> PyResult<ArcOrientation> {
    let words = [
        ("path", ArcOrientation::Path),
        ("object", ArcOrientation::Object),
        ("via", ArcOrientation::Via),
    ];
    one_of("orientation", orientation, &words)
}

/// A number of samples or poses: its bounds are checked where it is used, if it has a sign that
/// counts can have and a size that is one.
pub(super) fn read_steps(steps: &Bound<'_, PyAny>) -> PyResult<usize> {
    let py = steps.py();
    steps.extract().map_err(|error: PyErr| {
        if error.is_instance_of::<PyOverflowError>(py) {
            let message = format!("steps must be 2 to {MOST_SAMPLES}, got {steps}");
            Fault::Motion.error(py, message)
        } else {
            error
        }
    })
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
