//! `irbkin.rapid.motion`: a routine as one motion.

use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use super::checked::Finding;
use super::class::JointTarget;
use super::module::{RapidModule, counted};
use super::program::MotionMove;
use crate::arm::{ByJoints, SharedArm, configured, on};
use crate::arrays::vector;
use crate::errors::{Fault, exception};
use crate::outputs::{column, matrix, read_only};
use crate::robot::PyRobot;
use crate::trajectories::read_limits;
use crate::trajectory::PyTrajectory;
use irbkin::Robot;
use irbkin::pose::to_rows as pose_to_rows;
use irbkin_abb::rapid;
use irbkin_abb::rapid::{MotionOptions, RoutineMotion};

/// The moves of a routine as one motion: followed, timed and checked.
///
/// `motion` makes one. Frozen and picklable; a motion that is unpickled is made again.
#[pyclass(name = "RoutineMotion", module = "irbkin.rapid", eq, frozen)]
pub(crate) struct PyRoutineMotion {
    /// The routine; None for moves outside routines.
    #[pyo3(get)]
    routine: Option<String>,
    /// Duration [s]; without `max_acceleration` a kinematic lower bound, no cycle time.
    #[pyo3(get)]
    duration: f64,
    /// The joints over time: a Trajectory with these samples. Without `max_acceleration` the joints
    /// go evenly from sample to sample.
    #[pyo3(get)]
    trajectory: Py<PyTrajectory>,
    /// Times of the samples [s], shape (m,).
    #[pyo3(get)]
    t: Py<PyArray1<f64>>,
    /// Joint angles of the samples [rad], shape (m, 6), of a YuMi (m, 7).
    #[pyo3(get)]
    q: Py<PyArray2<f64>>,
    /// The move, by its index in `moves`, that each sample belongs to, shape (m,). A corner is
    /// shared by two: the sample halfway through it is the last one of the first move.
    #[pyo3(get)]
    move_index: Py<PyArray1<i64>>,
    /// Line of the instruction that each sample belongs to, shape (m,).
    #[pyo3(get)]
    lines: Py<PyArray1<i64>>,
    /// The moves of the routine, in order: a tuple of `MotionMove`.
    #[pyo3(get)]
    moves: Py<PyTuple>,
    /// The findings on moves, in order: a tuple of `Finding`.
    #[pyo3(get)]
    findings: Py<PyTuple>,
    motion: ByJoints<RoutineMotion, RoutineMotion<7>, RoutineMotion<5>>,
    robot: Py<PyRobot>,
    module: Py<RapidModule>,
    options: Py<PyDict>,
}

/// Make one motion of the moves of a routine: MoveAbsJ, MoveJ, MoveL and MoveC in order, each
/// followed from the joints before it, timed at its programmed speed and checked.
///
/// Everything that is wrong with a move is a finding, no error: an unknown value, a target out of
/// reach, a flip on the way, a singularity, another configuration than the target's, a joint too
/// fast at the programmed speed. A MoveL or MoveC that cannot be followed is replaced by a joint
/// move to its target; a move whose target has no joints is left out.
///
/// Args:
///     robot: The arm. Work objects are given in the world, in which the robot's base is.
///     module: Module.
///     routine: Name of the routine; without it main, or the only one that moves. Calls are
///         followed, into the module's context too, and loops with known bounds; other branches and
///         loops must not contain moves.
///     start: Joint angles [rad], shape (6,), or a JointTarget, from which the first move begins.
///         Without it the motion begins at the first target.
///     max_velocity: Limits [rad/s], a number or shape (6,); without it the robot's own.
///     max_acceleration: Limits [rad/s^2], a number or shape (6,). No catalog has them: without
///         them speeds change at once, and the duration is a kinematic lower bound.
///     step: Largest distance of the tool between two samples of a MoveL or MoveC [m].
///     turn: Largest turn of the tool between two samples of a MoveL or MoveC, and of a joint
///         between two of a MoveJ or MoveAbsJ [rad]; 5 deg without it.
///
/// Returns:
///     RoutineMotion. Its `findings` say what is wrong.
///
/// Raises:
///     RapidError: No such routine, no move in it, a branch, loop or jump around a move (with its
///         line), or not one move that can be made.
///     InvalidMotionError: A limit or a step that is not positive and finite, a robot without
///         velocities, or more than ten million samples.
///     InvalidJointsError: A start that is not finite or has a wrong shape.
///     InvalidModelError: The arm has no confdata: no spherical wrist, and it is not a GoFa
///         or YuMi of the catalog.
#[pyfunction]
#[pyo3(signature = (robot, module, routine=None, *, start=None, max_velocity=None,
    max_acceleration=None, step=0.005, turn=None))]
pub(crate) fn motion(
    robot: &Bound<'_, PyRobot>,
    module: &Bound<'_, RapidModule>,
    routine: Option<&str>,
    start: Option<&Bound<'_, PyAny>>,
    max_velocity: Option<&Bound<'_, PyAny>>,
    max_acceleration: Option<&Bound<'_, PyAny>>,
    step: f64,
    turn: Option<f64>,
) -> PyResult<PyRoutineMotion> {
    let arm = robot.get().arm();
    configured!(arm, robot => robot.configuration_rule().map(drop)).map_err(exception)?;
    let given = MotionArguments { start, max_velocity, max_acceleration, step, turn };
    match arm {
        SharedArm::Six(arm) => made(robot, arm, module, routine, &given, ByJoints::Six),
        SharedArm::Seven(arm) => made(robot, arm, module, routine, &given, ByJoints::Seven),
        SharedArm::Five(arm) => Err(exception(arm.lacks_configurations())),
    }
}

struct MotionArguments<'a, 'py> {
    start: Option<&'a Bound<'py, PyAny>>,
    max_velocity: Option<&'a Bound<'py, PyAny>>,
    max_acceleration: Option<&'a Bound<'py, PyAny>>,
    step: f64,
    turn: Option<f64>,
}

fn made<'py, const N: usize>(
    robot: &Bound<'py, PyRobot>,
    arm: &Robot<N>,
    module: &Bound<'py, RapidModule>,
    routine: Option<&str>,
    given: &MotionArguments<'_, 'py>,
    of_joints: impl Fn(RoutineMotion<N>) -> ByJoints<RoutineMotion, RoutineMotion<7>, RoutineMotion<5>>,
) -> PyResult<PyRoutineMotion> {
    let options = MotionOptions {
        start: given.start.map(read_start).transpose()?,
        max_velocity: read_limits(given.max_velocity, "max_velocity")?,
        max_acceleration: read_limits(given.max_acceleration, "max_acceleration")?,
        step: given.step,
        turn: given.turn.unwrap_or(MotionOptions::<N>::default().turn),
    };
    let (py, own) = (robot.py(), module.get());
    let context = own.context.iter().map(|other| &other.get().module);
    let modules: Vec<_> = core::iter::once(&own.module).chain(context).collect();
    let motion =
        py.detach(|| rapid::motion(arm, &modules, routine, &options)).map_err(exception)?;
    let index = |number: usize| i64::try_from(number).unwrap_or(-1);
    let line = |of: &usize| index(motion.moves.get(*of).map_or(0, |step| step.line));
    let trajectory = PyTrajectory::new(motion.trajectory.clone(), motion.t.clone())
        .with_names(arm.joint_names().map(<[String]>::to_vec));
    let q = PyArray1::from_slice(py, motion.q.as_flattened()).reshape([motion.q.len(), N])?;
    let moves = motion.moves.iter().map(|step| MotionMove::of(py, step));
    let findings = motion.findings.iter().map(|finding| Finding::of(py, finding));
    let findings = findings.collect::<PyResult<Vec<_>>>()?;
    Ok(PyRoutineMotion {
        routine: motion.routine.clone(),
        duration: motion.trajectory.duration(),
        trajectory: Py::new(py, trajectory)?,
        t: read_only(PyArray1::from_slice(py, &motion.t)),
        q: read_only(q),
        move_index: PyArray1::from_iter(py, motion.move_index.iter().copied().map(index)).unbind(),
        lines: PyArray1::from_iter(py, motion.move_index.iter().map(line)).unbind(),
        moves: PyTuple::new(py, moves)?.unbind(),
        findings: PyTuple::new(py, findings)?.unbind(),
        motion: of_joints(motion),
        robot: robot.clone().unbind(),
        module: module.clone().unbind(),
        options: keywords(py, &options)?,
    })
}

/// Options as keywords of a call that makes the motion again.
fn keywords<const N: usize>(py: Python<'_>, options: &MotionOptions<N>) -> PyResult<Py<PyDict>> {
    let MotionOptions { start, max_velocity, max_acceleration, step, turn } = options;
    let keywords = PyDict::new(py);
    keywords.set_item("start", start.map(Vec::from))?;
    keywords.set_item("max_velocity", max_velocity.map(Vec::from))?;
    keywords.set_item("max_acceleration", max_acceleration.map(Vec::from))?;
    keywords.set_item("step", step)?;
    keywords.set_item("turn", turn)?;
    Ok(keywords.unbind())
}

/// Joint angles [rad], or the joints of a JointTarget.
fn read_start<const N: usize>(given: &Bound<'_, PyAny>) -> PyResult<[f64; N]> {
    if let Ok(joints) = given.cast::<JointTarget>() {
        return Ok(rapid::joint_vector(&joints.get().0));
    }
    vector::<N>(given, "start", Fault::Joints)
}

impl PartialEq for PyRoutineMotion {
    fn eq(&self, other: &Self) -> bool {
        self.motion == other.motion
    }
}

/// Robot, module and routine of a motion.
type Made<'a> = (&'a Py<PyRobot>, &'a Py<RapidModule>, Option<&'a str>);

#[pymethods]
impl PyRoutineMotion {
    /// Return the motion as a module: a MoveAbsJ to the joints of each target that is met or
    /// passed, with its external axes, speed, zone, \T, tool and work object.
    ///
    /// Between the targets the joints move evenly. Tools and work objects are declared as
    /// PERS; speeds and zones that are not RAPID's own are written as numbers.
    ///
    /// Args:
    ///     name: Name of the module.
    ///
    /// Returns:
    ///     Module, which `dump` writes.
    ///
    /// Raises:
    ///     RapidError: The name is not a RAPID identifier.
    #[pyo3(signature = (name="Motion"))]
    fn to_module(&self, name: &str) -> PyResult<RapidModule> {
        let source =
            on!(&self.motion, motion => motion.to_module(name)).map_err(exception)?.to_string();
        // The module of its own text, as one that is read.
        Ok(RapidModule::new(rapid::parse(&source, &[]).map_err(exception)?, source, Vec::new()))
    }

    fn __len__(&self) -> usize {
        on!(&self.motion, motion => motion.t.len())
    }

    fn __repr__(&self) -> String {
        on!(&self.motion, motion => format!(
            "RoutineMotion({:?}: {}, {}, {:.3} s, {})",
            motion.routine.as_deref().unwrap_or(""),
            counted(motion.moves.len(), "move"),
            counted(motion.t.len(), "sample"),
            self.duration,
            counted(motion.findings.len(), "finding"),
        ))
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, Made<'_>)> {
        let options = self.options.bind(py);
        let motion = py.import("irbkin._core")?.getattr("motion")?;
        let again = py.import("functools")?.getattr("partial")?.call((motion,), Some(options))?;
        Ok((again, (&self.robot, &self.module, self.routine.as_deref())))
    }
}

impl MotionMove {
    fn of<const N: usize>(py: Python<'_>, step: &rapid::MotionMove<N>) -> Self {
        let rapid::MotionMove { kind, module, module_index, line, start, end, .. } = *step;
        let q = step.q.map(|q| column(py, q));
        let (length, as_programmed) = (step.length, step.as_programmed);
        Self {
            kind: kind.name().into(),
            module,
            module_index,
            line,
            start,
            end,
            length,
            q,
            as_programmed,
            tool: matrix(py, pose_to_rows(&step.tool).as_chunks::<4>().0).into_any().unbind(),
        }
    }
}
