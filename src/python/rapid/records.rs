//! RAPID's records from and to Python's.

use pyo3::prelude::*;
use pyo3::types::{PyBool, PyBytes, PyFloat, PyList, PyString, PyTuple};

use crate::kinematics::check_joints;
use crate::python::arrays::vector;
use crate::python::classes;
use crate::python::errors::{Fault, rapid_fault, to_py};
use crate::python::records as python_records;
use crate::rapid::{
    Content, JointTarget, LoadData, NOT_THERE, RapidPose, RobTarget, SpeedData, ToolData, Value,
    WobjData, ZoneData, joint_target as rapid_joint_target,
};
use crate::report::Configuration;

/// Most dimensions of an array.
const MOST_DIMENSIONS: usize = 3;

/// The Python record of a value.
pub(super) fn record<'py>(py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
    match value {
        Value::RobTarget(target) => rob_target(py, target),
        Value::JointTarget(target) => joint_target(py, target),
        Value::ToolData(tool) => {
            let (tframe, tload) = (pose(py, &tool.tframe)?, load(py, &tool.tload)?);
            classes::tool_data_class(py)?.call1((tool.robhold, tframe, tload))
        }
        Value::WobjData(WobjData { robhold, ufprog, ufmec, uframe, oframe }) => {
            let (uframe, oframe) = (pose(py, uframe)?, pose(py, oframe)?);
            classes::wobj_data_class(py)?.call1((robhold, ufprog, ufmec, uframe, oframe))
        }
        Value::Pose(frame) => pose(py, frame),
        Value::Pos(numbers) => Ok(PyTuple::new(py, numbers)?.into_any()),
        Value::Orient(numbers) => Ok(PyTuple::new(py, numbers)?.into_any()),
        Value::ConfData(configuration) => python_records::configuration(py, configuration),
        Value::ExtJoint(numbers) => Ok(PyTuple::new(py, numbers)?.into_any()),
        Value::LoadData(data) => load(py, data),
        Value::SpeedData(speed) => speed_data(py, speed),
        Value::ZoneData(zone) => zone_data(py, zone),
        Value::Num(number) => Ok(PyFloat::new(py, *number).into_any()),
    }
}

pub(super) fn rob_target<'py>(py: Python<'py>, target: &RobTarget) -> PyResult<Bound<'py, PyAny>> {
    let robconf = python_records::configuration(py, &target.robconf)?;
    classes::rob_target_class(py)?.call1((
        tuple(py, target.trans_mm)?,
        tuple(py, target.rot)?,
        robconf,
        tuple(py, target.extax)?,
    ))
}

pub(super) fn joint_target<'py>(
    py: Python<'py>,
    target: &JointTarget,
) -> PyResult<Bound<'py, PyAny>> {
    classes::joint_target_class(py)?.call1((tuple(py, target.robax_deg)?, tuple(py, target.extax)?))
}

fn pose<'py>(py: Python<'py>, pose: &RapidPose) -> PyResult<Bound<'py, PyAny>> {
    classes::rapid_pose_class(py)?.call1((tuple(py, pose.trans_mm)?, tuple(py, pose.rot)?))
}

fn load<'py>(py: Python<'py>, load: &LoadData) -> PyResult<Bound<'py, PyAny>> {
    let LoadData { mass_kg, cog_mm, aom, inertia } = load;
    classes::load_data_class(py)?.call1((
        mass_kg,
        tuple(py, *cog_mm)?,
        tuple(py, *aom)?,
        tuple(py, *inertia)?,
    ))
}

pub(super) fn speed_data<'py>(py: Python<'py>, speed: &SpeedData) -> PyResult<Bound<'py, PyAny>> {
    let SpeedData { v_tcp_mm_s, v_ori_deg_s, v_leax_mm_s, v_reax_deg_s } = *speed;
    classes::speed_data_class(py)?.call1((v_tcp_mm_s, v_ori_deg_s, v_leax_mm_s, v_reax_deg_s))
}

pub(super) fn zone_data<'py>(py: Python<'py>, zone: &ZoneData) -> PyResult<Bound<'py, PyAny>> {
    classes::zone_data_class(py)?.call1((
        zone.finep,
        zone.pzone_tcp_mm,
        zone.pzone_ori_mm,
        zone.pzone_eax_mm,
        zone.zone_ori_deg,
        zone.zone_leax_mm,
        zone.zone_reax_deg,
    ))
}

fn tuple<const N: usize>(py: Python<'_>, numbers: [f64; N]) -> PyResult<Bound<'_, PyTuple>> {
    PyTuple::new(py, numbers)
}

/// What a datum holds: a record, nested lists of records for an array, None without a value.
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
pub(super) struct Given {
    pub(super) sizes: Vec<usize>,
    pub(super) values: Vec<Value>,
}

/// What a Python object says that a datum holds; `thing` names it in errors.
pub(super) fn read_content(given: &Bound<'_, PyAny>, thing: &str) -> PyResult<Given> {
    read_array(given, thing, MOST_DIMENSIONS)
}

/// A value, or nested lists of at most so many dimensions.
fn read_array(given: &Bound<'_, PyAny>, thing: &str, dimensions: usize) -> PyResult<Given> {
    let Ok(list) = given.cast::<PyList>() else {
        return Ok(Given { sizes: Vec::new(), values: vec![read_value(given, thing)?] });
    };
    if dimensions == 0 || list.is_empty() {
        let message = format!(
            "{thing}: an array has one to {MOST_DIMENSIONS} dimensions and at least one element \
             in each"
        );
        return Err(rapid_fault(given.py(), message));
    }
    let mut all = Given { sizes: vec![list.len()], values: Vec::new() };
    for (number, element) in list.iter().enumerate() {
        let Given { sizes, values } = read_array(&element, thing, dimensions - 1)?;
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

#[derive(FromPyObject)]
struct PoseFields {
    trans_mm: [f64; 3],
    rot: [f64; 4],
}

#[derive(FromPyObject)]
struct RobTargetFields {
    trans_mm: [f64; 3],
    rot: [f64; 4],
    robconf: [i32; 4],
    extax: [f64; 6],
}

#[derive(FromPyObject)]
struct JointTargetFields {
    robax_deg: [f64; 6],
    extax: [f64; 6],
}

#[derive(FromPyObject)]
struct LoadFields {
    mass_kg: f64,
    cog_mm: [f64; 3],
    aom: [f64; 4],
    inertia: [f64; 3],
}

#[derive(FromPyObject)]
struct ToolFields {
    robhold: bool,
    tframe: PoseFields,
    tload: LoadFields,
}

#[derive(FromPyObject)]
struct WobjFields {
    robhold: bool,
    ufprog: bool,
    ufmec: String,
    uframe: PoseFields,
    oframe: PoseFields,
}

#[derive(FromPyObject)]
#[expect(clippy::struct_field_names, reason = "RAPID's names")]
struct SpeedFields {
    v_tcp_mm_s: f64,
    v_ori_deg_s: f64,
    v_leax_mm_s: f64,
    v_reax_deg_s: f64,
}

#[derive(FromPyObject)]
struct ZoneFields {
    finep: bool,
    pzone_tcp_mm: f64,
    pzone_ori_mm: f64,
    pzone_eax_mm: f64,
    zone_ori_deg: f64,
    zone_leax_mm: f64,
    zone_reax_deg: f64,
}

impl From<SpeedFields> for SpeedData {
    fn from(fields: SpeedFields) -> Self {
        let SpeedFields { v_tcp_mm_s, v_ori_deg_s, v_leax_mm_s, v_reax_deg_s } = fields;
        Self { v_tcp_mm_s, v_ori_deg_s, v_leax_mm_s, v_reax_deg_s }
    }
}

impl From<ZoneFields> for ZoneData {
    fn from(fields: ZoneFields) -> Self {
        Self {
            finep: fields.finep,
            pzone_tcp_mm: fields.pzone_tcp_mm,
            pzone_ori_mm: fields.pzone_ori_mm,
            pzone_eax_mm: fields.pzone_eax_mm,
            zone_ori_deg: fields.zone_ori_deg,
            zone_leax_mm: fields.zone_leax_mm,
            zone_reax_deg: fields.zone_reax_deg,
        }
    }
}

impl From<PoseFields> for RapidPose {
    fn from(PoseFields { trans_mm, rot }: PoseFields) -> Self {
        Self { trans_mm, rot }
    }
}

impl From<LoadFields> for LoadData {
    fn from(LoadFields { mass_kg, cog_mm, aom, inertia }: LoadFields) -> Self {
        Self { mass_kg, cog_mm, aom, inertia }
    }
}

pub(super) fn read_rob_target(given: &Bound<'_, PyAny>) -> PyResult<RobTarget> {
    demand(given, classes::rob_target_class(given.py())?, "target", "a RobTarget")?;
    let RobTargetFields { trans_mm, rot, robconf: [cf1, cf4, cf6, cfx], extax } =
        given.extract()?;
    Ok(RobTarget { trans_mm, rot, robconf: Configuration { cf1, cf4, cf6, cfx }, extax })
}

/// A jointtarget, or the joint angles [rad] of an arm with `dof` joints.
pub(super) fn read_joint_target(given: &Bound<'_, PyAny>, dof: usize) -> PyResult<JointTarget> {
    if given.is_instance(classes::joint_target_class(given.py())?)? {
        let JointTargetFields { robax_deg, extax } = given.extract()?;
        return Ok(JointTarget { robax_deg, extax });
    }
    if dof == 7 { of_vector::<7>(given) } else { of_vector::<6>(given) }
}

fn of_vector<const N: usize>(given: &Bound<'_, PyAny>) -> PyResult<JointTarget> {
    let q = vector::<N>(given, "joints", Fault::Joints)?;
    check_joints("joints", &q).map_err(|error| to_py(given.py(), &error))?;
    Ok(rapid_joint_target(&q, [NOT_THERE; 6]))
}

pub(super) fn read_tool(given: &Bound<'_, PyAny>) -> PyResult<ToolData> {
    demand(given, classes::tool_data_class(given.py())?, "tool", "a ToolData")?;
    let ToolFields { robhold, tframe, tload } = given.extract()?;
    Ok(ToolData { robhold, tframe: tframe.into(), tload: tload.into() })
}

pub(super) fn read_wobj(given: &Bound<'_, PyAny>) -> PyResult<WobjData> {
    demand(given, classes::wobj_data_class(given.py())?, "wobj", "a WobjData")?;
    let WobjFields { robhold, ufprog, ufmec, uframe, oframe } = given.extract()?;
    Ok(WobjData { robhold, ufprog, ufmec, uframe: uframe.into(), oframe: oframe.into() })
}

fn demand(
    given: &Bound<'_, PyAny>,
    class: &Bound<'_, PyAny>,
    field: &str,
    wanted: &str,
) -> PyResult<()> {
    if given.is_instance(class)? {
        return Ok(());
    }
    Err(rapid_fault(
        given.py(),
        format!("{field} must be {wanted}, got {}", given.get_type().name()?),
    ))
}

/// The value of a Python record; a tuple of 3 numbers is a pos, of 4 an orient, of 6 an extjoint.
fn read_value(given: &Bound<'_, PyAny>, thing: &str) -> PyResult<Value> {
    let py = given.py();
    let is = |class: PyResult<&Bound<'_, PyAny>>| given.is_instance(class?);
    let value = if is(classes::rob_target_class(py))? {
        Value::RobTarget(read_rob_target(given)?)
    } else if is(classes::joint_target_class(py))? {
        Value::JointTarget(read_joint_target(given, 6)?)
    } else if is(classes::tool_data_class(py))? {
        Value::ToolData(read_tool(given)?)
    } else if is(classes::wobj_data_class(py))? {
        Value::WobjData(read_wobj(given)?)
    } else if is(classes::rapid_pose_class(py))? {
        Value::Pose(given.extract::<PoseFields>()?.into())
    } else if is(classes::load_data_class(py))? {
        Value::LoadData(given.extract::<LoadFields>()?.into())
    } else if is(classes::speed_data_class(py))? {
        Value::SpeedData(given.extract::<SpeedFields>()?.into())
    } else if is(classes::zone_data_class(py))? {
        Value::ZoneData(given.extract::<ZoneFields>()?.into())
    } else if is(classes::configuration_class(py))? {
        let whole = given.extract::<[i32; 4]>();
        let [cf1, cf4, cf6, cfx] = whole.map_err(|_| {
            rapid_fault(
                py,
                format!("{thing}: {given} is not confdata, which has four whole numbers"),
            )
        })?;
        Value::ConfData(Configuration { cf1, cf4, cf6, cfx })
    } else {
        numbers(given, thing)?
    };
    Ok(value)
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
