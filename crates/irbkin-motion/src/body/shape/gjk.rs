//! How far two convex shapes are apart, each known by its points that are farthest along directions.
//!
//! Reference: Gilbert, Johnson, Keerthi, A fast procedure for computing the distance between complex
//! objects in three-dimensional space, 1988. The distance is the largest gap between parallel planes
//! that has been found to separate the two: whatever the procedure converges to, they are not
//! nearer.

use nalgebra::Vector3;
#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::segment::part_near;
use super::triangle::nearest_to_origin;
use irbkin::Pose;

/// Rounds of the search, at most.
const ROUNDS: u32 = 64;

/// How far a distance may be below the true one, relative to it [1].
const RELATIVE: f64 = 1e-12;

/// Volume of a tetrahedron below which it counts as flat, relative to a box of its edges [1].
const FLAT: f64 = 1e-10;

pub(crate) trait Convex {
    /// A point of it that is farthest along a direction; one that may be near it is known.
    fn support(&self, direction: &Vector3<f64>, known: Option<&Vector3<f64>>) -> Vector3<f64>;
}

impl<T: Convex + ?Sized> Convex for &T {
    #[inline(always)]
    fn support(&self, direction: &Vector3<f64>, known: Option<&Vector3<f64>>) -> Vector3<f64> {
        (**self).support(direction, known)
    }
}

impl<const K: usize> Convex for [Vector3<f64>; K] {
    fn support(&self, direction: &Vector3<f64>, _: Option<&Vector3<f64>>) -> Vector3<f64> {
        let along = |point: &Vector3<f64>| direction.dot(point);
        let far = |one: Vector3<f64>, two: Vector3<f64>| {
            if along(&two) > along(&one) { two } else { one }
        };
        self.iter().copied().reduce(far).unwrap_or_default()
    }
}

pub(crate) struct Framed<T> {
    pub(crate) shape: T,
    pub(crate) pose: Pose,
}

impl<T: Convex> Convex for Framed<T> {
    #[inline(always)]
    fn support(&self, direction: &Vector3<f64>, _: Option<&Vector3<f64>>) -> Vector3<f64> {
        let own = self.shape.support(&turned_back(&self.pose, direction), None);
        placed(&self.pose, &own)
    }
}

/// A direction in the frame of a pose. Written out, it is compiled in place.
#[inline(always)]
fn turned_back(pose: &Pose, way: &Vector3<f64>) -> Vector3<f64> {
    let r = pose.rotation.matrix();
    Vector3::new(
        r.m11 * way.x + r.m21 * way.y + r.m31 * way.z,
        r.m12 * way.x + r.m22 * way.y + r.m32 * way.z,
        r.m13 * way.x + r.m23 * way.y + r.m33 * way.z,
    )
}

/// A point of the frame of a pose.
#[inline(always)]
pub(super) fn placed(pose: &Pose, point: &Vector3<f64>) -> Vector3<f64> {
    let (r, origin) = (pose.rotation.matrix(), &pose.translation.vector);
    Vector3::new(
        r.m11 * point.x + r.m12 * point.y + r.m13 * point.z + origin.x,
        r.m21 * point.x + r.m22 * point.y + r.m23 * point.z + origin.y,
        r.m31 * point.x + r.m32 * point.y + r.m33 * point.z + origin.z,
    )
}

/// The part of a distance that is asked [m]: beyond `far` and from `near` on downwards, only that it
/// is there.
#[derive(Clone, Copy)]
pub(crate) struct DistanceQuery {
    pub(crate) far: f64,
    pub(crate) near: f64,
}

impl DistanceQuery {
    /// The distance.
    pub(crate) const DISTANCE: Self = Self { far: f64::INFINITY, near: f64::NEG_INFINITY };

    /// Whether it is more than so much.
    pub(crate) fn whether_above(limit: f64) -> Self {
        Self { far: limit, near: limit }
    }

    /// Of shapes that are so much thinner.
    pub(super) fn without(self, radii: f64) -> Self {
        Self { far: self.far + radii, near: self.near + radii }
    }
}

/// A direction across which planes separated two shapes before: a search that begins with it is
/// short where they do again.
pub(crate) type SeparatingDirection = Option<Vector3<f64>>;

/// At most four differences of points of the two shapes, of which the one nearest to the origin is
/// a weighted mean.
#[derive(Clone, Copy, Default)]
struct Simplex {
    count: usize,
    /// The points of the shapes, and their differences.
    points: [[Vector3<f64>; 2]; 4],
    values: [Vector3<f64>; 4],
    weights: [f64; 4],
}

/// How far two shapes are apart, or what of it is asked; the nearest points. The distance is theirs
/// or less. The search begins along a way from the other to the one, and leaves the way across which
/// planes separate the two the farthest.
#[inline(always)]
pub(super) fn nearest(
    one: &(impl Convex + ?Sized),
    other: &(impl Convex + ?Sized),
    way: &mut Vector3<f64>,
    asked: DistanceQuery,
) -> (f64, [Vector3<f64>; 2]) {
    let mut simplex = Simplex::default();
    let first = [one.support(&-*way, None), other.support(way, None)];
    simplex.push(first);
    simplex.weights[0] = 1.0;
    let (mut bound, mut last) = (0.0_f64.max(way.dot(&simplex.values[0]) / way.norm()), first);
    let rounds = if bound > asked.far { 0 } else { ROUNDS };
    for _ in 0..rounds {
        let nearest = simplex.mean(|at| simplex.values[at]);
        let length = nearest.norm();
        if length == 0.0 || length <= asked.near {
            break;
        }
        last = [one.support(&-nearest, Some(&last[0])), other.support(&nearest, Some(&last[1]))];
        let value = last[0] - last[1];
        let own = nearest.dot(&value) / length;
        if own > bound {
            (bound, *way) = (own, nearest);
        }
        let is_known = simplex.values[..simplex.count].contains(&value);
        if is_known || bound > asked.far || length - bound <= RELATIVE * length {
            break;
        }
        simplex.push(last);
        if bound == 0.0 && simplex.holds_origin() {
            break;
        }
        simplex.reduce();
    }
    let [from, to] = [0, 1].map(|of| simplex.mean(|at| simplex.points[at][of]));
    let to = if bound > 0.0 { to } else { from };
    (bound, [from, to])
}

impl Simplex {
    fn push(&mut self, points: [Vector3<f64>; 2]) {
        let at = self.count;
        (self.points[at], self.values[at], self.weights[at]) = (points, points[0] - points[1], 0.0);
        self.count += 1;
    }

    #[inline(always)]
    fn mean(&self, of: impl Fn(usize) -> Vector3<f64>) -> Vector3<f64> {
        let mut sum = Vector3::new(0.0, 0.0, 0.0);
        for at in 0..self.count {
            let (one, weight) = (of(at), self.weights[at]);
            sum.x += one.x * weight;
            sum.y += one.y * weight;
            sum.z += one.z * weight;
        }
        sum
    }

    /// Whether the origin is in a tetrahedron that is not flat.
    fn holds_origin(&self) -> bool {
        if self.count < 4 {
            return false;
        }
        let [a, b, c, d] = &self.values;
        let product = |x: &Vector3<f64>, y: &Vector3<f64>, z: &Vector3<f64>| x.dot(&y.cross(z));
        let (ab, ac, ad) = (b - a, c - a, d - a);
        let volume = product(&ab, &ac, &ad);
        let weights = [product(b, c, d), -product(a, c, d), product(a, b, d)];
        let last = -product(a, b, c);
        let box_of_edges = ab.norm_squared() * ac.norm_squared() * ad.norm_squared();
        volume * volume > FLAT * FLAT * box_of_edges
            && weights.iter().chain([&last]).all(|weight| weight * volume >= 0.0)
    }

    /// Keep the corners that the point nearest to the origin is between, with their weights.
    fn reduce(&mut self) {
        let [a, b, c, d] = self.values;
        match self.count {
            1 => self.weights[0] = 1.0,
            2 => {
                let part = part_near(&[a, b], &Vector3::zeros());
                self.weights = [1.0 - part, part, 0.0, 0.0];
            }
            3 => self.weights[..3].copy_from_slice(&nearest_to_origin(&[a, b, c])),
            // The face without the newest corner was the last simplex.
            _ => {
                let mut best = (f64::INFINITY, [0.0; 4]);
                for [one, two] in [[0, 1], [0, 2], [1, 2]] {
                    let face = [self.values[one], self.values[two], d];
                    let own = nearest_to_origin(&face);
                    let square = (face[0] * own[0] + face[1] * own[1] + d * own[2]).norm_squared();
                    if square < best.0 {
                        let mut weights = [0.0, 0.0, 0.0, own[2]];
                        (weights[one], weights[two]) = (own[0], own[1]);
                        best = (square, weights);
                    }
                }
                self.weights = best.1;
            }
        }
        let mut kept = 0;
        for at in 0..self.count {
            if self.weights[at] > 0.0 {
                self.points[kept] = self.points[at];
                self.values[kept] = self.values[at];
                self.weights[kept] = self.weights[at];
                kept += 1;
            }
        }
        self.count = kept;
    }
}
