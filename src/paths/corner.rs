//! Corners that are rounded as ABB's zones are.

use nalgebra::{Rotation3, Translation3, Vector3};

use super::leg::Leg;
use super::turn::Turn;
use super::zone::Zone;
use crate::error::Error;
use crate::kinematics::Pose;

/// The zones of a corner between its neighbors [m].
#[derive(Clone, Copy, Default)]
pub(crate) struct Corner {
    position: f64,
    orientation: f64,
}

impl Corner {
    pub(crate) fn new(zone: &Zone, before: &Leg, after: &Leg) -> Self {
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
    pub(crate) fn is_met(&self) -> bool {
        self.position == 0.0 && self.orientation == 0.0
    }
}

/// A leg with its neighbors behind rounded corners, if it has them.
pub(crate) struct Rounded<'a> {
    pub(crate) before: Option<(&'a Leg, Corner)>,
    pub(crate) leg: &'a Leg,
    pub(crate) after: Option<(&'a Leg, Corner)>,
    /// The pose at the end of the leg, for errors.
    pub(crate) index: usize,
}

/// A place inside a zone: the legs that meet there, its size, and how far through it, 0 to 1.
struct Inside<'a> {
    legs: [&'a Leg; 2],
    size: f64,
    u: f64,
    index: usize,
}

impl Rounded<'_> {
    /// The pose at a part of the leg, 0 to 1; at both ends halfway through the corners.
    pub(crate) fn at(&self, part: f64) -> Result<Pose, Error> {
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
    fn inside(&self, part: f64, size: impl Fn(&Corner) -> f64) -> Option<Inside<'_>> {
        let [behind, ahead] = [part, 1.0 - part].map(|part| part * self.leg.length());
        if let Some((before, corner)) = &self.before {
            let size = size(corner);
            if behind < size {
                let (u, index) = (0.5 + 0.5 * behind / size, self.index - 1);
                return Some(Inside { legs: [before, self.leg], size, u, index });
            }
        }
        let (after, corner) = self.after.as_ref()?;
        let (size, index) = (size(corner), self.index);
        let u = 0.5 - 0.5 * ahead / size;
        (ahead < size).then_some(Inside { legs: [self.leg, after], size, u, index })
    }
}

impl Inside<'_> {
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
