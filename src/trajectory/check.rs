//! Checks of what a caller gives.

use super::axis::AxisLimits;
use crate::error::{Error, MotionFault};
use crate::kinematics::check_seed;
use crate::kinematics::thresholds::{LEAST_DURATION, MOST_DURATION};

/// Check that limits are positive; infinity is no limit.
pub(super) fn check_limits(field: &'static str, limits: &[f64]) -> Result<(), Error> {
    match limits.iter().position(|limit| limit.is_nan() || *limit <= 0.0) {
        None => Ok(()),
        Some(index) => {
            let value = limits[index];
            Err(MotionFault::NotPositive { field, index: Some(index), value }.into())
        }
    }
}

/// Check limits along a path, and return how many joints they are for.
pub(super) fn check_path_limits(
    max_velocity: &[f64],
    max_acceleration: &[f64],
) -> Result<usize, Error> {
    check_limits("max_velocity", max_velocity)?;
    check_limits("max_acceleration", max_acceleration)?;
    let (found, wanted) = (max_acceleration.len(), max_velocity.len());
    if found != wanted {
        return Err(Error::WrongLength { field: "max_acceleration", found, wanted });
    }
    Ok(wanted)
}

/// Check the limits of `dof` joints.
pub(super) fn check_axes(limits: &[AxisLimits], dof: usize) -> Result<(), Error> {
    if limits.len() != dof {
        return Err(Error::WrongLength { field: "limits", found: limits.len(), wanted: dof });
    }
    for (joint, limits) in limits.iter().enumerate() {
        for (field, value) in [
            ("max_velocity", limits.velocity),
            ("max_acceleration", limits.acceleration),
            ("max_jerk", limits.jerk),
        ] {
            if value.is_nan() || value <= 0.0 {
                return Err(MotionFault::NotPositive { field, index: Some(joint), value }.into());
            }
        }
    }
    Ok(())
}

/// Check the angles of a joint vector.
pub(super) fn check_joints(field: &'static str, q: &[f64]) -> Result<(), Error> {
    if q.is_empty() {
        return Err(MotionFault::NoJoints { field }.into());
    }
    check_seed(field, q)
}

/// Check the angles of joint vectors, rows of `dof` numbers.
pub(super) fn check_rows(field: &'static str, q: &[f64], dof: usize) -> Result<(), Error> {
    if dof == 0 {
        return Err(MotionFault::NoJoints { field }.into());
    }
    for (row, q) in q.chunks_exact(dof).enumerate() {
        match check_seed(field, q) {
            Err(Error::InvalidJoints(fault)) => return Err(MotionFault::Row { row, fault }.into()),
            checked => checked?,
        }
    }
    Ok(())
}

/// Check a duration [s].
pub(super) fn check_duration(value: f64) -> Result<(), Error> {
    if value.is_nan() || value <= 0.0 || value.is_infinite() {
        return Err(MotionFault::NotPositive { field: "duration", index: None, value }.into());
    }
    let bounds = [LEAST_DURATION, MOST_DURATION];
    if value < bounds[0] || value > bounds[1] {
        return Err(MotionFault::Duration { value, bounds }.into());
    }
    Ok(())
}

/// Check that numbers are finite.
pub(super) fn check_finite(field: &'static str, numbers: &[f64]) -> Result<(), Error> {
    match numbers.iter().position(|number| !number.is_finite()) {
        None => Ok(()),
        Some(index) => Err(MotionFault::NotFinite { field, index, value: numbers[index] }.into()),
    }
}
