//! Checks of the joint vectors, weights and joint angles that a caller passes.

use crate::error::{Error, JointFault};
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::thresholds::{FARTHEST_OUTSIDE, MOST_ANGLE};

/// Check that every angle of a joint vector is finite.
#[doc(hidden)]
pub fn check_joints(field: &'static str, q: &[f64]) -> Result<(), Error> {
    match q.iter().position(|angle| !angle.is_finite()) {
        Some(i) => Err(JointFault::NotFinite { field, joint: i + 1, value: q[i] }.into()),
        None => Ok(()),
    }
}

/// Check a joint vector that a search starts from: finite, each angle at most [`MOST_ANGLE`].
#[doc(hidden)]
pub fn check_seed(field: &'static str, q: &[f64]) -> Result<(), Error> {
    q.iter().enumerate().try_for_each(|(i, angle)| check_angle(field, i + 1, *angle))
}

/// Check a seed as [`check_seed`] and [`check_near`] do.
pub(crate) fn check_seed_near<const N: usize>(
    seed: &[f64; N],
    limits: &JointLimits<N>,
    weights: &[f64; N],
) -> Result<(), Error> {
    check_seed("seed", seed)?;
    check_near("seed", seed, limits, weights)
}

/// Check that a joint vector is not far outside its limits, as one in degrees is. A joint without a
/// weight may be anywhere.
#[doc(hidden)]
pub fn check_near<const N: usize>(
    field: &'static str,
    q: &[f64; N],
    limits: &JointLimits<N>,
    weights: &[f64; N],
) -> Result<(), Error> {
    for (joint, [lower, upper]) in limits.to_array().into_iter().enumerate() {
        let (value, bounds) = (q[joint], [lower, upper]);
        let is_far = value < lower - FARTHEST_OUTSIDE || value > upper + FARTHEST_OUTSIDE;
        // Larger angles are no degrees: other checks reject them, where they matter.
        if is_far && weights[joint] > 0.0 && value.abs() <= MOST_ANGLE {
            return Err(JointFault::FarOutside { field, joint: joint + 1, value, bounds }.into());
        }
    }
    Ok(())
}

/// Check the angle of a joint (from 1) that is copied into the answer: beyond [`MOST_ANGLE`], turns
/// of 2 pi would cost the answer its digits.
pub(crate) fn check_angle(field: &'static str, joint: usize, value: f64) -> Result<(), Error> {
    if !value.is_finite() {
        return Err(JointFault::NotFinite { field, joint, value }.into());
    }
    if value.abs() > MOST_ANGLE {
        return Err(JointFault::TooLarge { field, joint, value, bound: MOST_ANGLE }.into());
    }
    Ok(())
}

/// Check an arm angle, as [`check_angle`] checks a joint.
pub(crate) fn check_arm_angle(value: f64) -> Result<(), Error> {
    if value.abs() <= MOST_ANGLE {
        Ok(())
    } else {
        Err(JointFault::ArmAngle { value, bound: MOST_ANGLE }.into())
    }
}

/// Check that weights are finite and not negative.
#[doc(hidden)]
pub fn check_weights(weights: &[f64]) -> Result<(), Error> {
    match weights.iter().position(|weight| !(weight.is_finite() && *weight >= 0.0)) {
        Some(i) => Err(JointFault::Weight { joint: i + 1, value: weights[i] }.into()),
        None => Ok(()),
    }
}
