//! A straight line of the tool, its orientation turning evenly.

use core::f64::consts::TAU;

use nalgebra::{Matrix3, Rotation3, Translation3, Vector3};

use super::spacing::Spacing;
use crate::error::{Error, MotionFault};
use crate::paths::thresholds::{HALF_TURN_COS, LEAST_ALONG, STEP_ROUNDING};
use crate::prelude::*;
use irbkin::Pose;
use irbkin::internal::checked_pose;
use irbkin::pose::to_wxyz as pose_to_wxyz;

/// Poses along a line, both ends included: the position goes straight, the orientation turns about
/// one axis (slerp), both in equal steps (eq. 17, 18).
///
/// Of a half turn, `axis` chooses the way, as seen from the base.
///
/// # Errors
///
/// [`irbkin::Error::InvalidPose`] for a pose that is not a rigid transform; [`Error::InvalidMotion`] for a
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
    let steps = spacing.steps_of_one([line.length, line.turn.angle])?;
    let mut poses = Vec::with_capacity(steps + 1);
    poses.push(start);
    poses.extend((1..steps).map(|step| {
        let part = part(step, steps);
        Pose::from_parts(Translation3::from(line.position(part)), line.turn.at(part))
    }));
    if steps > 0 {
        poses.push(end);
    }
    Ok(poses)
}

/// A line whose orientation turns evenly about one axis (eq. 17, 18); parts of it are from 0 to 1.
pub struct Line {
    start: Vector3<f64>,
    way: Vector3<f64>,
    /// Its length [m].
    pub(super) length: f64,
    pub(super) turn: Turn,
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

    pub(super) fn position(&self, part: f64) -> Vector3<f64> {
        self.start + self.way * part
    }

    /// The direction: a vector of length one, or zero of a line without length.
    pub(super) fn direction(&self) -> Vector3<f64> {
        if self.length == 0.0 { self.way } else { self.way / self.length }
    }
}

/// A part of the way, exact at both ends.
#[expect(clippy::cast_precision_loss, reason = "at most 1e7 steps")]
pub fn part(step: usize, steps: usize) -> f64 {
    step as f64 / steps as f64
}

/// A rotation about one axis from one orientation to another: slerp, by rotation matrices.
///
/// R(s) = R0 + sin(s angle) A + (1 - cos(s angle)) B, with A = R0 K, B = R0 K^2 and K the cross
/// product with the axis (Rodrigues' formula, eq. 18).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turn {
    start: Matrix3<f64>,
    sin_part: Matrix3<f64>,
    cos_part: Matrix3<f64>,
    axis: Vector3<f64>,
    pub(crate) angle: f64,
}

impl Turn {
    /// The shortest turn; of a half turn that about the `axis` which points more the way that it
    /// is given, seen from the base. `index` is the pose that an error names.
    pub(crate) fn new(
        start: &Rotation3<f64>,
        end: &Rotation3<f64>,
        axis: Option<&Vector3<f64>>,
        index: usize,
    ) -> Result<Self, Error> {
        let (mut w, mut v) = quaternion(start, end);
        if w < HALF_TURN_COS {
            let angle = 2.0 * v.norm().atan2(w);
            let axis = axis.ok_or(MotionFault::HalfTurn { index, angle })?;
            let along = (start.inverse() * axis).dot(&v) / (axis.norm() * v.norm());
            if along.is_nan() || along.abs() < LEAST_ALONG {
                return Err(MotionFault::Axis { along }.into());
            }
            if along < 0.0 {
                (w, v) = (-w, -v);
            }
        }
        let size = v.norm();
        let unit = if size > 0.0 { v / size } else { Vector3::zeros() };
        Ok(Self::about(start, &unit, 2.0 * size.atan2(w)))
    }

    /// The turn that passes nearer to an orientation at a part of the way: the shorter one, unless
    /// the other direction is twice as near, or nearer of a half turn.
    pub(super) fn past(
        [start, via, end]: [&Rotation3<f64>; 3],
        part: f64,
        index: usize,
    ) -> Result<Self, Error> {
        let (w, v) = quaternion(start, end);
        let angle = 2.0 * v.norm().atan2(w);
        // The axis of so small a turn is rounding: there is no other direction.
        if angle < STEP_ROUNDING {
            return Ok(Self::by(start, &(2.0 * v)));
        }
        let unit = v / v.norm();
        let short = Self::about(start, &unit, angle);
        let long = Self::about(start, &-unit, TAU - angle);
        let [near, far] = [short, long].map(|it| (it.at(part).matrix() - via.matrix()).norm());
        let is_half = w < HALF_TURN_COS;
        if is_half && (near - far).abs() < LEAST_ALONG {
            return Err(MotionFault::HalfTurn { index, angle }.into());
        }
        Ok(if far < if is_half { near } else { 0.5 * near } { long } else { short })
    }

    /// By an angle [rad] about an axis of length 1, as seen from the orientation at the start; of
    /// an angle of 0 it may have no length.
    fn about(start: &Rotation3<f64>, unit: &Vector3<f64>, angle: f64) -> Self {
        let start = *start.matrix();
        let sin_part = start * unit.cross_matrix();
        Self { start, sin_part, cos_part: sin_part * unit.cross_matrix(), axis: *unit, angle }
    }

    /// By a rotation vector [rad], as seen from the orientation at the start.
    pub(super) fn by(start: &Rotation3<f64>, vector: &Vector3<f64>) -> Self {
        let angle = vector.norm();
        let unit = if angle > 0.0 { vector / angle } else { Vector3::zeros() };
        Self::about(start, &unit, angle)
    }

    /// The rotation vector from start to end [rad], the same as seen from either.
    pub(super) fn vector(&self) -> Vector3<f64> {
        self.axis * self.angle
    }

    /// The orientation at a part of the way, 0 to 1.
    pub(crate) fn at(&self, part: f64) -> Rotation3<f64> {
        let (sin, cos) = (part * self.angle).sin_cos();
        // 1 - cos without cancellation.
        let versine = if cos > 0.0 { sin * sin / (1.0 + cos) } else { 1.0 - cos };
        let matrix = self.start + self.sin_part * sin + self.cos_part * versine;
        Rotation3::from_matrix_unchecked(matrix)
    }
}

/// The rotation from one orientation to another as a quaternion, w not negative.
fn quaternion(start: &Rotation3<f64>, end: &Rotation3<f64>) -> (f64, Vector3<f64>) {
    let relative = Pose::from_parts(Translation3::identity(), start.inverse() * end);
    let (_, [w, x, y, z]) = pose_to_wxyz(&relative);
    (w, Vector3::new(x, y, z))
}
