//! Joint vectors, weights and given angles that a caller passed.

use crate::error::{Error, JointFault};
use crate::kinematics::thresholds::MOST_ANGLE;

/// A joint vector of which every angle is finite.
#[cfg(feature = "python")]
pub(crate) fn check_joints(field: &'static str, q: &[f64]) -> Result<(), Error> {
    match q.iter().position(|angle| !angle.is_finite()) {
        Some(i) => Err(JointFault::NotFinite { field, joint: i + 1, value: q[i] }.into()),
        None => Ok(()),
    }
}

/// A joint vector that answers are counted from: finite, and each angle at most [`MOST_ANGLE`].
pub(crate) fn check_seed(field: &'static str, q: &[f64]) -> Result<(), Error> {
    q.iter().enumerate().try_for_each(|(i, angle)| check_angle(field, i + 1, *angle))
}

/// The angle of a joint, from 1, that an answer takes over: beyond [`MOST_ANGLE`], whole turns
/// would cost the answer its digits.
pub(crate) fn check_angle(field: &'static str, joint: usize, value: f64) -> Result<(), Error> {
    if !value.is_finite() {
        return Err(JointFault::NotFinite { field, joint, value }.into());
    }
    if value.abs() > MOST_ANGLE {
        return Err(JointFault::TooLarge { field, joint, value, bound: MOST_ANGLE }.into());
    }
    Ok(())
}

/// Weights that are finite and not negative.
pub(crate) fn check_weights(weights: &[f64]) -> Result<(), Error> {
    match weights.iter().position(|weight| !(weight.is_finite() && *weight >= 0.0)) {
        Some(i) => Err(JointFault::Weight { joint: i + 1, value: weights[i] }.into()),
        None => Ok(()),
    }
}
