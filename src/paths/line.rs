//! A straight line of the tool, its orientation turning evenly.

use alloc::vec::Vec;

use nalgebra::{Rotation3, Translation3, Vector3};

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
    let line = Line::new([&start, &end], axis.map(Vector3::from).as_ref(), 1)?;
    let steps = spacing.steps_of_one([line.length(), line.angle()])?;
    let mut poses = Vec::with_capacity(steps + 1);
    poses.push(start);
    poses.extend((1..steps).map(|step| {
        let part = part(step, steps);
        Pose::from_parts(Translation3::from(line.position(part)), line.orientation(part))
    }));
    if steps > 0 {
        poses.push(end);
    }
    Ok(poses)
}

/// A line whose orientation turns evenly about one axis (eq. 17, 18); parts of it are from 0 to 1.
pub(crate) struct Line {
    start: Vector3<f64>,
    way: Vector3<f64>,
    length: f64,
    turn: Turn,
}

impl Line {
    /// Of a half turn, `axis` chooses the way; `index` is the pose that an error names.
    pub(super) fn new(
        [start, end]: [&Pose; 2],
        axis: Option<&Vector3<f64>>,
        index: usize,
    ) -> Result<Self, Error> {
        let way = end.translation.vector - start.translation.vector;
        let turn = Turn::new(&start.rotation, &end.rotation, axis, index)?;
        Ok(Self { start: start.translation.vector, way, length: way.norm(), turn })
    }

    /// Its length [m].
    pub(super) fn length(&self) -> f64 {
        self.length
    }

    /// The angle that the tool turns by [rad].
    pub(super) fn angle(&self) -> f64 {
        self.turn.angle
    }

    /// The position at a part of the way.
    pub(super) fn position(&self, part: f64) -> Vector3<f64> {
        self.start + self.way * part
    }

    /// The direction: a vector of length one, or zero of a line without length.
    pub(super) fn direction(&self) -> Vector3<f64> {
        if self.length == 0.0 { self.way } else { self.way / self.length }
    }

    /// The orientation at a part of the way.
    pub(super) fn orientation(&self, part: f64) -> Rotation3<f64> {
        self.turn.at(part)
    }
}

/// A part of the way, exact at both ends.
#[expect(clippy::cast_precision_loss, reason = "at most 1e7 steps")]
pub(crate) fn part(step: usize, steps: usize) -> f64 {
    step as f64 / steps as f64
}
