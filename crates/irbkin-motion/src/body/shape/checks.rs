//! Checks of the lengths and points of shapes.

use nalgebra::Vector3;

use super::tree::Bounds;
use crate::body::fault::BodyFault;
use crate::error::Error;
use crate::prelude::*;
use irbkin::Pose;
use irbkin::internal::checked_pose;
use irbkin::internal::thresholds::MOST_LENGTH;

/// Least size of a shape [m].
pub(super) const LEAST: f64 = 1e-6;

/// Size of a shape, and distance of its position from the origin, beyond which it counts as in
/// millimeters [m]: no cell is larger.
const MOST_SIZE: f64 = 100.0;

/// Most points or triangles of a shape: their numbers are 32 bits.
const MOST_COUNT: usize = 1 << 28;

/// Check a length of a shape [m].
pub(crate) fn check_length(field: &'static str, value: f64, least: f64) -> Result<(), Error> {
    // NaN is in no range.
    if value >= least && value <= MOST_LENGTH {
        Ok(())
    } else {
        Err(BodyFault::Length { field, value, least, most: MOST_LENGTH }.into())
    }
}

/// Check a length of a shape's own [m].
pub(super) fn check_size(
    shape: &'static str,
    field: &'static str,
    value: f64,
) -> Result<(), Error> {
    if value > MOST_SIZE {
        return Err(BodyFault::Large { shape, field, value, most: MOST_SIZE }.into());
    }
    check_length(field, value, LEAST)
}

/// Check a point of a shape [m].
pub(super) fn check_point(
    shape: &'static str,
    field: &'static str,
    point: &Vector3<f64>,
) -> Result<(), Error> {
    for (index, value) in point.iter().enumerate() {
        if value.is_nan() || value.abs() > MOST_SIZE {
            let (value, most) = (*value, MOST_SIZE);
            return Err(BodyFault::Point { shape, field, index, value, most }.into());
        }
    }
    Ok(())
}

/// Check the pose of a shape.
pub(super) fn placed(shape: &'static str, pose: &Pose) -> Result<Pose, Error> {
    let pose = checked_pose(pose)?;
    check_point(shape, "pose", &pose.translation.vector)?;
    Ok(pose)
}

/// Points of a shape, checked: finite, at least `least` of them, and together not so large that they
/// are in millimeters.
pub(super) fn check_points(
    shape: &'static str,
    field: &'static str,
    points: &[[f64; 3]],
    least: usize,
) -> Result<Vec<Vector3<f64>>, Error> {
    if points.len() < least || points.len() > MOST_COUNT {
        let count = points.len();
        return Err(BodyFault::Count { field, count, least, most: MOST_COUNT }.into());
    }
    let points: Vec<_> = points.iter().copied().map(Vector3::from).collect();
    for (row, point) in points.iter().enumerate() {
        if let Some(value) = point.iter().find(|value| !value.is_finite()) {
            return Err(BodyFault::Row { field, row, value: *value }.into());
        }
    }
    let Bounds { low, high } = Bounds::of(&points);
    let span = (high - low).max();
    if span > MOST_SIZE {
        return Err(BodyFault::Span { field, span, most: MOST_SIZE }.into());
    }
    for point in [low, high] {
        check_point(shape, field, &point)?;
    }
    Ok(points)
}
