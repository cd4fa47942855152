//! `irbkin.rapid`: modules read and written, `CalcJointT` and `CalcRobT`.

mod checks;
mod module;
mod records;
mod routine_motion;

use std::sync::Arc;

use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyTuple};

pub(super) use self::checks::{check, check_codes};
pub(super) use self::module::RapidModule;
use self::records::{
    Given, joint_target, read_content, read_joint_target, read_rob_target, read_tool, read_wobj,
    record, rob_target,
};
pub(super) use self::routine_motion::{PyRoutineMotion, motion, restore_motion};
use super::arm::{Arm, on};
use super::classes;
use super::configured::{Options, check_rule};
use super::errors::{rapid_fault, to_py};
use super::found::read_seed;
use super::robot::PyRobot;
use crate::error::Error;
use crate::kinematics::Robot;
use crate::rapid::{self, Content, Datum, Module, Storage, TableRow, ToolData, Value, WobjData};
use crate::report::Configuration;

/// Parse a RAPID module.
///
/// Args:
///     text: RAPID text, or the bytes of a file: UTF-8, UTF-16 with its mark, else Latin-1.
///     context: Modules in which names that the text does not declare are looked for: their data
///         that are not LOCAL.
///
/// Raises:
///     RapidError: The text is broken; the message and the attributes `line` and `column` have the
///         place.
#[pyfunction]
#[pyo3(signature = (text, context=None))]
pub(super) fn parse(
    text: &Bound<'_, PyAny>,
    context: Option<&Bound<'_, PyAny>>,
) -> PyResult<RapidModule> {
    let py = text.py();
    let source = decode(text)?;
    if is_path(&source) {
        let message = format!("{source:?} is a path, parse takes the text of a module: use load");
        return Err(rapid_fault(py, message));
    }
    let mut others = Vec::new();
    if let Some(context) = context {
        for other in context.try_iter()? {
            others.push(other?.cast_into::<RapidModule>()?);
        }
    }
    let context: Vec<&Module> = others.iter().map(|other| &other.get().module).collect();
    let module =
        py.detach(|| rapid::parse(&source, &context)).map_err(|error| to_py(py, &error))?;
    let context = others.into_iter().map(Bound::unbind).collect();
    Ok(RapidModule::new(module, source, context))
}

/// Whether a text is the path of a module: one word with its ending, which no RAPID text is.
fn is_path(text: &str) -> bool {
    let endings = [".mod", ".modx", ".sys", ".sysx", ".prg"];
    let (text, marks) = (text.trim().to_ascii_lowercase(), ['\n', ';', '[', '"', '!']);
    endings.iter().any(|ending| text.ends_with(ending)) && !text.contains(marks)
}

/// Return RAPID text from a str, or from the bytes of a file.
#[pyfunction]
pub(super) fn decode(text: &Bound<'_, PyAny>) -> PyResult<String> {
    match text.cast::<PyBytes>() {
        Ok(bytes) => Ok(rapid::decode(bytes.as_bytes()).into_owned()),
        Err(_) => text.extract(),
    }
}

/// Parse one value: a robtarget, jointtarget, tooldata, wobjdata, pose or loaddata, determined by
/// its shape.
#[pyfunction]
pub(super) fn parse_record<'py>(py: Python<'py>, text: &str) -> PyResult<Bound<'py, PyAny>> {
    record(py, &rapid::parse_record(text).map_err(|error| to_py(py, &error))?)
}

/// Return the RAPID text of a record, of a module, or of a mapping of names to values.
#[pyfunction]
pub(super) fn dump(value: &Bound<'_, PyAny>, name: &str) -> PyResult<String> {
    let py = value.py();
    if let Ok(module) = value.cast::<RapidModule>() {
        return Ok(module.get().module.to_string());
    }
    let module = |name: &str, data| {
        Module::new(Some(name.to_owned()), data, Vec::new(), &[]).map_err(|error| to_py(py, &error))
    };
    let Ok(data) = value.cast::<PyDict>() else {
        let datum = datum("value".to_owned(), value)?;
        let text = datum.content.to_string();
        // A module takes only what can be read again.
        return module("Value", vec![datum]).map(|_| text);
    };
    let name_of = |name: &Bound<'_, PyAny>| {
        name.extract().map_err(|_| {
            rapid_fault(
                py,
                format!("{name} is not a RAPID identifier (a letter, then letters, digits, _)"),
            )
        })
    };
    let data = data
        .iter()
        .map(|(name, value)| datum(name_of(&name)?, &value))
        .collect::<PyResult<Vec<_>>>()?;
    Ok(module(name, data)?.to_string())
}

/// The declaration of a Python record, or of nested lists of records.
fn datum(name: String, value: &Bound<'_, PyAny>) -> PyResult<Datum> {
    let Given { sizes, values } = read_content(value, &name)?;
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
///     tool: ToolData; the robot's own tool where not given.
///     wobj: WobjData; the world where not given.
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
///     InvalidModelError: The arm has no confdata: no spherical wrist, and it is no GoFa or YuMi of
///         the catalog.
#[pyfunction]
#[pyo3(signature = (robot, target, tool=None, wobj=None, *, fallback=None, seed=None))]
pub(super) fn calc_joint_t<'py>(
    robot: &Bound<'py, PyRobot>,
    target: &Bound<'py, PyAny>,
    tool: Option<&Bound<'py, PyAny>>,
    wobj: Option<&Bound<'py, PyAny>>,
    fallback: Option<&str>,
    seed: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let py = robot.py();
    let (arm, target) = (robot.get().arm(), read_rob_target(target)?);
    let Cell { tool, wobj } = Cell::read(py, arm, tool, wobj)?;
    let (tool, wobj) = (tool.as_ref(), wobj.as_ref());
    let joints = on!(arm, robot => {
        rapid::joint_target_of(robot, &target, tool, wobj, read_fallback(arm, fallback, seed)?)
    });
    joint_target(py, &joints.map_err(|error| named(py, &error))?)
}

/// Return the robtarget of a jointtarget, with its configuration, as RAPID's CalcRobT. Limits are
/// not checked.
///
/// Args:
///     robot: The arm. Work objects are given in the world, in which the robot's base is.
///     joints: JointTarget, or joint angles [rad], shape (n,).
///     tool: ToolData; the robot's own tool where not given.
///     wobj: WobjData; the world where not given.
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
) -> PyResult<Bound<'py, PyAny>> {
    let py = robot.py();
    let arm = robot.get().arm();
    let (joints, Cell { tool, wobj }) =
        (read_joint_target(joints, arm.dof())?, Cell::read(py, arm, tool, wobj)?);
    let (tool, wobj) = (tool.as_ref(), wobj.as_ref());
    let target = on!(arm, robot => rapid::rob_target_of(robot, &joints, tool, wobj));
    rob_target(py, &target.map_err(|error| to_py(py, &error))?)
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
///     TargetTable. `problems` says what is wrong with the target of a row.
///
/// Raises:
///     InvalidModelError: The arm has no confdata: no spherical wrist, and it is no GoFa or YuMi of
///         the catalog.
#[pyfunction]
#[pyo3(signature = (robot, module, *, fallback=None, seed=None))]
pub(super) fn calc_moves<'py>(
    robot: &Bound<'py, PyRobot>,
    module: &Bound<'py, RapidModule>,
    fallback: Option<&str>,
    seed: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let py = robot.py();
    let (arm, module) = (robot.get().arm(), &module.get().module);
    check_rule(py, arm)?;
    on!(arm, robot => {
        let fallback = read_fallback(arm, fallback, seed)?;
        let rows = py.detach(|| rapid::moves_table(robot, module, fallback));
        table(py, &rows.map_err(|error| to_py(py, &error))?)
    })
}

/// Return the joint angles of every robtarget that a module declares, in the order of the text, all
/// with one tool and work object.
///
/// Args:
///     robot: The arm.
///     module: Module.
///     tool: ToolData; the robot's own tool where not given.
///     wobj: WobjData; the world where not given.
///     fallback: With "nearest", a target whose configuration no solution has gets the one nearest
///         to the joints before it.
///     seed: Joint vector [rad] before the first target, shape (n,).
///
/// Returns:
///     TargetTable. `problems` says what is wrong with the target of a row.
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
) -> PyResult<Bound<'py, PyAny>> {
    let py = robot.py();
    let (arm, module) = (robot.get().arm(), &module.get().module);
    let Cell { tool, wobj } = Cell::read(py, arm, tool, wobj)?;
    let (tool, wobj) = (tool.as_ref(), wobj.as_ref());
    on!(arm, robot => {
        let fallback = read_fallback(arm, fallback, seed)?;
        let rows = py.detach(|| rapid::targets_table(robot, module, tool, wobj, fallback));
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
        let (tool, wobj) = (tool.map(read_tool).transpose()?, wobj.map(read_wobj).transpose()?);
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

/// What a seed [rad] is for.
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
    let told = value
        .setattr("rapid_error", name)
        .and_then(|()| value.setattr("args", (format!("{name}: {error}"),)));
    told.map_or_else(|failure| failure, |()| raised)
}

/// `irbkin.rapid.TargetTable`.
fn table<'py, const N: usize>(
    py: Python<'py>,
    rows: &[TableRow<N>],
) -> PyResult<Bound<'py, PyAny>> {
    let joints: Vec<f64> = rows.iter().flat_map(|row| row.q.unwrap_or([f64::NAN; N])).collect();
    let integers = |of: fn(&Configuration) -> i32| {
        PyArray1::from_iter(py, rows.iter().map(move |row| of(&row.configuration)))
    };
    let (cf1, cf4, cf6, cfx) =
        (integers(|c| c.cf1), integers(|c| c.cf4), integers(|c| c.cf6), integers(|c| c.cfx));
    let distance = |of: fn(&crate::kinematics::SingularDistances) -> f64| {
        PyArray1::from_iter(
            py,
            rows.iter().map(move |row| row.distances.as_ref().map_or(f64::NAN, of)),
        )
    };
    let fields = [
        PyTuple::new(py, rows.iter().map(|row| row.kind))?.into_any(),
        PyTuple::new(py, rows.iter().map(|row| &row.text))?.into_any(),
        PyArray1::from_iter(py, rows.iter().map(|row| i64::try_from(row.line).unwrap_or(0)))
            .into_any(),
        (PyArray1::from_vec(py, joints).reshape([rows.len(), N])? as Bound<'_, PyArray2<f64>>)
            .into_any(),
        classes::configuration_batch_class(py)?.call1((cf1, cf4, cf6, cfx))?,
        distance(|d| d.wrist).into_any(),
        distance(|d| d.elbow).into_any(),
        distance(|d| d.shoulder).into_any(),
        PyTuple::new(py, rows.iter().map(|row| row.problem.as_ref().map(ToString::to_string)))?
            .into_any(),
    ];
    classes::target_table_class(py)?.call1(PyTuple::new(py, fields)?)
}
