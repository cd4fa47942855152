//! Lines through many poses, with corners that are rounded as ABB's zones are.

use nalgebra::{Rotation3, Translation3, Vector3};

use super::arc::{Arc, ArcOrientation};
use super::line::{Line, Turn, part};
use super::spacing::Spacing;
use crate::error::{Error, MotionFault};
use crate::prelude::*;
use irbkin::Pose;
use irbkin::internal::{check_length, checked_pose};

/// How far a corner is from the path that rounds it, for a zone of `radius` [m] at a corner where
/// the direction changes by `angle` [rad]: `radius / 2 * sin(angle / 2)` (eq. 22).
#[must_use]
pub fn corner_distance(radius: f64, angle: f64) -> f64 {
    #[cfg(not(feature = "std"))]
    use nalgebra::ComplexField as _;
    0.5 * radius * (0.5 * angle).sin()
}

/// Poses along lines from one pose to the next, corners rounded by `zones`, one for each pose; the
/// first and the last pose are met whatever their zones are.
///
/// Inside a zone the position runs on a parabola, as ABB's manual has it, which leaves the lines
/// where the zone begins (eq. 21). A zone reaches half of the way to the next corner at most. The
/// orientation is blended in the same way over its own zone. Each line is divided into equal steps.
/// A corner before or behind a pose that only turns is met.
///
/// # Errors
///
/// [`irbkin::Error::InvalidPose`] for a pose that is not a rigid transform; [`Error::InvalidMotion`] for no
/// pose, another number of zones, a negative zone, a half turn or a spacing that leaves the number
/// of poses open.
pub fn polyline(poses: &[Pose], zones: &[Zone], spacing: Spacing) -> Result<Vec<Pose>, Error> {
    if poses.is_empty() {
        return Err(MotionFault::TooFew { field: "T", found: 0, least: 1 }.into());
    }
    check_length("zones", zones.len(), poses.len())?;
    let poses: Vec<Pose> = poses.iter().map(checked_pose).collect::<Result<_, _>>()?;
    zones.iter().enumerate().try_for_each(|(index, zone)| zone.check(index))?;
    let legs = poses
        .windows(2)
        .enumerate()
        .map(|(index, ends)| Leg::line([&ends[0], &ends[1]], index + 1))
        .collect::<Result<Vec<_>, _>>()?;
    if legs.is_empty() {
        return Ok(poses);
    }
    let corner = |index: usize| match (index.checked_sub(1).map(|it| &legs[it]), legs.get(index)) {
        (Some(before), Some(after)) => Corner::new(&zones[index], before, after),
        _ => Corner::default(),
    };
    let sizes: Vec<[f64; 2]> = legs.iter().map(|leg| [leg.length(), leg.angle()]).collect();
    let steps = spacing.steps(&sizes)?;
    let mut path = Vec::with_capacity(steps.iter().sum::<usize>() + 1);
    path.push(poses[0]);
    let mut last = corner(0);
    for (index, (leg, steps)) in legs.iter().zip(steps).enumerate() {
        let next = corner(index + 1);
        let rounded = Rounded {
            before: index.checked_sub(1).map(|before| (&legs[before], last)),
            leg,
            after: legs.get(index + 1).map(|after| (after, next)),
            index: index + 1,
        };
        for step in 1..=steps {
            let is_met = step == steps && next.is_met();
            path.push(if is_met { poses[index + 1] } else { rounded.at(part(step, steps))? });
        }
        last = next;
    }
    Ok(path)
}

/// How far around a corner of a polyline the tool may leave the way to it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Zone {
    /// Distance from the corner at which the position leaves the line [m]; 0 for a corner that is
    /// met.
    pub position: f64,
    /// Distance from the corner at which the orientation begins to leave its way [m]; at least
    /// `position` counts.
    pub orientation: f64,
    /// Angle left to turn, where the orientation begins to leave its way [rad]: the smaller of both
    /// counts.
    pub angle: f64,
}

/// ABB's predefined zones: name, tool [mm], orientation [mm], orientation [deg].
/// Source: the zonedata table of the RAPID reference manual.
pub const PREDEFINED: [(&str, f64, f64, f64); 15] = [
    ("fine", 0.0, 0.0, 0.0),
    ("z0", 0.3, 0.3, 0.03),
    ("z1", 1.0, 1.0, 0.1),
    ("z5", 5.0, 8.0, 0.8),
    ("z10", 10.0, 15.0, 1.5),
    ("z15", 15.0, 23.0, 2.3),
    ("z20", 20.0, 30.0, 3.0),
    ("z30", 30.0, 45.0, 4.5),
    ("z40", 40.0, 60.0, 6.0),
    ("z50", 50.0, 75.0, 7.5),
    ("z60", 60.0, 90.0, 9.0),
    ("z80", 80.0, 120.0, 12.0),
    ("z100", 100.0, 150.0, 15.0),
    ("z150", 150.0, 225.0, 23.0),
    ("z200", 200.0, 300.0, 30.0),
];

impl Zone {
    /// A corner that is met.
    pub const FINE: Self = Self { position: 0.0, orientation: 0.0, angle: 0.0 };

    /// A zone with one radius for position and orientation [m].
    #[must_use]
    pub const fn radius(radius: f64) -> Self {
        Self { position: radius, orientation: radius, angle: f64::INFINITY }
    }

    /// One of ABB's predefined zones, "fine", "z0" .. "z200"; `None` for another name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let (_, position, orientation, angle) =
            PREDEFINED.iter().find(|(own, ..)| own.eq_ignore_ascii_case(name))?;
        Some(Self::of_zonedata([*position, *orientation], *angle))
    }

    /// A zone in the units of zonedata: position and orientation [mm], angle [deg].
    #[doc(hidden)]
    pub fn of_zonedata([position, orientation]: [f64; 2], angle: f64) -> Self {
        Self {
            position: position * 1e-3,
            orientation: orientation * 1e-3,
            angle: angle.to_radians(),
        }
    }

    fn check(&self, index: usize) -> Result<(), Error> {
        for value in [self.position, self.orientation] {
            if !(value >= 0.0 && value.is_finite()) {
                return Err(MotionFault::Zone { index, value }.into());
            }
        }
        if self.angle.is_nan() || self.angle < 0.0 {
            return Err(MotionFault::Zone { index, value: self.angle }.into());
        }
        Ok(())
    }
}

/// A line or an arc of the tool; parts of it are from 0 to 1.
#[expect(clippy::large_enum_variant, reason = "most are lines, one or two at a time")]
pub enum Leg {
    Line(Line),
    Arc(Arc),
}

impl Leg {
    /// A line between two poses; `index` is the pose that an error names.
    pub fn line([start, end]: [&Pose; 2], index: usize) -> Result<Self, Error> {
        Ok(Self::Line(Line::new([start, end], None, index)?))
    }

    /// An arc through three poses.
    pub fn arc(poses: [&Pose; 3], orientation: ArcOrientation) -> Result<Self, Error> {
        Ok(Self::Arc(Arc::through(poses, orientation)?))
    }

    /// Its length [m].
    pub fn length(&self) -> f64 {
        match self {
            Self::Line(line) => line.length,
            Self::Arc(arc) => arc.length(),
        }
    }

    /// An angle that the tool does not turn by more than [rad].
    pub fn angle(&self) -> f64 {
        match self {
            Self::Line(line) => line.turn.angle,
            Self::Arc(arc) => arc.angle(),
        }
    }

    pub(super) fn position(&self, part: f64) -> Vector3<f64> {
        match self {
            Self::Line(line) => line.position(part),
            Self::Arc(arc) => arc.position(part),
        }
    }

    /// The direction at a part of the way: a vector of length one, or zero of a line without
    /// length.
    fn direction(&self, part: f64) -> Vector3<f64> {
        match self {
            Self::Line(line) => line.direction(),
            Self::Arc(arc) => arc.direction(part),
        }
    }

    fn orientation(&self, part: f64) -> Rotation3<f64> {
        match self {
            Self::Line(line) => line.turn.at(part),
            Self::Arc(arc) => arc.orientation(part),
        }
    }
}

/// The zones of a corner between its neighbors [m].
#[derive(Clone, Copy, Default)]
pub struct Corner {
    position: f64,
    orientation: f64,
}

impl Corner {
    pub fn new(zone: &Zone, before: &Leg, after: &Leg) -> Self {
        let half = 0.5 * before.length().min(after.length());
        let position = zone.position.min(half);
        if position == 0.0 {
            return Self::default();
        }
        // An angle that is left to turn is a length of the way that turns by it.
        let left = [before, after].map(|leg| zone.angle / leg.angle() * leg.length());
        let orientation = zone.orientation.min(left[0].min(left[1])).max(position).min(half);
        Self { position, orientation }
    }

    /// Whether the pose at the corner is met.
    pub fn is_met(&self) -> bool {
        self.position == 0.0 && self.orientation == 0.0
    }
}

/// A leg with its neighbors behind rounded corners, if it has them.
pub struct Rounded<'a> {
    pub before: Option<(&'a Leg, Corner)>,
    pub leg: &'a Leg,
    pub after: Option<(&'a Leg, Corner)>,
    /// The pose at the end of the leg, for errors.
    pub index: usize,
}

/// A place inside a zone: the legs that meet there, its size, and how far through it, 0 to 1.
struct ZonePoint<'a> {
    legs: [&'a Leg; 2],
    size: f64,
    u: f64,
    index: usize,
}

impl Rounded<'_> {
    /// The pose at a part of the leg, 0 to 1; at both ends halfway through the corners.
    pub fn at(&self, part: f64) -> Result<Pose, Error> {
        let position = match self.inside(part, |corner| corner.position) {
            Some(inside) => inside.position(),
            None => self.leg.position(part),
        };
        let orientation = match self.inside(part, |corner| corner.orientation) {
            Some(inside) => inside.orientation()?,
            None => self.leg.orientation(part),
        };
        Ok(Pose::from_parts(Translation3::from(position), orientation))
    }

    /// The zone that a part of the leg is in.
    fn inside(&self, part: f64, size: impl Fn(&Corner) -> f64) -> Option<ZonePoint<'_>> {
        let [behind, ahead] = [part, 1.0 - part].map(|part| part * self.leg.length());
        if let Some((before, corner)) = &self.before {
            let size = size(corner);
            if behind < size {
                let (u, index) = (0.5 + 0.5 * behind / size, self.index - 1);
                return Some(ZonePoint { legs: [before, self.leg], size, u, index });
            }
        }
        let (after, corner) = self.after.as_ref()?;
        let (size, index) = (size(corner), self.index);
        let u = 0.5 - 0.5 * ahead / size;
        (ahead < size).then_some(ZonePoint { legs: [self.leg, after], size, u, index })
    }
}

impl ZonePoint<'_> {
    /// Where the zone begins and ends, as parts of the legs.
    fn parts(&self) -> [f64; 2] {
        let [before, after] = self.legs;
        [1.0 - self.size / before.length(), self.size / after.length()]
    }

    /// A cubic with the directions of both legs, between two lines the parabola of eq. 21 (eq. 33).
    fn position(&self) -> Vector3<f64> {
        let ([entry, exit], [before, after]) = (self.parts(), self.legs);
        let (first, last) = (before.position(entry), after.position(exit));
        let reach = 2.0 / 3.0 * self.size;
        let second = first + before.direction(entry) * reach;
        let third = last - after.direction(exit) * reach;
        let (u, v) = (self.u, 1.0 - self.u);
        first * (v * v * v)
            + second * (3.0 * v * v * u)
            + third * (3.0 * v * u * u)
            + last * (u * u * u)
    }

    /// De Casteljau's construction of the parabola, with turns for lines.
    fn orientation(&self) -> Result<Rotation3<f64>, Error> {
        let ([entry, exit], [before, after]) = (self.parts(), self.legs);
        let first = before.orientation(entry + (1.0 - entry) * self.u);
        let last = after.orientation(exit * self.u);
        Ok(Turn::new(&first, &last, None, self.index)?.at(self.u))
    }
}
