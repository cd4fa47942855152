//! The bytes and the hashes of values.
//!
//! An answer is kept as it was solved: another instruction set would solve its pose with other
//! rounding.

use std::hash::{DefaultHasher, Hash, Hasher};

use pyo3::prelude::*;
use pyo3::types::PyBytes;
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::errors::Fault;

/// Function and arguments that restore a pickled value.
pub(super) type Reduced<'py> = (Bound<'py, PyAny>, (&'static str, Bound<'py, PyBytes>));

/// Write a value of the class `class` for pickle.
pub(super) fn reduced<'py>(
    py: Python<'py>,
    class: &'static str,
    value: &impl Serialize,
) -> PyResult<Reduced<'py>> {
    let failed = |error| Fault::Model.error(format_args!("{class} cannot be pickled: {error}"));
    let bytes = postcard::to_allocvec(value).map_err(failed)?;
    Ok((py.import("irbkin._core")?.getattr("_restore")?, (class, PyBytes::new(py, &bytes))))
}

/// Read a value of the class `class`, as [`reduced`] wrote it, if it `is_whole`.
pub(super) fn read<T: DeserializeOwned>(
    class: &str,
    bytes: &[u8],
    is_whole: impl FnOnce(&T) -> bool,
) -> PyResult<T> {
    let damaged =
        |cause| Fault::Model.error(format_args!("the pickled {class} is damaged: {cause}"));
    let value = postcard::from_bytes(bytes).map_err(|error| damaged(error.to_string()))?;
    if is_whole(&value) {
        Ok(value)
    } else {
        Err(damaged("a slot or a joint does not exist".to_owned()))
    }
}

/// Hash numbers and a name.
pub(super) fn hash_of(name: &str, numbers: impl IntoIterator<Item = f64>) -> u64 {
    let mut hasher = DefaultHasher::new();
    name.hash(&mut hasher);
    for number in numbers {
        // 0.0 equals -0.0.
        (number + 0.0).to_bits().hash(&mut hasher);
    }
    hasher.finish()
}
