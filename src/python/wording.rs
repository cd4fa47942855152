//! How messages spell shapes, indices and what was passed in place of an array.

use pyo3::intern;
use pyo3::prelude::*;
use pyo3::types::{PyList, PyTuple};

/// A shape as NumPy prints it: (5, 4, 4), (6,), ().
pub(super) fn shape(sizes: &[usize]) -> String {
    match sizes {
        [one] => format!("({one},)"),
        _ => format!("({})", listed(sizes)),
    }
}

/// A shape with any leading dimensions: (..., 4, 4), (...).
pub(super) fn shape_of_rows(tail: &[usize]) -> String {
    if tail.is_empty() { "(...)".to_owned() } else { format!("(..., {})", listed(tail)) }
}

/// The index of an element by its number in row-major order.
pub(super) fn index_in(shape: &[usize], mut number: usize) -> Vec<usize> {
    let mut index: Vec<usize> = shape
        .iter()
        .rev()
        .map(|size| {
            let at = number % size;
            number /= size;
            at
        })
        .collect();
    index.reverse();
    index
}

fn listed(sizes: &[usize]) -> String {
    sizes.iter().map(usize::to_string).collect::<Vec<_>>().join(", ")
}

/// What NumPy makes no numbers of, and how it is passed where that is known.
pub(super) fn no_numbers(value: &Bound<'_, PyAny>, dtype: &str) -> String {
    if value.is_none() {
        return "None".to_owned();
    }
    let name = |object: &Bound<'_, PyAny>| {
        object.get_type().name().map_or_else(|_| "object".to_owned(), |name| name.to_string())
    };
    if let Some(how) = conversion(value) {
        return format!("a {}: pass {how}", name(value));
    }
    let first = first_of(value);
    if let Some((first, how)) = first.and_then(|first| Some((name(&first), conversion(&first)?))) {
        return format!("a list of {first}: pass {how} of each");
    }
    format!("an array of dtype {dtype}")
}

fn first_of<'py>(value: &Bound<'py, PyAny>) -> Option<Bound<'py, PyAny>> {
    if let Ok(list) = value.cast::<PyList>() {
        return list.get_item(0).ok();
    }
    value.cast::<PyTuple>().ok()?.get_item(0).ok()
}

/// How an object that stands for a pose or for joints is made an array.
fn conversion(value: &Bound<'_, PyAny>) -> Option<&'static str> {
    let py = value.py();
    let has = |name| value.hasattr(name).unwrap_or(false);
    if has(intern!(py, "tframe")) {
        return Some(".tframe.matrix()");
    }
    if has(intern!(py, "uframe")) {
        return Some(".uframe.matrix() @ its .oframe.matrix()");
    }
    if has(intern!(py, "robax_deg")) {
        return Some("np.radians of its .robax_deg");
    }
    if has(intern!(py, "as_quat")) && !has(intern!(py, "translation")) {
        return Some("irbkin.pose(xyz, wxyz=rotation.as_quat(scalar_first=True))");
    }
    if has(intern!(py, "as_matrix")) {
        return Some(".as_matrix()");
    }
    has(intern!(py, "matrix")).then_some(".matrix()")
}
