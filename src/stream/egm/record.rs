//! Messages as named tuples of `irbkin.stream.egm`.

use pyo3::prelude::*;
use pyo3::types::PyTuple;

/// A field in Python.
pub(crate) trait Record {
    fn record<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>>;
}

/// A message is the named tuple of its name, of all fields.
macro_rules! record {
    ($Name:ident { $($field:ident)* }) => {
        impl super::record::Record for $Name {
            fn record<'py>(
                &self,
                py: pyo3::Python<'py>,
            ) -> pyo3::PyResult<pyo3::Bound<'py, pyo3::PyAny>> {
                use pyo3::types::PyAnyMethods;
                static CLASS: pyo3::sync::PyOnceLock<pyo3::Py<pyo3::types::PyType>> =
                    pyo3::sync::PyOnceLock::new();
                let class = CLASS.import(py, "irbkin.stream.egm._records", stringify!($Name))?;
                let fields = [$(super::record::Record::record(&self.$field, py)?),*];
                class.call1(pyo3::types::PyTuple::new(py, fields)?)
            }
        }
    };
}
pub(crate) use record;

impl<T: Record> Record for Option<T> {
    fn record<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.as_ref().map_or_else(|| Ok(py.None().into_bound(py)), |it| it.record(py))
    }
}

impl<T: Record> Record for [T] {
    fn record<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let all = self.iter().map(|it| it.record(py)).collect::<PyResult<Vec<_>>>()?;
        Ok(PyTuple::new(py, all)?.into_any())
    }
}

impl Record for Vec<f64> {
    fn record<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self[..].record(py)
    }
}

impl<T: Record, const N: usize> Record for [T; N] {
    fn record<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self[..].record(py)
    }
}

macro_rules! numbers {
    ($($Number:ident)*) => {$(
        impl Record for $Number {
            fn record<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
                Ok(self.into_pyobject(py)?.to_owned().into_any())
            }
        }
    )*};
}
numbers! { bool f64 i32 u32 u64 }
