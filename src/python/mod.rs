//! The Python module `irbkin._core`: convert, call, convert.

mod arguments;
mod arm;
mod arrays;
mod batches;
mod borrows;
mod catalog;
mod classes;
mod configured;
mod corrections;
mod errors;
mod found;
mod freedoms;
mod inverse;
mod locked;
mod models;
mod nearest;
mod outputs;
mod paths;
mod plan_batches;
mod plans;
mod poses;
mod queries;
mod rapid;
mod record;
mod records;
mod redundancy;
mod restored;
mod retiming;
mod robot;
mod signals;
mod solution;
mod solutions;
mod state;
mod table;
mod tool_paths;
mod trajectories;
mod trajectory;

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyMapping, PyTuple};

use crate::lanes::InstructionSet;
use crate::report::Configuration;

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
    let available = || InstructionSet::available().map(InstructionSet::name).collect::<Vec<_>>();
    let set = InstructionSet::available().find(|set| set.name() == name);
    let set = set.ok_or_else(|| {
        PyValueError::new_err(format!(
            "the instruction set \"{name}\" is not supported by this CPU, which has {available:?}",
            available = available()
        ))
    })?;
    set.force().map_err(|error| PyValueError::new_err(error.to_string()))
}

// Single calls read arrays under the interpreter's lock (`arrays::copied_vector`), and `borrows`
// relies on it.
#[pymodule(gil_used = true)]
fn _core(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<robot::PyRobot>()?;
    module.add_class::<solutions::PySolutions>()?;
    module.add_class::<solution::PySolution>()?;
    module.add_class::<Configuration>()?;
    module.add_class::<records::Break>()?;
    module.add_class::<records::CatalogEntry>()?;
    module.add_class::<records::ConfigurationBatch>()?;
    module.add_class::<records::FollowResult>()?;
    module.add_class::<records::FreeJoint>()?;
    module.add_class::<records::IkBatch>()?;
    module.add_class::<records::IkMargin>()?;
    module.add_class::<records::Margin>()?;
    module.add_class::<records::MotionPeaks>()?;
    module.add_class::<records::Plan>()?;
    module.add_class::<records::PlanBreak>()?;
    module.add_class::<records::PoseCheck>()?;
    module.add_class::<records::Singularity>()?;
    module.add_class::<records::StrandEnd>()?;
    module.add_class::<records::ToolSpeedLimits>()?;
    module.add_class::<records::TrajectorySample>()?;
    module.add_function(wrap_pyfunction!(catalog::catalog, module)?)?;
    module.add_function(wrap_pyfunction!(catalog::catalog_entry, module)?)?;
    module.add_function(wrap_pyfunction!(instruction_set, module)?)?;
    module.add_function(wrap_pyfunction!(instruction_sets, module)?)?;
    module.add_function(wrap_pyfunction!(use_instruction_set, module)?)?;
    module.add_function(wrap_pyfunction!(restored::restore, module)?)?;
    module.add_function(wrap_pyfunction!(poses::pose, module)?)?;
    module.add_function(wrap_pyfunction!(poses::to_xyz_wxyz, module)?)?;
    module.add_function(wrap_pyfunction!(poses::to_xyz_euler_zyx, module)?)?;
    module.add_class::<trajectory::PyTrajectory>()?;
    module.add_function(wrap_pyfunction!(trajectory::trajectory_of, module)?)?;
    module.add_function(wrap_pyfunction!(trajectories::joint, module)?)?;
    module.add_function(wrap_pyfunction!(trajectories::spline, module)?)?;
    module.add_function(wrap_pyfunction!(retiming::retime, module)?)?;
    module.add_function(wrap_pyfunction!(retiming::at_tool_speed, module)?)?;
    module.add_function(wrap_pyfunction!(retiming::tool_speed_limits, module)?)?;
    module.add_function(wrap_pyfunction!(tool_paths::line, module)?)?;
    module.add_function(wrap_pyfunction!(tool_paths::arc, module)?)?;
    module.add_function(wrap_pyfunction!(tool_paths::polyline, module)?)?;
    // `spline` is taken by trajectories; `irbkin.paths` gives this one its name.
    module.add("path_spline", wrap_pyfunction!(tool_paths::spline, module)?)?;
    rapid::add_records(module)?;
    module.add_class::<rapid::RapidModule>()?;
    module.add_function(wrap_pyfunction!(rapid::parse, module)?)?;
    module.add_function(wrap_pyfunction!(rapid::parse_module, module)?)?;
    module.add_function(wrap_pyfunction!(rapid::dump, module)?)?;
    module.add_function(wrap_pyfunction!(rapid::calc_joint_t, module)?)?;
    module.add_function(wrap_pyfunction!(rapid::calc_rob_t, module)?)?;
    module.add_function(wrap_pyfunction!(rapid::calc_moves, module)?)?;
    module.add_function(wrap_pyfunction!(rapid::calc_targets, module)?)?;
    module.add_class::<rapid::PyRoutineMotion>()?;
    module.add_function(wrap_pyfunction!(rapid::motion, module)?)?;
    module.add_function(wrap_pyfunction!(rapid::check, module)?)?;
    module.add_function(wrap_pyfunction!(rapid::check_codes, module)?)?;
    let py = module.py();
    PyMapping::register::<rapid::RapidModule>(py)
}
