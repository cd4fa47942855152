//! Arrays that answers are written to.

use std::fmt;
use std::ops::Range;

use numpy::ndarray::aview2;
use numpy::{
    PyArray1, PyArray2, PyArrayDyn, PyArrayMethods, PyReadwriteArrayDyn, PyUntypedArray,
    PyUntypedArrayMethods,
};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;

use super::arrays::{addresses, refuse_masked};
use super::borrows::{Access, Borrow, is_free, overlap};
use super::errors::shape_text;

/// A new array with `rows`: one NumPy object, its memory written once.
#[inline]
pub(super) fn matrix<'py, const C: usize>(
    py: Python<'py>,
    rows: &[[f64; C]],
) -> Bound<'py, PyArray2<f64>> {
    PyArray2::from_array(py, &aview2(rows))
}

/// `rows` in `out` where it was given, in a new array where not. `input` is what they were
/// calculated from: `out` may not overlap it.
#[inline]
pub(super) fn answer<'py, const C: usize>(
    input: &Bound<'py, PyAny>,
    out: Option<&Bound<'py, PyAny>>,
    rows: &[[f64; C]],
) -> PyResult<Bound<'py, PyAny>> {
    match out {
        None => Ok(matrix(input.py(), rows).into_any()),
        Some(out) => write_out(input, out, &[rows.len(), C], rows.as_flattened()),
    }
}

/// As [`answer`], of one row.
#[inline]
pub(super) fn answer_row<'py>(
    input: &Bound<'py, PyAny>,
    out: Option<&Bound<'py, PyAny>>,
    row: &[f64],
) -> PyResult<Bound<'py, PyAny>> {
    match out {
        None => Ok(PyArray1::from_slice(input.py(), row).into_any()),
        Some(out) => write_out(input, out, &[row.len()], row),
    }
}

fn write_out<'py>(
    input: &Bound<'py, PyAny>,
    out: &Bound<'py, PyAny>,
    shape: &[usize],
    numbers: &[f64],
) -> PyResult<Bound<'py, PyAny>> {
    let array = checked_out::<f64>(out, shape, "float64")?;
    let memory =
        input.cast::<PyArrayDyn<f64>>().ok().filter(|input| input.is_c_contiguous()).map(addresses);
    checked_writable(&array, memory.as_slice())?.as_slice_mut()?.copy_from_slice(numbers);
    Ok(array.into_any())
}

/// The array to write an answer to: `out` where it was given, a new one where not.
pub(super) fn output<'py>(
    py: Python<'py>,
    out: Option<&Bound<'py, PyAny>>,
    shape: &[usize],
) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let Some(out) = out else {
        return Ok(PyArrayDyn::zeros(py, shape, false));
    };
    checked_out(out, shape, "float64")
}

/// `out` as an array of the wanted type, shape and layout.
pub(super) fn checked_out<'py, T: numpy::Element>(
    out: &Bound<'py, PyAny>,
    shape: &[usize],
    dtype: &str,
) -> PyResult<Bound<'py, PyArrayDyn<T>>> {
    let array = out.cast::<PyArrayDyn<T>>().map_err(|_| {
        PyTypeError::new_err(format!(
            "out must be an array of dtype {dtype}, got {}",
            describe(out)
        ))
    })?;
    refuse_masked(out, "out")?;
    if array.shape() != shape || !array.is_c_contiguous() {
        return Err(PyValueError::new_err(format!(
            "out must be C-contiguous with shape {}, got {}",
            shape_text(shape),
            describe(out)
        )));
    }
    Ok(array.clone())
}

/// An array that an answer is written to, with the interpreter's lock or without.
pub(super) struct Writable<'py, T: numpy::Element> {
    view: PyReadwriteArrayDyn<'py, T>,
    _borrow: Borrow,
}

impl<T: numpy::Element> Writable<'_, T> {
    /// The elements in row-major order.
    pub(super) fn as_slice_mut(&mut self) -> PyResult<&mut [T]> {
        Ok(self.view.as_slice_mut()?)
    }
}

/// A view to write through; refused for a read-only array, for one that overlaps the memory of
/// `others` and for memory that another call uses.
pub(super) fn writable<'py, T: numpy::Element>(
    array: &Bound<'py, PyArrayDyn<T>>,
    others: &[Range<usize>],
) -> PyResult<Writable<'py, T>> {
    let view = checked_writable(array, others)?;
    Ok(Writable { view, _borrow: Borrow::new(addresses(array), Access::Write) })
}

fn checked_writable<'py, T: numpy::Element>(
    array: &Bound<'py, PyArrayDyn<T>>,
    others: &[Range<usize>],
) -> PyResult<PyReadwriteArrayDyn<'py, T>> {
    let refused = |cause: &dyn fmt::Display| {
        PyValueError::new_err(format!("out must be writable and must not overlap the input{cause}"))
    };
    let own = addresses(array);
    if others.iter().any(|other| overlap(&own, other)) {
        return Err(refused(&""));
    }
    if !is_free(&own, Access::Write) {
        return Err(refused(&": another call uses its memory"));
    }
    array.try_readwrite().map_err(|cause| refused(&format_args!(": {cause}")))
}

fn describe(value: &Bound<'_, PyAny>) -> String {
    match value.cast::<PyUntypedArray>() {
        Ok(array) => {
            let order = if array.is_c_contiguous() { "" } else { ", not C-contiguous" };
            let shape = shape_text(array.shape());
            format!("an array of dtype {} and shape {shape}{order}", array.dtype())
        }
        Err(_) => value
            .get_type()
            .name()
            .map_or_else(|_| "another object".to_owned(), |name| name.to_string()),
    }
}
