//! Arguments that are one of a few words, or a count.

use std::num::NonZeroUsize;

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::kinematics::{JacobianFrame, SingularityMode};

/// The frame of a Jacobian.
pub(super) fn read_frame(frame: &str) -> PyResult<JacobianFrame> {
    match frame {
        "base" => Ok(JacobianFrame::Base),
        "tool" => Ok(JacobianFrame::Tool),
        _ => Err(PyValueError::new_err(format!(
            "frame must be \"base\" or \"tool\", got \"{frame}\""
        ))),
    }
}

/// What a path does at the wrist singularity.
pub(super) fn read_singularity_mode(singularity_mode: &str) -> PyResult<SingularityMode> {
    match singularity_mode {
        "through" => Ok(SingularityMode::Through),
        "error" => Ok(SingularityMode::Error),
        "wrist" => Ok(SingularityMode::Wrist),
        "lock_axis4" => Ok(SingularityMode::LockAxis4),
        _ => Err(PyValueError::new_err(format!(
            "singularity_mode must be \"through\", \"error\", \"wrist\" or \"lock_axis4\", got \"{singularity_mode}\""
        ))),
    }
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
