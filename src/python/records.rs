//! Values of the enumerations and records that `irbkin` defines in Python.

use pyo3::prelude::*;

use super::classes::{configuration_class, kind_class, reach_class, status_class};
use crate::kinematics::{SingularityKind, Status};
use crate::report::{Configuration, Reach};

/// `irbkin.Configuration` of one.
pub(super) fn configuration<'py>(
    py: Python<'py>,
    configuration: &Configuration,
) -> PyResult<Bound<'py, PyAny>> {
    let Configuration { cf1, cf4, cf6, cfx } = *configuration;
    configuration_class(py)?.call1((cf1, cf4, cf6, cfx))
}

/// `irbkin.SingularityKind` of singularities.
pub(super) fn kinds(py: Python<'_>, kinds: SingularityKind) -> PyResult<Bound<'_, PyAny>> {
    kind_class(py)?.call1((kinds.bits(),))
}

/// `irbkin.Status` of a status.
pub(super) fn status(py: Python<'_>, status: Status) -> PyResult<Bound<'_, PyAny>> {
    status_class(py)?.call1((status.bits(),))
}

/// `irbkin.Reach` without its shortfall.
pub(super) fn reach(py: Python<'_>, reach: Reach) -> PyResult<Bound<'_, PyAny>> {
    reach_class(py)?.getattr(match reach {
        Reach::Reached => "REACHED",
        Reach::TooFar { .. } => "TOO_FAR",
        Reach::TooNear { .. } => "TOO_NEAR",
        Reach::NoRoots => "NO_ROOTS",
    })
}
