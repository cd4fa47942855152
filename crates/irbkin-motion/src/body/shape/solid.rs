//! Shapes of obstacles.

use nalgebra::Vector3;

use super::capsule::{Capsule, Separation};
use super::checks::{check_length, check_point, check_size, placed};
use super::cloud::Cloud;
use super::convex::{nearest_of_box, nearest_of_cylinder, of_convex};
use super::hull::Hull;
use super::mesh::Mesh;
use super::tree::Bounds;
use crate::body::fault::BodyFault;
use crate::error::Error;
use crate::prelude::*;
use irbkin::internal::checked_pose;
use irbkin::{Interrupt, Pose};

/// A solid shape, or a surface.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Shape {
    /// A capsule or a sphere.
    Capsule(Capsule),
    /// A box around the origin of a frame.
    Box {
        /// The frame.
        pose: Pose,
        /// Half of the lengths of its edges [m].
        half: Vector3<f64>,
    },
    /// A cylinder around the origin of a frame, along its z axis.
    Cylinder {
        /// The frame.
        pose: Pose,
        /// The radius [m].
        radius: f64,
        /// Half of its length [m].
        half: f64,
    },
    /// Everything on one side of a plane.
    HalfSpace {
        /// The unit normal of the plane, which points out of the solid.
        normal: Vector3<f64>,
        /// How far the plane is from the origin along the normal [m].
        offset: f64,
    },
    /// The convex hull of points in a frame.
    Convex {
        /// The frame.
        pose: Pose,
        /// The points.
        hull: Hull,
    },
    /// A triangle mesh in a frame.
    Mesh {
        /// The frame.
        pose: Pose,
        /// The triangles.
        mesh: Mesh,
    },
    /// Balls around points in a frame.
    Points {
        /// The frame.
        pose: Pose,
        /// The points and their radius.
        cloud: Cloud,
    },
    /// At least one shape, none of which is a union.
    Union(Vec<Shape>),
}

impl Shape {
    /// A sphere by its radius and center [m].
    ///
    /// # Errors
    ///
    /// As [`Capsule::new`].
    pub fn sphere(radius: f64, center: [f64; 3]) -> Result<Self, Error> {
        check_point("sphere", "center", &center.into())?;
        check_size("sphere", "radius", radius)?;
        Capsule::new(center, center, radius).map(Self::Capsule)
    }

    /// A capsule by the ends of its axis and its radius [m].
    ///
    /// # Errors
    ///
    /// As [`Capsule::new`].
    pub fn capsule(a: [f64; 3], b: [f64; 3], radius: f64) -> Result<Self, Error> {
        Capsule::new(a, b, radius).map(Self::Capsule)
    }

    /// A box by the lengths of its edges [m], around the origin of `pose`.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidBody`] for an edge that is shorter than 1e-6 m or longer than 100 m, or a
    /// pose that is more than 100 m away, and [`irbkin::Error::InvalidPose`].
    pub fn cuboid(size: [f64; 3], pose: &Pose) -> Result<Self, Error> {
        for length in size {
            check_size("box", "size", length)?;
        }
        Ok(Self::Box { pose: placed("box", pose)?, half: 0.5 * Vector3::from(size) })
    }

    /// A cylinder by its radius and length [m], around the origin of `pose` along its z axis.
    ///
    /// # Errors
    ///
    /// As [`Self::cuboid`].
    pub fn cylinder(radius: f64, length: f64, pose: &Pose) -> Result<Self, Error> {
        check_size("cylinder", "radius", radius)?;
        check_size("cylinder", "length", length)?;
        Ok(Self::Cylinder { pose: placed("cylinder", pose)?, radius, half: 0.5 * length })
    }

    /// Everything behind the plane through `point` [m] whose normal is `normal`: a floor has the
    /// normal (0, 0, 1).
    ///
    /// # Errors
    ///
    /// [`Error::InvalidBody`] for a point more than 100 m away, and a normal that is not finite or of
    /// length zero.
    pub fn half_space(normal: [f64; 3], point: [f64; 3]) -> Result<Self, Error> {
        let (normal, point) = (Vector3::from(normal), Vector3::from(point));
        check_point("half space", "point", &point)?;
        let length = normal.norm();
        check_length("length of the normal", length, 0.0)?;
        if length < f64::MIN_POSITIVE {
            return Err(BodyFault::Normal.into());
        }
        let normal = normal / length;
        Ok(Self::HalfSpace { normal, offset: normal.dot(&point) })
    }

    /// The convex hull of at least four points [m] in the frame of `pose`.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidBody`] for points that are not finite, in a plane, or more than 100 m apart,
    /// and [`irbkin::Error::InvalidPose`].
    pub fn convex(points: &[[f64; 3]], pose: &Pose) -> Result<Self, Error> {
        Self::convex_until(points, pose, Interrupt::none())
    }

    /// [`Self::convex`], until it is interrupted.
    #[doc(hidden)]
    pub fn convex_until(
        points: &[[f64; 3]],
        pose: &Pose,
        interrupt: Interrupt<'_>,
    ) -> Result<Self, Error> {
        let pose = placed("convex hull", pose)?;
        Ok(Self::Convex { pose, hull: Hull::new(points, interrupt)? })
    }

    /// A mesh by the corners of its triangles [m] in the frame of `pose`. What is inside a solid one
    /// belongs to it; of another one only the surface does. If a solid one is not closed, corners
    /// that are within a micrometer, or a millionth of its size, are made one.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidBody`] for corners that are not finite or more than 100 m apart, and for a
    /// solid mesh that is still not closed, or without volume; [`irbkin::Error::InvalidPose`].
    pub fn mesh(triangles: &[[[f64; 3]; 3]], is_solid: bool, pose: &Pose) -> Result<Self, Error> {
        Self::mesh_until(triangles, is_solid, pose, Interrupt::none())
    }

    /// [`Self::mesh`], until it is interrupted.
    #[doc(hidden)]
    pub fn mesh_until(
        triangles: &[[[f64; 3]; 3]],
        is_solid: bool,
        pose: &Pose,
        interrupt: Interrupt<'_>,
    ) -> Result<Self, Error> {
        let pose = placed("mesh", pose)?;
        Ok(Self::Mesh { pose, mesh: Mesh::new(triangles, is_solid, interrupt)? })
    }

    /// Balls of one radius [m] around points [m] in the frame of `pose`.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidBody`] for points that are not finite or more than 100 m apart, and a radius
    /// below 1e-6 m; [`irbkin::Error::InvalidPose`].
    pub fn points(points: &[[f64; 3]], radius: f64, pose: &Pose) -> Result<Self, Error> {
        Self::points_until(points, radius, pose, Interrupt::none())
    }

    /// [`Self::points`], until it is interrupted.
    #[doc(hidden)]
    pub fn points_until(
        points: &[[f64; 3]],
        radius: f64,
        pose: &Pose,
        interrupt: Interrupt<'_>,
    ) -> Result<Self, Error> {
        let pose = placed("point cloud", pose)?;
        Ok(Self::Points { pose, cloud: Cloud::new(points, radius, interrupt)? })
    }

    /// Several shapes as one.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidBody`] without a shape.
    pub fn union(shapes: Vec<Self>) -> Result<Self, Error> {
        let parts = |shape| match shape {
            Self::Union(parts) => parts,
            one => vec![one],
        };
        let parts: Vec<_> = shapes.into_iter().flat_map(parts).collect();
        if parts.is_empty() { Err(BodyFault::NoShape.into()) } else { Ok(Self::Union(parts)) }
    }

    /// The shapes that it consists of: itself, if it is no union.
    #[must_use]
    pub fn parts(&self) -> &[Self] {
        match self {
            Self::Union(parts) => parts,
            one => core::slice::from_ref(one),
        }
    }

    /// The shape moved from a frame, whose pose is given, into the frame of the pose.
    ///
    /// # Errors
    ///
    /// [`irbkin::Error::InvalidPose`], and [`Error::InvalidBody`] if it is more than 100 m away then.
    pub fn moved(&self, pose: &Pose) -> Result<Self, Error> {
        let to = checked_pose(pose)?;
        let mut moved = self.clone();
        match &mut moved {
            Self::Capsule(capsule) => *capsule = capsule.moved(&to),
            Self::Box { pose, .. }
            | Self::Cylinder { pose, .. }
            | Self::Convex { pose, .. }
            | Self::Mesh { pose, .. }
            | Self::Points { pose, .. } => *pose = to * *pose,
            Self::HalfSpace { normal, offset } => {
                *normal = to.rotation * *normal;
                *offset += normal.dot(&to.translation.vector);
                check_point("half space", "point", &(*normal * *offset))?;
            }
            Self::Union(parts) => {
                *parts = parts.iter().map(|part| part.moved(&to)).collect::<Result<_, _>>()?;
            }
        }
        if let Some((center, _)) = moved.ball() {
            check_point("moved shape", "middle", &center)?;
        }
        Ok(moved)
    }

    /// The center and the radius of a ball around it [m], if it has an end.
    pub(crate) fn ball(&self) -> Option<(Vector3<f64>, f64)> {
        let around = |pose: &Pose, bounds: &Bounds, more: f64| {
            (pose.rotation * bounds.center() + pose.translation.vector, bounds.radius() + more)
        };
        Some(match self {
            Self::Capsule(own) => own.ball(),
            Self::Box { pose, half } => (pose.translation.vector, half.norm()),
            Self::Cylinder { pose, radius, half } => {
                (pose.translation.vector, (radius * radius + half * half).sqrt())
            }
            Self::HalfSpace { .. } => return None,
            Self::Convex { pose, hull } => around(pose, hull.bounds(), 0.0),
            Self::Mesh { pose, mesh } => around(pose, mesh.tree().bounds(), 0.0),
            Self::Points { pose, cloud } => around(pose, cloud.tree().bounds(), cloud.radius()),
            Self::Union(_) => around(&Pose::identity(), &self.bounds()?, 0.0),
        })
    }

    /// A box around it along the axes, if it has an end.
    pub(crate) fn bounds(&self) -> Option<Bounds> {
        let around = |half: Vector3<f64>, pose: &Pose| Bounds::of([&-half, &half]).moved(pose);
        Some(match self {
            Self::Capsule(own) => Bounds::of(&own.ends).widened(own.radius),
            Self::Box { pose, half } => around(*half, pose),
            Self::Cylinder { pose, radius, half } => {
                around(Vector3::new(*radius, *radius, *half), pose)
            }
            Self::HalfSpace { .. } => return None,
            Self::Convex { pose, hull } => hull.bounds().moved(pose),
            Self::Mesh { pose, mesh } => mesh.tree().bounds().moved(pose),
            Self::Points { pose, cloud } => {
                cloud.tree().bounds().moved(pose).widened(cloud.radius())
            }
            Self::Union(parts) => {
                let each = parts.iter().map(Self::bounds).collect::<Option<Vec<_>>>()?;
                Bounds::of(each.iter().flat_map(|own| [&own.low, &own.high]))
            }
        })
    }

    /// Whether a capsule is farther than a distance [m] since the balls around both are.
    fn is_far(&self, capsule: &Capsule, distance: f64) -> bool {
        let is_beyond = |(center, radius)| capsule.is_far_from_ball(&center, radius + distance);
        self.ball().is_some_and(is_beyond)
    }

    /// Whether a capsule is as near to the shape as a distance [m], or nearer.
    pub(crate) fn is_within(&self, capsule: &Capsule, distance: f64) -> bool {
        let own = |pose: &Pose| capsule.moved(&pose.inverse());
        match self {
            Self::Union(parts) => parts.iter().any(|part| part.is_within(capsule, distance)),
            _ if self.is_far(capsule, distance) => false,
            Self::Convex { pose, hull } => hull.is_within(&own(pose), distance),
            Self::Mesh { pose, mesh } => mesh.is_within(&own(pose), distance),
            Self::Points { pose, cloud } => cloud.is_within(&own(pose), distance),
            _ => self.separation(capsule).distance <= distance,
        }
    }

    /// How far a capsule is from the shape; where they touch, less than zero, and not below minus
    /// the capsule's radius if the shape is no half-space, capsule or cloud.
    pub(crate) fn separation(&self, capsule: &Capsule) -> Separation {
        let within = |pose: &Pose, separation: &dyn Fn(&Capsule) -> Separation| {
            separation(&capsule.moved(&pose.inverse())).moved(pose)
        };
        match self {
            Self::Capsule(own) => capsule.separation(own),
            Self::HalfSpace { normal, offset } => of_half_space(capsule, normal, *offset),
            Self::Box { pose, half } => {
                within(pose, &|own| of_convex(own, |point| nearest_of_box(half, point)))
            }
            Self::Cylinder { pose, radius, half } => within(pose, &|own| {
                of_convex(own, |point| nearest_of_cylinder(*radius, *half, point))
            }),
            Self::Convex { pose, hull } => within(pose, &|own| hull.separation(own)),
            Self::Mesh { pose, mesh } => within(pose, &|own| mesh.separation(own)),
            Self::Points { pose, cloud } => within(pose, &|own| cloud.separation(own)),
            Self::Union(parts) => {
                let each = parts.iter().map(|part| part.separation(capsule));
                let least = each.min_by(|a, b| a.distance.total_cmp(&b.distance));
                least.unwrap_or(Separation::NOTHING)
            }
        }
    }
}

fn of_half_space(capsule: &Capsule, normal: &Vector3<f64>, offset: f64) -> Separation {
    let depth = capsule.ends.map(|end| normal.dot(&end) - offset);
    let lowest = usize::from(depth[1] < depth[0]);
    let from = capsule.ends[lowest] - normal * capsule.radius;
    let distance = depth[lowest] - capsule.radius;
    Separation { distance, points: [from, from - normal * distance] }
}
