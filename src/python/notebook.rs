//! What notebooks show: `irbkin.scene._html`.

use pyo3::prelude::*;

use super::records::Plan;
use super::robot::PyRobot;
use super::solutions::PySolutions;
use super::trajectory::PyTrajectory;

/// The HTML of something, and of the robot that it is of.
fn html(thing: &Bound<'_, PyAny>, robot: Option<PyRobot>) -> PyResult<String> {
    let module = thing.py().import("irbkin.scene._html")?;
    module.getattr("html")?.call1((thing, robot))?.extract()
}

#[pymethods]
impl PyRobot {
    fn _repr_html_(slf: &Bound<'_, Self>) -> PyResult<String> {
        html(slf.as_any(), None)
    }
}

#[pymethods]
impl PySolutions {
    fn _repr_html_(slf: &Bound<'_, Self>) -> PyResult<String> {
        html(slf.as_any(), Some(slf.get().robot()))
    }
}

#[pymethods]
impl Plan {
    fn _repr_html_(slf: &Bound<'_, Self>) -> PyResult<String> {
        html(slf.as_any(), None)
    }
}

#[pymethods]
impl PyTrajectory {
    fn _repr_html_(slf: &Bound<'_, Self>) -> PyResult<String> {
        html(slf.as_any(), None)
    }
}
