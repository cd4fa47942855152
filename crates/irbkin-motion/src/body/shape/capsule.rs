//! Capsules: what moves with an arm.

use nalgebra::Vector3;
#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::checks::{check_point, check_size};
use super::segment::{Segment, at, between, part_near};
use crate::error::Error;
use irbkin::Pose;

/// By how much balls must be apart, relative to their sizes: more than rounding [1].
const FAR: f64 = 1e-9;

/// All points within a radius of a line segment; a sphere if both ends are the same point.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Capsule {
    /// The ends of the axis [m].
    pub(crate) ends: Segment,
    /// The radius [m].
    pub(crate) radius: f64,
}

impl Capsule {
    /// A capsule by the ends of its axis [m] and its radius [m].
    ///
    /// # Errors
    ///
    /// [`Error::InvalidBody`] for an end that is not finite or more than 100 m away, and a radius
    /// below 1e-6 m or above 100 m.
    pub fn new(a: [f64; 3], b: [f64; 3], radius: f64) -> Result<Self, Error> {
        let capsule = Self::known(a, b, radius);
        check_point("capsule", "a", &capsule.ends[0])?;
        check_point("capsule", "b", &capsule.ends[1])?;
        check_size("capsule", "radius", radius)?;
        Ok(capsule)
    }

    pub(crate) fn known(a: [f64; 3], b: [f64; 3], radius: f64) -> Self {
        Self { ends: [a, b].map(Vector3::from), radius }
    }

    /// The ends of the axis [m].
    #[must_use]
    pub fn ends(&self) -> [[f64; 3]; 2] {
        self.ends.map(Into::into)
    }

    /// Whether both ends are the same point.
    #[must_use]
    pub fn is_sphere(&self) -> bool {
        self.ends[0] == self.ends[1]
    }

    /// The radius [m].
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// The capsule moved from a frame, whose pose is given, into the frame of the pose.
    pub(crate) fn moved(&self, pose: &Pose) -> Self {
        let move_end = |end: &Vector3<f64>| pose.rotation * end + pose.translation.vector;
        Self { ends: [move_end(&self.ends[0]), move_end(&self.ends[1])], radius: self.radius }
    }

    /// Whether the ball around it is farther from a point than a distance [m].
    #[inline]
    pub(super) fn is_far_from_ball(&self, center: &Vector3<f64>, distance: f64) -> bool {
        let (own, radius) = self.ball();
        let most = (radius + distance) * (1.0 + FAR);
        (own - center).norm_squared() > most * most
    }

    /// How far a point is from the axis [m].
    pub(crate) fn axis_distance(&self, point: &Vector3<f64>) -> f64 {
        (point - at(&self.ends, part_near(&self.ends, point))).norm()
    }

    /// How far its farthest point is from the origin [m].
    pub(crate) fn farthest(&self) -> f64 {
        self.ends[0].norm().max(self.ends[1].norm()) + self.radius
    }

    /// The ball around it: center and radius [m].
    #[inline]
    pub(super) fn ball(&self) -> (Vector3<f64>, f64) {
        let length = (self.ends[1] - self.ends[0]).norm();
        (at(&self.ends, 0.5), 0.5 * length + self.radius)
    }

    /// Its volume over pi, for comparison [m^3].
    pub(crate) fn volume(&self) -> f64 {
        let length = (self.ends[1] - self.ends[0]).norm();
        self.radius * self.radius * (length + 4.0 / 3.0 * self.radius)
    }

    pub(crate) fn separation(&self, other: &Self) -> Separation {
        let (_, points) = between(&self.ends, &other.ends);
        Separation::of_balls(points, [self.radius, other.radius])
    }
}

/// How far two shapes are apart, and where they are nearest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Separation {
    /// The distance of their surfaces [m]; less than zero if they touch.
    pub(crate) distance: f64,
    /// The nearest points of the surfaces [m].
    pub(crate) points: [Vector3<f64>; 2],
}

impl Separation {
    /// From nothing at all.
    pub(crate) const NOTHING: Self =
        Self { distance: f64::INFINITY, points: [Vector3::new(f64::NAN, f64::NAN, f64::NAN); 2] };

    /// Of two balls, by their centers and radii.
    pub(super) fn of_balls([from, to]: [Vector3<f64>; 2], radii: [f64; 2]) -> Self {
        let way = to - from;
        let length = way.norm();
        let direction = if length > 0.0 { way / length } else { Vector3::z() };
        let points = [from + direction * radii[0], to - direction * radii[1]];
        Self { distance: length - radii[0] - radii[1], points }
    }

    /// Of two shapes with radii, by points that are nearest without these, the same where one shape
    /// is in the other; `distance` is theirs, or less. A solid has no radius.
    pub(super) fn of_rounded(
        distance: f64,
        [from, to]: [Vector3<f64>; 2],
        radii: [f64; 2],
    ) -> Self {
        let way = if distance > 0.0 { (to - from).normalize() } else { Vector3::zeros() };
        let points = [from + way * radii[0], to - way * radii[1]];
        Self { distance: distance - radii[0] - radii[1], points }
    }

    /// The separation moved from a frame, whose pose is given, into the frame of the pose.
    pub(super) fn moved(&self, pose: &Pose) -> Self {
        let points = self.points.map(|point| pose.rotation * point + pose.translation.vector);
        Self { distance: self.distance, points }
    }
}
