//! Flat slices seen as rows.

use crate::error::Error;

/// The whole rows of an input.
#[doc(hidden)]
pub fn rows<'a, const R: usize>(
    field: &'static str,
    numbers: &'a [f64],
) -> Result<&'a [[f64; R]], Error> {
    match numbers.as_chunks::<R>() {
        (rows, []) => Ok(rows),
        _ => Err(Error::WrongLength {
            field,
            found: numbers.len(),
            wanted: numbers.len().div_ceil(R) * R,
        }),
    }
}

/// The rows of an input of which there must be `count`.
pub(super) fn rows_for<'a, const R: usize>(
    field: &'static str,
    numbers: &'a [f64],
    count: usize,
) -> Result<&'a [[f64; R]], Error> {
    check_length(field, numbers.len(), count * R)?;
    Ok(numbers.as_chunks::<R>().0)
}

/// The rows of an output for `count` answers.
pub(super) fn rows_out<'a, const R: usize, T>(
    field: &'static str,
    out: &'a mut [T],
    count: usize,
) -> Result<&'a mut [[T; R]], Error> {
    check_length(field, out.len(), count * R)?;
    Ok(out.as_chunks_mut::<R>().0)
}

/// Check the number of elements of a slice.
#[doc(hidden)]
pub fn check_length(field: &'static str, found: usize, wanted: usize) -> Result<(), Error> {
    if found == wanted { Ok(()) } else { Err(Error::WrongLength { field, found, wanted }) }
}

pub(super) fn is_finite(q: &[f64]) -> bool {
    q.iter().all(|angle| angle.is_finite())
}
