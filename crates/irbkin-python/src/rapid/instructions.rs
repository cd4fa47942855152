//! `irbkin._core.instructions`: RAPID's own instructions and functions, for an editor.

use pyo3::prelude::*;

use irbkin_abb::rapid::internal::Entry;

/// Return RAPID's own instructions and functions: rows of name, kind and arguments.
///
/// The kind is "instruction" or "function". The arguments are as in the header of a routine, with
/// `...` for those that are not known.
#[pyfunction]
pub(crate) fn instructions() -> Vec<(&'static str, &'static str, &'static str)> {
    let kind = |is_function| if is_function { "function" } else { "instruction" };
    Entry::all().map(|(name, arguments, is)| (name, kind(is), arguments)).collect()
}
