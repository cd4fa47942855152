//! `irbkin.rapid.motion`: a routine as one motion.

use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyTuple;

use super::module::RapidModule;
use super::records::read_joint_target;
use super::six_joints;
use crate::python::arrays::vector;
use crate::python::classes;
use crate::python::errors::{Fault, to_py};
use crate::python::robot::PyRobot;
use crate::python::trajectories::read_each;
use crate::python::trajectory::PyTrajectory;
use crate::rapid::{self, Finding, MotionMove, MotionOptions, RoutineMotion};

/// The moves of a routine as one motion: followed, timed and checked.
///
/// `motion` makes one. Frozen and picklable; a motion that is unpickled is made again.
#[pyclass(name = "RoutineMotion", module = "irbkin.rapid", frozen)]
pub(crate) struct PyRoutineMotion {
    motion: RoutineMotion,
    robot: Py<PyRobot>,
    module: Py<RapidModule>,
    options: MotionOptions,
    trajectory: PyOnceLock<Py<PyTrajectory>>,
    t: PyOnceLock<Py<PyArray1<f64>>>,
    q: PyOnceLock<Py<PyArray2<f64>>>,
    moves: PyOnceLock<Py<PyTuple>>,
    findings: PyOnceLock<Py<PyTuple>>,
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
///     routine: Name of the routine; without it main, or the only one that moves. Its branches and
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
///     InvalidModelError: The arm has no confdata: no spherical wrist, and it is no GoFa of the
///         catalog.
#[pyfunction]
#[pyo3(signature = (robot, module, routine=None, *, start=None, max_velocity=None,
    max_acceleration=None, step=0.005, turn=None))]
#[expect(clippy::too_many_arguments, reason = "keywords of one call")]
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
    let start = start.map(read_start).transpose()?;
    let options = MotionOptions {
        start,
        max_velocity: read_limits(max_velocity, "max_velocity")?,
        max_acceleration: read_limits(max_acceleration, "max_acceleration")?,
        step,
        turn: turn.unwrap_or(MotionOptions::default().turn),
    };
    made(robot, module, routine, options)
}

/// A limit of each joint, if it is given.
pub(super) fn read_limits(
    given: Option<&Bound<'_, PyAny>>,
    field: &'static str,
) -> PyResult<Option<[f64; 6]>> {
    match given {
        None => Ok(None),
        Some(_) => Ok(read_each(given, field, 6, 0.0)?.vector(6).try_into().ok()),
    }
}

/// Joint angles [rad], or those of a JointTarget.
fn read_start(given: &Bound<'_, PyAny>) -> PyResult<[f64; 6]> {
    if given.is_instance(classes::joint_target_class(given.py())?)? {
        return Ok(read_joint_target(given, 6)?.robax_deg.map(f64::to_radians));
    }
    vector::<6>(given, "start", Fault::Joints)
}

fn made(
    robot: &Bound<'_, PyRobot>,
    module: &Bound<'_, RapidModule>,
    routine: Option<&str>,
    options: MotionOptions,
) -> PyResult<PyRoutineMotion> {
    let py = robot.py();
    let arm = six_joints(robot, "motion")?;
    let own = &module.get().module;
    let motion = py
        .detach(|| rapid::motion(arm, own, routine, &options))
        .map_err(|error| to_py(py, &error))?;
    Ok(PyRoutineMotion {
        motion,
        robot: robot.clone().unbind(),
        module: module.clone().unbind(),
        options,
        trajectory: PyOnceLock::new(),
        t: PyOnceLock::new(),
        q: PyOnceLock::new(),
        moves: PyOnceLock::new(),
        findings: PyOnceLock::new(),
    })
}

type Restored = (Py<PyRobot>, Py<RapidModule>, Option<String>, StoredOptions);

/// Start, velocities, accelerations, step and turn.
type StoredOptions = (Option<[f64; 6]>, Option<[f64; 6]>, Option<[f64; 6]>, f64, f64);

/// A pickled motion.
#[pyfunction(name = "_restore_motion")]
pub(crate) fn restore_motion(
    robot: &Bound<'_, PyRobot>,
    module: &Bound<'_, RapidModule>,
    routine: Option<&str>,
    options: StoredOptions,
) -> PyResult<PyRoutineMotion> {
    let (start, max_velocity, max_acceleration, step, turn) = options;
    let options = MotionOptions { start, max_velocity, max_acceleration, step, turn };
    made(robot, module, routine, options)
}

#[pymethods]
impl PyRoutineMotion {
    /// The routine; None for moves outside routines.
    #[getter]
    fn routine(&self) -> Option<&str> {
        self.motion.routine.as_deref()
    }

    /// Duration [s]; without `max_acceleration` a kinematic lower bound, no cycle time.
    #[getter]
    fn duration(&self) -> f64 {
        self.motion.trajectory.duration()
    }

    /// The joints over time: a Trajectory with these samples. Without `max_acceleration` the joints
    /// go evenly from sample to sample.
    #[getter]
    fn trajectory<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTrajectory>> {
        let trajectory = self.trajectory.get_or_try_init(py, || {
            let (trajectory, times) = (self.motion.trajectory.clone(), self.motion.t.clone());
            Py::new(py, PyTrajectory::new(py, trajectory, times)?)
        });
        Ok(trajectory?.bind(py).clone())
    }

    /// Times of the samples [s], shape (m,).
    #[getter]
    fn t<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let t = self.t.get_or_init(py, || {
            let t = PyArray1::from_slice(py, &self.motion.t);
            t.readwrite().make_nonwriteable();
            t.unbind()
        });
        t.bind(py).clone()
    }

    /// Joint angles of the samples [rad], shape (m, 6).
    #[getter]
    fn q<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let q = self.q.get_or_try_init(py, || {
            let q = PyArray1::from_slice(py, self.motion.q.as_flattened());
            let q = q.reshape([self.motion.q.len(), 6])?;
            q.readwrite().make_nonwriteable();
            Ok::<_, PyErr>(q.unbind())
        });
        Ok(q?.bind(py).clone())
    }

    /// The move, by its index in `moves`, that each sample belongs to, shape (m,). A corner is
    /// shared by two: the sample halfway through it is the last one of the first move.
    #[getter]
    fn move_index<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i64>> {
        let index = self.motion.move_index.iter().map(|index| i64::try_from(*index).unwrap_or(-1));
        PyArray1::from_iter(py, index)
    }

    /// Line of the instruction that each sample belongs to, shape (m,).
    #[getter]
    fn lines<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i64>> {
        let line = |index: &usize| self.motion.moves.get(*index).map_or(0, |step| step.line);
        let lines = self.motion.move_index.iter().map(line);
        PyArray1::from_iter(py, lines.map(|line| i64::try_from(line).unwrap_or(0)))
    }

    /// The moves of the routine, in order: a tuple of `MotionMove`.
    #[getter]
    fn moves<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let moves = self.moves.get_or_try_init(py, || {
            let moves = self.motion.moves.iter().map(|step| motion_move(py, step));
            Ok::<_, PyErr>(PyTuple::new(py, moves.collect::<PyResult<Vec<_>>>()?)?.unbind())
        });
        Ok(moves?.bind(py).clone())
    }

    /// What is wrong with moves, in order: a tuple of `Finding`.
    #[getter]
    fn findings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let findings = self.findings.get_or_try_init(py, || {
            let findings = self.motion.findings.iter().map(|finding| finding_record(py, finding));
            Ok::<_, PyErr>(PyTuple::new(py, findings.collect::<PyResult<Vec<_>>>()?)?.unbind())
        });
        Ok(findings?.bind(py).clone())
    }

    /// Return the motion as a module: a MoveAbsJ to the joints of each target that is met or
    /// passed, with its external axes, speed, zone, \T, tool and work object.
    ///
    /// The path between the targets is that of the joints. Tools and work objects are declared as
    /// PERS; speeds and zones that are not RAPID's own are written as numbers.
    ///
    /// Args:
    ///     name: Name of the module.
    ///
    /// Returns:
    ///     Module, which `dump` writes.
    ///
    /// Raises:
    ///     RapidError: The name is none.
    #[pyo3(signature = (name="Motion"))]
    fn to_module(&self, py: Python<'_>, name: &str) -> PyResult<RapidModule> {
        let module = self.motion.to_module(name).map_err(|error| to_py(py, &error))?;
        let source = module.to_string();
        // The module of its own text, as one that is read.
        let module = rapid::parse(&source, &[]).map_err(|error| to_py(py, &error))?;
        Ok(RapidModule::new(module, source, Vec::new()))
    }

    fn __len__(&self) -> usize {
        self.motion.t.len()
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        other.cast::<Self>().is_ok_and(|other| self.motion == other.get().motion)
    }

    fn __repr__(&self) -> String {
        let count = |number: usize, what: &str| {
            format!("{number} {what}{}", if number == 1 { "" } else { "s" })
        };
        format!(
            "RoutineMotion({:?}: {}, {}, {:.3} s, {})",
            self.motion.routine.as_deref().unwrap_or(""),
            count(self.motion.moves.len(), "move"),
            count(self.motion.t.len(), "sample"),
            self.duration(),
            count(self.motion.findings.len(), "finding"),
        )
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, Restored)> {
        let restore = py.import("irbkin._core")?.getattr("_restore_motion")?;
        let MotionOptions { start, max_velocity, max_acceleration, step, turn } = self.options;
        let options = (start, max_velocity, max_acceleration, step, turn);
        let (robot, module) = (self.robot.clone_ref(py), self.module.clone_ref(py));
        Ok((restore, (robot, module, self.motion.routine.clone(), options)))
    }
}

fn motion_move<'py>(py: Python<'py>, step: &MotionMove) -> PyResult<Bound<'py, PyAny>> {
    let q = step.q.map(|q| PyArray1::from_slice(py, &q));
    let MotionMove { kind, module_index, line, start, end, length, as_programmed, .. } = step;
    let fields = (kind.name(), module_index, line, start, end, length, q, as_programmed);
    classes::motion_move_class(py)?.call1(fields)
}

fn finding_record<'py>(py: Python<'py>, finding: &Finding) -> PyResult<Bound<'py, PyAny>> {
    let figures = finding.kind.value_and_bound();
    let fields = (
        finding.kind.name(),
        finding.move_index,
        finding.line,
        finding.column,
        finding.kind.joint(),
        figures.map(|[value, _]| value),
        figures.map(|[_, bound]| bound),
        finding.to_string(),
    );
    classes::finding_class(py)?.call1(fields)
}
