//! Arrays that answers are written to.

use std::fmt;
use std::ops::Range;

use numpy::ndarray::{Dimension, aview2};
use numpy::{
    Element, PyArray, PyArray1, PyArray2, PyArrayDyn, PyArrayMethods, PyReadwriteArrayDyn,
    PyUntypedArray, PyUntypedArrayMethods, dtype,
};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

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

/// A new array of one dimension.
pub(super) fn column<T: Element>(py: Python<'_>, values: impl IntoIterator<Item = T>) -> Py<PyAny> {
    PyArray1::from_iter(py, values).into_any().unbind()
}

pub(super) fn array<T: Element>(
    py: Python<'_>,
    values: impl IntoIterator<Item = T>,
    shape: &[usize],
) -> PyResult<Py<PyAny>> {
    Ok(PyArray1::from_iter(py, values).reshape(shape)?.into_any().unbind())
}

pub(super) fn read_only<D: Dimension>(array: Bound<'_, PyArray<f64, D>>) -> Py<PyArray<f64, D>> {
    array.readwrite().make_nonwriteable();
    array.unbind()
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
    let array = checked_out::<f64>(out, shape)?;
    let memory =
        input.cast::<PyArrayDyn<f64>>().ok().filter(|input| input.is_c_contiguous()).map(addresses);
    checked_writable(&array, memory.as_slice())?.as_slice_mut()?.copy_from_slice(numbers);
    Ok(array.into_any())
}

/// An array that an answer is written to, with the interpreter's lock or without.
pub(super) struct Output<'py, T: Element = f64> {
    array: Bound<'py, PyArrayDyn<T>>,
    view: PyReadwriteArrayDyn<'py, T>,
    _borrow: Borrow,
}

impl<'py, T: Element> Output<'py, T> {
    /// `out` where it was given, a new array where not; refused if it is read-only, overlaps the
    /// memory of `others`, or another call uses its memory.
    pub(super) fn new(
        py: Python<'py>,
        out: Option<&Bound<'py, PyAny>>,
        shape: &[usize],
        others: &[Range<usize>],
    ) -> PyResult<Self> {
        let array = match out {
            Some(out) => checked_out(out, shape)?,
            None => PyArrayDyn::zeros(py, shape, false),
        };
        let view = checked_writable(&array, others)?;
        let borrow = Borrow::new(addresses(&array), Access::Write);
        Ok(Self { array, view, _borrow: borrow })
    }

    /// The elements in row-major order.
    pub(super) fn slice(&mut self) -> PyResult<&mut [T]> {
        Ok(self.view.as_slice_mut()?)
    }

    pub(super) fn addresses(&self) -> Range<usize> {
        addresses(&self.array)
    }

    /// The array, which is written.
    pub(super) fn bound(self) -> Bound<'py, PyAny> {
        self.array.into_any()
    }

    /// The array, which is written, as the field of a record.
    pub(super) fn array(self) -> Py<PyAny> {
        self.bound().unbind()
    }
}

pub(super) type Pair<'py> = (Option<Bound<'py, PyAny>>, Option<Bound<'py, PyAny>>);

/// The two arrays of `out`, where it is a tuple of two.
pub(super) fn pair<'py>(out: &Bound<'py, PyAny>) -> PyResult<Option<Pair<'py>>> {
    match out.cast::<PyTuple>() {
        Ok(pair) if pair.len() == 2 => Ok(Some((Some(pair.get_item(0)?), Some(pair.get_item(1)?)))),
        _ => Ok(None),
    }
}

/// `out` as an array of the wanted type, shape and layout.
fn checked_out<'py, T: Element>(
    out: &Bound<'py, PyAny>,
    shape: &[usize],
) -> PyResult<Bound<'py, PyArrayDyn<T>>> {
    let array = out.cast::<PyArrayDyn<T>>().map_err(|_| {
        let (wanted, got) = (dtype::<T>(out.py()), describe(out));
        PyTypeError::new_err(format!("out must be an array of dtype {wanted}, got {got}"))
    })?;
    refuse_masked(out, "out")?;
    if array.shape() != shape || !array.is_c_contiguous() {
        let (wanted, got) = (shape_text(shape), describe(out));
        let message = format!("out must be C-contiguous with shape {wanted}, got {got}");
        return Err(PyValueError::new_err(message));
    }
    Ok(array.clone())
}

fn checked_writable<'py, T: Element>(
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

pub(super) fn describe(value: &Bound<'_, PyAny>) -> String {
    if let Ok(array) = value.cast::<PyUntypedArray>() {
        let order = if array.is_c_contiguous() { "" } else { ", not C-contiguous" };
        let shape = shape_text(array.shape());
        return format!("an array of dtype {} and shape {shape}{order}", array.dtype());
    }
    let class = value.get_type().name();
    class.map_or_else(|_| "another object".to_owned(), |name| name.to_string())
}
