//! Limits that a caller gives, checked.

use crate::error::{Error, MotionFault};

/// Limits are positive; infinity is none.
pub(super) fn check(field: &'static str, limits: &[f64]) -> Result<(), Error> {
    match limits.iter().position(|limit| limit.is_nan() || *limit <= 0.0) {
        None => Ok(()),
        Some(index) => {
            let value = limits[index];
            Err(MotionFault::NotPositive { field, index: Some(index), value }.into())
        }
    }
}

/// Numbers that must be finite.
pub(super) fn check_finite(field: &'static str, numbers: &[f64]) -> Result<(), Error> {
    match numbers.iter().position(|number| !number.is_finite()) {
        None => Ok(()),
        Some(index) => Err(MotionFault::NotFinite { field, index, value: numbers[index] }.into()),
    }
}
