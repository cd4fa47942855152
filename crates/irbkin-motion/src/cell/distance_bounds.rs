//! How far apart things are, in lanes: bounds of the distance of an axis from an axis, a box
//! or a cylinder (docs/theory/cell.md).

use fearless_simd::prelude::*;
use nalgebra::Vector3;

use crate::body::{Bounds, Centered, Shape};
use irbkin::Pose;
use irbkin::internal::lanes::{Column, LANES, Number as _, Vector, dot};

pub(super) type Point<S> = [Vector<S>; 3];

/// The axis of a capsule, in lanes.
#[derive(Clone, Copy)]
pub(super) struct Axis<S: Simd> {
    pub(super) middle: Point<S>,
    /// From the middle to an end.
    pub(super) half: Point<S>,
    /// The square of this [m^2].
    pub(super) square: f64,
}

/// Lanes, as bits, in which two are certainly farther apart than a limit, and in which they are
/// certainly not.
#[derive(Clone, Copy, Default)]
pub(super) struct Decided {
    pub(super) far: u64,
    pub(super) near: u64,
}

impl Decided {
    pub(super) fn lanes(self) -> u64 {
        self.far | self.near
    }

    #[inline(always)]
    fn or(self, other: Self) -> Self {
        Self { far: self.far | other.far, near: self.near | other.near }
    }
}

/// All lanes, as bits.
pub(super) const ALL: u64 = (1 << LANES) - 1;

/// Rounds in which the nearest point of an axis is sought.
const ROUNDS: usize = 4;

#[inline(always)]
pub(super) fn load<S: Simd>(simd: S, columns: &[Column; 3]) -> Point<S> {
    [
        Vector::load_array_ref(simd, &columns[0]),
        Vector::load_array_ref(simd, &columns[1]),
        Vector::load_array_ref(simd, &columns[2]),
    ]
}

#[inline(always)]
pub(super) fn minus<S: Simd>(one: Point<S>, other: Point<S>) -> Point<S> {
    [one[0] - other[0], one[1] - other[1], one[2] - other[2]]
}

#[inline(always)]
pub(super) fn constant<S: Simd>(simd: S, point: &Vector3<f64>) -> Point<S> {
    [Vector::splat(simd, point.x), Vector::splat(simd, point.y), Vector::splat(simd, point.z)]
}

/// `from + along * part`
#[inline(always)]
fn at<S: Simd>(from: Point<S>, along: Point<S>, part: Vector<S>) -> Point<S> {
    [
        along[0].times_plus(part, from[0]),
        along[1].times_plus(part, from[1]),
        along[2].times_plus(part, from[2]),
    ]
}

/// A part of a half axis.
#[inline(always)]
fn clamped<S: Simd>(part: Vector<S>) -> Vector<S> {
    part.max(-1.0).min(1.0)
}

/// By how much the product of a half axis and a direction is less elsewhere on the axis at most.
#[inline(always)]
fn gap<S: Simd>(product: Vector<S>, part: Vector<S>) -> Vector<S> {
    product.times_plus(part, product.size())
}

/// The inverse of the square of the half of an axis; zero for a point.
#[inline(always)]
pub(super) fn inverse_of(square: f64) -> f64 {
    if square > 0.0 { 1.0 / square } else { 0.0 }
}

impl<S: Simd> Axis<S> {
    #[inline(always)]
    pub(super) fn new(middle: Point<S>, half: Point<S>, square: f64) -> Self {
        Self { middle, half, square }
    }

    /// An axis that is the same in all lanes.
    #[inline(always)]
    fn of(simd: S, own: &Centered) -> Self {
        Self::new(constant(simd, &own.center), constant(simd, &own.half), own.square)
    }

    /// Compare the distance from another axis with a limit [m], in the lanes that are asked (eq. 4).
    #[inline(always)]
    pub(super) fn against_axis(&self, other: &Self, limit: Vector<S>, asked: u64) -> Decided {
        let (one, two) = (self.half, other.half);
        let between = minus(self.middle, other.middle);
        let (c, f) = (dot(one, between), dot(two, between));
        let decided = decide(dot(between, between), c.size() + f.size(), limit);
        if asked & !decided.lanes() == 0 {
            return decided;
        }
        let (way, [first, second]) = self.way_from(other);
        let gaps = gap(dot(one, way), first) + gap(-dot(two, way), second);
        decided.or(decide(dot(way, way), gaps, limit))
    }

    /// The plane across the way to another axis, which it does not go beyond.
    #[inline(always)]
    pub(super) fn plane_to(&self, other: &Self) -> Plane<S> {
        let (way, _) = other.way_from(self);
        let reach = dot(way, self.middle) + dot(way, self.half).size();
        Plane { way, reach, radius: 0.0 }
    }

    /// The way between the points at which it and another axis are nearest, by their parts.
    #[inline(always)]
    pub(super) fn way_from(&self, other: &Self) -> (Point<S>, [Vector<S>; 2]) {
        let (one, two) = (self.half, other.half);
        let between = minus(self.middle, other.middle);
        let (b, c, f) = (dot(one, two), dot(one, between), dot(two, between));
        let across = (-(b * b) + self.square * other.square).max(f64::MIN_POSITIVE);
        let first = clamped((b * f - c * other.square) / across);
        let second = clamped(b.times_plus(first, f) * inverse_of(other.square));
        let first = clamped(b.times_minus(second, c) * inverse_of(self.square));
        (at(at(between, one, first), two, -second), [first, second])
    }

    /// Compare the distance from a solid around the origin of a frame with a limit [m], in the
    /// lanes that are asked (eq. 5).
    #[inline(always)]
    fn against_solid(&self, solid: &Solid, pose: &Pose, limit: Vector<S>, asked: u64) -> Decided {
        let middle = minus(self.middle, constant(limit.token(), &pose.translation.vector));
        let (middle, half) = (in_frame(middle, pose), in_frame(self.half, pose));
        let mut part = limit.like(0.0);
        let mut decided = Decided::default();
        for _ in 0..ROUNDS {
            let from = at(middle, half, part);
            let way = minus(from, solid.nearest(from));
            let product = dot(half, way);
            decided = decided.or(decide(dot(way, way), gap(product, part), limit));
            if asked & !decided.lanes() == 0 {
                break;
            }
            let bend = solid.bend(half, way).max(f64::MIN_POSITIVE);
            part = clamped(part - product / bend);
        }
        decided
    }
}

/// Compare with a limit [m] a distance of which the square is at most so much; along that way all
/// points of one are beyond all points of the other by the square less the gaps (eq. 3).
#[inline(always)]
fn decide<S: Simd>(square: Vector<S>, gaps: Vector<S>, limit: Vector<S>) -> Decided {
    let (apart, limit) = (square - gaps, limit * limit);
    let far = apart.simd_gt(0.0) & (apart * apart).simd_gt(limit * square);
    Decided { far: far.to_bitmask(), near: square.simd_le(limit).to_bitmask() }
}

/// A solid around the origin of its frame.
enum Solid {
    /// A box, by half of the lengths of its edges [m].
    Box([f64; 3]),
    /// A cylinder along z, by its radius and half of its length [m].
    Cylinder([f64; 2]),
}

impl Solid {
    /// A shape as a solid, and its frame.
    #[inline(always)]
    fn of(shape: &Shape) -> Option<(Self, &Pose)> {
        match shape {
            Shape::Box { pose, half } => Some((Self::Box((*half).into()), pose)),
            Shape::Cylinder { pose, radius, half } => {
                Some((Self::Cylinder([*radius, *half]), pose))
            }
            _ => None,
        }
    }

    /// The way from its nearest point to a point, in its frame.
    #[inline(always)]
    fn way_to<S: Simd>(&self, pose: &Pose, point: Point<S>) -> Point<S> {
        let origin = constant(point[0].token(), &pose.translation.vector);
        let local = in_frame(minus(point, origin), pose);
        minus(local, self.nearest(local))
    }

    #[inline(always)]
    fn nearest<S: Simd>(&self, point: Point<S>) -> Point<S> {
        match self {
            Self::Box([x, y, z]) => {
                [point[0].max(-x).min(*x), point[1].max(-y).min(*y), point[2].max(-z).min(*z)]
            }
            Self::Cylinder([radius, half]) => {
                let square = point[0].times_plus(point[0], point[1] * point[1]);
                let scale = (square.like(*radius) / square.max(f64::MIN_POSITIVE).root()).min(1.0);
                [point[0] * scale, point[1] * scale, point[2].max(-half).min(*half)]
            }
        }
    }

    /// How far the solid reaches along a direction, times its length.
    #[inline(always)]
    fn reach<S: Simd>(&self, way: Point<S>) -> Vector<S> {
        match self {
            Self::Box([x, y, z]) => way[0].size() * *x + way[1].size() * *y + way[2].size() * *z,
            Self::Cylinder([radius, half]) => {
                let across = way[0].times_plus(way[0], way[1] * way[1]).root();
                across * *radius + way[2].size() * *half
            }
        }
    }

    /// The second derivative of half the square of the distance along an axis, at least where it is
    /// constant.
    #[inline(always)]
    fn bend<S: Simd>(&self, along: Point<S>, way: Point<S>) -> Vector<S> {
        let along_z = if_outside(along[2], way[2]);
        match self {
            Self::Box(_) => if_outside(along[0], way[0]) + if_outside(along[1], way[1]) + along_z,
            Self::Cylinder(_) => along[0].times_plus(along[0], along[1] * along[1]) + along_z,
        }
    }
}

/// The square of a component where the way to the solid has it, else zero.
#[inline(always)]
fn if_outside<S: Simd>(along: Vector<S>, way: Vector<S>) -> Vector<S> {
    let zero = way.like(0.0);
    way.size().if_above(zero, along * along, zero)
}

#[inline(always)]
fn in_frame<S: Simd>(way: Point<S>, pose: &Pose) -> Point<S> {
    let r = pose.rotation.matrix();
    [
        way[0].scaled_plus(r[(0, 0)], way[1].scaled_plus(r[(1, 0)], way[2] * r[(2, 0)])),
        way[0].scaled_plus(r[(0, 1)], way[1].scaled_plus(r[(1, 1)], way[2] * r[(2, 1)])),
        way[0].scaled_plus(r[(0, 2)], way[1].scaled_plus(r[(1, 2)], way[2] * r[(2, 2)])),
    ]
}

/// A plane that a convex solid does not go beyond.
pub(super) struct Plane<S: Simd> {
    /// Across the plane, away from the solid.
    pub(super) way: Point<S>,
    /// How far the solid reaches along the way, without the radius [m^2].
    pub(super) reach: Vector<S>,
    pub(super) radius: f64,
}

impl<S: Simd> Plane<S> {
    /// The lanes in which what has a gap to it, times the length of the way, is farther than a limit
    /// [m].
    #[inline(always)]
    pub(super) fn is_below(&self, gap: Vector<S>, limit: Vector<S>) -> u64 {
        let limit = limit + self.radius;
        let is_far = (gap * gap).simd_gt(limit * limit * dot(self.way, self.way));
        (gap.simd_gt(0.0) & is_far).to_bitmask()
    }
}

/// The plane across the way from a convex solid to an axis.
#[inline(always)]
pub(super) fn plane_to<S: Simd>(shape: &Shape, axis: &Axis<S>) -> Option<Plane<S>> {
    let simd = axis.middle[0].token();
    match shape {
        Shape::HalfSpace { normal, offset } => {
            let (way, reach) = (constant(simd, normal), Vector::splat(simd, *offset));
            Some(Plane { way, reach, radius: 0.0 })
        }
        Shape::Capsule(own) => {
            let other = Axis::of(simd, &Centered::of(own));
            Some(Plane { radius: own.radius, ..other.plane_to(axis) })
        }
        _ => {
            let (solid, pose) = Solid::of(shape)?;
            let half = in_frame(axis.half, pose);
            let mut local = solid.way_to(pose, axis.middle);
            let mut part = half[0].like(0.0);
            for _ in 0..2 {
                let bend = solid.bend(half, local).max(f64::MIN_POSITIVE);
                part = clamped(part - dot(half, local) / bend);
                local = solid.way_to(pose, at(axis.middle, axis.half, part));
            }
            plane_across(shape, in_frame(local, &pose.inverse()))
        }
    }
}

/// The plane across a way that a box or cylinder does not go beyond.
#[inline(always)]
pub(super) fn plane_across<S: Simd>(shape: &Shape, way: Point<S>) -> Option<Plane<S>> {
    let (solid, pose) = Solid::of(shape)?;
    let origin = constant(way[0].token(), &pose.translation.vector);
    let reach = dot(way, origin) + solid.reach(in_frame(way, pose));
    Some(Plane { way, reach, radius: 0.0 })
}

/// Lanes in which a ball is apart from a shape, or from the ball around the shape; a limit is its
/// radius and more [m].
#[inline(always)]
pub(super) fn ball_beyond<S: Simd>(shape: &Shape, center: Point<S>, limit: Vector<S>) -> u64 {
    let simd = limit.token();
    if let Shape::HalfSpace { normal, offset } = shape {
        return dot(center, constant(simd, normal)).simd_gt(limit + *offset).to_bitmask();
    }
    let (way, limit) = if let Some((solid, pose)) = Solid::of(shape) {
        (solid.way_to(pose, center), limit)
    } else if let Some((around, radius)) = shape.ball() {
        (minus(center, constant(simd, &around)), limit + radius)
    } else {
        return 0;
    };
    dot(way, way).simd_gt(limit * limit).to_bitmask()
}

/// Lanes in which an axis is certainly farther from a box along the axes of the world than a limit
/// [m] (eq. 3). `inverse` is of the square of its half; zero of a point.
#[inline(always)]
pub(super) fn is_beyond_box<S: Simd>(
    bounds: &Bounds,
    [middle, half]: [Point<S>; 2],
    inverse: Vector<S>,
    limit: Vector<S>,
) -> u64 {
    let to_center = minus(constant(limit.token(), &bounds.center()), middle);
    let from = at(middle, half, clamped(dot(to_center, half) * inverse));
    let (mut nearest, mut way) = (from, from);
    for axis in 0..3 {
        nearest[axis] = from[axis].max(bounds.low[axis]).min(bounds.high[axis]);
        way[axis] = from[axis] - nearest[axis];
    }
    let gap = dot(way, minus(middle, nearest)) - dot(way, half).size();
    let is_far = (gap * gap).simd_gt(limit * limit * dot(way, way));
    (gap.simd_gt(0.0) & is_far).to_bitmask()
}

/// Compare the distance of an axis from a shape with a limit [m], in the lanes that are asked.
#[inline(always)]
pub(super) fn against_shape<S: Simd>(
    axis: &Axis<S>,
    shape: &Shape,
    limit: Vector<S>,
    asked: u64,
) -> Decided {
    let simd = limit.token();
    match shape {
        Shape::Capsule(own) => {
            axis.against_axis(&Axis::of(simd, &Centered::of(own)), limit + own.radius, asked)
        }
        Shape::HalfSpace { normal, offset } => {
            let normal = constant(simd, normal);
            let lowest = dot(axis.middle, normal) - dot(axis.half, normal).size();
            let far = lowest.simd_gt(limit + *offset).to_bitmask();
            Decided { far, near: !far }
        }
        _ => match Solid::of(shape) {
            Some((solid, pose)) => axis.against_solid(&solid, pose, limit, asked),
            None => Decided::default(),
        },
    }
}
