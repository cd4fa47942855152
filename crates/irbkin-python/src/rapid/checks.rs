//! `irbkin.rapid.check`: the moves of a module, checked.

use std::collections::BTreeMap;

use pyo3::prelude::*;
use pyo3::pybacked::PyBackedStr;
use pyo3::types::PyTuple;

use super::checked::{Checked, CheckedMove, Finding};
use super::class;
use super::module::{RapidModule, close_names};
use crate::arm::{SharedArm, configured};
use crate::bodies::Shapes;
use crate::cell::PyCell;
use crate::errors::{Fault, exception};
use crate::records::Configuration;
use crate::robot::PyRobot;
use crate::signals::detached_until;
use crate::targets::{read_frame, read_pose};
use crate::trajectories::read_limits;
use irbkin::Robot;
use irbkin_abb::rapid;
use irbkin_abb::rapid::internal::{GivenTools, rapid_pose};
use irbkin_abb::rapid::{
    CheckOptions, Code, Module, MotionOptions, ToolData, Unit, UnitAxis, Units,
};
use irbkin_motion::Arm;

/// Check every move of a module, of all routines.
///
/// Routines are followed from `main` through calls, with their arguments; those that nothing calls,
/// by themselves. A branch is checked from where the robot is before it, a loop in each pass if its
/// bounds are known and else in the first. Behind a branch that moves, behind a label and in a
/// handler, the next move is checked as a target only.
///
/// Args:
///     robot: The arm. Work objects are given in the world, in which the robot's base is.
///     module: Module; calls of routines of its context are followed, too.
///     codes: The codes that are wanted, such as "C201"; without it all but U807: unused names.
///     max_velocity: Limits [rad/s], a number or one an axis; without it the robot's own. Without
///         either no joint is found to be too fast.
///     step: Largest distance of the tool between two samples of a MoveL or MoveC [m].
///     turn: Largest turn of the tool between two samples [rad]; 5 deg without it.
///     cell: An `irbkin.Cell` in which each move is proven to touch nothing; without it collisions
///         are not looked for.
///
/// Returns:
///     A tuple of `Finding`, in the order of the text.
///
/// Raises:
///     RapidError: A code that does not exist.
///     InvalidMotionError: A limit or a step that is not positive and finite, or more than ten
///         million samples.
///     InvalidModelError: The arm has no confdata: no spherical wrist, and it is not a GoFa
///         or YuMi of the catalog.
#[pyfunction]
#[pyo3(signature = (robot, module, *, codes=None, max_velocity=None, step=0.005, turn=None, cell=None))]
pub(crate) fn check<'py>(
    robot: &Bound<'py, PyRobot>,
    module: &Bound<'py, RapidModule>,
    codes: Option<&Bound<'py, PyAny>>,
    max_velocity: Option<&Bound<'py, PyAny>>,
    step: f64,
    turn: Option<f64>,
    cell: Option<&Bound<'py, PyCell>>,
) -> PyResult<Bound<'py, PyTuple>> {
    let py = robot.py();
    let context = module.get().context.iter().map(|other| other.bind(py).clone());
    let modules: Vec<_> = core::iter::once(module.clone()).chain(context).collect();
    let codes = codes.map(read_codes).transpose()?;
    let found = configured!(robot.get().arm(), arm => {
        let options = CheckOptions {
            codes: codes.as_deref(),
            motion: read_motion(max_velocity, step, turn)?,
            cell: cell.map(|cell| &*cell.get().cell),
            ..CheckOptions::default()
        };
        checked(py, arm, &modules, options)?
    });
    let is_own = |it: &Bound<'_, PyAny>| it.cast::<Finding>().is_ok_and(|it| it.get().module == 0);
    PyTuple::new(py, found.findings.bind(py).iter().filter(is_own).collect::<Vec<_>>())
}

/// Check every move of a program: modules that know each other.
///
/// Args:
///     robot: The arm. Work objects are given in the world, in which the robot's base is.
///     modules: Module of the task; each is parsed with the others as its context.
///     codes: As of `check`.
///     max_velocity: As of `check`.
///     step: As of `check`.
///     turn: As of `check`.
///     cell: As of `check`.
///     units: The mechanical units of the controller: tuples of a name, whether it carries the
///         robot, whether its axes are determined, and its axes: tuples of the external axis from
///         0, the frame of shape (4, 4) [m], and whether it turns about its z axis or else moves
///         along its x axis. An external axis of no unit, which is not at zero, is not checked.
///     last_values: Whether a PERS that the program assigns has the value of its declaration, which
///         it had when it was saved; what is found with it is a note.
///     tools: A ToolData or a pose of the TCP in the flange, shape (4, 4) [m], for each tool that
///         nothing declares, by its name; None is for all others. What is found with it is a note.
///     carried: Shapes in the flange frame, by the name of the tool or work object they move with.
///     whole: Whether every module of the task is given: a call of what none declares is an error
///         then, and a note if some are missing. None if it is not known.
///     of_system: Indices of modules of the system that do not say so by their attributes: a call
///         of what none declares is a note there.
///     tasks: Names and modules of the controller's tasks, this one first; no modules of one that
///         lacks some. The points at which tasks wait for each other are compared.
///     signals: Names of the controller's signals: any other name that nothing declares is wrong.
///         Without them such names may be signals, which is a note.
///
/// Returns:
///     `Checked`.
///
/// Raises:
///     RapidError: A code that does not exist.
///     InvalidMotionError: As of `check`.
///     InvalidModelError: As of `check`.
#[pyfunction]
#[pyo3(signature = (robot, modules, *, codes=None, max_velocity=None, step=0.005, turn=None,
    cell=None, units=None, last_values=false, tools=None, whole=None, of_system=None,
    signals=None, carried=None, tasks=None))]
#[expect(clippy::needless_pass_by_value, reason = "a sequence is extracted by value")]
pub(crate) fn check_program<'py>(
    robot: &Bound<'py, PyRobot>,
    modules: Vec<Bound<'py, RapidModule>>,
    codes: Option<&Bound<'py, PyAny>>,
    max_velocity: Option<&Bound<'py, PyAny>>,
    step: f64,
    turn: Option<f64>,
    cell: Option<&Bound<'py, PyCell>>,
    units: Option<Vec<GivenUnit<'py>>>,
    last_values: bool,
    tools: Option<NamedTools<'py>>,
    whole: Option<bool>,
    of_system: Option<Vec<usize>>,
    signals: Option<Vec<String>>,
    carried: Option<BTreeMap<String, Shapes<'py>>>,
    tasks: Option<Vec<(String, Vec<Bound<'py, RapidModule>>)>>,
) -> PyResult<Checked> {
    let py = robot.py();
    let units = read_units(units)?;
    let carried = carried.into_iter().flatten();
    let carried = carried.map(|(name, shapes)| (name.to_lowercase(), shapes.read())).collect();
    let tools = read_tools(tools)?;
    let signals = signals.map(|all| all.iter().map(|it| it.to_lowercase()).collect());
    let tasks = tasks.unwrap_or_default();
    let tasks = tasks.iter().map(|(name, modules)| {
        let modules = modules.iter().map(|it| &it.get().module);
        (name.as_str(), modules.collect())
    });
    let tasks: Vec<_> = tasks.collect();
    let codes = codes.map(read_codes).transpose()?;
    configured!(robot.get().arm(), arm => {
        let options = CheckOptions {
            codes: codes.as_deref(),
            motion: read_motion(max_velocity, step, turn)?,
            cell: cell.map(|cell| &*cell.get().cell),
            units: Some(&units),
            takes_last: last_values,
            tools: Some(&tools),
            is_whole: whole,
            of_system: of_system.as_deref().unwrap_or_default(),
            signals: signals.as_ref(),
            tasks: &tasks,
            carried: Some(&carried),
            ..CheckOptions::default()
        };
        checked(py, arm, &modules, options)
    })
}

/// Solve the confdata of a program anew for another arm.
///
/// Args:
///     robot: The arm. Work objects are given in the world, in which its base is.
///     modules: As of `check_program`.
///     tagged: The same with a number for each confdata that is written, and 1,000,000 more, as its
///         cf1.
///     source: The arm before, to whose postures the new ones are the nearest; without it each is
///         the nearest to the one at the target before.
///     units: As of `check_program`.
///     last_values: As of `check_program`.
///     tools: As of `check_program`.
///
/// Returns:
///     The confdata that change, by their numbers.
///
/// Raises:
///     InvalidModelError: As of `check`, of either arm; one with seven joints.
#[pyfunction]
#[pyo3(signature = (robot, modules, tagged, *, source=None, units=None, last_values=false,
    tools=None))]
#[expect(clippy::needless_pass_by_value, reason = "a sequence is extracted by value")]
pub(crate) fn port_program<'py>(
    robot: &Bound<'py, PyRobot>,
    modules: Vec<Bound<'py, RapidModule>>,
    tagged: Vec<Bound<'py, RapidModule>>,
    source: Option<&Bound<'py, PyRobot>>,
    units: Option<Vec<GivenUnit<'py>>>,
    last_values: bool,
    tools: Option<NamedTools<'py>>,
) -> PyResult<Vec<(usize, Configuration)>> {
    let units = read_units(units)?;
    let tools = read_tools(tools)?;
    let arm = six_joints(robot, "robot")?;
    let source = source.map(|it| six_joints(it, "source")).transpose()?;
    let [modules, tagged]: [Vec<&Module>; 2] =
        [&modules, &tagged].map(|all| all.iter().map(|it| &it.get().module).collect());
    let changed = detached_until(robot.py(), |interrupt| {
        let options = CheckOptions {
            units: Some(&units),
            takes_last: last_values,
            tools: Some(&tools),
            interrupt,
            ..CheckOptions::default()
        };
        rapid::port(arm, source, [&modules, &tagged], &options)
    })?
    .map_err(exception)?;
    Ok(changed.into_iter().map(|(number, it)| (number, Configuration::from(it))).collect())
}

fn six_joints<'a>(robot: &'a Bound<'_, PyRobot>, argument: &str) -> PyResult<&'a Robot<6>> {
    match robot.get().arm() {
        SharedArm::Six(arm) => Ok(arm),
        SharedArm::Five(arm) => Err(exception(arm.lacks_configurations())),
        SharedArm::Seven(arm) => Err(Fault::Model.error(format_args!(
            "{argument} is {}, which has seven joints: programs of six are ported",
            arm.name()
        ))),
    }
}

/// Tools as Python gives them, by their names.
type NamedTools<'py> = BTreeMap<Option<String>, Bound<'py, PyAny>>;

fn read_tools(tools: Option<NamedTools<'_>>) -> PyResult<GivenTools> {
    let tools = tools.into_iter().flatten();
    tools.map(|(name, it)| Ok((name.map(|name| name.to_lowercase()), read_tool(&it)?))).collect()
}

fn read_units(units: Option<Vec<GivenUnit<'_>>>) -> PyResult<Units> {
    let units = units.unwrap_or_default().into_iter().map(read_unit);
    Ok(Units(units.collect::<PyResult<Vec<_>>>()?))
}

/// A unit as Python gives it.
type GivenUnit<'py> = (String, bool, bool, Vec<(usize, Bound<'py, PyAny>, bool)>);

fn read_unit((name, is_carrier, is_determined, axes): GivenUnit<'_>) -> PyResult<Unit> {
    let axis = |(external, frame, is_rotation): (usize, Bound<'_, PyAny>, bool)| {
        if external >= 6 {
            return Err(Fault::Rapid.error(format_args!(
                "units: {name} has the external axis {external}, there are 0 to 5"
            )));
        }
        Ok(UnitAxis { external, frame: read_pose(&frame)?, is_rotation })
    };
    let axes = axes.into_iter().map(axis).collect::<PyResult<Vec<_>>>()?;
    Ok(Unit { name: name.clone(), axes, is_carrier, is_determined })
}

/// A tooldata, or one of a pose.
fn read_tool(given: &Bound<'_, PyAny>) -> PyResult<ToolData> {
    if let Ok(tool) = given.cast::<class::ToolData>() {
        return Ok(tool.get().0);
    }
    let tframe = rapid_pose(&read_frame(given, "check_program")?);
    Ok(ToolData { tframe, ..ToolData::TOOL0 })
}

/// How the moves of a program are followed.
fn read_motion<const N: usize>(
    max_velocity: Option<&Bound<'_, PyAny>>,
    step: f64,
    turn: Option<f64>,
) -> PyResult<MotionOptions<N>> {
    let max_velocity = read_limits(max_velocity, "max_velocity")?;
    let default = MotionOptions::default();
    Ok(MotionOptions { max_velocity, step, turn: turn.unwrap_or(default.turn), ..default })
}

/// A check, with the findings of the wanted codes.
fn checked<const N: usize>(
    py: Python<'_>,
    arm: &Arm<N>,
    modules: &[Bound<'_, RapidModule>],
    options: CheckOptions<'_, N>,
) -> PyResult<Checked> {
    let own: Vec<&RapidModule> = modules.iter().map(Bound::get).collect();
    let texts: Vec<_> = own.iter().map(|it| (&it.module, it.source.as_str())).collect();
    let rapid::Checked { findings, moves } = detached_until(py, |interrupt| {
        rapid::check(arm, &texts, &CheckOptions { interrupt, ..options })
    })?
    .map_err(exception)?;
    let modules: Vec<&Module> = own.iter().map(|it| &it.module).collect();
    let mut left = MOST_COMPARED;
    let findings = findings.into_iter().map(|it| record(py, it, &modules, &mut left));
    let moves = moves.into_iter().map(|step| CheckedMove::of(py, step));
    Ok(Checked {
        findings: PyTuple::new(py, findings.collect::<PyResult<Vec<_>>>()?)?.unbind(),
        moves: PyTuple::new(py, moves)?.unbind(),
    })
}

/// Pairs of letters of unknown and of known names that are compared [1]: 0.1 s. Of many unknown
/// names the last have no suggestion.
const MOST_COMPARED: usize = 40_000_000;

fn read_codes(given: &Bound<'_, PyAny>) -> PyResult<Vec<Code>> {
    let mut codes = Vec::new();
    for id in given.try_iter()? {
        let id: PyBackedStr = id?.extract()?;
        let found = Code::ALL.into_iter().find(|code| code.id() == &*id);
        codes.push(found.ok_or_else(|| {
            let ids = Code::ALL.map(Code::id).join(", ");
            Fault::Rapid.error(format_args!("codes: {id:?} is no code; there are {ids}"))
        })?);
    }
    Ok(codes)
}

/// A finding; its message names what an unknown name could mean.
fn record(
    py: Python<'_>,
    mut finding: rapid::Finding,
    modules: &[&Module],
    left: &mut usize,
) -> PyResult<Finding> {
    py.check_signals()?;
    if let Some(unknown) = finding.unknown.as_ref().filter(|_| *left > 0) {
        let names = rapid::candidates(&finding, modules);
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let letters: usize = names.iter().map(|name| name.len()).sum();
        *left = left.saturating_sub(letters.saturating_mul(unknown.len()));
        let close = match finding.code {
            Code::UnknownSpeed | Code::UnknownZone => beside(unknown, &names),
            _ => close_names(unknown, &names),
        };
        if !close.is_empty() {
            finding.message = format!("{}; did you mean {}?", finding.message, close.join(", "));
        } else if finding.code == Code::UnknownTool {
            finding.message = format!("{}; give it with --tool {unknown}=X Y Z", finding.message);
        }
    }
    Finding::of(py, &finding)
}

/// The names with the next lower and the next higher number, v200 and v300 of v250; those that are
/// spelled alike, if a name is no number behind a letter.
fn beside<'a>(wanted: &str, known: &[&'a str]) -> Vec<&'a str> {
    let number = |name: &str| name.get(1..)?.parse::<u32>().ok();
    let Some(own) = number(wanted) else { return close_names(wanted, known) };
    let is_alike = |it: &&&str| {
        it.get(..1).zip(wanted.get(..1)).is_some_and(|(a, b)| a.eq_ignore_ascii_case(b))
    };
    let numbered = || known.iter().filter(is_alike).filter_map(|it| Some((number(it)?, *it)));
    let lower = numbered().filter(|(it, _)| *it < own).max();
    let higher = numbered().filter(|(it, _)| *it > own).min();
    [lower, higher].into_iter().flatten().map(|(_, name)| name).collect()
}

/// Every code of a check: code, name, severity, whether it is shown without a selection.
#[pyfunction]
pub(crate) fn check_codes() -> Vec<(&'static str, &'static str, &'static str, bool)> {
    let row = |code: Code| (code.id(), code.name(), code.severity().id(), code.is_default());
    Code::ALL.map(row).to_vec()
}
