//! From any state, also beyond a limit, to rest at a target in the shortest time within limits of
//! velocity, acceleration and jerk; and to a standstill. Without a heap and in bounded time, for
//! control loops. docs/theory/jerk.md derives it.
//!
//! ```
//! use irbkin_motion::trajectory::{AxisLimits, AxisMotion, AxisState, state};
//!
//! let now = AxisState { position: 0.2, velocity: 1.0, acceleration: -3.0 };
//! let limits = AxisLimits { velocity: 2.0, acceleration: 8.0, jerk: 60.0 };
//! let mut motions = [AxisMotion::still(0.0, 0.0); 6];
//! let duration = state::to_rest(&[now; 6], &[0.9; 6], &[limits; 6], &mut motions)?;
//! assert!((motions[5].state(duration).position - 0.9).abs() < 1e-15);
//! assert!(state::brake(&now, &limits)?.duration() < duration);
//! # Ok::<(), irbkin_motion::Error>(())
//! ```

use super::axis::{AxisLimits, AxisMotion};
use super::check::{check_axes, check_finite};
use super::phase::{AxisState, Phase};
use super::piecewise::Trajectory;
use super::thresholds::{JOINED_POSITION, LIMIT_ROUNDING};
use crate::error::{Error, MotionFault};
use crate::prelude::*;
use irbkin::internal::check_length;

/// How far the target may be from where the joint stops anyway, as a part of the angles [1]: what
/// rounding leaves of their difference. To go there would take its cube root over the jerk.
const SAME_PLACE: f64 = 1e-15;

/// How much the durations of two joints may differ, as a part [1]: a joint that is off by less is
/// stretched to the last digit, which changes its velocity by that part.
const SAME_TIME: f64 = 1e-12;

/// Most evaluations in which a bracket is narrowed [1]: every third one halves it, to 2^-66.
const MOST_ROUNDS: usize = 200;

/// Most halvings of a cruise velocity [1]: the way left at it is 1e-15 of the angles at least.
const MOST_HALVINGS: usize = 100;

/// The shortest motions of all joints to rest at a target [rad], which end together.
///
/// `motions` gets the motion of each joint. A joint that starts beyond a limit returns to it as fast
/// as the others allow, and stays inside.
///
/// Returns the duration [s].
///
/// # Errors
///
/// [`Error::InvalidMotion`] for a number that is not finite, a limit that is not positive, or a
/// motion that a double cannot hold; [`irbkin::Error::WrongLength`] for slices of different lengths.
pub fn to_rest(
    start: &[AxisState],
    target: &[f64],
    limits: &[AxisLimits],
    motions: &mut [AxisMotion],
) -> Result<f64, Error> {
    for (field, found) in [("target", target.len()), ("motions", motions.len())] {
        check_length(field, found, start.len())?;
    }
    check(start, limits)?;
    check_finite("target", target)?;
    let joints = || start.iter().zip(target).zip(limits);
    let mut duration = 0.0_f64;
    for (motion, ((start, target), limits)) in motions.iter_mut().zip(joints()) {
        *motion = Joint::new(start, *target, limits).fastest();
        check_overflow(motion)?;
        duration = duration.max(motion.duration());
    }
    for (motion, ((start, target), limits)) in motions.iter_mut().zip(joints()) {
        if motion.duration() < duration * (1.0 - SAME_TIME) {
            *motion = Joint::new(start, *target, limits).slowed(duration);
        }
        if motion.duration() >= duration * (1.0 - SAME_TIME) {
            *motion = motion.stretched(duration);
        }
    }
    Ok(duration)
}

/// The shortest motion of a joint to a standstill, wherever that is (eq. 4).
///
/// It exceeds a limit only if the state forces it to, and reverses only if the acceleration does not
/// leave time to stop before.
///
/// # Errors
///
/// [`Error::InvalidMotion`] for a number that is not finite or a limit that is not positive.
pub fn brake(state: &AxisState, limits: &AxisLimits) -> Result<AxisMotion, Error> {
    check(&[*state], &[*limits])?;
    let motion = AxisMotion::of_phases(&ramp(state, 0.0, limits));
    check_overflow(&motion).map(|()| motion)
}

/// A motion between any two states: to rest where the way to the end begins, which is the shortest
/// motion if the end is at rest, and on to the end. It takes no time if all joints are at the end,
/// to 1e-9 rad and 1e-9 of the limits.
///
/// # Errors
///
/// As [`to_rest`].
pub fn between(
    start: &[AxisState],
    end: &[AxisState],
    limits: &[AxisLimits],
) -> Result<Trajectory, Error> {
    if end.is_empty() {
        return Err(MotionFault::NoJoints { field: "end" }.into());
    }
    check_length("start", start.len(), end.len())?;
    check(start, limits)?;
    check(end, limits)?;
    if start.iter().zip(end).zip(limits).all(|((start, end), limits)| is_at(start, end, limits)) {
        let still = |end: &AxisState| {
            AxisMotion::of_phases(&[Phase { duration: 0.0, start: *end, jerk: 0.0 }])
        };
        return Ok(Trajectory::of_axes(&end.iter().map(still).collect::<Vec<_>>()));
    }
    // The way to the end is the stop from it, passed the other way.
    let stops = end.iter().zip(limits).map(|(end, limits)| brake(&end.reversed(), limits));
    let stops: Vec<AxisMotion> = stops.collect::<Result<_, _>>()?;
    let begins: Vec<f64> = stops.iter().map(|own| own.state(own.duration()).position).collect();
    let mut motions = vec![AxisMotion::still(0.0, 0.0); begins.len()];
    to_rest(start, &begins, limits, &mut motions)?;
    let (motion, stop) = (Trajectory::of_axes(&motions), Trajectory::of_axes(&stops));
    if stop.duration() > 0.0 { motion.then(&stop.reversed()) } else { Ok(motion) }
}

/// Whether a joint is at its end already.
fn is_at(start: &AxisState, end: &AxisState, limits: &AxisLimits) -> bool {
    (start.position - end.position).abs() <= JOINED_POSITION
        && (start.velocity - end.velocity).abs() <= LIMIT_ROUNDING * limits.velocity
        && (start.acceleration - end.acceleration).abs() <= LIMIT_ROUNDING * limits.acceleration
}

/// Refuses a motion that a double cannot hold.
fn check_overflow(motion: &AxisMotion) -> Result<(), Error> {
    let end = motion.state(motion.duration()).position;
    if end.is_finite() { Ok(()) } else { Err(MotionFault::Overflow.into()) }
}

fn check(states: &[AxisState], limits: &[AxisLimits]) -> Result<(), Error> {
    check_axes(limits, states.len())?;
    for (index, (state, limits)) in states.iter().zip(limits).enumerate() {
        for (field, value) in [
            ("position", state.position),
            ("velocity", state.velocity),
            ("acceleration", state.acceleration),
            ("max_velocity", limits.velocity),
            ("max_acceleration", limits.acceleration),
            ("max_jerk", limits.jerk),
        ] {
            if !value.is_finite() {
                return Err(MotionFault::NotFinite { field, index, value }.into());
            }
        }
        // A ramp calculates the square of an acceleration.
        let acceleration = state.acceleration.abs().max(limits.acceleration);
        if !(acceleration * acceleration).is_finite() {
            return Err(MotionFault::Overflow.into());
        }
    }
    Ok(())
}

/// The fastest way to a velocity without acceleration (eq. 2 to 4): jerk up to a peak
/// acceleration, hold it, jerk down to zero.
fn ramp(start: &AxisState, velocity: f64, limits: &AxisLimits) -> [Phase; 3] {
    let AxisLimits { acceleration: most, jerk, .. } = *limits;
    let eased = start.velocity + start.acceleration * start.acceleration.abs() / (2.0 * jerk);
    let sign = if velocity >= eased { 1.0 } else { -1.0 };
    // As if the velocity were to rise.
    let (own, gain) = (sign * start.acceleration, sign * (velocity - start.velocity));
    let peak = (jerk * gain + own * own / 2.0).max(0.0).sqrt().min(most);
    let (first, last) = ((peak - own).abs() / jerk, peak / jerk);
    let held = gain - 0.5 * (first * (own + peak) + last * peak);
    let hold = if peak < most { 0.0 } else { (held / peak).max(0.0) };
    let rise = if peak < own { -sign * jerk } else { sign * jerk };

    let begin = Phase { duration: first, start: *start, jerk: rise };
    let acceleration = sign * peak;
    let middle = AxisState { acceleration, ..begin.end() };
    let middle = Phase { duration: hold, start: middle, jerk: 0.0 };
    // Counted from the end, which is met.
    let AxisState { position, .. } = middle.end();
    let velocity = velocity - acceleration * last / 2.0;
    let start = AxisState { position, velocity, acceleration };
    [begin, middle, Phase { duration: last, start, jerk: -sign * jerk }]
}

/// Where a joint comes to rest that stops from a state on [rad].
fn standstill(state: &AxisState, limits: &AxisLimits) -> f64 {
    ramp(state, 0.0, limits)[2].end().position
}

/// A joint on its way to rest at a target. Positions count from its start [rad]: a short way would
/// lose its digits.
struct Joint<'a> {
    origin: f64,
    start: AxisState,
    target: f64,
    limits: &'a AxisLimits,
}

impl<'a> Joint<'a> {
    fn new(start: &AxisState, target: f64, limits: &'a AxisLimits) -> Self {
        let origin = start.position;
        let start = AxisState { position: 0.0, ..*start };
        Self { origin, start, target: target - origin, limits }
    }

    fn motion<const COUNT: usize>(&self, mut phases: [Phase; COUNT]) -> AxisMotion {
        for phase in &mut phases {
            phase.start.position += self.origin;
        }
        AxisMotion::of_phases(&phases)
    }

    /// The sign of the velocity with which the target is reached, if it is not where the joint
    /// stops anyway (eq. 5).
    fn direction(&self) -> Option<f64> {
        let stop = standstill(&self.start, self.limits);
        let sizes = self.origin.abs() + self.target.abs() + stop.abs();
        let gap = self.target - stop;
        (gap.abs() > SAME_PLACE * sizes).then(|| gap.signum())
    }

    /// The stop from a state, shifted by what rounding makes it miss the target.
    fn stop(&self, from: &AxisState) -> [Phase; 3] {
        let mut phases = ramp(from, 0.0, self.limits);
        let miss = self.target - phases[2].end().position;
        for phase in &mut phases {
            phase.start.position += miss;
        }
        phases
    }

    fn fastest(&self) -> AxisMotion {
        let Some(sign) = self.direction() else { return self.motion(self.stop(&self.start)) };
        self.motion(self.by_way_of(sign * self.limits.velocity))
    }

    /// The motion that takes a duration [s], by the cruise velocity with which it does (eq. 7). If
    /// rounding hides that, the joint arrives early.
    fn slowed(&self, duration: f64) -> AxisMotion {
        let Some(sign) = self.direction() else { return self.fastest() };
        let late = |speed: f64| {
            let phases = self.by_way_of(sign * speed);
            phases.iter().map(|phase| phase.duration).sum::<f64>() - duration
        };
        let (mut slow, mut fast) = (0.5 * self.limits.velocity, self.limits.velocity);
        for _ in 1..MOST_HALVINGS {
            if late(slow) >= 0.0 {
                break;
            }
            (slow, fast) = (0.5 * slow, slow);
        }
        let speed = least_root(|speed| -late(speed), slow, fast);
        self.motion(self.by_way_of(sign * speed))
    }

    /// To rest at the target by a ramp to a velocity, which is left for the stop when that leads to
    /// the target (eq. 6): three phases to the velocity, one at it, three to rest.
    fn by_way_of(&self, velocity: f64) -> [Phase; 7] {
        // How far behind the target the joint comes to rest that stops in a state.
        let beyond =
            |state: &AxisState| (standstill(state, self.limits) - self.target) * velocity.signum();
        let mut ways = ramp(&self.start, velocity, self.limits);
        let mut from = AxisState { velocity, acceleration: 0.0, ..ways[2].end() };
        let mut cruise = -beyond(&from) / velocity.abs();
        if cruise <= 0.0 {
            cruise = 0.0;
            if let Some(left) = ways.iter().position(|phase| beyond(&phase.end()) >= 0.0) {
                let phase = &mut ways[left];
                phase.duration = least_root(|t| beyond(&phase.after(t)), 0.0, phase.duration);
                from = phase.end();
                ways[left + 1..].iter_mut().for_each(|later| later.duration = 0.0);
            }
        }
        let cruise = Phase { duration: cruise, start: from, jerk: 0.0 };
        let ([first, second, third], [fourth, fifth, sixth]) = (ways, self.stop(&cruise.end()));
        [first, second, third, cruise, fourth, fifth, sixth]
    }
}

/// The least place between two at which a function is not negative, to the last digit. The function
/// rises, and is not negative at the second.
fn least_root(function: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let (mut below, mut above) = (function(low), function(high));
    if below >= 0.0 {
        return low;
    }
    for round in 0..MOST_ROUNDS {
        let middle = 0.5 * (low + high);
        let straight = high - above * ((high - low) / (above - below));
        let is_inside = low < straight && straight < high && round % 3 < 2;
        let place = if is_inside { straight } else { middle };
        if !(low < place && place < high) {
            break;
        }
        let value = function(place);
        if value < 0.0 {
            (low, below) = (place, value);
        } else {
            (high, above) = (place, value);
        }
    }
    high
}
