//! A circular arc of the tool through three poses.

use core::f64::consts::TAU;

use nalgebra::{Rotation3, Translation3, Unit, Vector3};

use super::line::{Turn, part};
use super::spacing::Spacing;
use crate::error::{Error, MotionFault};
use crate::paths::thresholds::LEAST_BEND;
use crate::prelude::*;
use irbkin::Pose;
use irbkin::internal::checked_pose;

/// The orientation of the tool along an arc; ABB's names are values of CirPathMode.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum ArcOrientation {
    /// It turns evenly relative to the path (ABB: \PathFrame). The second pose's chooses the
    /// direction.
    #[default]
    Path,
    /// It turns evenly relative to the base (ABB: \ObjectFrame). The second pose's chooses the
    /// direction.
    Object,
    /// It turns evenly to the second pose's, then to the third's (ABB: \CirPointOri).
    Via,
}

/// Poses along the arc from `start` through `via` to `end`, both ends included, in equal steps
/// (eq. 19, 20).
///
/// # Errors
///
/// [`irbkin::Error::InvalidPose`] for a pose that is not a rigid transform; [`Error::InvalidMotion`] when
/// the three points lie on a line or coincide, the orientation makes a half turn whose direction
/// the second pose leaves open, or the spacing leaves the number of poses open.
pub fn arc(
    start: &Pose,
    via: &Pose,
    end: &Pose,
    orientation: ArcOrientation,
    spacing: Spacing,
) -> Result<Vec<Pose>, Error> {
    let poses @ [start, _, end] = [checked_pose(start)?, checked_pose(via)?, checked_pose(end)?];
    let arc = Arc::through([&poses[0], &poses[1], &poses[2]], orientation)?;
    let steps = spacing.steps_of_one([arc.length(), arc.angle()])?;
    let mut path = Vec::with_capacity(steps + 1);
    path.push(start);
    path.extend((1..steps).map(|step| {
        let part = part(step, steps);
        Pose::from_parts(Translation3::from(arc.position(part)), arc.orientation(part))
    }));
    path.push(end);
    Ok(path)
}

/// An arc through three poses; parts of it are from 0 to 1.
pub struct Arc {
    circle: Circle,
    turns: Turns,
}

impl Arc {
    pub(super) fn through(poses: [&Pose; 3], orientation: ArcOrientation) -> Result<Self, Error> {
        let circle = Circle::through(poses.map(|pose| pose.translation.vector))?;
        let turns = Turns::new(&circle, orientation, poses.map(|pose| pose.rotation))?;
        Ok(Self { circle, turns })
    }

    /// Its length [m].
    pub(super) fn length(&self) -> f64 {
        self.circle.radius * self.circle.end
    }

    /// An angle that the tool does not turn by more than [rad].
    pub(super) fn angle(&self) -> f64 {
        self.turns.angle(&self.circle)
    }

    /// The position at a part of the way (eq. 19).
    pub(super) fn position(&self, part: f64) -> Vector3<f64> {
        self.circle.at(part * self.circle.end)
    }

    /// The direction at a part of the way, of length one.
    pub(super) fn direction(&self, part: f64) -> Vector3<f64> {
        let (sin, cos) = (part * self.circle.end).sin_cos();
        (self.circle.y * cos - self.circle.x * sin) / self.circle.radius
    }

    pub(super) fn orientation(&self, part: f64) -> Rotation3<f64> {
        self.turns.at(&self.circle, part)
    }
}

/// A circle by its center, two directions in its plane, and the angles of points on it.
struct Circle {
    center: Vector3<f64>,
    /// From the center to the first point.
    x: Vector3<f64>,
    y: Vector3<f64>,
    radius: f64,
    /// Angles of the second and the third point, 0 to 2 pi, the first at 0.
    via: f64,
    end: f64,
}

impl Circle {
    fn through([first, second, third]: [Vector3<f64>; 3]) -> Result<Self, Error> {
        let (a, b) = (second - first, third - first);
        let normal = a.cross(&b);
        let longest = a.norm().max(b.norm()).max((b - a).norm());
        let (off, bound) = (normal.norm() / longest, LEAST_BEND * longest);
        // Points that coincide have no line: not a number.
        if off.is_nan() || off < bound {
            let off = if off.is_nan() { 0.0 } else { off };
            return Err(MotionFault::Collinear { off, bound }.into());
        }
        // The center of the triangle's circle, from the first point.
        let to_center = (b * a.norm_squared() - a * b.norm_squared()).cross(&normal)
            / (2.0 * normal.norm_squared());
        let x = -to_center;
        let y = normal.normalize().cross(&x);
        let mut circle =
            Self { center: first + to_center, x, y, radius: x.norm(), via: 0.0, end: 0.0 };
        (circle.via, circle.end) = (circle.angle(second), circle.angle(third));
        Ok(circle)
    }

    fn angle(&self, point: Vector3<f64>) -> f64 {
        let from_center = point - self.center;
        let angle = from_center.dot(&self.y).atan2(from_center.dot(&self.x));
        if angle < 0.0 { angle + TAU } else { angle }
    }

    fn at(&self, angle: f64) -> Vector3<f64> {
        let (sin, cos) = angle.sin_cos();
        self.center + self.x * cos + self.y * sin
    }

    /// The turn of the path itself up to an angle.
    fn turned(&self, angle: f64) -> Rotation3<f64> {
        Rotation3::from_axis_angle(&Unit::new_normalize(self.x.cross(&self.y)), angle)
    }
}

/// The orientation along an arc.
#[expect(clippy::large_enum_variant, reason = "one on the stack for a path")]
enum Turns {
    /// Relative to the path.
    Path(Turn),
    Object(Turn),
    /// To the second pose and on; the part of the way at which it is passed.
    Via([Turn; 2], f64),
}

impl Turns {
    fn new(
        circle: &Circle,
        orientation: ArcOrientation,
        [start, via, end]: [Rotation3<f64>; 3],
    ) -> Result<Self, Error> {
        let part = circle.via / circle.end;
        Ok(match orientation {
            ArcOrientation::Path => {
                let [via, end] = [(circle.via, via), (circle.end, end)]
                    .map(|(angle, orientation)| circle.turned(angle).inverse() * orientation);
                Self::Path(Turn::past([&start, &via, &end], part, 2)?)
            }
            ArcOrientation::Object => Self::Object(Turn::past([&start, &via, &end], part, 2)?),
            ArcOrientation::Via => Self::Via(
                [Turn::new(&start, &via, None, 1)?, Turn::new(&via, &end, None, 2)?],
                part,
            ),
        })
    }

    fn at(&self, circle: &Circle, part: f64) -> Rotation3<f64> {
        match self {
            Self::Path(turn) => circle.turned(part * circle.end) * turn.at(part),
            Self::Object(turn) => turn.at(part),
            Self::Via([first, _], via) if part <= *via => first.at(part / via),
            Self::Via([_, second], via) => second.at((part - via) / (1.0 - via)),
        }
    }

    /// An angle that the tool does not turn by more than.
    fn angle(&self, circle: &Circle) -> f64 {
        match self {
            Self::Path(turn) => turn.angle + circle.end,
            Self::Object(turn) => turn.angle,
            Self::Via([first, second], via) => {
                // Steps are equal over the whole arc: the faster half counts.
                (first.angle / via).max(second.angle / (1.0 - via))
            }
        }
    }
}
