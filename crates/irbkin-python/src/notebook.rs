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

/// Let answers have a table, which a function makes of them.
macro_rules! repr_html {
    ($($answer:ident: $function:literal,)+) => {$(
        #[pymethods]
        impl $answer {
            fn _repr_html_(slf: &Bound<'_, Self>) -> PyResult<String> {
                html(slf.py(), $function, (slf,))
            }
        }
    )+};
}

repr_html! { PyRobot: "of_robot", Plan: "of_plan", PyTrajectory: "of_trajectory", }

#[pymethods]
impl PySolutions {
    fn _repr_html_(slf: &Bound<'_, Self>) -> PyResult<String> {
        html(slf.py(), "of_solutions", (slf, slf.get().robot()))
    }
}
