//! How a record is defined: a frozen class with documented fields.
//!
//! A record is also the sequence of its fields: it unpacks, and equals a tuple of equal fields. An
//! array field compares by shape and elements, NaN being equal to NaN.

use numpy::{PyUntypedArray, PyUntypedArrayMethods};
use pyo3::basic::CompareOp;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

/// Elements of an array that a representation shows.
const MOST_SHOWN: usize = 16;

/// Define records of a module by their fields.
macro_rules! record {
    (
        $module:literal;
        $($(#[$doc:meta])* $name:ident { $($(#[$field_doc:meta])* $field:ident: $type:ty,)+ })+
    ) => {$(
        $(#[$doc])*
        #[pyclass(module = $module, frozen, get_all, sequence)]
        pub(crate) struct $name { $($(#[$field_doc])* pub(crate) $field: $type,)+ }
        record_methods!($name { $($field: $type,)+ });
    )+};
}

/// Implement the methods of a record on a class. Needs PyO3's prelude, `PyTuple`, `CompareOp` and
/// this module as `record` where it is used.
macro_rules! record_methods {
    ($name:ident { $($field:ident: $type:ty),+ $(,)? }) => {
        impl $name {
            const FIELDS: &[&str] = &[$(stringify!($field)),+];
        }

        #[pymethods]
        impl $name {
            #[new]
            fn new($($field: $type),+) -> Self {
                Self { $($field),+ }
            }

            fn __len__(&self) -> usize {
                Self::FIELDS.len()
            }

            fn __getitem__<'py>(
                slf: &Bound<'py, Self>,
                index: &Bound<'py, PyAny>,
            ) -> PyResult<Bound<'py, PyAny>> {
                record::fields(slf, Self::FIELDS)?.as_any().get_item(index)
            }

            fn __richcmp__<'py>(
                slf: &Bound<'py, Self>,
                other: &Bound<'py, PyAny>,
                operator: CompareOp,
            ) -> PyResult<Bound<'py, PyAny>> {
                record::compared(slf, other, operator, Self::FIELDS)
            }

            fn __hash__(slf: &Bound<'_, Self>) -> PyResult<isize> {
                record::fields(slf, Self::FIELDS)?.hash()
            }

            fn __repr__(slf: &Bound<'_, Self>) -> PyResult<String> {
                record::shown(slf, Self::FIELDS)
            }

            fn __reduce__<'py>(
                slf: &Bound<'py, Self>,
            ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
                Ok((slf.get_type().into_any(), record::fields(slf, Self::FIELDS)?))
            }
        }
    };
}
pub(crate) use {record, record_methods};

pub(crate) fn fields<'py>(
    record: &Bound<'py, PyAny>,
    names: &[&str],
) -> PyResult<Bound<'py, PyTuple>> {
    let values = names.iter().map(|name| record.getattr(*name)).collect::<PyResult<Vec<_>>>()?;
    PyTuple::new(record.py(), values)
}

/// Compare a record with another one of its class, or with a tuple.
pub(crate) fn compared<'py>(
    record: &Bound<'py, PyAny>,
    other: &Bound<'py, PyAny>,
    operator: CompareOp,
    names: &[&str],
) -> PyResult<Bound<'py, PyAny>> {
    let py = record.py();
    let others = if other.is_instance(&record.get_type())? {
        fields(other, names)?
    } else if let Ok(others) = other.cast::<PyTuple>() {
        others.clone()
    } else {
        return Ok(py.NotImplemented().into_bound(py));
    };
    let same = py.import("irbkin._equality")?.getattr("same")?;
    let is_equal = same.call1((fields(record, names)?, others))?.is_truthy()?;
    Ok(match operator {
        CompareOp::Eq => is_equal.into_pyobject(py)?.to_owned().into_any(),
        CompareOp::Ne => (!is_equal).into_pyobject(py)?.to_owned().into_any(),
        _ => py.NotImplemented().into_bound(py),
    })
}

/// Say what came out, of an answer; write another record as the call that makes it, large arrays by
/// their shapes.
pub(crate) fn shown(record: &Bound<'_, PyAny>, names: &[&str]) -> PyResult<String> {
    let own = record.py().import("irbkin._shown")?.call_method1("of_record", (record,))?;
    if let Some(words) = own.extract()? {
        return Ok(words);
    }
    let mut parts = Vec::with_capacity(names.len());
    for name in names {
        let value = record.getattr(*name)?;
        parts.push(match value.cast::<PyUntypedArray>() {
            Ok(array) if array.len() > MOST_SHOWN => {
                let shape = value.getattr("shape")?;
                format!("{name}=<array of {} of shape {shape}>", array.dtype())
            }
            _ => format!("{name}={}", value.repr()?),
        });
    }
    Ok(format!("{}({})", record.get_type().name()?, parts.join(", ")))
}
