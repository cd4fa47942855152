//! Points of line segments, and the nearest points of two.
//!
//! Reference: Ericson, Real-Time Collision Detection, 2005, section 5.1.

use nalgebra::Vector3;

/// The ends of a line segment [m].
pub(super) type Segment = [Vector3<f64>; 2];

/// The square of the distance of two points [m^2], and the points [m].
pub(super) type Nearest = (f64, [Vector3<f64>; 2]);

/// Farther than any pair of points.
pub(super) const NOWHERE: Nearest = (f64::INFINITY, [Vector3::new(0.0, 0.0, 0.0); 2]);

pub(super) fn nearer(one: Nearest, from: Vector3<f64>, to: Vector3<f64>) -> Nearest {
    let square = (from - to).norm_squared();
    if square < one.0 { (square, [from, to]) } else { one }
}

/// The point of a segment that is `part` of the way from one end to the other.
#[inline]
pub(super) fn at(segment: &Segment, part: f64) -> Vector3<f64> {
    segment[0] + (segment[1] - segment[0]) * part
}

/// The part of a segment at which it is nearest to a point.
#[inline]
pub(super) fn part_near(segment: &Segment, point: &Vector3<f64>) -> f64 {
    let axis = segment[1] - segment[0];
    let length = axis.norm_squared();
    if length == 0.0 { 0.0 } else { (axis.dot(&(point - segment[0])) / length).clamp(0.0, 1.0) }
}

/// The nearest points of two segments: of their lines, with the parts limited one after the other.
///
/// Products of vectors, not of their squares, find the nearest points of nearly parallel lines to
/// the rounding of their coordinates (docs/theory/cell.md, eq. 6).
pub(super) fn between(one: &Segment, other: &Segment) -> Nearest {
    let (along, other_along) = (one[1] - one[0], other[1] - other[0]);
    let across = along.cross(&other_along);
    let square = across.norm_squared();
    let part = if square > 0.0 {
        let part = other_along.cross(&(one[0] - other[0])).dot(&across) / square;
        part.clamp(0.0, 1.0)
    } else {
        0.0
    };
    let to = at(other, part_near(other, &at(one, part)));
    // Where the part of the other is limited, this one moves; elsewhere it stays, up to rounding.
    let from = at(one, part_near(one, &to));
    nearer(NOWHERE, from, to)
}
