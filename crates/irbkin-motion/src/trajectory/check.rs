//! Checks of what a caller gives.

use super::axis::AxisLimits;
use crate::error::{Error, MotionFault};
use crate::trajectory::thresholds::{LEAST_DURATION, MOST_DURATION};
use irbkin::internal::thresholds::FARTHEST_OUTSIDE;
use irbkin::internal::{JointFault, check_length, check_seed};

/// Joints of an arm, at least: most of them beyond four turns are in degrees.
const LEAST_JOINTS: usize = 6;

/// Check that a limit is positive; infinity is no limit.
pub(crate) fn check_limit(
    field: &'static str,
    index: Option<usize>,
    value: f64,
) -> Result<(), MotionFault> {
    if value > 0.0 { Ok(()) } else { Err(MotionFault::NotPositive { field, index, value }) }
}

/// [`check_limit`] of each of some.
pub(crate) fn check_limits(field: &'static str, limits: &[f64]) -> Result<(), Error> {
    let mut all = limits.iter().enumerate();
    Ok(all.try_for_each(|(index, limit)| check_limit(field, Some(index), *limit))?)
}

/// Check limits along a path, and return how many joints they are for.
pub(super) fn check_path_limits(
    max_velocity: &[f64],
    max_acceleration: &[f64],
) -> Result<usize, Error> {
    check_limits("max_velocity", max_velocity)?;
    check_limits("max_acceleration", max_acceleration)?;
    let dof = max_velocity.len();
    check_length("max_acceleration", max_acceleration.len(), dof)?;
    Ok(dof)
}

/// Check the limits of `dof` joints.
pub(super) fn check_axes(limits: &[AxisLimits], dof: usize) -> Result<(), Error> {
    check_length("limits", limits.len(), dof)?;
    for (joint, limits) in limits.iter().enumerate() {
        for (field, value) in [
            ("max_velocity", limits.velocity),
            ("max_acceleration", limits.acceleration),
            ("max_jerk", limits.jerk),
        ] {
            check_limit(field, Some(joint), value)?;
        }
    }
    Ok(())
}

pub(crate) fn check_joints(field: &'static str, q: &[f64]) -> Result<(), Error> {
    if q.is_empty() {
        return Err(MotionFault::NoJoints { field }.into());
    }
    check_seed(field, q)?;
    in_degrees(field, q, q.len()).map_or(Ok(()), |(_, fault)| Err(fault.into()))
}

/// Check the angles of joint vectors, rows of `dof` numbers.
pub(super) fn check_rows(field: &'static str, q: &[f64], dof: usize) -> Result<(), Error> {
    if dof == 0 {
        return Err(MotionFault::NoJoints { field }.into());
    }
    for (row, q) in q.chunks_exact(dof).enumerate() {
        match check_seed(field, q) {
            Err(irbkin::Error::InvalidJoints(fault)) => {
                return Err(MotionFault::Row { row, fault }.into());
            }
            checked => checked?,
        }
    }
    in_degrees(field, q, dof)
        .map_or(Ok(()), |(row, fault)| Err(MotionFault::Row { row, fault }.into()))
}

/// The first row of joint vectors of an arm in which a joint is beyond [`FARTHEST_OUTSIDE`], where
/// more than half of the joints somewhere are.
fn in_degrees(field: &'static str, q: &[f64], dof: usize) -> Option<(usize, JointFault)> {
    let far =
        |joint: usize| q.chunks_exact(dof).position(|row| row[joint].abs() > FARTHEST_OUTSIDE);
    let joints = (0..dof).filter_map(|joint| Some((far(joint)?, joint)));
    if dof < LEAST_JOINTS || 2 * joints.clone().count() <= dof {
        return None;
    }
    let (row, joint) = joints.min()?;
    let (value, bound) = (q[row * dof + joint], FARTHEST_OUTSIDE);
    Some((row, JointFault::Degrees { field, joint: joint + 1, value, bound }))
}

/// Check a speed, a time, or another number that must be positive and finite.
#[doc(hidden)]
pub fn check_positive(field: &'static str, value: f64) -> Result<(), MotionFault> {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(MotionFault::NotPositive { field, index: None, value })
}

/// Check a duration [s].
pub(super) fn check_duration(value: f64) -> Result<(), Error> {
    check_positive("duration", value)?;
    let bounds = [LEAST_DURATION, MOST_DURATION];
    if value < bounds[0] || value > bounds[1] {
        return Err(MotionFault::Duration { value, bounds }.into());
    }
    Ok(())
}

pub(crate) fn check_finite(field: &'static str, numbers: &[f64]) -> Result<(), Error> {
    match numbers.iter().position(|number| !number.is_finite()) {
        None => Ok(()),
        Some(index) => Err(MotionFault::NotFinite { field, index, value: numbers[index] }.into()),
    }
}
