//! Figures of a record that are found when they are read.

use std::array;

use pyo3::prelude::*;
use pyo3::types::PyFloat;

use super::arm::{SharedArm, on};

/// An array, or a figure of the singular values of one joint vector, which is found when it is read:
/// that takes longer than the rest of a [`Singularity`].
pub(crate) enum Figure {
    Known(Py<PyAny>),
    Sought(SharedArm, [f64; 7], fn(&irbkin::Singularity) -> f64),
}

impl FromPyObject<'_, '_> for Figure {
    type Error = PyErr;

    fn extract(known: Borrowed<'_, '_, PyAny>) -> PyResult<Self> {
        Ok(Self::Known(known.to_owned().unbind()))
    }
}

impl<'py> IntoPyObject<'py> for &Figure {
    type Target = PyAny;
    type Output = Bound<'py, PyAny>;
    type Error = PyErr;

    fn into_pyobject(self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(match self {
            Figure::Known(array) => array.bind(py).clone(),
            Figure::Sought(arm, q, figure) => {
                let found = on!(arm, robot => robot.singularity(&array::from_fn(|i| q[i])));
                PyFloat::new(py, figure(&found)).into_any()
            }
        })
    }
}
