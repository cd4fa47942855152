//! Masked arrays of `numpy.ma`. A masked element is not known: it is never read.
//!
//! An argument of one row is refused with the place of the first one. In a batch, NaN stands for
//! it, so that its row is invalid and the others are not touched.

use pyo3::exceptions::PyValueError;
use pyo3::intern;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyDict, PyFloat, PyList, PyTuple};

use super::errors::Fault;

/// Most lists in lists that are looked into: NumPy makes arrays of no more dimensions.
const DEEPEST: usize = 64;

/// An argument with masked elements.
pub(super) struct Masked<'py> {
    /// The same with NaN for each of them.
    pub(super) filled: Bound<'py, PyAny>,
    first: Vec<usize>,
}

impl<'py> Masked<'py> {
    /// The argument, where it has masked elements. What is no array of real numbers is left to
    /// those who say so.
    pub(super) fn of(value: &Bound<'py, PyAny>) -> PyResult<Option<Self>> {
        let py = value.py();
        let Some(class) = masked_array_class(py)? else { return Ok(None) };
        if !holds(value, class, DEEPEST)? {
            return Ok(None);
        }
        let masked_arrays = py.import(intern!(py, "numpy.ma"))?;
        let Ok(array) = masked_arrays.call_method1(intern!(py, "asarray"), (value,)) else {
            return Ok(None);
        };
        let kind: String =
            array.getattr(intern!(py, "dtype"))?.getattr(intern!(py, "kind"))?.extract()?;
        let mask = masked_arrays.call_method1(intern!(py, "getmaskarray"), (&array,))?;
        if !matches!(kind.as_str(), "f" | "i" | "u")
            || !mask.call_method0(intern!(py, "any"))?.is_truthy()?
        {
            return Ok(None);
        }
        let numpy = py.import(intern!(py, "numpy"))?;
        let first = numpy.call_method1(intern!(py, "argwhere"), (mask,))?.get_item(0)?;
        let float64 = array.call_method1(intern!(py, "astype"), (intern!(py, "float64"),))?;
        let filled = float64.call_method1(intern!(py, "filled"), (f64::NAN,))?;
        Ok(Some(Self { filled, first: first.call_method0("tolist")?.extract()? }))
    }

    /// The error of an argument that has one row only.
    pub(super) fn refused(&self, py: Python<'_>, field: &str, fault: Fault) -> PyErr {
        fault.error(py, self.message(field))
    }

    fn message(&self, field: &str) -> String {
        let Self { first, .. } = self;
        format!("{field}{first:?} is masked: every element must be given, or the row left out")
    }
}

/// An answer is not written to elements that stay masked.
pub(super) fn check_out(out: &Bound<'_, PyAny>) -> PyResult<()> {
    match Masked::of(out)? {
        Some(masked) => Err(PyValueError::new_err(format!(
            "out{:?} is masked: out must be an array without masked elements",
            masked.first
        ))),
        None => Ok(()),
    }
}

/// Whether a value is a masked array, or holds one in a list or tuple.
fn holds(value: &Bound<'_, PyAny>, class: &Bound<'_, PyAny>, depth: usize) -> PyResult<bool> {
    if value.is_exact_instance_of::<PyFloat>() {
        return Ok(false);
    }
    let holding = |item: &Bound<'_, PyAny>| holds(item, class, depth - 1);
    if let Ok(list) = value.cast::<PyList>() {
        return Ok(depth > 0 && any(list.iter(), holding)?);
    }
    if let Ok(tuple) = value.cast::<PyTuple>() {
        return Ok(depth > 0 && any(tuple.iter(), holding)?);
    }
    value.is_instance(class)
}

fn any<'py>(
    items: impl Iterator<Item = Bound<'py, PyAny>>,
    test: impl Fn(&Bound<'py, PyAny>) -> PyResult<bool>,
) -> PyResult<bool> {
    for item in items {
        if test(&item)? {
            return Ok(true);
        }
    }
    Ok(false)
}

/// `numpy.ma.MaskedArray`; none as long as nobody has imported `numpy.ma`.
fn masked_array_class(py: Python<'_>) -> PyResult<Option<&Bound<'_, PyAny>>> {
    static CLASS: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
    if let Some(class) = CLASS.get(py) {
        return Ok(Some(class.bind(py)));
    }
    let modules = py.import(intern!(py, "sys"))?.getattr(intern!(py, "modules"))?;
    let Some(module) = modules.cast_into::<PyDict>()?.get_item(intern!(py, "numpy.ma"))? else {
        return Ok(None);
    };
    let class = module.getattr(intern!(py, "MaskedArray"))?.unbind();
    Ok(Some(CLASS.get_or_init(py, || class).bind(py)))
}
