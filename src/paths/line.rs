//! A straight line of the tool, its orientation turning evenly.

use alloc::vec::Vec;

use nalgebra::{Translation3, Vector3};

use super::spacing::Spacing;
use super::turn::Turn;
use crate::error::{Error, MotionFault};
use crate::kinematics::{Pose, checked_pose};

/// Poses along a line, both ends included: the position goes straight, the orientation turns about
/// one axis (slerp), both in equal steps (eq. 17, 18).
///
/// Of a half turn, `axis` chooses the way, as seen from the base.
///
/// # Errors
///
/// [`Error::InvalidPose`] for a pose that is not a rigid transform; [`Error::InvalidMotion`] for a
/// half turn without an axis, an axis that is not finite, or a spacing that leaves the number of
/// poses open.
pub fn line(
    start: &Pose,
    end: &Pose,
    spacing: Spacing,
    axis: Option<[f64; 3]>,
) -> Result<Vec<Pose>, Error> {
    let (start, end) = (checked_pose(start)?, checked_pose(end)?);
    if let Some(axis) = axis
        && let Some(index) = axis.iter().position(|number| !number.is_finite())
    {
        return Err(MotionFault::NotFinite { field: "axis", index, value: axis[index] }.into());
    }
    let axis = axis.map(Vector3::from);
    let turn = Turn::new(&start.rotation, &end.rotation, axis.as_ref(), 1)?;
    let way = end.translation.vector - start.translation.vector;
    let steps = spacing.steps_of_one([way.norm(), turn.angle])?;
    let mut poses = Vec::with_capacity(steps + 1);
    poses.push(start);
    poses.extend((1..steps).map(|step| {
        let part = part(step, steps);
        let position = start.translation.vector + way * part;
        Pose::from_parts(Translation3::from(position), turn.at(part))
    }));
    if steps > 0 {
        poses.push(end);
    }
    Ok(poses)
}

/// A part of the way, exact at both ends.
#[expect(clippy::cast_precision_loss, reason = "at most 1e7 steps")]
pub(crate) fn part(step: usize, steps: usize) -> f64 {
    step as f64 / steps as f64
}
