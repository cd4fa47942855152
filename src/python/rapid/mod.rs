//! `irbkin.rapid`: modules read and written, `CalcJointT` and `CalcRobT`.

mod checks;
mod module;
mod program;
mod records;
mod routine_motion;
mod values;

use std::sync::Arc;

use numpy::{PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyMapping, PyTuple};

pub(super) use self::checks::{check, check_codes};
pub(super) use self::module::{RapidModule, parse, parse_module};
use self::program::{Finding, TargetTable};
pub(super) use self::routine_motion::{PyRoutineMotion, motion};
use self::values::{Elements, read, read_content, read_joint_target};
use super::arm::{Arm, on};
use super::configured::{Options, check_rule};
use super::errors::{rapid_fault, to_py};
use super::found::read_seed;
use super::records::ConfigurationBatch;
use super::robot::PyRobot;
use crate::error::Error;
use crate::kinematics::{Robot, SingularDistances};
use crate::rapid::{
    self, Content, Datum, JointTarget, LoadData, Module, RapidPose, RobTarget, SpeedData, Storage,
    TableRow, ToolData, Value, WobjData, ZoneData,
};
use crate::report::Configuration;

/// Add the classes of records to the extension module.
pub(super) fn add_records(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("NOT_THERE", rapid::NOT_THERE)?;
    module.add_class::<RobTarget>()?;
    module.add_class::<JointTarget>()?;
    module.add_class::<ToolData>()?;
    module.add_class::<WobjData>()?;
    module.add_class::<RapidPose>()?;
    module.add_class::<LoadData>()?;
    module.add_class::<SpeedData>()?;
    module.add_class::<ZoneData>()?;
    module.add_class::<program::Declaration>()?;
    module.add_class::<program::Argument>()?;
    module.add_class::<program::MotionSettings>()?;
    module.add_class::<program::Move>()?;
    module.add_class::<program::MotionMove>()?;
    module.add_class::<program::Finding>()?;
    module.add_class::<program::Skipped>()?;
    module.add_class::<program::TargetTable>()
}

/// Return the RAPID text of a record, of a module, or of a mapping of names to values.
///
/// `parse` gives back modules with all their data, and single RobTarget, JointTarget, ToolData,
/// WobjData, Pose and LoadData. The text of any other single value belongs into a declaration:
/// alone its shape does not determine its type, and `parse` refuses it.
///
/// Args:
///     value: RobTarget, JointTarget, ToolData, WobjData, Pose, LoadData, SpeedData, ZoneData,
///         Configuration, a number, a tuple of 3 (pos), 4 (orient) or 6 (extjoint) numbers, nested
///         lists of these for an array: the text of the value. A Module, or a mapping of names to
///         values: the text of a module, with tools and work objects as PERS, others as CONST.
///     name: Name of the module that is made of a mapping.
///
/// Raises:
///     RapidError: A value is not RAPID data or not finite, or a name is not an identifier.
#[pyfunction]
#[pyo3(signature = (value, name="Data"))]
pub(super) fn dump(value: &Bound<'_, PyAny>, name: &str) -> PyResult<String> {
    let py = value.py();
    if let Ok(module) = value.cast::<RapidModule>() {
        return Ok(module.get().module.to_string());
    }
    let module = |name: &str, data| {
        Module::new(Some(name.to_owned()), data, Vec::new(), &[]).map_err(|error| to_py(py, &error))
    };
    let Ok(data) = value.cast::<PyMapping>() else {
        let datum = datum("value".to_owned(), value)?;
        let text = datum.content.to_string();
        // A module takes only what can be read again.
        return module("Value", vec![datum]).map(|_| text);
    };
    let mut declared = Vec::new();
    for item in data.items()? {
        let (name, value): (Bound<'_, PyAny>, Bound<'_, PyAny>) = item.extract()?;
        let name = name.extract().map_err(|_| {
            let message =
                format!("{name} is not a RAPID identifier (a letter, then letters, digits, _)");
            rapid_fault(py, message)
        })?;
        declared.push(datum(name, &value)?);
    }
    Ok(module(name, declared)?.to_string())
}

/// The declaration of a Python record, or of nested lists of records.
fn datum(name: String, value: &Bound<'_, PyAny>) -> PyResult<Datum> {
    let Elements { sizes, values } = read_content(value, &name)?;
    let first = values.first().cloned().unwrap_or(Value::Num(0.0));
    // A controller keeps tools and work objects where it can change them.
    let storage = match first {
        Value::ToolData(_) | Value::WobjData(_) => Storage::Pers,
        _ => Storage::Const,
    };
    let datum = Datum::single(name, storage, first);
    let is_single = sizes.is_empty();
    Ok(if is_single { datum } else { Datum { content: Content::Array { sizes, values }, ..datum } })
}

/// Return the jointtarget of a robtarget, as RAPID's CalcJointT: joint angles inside the limits
/// that have its configuration.
///
/// Args:
///     robot: The arm. Work objects are given in the world, in which the robot's base is.
///     target: RobTarget.
///     tool: ToolData; by default the robot's own tool.
///     wobj: WobjData; by default the world.
///     fallback: With "nearest", the solution nearest to `seed` where none has the configuration.
///     seed: Joint vector [rad], shape (n,), of the fallback, and to which the solution of a GoFa
///         is the nearest where its configuration names two.
///
/// Returns:
///     JointTarget, with the target's external axes. eax_a of a YuMi is the arm angle in the target
///     and axis 7 in the answer.
///
/// Raises:
///     UnreachableError: Its `rapid_error` is "ERR_OUTSIDE_REACH" where the arm is too short or too
///         long, "ERR_ROBLIMIT" where solutions exist but none inside the limits with the
///         configuration; `configurations` has those that exist.
///     InvalidPoseError: A quaternion's norm is off one by more than 2e-3.
///     InvalidJointsError: The arm has no such cfx.
///     RapidError: The robot holds both tool and work object or neither, or a mechanical unit moves
///         the work object.
///     InvalidModelError: The arm has no confdata: no spherical wrist, and it is not a GoFa or YuMi
///         of the catalog.
#[pyfunction]
#[pyo3(signature = (robot, target, tool=None, wobj=None, *, fallback=None, seed=None))]
pub(super) fn calc_joint_t<'py>(
    robot: &Bound<'py, PyRobot>,
    target: &Bound<'py, PyAny>,
    tool: Option<&Bound<'py, PyAny>>,
    wobj: Option<&Bound<'py, PyAny>>,
    fallback: Option<&str>,
    seed: Option<&Bound<'py, PyAny>>,
) -> PyResult<JointTarget> {
    let py = robot.py();
    let (arm, target) = (robot.get().arm(), read(target, "target")?);
    let Cell { tool, wobj } = Cell::read(py, arm, tool, wobj)?;
    let (tool, wobj) = (tool.as_ref(), wobj.as_ref());
    let joints = on!(arm, robot => {
        rapid::calc_joint_t_or(robot, &target, tool, wobj, read_fallback(arm, fallback, seed)?)
    });
    joints.map_err(|error| named(py, &error))
}

/// Return the robtarget of a jointtarget, with its configuration, as RAPID's CalcRobT. Limits are
/// not checked.
///
/// Args:
///     robot: The arm. Work objects are given in the world, in which the robot's base is.
///     joints: JointTarget, or joint angles [rad], shape (n,).
///     tool: ToolData; by default the robot's own tool.
///     wobj: WobjData; by default the world.
///
/// Returns:
///     RobTarget, with the external axes of `joints`; eax_a of a YuMi is its arm angle.
///
/// Raises:
///     InvalidPoseError, RapidError, InvalidModelError: As `calc_joint_t`.
#[pyfunction]
#[pyo3(signature = (robot, joints, tool=None, wobj=None))]
pub(super) fn calc_rob_t<'py>(
    robot: &Bound<'py, PyRobot>,
    joints: &Bound<'py, PyAny>,
    tool: Option<&Bound<'py, PyAny>>,
    wobj: Option<&Bound<'py, PyAny>>,
) -> PyResult<RobTarget> {
    let py = robot.py();
    let arm = robot.get().arm();
    let (joints, Cell { tool, wobj }) =
        (read_joint_target(joints, arm.dof())?, Cell::read(py, arm, tool, wobj)?);
    let (tool, wobj) = (tool.as_ref(), wobj.as_ref());
    let target = on!(arm, robot => rapid::calc_rob_t(robot, &joints, tool, wobj));
    target.map_err(|error| to_py(py, &error))
}

/// Return the joint angles of every target of a module's moves, in their order, each with its own
/// tool and work object; a MoveC has two. The motion between targets is not checked: `follow` does.
///
/// Args:
///     robot: The arm.
///     module: Module.
///     fallback: With "nearest", a target whose configuration no solution has gets the one nearest
///         to the joints before it.
///     seed: Joint vector [rad] before the first target, shape (n,).
///
/// Returns:
///     TargetTable. `findings` says what is wrong with the target of a row.
///
/// Raises:
///     InvalidModelError: The arm has no confdata: no spherical wrist, and it is not a GoFa or YuMi
///         of the catalog.
#[pyfunction]
#[pyo3(signature = (robot, module, *, fallback=None, seed=None))]
pub(super) fn calc_moves<'py>(
    robot: &Bound<'py, PyRobot>,
    module: &Bound<'py, RapidModule>,
    fallback: Option<&str>,
    seed: Option<&Bound<'py, PyAny>>,
) -> PyResult<TargetTable> {
    let py = robot.py();
    let (arm, module) = (robot.get().arm(), &module.get().module);
    check_rule(py, arm)?;
    on!(arm, robot => {
        let fallback = read_fallback(arm, fallback, seed)?;
        let rows = py.detach(|| rapid::calc_moves(robot, module, fallback));
        table(py, &rows.map_err(|error| to_py(py, &error))?)
    })
}

/// Return the joint angles of every robtarget that a module declares, in the order of the text, all
/// with one tool and work object.
///
/// Args:
///     robot: The arm.
///     module: Module.
///     tool: ToolData; by default the robot's own tool.
///     wobj: WobjData; by default the world.
///     fallback: With "nearest", a target whose configuration no solution has gets the one nearest
///         to the joints before it.
///     seed: Joint vector [rad] before the first target, shape (n,).
///
/// Returns:
///     TargetTable. `findings` says what is wrong with the target of a row.
///
/// Raises:
///     InvalidPoseError, RapidError, InvalidModelError: As `calc_joint_t`, of the tool and the work
///         object.
#[pyfunction]
#[pyo3(signature = (robot, module, tool=None, wobj=None, *, fallback=None, seed=None))]
pub(super) fn calc_targets<'py>(
    robot: &Bound<'py, PyRobot>,
    module: &Bound<'py, RapidModule>,
    tool: Option<&Bound<'py, PyAny>>,
    wobj: Option<&Bound<'py, PyAny>>,
    fallback: Option<&str>,
    seed: Option<&Bound<'py, PyAny>>,
) -> PyResult<TargetTable> {
    let py = robot.py();
    let (arm, module) = (robot.get().arm(), &module.get().module);
    let Cell { tool, wobj } = Cell::read(py, arm, tool, wobj)?;
    let (tool, wobj) = (tool.as_ref(), wobj.as_ref());
    on!(arm, robot => {
        let fallback = read_fallback(arm, fallback, seed)?;
        let rows = py.detach(|| rapid::calc_targets(robot, module, tool, wobj, fallback));
        table(py, &rows.map_err(|error| to_py(py, &error))?)
    })
}

/// A tool and a work object, of an arm that has configurations.
struct Cell {
    tool: Option<ToolData>,
    wobj: Option<WobjData>,
}

impl Cell {
    fn read(
        py: Python<'_>,
        arm: &Arm,
        tool: Option<&Bound<'_, PyAny>>,
        wobj: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let (tool, wobj) = (
            tool.map(|tool| read(tool, "tool")).transpose()?,
            wobj.map(|wobj| read(wobj, "wobj")).transpose()?,
        );
        check_rule(py, arm)?;
        Ok(Self { tool, wobj })
    }
}

/// The robot of a call that follows moves.
fn six_joints<'a>(robot: &'a Bound<'_, PyRobot>, call: &str) -> PyResult<&'a Arc<Robot<6>>> {
    let (py, arm) = (robot.py(), robot.get().arm());
    check_rule(py, arm)?;
    arm.six_joints(py, call)
}

/// The fallback with a seed [rad].
fn read_fallback<const N: usize>(
    arm: &Arm,
    fallback: Option<&str>,
    seed: Option<&Bound<'_, PyAny>>,
) -> PyResult<rapid::Fallback<N>> {
    let or_nearest = Options { arm_angle: None, fallback, seed }.or_nearest(arm)?;
    let Some(seed) = seed else { return Ok(rapid::Fallback::None) };
    let (seed, _) = read_seed::<N>(seed, None)?;
    Ok(if or_nearest { rapid::Fallback::Nearest(seed) } else { rapid::Fallback::Near(seed) })
}

/// With RAPID's name of the error.
fn named(py: Python<'_>, error: &Error) -> PyErr {
    let raised = to_py(py, error);
    let Some(name) = rapid::error_name(error) else { return raised };
    let value = raised.value(py);
    let set = value
        .setattr("rapid_error", name)
        .and_then(|()| value.setattr("args", (format!("{name}: {error}"),)));
    set.map_or_else(|failure| failure, |()| raised)
}

/// The rows as arrays.
fn table<const N: usize>(py: Python<'_>, rows: &[TableRow<N>]) -> PyResult<TargetTable> {
    let joints: Vec<f64> = rows.iter().flat_map(|row| row.q.unwrap_or([f64::NAN; N])).collect();
    let integers = |of: fn(&Configuration) -> i32| {
        let each = rows.iter().map(move |row| of(&row.configuration));
        PyArray1::from_iter(py, each).into_any().unbind()
    };
    let configuration = ConfigurationBatch {
        cf1: integers(|c| c.cf1),
        cf4: integers(|c| c.cf4),
        cf6: integers(|c| c.cf6),
        cfx: integers(|c| c.cfx),
    };
    let distance = |of: fn(&SingularDistances) -> f64| {
        let each = rows.iter().map(move |row| row.distances.as_ref().map_or(f64::NAN, of));
        PyArray1::from_iter(py, each).into_any().unbind()
    };
    let lines = rows.iter().map(|row| i64::try_from(row.line).unwrap_or(0));
    let found = |row: &TableRow<N>| row.finding.as_ref().map(|it| Finding::of(py, it)).transpose();
    let findings = rows.iter().map(found).collect::<PyResult<Vec<_>>>()?;
    Ok(TargetTable {
        kinds: PyTuple::new(py, rows.iter().map(|row| row.kind))?.unbind(),
        names: PyTuple::new(py, rows.iter().map(|row| &row.text))?.unbind(),
        lines: PyArray1::from_iter(py, lines).into_any().unbind(),
        q: PyArray1::from_vec(py, joints).reshape([rows.len(), N])?.into_any().unbind(),
        configuration: Py::new(py, configuration)?.into_any(),
        wrist: distance(|d| d.wrist),
        elbow: distance(|d| d.elbow),
        shoulder: distance(|d| d.shoulder),
        findings: PyTuple::new(py, findings)?.unbind(),
    })
}
