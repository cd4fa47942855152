//! `irbkin.stream.egm.encode` and `decode`.

use crate::errors::exception;
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyBytes, PyTuple, PyType};

use irbkin_abb::egm::{
    EgmData, EgmHeader, EgmPose, EgmPosition, EgmRobot, EgmSensor, EgmSpeed, EgmState, EgmTimestamp,
};

/// Return the bytes of a message, its fields in the order of their numbers.
///
/// Args:
///     message: An EgmRobot or an EgmSensor.
///
/// Raises:
///     TypeError: It is neither, or a field has another type or more bits.
///     StreamError: It is longer than a datagram.
#[pyfunction]
pub(super) fn encode<'py>(
    py: Python<'py>,
    message: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyBytes>> {
    let bytes = match &*message.get_type().name()?.to_string_lossy() {
        "EgmRobot" => EgmRobot::read(message)?.encode().map_err(exception)?,
        "EgmSensor" => EgmSensor::read(message)?.encode().map_err(exception)?,
        other => return Err(unknown(other)),
    };
    Ok(PyBytes::new(py, &bytes))
}

/// Return the message of a datagram. Fields that egm.proto does not have are skipped.
///
/// Args:
///     data: The bytes.
///     kind: EgmRobot, what a controller sends, or EgmSensor, what it receives.
///
/// Raises:
///     TypeError: `kind` is another class.
///     StreamError: The bytes are no such message: the byte, the field and the reason.
#[pyfunction]
pub(super) fn decode<'py>(
    py: Python<'py>,
    data: &[u8],
    kind: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyAny>> {
    let name = kind.getattr("__name__").map_or_else(|_| kind.to_string(), |it| it.to_string());
    match name.as_str() {
        "EgmRobot" => EgmRobot::decode(data).map_err(exception)?.record(py),
        "EgmSensor" => EgmSensor::decode(data).map_err(exception)?.record(py),
        other => Err(unknown(other)),
    }
}

fn unknown(name: &str) -> PyErr {
    PyTypeError::new_err(format!("a message is an EgmRobot or an EgmSensor, got {name}"))
}

/// A field of a message, from and to Python.
trait Record: Sized {
    fn read(given: &Bound<'_, PyAny>) -> PyResult<Self>;

    fn record<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>>;
}

/// Messages are named tuples of their names, of all fields.
macro_rules! messages {
    ($(
        $(#[doc = $doc:literal])*
        $Name:ident {
            $($(#[doc = $field_doc:literal])* $number:literal $field:ident: $Type:ty,)*
        }
    )*) => {$(
        impl Record for $Name {
            fn read(given: &Bound<'_, PyAny>) -> PyResult<Self> {
                Ok(Self {
                    $($field: {
                        let field = given.getattr(stringify!($field))?;
                        let name = concat!(stringify!($Name), ".", stringify!($field));
                        Record::read(&field).map_err(|cause| of_field(given.py(), name, cause))?
                    },)*
                })
            }

            fn record<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
                static CLASS: PyOnceLock<Py<PyType>> = PyOnceLock::new();
                let class = CLASS.import(py, "irbkin.stream.egm._records", stringify!($Name))?;
                class.call1(PyTuple::new(py, [$(self.$field.record(py)?),*])?)
            }
        }
    )*};
}
irbkin_abb::egm_messages!(messages);

/// The error of a field, which its cause explains.
fn of_field(py: Python<'_>, name: &str, cause: PyErr) -> PyErr {
    let error = PyTypeError::new_err(format!("failed to extract field {name}"));
    error.set_cause(py, Some(cause));
    error
}

impl Record for EgmState {
    fn read(given: &Bound<'_, PyAny>) -> PyResult<Self> {
        Ok(Self(Record::read(given)?))
    }

    fn record<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.0.record(py)
    }
}

impl<T: Record> Record for Option<T> {
    fn read(given: &Bound<'_, PyAny>) -> PyResult<Self> {
        if given.is_none() { Ok(None) } else { T::read(given).map(Some) }
    }

    fn record<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.as_ref().map_or_else(|| Ok(py.None().into_bound(py)), |it| it.record(py))
    }
}

/// Numbers, and tuples of them.
macro_rules! numbers {
    ($($Number:ty)*) => {$(
        impl Record for $Number {
            fn read(given: &Bound<'_, PyAny>) -> PyResult<Self> {
                given.extract()
            }

            fn record<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
                self.into_bound_py_any(py)
            }
        }
    )*};
}
numbers! { bool f64 i32 u32 u64 }

macro_rules! tuples {
    ($($Numbers:ty)*) => {$(
        impl Record for $Numbers {
            fn read(given: &Bound<'_, PyAny>) -> PyResult<Self> {
                given.extract()
            }

            fn record<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
                Ok(PyTuple::new(py, self)?.into_any())
            }
        }
    )*};
}
tuples! { Vec<f64> [f64; 3] [f64; 4] [u64; 2] }
