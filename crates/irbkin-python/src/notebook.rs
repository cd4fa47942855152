//! The tables of notebooks: `irbkin.scene._html`.

use pyo3::prelude::*;

use super::records::Plan;
use super::robot::PyRobot;
use super::solutions::PySolutions;
use super::trajectory::PyTrajectory;

/// Call a function of `irbkin.scene._html`.
fn html<'py, A>(py: Python<'py>, function: &str, arguments: A) -> PyResult<String>
where
    A: pyo3::call::PyCallArgs<'py>,
{
    py.import("irbkin.scene._html")?.call_method1(function, arguments)?.extract()
}

#[pymethods]
impl PyRobot {
    fn _repr_html_(slf: &Bound<'_, Self>) -> PyResult<String> {
        html(slf.py(), "of_robot", (slf,))
    }
}

#[pymethods]
impl PySolutions {
    fn _repr_html_(slf: &Bound<'_, Self>) -> PyResult<String> {
        html(slf.py(), "of_solutions", (slf, slf.get().robot()))
    }
}

#[pymethods]
impl Plan {
    fn _repr_html_(slf: &Bound<'_, Self>) -> PyResult<String> {
        html(slf.py(), "of_plan", (slf,))
    }
}

#[pymethods]
impl PyTrajectory {
    fn _repr_html_(slf: &Bound<'_, Self>) -> PyResult<String> {
        html(slf.py(), "of_trajectory", (slf,))
    }
}
