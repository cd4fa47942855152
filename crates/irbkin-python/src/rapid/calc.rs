//! `CalcJointT`, `CalcRobT`, and the targets of a module in one table.

use pyo3::prelude::*;
use pyo3::types::PyTuple;

use super::checked::Finding;
use super::class::{JointTarget, RobTarget, ToolData, WobjData};
use super::module::RapidModule;
use super::program::TargetTable;
use super::values::{read, read_joint_target};
use crate::arm::{SharedArm, configured};
use crate::configured::or_nearest;
use crate::errors::{exception, with_attributes};
use crate::outputs::{array, column};
use crate::records::ConfigurationBatch;
use crate::robot::PyRobot;
use crate::targets::read_seed;
use irbkin::{Configuration, SingularDistances};
use irbkin_abb::Error;
use irbkin_abb::rapid;
use irbkin_abb::rapid::TableRow;

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
pub(crate) fn calc_joint_t(
    robot: &Bound<'_, PyRobot>,
    target: &Bound<'_, PyAny>,
    tool: Option<&Bound<'_, PyAny>>,
    wobj: Option<&Bound<'_, PyAny>>,
    fallback: Option<&str>,
    seed: Option<&Bound<'_, PyAny>>,
) -> PyResult<JointTarget> {
    let arm = robot.get().arm();
    let RobTarget(target) = read(target, "target")?;
    let (tool, wobj) = tool_and_wobj(arm, tool, wobj)?;
    let (tool, wobj) = (tool.as_ref(), wobj.as_ref());
    let joints = configured!(arm, robot => {
        rapid::calc_joint_t_or(robot, &target, tool, wobj, read_fallback(arm, fallback, seed)?)
    });
    joints.map(JointTarget).map_err(named)
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
pub(crate) fn calc_rob_t(
    robot: &Bound<'_, PyRobot>,
    joints: &Bound<'_, PyAny>,
    tool: Option<&Bound<'_, PyAny>>,
    wobj: Option<&Bound<'_, PyAny>>,
) -> PyResult<RobTarget> {
    let arm = robot.get().arm();
    let joints = read_joint_target(joints, arm.dof())?;
    let (tool, wobj) = tool_and_wobj(arm, tool, wobj)?;
    let (tool, wobj) = (tool.as_ref(), wobj.as_ref());
    let target = configured!(arm, robot => rapid::calc_rob_t(robot, &joints, tool, wobj));
    Ok(RobTarget(target.map_err(exception)?))
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
pub(crate) fn calc_moves(
    robot: &Bound<'_, PyRobot>,
    module: &Bound<'_, RapidModule>,
    fallback: Option<&str>,
    seed: Option<&Bound<'_, PyAny>>,
) -> PyResult<TargetTable> {
    let py = robot.py();
    let (arm, module) = (robot.get().arm(), &module.get().module);
    configured!(arm, robot => robot.configuration_rule().map(drop)).map_err(exception)?;
    configured!(arm, robot => {
        let fallback = read_fallback(arm, fallback, seed)?;
        table(py, &py.detach(|| rapid::calc_moves(robot, module, fallback)).map_err(exception)?)
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
///     fallback: As of `calc_moves`.
///     seed: As of `calc_moves`.
///
/// Returns:
///     TargetTable. `findings` says what is wrong with the target of a row.
///
/// Raises:
///     InvalidPoseError, RapidError, InvalidModelError: As `calc_joint_t`, of the tool and the work
///         object.
#[pyfunction]
#[pyo3(signature = (robot, module, tool=None, wobj=None, *, fallback=None, seed=None))]
pub(crate) fn calc_targets(
    robot: &Bound<'_, PyRobot>,
    module: &Bound<'_, RapidModule>,
    tool: Option<&Bound<'_, PyAny>>,
    wobj: Option<&Bound<'_, PyAny>>,
    fallback: Option<&str>,
    seed: Option<&Bound<'_, PyAny>>,
) -> PyResult<TargetTable> {
    let py = robot.py();
    let (arm, module) = (robot.get().arm(), &module.get().module);
    let (tool, wobj) = tool_and_wobj(arm, tool, wobj)?;
    let (tool, wobj) = (tool.as_ref(), wobj.as_ref());
    configured!(arm, robot => {
        let fallback = read_fallback(arm, fallback, seed)?;
        let rows = py.detach(|| rapid::calc_targets(robot, module, tool, wobj, fallback));
        table(py, &rows.map_err(exception)?)
    })
}

/// A tool and a work object, of an arm that has configurations.
fn tool_and_wobj(
    arm: &SharedArm,
    tool: Option<&Bound<'_, PyAny>>,
    wobj: Option<&Bound<'_, PyAny>>,
) -> PyResult<(Option<rapid::ToolData>, Option<rapid::WobjData>)> {
    let tool = tool.map(|tool| read(tool, "tool")).transpose()?.map(|ToolData(tool)| tool);
    let wobj = wobj.map(|wobj| read(wobj, "wobj")).transpose()?.map(|WobjData(wobj)| wobj);
    configured!(arm, robot => robot.configuration_rule().map(drop)).map_err(exception)?;
    Ok((tool, wobj))
}

/// The fallback with a seed [rad].
fn read_fallback<const N: usize>(
    arm: &SharedArm,
    fallback: Option<&str>,
    seed: Option<&Bound<'_, PyAny>>,
) -> PyResult<rapid::Fallback<N>> {
    let or_nearest = or_nearest(arm, fallback, seed)?;
    let Some(seed) = seed else { return Ok(rapid::Fallback::None) };
    let seed = read_seed(seed)?;
    Ok(if or_nearest { rapid::Fallback::Nearest(seed) } else { rapid::Fallback::Near(seed) })
}

/// With RAPID's name of the error.
fn named(error: Error) -> PyErr {
    let Some(name) = rapid::error_name(&error) else { return exception(error) };
    let message = format!("{name}: {error}");
    with_attributes(exception(error), |value| {
        value.setattr("rapid_error", name)?;
        value.setattr("args", (message,))
    })
}

fn table<const N: usize>(py: Python<'_>, rows: &[TableRow<N>]) -> PyResult<TargetTable> {
    let joints = rows.iter().flat_map(|row| row.q.unwrap_or([f64::NAN; N]));
    let integers =
        |of: fn(&Configuration) -> i32| column(py, rows.iter().map(|row| of(&row.configuration)));
    let configuration = ConfigurationBatch {
        cf1: integers(|c| c.cf1),
        cf4: integers(|c| c.cf4),
        cf6: integers(|c| c.cf6),
        cfx: integers(|c| c.cfx),
    };
    let distance = |of: fn(&SingularDistances) -> f64| {
        column(py, rows.iter().map(|row| row.distances.as_ref().map_or(f64::NAN, of)))
    };
    let found = |row: &TableRow<N>| row.finding.as_ref().map(|it| Finding::of(py, it)).transpose();
    let findings = rows.iter().map(found).collect::<PyResult<Vec<_>>>()?;
    Ok(TargetTable {
        kinds: PyTuple::new(py, rows.iter().map(|row| row.kind))?.unbind(),
        names: PyTuple::new(py, rows.iter().map(|row| &row.text))?.unbind(),
        lines: column(py, rows.iter().map(|row| i64::try_from(row.line).unwrap_or(0))),
        q: array(py, joints, &[rows.len(), N])?,
        configuration: Py::new(py, configuration)?.into_any(),
        wrist: distance(|d| d.wrist),
        elbow: distance(|d| d.elbow),
        shoulder: distance(|d| d.shoulder),
        findings: PyTuple::new(py, findings)?.unbind(),
    })
}
