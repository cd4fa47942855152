//! Triangles: the nearest points of a segment and a triangle, and the point nearest to the origin.

use nalgebra::Vector3;

use super::segment::{NOWHERE, Nearest, Segment, at, between, nearer, part_near};
use super::tree::{square_along, way_to};

/// The corners of a triangle [m].
pub(super) type Triangle = [Vector3<f64>; 3];

/// Square of the height of a triangle over its longest edge, below which rounding moves the foot of
/// a perpendicular by more than 1e-12 of the edge [1].
const SLIVER: f64 = 1e-8;

pub(super) fn edges([a, b, c]: &Triangle) -> [Segment; 3] {
    [[*a, *b], [*b, *c], [*c, *a]]
}

/// The nearest points of a segment and a triangle: the point at which the segment goes through, or
/// the end that is nearer to the plane and its foot, or points of the segment and an edge. While
/// another point of the segment has a foot inside, one towards the plane is nearer.
///
/// A triangle whose corners are on a line is its edges.
pub(super) fn segment_and(triangle: &Triangle, segment: &Segment) -> Nearest {
    let [a, b, c] = triangle;
    let normal = (b - a).cross(&(c - a));
    let [first, last] = segment.map(|end| normal.dot(&(end - a)));
    let part = if first * last < 0.0 {
        first / (first - last)
    } else {
        f64::from(u8::from(last.abs() < first.abs()))
    };
    let point = at(segment, part);
    let foot = foot(triangle, &normal, &point);
    let nearest = foot.map_or(NOWHERE, |foot| nearer(NOWHERE, point, foot));
    let length = edges(triangle)
        .iter()
        .fold(0.0_f64, |most, [from, to]| most.max((to - from).norm_squared()));
    if foot.is_some() && normal.norm_squared() > SLIVER * length * length {
        return nearest;
    }
    edges(triangle).iter().fold(nearest, |nearest, edge| {
        let of_edge = between(segment, edge);
        if of_edge.0 < nearest.0 { of_edge } else { nearest }
    })
}

/// A square [m^2] that the square of the distance of a triangle from a segment is not less than, up
/// to rounding (docs/theory/cell.md, eq. 7).
pub(super) fn square_outside(triangle: &Triangle, segment: &Segment) -> f64 {
    let [a, b, c] = triangle;
    let middle = (a + b + c) / 3.0;
    let way = way_to(segment, &middle);
    let begin = middle - way;
    let along = triangle.map(|corner| way.dot(&(corner - begin)));
    square_along(&way, along[0].min(along[1]).min(along[2]))
}

/// The foot of the perpendicular from a point, if it is inside the triangle.
fn foot([a, b, c]: &Triangle, normal: &Vector3<f64>, point: &Vector3<f64>) -> Option<Vector3<f64>> {
    let [of_a, of_b, of_c] = [a, b, c].map(|corner| corner - point);
    // The weights of the corners, each times the square of the normal.
    let weights = [of_b.cross(&of_c), of_c.cross(&of_a), of_a.cross(&of_b)];
    let [at_a, at_b, at_c] = weights.map(|weight| weight.dot(normal));
    let sum = at_a + at_b + at_c;
    let is_inside = at_a >= 0.0 && at_b >= 0.0 && at_c >= 0.0 && sum > 0.0;
    is_inside.then(|| a + ((b - a) * at_b + (c - a) * at_c) / sum)
}

/// The weights of the corners at the point of a triangle that is nearest to the origin.
pub(super) fn nearest_to_origin(corners: &Triangle) -> [f64; 3] {
    let [a, b, c] = corners;
    let normal = (b - a).cross(&(c - a));
    let inside = [b.cross(c), c.cross(a), a.cross(b)].map(|weight| weight.dot(&normal));
    let sum: f64 = inside.iter().sum();
    if inside.iter().all(|weight| *weight >= 0.0) && sum > 0.0 {
        return inside.map(|weight| weight / sum);
    }
    let mut best = (f64::INFINITY, [1.0, 0.0, 0.0]);
    for (first, edge) in edges(corners).iter().enumerate() {
        let part = part_near(edge, &Vector3::zeros());
        let square = at(edge, part).norm_squared();
        if square < best.0 {
            let mut weights = [0.0; 3];
            (weights[first], weights[(first + 1) % 3]) = (1.0 - part, part);
            best = (square, weights);
        }
    }
    best.1
}
