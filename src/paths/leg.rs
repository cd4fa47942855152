//! A part of a path between two poses: a line or an arc.

use nalgebra::{Rotation3, Vector3};

use super::arc::Arc;
#[cfg(feature = "rapid")]
use super::arc::ArcOrientation;
use super::line::Line;
use crate::error::Error;
use crate::kinematics::Pose;

/// A line or an arc of the tool; parts of it are from 0 to 1.
#[cfg_attr(not(feature = "rapid"), expect(dead_code, reason = "arcs are parts of RAPID motion"))]
#[expect(clippy::large_enum_variant, reason = "most are lines, one or two at a time")]
pub(crate) enum Leg {
    Line(Line),
    Arc(Arc),
}

impl Leg {
    /// A line between two poses; `index` is the pose that an error names.
    pub(crate) fn line([start, end]: [&Pose; 2], index: usize) -> Result<Self, Error> {
        Ok(Self::Line(Line::new([start, end], None, index)?))
    }

    /// An arc through three poses.
    #[cfg(feature = "rapid")]
    pub(crate) fn arc(poses: [&Pose; 3], orientation: ArcOrientation) -> Result<Self, Error> {
        Ok(Self::Arc(Arc::through(poses, orientation)?))
    }

    /// Its length [m].
    pub(crate) fn length(&self) -> f64 {
        match self {
            Self::Line(line) => line.length(),
            Self::Arc(arc) => arc.length(),
        }
    }

    /// An angle that the tool does not turn by more than [rad].
    pub(crate) fn angle(&self) -> f64 {
        match self {
            Self::Line(line) => line.angle(),
            Self::Arc(arc) => arc.angle(),
        }
    }

    /// The position at a part of the way.
    pub(super) fn position(&self, part: f64) -> Vector3<f64> {
        match self {
            Self::Line(line) => line.position(part),
            Self::Arc(arc) => arc.position(part),
        }
    }

    /// The direction at a part of the way: a vector of length one, or zero of a line without
    /// length.
    pub(super) fn direction(&self, part: f64) -> Vector3<f64> {
        match self {
            Self::Line(line) => line.direction(),
            Self::Arc(arc) => arc.direction(part),
        }
    }

    /// The orientation at a part of the way.
    pub(super) fn orientation(&self, part: f64) -> Rotation3<f64> {
        match self {
            Self::Line(line) => line.orientation(part),
            Self::Arc(arc) => arc.orientation(part),
        }
    }
}
