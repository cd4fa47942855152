//! Lines through many poses, with corners that are rounded as ABB's zones are.

use alloc::vec::Vec;

use super::corner::{Corner, Rounded};
use super::leg::Leg;
use super::line::part;
use super::spacing::Spacing;
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
