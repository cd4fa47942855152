//! `irbkin.catalog` and `irbkin.catalog_entry`.

use std::ops::RangeInclusive;

use crate::errors::exception;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyBytes, PyTuple};

use super::outputs::{array, column};
use super::records::CatalogEntry;
use irbkin::catalog::{catalog as every_arm, find};
use irbkin::thresholds::MOST_REACH;

/// Return what the catalog has of an arm: payload, reach, limits, speeds, accelerations, sources.
///
/// Args:
///     name: Catalog name or alias, as `Robot` takes it.
///
/// Returns:
///     CatalogEntry.
///
/// Raises:
///     UnknownRobotError: No arm of that name; the message has the close names, or why the arm is
///         left out.
#[pyfunction]
pub(super) fn catalog_entry(py: Python<'_>, name: &str) -> PyResult<CatalogEntry> {
    let arm = find(name).map_err(exception)?;
    let radians = |angle: f64| arm.angles.to_radians(angle);
    let limits = arm.limits.as_flattened().iter().map(|&limit| radians(limit));
    let rates = |all: &[f64]| column(py, all.iter().map(|&rate| radians(rate)));
    Ok(CatalogEntry {
        name: arm.name.to_owned(),
        maker: arm.maker.to_owned(),
        aliases: PyTuple::new(py, arm.aliases().collect::<Vec<_>>())?.unbind(),
        dof: arm.dof(),
        payload: arm.payload,
        reach: arm.reach,
        limits: array(py, limits, &[arm.dof(), 2])?,
        max_velocity: arm.max_velocity.as_deref().map(rates),
        max_acceleration: arm.max_acceleration.as_deref().map(rates),
        is_coupled: arm.is_coupled(),
        sources: arm.sources.into(),
        provenance: arm.provenance.to_owned(),
    })
}

/// Return the names of the arms in the catalog, ABB's by type number first; of all, or of those
/// with a reach and a payload. `catalog_entry(name)` has the data of one.
///
/// Args:
///     reach: Reach as the type name or the data sheet has it [m]: a number for at least that much,
///         a pair for (least, most).
///     payload: Payload [kg], in the same way.
///
/// Returns:
///     Names in catalog order. An arm whose reach or payload is not known is left out where it is
///     asked for.
///
/// Raises:
///     ValueError: A filter is neither a number nor a pair, is NaN or negative, or its least is
///         more than its most.
#[pyfunction]
#[pyo3(signature = (reach=None, payload=None))]
pub(super) fn catalog<'py>(
    py: Python<'py>,
    reach: Option<&Bound<'py, PyAny>>,
    payload: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyTuple>> {
    let reach = reach.map(|reach| read_range(reach, "reach", "m")).transpose()?;
    let payload = payload.map(|payload| read_range(payload, "payload", "kg")).transpose()?;
    let passes = |filter: &Option<RangeInclusive<f64>>, figure: Option<f64>| {
        filter.as_ref().is_none_or(|range| figure.is_some_and(|figure| range.contains(&figure)))
    };
    let fitting =
        every_arm().filter(|arm| passes(&reach, arm.reach) && passes(&payload, arm.payload));
    PyTuple::new(py, fitting.map(|arm| arm.name).collect::<Vec<_>>())
}

/// The figures that pass a filter: a number is the least, a pair the least and the most.
fn read_range(filter: &Bound<'_, PyAny>, field: &str, unit: &str) -> PyResult<RangeInclusive<f64>> {
    let refused = |message| PyValueError::new_err(format!("{field} {message}"));
    // Python's bytes are pairs of numbers, and its truth values numbers, to those who ask.
    let no_number = filter.is_instance_of::<PyBytes>() || filter.is_instance_of::<PyBool>();
    let least = filter.extract::<f64>().map(|least| [least, f64::INFINITY]);
    let pair = least.or_else(|_| filter.extract::<[f64; 2]>()).ok().filter(|_| !no_number);
    let Some([least, most]) = pair else {
        let got = filter.repr()?;
        return Err(refused(format!(
            "must be a number (at least that much) or a pair (least, most) [{unit}], got {got}"
        )));
    };
    for value in [least, most] {
        if value.is_nan() || value < 0.0 {
            return Err(refused(format!("is {value} {unit}, it must be 0 or more")));
        }
        // A payload may be that many kilograms; no arm reaches that many meters.
        if unit == "m" && value.is_finite() && value > MOST_REACH {
            return Err(refused(format!(
                "is {value} {unit}, it must be at most {MOST_REACH} {unit} (is it in millimeters?)"
            )));
        }
    }
    if least > most {
        return Err(refused(format!("is empty: least {least} {unit} > most {most} {unit}")));
    }
    Ok(least..=most)
}
