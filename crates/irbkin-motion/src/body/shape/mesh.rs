//! Triangle meshes: solids by their surface, or surfaces alone.

use alloc::sync::Arc;

use nalgebra::Vector3;

use super::capsule::{Capsule, Separation};
use super::checks::check_points;
use super::segment::{Nearest, Segment, nearer};
use super::surface::{check_volume, crossings};
use super::tree::{Bounds, Tree, above};
use super::triangle::{Triangle, segment_and, square_outside};
use super::weld::closed;
use crate::error::Error;
use crate::prelude::*;
use irbkin::Interrupt;

/// Directions in which a point looks for its way out of a mesh, one after another while an edge is
/// in the way.
const DIRECTIONS: [[f64; 3]; 5] = [
    [0.531, 0.283, 0.798],
    [-0.617, 0.712, 0.335],
    [0.149, -0.883, 0.446],
    [0.775, 0.428, -0.466],
    [-0.357, -0.391, -0.848],
];

/// Triangles, and what is inside them if the mesh is solid.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "Stored", into = "Stored")
)]
pub struct Mesh(Arc<MeshData>);

/// A mesh as serde reads and writes it.
type Stored = (Vec<[[f64; 3]; 3]>, bool);

#[derive(Debug, PartialEq)]
struct MeshData {
    triangles: Vec<Triangle>,
    is_solid: bool,
    tree: Tree,
}

impl From<Mesh> for Stored {
    fn from(mesh: Mesh) -> Self {
        (mesh.triangles().collect(), mesh.is_solid())
    }
}

impl TryFrom<Stored> for Mesh {
    type Error = Error;

    fn try_from((triangles, is_solid): Stored) -> Result<Self, Error> {
        Self::new(&triangles, is_solid, Interrupt::none())
    }
}

impl Mesh {
    /// A mesh by the corners of its triangles [m]. A solid one is closed: every edge of a triangle
    /// is an edge of another one in the opposite sense. Where it is not, corners within
    /// [`SAME_CORNER`](super::weld::SAME_CORNER) are made one. Several solids may overlap if the corners of all are counterclockwise, seen from
    /// outside, or of all clockwise.
    pub(super) fn new(
        triangles: &[[[f64; 3]; 3]],
        is_solid: bool,
        interrupt: Interrupt<'_>,
    ) -> Result<Self, Error> {
        let corners = check_points("mesh", "triangles", triangles.as_flattened(), 3)?;
        let (rows, _) = corners.as_chunks::<3>();
        let mut triangles = rows.to_vec();
        if is_solid {
            triangles = closed(triangles, interrupt)?;
            check_volume(&triangles)?;
        }
        let boxes: Vec<_> = triangles.iter().map(Bounds::of).collect();
        Ok(Self(Arc::new(MeshData { triangles, is_solid, tree: Tree::new(&boxes, interrupt)? })))
    }

    /// The corners of the triangles [m].
    #[must_use]
    pub fn triangles(&self) -> impl ExactSizeIterator<Item = [[f64; 3]; 3]> {
        self.0.triangles.iter().map(|corners| corners.map(Into::into))
    }

    /// Whether what is inside belongs to it.
    #[must_use]
    pub fn is_solid(&self) -> bool {
        self.0.is_solid
    }

    pub(super) fn triangle(&self, index: usize) -> &Triangle {
        &self.0.triangles[index]
    }

    pub(super) fn tree(&self) -> &Tree {
        &self.0.tree
    }

    pub(super) fn separation(&self, capsule: &Capsule) -> Separation {
        let axis = &capsule.ends;
        // If the axis is not inside as a whole, it goes through a triangle or is outside.
        if self.0.is_solid && self.holds(&axis[0]) {
            return Separation::of_rounded(0.0, [axis[0]; 2], [capsule.radius, 0.0]);
        }
        let (square, points) = self.nearest(axis, f64::INFINITY, |_| false);
        Separation::of_rounded(square.sqrt(), points, [capsule.radius, 0.0])
    }

    /// Whether a capsule is as near to it as a distance [m], or nearer.
    pub(super) fn is_within(&self, capsule: &Capsule, distance: f64) -> bool {
        let is_near = |square: f64| square.sqrt() - capsule.radius <= distance;
        let most = above(distance + capsule.radius);
        is_near(self.nearest(&capsule.ends, most, is_near).0)
            || (self.0.is_solid && self.holds(&capsule.ends[0]))
    }

    /// As [`Tree::nearest`] of an axis and the surface.
    fn nearest(&self, axis: &Segment, most: f64, is_enough: impl Fn(f64) -> bool) -> Nearest {
        self.0.tree.nearest(axis, most, is_enough, |nearest, index| {
            let triangle = &self.0.triangles[index];
            if square_outside(triangle, axis) >= nearest.0 {
                return nearest;
            }
            let (_, [from, to]) = segment_and(triangle, axis);
            nearer(nearest, from, to)
        })
    }

    /// Whether a point is inside, or so near to the surface that rounding decides.
    pub(super) fn holds(&self, point: &Vector3<f64>) -> bool {
        self.0.tree.bounds().contains(point) && {
            let ways = DIRECTIONS.map(Vector3::from);
            let winding = ways.iter().find_map(|way| self.winding(point, way));
            winding.is_none_or(|winding| winding != 0)
        }
    }

    /// How many times more a ray goes out of the mesh than into it; `None` where it is too near to
    /// an edge, or the point to a triangle.
    fn winding(&self, point: &Vector3<f64>, way: &Vector3<f64>) -> Option<i32> {
        let mut winding = Some(0);
        self.0.tree.search(
            1.0,
            |bounds| if is_ahead(bounds, point, way) { 0.0 } else { 1.0 },
            |index| {
                let crossing = crossings(&self.0.triangles[index], point, way);
                winding = winding.zip(crossing).map(|(sum, one)| sum + one);
                if winding.is_some() { 1.0 } else { f64::NEG_INFINITY }
            },
        );
        winding
    }
}

/// Whether a ray may hit a box.
fn is_ahead(bounds: &Bounds, point: &Vector3<f64>, way: &Vector3<f64>) -> bool {
    // More than the rounding of the quotients.
    let room = 1e-9 * (bounds.radius() + (bounds.center() - point).norm());
    let (mut enter, mut leave) = (0.0_f64, f64::INFINITY);
    for axis in 0..3 {
        let low = (bounds.low[axis] - room - point[axis]) / way[axis];
        let high = (bounds.high[axis] + room - point[axis]) / way[axis];
        enter = enter.max(low.min(high));
        leave = leave.min(low.max(high));
    }
    enter <= leave
}
