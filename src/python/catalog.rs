//! `irbkin.catalog` and `irbkin.catalog_entry`.

use numpy::{PyArray1, PyArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyBytes, PyTuple};

use super::errors::to_py;
use super::records::CatalogEntry;
use crate::catalog::{catalog as every_arm, find};
use crate::kinematics::thresholds::MOST_REACH;

/// Return what the catalog has of an arm: payload, reach, limits, velocities, sources.
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
    let arm = find(name).map_err(|error| to_py(py, &error))?;
    let radians = |angle: f64| arm.angles.to_radians(angle);
    let limits: Vec<f64> = arm.limits.as_flattened().iter().map(|&limit| radians(limit)).collect();
    let velocities = arm
        .max_velocity
        .map(|all| PyArray1::from_iter(py, all.iter().map(|&velocity| radians(velocity))));
    Ok(CatalogEntry {
        name: arm.name.to_owned(),
        maker: arm.maker.to_owned(),
        aliases: PyTuple::new(py, arm.aliases().collect::<Vec<_>>())?.unbind(),
        dof: arm.dof(),
        payload: arm.payload,
        reach: arm.reach,
        limits: PyArray1::from_vec(py, limits).reshape([arm.dof(), 2])?.into_any().unbind(),
        max_velocity: velocities.map(|velocities| velocities.into_any().unbind()),
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
    let [reach, payload] =
        [Range::read("reach", "m", reach)?, Range::read("payload", "kg", payload)?];
    let fitting = every_arm().filter(|arm| {
        Range::holds(reach.as_ref(), arm.reach) && Range::holds(payload.as_ref(), arm.payload)
    });
    PyTuple::new(py, fitting.map(|arm| arm.name).collect::<Vec<_>>())
}

/// The figures that pass a filter.
struct Range {
    least: f64,
    most: f64,
}

impl Range {
    fn read(field: &str, unit: &str, filter: Option<&Bound<'_, PyAny>>) -> PyResult<Option<Self>> {
        let Some(filter) = filter else { return Ok(None) };
        // Python's bytes are pairs of numbers, and its truth values numbers, to those who ask.
        let no_number = filter.is_instance_of::<PyBytes>() || filter.is_instance_of::<PyBool>();
        let pair = filter
            .extract::<f64>()
            .map(|least| [least, f64::INFINITY])
            .or_else(|_| filter.extract::<[f64; 2]>());
        let [least, most] = pair.ok().filter(|_| !no_number).ok_or_else(|| {
            let got = filter.repr();
            let got = got.map_or_else(|_| "something else".into(), |repr| repr.to_string());
            PyValueError::new_err(format!(
                "{field} must be a number (at least that much) or a pair (least, most) [{unit}], \
                 got {got}"
            ))
        })?;
        for value in [least, most] {
            if value.is_nan() || value < 0.0 {
                return Err(PyValueError::new_err(format!(
                    "{field} is {value} {unit}, it must be 0 or more"
                )));
            }
        }
        // A payload may be that many kilograms; no arm reaches that many meters.
        if let Some(value) = [least, most]
            .into_iter()
            .find(|value| unit == "m" && value.is_finite() && *value > MOST_REACH)
        {
            return Err(PyValueError::new_err(format!(
                "{field} is {value} {unit}, it must be at most {MOST_REACH} {unit} (is it in \
                 millimeters?)"
            )));
        }
        if least > most {
            return Err(PyValueError::new_err(format!(
                "{field} is empty: least {least} {unit} > most {most} {unit}"
            )));
        }
        Ok(Some(Self { least, most }))
    }

    /// Whether a figure of an arm goes through a filter that may not be there.
    fn holds(filter: Option<&Self>, figure: Option<f64>) -> bool {
        filter.is_none_or(|range| {
            figure.is_some_and(|figure| (range.least..=range.most).contains(&figure))
        })
    }
}
