//! NumPy arrays in and out: any number array is taken, a C-contiguous float64 one without a copy.

use std::array;
use std::fmt::Display;
use std::ops::Range;

use numpy::ndarray::{Dimension, Ix1, Ix2};
use numpy::{
    PyArray, PyArrayDescr, PyArrayDescrMethods, PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn,
    PyUntypedArray, PyUntypedArrayMethods,
};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::intern;
use pyo3::prelude::*;
use pyo3::type_object::PyTypeInfo;
use pyo3::types::{PyFloat, PyInt, PyList, PyTuple};

use super::borrows::{Access, Borrow, is_any_written, is_free};
use super::errors::{Fault, shape_of_rows, shape_text};

/// An argument that is an array whose last dimensions are known, and the leading ones.
pub(super) struct Rows<'py> {
    array: PyReadonlyArrayDyn<'py, f64>,
    pub(super) lead: Vec<usize>,
    field: &'static str,
    fault: Fault,
    _borrow: Borrow,
}

impl<'py> Rows<'py> {
    /// Read `value`, of shape (..., `tail`), as the argument `field`.
    pub(super) fn read(
        value: &Bound<'py, PyAny>,
        tail: &[usize],
        field: &'static str,
        fault: Fault,
    ) -> PyResult<Self> {
        let wanted = || shape_of_rows(tail);
        let mut rows = Self::shaped(value, wanted, field, fault, |shape| shape.ends_with(tail))?;
        rows.lead.truncate(rows.lead.len() - tail.len());
        Ok(rows)
    }

    /// Read `value`, of a shape that `fits`, as the argument `field`; `wanted` spells such shapes.
    /// All dimensions are leading ones.
    pub(super) fn shaped<W: Display>(
        value: &Bound<'py, PyAny>,
        wanted: impl FnOnce() -> W,
        field: &'static str,
        fault: Fault,
        fits: impl FnOnce(&[usize]) -> bool,
    ) -> PyResult<Self> {
        let array = readable(value, field, fault)?;
        let lead = array.shape().to_vec();
        if !fits(&lead) {
            let (wanted, got) = (wanted(), shape_text(&lead));
            // Of a position, a vector with a quaternion or Euler angles, three rows of a matrix.
            let is_pose = field == "T" && matches!(lead[..], [3 | 6 | 7] | [3, 4]);
            let hint = if is_pose {
                " (irbkin.pose makes a matrix of position and orientation)"
            } else {
                ""
            };
            return Err(
                fault.error(format_args!("{field} must have shape {wanted}, got {got}{hint}"))
            );
        }
        let borrow = Borrow::new(addresses(&array), Access::Read);
        Ok(Self { array, lead, field, fault, _borrow: borrow })
    }

    /// Read `value`, of exactly the shape `shape`, as the argument `field`.
    pub(super) fn exact(
        value: &Bound<'py, PyAny>,
        shape: &[usize],
        field: &'static str,
        fault: Fault,
    ) -> PyResult<Self> {
        Self::shaped(value, || shape_text(shape), field, fault, |given| given == shape)
    }

    /// The numbers in row-major order.
    pub(super) fn data(&self) -> PyResult<&[f64]> {
        Ok(self.array.as_slice()?)
    }

    pub(super) fn chunks<const N: usize>(&self) -> PyResult<&[[f64; N]]> {
        Ok(self.data()?.as_chunks::<N>().0)
    }

    /// The row, if there is one without leading dimensions.
    pub(super) fn single<const N: usize>(&self) -> PyResult<Option<&[f64; N]>> {
        Ok(if self.is_single() { self.chunks()?.first() } else { None })
    }

    pub(super) fn shape(&self) -> &[usize] {
        self.array.shape()
    }

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

/// Give all arguments the same leading dimensions, as NumPy broadcasts them.
pub(super) fn together(arguments: &mut [&mut Rows<'_>]) -> PyResult<()> {
    let mut lead = Vec::new();
    for (number, rows) in arguments.iter().enumerate() {
        let named =
            |rows: &Rows<'_>| format!("{} of shape {}", rows.field, shape_text(rows.shape()));
        lead = joined(&lead, &rows.lead).ok_or_else(|| {
            let others: Vec<String> =
                arguments[..number].iter().map(|other| named(other)).collect();
            rows.fault.error(format_args!(
                "{} cannot be broadcast with {}: leading dimensions must be equal, or 1, or left \
                 out",
                named(rows),
                others.join(" and ")
            ))
        })?;
    }
    for rows in arguments.iter_mut().filter(|rows| rows.lead != lead) {
        let (py, tail) = (rows.array.py(), &rows.shape()[rows.lead.len()..]);
        let shape = PyTuple::new(py, [&lead, tail].concat())?;
        let numpy = py.import(intern!(py, "numpy"))?;
        let all = numpy.call_method1(intern!(py, "broadcast_to"), (rows.array.as_any(), shape))?;
        **rows = Rows::read(&all, tail, rows.field, rows.fault)?;
    }
    Ok(())
}

/// The shape that arrays of two shapes have together.
fn joined(one: &[usize], other: &[usize]) -> Option<Vec<usize>> {
    let (long, short) = if one.len() < other.len() { (other, one) } else { (one, other) };
    let mut shape = long.to_vec();
    let start = long.len() - short.len();
    for (size, other) in shape[start..].iter_mut().zip(short) {
        *size = match (*size, *other) {
            (one, other) if one == other => one,
            (1, other) => other,
            (one, 1) => one,
            _ => return None,
        };
    }
    Some(shape)
}

/// An array that can be read the short way: float64, any strides, not of a class of its own.
///
/// The elements are copied under the interpreter's lock, without NumPy's bookkeeping of borrows:
/// with 50 ns that costs more than the rest of the call. Who else could write holds the lock, or
/// has a borrow.
#[inline]
fn plain<'a, 'py, D: Dimension>(
    value: &'a Bound<'py, PyAny>,
) -> Option<&'a Bound<'py, PyArray<f64, D>>> {
    if !PyUntypedArray::is_exact_type_of(value) {
        return None;
    }
    value.cast().ok().filter(|array: &&Bound<'_, _>| array.is_aligned() && !is_any_written())
}

/// A copy of a plain array of shape (`N`,), or of a list of `N` numbers.
#[inline]
pub(super) fn copied_vector<const N: usize>(value: &Bound<'_, PyAny>) -> Option<[f64; N]> {
    let Some(array) = plain::<Ix1>(value) else { return listed(value) };
    let number = |index| array.get_owned([index]).unwrap_or(f64::NAN);
    (array.shape() == [N]).then(|| array::from_fn(number))
}

/// The numbers of a list of `N` of them, which NumPy would take two microseconds to read.
fn listed<const N: usize>(value: &Bound<'_, PyAny>) -> Option<[f64; N]> {
    let items = value.cast_exact::<PyList>().ok().filter(|items| items.len() == N)?;
    let mut numbers = [0.0; N];
    for (number, item) in numbers.iter_mut().zip(items) {
        *number = if item.is_exact_instance_of::<PyInt>() {
            item.extract::<i32>().ok()?.into()
        } else {
            item.cast::<PyFloat>().ok()?.value()
        };
    }
    Some(numbers)
}

/// A copy of a plain array of shape (2, `N`) of finite numbers.
pub(super) fn copied_pair<const N: usize>(value: &Bound<'_, PyAny>) -> Option<[[f64; N]; 2]> {
    let array = plain::<Ix2>(value).filter(|array| array.shape() == [2, N])?;
    let number = |row, column| array.get_owned([row, column]).unwrap_or(f64::NAN);
    let pair: [[f64; N]; 2] = array::from_fn(|row| array::from_fn(|column| number(row, column)));
    pair.as_flattened().iter().all(|number| number.is_finite()).then_some(pair)
}

/// A copy of a plain array of shape (n,).
#[inline]
pub(super) fn copied_numbers(value: &Bound<'_, PyAny>) -> Option<Vec<f64>> {
    let array = plain::<Ix1>(value)?;
    (0..array.len()).map(|index| array.get_owned([index])).collect()
}

/// A copy of a plain array of shape (4, 4), in row-major order.
#[inline]
pub(super) fn copied_matrix4(value: &Bound<'_, PyAny>) -> Option<[f64; 16]> {
    let array = plain::<Ix2>(value).filter(|array| array.shape() == [4, 4])?;
    // Every index is inside the shape. Row by row, so that it unrolls.
    let mut numbers = [0.0; 16];
    for (row, to) in numbers.as_chunks_mut::<4>().0.iter_mut().enumerate() {
        *to = array::from_fn(|column| array.get_owned([row, column]).unwrap_or(f64::NAN));
    }
    Some(numbers)
}

/// Exactly `N` numbers, as the argument `field`.
#[inline]
pub(super) fn vector<const N: usize>(
    value: &Bound<'_, PyAny>,
    field: &'static str,
    fault: Fault,
) -> PyResult<[f64; N]> {
    copied_vector(value).map_or_else(|| exactly::<N>(value, &[N], field, fault), Ok)
}

/// Exactly 4 rows of 4 numbers in row-major order, as the argument `field`.
#[inline]
pub(super) fn matrix4(
    value: &Bound<'_, PyAny>,
    field: &'static str,
    fault: Fault,
) -> PyResult<[f64; 16]> {
    copied_matrix4(value).map_or_else(|| exactly::<16>(value, &[4, 4], field, fault), Ok)
}

/// One array of exactly the shape `shape`, of `N` elements.
#[cold]
#[inline(never)]
fn exactly<const N: usize>(
    value: &Bound<'_, PyAny>,
    shape: &[usize],
    field: &'static str,
    fault: Fault,
) -> PyResult<[f64; N]> {
    let rows = Rows::exact(value, shape, field, fault)?;
    Ok(rows.data()?.try_into().unwrap_or([f64::NAN; N]))
}

/// Numbers of one dimension, as the argument `field`; `wanted` spells their shape.
pub(super) fn numbers(
    value: &Bound<'_, PyAny>,
    wanted: &str,
    field: &'static str,
    fault: Fault,
) -> PyResult<Vec<f64>> {
    if let Some(numbers) = copied_numbers(value) {
        return Ok(numbers);
    }
    let rows = Rows::shaped(value, || wanted, field, fault, |shape| shape.len() == 1)?;
    Ok(rows.data()?.to_vec())
}

/// Refuse a masked array: the memory of masked elements holds numbers that nobody means.
pub(super) fn refuse_masked(value: &Bound<'_, PyAny>, field: &str) -> PyResult<()> {
    let is_plain = PyUntypedArray::is_exact_type_of(value) || !PyUntypedArray::is_type_of(value);
    if is_plain || !value.hasattr(intern!(value.py(), "mask"))? {
        return Ok(());
    }
    let message = format!("{field} is a masked array: pass {field}.filled(np.nan)");
    Err(PyTypeError::new_err(message))
}

/// View `value` as an aligned C-contiguous float64 array for reading; copy where it is another.
fn readable<'py>(
    value: &Bound<'py, PyAny>,
    field: &str,
    fault: Fault,
) -> PyResult<PyReadonlyArrayDyn<'py, f64>> {
    refuse_masked(value, field)?;
    let written = || PyValueError::new_err(format!("{field} is being written by another call"));
    if let Ok(array) = value.cast::<PyArrayDyn<f64>>() {
        let array = array.try_readonly().map_err(|_| written())?;
        if array.is_c_contiguous() && array.as_slice().is_ok() {
            let is_free = is_free(&addresses(&array), Access::Read);
            return if is_free { Ok(array) } else { Err(written()) };
        }
    }
    let array = as_array(value).map_err(|cause| {
        let cause = cause.value(value.py());
        fault.error(format_args!("{field} must be an array of numbers: {cause}"))
    })?;
    if is_any_written() && !is_free(&extent(&array)?, Access::Read) {
        return Err(written());
    }
    converted(value, &array, field)?.try_readonly().map_err(|_| written())
}

/// Let NumPy make an array of a value, of all poses of an object of several.
pub(super) fn as_array<'py>(value: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyUntypedArray>> {
    let py = value.py();
    let arrays = py.import(intern!(py, "irbkin._arrays"))?;
    let all = arrays.call_method1(intern!(py, "all_poses"), (value,))?;
    let numpy = py.import(intern!(py, "numpy"))?;
    Ok(numpy.call_method1(intern!(py, "asarray"), (all,))?.cast_into()?)
}

/// A real array as an aligned C-contiguous one of float64.
fn converted<'py>(
    value: &Bound<'py, PyAny>,
    array: &Bound<'py, PyUntypedArray>,
    field: &str,
) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let py = array.py();
    let dtype = array.dtype();
    let kind: String = dtype.getattr(intern!(py, "kind"))?.extract()?;
    if !matches!(kind.as_str(), "f" | "i" | "u") {
        return Err(PyTypeError::new_err(format!(
            "{field} must be real numbers, got {}",
            no_numbers(value, &dtype)
        )));
    }
    let numpy = py.import(intern!(py, "numpy"))?;
    let contiguous =
        numpy.call_method1(intern!(py, "require"), (array, intern!(py, "float64"), ["C", "A"]))?;
    Ok(contiguous.cast_into::<PyArrayDyn<f64>>()?)
}

/// Attributes of objects that stand for a pose or for joints, and how each is made an array.
const CONVERSIONS: [(&str, &str); 6] = [
    ("tframe", ".tframe.matrix()"),
    ("uframe", ".uframe.matrix() @ its .oframe.matrix()"),
    ("robax_deg", "np.radians of its .robax_deg"),
    ("as_quat", "irbkin.pose(xyz, rotation=it)"),
    ("as_matrix", ".as_matrix()"),
    ("matrix", ".matrix()"),
];

/// Name an argument of which NumPy makes no numbers.
fn no_numbers(value: &Bound<'_, PyAny>, dtype: &Bound<'_, PyArrayDescr>) -> String {
    let class =
        value.get_type().name().map_or_else(|_| "object".to_owned(), |name| name.to_string());
    let conversion =
        CONVERSIONS.iter().find(|(attribute, _)| value.hasattr(*attribute).unwrap_or(false));
    if let Some((_, how)) = conversion {
        return format!("a {class}: pass {how}");
    }
    if value.is_none() { "None".to_owned() } else { format!("an array of dtype {dtype}") }
}

/// The addresses of a C-contiguous array's memory.
pub(super) fn addresses<T: numpy::Element>(array: &Bound<'_, PyArrayDyn<T>>) -> Range<usize> {
    let start = array.data().addr();
    start..start + array.len() * size_of::<T>()
}

/// The addresses from the lowest to the highest of an array with any strides.
fn extent(array: &Bound<'_, PyUntypedArray>) -> PyResult<Range<usize>> {
    let py = array.py();
    let interface = array.getattr(intern!(py, "__array_interface__"))?;
    let (data, _): (usize, bool) = interface.get_item(intern!(py, "data"))?.extract()?;
    if array.is_empty() {
        return Ok(data..data);
    }
    let (mut lowest, mut highest) = (data, data + array.dtype().itemsize());
    for (count, stride) in array.shape().iter().zip(array.strides()) {
        let length = (count - 1) * stride.unsigned_abs();
        if *stride < 0 { lowest -= length } else { highest += length }
    }
    Ok(lowest..highest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shapes_are_joined_as_numpy_joins_them() {
        for (one, other, both) in [
            (&[] as &[usize], &[] as &[usize], Some(&[] as &[usize])),
            (&[], &[2, 3], Some(&[2, 3])),
            (&[3], &[2, 1], Some(&[2, 3])),
            (&[2, 3], &[1], Some(&[2, 3])),
            (&[0], &[1], Some(&[0])),
            (&[0], &[2], None),
            (&[2, 3], &[2], None),
        ] {
            assert_eq!(joined(one, other).as_deref(), both, "{one:?} {other:?}");
            assert_eq!(joined(other, one).as_deref(), both, "{other:?} {one:?}");
        }
    }
}
