//! NumPy arrays in and out: any number array is taken, a C-contiguous float64 one without a copy.

use std::ops::Range;

use numpy::{PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn, PyReadwriteArrayDyn, PyUntypedArray, PyUntypedArrayMethods};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::intern;
use pyo3::prelude::*;

use super::errors::Fault;

/// An input array whose last dimensions are known, and the leading ones that came before them.
pub(super) struct Rows<'py> {
    array: PyReadonlyArrayDyn<'py, f64>,
    pub(super) lead: Vec<usize>,
}

impl<'py> Rows<'py> {
    /// Reads `value`, of shape (..., `tail`), as the argument `field`.
    pub(super) fn read(value: &Bound<'py, PyAny>, tail: &[usize], field: &str, fault: Fault) -> PyResult<Self> {
        let array = readable(value, field, fault)?;
        let shape = array.shape();
        let Some(lead) = shape.strip_suffix(tail) else {
            let wanted = tail.iter().map(usize::to_string).collect::<Vec<_>>().join(", ");
            return Err(fault.error(value.py(), format!("{field} must have shape (..., {wanted}), got {shape:?}")));
        };
        let lead = lead.to_vec();
        Ok(Self { array, lead })
    }

    /// The numbers in row-major order.
    pub(super) fn data(&self) -> PyResult<&[f64]> {
        Ok(self.array.as_slice()?)
    }

    /// The addresses of its memory.
    pub(super) fn addresses(&self) -> Range<usize> {
        addresses(&self.array)
    }

    /// Whether it is one row without leading dimensions.
    pub(super) fn is_single(&self) -> bool {
        self.lead.is_empty()
    }

    /// The leading dimensions followed by others.
    pub(super) fn shape_with(&self, tail: &[usize]) -> Vec<usize> {
        [&self.lead[..], tail].concat()
    }
}

/// Exactly `N` numbers, as the argument `field`.
pub(super) fn vector<const N: usize>(value: &Bound<'_, PyAny>, field: &str, fault: Fault) -> PyResult<[f64; N]> {
    exactly::<N>(value, &[N], field, fault)
}

/// One array of exactly the shape `shape`, of `N` elements.
pub(super) fn exactly<const N: usize>(value: &Bound<'_, PyAny>, shape: &[usize], field: &str, fault: Fault) -> PyResult<[f64; N]> {
    let array = readable(value, field, fault)?;
    if array.shape() != shape {
        return Err(fault.error(value.py(), format!("{field} must have shape {shape:?}, got {:?}", array.shape())));
    }
    Ok(array.as_slice()?.try_into().map_or([f64::NAN; N], |numbers: &[f64; N]| *numbers))
}

/// `value` as an aligned C-contiguous float64 array, seen for reading: itself where it is one.
fn readable<'py>(value: &Bound<'py, PyAny>, field: &str, fault: Fault) -> PyResult<PyReadonlyArrayDyn<'py, f64>> {
    let read = |array: &Bound<'py, PyArrayDyn<f64>>| {
        array.try_readonly().map_err(|_| PyValueError::new_err(format!("{field} is being written by another call")))
    };
    if let Ok(array) = value.cast::<PyArrayDyn<f64>>() {
        let array = read(array)?;
        if array.is_c_contiguous() && array.as_slice().is_ok() {
            return Ok(array);
        }
    }
    read(&converted(value, field, fault)?)
}

fn converted<'py>(value: &Bound<'py, PyAny>, field: &str, fault: Fault) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let py = value.py();
    let numpy = py.import(intern!(py, "numpy"))?;
    let array = numpy
        .call_method1(intern!(py, "asarray"), (value,))
        .map_err(|cause| fault.error(py, format!("{field} must be an array of numbers: {}", cause.value(py))))?;
    let array = array.cast::<PyUntypedArray>()?;
    let dtype = array.dtype();
    let kind: String = dtype.getattr(intern!(py, "kind"))?.extract()?;
    if !matches!(kind.as_str(), "f" | "i" | "u") {
        return Err(PyTypeError::new_err(format!("{field} must be real numbers, got an array of dtype {dtype}")));
    }
    let contiguous = numpy.call_method1(intern!(py, "require"), (array, intern!(py, "float64"), ["C", "A"]))?;
    Ok(contiguous.cast_into::<PyArrayDyn<f64>>()?)
}

/// The array to write an answer to: `out` where it was given, a new one where not.
pub(super) fn output<'py>(py: Python<'py>, out: Option<&Bound<'py, PyAny>>, shape: &[usize]) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
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
    let array = out
        .cast::<PyArrayDyn<T>>()
        .map_err(|_| PyTypeError::new_err(format!("out must be an array of dtype {dtype}, got {}", describe(out))))?;
    if array.shape() != shape || !array.is_c_contiguous() {
        return Err(PyValueError::new_err(format!("out must be C-contiguous with shape {shape:?}, got {}", describe(out))));
    }
    Ok(array.clone())
}

/// A view to write through; refused for a read-only array and for one that overlaps the memory of `others`.
///
/// NumPy's own bookkeeping of borrows knows arrays by the array that owns their memory; two views of one buffer have none, so the
/// addresses are compared too.
pub(super) fn writable<'py, T: numpy::Element>(
    array: &Bound<'py, PyArrayDyn<T>>,
    others: &[Range<usize>],
) -> PyResult<PyReadwriteArrayDyn<'py, T>> {
    let own = addresses(array);
    if others.iter().any(|other| own.start < other.end && other.start < own.end) {
        return Err(PyValueError::new_err("out must be writable and must not overlap the input"));
    }
    array.try_readwrite().map_err(|cause| PyValueError::new_err(format!("out must be writable and must not overlap the input: {cause}")))
}

/// The addresses of a C-contiguous array's memory.
pub(super) fn addresses<T: numpy::Element>(array: &Bound<'_, PyArrayDyn<T>>) -> Range<usize> {
    let start = array.data().addr();
    start..start + array.len() * size_of::<T>()
}

fn describe(value: &Bound<'_, PyAny>) -> String {
    match value.cast::<PyUntypedArray>() {
        Ok(array) => {
            let order = if array.is_c_contiguous() { "" } else { ", not C-contiguous" };
            format!("an array of dtype {} and shape {:?}{order}", array.dtype(), array.shape())
        }
        Err(_) => value.get_type().name().map_or_else(|_| "another object".to_owned(), |name| name.to_string()),
    }
}
