//! The convex hull of points: how far a capsule is from it, without its faces.
//!
//! Reference: Gilbert, Johnson, Keerthi, A fast procedure for computing the distance between complex
//! objects in three-dimensional space, 1988. The distance is the largest gap between parallel planes
//! that has been found to separate axis and points: whatever the procedure converges to, no point is
//! nearer.

use alloc::sync::Arc;
use alloc::vec::Vec;

use arrayvec::ArrayVec;
use nalgebra::Vector3;
#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::capsule::{Capsule, Separation};
use super::checks::{LEAST, check_points};
use super::segment::{Segment, part_near};
use super::tree::{Bounds, Tree};
use super::triangle::nearest_to_origin;
use crate::body::fault::BodyFault;
use crate::error::Error;
use crate::interrupt::Interrupt;

/// Rounds of the search, at most.
const ROUNDS: u32 = 64;

/// How far a distance may be below the true one, relative to it [1].
const RELATIVE: f64 = 1e-12;

/// Volume of a tetrahedron below which it counts as flat, relative to a box of its edges [1].
const FLAT: f64 = 1e-10;

/// The convex hull of points.
#[derive(Clone, Debug)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "Vec<[f64; 3]>", into = "Vec<[f64; 3]>")
)]
pub struct Hull(Arc<Inside>);

#[derive(Debug)]
struct Inside {
    points: Vec<Vector3<f64>>,
    tree: Tree,
}

impl PartialEq for Hull {
    fn eq(&self, other: &Self) -> bool {
        self.0.points == other.0.points
    }
}

impl From<Hull> for Vec<[f64; 3]> {
    fn from(hull: Hull) -> Self {
        hull.points().collect()
    }
}

impl TryFrom<Vec<[f64; 3]>> for Hull {
    type Error = Error;

    fn try_from(points: Vec<[f64; 3]>) -> Result<Self, Error> {
        Self::new(&points, Interrupt::none())
    }
}

/// A difference of points of the axis and of the hull.
#[derive(Clone, Copy)]
struct Difference {
    value: Vector3<f64>,
    points: [Vector3<f64>; 2],
}

/// At most four differences, of which the nearest to the origin is a weighted mean.
type Simplex = ArrayVec<(f64, Difference), 4>;

impl Hull {
    /// The convex hull of at least four points [m].
    pub(super) fn new(points: &[[f64; 3]], interrupt: Interrupt<'_>) -> Result<Self, Error> {
        let points = check_points("convex hull", "points", points, 4)?;
        let thickness = thickness(&points);
        if thickness < LEAST {
            return Err(BodyFault::Flat { thickness, least: LEAST }.into());
        }
        let boxes: Vec<_> = points.iter().map(|point| Bounds::of([point])).collect();
        Ok(Self(Arc::new(Inside { points, tree: Tree::new(&boxes, interrupt)? })))
    }

    /// The points [m].
    #[must_use]
    pub fn points(&self) -> impl ExactSizeIterator<Item = [f64; 3]> {
        self.0.points.iter().map(|point| (*point).into())
    }

    /// The box around it.
    pub(super) fn bounds(&self) -> &Bounds {
        self.0.tree.bounds()
    }

    /// How far a capsule is from it.
    pub(super) fn separation(&self, capsule: &Capsule) -> Separation {
        let (distance, points) = self.nearest(&capsule.ends, f64::INFINITY);
        Separation::of_axis(distance, points, capsule.radius)
    }

    /// Whether a capsule is as near to it as a distance [m], or nearer.
    pub(super) fn is_within(&self, capsule: &Capsule, distance: f64) -> bool {
        let most = distance + capsule.radius;
        self.nearest(&capsule.ends, most).0 - capsule.radius <= distance
    }

    /// How far an axis is from it, or a lesser distance that is more than `most`; the nearest points.
    fn nearest(&self, axis: &Segment, most: f64) -> (f64, [Vector3<f64>; 2]) {
        let mut simplex = Simplex::new();
        let first = self.support(axis, &(axis[0] - self.0.points[0]), &simplex);
        simplex.push((1.0, first));
        let mut bound = 0.0_f64;
        for _ in 0..ROUNDS {
            let nearest = mean(&simplex, |one| one.value);
            let length = nearest.norm();
            if length == 0.0 {
                break;
            }
            let next = self.support(axis, &nearest, &simplex);
            bound = bound.max(nearest.dot(&next.value) / length);
            let is_known = simplex.iter().any(|(_, one)| one.value == next.value);
            if is_known || bound > most || length - bound <= RELATIVE * length {
                break;
            }
            simplex.push((0.0, next));
            if bound == 0.0 && holds_origin(&simplex) {
                break;
            }
            simplex = reduced(&simplex);
        }
        let [from, to] = [0, 1].map(|of| mean(&simplex, |one| one.points[of]));
        let to = if bound > 0.0 { to } else { from };
        (bound, [from, to])
    }

    /// The difference that is least along a direction, sought from a simplex on.
    fn support(&self, axis: &Segment, direction: &Vector3<f64>, known: &Simplex) -> Difference {
        let along = |point: &Vector3<f64>| -direction.dot(point);
        let is_last = along(&axis[1]) > along(&axis[0]);
        let from = axis[usize::from(is_last)];
        let points = known.iter().map(|(_, one)| one.points[1]);
        let first = points.min_by(|a, b| along(a).total_cmp(&along(b)));
        let mut to = first.unwrap_or(self.0.points[0]);
        let corner = |bounds: &Bounds| {
            let largest = direction.component_mul(&bounds.low);
            -largest.sup(&direction.component_mul(&bounds.high)).sum()
        };
        self.0.tree.search(along(&to), corner, |index| {
            let point = &self.0.points[index];
            if along(point) < along(&to) {
                to = *point;
            }
            along(&to)
        });
        Difference { value: from - to, points: [from, to] }
    }
}

/// The weighted mean of a simplex.
fn mean(simplex: &Simplex, of: impl Fn(&Difference) -> Vector3<f64>) -> Vector3<f64> {
    simplex.iter().map(|(weight, one)| of(one) * *weight).sum()
}

/// Whether the origin is in a tetrahedron that is not flat.
fn holds_origin(simplex: &Simplex) -> bool {
    let [a, b, c, d] = match &simplex[..] {
        [(_, a), (_, b), (_, c), (_, d)] => [a.value, b.value, c.value, d.value],
        _ => return false,
    };
    let product = |x: &Vector3<f64>, y: &Vector3<f64>, z: &Vector3<f64>| x.dot(&y.cross(z));
    let (ab, ac, ad) = (b - a, c - a, d - a);
    let volume = product(&ab, &ac, &ad);
    let weights = [product(&b, &c, &d), -product(&a, &c, &d), product(&a, &b, &d)];
    let last = -product(&a, &b, &c);
    volume.abs() > FLAT * ab.norm() * ac.norm() * ad.norm()
        && weights.iter().chain([&last]).all(|weight| weight * volume >= 0.0)
}

/// The corners of a simplex that the point nearest to the origin is between, with their weights.
fn reduced(simplex: &Simplex) -> Simplex {
    let all: ArrayVec<Difference, 4> = simplex.iter().map(|(_, one)| *one).collect();
    let faces: &[&[usize]] = match all.len() {
        1 => &[&[0]],
        2 => &[&[0, 1]],
        3 => &[&[0, 1, 2]],
        // The face without the newest corner was the last simplex.
        _ => &[&[0, 1, 3], &[0, 2, 3], &[1, 2, 3]],
    };
    let mut best = (f64::INFINITY, Simplex::new());
    for face in faces {
        let corners: ArrayVec<Difference, 3> = face.iter().map(|at| all[*at]).collect();
        let weights = match &corners[..] {
            [a, b] => {
                let part = part_near(&[a.value, b.value], &Vector3::zeros());
                [1.0 - part, part, 0.0]
            }
            [a, b, c] => nearest_to_origin(&[a.value, b.value, c.value]),
            _ => [1.0, 0.0, 0.0],
        };
        let kept = weights.into_iter().zip(corners).filter(|(weight, _)| *weight > 0.0);
        let face: Simplex = kept.collect();
        let square = mean(&face, |one| one.value).norm_squared();
        if square < best.0 {
            best = (square, face);
        }
    }
    best.1
}

/// How far points are from a plane, at least: of the plane through three that are far apart.
fn thickness(points: &[Vector3<f64>]) -> f64 {
    let largest = |size: &dyn Fn(&Vector3<f64>) -> f64| {
        points.iter().copied().max_by(|a, b| size(a).total_cmp(&size(b))).unwrap_or_default()
    };
    let first = points[0];
    let second = largest(&|point| (point - first).norm());
    let along = second - first;
    let third = largest(&|point| along.cross(&(point - first)).norm());
    let normal = along.cross(&(third - first));
    let length = normal.norm();
    if length < LEAST * along.norm() || length == 0.0 {
        return 0.0;
    }
    let fourth = largest(&|point| normal.dot(&(point - first)).abs());
    normal.dot(&(fourth - first)).abs() / length
}
