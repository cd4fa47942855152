//! `irbkin.stream.egm.encode` and `decode`.

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::stream::egm::{EgmRobot, EgmSensor, Record};

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
        "EgmRobot" => message.extract::<EgmRobot>()?.encode()?,
        "EgmSensor" => message.extract::<EgmSensor>()?.encode()?,
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
        "EgmRobot" => EgmRobot::decode(data)?.record(py),
        "EgmSensor" => EgmSensor::decode(data)?.record(py),
        other => Err(unknown(other)),
    }
}

fn unknown(name: &str) -> PyErr {
    PyTypeError::new_err(format!("a message is an EgmRobot or an EgmSensor, got {name}"))
}
