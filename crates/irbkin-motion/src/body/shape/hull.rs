//! The convex hull of points: how far other shapes are from it, without its faces.

use alloc::sync::Arc;

use nalgebra::Vector3;

use super::capsule::{Capsule, Separation};
use super::checks::{LEAST, check_points};
use super::gjk::{Convex, DistanceQuery, nearest};
use super::tree::{Bounds, Tree};
use crate::body::fault::BodyFault;
use crate::error::Error;
use crate::prelude::*;
use irbkin::Interrupt;

/// The convex hull of points.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "Vec<[f64; 3]>", into = "Vec<[f64; 3]>")
)]
pub struct Hull(Arc<HullData>);

#[derive(Debug, PartialEq)]
struct HullData {
    points: Vec<Vector3<f64>>,
    tree: Tree,
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

impl Hull {
    /// The convex hull of at least four points [m].
    pub(super) fn new(points: &[[f64; 3]], interrupt: Interrupt<'_>) -> Result<Self, Error> {
        let points = check_points("convex hull", "points", points, 4)?;
        let thickness = thickness(&points);
        if thickness < LEAST {
            return Err(BodyFault::Flat { thickness, least: LEAST }.into());
        }
        let boxes: Vec<_> = points.iter().map(|point| Bounds::of([point])).collect();
        Ok(Self(Arc::new(HullData { points, tree: Tree::new(&boxes, interrupt)? })))
    }

    /// The points [m].
    #[must_use]
    pub fn points(&self) -> impl ExactSizeIterator<Item = [f64; 3]> {
        self.0.points.iter().map(|point| (*point).into())
    }

    pub(super) fn bounds(&self) -> &Bounds {
        self.0.tree.bounds()
    }

    pub(super) fn separation(&self, capsule: &Capsule) -> Separation {
        let (distance, points) = self.nearest(capsule, DistanceQuery::DISTANCE);
        Separation::of_rounded(distance, points, [capsule.radius, 0.0])
    }

    /// Whether a capsule is as near to it as a distance [m], or nearer.
    pub(super) fn is_within(&self, capsule: &Capsule, distance: f64) -> bool {
        let most = distance + capsule.radius;
        self.nearest(capsule, DistanceQuery::whether_above(most)).0 <= most
    }

    /// How far the axis of a capsule is from it.
    fn nearest(&self, capsule: &Capsule, asked: DistanceQuery) -> (f64, [Vector3<f64>; 2]) {
        let axis = &capsule.ends;
        let (one, other): (&dyn Convex, &dyn Convex) = (axis, self);
        nearest(one, other, &mut (axis[0] - self.0.points[0]), asked)
    }
}

impl Convex for Hull {
    fn support(&self, direction: &Vector3<f64>, known: Option<&Vector3<f64>>) -> Vector3<f64> {
        // The search is for what is least.
        let along = |point: &Vector3<f64>| -direction.dot(point);
        let mut found = *known.unwrap_or(&self.0.points[0]);
        let corner = |bounds: &Bounds| {
            let largest = direction.component_mul(&bounds.low);
            -largest.sup(&direction.component_mul(&bounds.high)).sum()
        };
        self.0.tree.search(along(&found), corner, |index| {
            let point = &self.0.points[index];
            if along(point) < along(&found) {
                found = *point;
            }
            along(&found)
        });
        found
    }
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
