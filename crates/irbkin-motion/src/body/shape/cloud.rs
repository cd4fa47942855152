//! Clouds of points: balls of one radius.

use alloc::sync::Arc;

use nalgebra::Vector3;

use super::capsule::{Capsule, Separation};
use super::checks::{check_points, check_size};
use super::segment::{Nearest, Segment, at, nearer, part_near};
use super::tree::{Bounds, Tree, above};
use crate::error::Error;
use crate::prelude::*;
use irbkin::Interrupt;

/// Points, and all that is within a radius of them.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "Stored", into = "Stored")
)]
pub struct Cloud(Arc<CloudData>);

/// A cloud as serde reads and writes it.
type Stored = (Vec<[f64; 3]>, f64);

#[derive(Debug, PartialEq)]
struct CloudData {
    points: Vec<Vector3<f64>>,
    radius: f64,
    tree: Tree,
}

impl From<Cloud> for Stored {
    fn from(cloud: Cloud) -> Self {
        (cloud.points().collect(), cloud.radius())
    }
}

impl TryFrom<Stored> for Cloud {
    type Error = Error;

    fn try_from((points, radius): Stored) -> Result<Self, Error> {
        Self::new(&points, radius, Interrupt::none())
    }
}

impl Cloud {
    /// At least one point [m], and the radius of the balls around them [m].
    pub(super) fn new(
        points: &[[f64; 3]],
        radius: f64,
        interrupt: Interrupt<'_>,
    ) -> Result<Self, Error> {
        check_size("point cloud", "radius", radius)?;
        let points = check_points("point cloud", "points", points, 1)?;
        let boxes: Vec<_> = points.iter().map(|point| Bounds::of([point])).collect();
        Ok(Self(Arc::new(CloudData { points, radius, tree: Tree::new(&boxes, interrupt)? })))
    }

    /// The points [m].
    #[must_use]
    pub fn points(&self) -> impl ExactSizeIterator<Item = [f64; 3]> {
        self.0.points.iter().map(|point| (*point).into())
    }

    /// The radius of the balls around the points [m].
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.0.radius
    }

    pub(super) fn point(&self, index: usize) -> Vector3<f64> {
        self.0.points[index]
    }

    pub(super) fn tree(&self) -> &Tree {
        &self.0.tree
    }

    pub(super) fn separation(&self, capsule: &Capsule) -> Separation {
        let (_, points) = self.nearest(&capsule.ends, f64::INFINITY, |_| false);
        Separation::of_balls(points, [capsule.radius, self.radius()])
    }

    /// Whether a capsule is as near to a ball as a distance [m], or nearer.
    pub(super) fn is_within(&self, capsule: &Capsule, distance: f64) -> bool {
        let is_near = |square: f64| square.sqrt() - capsule.radius - self.radius() <= distance;
        let most = above(distance + capsule.radius + self.radius());
        is_near(self.nearest(&capsule.ends, most, is_near).0)
    }

    /// As [`Tree::nearest`] of an axis.
    fn nearest(&self, axis: &Segment, most: f64, is_enough: impl Fn(f64) -> bool) -> Nearest {
        self.0.tree.nearest(axis, most, is_enough, |nearest, index| {
            let point = self.0.points[index];
            nearer(nearest, at(axis, part_near(axis, &point)), point)
        })
    }
}
