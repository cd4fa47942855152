//! `irbkin.rapid.check`: the moves of a module, checked.

use pyo3::prelude::*;
use pyo3::pybacked::PyBackedStr;
use pyo3::types::PyTuple;

use super::module::{RapidModule, close_names};
use super::program::Finding;
use crate::python::cell::PyCell;
use crate::python::errors::Fault;
use crate::python::robot::PyRobot;
use crate::python::trajectories::read_limits;
use crate::rapid::{self, Code, Module, MotionOptions};

/// Check every move of a module, of all routines.
///
/// A branch or a loop is checked from where the robot is before it. Behind one that moves, behind
/// a label and in a handler, the next move is checked as a target only.
///
/// Args:
///     robot: The arm. Work objects are given in the world, in which the robot's base is.
///     module: Module.
///     codes: The codes that are wanted, such as "C201"; without it all.
///     max_velocity: Limits [rad/s], a number or shape (6,); without it the robot's own. Without
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
///     InvalidModelError: The arm has no confdata: no spherical wrist, and it is not a GoFa of the
///         catalog.
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
    let cell = cell.map(|cell| &*cell.get().0);
    let arm = robot.get().arm();
    arm.check_rule()?;
    let robot = arm.six_joints("check")?;
    let options = MotionOptions {
        max_velocity: read_limits(max_velocity, "max_velocity")?,
        step,
        turn: turn.unwrap_or(MotionOptions::default().turn),
        ..MotionOptions::default()
    };
    let RapidModule { module, source, context, .. } = module.get();
    let found = py.detach(|| rapid::check(robot, module, source, &options, cell))?;
    let others = context.iter().map(|other| &other.get().module);
    let modules: Vec<&Module> = core::iter::once(module).chain(others).collect();
    let codes = codes.map(read_codes).transpose()?;
    let is_wanted = |code: Code| codes.as_ref().is_none_or(|codes| codes.contains(&code));
    let wanted = found.into_iter().filter(|finding| is_wanted(finding.code));
    let records = wanted.map(|finding| record(py, finding, &modules));
    PyTuple::new(py, records.collect::<PyResult<Vec<_>>>()?)
}

/// Codes by their ids.
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
fn record(py: Python<'_>, mut finding: rapid::Finding, modules: &[&Module]) -> PyResult<Finding> {
    if let Some(unknown) = &finding.unknown {
        let names = rapid::candidates(&finding, modules);
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let close = close_names(unknown, &names);
        if !close.is_empty() {
            finding.message = format!("{}; did you mean {}?", finding.message, close.join(", "));
        }
    }
    Finding::of(py, &finding)
}

/// Every code of a check, with its name and whether it is shown unless codes are selected.
#[pyfunction]
pub(crate) fn check_codes() -> Vec<(&'static str, &'static str, bool)> {
    Code::ALL.iter().map(|code| (code.id(), code.name(), code.is_default())).collect()
}
