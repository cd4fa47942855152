//! Lines through many poses, with corners that are rounded as ABB's zones are.

use alloc::vec::Vec;

use nalgebra::{Rotation3, Translation3, Vector3};

use super::line::part;
use super::spacing::Spacing;
use super::turn::Turn;
use super::zone::Zone;
use crate::error::{Error, MotionFault};
use crate::kinematics::{Pose, checked_pose};

/// How far a corner is from the path that rounds it, for a zone of `radius` [m] at a corner where
/// the direction changes by `angle` [rad]: `radius / 2 * sin(angle / 2)` (eq. 22).
#[must_use]
pub fn corner_distance(radius: f64, angle: f64) -> f64 {
    #[cfg(not(feature = "std"))]
    use nalgebra::ComplexField as _;
    0.5 * radius * (0.5 * angle).sin()
}

/// Poses along lines from one pose to the next, corners rounded by `zones`, one for each pose; those
/// of the first and the last pose are met whatever their zones are.
///
/// Inside a zone the position runs on a parabola, as ABB's manual has it, which leaves the lines
/// where the zone begins (eq. 21). A zone reaches half of the way to the next corner at most. The
/// orientation is blended in the same way over its own zone. Each line is divided into equal steps.
/// A corner before or behind a pose that only turns is met.
///
/// # Errors
///
/// [`Error::InvalidPose`] for a pose that is not a rigid transform; [`Error::InvalidMotion`] for no
/// pose, another number of zones, a negative zone, a half turn or a spacing that leaves the number
/// of poses open.
pub fn polyline(poses: &[Pose], zones: &[Zone], spacing: Spacing) -> Result<Vec<Pose>, Error> {
    if poses.is_empty() {
        return Err(MotionFault::TooFew { field: "T", found: 0, least: 1 }.into());
    }
    if zones.len() != poses.len() {
        let (found, wanted) = (zones.len(), poses.len());
        return Err(Error::WrongLength { field: "zones", found, wanted });
    }
    let poses: Vec<Pose> = poses.iter().map(checked_pose).collect::<Result<_, _>>()?;
    zones.iter().enumerate().try_for_each(|(index, zone)| zone.check(index))?;
    let legs = poses
        .windows(2)
        .enumerate()
        .map(|(index, ends)| Leg::new([&ends[0], &ends[1]], index + 1))
        .collect::<Result<Vec<_>, _>>()?;
    if legs.is_empty() {
        return Ok(poses);
    }
    let corners: Vec<Corner> = (0..poses.len())
        .map(|index: usize| {
            match (index.checked_sub(1).map(|before| &legs[before]), legs.get(index)) {
                (Some(before), Some(after)) => Corner::new(&zones[index], before, after),
                _ => Corner::default(),
            }
        })
        .collect();
    let sizes: Vec<[f64; 2]> = legs.iter().map(|leg| [leg.length, leg.turn.angle]).collect();
    let steps = spacing.steps(&sizes)?;
    let mut path = Vec::with_capacity(steps.iter().sum::<usize>() + 1);
    path.push(poses[0]);
    for (index, (leg, steps)) in legs.iter().zip(steps).enumerate() {
        for step in 1..=steps {
            if step == steps
                && corners[index + 1].position == 0.0
                && corners[index + 1].orientation == 0.0
            {
                path.push(poses[index + 1]);
                continue;
            }
            let part = part(step, steps);
            let place = Place { legs: &legs, corners: &corners, index, part };
            let position = place.position(leg, &poses);
            path.push(Pose::from_parts(Translation3::from(position), place.orientation(leg)?));
        }
    }
    Ok(path)
}

/// A line between two poses.
struct Leg {
    start: Vector3<f64>,
    way: Vector3<f64>,
    length: f64,
    turn: Turn,
}

impl Leg {
    fn new([start, end]: [&Pose; 2], index: usize) -> Result<Self, Error> {
        let way = end.translation.vector - start.translation.vector;
        let turn = Turn::new(&start.rotation, &end.rotation, None, index)?;
        Ok(Self { start: start.translation.vector, way, length: way.norm(), turn })
    }
}

/// The zones of a corner as they come out between its neighbors [m].
#[derive(Clone, Copy, Default)]
struct Corner {
    position: f64,
    orientation: f64,
}

impl Corner {
    fn new(zone: &Zone, before: &Leg, after: &Leg) -> Self {
        let half = 0.5 * before.length.min(after.length);
        let position = zone.position.min(half);
        if position == 0.0 {
            return Self::default();
        }
        // An angle that is left to turn is a length of the way that turns by it.
        let left = [before, after].map(|leg| zone.angle / leg.turn.angle * leg.length);
        let orientation = zone.orientation.min(left[0].min(left[1])).max(position).min(half);
        Self { position, orientation }
    }
}

/// A part of a leg, with its corners.
struct Place<'a> {
    legs: &'a [Leg],
    corners: &'a [Corner],
    index: usize,
    part: f64,
}

impl Place<'_> {
    /// The corner whose zone the place is in, and how far through it, 0 to 1.
    fn inside(&self, leg: &Leg, size: impl Fn(&Corner) -> f64) -> Option<(usize, f64)> {
        let [behind, ahead] = [self.part, 1.0 - self.part].map(|part| part * leg.length);
        let [last, next] = [size(&self.corners[self.index]), size(&self.corners[self.index + 1])];
        if behind < last {
            Some((self.index, 0.5 + 0.5 * behind / last))
        } else if ahead < next {
            Some((self.index + 1, 0.5 - 0.5 * ahead / next))
        } else {
            None
        }
    }

    fn position(&self, leg: &Leg, poses: &[Pose]) -> Vector3<f64> {
        let Some((corner, u)) = self.inside(leg, |corner| corner.position) else {
            return leg.start + leg.way * self.part;
        };
        let (before, after) = (&self.legs[corner - 1], &self.legs[corner]);
        let radius = self.corners[corner].position;
        let met = poses[corner].translation.vector;
        let [entry, exit] = [-radius / before.length, radius / after.length];
        let v = 1.0 - u;
        met + before.way * (entry * v * v) + after.way * (exit * u * u)
    }

    fn orientation(&self, leg: &Leg) -> Result<Rotation3<f64>, Error> {
        let Some((corner, u)) = self.inside(leg, |corner| corner.orientation) else {
            return Ok(leg.turn.at(self.part));
        };
        let (before, after) = (&self.legs[corner - 1], &self.legs[corner]);
        let size = self.corners[corner].orientation;
        // De Casteljau's construction of the parabola, with turns for lines.
        let entry = before.turn.at(1.0 - (1.0 - u) * size / before.length);
        let exit = after.turn.at(u * size / after.length);
        Ok(Turn::new(&entry, &exit, None, corner)?.at(u))
    }
}
