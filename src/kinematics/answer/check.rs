//! Joint vectors, weights and given angles that a caller passed.

use crate::error::{Error, JointFault};

/// A joint vector of which every angle is finite.
pub(crate) fn check_joints(field: &'static str, q: &[f64]) -> Result<(), Error> {
    match q.iter().position(|angle| !angle.is_finite()) {
        Some(i) => Err(JointFault::NotFinite { field, joint: i + 1, value: q[i] }.into()),
        None => Ok(()),
    }
}

/// Weights that are finite and not negative.
pub(crate) fn check_weights(weights: &[f64]) -> Result<(), Error> {
    match weights.iter().position(|weight| !(weight.is_finite() && *weight >= 0.0)) {
        Some(i) => Err(JointFault::Weight { joint: i + 1, value: weights[i] }.into()),
        None => Ok(()),
    }
}
