//! The Python module `irbkin._core`: convert, call, convert.

mod answers;
mod arguments;
mod arm;
mod arrays;
mod batches;
mod borrows;
mod broadcast;
mod build;
mod catalog;
mod classes;
mod configurations;
mod edits;
mod errors;
mod found;
mod inverse;
mod masked;
mod models;
mod nearest;
mod paths;
mod poses;
mod queries;
mod rapid;
mod records;
mod robot;
mod signals;
mod solutions;
mod urdf;

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::lanes::InstructionSet;

/// Name of the instruction set that calculates: "avx512", "avx2" or "baseline".
#[pyfunction]
fn instruction_set() -> &'static str {
    InstructionSet::in_use().name()
}

/// Names of the instruction sets that this processor has, the narrowest first.
#[pyfunction]
fn instruction_sets(py: Python<'_>) -> PyResult<Bound<'_, PyTuple>> {
    PyTuple::new(py, InstructionSet::available().map(InstructionSet::name).collect::<Vec<_>>())
}

/// Calculates with another instruction set from now on, in the whole process: for tests and
/// measurements.
///
/// Args:
///     name: One of `instruction_sets()`.
///
/// Raises:
///     ValueError: This processor does not have it.
#[pyfunction]
fn use_instruction_set(name: &str) -> PyResult<()> {
    let available = || InstructionSet::available().map(InstructionSet::name).collect::<Vec<_>>();
    let set = InstructionSet::available().find(|set| set.name() == name);
    let set = set.ok_or_else(|| {
        PyValueError::new_err(format!(
            "instruction set \"{name}\" is none of this processor's: {available:?}",
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
    module.add_class::<solutions::PySolution>()?;
    module.add_function(wrap_pyfunction!(catalog::catalog, module)?)?;
    module.add_function(wrap_pyfunction!(instruction_set, module)?)?;
    module.add_function(wrap_pyfunction!(instruction_sets, module)?)?;
    module.add_function(wrap_pyfunction!(use_instruction_set, module)?)?;
    module.add_function(wrap_pyfunction!(robot::restore_robot, module)?)?;
    module.add_function(wrap_pyfunction!(poses::pose, module)?)?;
    module.add_function(wrap_pyfunction!(poses::to_xyz_wxyz, module)?)?;
    module.add_function(wrap_pyfunction!(poses::to_xyz_euler_zyx, module)?)?;
    module.add_class::<rapid::RapidModule>()?;
    module.add_function(wrap_pyfunction!(rapid::parse, module)?)?;
    module.add_function(wrap_pyfunction!(rapid::decode, module)?)?;
    module.add_function(wrap_pyfunction!(rapid::parse_record, module)?)?;
    module.add_function(wrap_pyfunction!(rapid::dump, module)?)?;
    module.add_function(wrap_pyfunction!(rapid::calc_joint_t, module)?)?;
    module.add_function(wrap_pyfunction!(rapid::calc_rob_t, module)?)?;
    module.add_function(wrap_pyfunction!(rapid::calc_moves, module)?)?;
    module.add_function(wrap_pyfunction!(rapid::calc_targets, module)?)?;
    Ok(())
}
