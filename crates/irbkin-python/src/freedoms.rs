//! Freedoms of `Robot.plan`: the tuples of `irbkin.freedom`.

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyString};

use super::arguments::{AXES, one_of};
use super::arrays::{Rows, vector};
use super::errors::{Fault, exception};
use irbkin_motion::internal::MOST_TOOL_ANGLES;
use irbkin_motion::plan::{ExternalAxis, ToolAxis, ToolCone, ToolRotation};

/// A tuple of `irbkin.freedom`, as the argument `field`.
struct Fields<'a, 'py> {
    tuple: &'a Bound<'py, PyAny>,
    field: &'a str,
}

impl<'py> Fields<'_, 'py> {
    fn get(&self, name: &str, wanted: &str) -> PyResult<(Bound<'py, PyAny>, PyErr)> {
        let value = self.tuple.getattr(name)?;
        let error = format!("{name} of {} must be {wanted}, got {}", self.field, value.repr()?);
        Ok((value, PyTypeError::new_err(error)))
    }

    fn number(&self, name: &str) -> PyResult<f64> {
        let (value, error) = self.get(name, "a number")?;
        value.extract().map_err(|_| error)
    }

    /// A count; a negative number becomes one that is out of bounds.
    fn count(&self, name: &str) -> PyResult<usize> {
        let (value, error) = self.get(name, "a whole number")?;
        count(&value).ok_or(error)
    }

    fn axis(&self, name: &str) -> PyResult<ToolAxis> {
        let (value, error) = self.get(name, "\"x\", \"y\" or \"z\"")?;
        let word: String = value.extract().map_err(|_| error)?;
        one_of("axis", &word, &AXES)
    }

    /// A letter, or three numbers.
    fn direction(&self, name: &str) -> PyResult<[f64; 3]> {
        let (value, _) = self.get(name, "a direction")?;
        if !value.is_instance_of::<PyString>() {
            return vector::<3>(&value, "axis", Fault::Motion);
        }
        Ok(match self.axis(name)? {
            ToolAxis::X => [1.0, 0.0, 0.0],
            ToolAxis::Y => [0.0, 1.0, 0.0],
            ToolAxis::Z => [0.0, 0.0, 1.0],
        })
    }
}

/// The count that is nearest to a whole number; `None` for any other value.
fn count(value: &Bound<'_, PyAny>) -> Option<usize> {
    if value.is_instance_of::<PyBool>() {
        return None;
    }
    let count: i128 = value.extract().ok()?;
    // A negative number is outside the bounds that the message names.
    Some(usize::try_from(count.clamp(0, MOST_TOOL_ANGLES as i128 + 1)).unwrap_or_default())
}

/// A rotation from a number of steps or from `irbkin.ToolRotation`.
pub(super) fn read_rotation(rotation: &Bound<'_, PyAny>) -> PyResult<ToolRotation> {
    let made = if rotation.is_instance(&class(rotation.py(), "ToolRotation")?)? {
        let fields = Fields { tuple: rotation, field: "rotation" };
        let (lower, upper) = (fields.number("lower")?, fields.number("upper")?);
        ToolRotation::new(fields.count("steps")?, lower, upper, fields.axis("axis")?)
    } else {
        let wanted = "rotation must be an irbkin.ToolRotation or a number of angles";
        ToolRotation::full(count(rotation).ok_or_else(|| other(wanted, rotation))?)
    };
    made.map_err(exception)
}

pub(super) fn read_redundancy(given: &Bound<'_, PyAny>) -> PyResult<usize> {
    count(given).ok_or_else(|| other("redundancy must be a number of angles", given))
}

/// External axes from `irbkin.Track`, `irbkin.Positioner`, or several of them.
pub(super) fn read_carrier(carrier: &Bound<'_, PyAny>) -> PyResult<Vec<ExternalAxis>> {
    let wanted = "carrier must be an irbkin.Track, an irbkin.Positioner, or a sequence of them";
    let kinds = [class(carrier.py(), "Track")?, class(carrier.py(), "Positioner")?];
    let mut axes = Vec::new();
    for one in &each(carrier, &kinds, wanted)? {
        let is_track = one.is_instance(&kinds[0])?;
        let fields = Fields { tuple: one, field: if is_track { "Track" } else { "Positioner" } };
        let (lower, upper) = (fields.number("lower")?, fields.number("upper")?);
        let (direction, steps) = (fields.direction("axis")?, fields.count("steps")?);
        let made = if is_track {
            ExternalAxis::track(direction, lower, upper, steps)
        } else {
            let point = vector::<3>(&one.getattr("point")?, "point", Fault::Motion)?;
            ExternalAxis::positioner(point, direction, lower, upper, steps)
        };
        let (max_velocity, weight) = (fields.number("max_velocity")?, fields.number("weight")?);
        let made = made.and_then(|axis| axis.with_max_velocity(max_velocity)?.with_weight(weight));
        axes.push(made.map_err(exception)?);
    }
    Ok(axes)
}

/// A tolerance from `irbkin.ToolCone`.
pub(super) fn read_tolerance(tolerance: &Bound<'_, PyAny>) -> PyResult<ToolCone> {
    if !tolerance.is_instance(&class(tolerance.py(), "ToolCone")?)? {
        return Err(other("tolerance must be an irbkin.ToolCone", tolerance));
    }
    let fields = Fields { tuple: tolerance, field: "ToolCone" };
    ToolCone::new(fields.number("angle")?, fields.count("steps")?).map_err(exception)
}

/// A class of `irbkin.freedom`.
pub(super) fn class<'py>(py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
    py.import("irbkin.freedom")?.getattr(name)
}

/// One object of two classes, or each of a sequence of them.
fn each<'py>(
    given: &Bound<'py, PyAny>,
    classes: &[Bound<'py, PyAny>; 2],
    wanted: &str,
) -> PyResult<Vec<Bound<'py, PyAny>>> {
    let fits = |one: &Bound<'py, PyAny>| -> PyResult<bool> {
        Ok(one.is_instance(&classes[0])? || one.is_instance(&classes[1])?)
    };
    if fits(given)? {
        return Ok(vec![given.clone()]);
    }
    let all = given.try_iter().map_err(|_| other(wanted, given))?.collect::<PyResult<Vec<_>>>()?;
    for one in &all {
        if !fits(one)? {
            return Err(other(wanted, given));
        }
    }
    Ok(all)
}

fn other(wanted: &str, got: &Bound<'_, PyAny>) -> PyErr {
    let got = got.repr().map_or_else(|_| String::new(), |text| format!(", got {text}"));
    PyTypeError::new_err(format!("{wanted}{got}"))
}

/// The joint vector of an end, with the values of external axes behind it.
pub(super) fn read_end<const N: usize>(
    given: Option<&Bound<'_, PyAny>>,
    field: &'static str,
    external: usize,
) -> PyResult<(Option<[f64; N]>, Vec<f64>)> {
    let Some(given) = given else { return Ok((None, Vec::new())) };
    if external == 0 {
        return Ok((Some(vector::<N>(given, field, Fault::Joints)?), Vec::new()));
    }
    let count = N + external;
    let wanted = || format!("({count},): {N} joint angles and {external} external axes");
    let rows = Rows::shaped(given, wanted, field, Fault::Joints, |shape| shape == [count])?;
    let (q, values) = rows.data()?.split_at(N);
    Ok((q.try_into().ok(), values.to_vec()))
}
