//! `irbkin.catalog`.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyBytes, PyTuple};

use crate::catalog::catalog as every_arm;
use crate::kinematics::thresholds::MOST_REACH;

/// Names of the robots in the catalog, ABB's by type number first; of all, or of those that reach
/// and carry what is asked for.
///
/// Args:
///     reach: Reach as the type name or the data sheet has it [m]: a number for at least that much,
///         a pair for (least, most).
///     payload: Payload [kg], in the same way.
///
/// Returns:
///     Names in catalog order. An arm whose reach or payload is not known is in no answer that asks
///     for it.
///
/// Raises:
///     ValueError: A filter is neither a number nor a pair, is NaN or negative, or its least is
///         more than its most.
#[pyfunction]
#[pyo3(signature = (*, reach=None, payload=None))]
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

/// What a filter lets through.
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
            let got = filter.repr().map_or_else(|_| "something else".into(), |repr| repr.to_string());
            PyValueError::new_err(format!("{field} must be a number (at least that much) or a pair (least, most) [{unit}], got {got}"))
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
