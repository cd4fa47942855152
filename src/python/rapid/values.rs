//! Values of RAPID from and to Python.

use pyo3::PyClass;
use pyo3::conversion::FromPyObjectOwned;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyBytes, PyFloat, PyList, PyString, PyTuple};

use crate::kinematics::check_joints;
use crate::python::arrays::vector;
use crate::python::errors::{Fault, rapid_fault, to_py};
use crate::rapid::{
    Content, JointTarget, LoadData, NOT_THERE, RapidPose, RobTarget, SpeedData, ToolData, Value,
    WobjData, ZoneData, joint_target,
};
use crate::report::Configuration;

/// Most dimensions of an array.
const MOST_DIMENSIONS: usize = 3;

/// The Python record of a value.
pub(super) fn record<'py>(py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
    Ok(match value {
        Value::RobTarget(target) => Bound::new(py, *target)?.into_any(),
        Value::JointTarget(target) => Bound::new(py, *target)?.into_any(),
        Value::ToolData(tool) => Bound::new(py, *tool)?.into_any(),
        Value::WobjData(wobj) => Bound::new(py, wobj.clone())?.into_any(),
        Value::Pose(pose) => Bound::new(py, *pose)?.into_any(),
        Value::LoadData(load) => Bound::new(py, *load)?.into_any(),
        Value::SpeedData(speed) => Bound::new(py, *speed)?.into_any(),
        Value::ZoneData(zone) => Bound::new(py, *zone)?.into_any(),
        Value::ConfData(configuration) => Bound::new(py, *configuration)?.into_any(),
        Value::Pos(numbers) => PyTuple::new(py, numbers)?.into_any(),
        Value::Orient(numbers) => PyTuple::new(py, numbers)?.into_any(),
        Value::ExtJoint(numbers) => PyTuple::new(py, numbers)?.into_any(),
        Value::Num(number) => PyFloat::new(py, *number).into_any(),
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
        let message = format!(
            "{thing}: an array has one to {MOST_DIMENSIONS} dimensions and at least one element \
             in each"
        );
        return Err(rapid_fault(given.py(), message));
    }
    let mut all = Elements { sizes: vec![list.len()], values: Vec::new() };
    for (number, element) in list.iter().enumerate() {
        let Elements { sizes, values } = read_array(&element, thing, dimensions - 1)?;
        if number > 0 && all.sizes[1..] != sizes {
            let message = format!(
                "{thing}: its lists have different lengths, {:?} and {sizes:?}",
                &all.sizes[1..]
            );
            return Err(rapid_fault(given.py(), message));
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
        let message = format!("{field} must be a {wanted}, got {got}");
        Err(rapid_fault(given.py(), message))
    })
}

/// A jointtarget, or the joint angles [rad] of an arm with `dof` joints.
pub(super) fn read_joint_target(given: &Bound<'_, PyAny>, dof: usize) -> PyResult<JointTarget> {
    if let Ok(joints) = given.extract() {
        return Ok(joints);
    }
    if dof == 7 { of_vector::<7>(given) } else { of_vector::<6>(given) }
}

fn of_vector<const N: usize>(given: &Bound<'_, PyAny>) -> PyResult<JointTarget> {
    let q = vector::<N>(given, "joints", Fault::Joints)?;
    check_joints("joints", &q).map_err(|error| to_py(given.py(), &error))?;
    Ok(joint_target(&q, [NOT_THERE; 6]))
}

/// The value of a Python record; a tuple of 3 numbers is a pos, of 4 an orient, of 6 an extjoint.
fn read_value(given: &Bound<'_, PyAny>, thing: &str) -> PyResult<Value> {
    macro_rules! records {
        ($($Record:ident as $Name:ident),*) => {$(
            if let Ok(record) = given.cast::<$Record>() {
                return Ok(Value::$Name(record.get().clone()));
            }
        )*};
    }
    records!(
        RobTarget as RobTarget,
        JointTarget as JointTarget,
        ToolData as ToolData,
        WobjData as WobjData,
        RapidPose as Pose,
        LoadData as LoadData,
        SpeedData as SpeedData,
        ZoneData as ZoneData,
        Configuration as ConfData
    );
    numbers(given, thing)
}

/// A number, or a tuple or an array of numbers.
fn numbers(given: &Bound<'_, PyAny>, thing: &str) -> PyResult<Value> {
    let refused =
        || Ok(rapid_fault(given.py(), format!("{thing}: {} is not RAPID data", given.repr()?)));
    if given.is_instance_of::<PyBool>()
        || given.is_instance_of::<PyString>()
        || given.is_instance_of::<PyBytes>()
    {
        return refused().and_then(Err);
    }
    if let Ok(number) = given.extract::<f64>() {
        return Ok(Value::Num(number));
    }
    match given.extract::<Vec<f64>>().ok().as_deref() {
        Some(&[x, y, z]) => Ok(Value::Pos([x, y, z])),
        Some(&[w, x, y, z]) => Ok(Value::Orient([w, x, y, z])),
        Some(&[a, b, c, d, e, f]) => Ok(Value::ExtJoint([a, b, c, d, e, f])),
        _ => refused().and_then(Err),
    }
}
