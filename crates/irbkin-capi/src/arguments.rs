//! Pointers of a caller as references, slices, texts and poses.
//!
//! Each function refuses NULL, and addresses and lengths that no Rust slice has. It cannot see
//! whether the memory is the caller's: that is the contract of the header.

use core::ffi::{CStr, c_char};

use irbkin::nalgebra::{Matrix3, Rotation3, Translation3};
use irbkin::thresholds::MOST_ANGLE;
use irbkin::{Pose, pose};

use crate::fault::Fault;

/// Check the address of `len` values.
fn check<T>(argument: &'static str, pointer: *const T, len: usize) -> Result<(), Fault> {
    let most = isize::MAX.unsigned_abs() / size_of::<T>();
    if len > most {
        return Err(Fault::TooLong { argument, found: len, most });
    }
    if pointer.is_null() {
        return Err(Fault::Null { argument });
    }
    if !pointer.is_aligned() {
        return Err(Fault::Misaligned { argument, wanted: align_of::<T>() });
    }
    Ok(())
}

pub(crate) fn check_length(
    argument: &'static str,
    found: usize,
    wanted: usize,
) -> Result<(), Fault> {
    if found == wanted { Ok(()) } else { Err(Fault::Length { argument, found, wanted }) }
}

/// Check that what is read and what will be written do not overlap.
pub(crate) fn check_apart(
    (argument, read): (&'static str, &[f64]),
    (other, written, len): (&'static str, *const f64, usize),
) -> Result<(), Fault> {
    let (start, read) = (written.addr(), read.as_ptr_range());
    let end = start.saturating_add(len.saturating_mul(size_of::<f64>()));
    if read.start.addr() < end && start < read.end.addr() {
        return Err(Fault::Overlap { argument, other });
    }
    Ok(())
}

/// An argument that may be left out: `read` is called unless it is NULL.
pub(crate) fn given<P, T>(
    pointer: *const P,
    read: impl FnOnce() -> Result<T, Fault>,
) -> Result<Option<T>, Fault> {
    (!pointer.is_null()).then(read).transpose()
}

/// A value.
///
/// # Safety
///
/// The pointer is NULL or of a living value that does not change during the call.
pub(crate) unsafe fn reference<'a, T>(
    argument: &'static str,
    pointer: *const T,
) -> Result<&'a T, Fault> {
    check(argument, pointer, 1)?;
    // SAFETY: it is not NULL and aligned; the rest is the caller's contract.
    Ok(unsafe { &*pointer })
}

/// Values to read.
///
/// # Safety
///
/// The pointer is NULL or of `len` values that do not change during the call.
pub(crate) unsafe fn slice<'a, T>(
    argument: &'static str,
    pointer: *const T,
    len: usize,
) -> Result<&'a [T], Fault> {
    if len == 0 {
        return Ok(&[]);
    }
    check(argument, pointer, len)?;
    // SAFETY: as in `reference`, and the length is not too large.
    Ok(unsafe { core::slice::from_raw_parts(pointer, len) })
}

/// Values to write.
///
/// # Safety
///
/// The pointer is NULL or of `len` values that only this call uses.
pub(crate) unsafe fn slice_mut<'a, T>(
    argument: &'static str,
    pointer: *mut T,
    len: usize,
) -> Result<&'a mut [T], Fault> {
    if len == 0 {
        return Ok(&mut []);
    }
    check(argument, pointer, len)?;
    // SAFETY: as in `slice`.
    Ok(unsafe { core::slice::from_raw_parts_mut(pointer, len) })
}

/// `K` values to read.
///
/// # Safety
///
/// As of [`slice`].
pub(crate) unsafe fn array<'a, T, const K: usize>(
    argument: &'static str,
    pointer: *const T,
) -> Result<&'a [T; K], Fault> {
    // SAFETY: as of the caller.
    unsafe { reference(argument, pointer.cast()) }
}

/// `K` values to write.
///
/// # Safety
///
/// As of [`slice_mut`].
pub(crate) unsafe fn array_mut<'a, T, const K: usize>(
    argument: &'static str,
    pointer: *mut T,
) -> Result<&'a mut [T; K], Fault> {
    check(argument, pointer, K)?;
    // SAFETY: it is not NULL and aligned; the rest is the caller's contract.
    Ok(unsafe { &mut *pointer.cast() })
}

/// A text.
///
/// # Safety
///
/// The pointer is NULL or of bytes that end with a zero.
pub(crate) unsafe fn text<'a>(
    argument: &'static str,
    pointer: *const c_char,
) -> Result<&'a str, Fault> {
    check(argument, pointer, 1)?;
    // SAFETY: it is not NULL; the zero is the caller's contract.
    let text = unsafe { CStr::from_ptr(pointer) };
    text.to_str().map_err(|error| Fault::Text { argument, at: error.valid_up_to() })
}

/// A pose by the 16 elements of its matrix.
///
/// # Safety
///
/// As of [`slice`].
pub(crate) unsafe fn pose(argument: &'static str, pointer: *const f64) -> Result<Pose, Fault> {
    // SAFETY: as of the caller.
    let rows = unsafe { array(argument, pointer) }?;
    pose::from_rows(rows).map_err(|error| match argument {
        // The message names it by itself.
        "pose" => error.into(),
        _ => Fault::of(argument)(error),
    })
}

/// A pose for a call that checks it anyway.
///
/// # Safety
///
/// As of [`slice`].
pub(crate) unsafe fn unchecked_pose(
    argument: &'static str,
    pointer: *const f64,
) -> Result<Pose, Fault> {
    // SAFETY: as of the caller.
    let rows: &[f64; 16] = unsafe { array(argument, pointer) }?;
    let &[a, b, c, x, d, e, f, y, g, h, i, z, 0.0, 0.0, 0.0, 1.0] = rows else {
        // SAFETY: as of the caller.
        return unsafe { pose(argument, pointer) };
    };
    let rotation = Rotation3::from_matrix_unchecked(Matrix3::new(a, b, c, d, e, f, g, h, i));
    Ok(Pose::from_parts(Translation3::new(x, y, z), rotation))
}

/// The joint angles of an arm, each finite.
pub(crate) fn joints<'a, const N: usize>(
    argument: &'static str,
    q: &'a [f64],
) -> Result<&'a [f64; N], Fault> {
    let angles = q.try_into().map_err(|_| Fault::Length { argument, found: q.len(), wanted: N })?;
    let fits = |angle: &f64| angle.abs() <= MOST_ANGLE;
    match q.iter().position(|angle| !fits(angle)) {
        None => Ok(angles),
        Some(index) => {
            let value = q.get(index).copied().unwrap_or(f64::NAN);
            Err(Fault::Angle { argument, index, value, bound: MOST_ANGLE })
        }
    }
}
