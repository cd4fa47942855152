//! Names that `irbkin.Robot` does not have but other packages do, each answered with irbkin's.
//!
//! They are attributes that raise: with a `__getattr__`, Python would look up every method of a
//! robot the long way, which adds 0.1 us to a call.

use pyo3::exceptions::PyAttributeError;
use pyo3::prelude::*;

use super::robot::PyRobot;

/// Define names that raise, and hide them from `dir`.
macro_rules! hints {
    ($($other:ident: $own:literal,)+) => {
        const OTHERS: &[&str] = &[$(stringify!($other)),+];

        #[pymethods]
        impl PyRobot {
            $(
                #[doc = concat!("Another package's name: use `", $own, "`.")]
                #[getter]
                fn $other(&self) -> PyResult<()> {
                    Err(PyAttributeError::new_err(concat!(
                        "Robot has no attribute '", stringify!($other), "': use ", $own
                    )))
                }
            )+

            fn __dir__(slf: &Bound<'_, Self>) -> PyResult<Vec<String>> {
                let object = slf.py().get_type::<PyAny>();
                let names: Vec<String> = object.call_method1("__dir__", (slf,))?.extract()?;
                Ok(names.into_iter().filter(|name| !OTHERS.contains(&name.as_str())).collect())
            }
        }
    };
}

hints! {
    set_tool: "with_tool",
    set_base: "with_base",
    set_limits: "with_limits",
    joint_limits: "limits",
    n: "dof",
    ikine: "ik",
    inverse: "ik",
    fkine: "fk",
    forward: "fk",
}
