//! The Python module `irbkin._core`: convert, call, convert.

mod answers;
mod arguments;
mod arm;
mod arrays;
mod build;
mod errors;
mod poses;
mod robot;
mod solutions;

use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::catalogue;

/// Names of every robot in the catalogue.
#[pyfunction]
fn catalog(py: Python<'_>) -> PyResult<Bound<'_, PyTuple>> {
    PyTuple::new(py, catalogue::catalogue().map(|arm| arm.name).collect::<Vec<_>>())
}

#[pymodule(gil_used = false)]
fn _core(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<robot::PyRobot>()?;
    module.add_class::<solutions::PySolutions>()?;
    module.add_class::<solutions::PySolution>()?;
    module.add_function(wrap_pyfunction!(catalog, module)?)?;
    module.add_function(wrap_pyfunction!(robot::restore_robot, module)?)?;
    module.add_function(wrap_pyfunction!(poses::pose, module)?)?;
    module.add_function(wrap_pyfunction!(poses::to_xyz_quaternion, module)?)?;
    module.add_function(wrap_pyfunction!(poses::to_xyz_euler_zyx, module)?)?;
    Ok(())
}
