//! The Python module `irbkin._core`: convert, call, convert.
#![allow(
    non_snake_case,
    clippy::too_many_arguments,
    reason = "arguments are Python's keywords, a pose is T"
)]

/// Add classes and functions to a module.
macro_rules! add {
    ($module:ident: classes [$($class:ty,)+], functions [$($function:path,)+]) => {
        $($module.add_class::<$class>()?;)+
        $($module.add_function(wrap_pyfunction!($function, $module)?)?;)+
    };
}

mod arguments;
mod arm;
mod arrays;
mod bodies;
mod borrows;
mod catalog;
mod cell;
mod columns;
mod configured;
mod corrections;
mod egm;
mod errors;
mod figure;
mod follow;
mod follower;
mod found;
mod freedoms;
mod go;
mod guard;
mod heading;
mod inverse;
mod meshes;
mod models;
mod notebook;
mod outputs;
mod page;
mod plans;
mod poses;
mod queries;
mod rapid;
mod record;
mod records;
mod redundancy;
mod retiming;
mod robot;
mod shape_data;
mod shapes;
mod signals;
mod solution;
mod solutions;
mod state;
mod table;
mod targets;
mod tool_paths;
mod trajectories;
mod trajectory;

use crate::errors::exception;
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use self::arm::{SharedArm, on};
use self::cell::PyCell;
use self::errors::Fault;
use self::guard::Step;
use self::records::{
    Break, CatalogEntry, CellContact, CellDistance, Configuration, ConfigurationBatch,
    FollowResult, FreeJoint, IkBatch, IkMargin, Margin, MotionPeaks, Plan, PlanBreak, PoseCheck,
    Singularity, StrandEnd, ToolSpeedLimits, TrajectorySample,
};
use self::robot::PyRobot;
use self::shapes::{PyBody, PyShape};
use self::solution::PySolution;
use self::solutions::PySolutions;
use self::state::read;
use self::trajectory::PyTrajectory;
use irbkin::{InstructionSet, Solution, Status};

/// Return the name of the instruction set in use: "avx512", "avx2" or "baseline".
#[pyfunction]
fn instruction_set() -> &'static str {
    InstructionSet::in_use().name()
}

/// Return the names of the instruction sets that this CPU supports, the narrowest first.
#[pyfunction]
fn instruction_sets(py: Python<'_>) -> PyResult<Bound<'_, PyTuple>> {
    PyTuple::new(py, InstructionSet::available().map(InstructionSet::name).collect::<Vec<_>>())
}

/// Use another instruction set from now on, in the whole process: for tests and measurements.
///
/// Args:
///     name: One of `instruction_sets()`.
///
/// Raises:
///     ValueError: This CPU does not support it.
#[pyfunction]
fn use_instruction_set(name: &str) -> PyResult<()> {
    let set = InstructionSet::available().find(|set| set.name() == name).ok_or_else(|| {
        let known: Vec<_> = InstructionSet::available().map(InstructionSet::name).collect();
        PyValueError::new_err(format!(
            "the instruction set \"{name}\" is not supported by this CPU, which has {known:?}"
        ))
    })?;
    set.force().map_err(exception)
}

/// Restore a pickled value. Loading runs the checks of the constructors.
#[pyfunction(name = "_restore")]
fn restore<'py>(py: Python<'py>, kind: &str, state: &[u8]) -> PyResult<Bound<'py, PyAny>> {
    match kind {
        "Robot" => PyRobot::from(read::<SharedArm>(kind, state, |_| true)?).into_bound_py_any(py),
        "Solutions" => read(kind, state, is_whole)?.into_bound_py_any(py),
        "Solution" => {
            let is_whole =
                |one: &PySolution| on!(&one.of, it => fits(&it.solution, it.robot.slot_count()));
            read(kind, state, is_whole)?.into_bound_py_any(py)
        }
        "Shape" => PyShape(read(kind, state, |_| true)?).into_bound_py_any(py),
        "Body" => PyBody(read(kind, state, |_| true)?).into_bound_py_any(py),
        "Cell" => PyCell::from(read::<irbkin_motion::cell::Cell>(kind, state, |_| true)?)
            .into_bound_py_any(py),
        "Trajectory" => {
            let (motion, times, names) = read(kind, state, |_| true)?;
            PyTrajectory::new(motion, times).with_names(names).into_bound_py_any(py)
        }
        _ => Err(Fault::Model.error(format_args!("the pickled {kind} is damaged: unknown class"))),
    }
}

fn is_whole(solutions: &PySolutions) -> bool {
    on!(&solutions.found, found => {
        let slots = found.robot.slot_count();
        found.solutions.slot_count() == slots
            && found.solutions.is_consistent()
            && found.solutions.iter().chain(found.turned.iter().flatten()).all(|one| fits(one, slots))
    })
}

/// Whether slot, flags and free joint of a solution exist.
fn fits<const N: usize>(solution: &Solution<N>, slots: usize) -> bool {
    let of_others = Status::MERGED | Status::INVALID | Status::UNCERTIFIED;
    solution.slot.index() < slots
        && solution.status.contains(Status::FOUND)
        && !solution.status.intersects(of_others)
        && solution.free_joint.is_none_or(|free| (1..=N).contains(&free.joint()))
}

// Single calls read arrays under the interpreter's lock (`arrays::copied_vector`), and `borrows`
// relies on it.
#[pymodule(gil_used = true)]
fn _core(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    add!(module: classes [
        robot::PyRobot, solutions::PySolutions, solution::PySolution, Configuration,
        follower::PyFollower, trajectory::PyTrajectory, Break, CatalogEntry, ConfigurationBatch,
        FollowResult, FreeJoint, IkBatch, IkMargin, Margin, MotionPeaks, Plan, PlanBreak, PoseCheck,
        Singularity, StrandEnd, ToolSpeedLimits, TrajectorySample, PyShape, PyBody, PyCell,
        CellContact, CellDistance, page::PageEngine, guard::PyGuard, Step,
    ], functions [
        catalog::catalog, catalog::catalog_entry, instruction_set, instruction_sets,
        use_instruction_set, restore, poses::pose, poses::to_xyz_wxyz,
        poses::to_xyz_euler_zyx, trajectory::between, trajectories::joint,
        trajectories::spline, retiming::retime, retiming::at_tool_speed,
        models::urdf_links, models::urdf_swept, models::urdf_text, retiming::tool_speed_limits,
        tool_paths::line, tool_paths::arc, tool_paths::polyline, egm::encode, egm::decode,
    ]);
    // `spline` is taken by trajectories; `irbkin.paths` gives this one its name.
    module.add("path_spline", wrap_pyfunction!(tool_paths::spline, module)?)?;
    rapid::add(module)
}
