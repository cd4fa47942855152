//! Values of RAPID from and to Python.

use pyo3::PyClass;
use pyo3::conversion::FromPyObjectOwned;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyBytes, PyFloat, PyList, PyTuple};

use super::class;
use crate::arrays::vector;
use crate::errors::{Fault, exception};
use crate::records::Configuration;
use irbkin::internal::check_joints;
use irbkin_abb::rapid::internal::joint_target;
use irbkin_abb::rapid::{Content, JointTarget, NOT_THERE, Value};

/// Most dimensions of an array.
const MOST_DIMENSIONS: usize = 3;

pub(super) fn record<'py>(py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
    Ok(match value {
        Value::RobTarget(target) => Bound::new(py, class::RobTarget(*target))?.into_any(),
        Value::JointTarget(target) => Bound::new(py, class::JointTarget(*target))?.into_any(),
        Value::ToolData(tool) => Bound::new(py, class::ToolData(*tool))?.into_any(),
        Value::WobjData(wobj) => Bound::new(py, class::WobjData(wobj.clone()))?.into_any(),
        Value::Pose(pose) => Bound::new(py, class::RapidPose(*pose))?.into_any(),
        Value::LoadData(load) => Bound::new(py, class::LoadData(*load))?.into_any(),
        Value::SpeedData(speed) => Bound::new(py, class::SpeedData(*speed))?.into_any(),
        Value::ZoneData(zone) => Bound::new(py, class::ZoneData(*zone))?.into_any(),
        Value::ConfData(configuration) => {
            Bound::new(py, Configuration::from(*configuration))?.into_any()
        }
        Value::Pos(numbers) => PyTuple::new(py, numbers)?.into_any(),
        Value::Orient(numbers) => PyTuple::new(py, numbers)?.into_any(),
        Value::ExtJoint(numbers) => PyTuple::new(py, numbers)?.into_any(),
        Value::Num(number) | Value::Dnum(number) => PyFloat::new(py, *number).into_any(),
    })
}

/// The content of a datum: a record, nested lists of records for an array, None without a value.
pub(super) fn content<'py>(py: Python<'py>, content: &Content) -> PyResult<Bound<'py, PyAny>> {
    match content {
        Content::Uninitialized { .. } => Ok(py.None().into_bound(py)),
        Content::Single(value) => record(py, value),
        Content::Array { sizes, values } => nested(py, sizes, values),
    }
}

fn nested<'py>(py: Python<'py>, sizes: &[usize], values: &[Value]) -> PyResult<Bound<'py, PyAny>> {
    let [size, inner @ ..] = sizes else {
        return values
            .first()
            .map_or_else(|| Ok(py.None().into_bound(py)), |value| record(py, value));
    };
    let parts = values.chunks((values.len() / size).max(1)).map(|part| nested(py, inner, part));
    Ok(PyList::new(py, parts.collect::<PyResult<Vec<_>>>()?)?.into_any())
}

/// A value, or the elements of an array in nested lists, with the sizes of the array.
pub(super) struct Elements {
    pub(super) sizes: Vec<usize>,
    pub(super) values: Vec<Value>,
}

/// The content of a datum from Python; `thing` names it in messages.
pub(super) fn read_content(given: &Bound<'_, PyAny>, thing: &str) -> PyResult<Elements> {
    read_array(given, thing, MOST_DIMENSIONS)
}

/// A value, or nested lists of at most so many dimensions.
fn read_array(given: &Bound<'_, PyAny>, thing: &str, dimensions: usize) -> PyResult<Elements> {
    let Ok(list) = given.cast::<PyList>() else {
        return Ok(Elements { sizes: Vec::new(), values: vec![read_value(given, thing)?] });
    };
    if dimensions == 0 || list.is_empty() {
        return Err(Fault::Rapid.error(format_args!(
            "{thing}: an array has one to {MOST_DIMENSIONS} dimensions and at least one element in \
             each"
        )));
    }
    let mut all = Elements { sizes: vec![list.len()], values: Vec::new() };
    for (number, element) in list.iter().enumerate() {
        let Elements { sizes, values } = read_array(&element, thing, dimensions - 1)?;
        if number > 0 && all.sizes[1..] != sizes {
            return Err(Fault::Rapid.error(format_args!(
                "{thing}: its lists have different lengths, {:?} and {sizes:?}",
                &all.sizes[1..]
            )));
        }
        all.sizes.truncate(1);
        all.sizes.extend(sizes);
        all.values.extend(values);
    }
    Ok(all)
}

/// A record of a class, as an argument that messages name.
pub(super) fn read<'py, T>(given: &Bound<'py, PyAny>, field: &str) -> PyResult<T>
where
    T: PyClass + Clone + FromPyObjectOwned<'py>,
{
    given.extract().or_else(|_| {
        let (wanted, got) = (T::NAME, given.get_type().name()?);
        Err(Fault::Rapid.error(format_args!("{field} must be a {wanted}, got {got}")))
    })
}

/// A jointtarget, or the joint angles [rad] of an arm with `dof` joints.
pub(super) fn read_joint_target(given: &Bound<'_, PyAny>, dof: usize) -> PyResult<JointTarget> {
    if let Ok(class::JointTarget(joints)) = given.extract() {
        return Ok(joints);
    }
    if dof == 7 { of_vector::<7>(given) } else { of_vector::<6>(given) }
}

fn of_vector<const N: usize>(given: &Bound<'_, PyAny>) -> PyResult<JointTarget> {
    let q = vector::<N>(given, "joints", Fault::Joints)?;
    check_joints("joints", &q).map_err(exception)?;
    Ok(joint_target(&q, [NOT_THERE; 6]))
}

/// The value of a Python record; a tuple of 3 numbers is a pos, of 4 an orient, of 6 an extjoint.
fn read_value(given: &Bound<'_, PyAny>, thing: &str) -> PyResult<Value> {
    // A bool is a number for Python, and bytes are numbers.
    let is_other = given.is_instance_of::<PyBool>() || given.is_instance_of::<PyBytes>();
    if let (false, Some(value)) = (is_other, extracted(given)) {
        return Ok(value);
    }
    let got = given.repr()?;
    Err(Fault::Rapid.error(format_args!("{thing}: {got} is not RAPID data")))
}

fn extracted(given: &Bound<'_, PyAny>) -> Option<Value> {
    macro_rules! first_of {
        ($($pattern:pat => $value:expr,)*) => {
            $(if let Ok($pattern) = given.extract() {
                return Some($value);
            })*
        };
    }
    first_of! {
        class::RobTarget(target) => Value::RobTarget(target),
        class::JointTarget(target) => Value::JointTarget(target),
        class::ToolData(tool) => Value::ToolData(tool),
        class::WobjData(wobj) => Value::WobjData(wobj),
        class::RapidPose(pose) => Value::Pose(pose),
        Configuration { cf1, cf4, cf6, cfx } => {
            Value::ConfData(irbkin::Configuration { cf1, cf4, cf6, cfx })
        },
        class::LoadData(load) => Value::LoadData(load),
        class::SpeedData(speed) => Value::SpeedData(speed),
        class::ZoneData(zone) => Value::ZoneData(zone),
    }
    given
        .extract()
        .map(Value::Pos)
        .or_else(|_| given.extract().map(Value::Orient))
        .or_else(|_| given.extract().map(Value::ExtJoint))
        .or_else(|_| given.extract().map(Value::Num))
        .ok()
}
