//! Shapes and how far a capsule is from them.
//!
//! Reference: Ericson, Real-Time Collision Detection, 2005, section 5.1.

use nalgebra::Vector3;
#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use crate::error::{BodyFault, Error};
use crate::kinematics::thresholds::MOST_LENGTH;
use crate::kinematics::{Pose, checked_pose};

/// Least size of a shape [m].
const LEAST: f64 = 1e-6;

/// Square of the sine between two axes below which they count as parallel [1].
const PARALLEL: f64 = 1e-12;

/// Rounds in which the nearest point of an axis is found, at most.
const ROUNDS: u32 = 60;

/// How far off the square of a distance may be [m^2].
const SQUARE_OFF: f64 = 1e-14;

/// All points within a radius of a line segment; a sphere if both ends are the same point.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Capsule {
    /// The ends of the axis [m].
    pub(crate) ends: [Vector3<f64>; 2],
    /// The radius [m].
    pub(crate) radius: f64,
}

impl Capsule {
    /// A capsule by the ends of its axis [m] and its radius [m].
    ///
    /// # Errors
    ///
    /// [`Error::InvalidBody`] for an end that is not finite or more than 1e6 m away, and a radius
    /// below 1e-6 m.
    pub fn new(a: [f64; 3], b: [f64; 3], radius: f64) -> Result<Self, Error> {
        let capsule = Self::known(a, b, radius);
        check_point("a", &capsule.ends[0])?;
        check_point("b", &capsule.ends[1])?;
        check_length("radius", radius, LEAST)?;
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

    /// A point of the axis, `part` of the way from one end to the other.
    fn at(&self, part: f64) -> Vector3<f64> {
        self.ends[0] + (self.ends[1] - self.ends[0]) * part
    }

    /// The part of the axis at which it is nearest to a point.
    fn nearest(&self, point: &Vector3<f64>) -> f64 {
        let axis = self.ends[1] - self.ends[0];
        let length = axis.norm_squared();
        if length == 0.0 {
            0.0
        } else {
            (axis.dot(&(point - self.ends[0])) / length).clamp(0.0, 1.0)
        }
    }

    /// The radius of the ball around it [m].
    pub(crate) fn ball(&self) -> f64 {
        0.5 * (self.ends[1] - self.ends[0]).norm() + self.radius
    }

    /// How far two capsules are apart.
    pub(crate) fn separation(&self, other: &Self) -> Separation {
        let (one, two) = (self.ends[1] - self.ends[0], other.ends[1] - other.ends[0]);
        let between = self.ends[0] - other.ends[0];
        let (a, b, c) = (one.norm_squared(), one.dot(&two), two.norm_squared());
        let mut nearest = (f64::INFINITY, [0.0; 2]);
        let mut take = |parts: [f64; 2]| {
            let square = (self.at(parts[0]) - other.at(parts[1])).norm_squared();
            if square < nearest.0 {
                nearest = (square, parts);
            }
        };
        for end in [0, 1] {
            let part = if end == 0 { 0.0 } else { 1.0 };
            take([part, other.nearest(&self.ends[end])]);
            take([self.nearest(&other.ends[end]), part]);
        }
        let across = a * c - b * b;
        if across > PARALLEL * a * c {
            let part = ((b * two.dot(&between) - c * one.dot(&between)) / across).clamp(0.0, 1.0);
            take([part, other.nearest(&self.at(part))]);
        }
        let parts = nearest.1;
        let [from, to] = [self.at(parts[0]), other.at(parts[1])];
        Separation::between(from, self.radius, to, other.radius)
    }
}

/// A solid shape.
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
}

impl Shape {
    /// A sphere by its radius and center [m].
    ///
    /// # Errors
    ///
    /// As [`Capsule::new`].
    pub fn sphere(radius: f64, center: [f64; 3]) -> Result<Self, Error> {
        check_point("center", &center.into())?;
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
    /// [`Error::InvalidBody`] for an edge that is shorter than 1e-6 m or not finite, and
    /// [`Error::InvalidPose`].
    pub fn cuboid(size: [f64; 3], pose: &Pose) -> Result<Self, Error> {
        for length in size {
            check_length("size", length, LEAST)?;
        }
        Ok(Self::Box { pose: placed(pose)?, half: 0.5 * Vector3::from(size) })
    }

    /// A cylinder by its radius and length [m], around the origin of `pose` along its z axis.
    ///
    /// # Errors
    ///
    /// As [`Self::cuboid`].
    pub fn cylinder(radius: f64, length: f64, pose: &Pose) -> Result<Self, Error> {
        check_length("radius", radius, LEAST)?;
        check_length("length", length, LEAST)?;
        Ok(Self::Cylinder { pose: placed(pose)?, radius, half: 0.5 * length })
    }

    /// Everything behind the plane through `point` [m] whose normal is `normal`: a floor has the
    /// normal (0, 0, 1).
    ///
    /// # Errors
    ///
    /// [`Error::InvalidBody`] for a point or normal that is not finite, and a normal of length zero.
    pub fn half_space(normal: [f64; 3], point: [f64; 3]) -> Result<Self, Error> {
        let (normal, point) = (Vector3::from(normal), Vector3::from(point));
        check_point("normal", &normal)?;
        check_point("point", &point)?;
        let length = normal.norm();
        if length < f64::MIN_POSITIVE {
            return Err(BodyFault::Normal.into());
        }
        let normal = normal / length;
        Ok(Self::HalfSpace { normal, offset: normal.dot(&point) })
    }

    /// The center and the radius of a ball around it [m], if it has an end.
    pub(crate) fn ball(&self) -> Option<(Vector3<f64>, f64)> {
        Some(match self {
            Self::Capsule(own) => (own.at(0.5), own.ball()),
            Self::Box { pose, half } => (pose.translation.vector, half.norm()),
            Self::Cylinder { pose, radius, half } => (pose.translation.vector, radius.hypot(*half)),
            Self::HalfSpace { .. } => return None,
        })
    }

    /// How far a capsule is from the shape; where they touch, less than zero, and not below minus
    /// the capsule's radius if the shape is no half-space or capsule.
    pub(crate) fn separation(&self, capsule: &Capsule) -> Separation {
        match self {
            Self::Capsule(own) => capsule.separation(own),
            Self::HalfSpace { normal, offset } => {
                let depth = capsule.ends.map(|end| normal.dot(&end) - offset);
                let lowest = usize::from(depth[1] < depth[0]);
                let from = capsule.ends[lowest] - normal * capsule.radius;
                let distance = depth[lowest] - capsule.radius;
                Separation { distance, points: [from, from - normal * distance] }
            }
            Self::Box { pose, half } => {
                let nearest = |point: &Vector3<f64>| {
                    point.zip_map(half, |value, half| value.clamp(-half, half))
                };
                of_convex(capsule, pose, nearest)
            }
            Self::Cylinder { pose, radius, half } => of_convex(capsule, pose, |point| {
                let across = point.x.hypot(point.y);
                let scale = if across > *radius { radius / across } else { 1.0 };
                Vector3::new(scale * point.x, scale * point.y, point.z.clamp(-half, *half))
            }),
        }
    }
}

/// How far a capsule is from a convex shape whose nearest point to a point is known: along the
/// axis the square of the distance is convex, and its slope changes sign at the least one.
fn of_convex(
    capsule: &Capsule,
    pose: &Pose,
    nearest: impl Fn(&Vector3<f64>) -> Vector3<f64>,
) -> Separation {
    let own = capsule.moved(&pose.inverse());
    let axis = own.ends[1] - own.ends[0];
    let look = |part: f64| {
        let from = own.at(part);
        let to = nearest(&from);
        (axis.dot(&(from - to)), from, to)
    };
    let (first, last) = (look(0.0), look(1.0));
    let mut best = if first.0 >= 0.0 { first } else { last };
    let mut rest = 0.0;
    if first.0 < 0.0 && last.0 > 0.0 {
        let (mut low, mut high, mut slopes) = (0.0, 1.0, [first.0, last.0]);
        for round in 0..ROUNDS {
            let part = if round % 2 == 0 {
                low - slopes[0] * (high - low) / (slopes[1] - slopes[0])
            } else {
                0.5 * (low + high)
            };
            best = look(part);
            // By convexity, the square is nowhere in between less by more than this.
            rest = 2.0 * best.0.abs() * (high - low);
            if rest <= SQUARE_OFF {
                break;
            }
            if best.0 < 0.0 {
                (low, slopes[0]) = (part, best.0);
            } else {
                (high, slopes[1]) = (part, best.0);
            }
        }
    }
    let (_, from, to) = best;
    let square = ((from - to).norm_squared() - rest).max(0.0);
    let away =
        if square > 0.0 { (from - to).normalize() * capsule.radius } else { Vector3::zeros() };
    let [from, to] = [from - away, to].map(|point| pose.rotation * point + pose.translation.vector);
    Separation { distance: square.sqrt() - capsule.radius, points: [from, to] }
}

fn placed(pose: &Pose) -> Result<Pose, Error> {
    let pose = checked_pose(pose)?;
    check_point("pose", &pose.translation.vector)?;
    Ok(pose)
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
    /// Of two balls.
    fn between(from: Vector3<f64>, radius: f64, to: Vector3<f64>, other: f64) -> Self {
        let way = to - from;
        let length = way.norm();
        let direction = if length > 0.0 { way / length } else { Vector3::z() };
        let points = [from + direction * radius, to - direction * other];
        Self { distance: length - radius - other, points }
    }
}

/// Check a length of a shape [m].
pub(crate) fn check_length(field: &'static str, value: f64, least: f64) -> Result<(), Error> {
    // NaN is in no range.
    if value >= least && value <= MOST_LENGTH {
        Ok(())
    } else {
        Err(BodyFault::Length { field, value, least, most: MOST_LENGTH }.into())
    }
}

/// Check a point [m].
fn check_point(field: &'static str, point: &Vector3<f64>) -> Result<(), Error> {
    for (index, value) in point.iter().enumerate() {
        if value.is_nan() || value.abs() > MOST_LENGTH {
            return Err(BodyFault::Point { field, index, value: *value, most: MOST_LENGTH }.into());
        }
    }
    Ok(())
}
