//! From one joint vector to another.

use super::axis::{AxisLimits, AxisMotion, Profile};
use super::check::{check_axes, check_duration, check_finite, check_joints};
use super::phase::AxisState;
use super::piecewise::Trajectory;
use crate::error::{Error, MotionFault};
use crate::prelude::*;
use irbkin::internal::check_length;

/// How joints with limits of their own arrive together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Synchronization {
    /// Each joint has a profile of its own, slowed down to the duration of the slowest: the
    /// shortest duration.
    Time,
    /// All joints share one profile: a straight line in joint space, as ABB's MoveJ describes it.
    Phase,
}

impl Profile {
    fn name(self) -> &'static str {
        match self {
            Self::Quintic => "quintic",
            Self::Cubic => "cubic",
            Self::Trapezoid => "trapezoid",
            Self::SCurve => "s_curve",
        }
    }

    /// Refuses velocities and accelerations at the ends that the profile cannot have.
    fn check_ends(self, states: &[AxisState]) -> Result<(), Error> {
        let fault =
            |field: &'static str| MotionFault::Profile { profile: self.name(), field }.into();
        if self != Self::Quintic
            && !states.iter().all(|state| AxisState::is_rest(state.acceleration))
        {
            return Err(fault("acceleration at an end"));
        }
        let has_velocity = matches!(self, Self::Quintic | Self::Cubic);
        if !has_velocity && !states.iter().all(|state| AxisState::is_rest(state.velocity)) {
            return Err(fault("velocity at an end"));
        }
        Ok(())
    }
}

/// A trajectory between two states of each joint over a duration [s].
///
/// # Errors
///
/// [`irbkin::Error::InvalidJoints`] for an angle that is not finite or beyond [`MOST_ANGLE`];
/// [`Error::InvalidMotion`] for no joints, a velocity or acceleration that is not finite or that the
/// profile cannot have, or a duration outside 1e-9 to 1e9 s;
/// [`irbkin::Error::WrongLength`] for ends of different lengths.
///
/// [`MOST_ANGLE`]: irbkin::thresholds::MOST_ANGLE
pub fn joint(
    profile: Profile,
    start: &[AxisState],
    end: &[AxisState],
    duration: f64,
) -> Result<Trajectory, Error> {
    check_length("q1", end.len(), start.len())?;
    check_states(["q0", "start_velocity", "start_acceleration"], start)?;
    check_states(["q1", "end_velocity", "end_acceleration"], end)?;
    profile.check_ends(start)?;
    profile.check_ends(end)?;
    check_duration(duration)?;
    let axes: Vec<AxisMotion> = start
        .iter()
        .zip(end)
        .map(|(start, end)| match profile {
            Profile::Quintic => AxisMotion::quintic(*start, *end, duration),
            Profile::Cubic => AxisMotion::cubic(*start, *end, duration),
            Profile::Trapezoid => AxisMotion::trapezoid(start.position, end.position, duration),
            Profile::SCurve => AxisMotion::s_curve(start.position, end.position, duration),
        })
        .collect();
    Trajectory::of_axes(&axes).checked()
}

/// Check states; `fields` name their positions, velocities and accelerations.
fn check_states(fields: [&'static str; 3], states: &[AxisState]) -> Result<(), Error> {
    let of = |number: fn(&AxisState) -> f64| states.iter().map(number).collect::<Vec<_>>();
    check_joints(fields[0], &of(|state| state.position))?;
    check_finite(fields[1], &of(|state| state.velocity))?;
    check_finite(fields[2], &of(|state| state.acceleration))
}

/// The shortest trajectory of a profile between two joint vectors [rad], from rest to rest, within
/// limits.
///
/// # Errors
///
/// As [`joint`]; [`Error::InvalidMotion`] too for a limit that is not positive or a joint that moves
/// and that no limit binds.
pub fn joint_within(
    profile: Profile,
    start: &[f64],
    end: &[f64],
    limits: &[AxisLimits],
    synchronization: Synchronization,
) -> Result<Trajectory, Error> {
    check_length("q1", end.len(), start.len())?;
    check_joints("q0", start)?;
    check_joints("q1", end)?;
    check_axes(limits, start.len())?;
    let axes = match synchronization {
        Synchronization::Time => slowed(profile, start, end, limits),
        Synchronization::Phase => along_line(profile, start, end, limits),
    };
    let arrives = axes.iter().map(AxisMotion::duration).fold(0.0, f64::max);
    let moving = start.iter().zip(end).position(|(start, end)| (end - start).abs() > 0.0);
    match moving {
        Some(joint) if arrives == 0.0 => Err(MotionFault::NoDuration { joint: joint + 1 }.into()),
        Some(_) => check_duration(arrives).and_then(|()| Trajectory::of_axes(&axes).checked()),
        None => Ok(Trajectory::of_axes(&axes)),
    }
}

/// A profile each, at the pace of the slowest.
fn slowed(profile: Profile, start: &[f64], end: &[f64], limits: &[AxisLimits]) -> Vec<AxisMotion> {
    let own = start.iter().zip(end).zip(limits);
    let own = own.map(|((start, end), limits)| AxisMotion::within(profile, *start, *end, limits));
    let mut axes: Vec<AxisMotion> = own.collect();
    let duration = axes.iter().map(AxisMotion::duration).fold(0.0, f64::max);
    for (axis, (start, end)) in axes.iter_mut().zip(start.iter().zip(end)) {
        // A joint that nothing limits has the time of the others.
        if axis.duration() == 0.0 && (end - start).abs() > 0.0 && duration > 0.0 {
            let [start, end] = [*start, *end].map(AxisState::at_rest);
            *axis = AxisMotion::quintic(start, end, duration);
        } else {
            *axis = axis.stretched(duration);
        }
    }
    axes
}

/// One profile from 0 to 1, within what the limits of each joint leave of its velocity,
/// acceleration and jerk.
fn along_line(
    profile: Profile,
    start: &[f64],
    end: &[f64],
    limits: &[AxisLimits],
) -> Vec<AxisMotion> {
    let none =
        AxisLimits { velocity: f64::INFINITY, acceleration: f64::INFINITY, jerk: f64::INFINITY };
    let ways = start.iter().zip(end).map(|(start, end)| (end - start).abs());
    let shared =
        ways.zip(limits).filter(|(way, _)| *way > 0.0).fold(none, |least, (way, own)| AxisLimits {
            velocity: least.velocity.min(own.velocity / way),
            acceleration: least.acceleration.min(own.acceleration / way),
            jerk: least.jerk.min(own.jerk / way),
        });
    let moves = start != end;
    let unit = AxisMotion::within(profile, 0.0, if moves { 1.0 } else { 0.0 }, &shared);
    start.iter().zip(end).map(|(start, end)| unit.between(*start, *end)).collect()
}
