//! The motion of one joint from one state to another: at most seven polynomials in time.

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use super::phase::{AxisState, Phase};
use super::polynomial::{TERMS, derivatives};
use crate::spline::{hermite, quintic_between};

/// Most pieces of one motion: three phases to a velocity, one at it, three to rest.
const MOST_PIECES: usize = 7;

/// Limits of one joint; infinity for none.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct AxisLimits {
    /// Velocity [rad/s].
    pub velocity: f64,
    /// Acceleration [rad/s^2].
    pub acceleration: f64,
    /// Jerk [rad/s^3].
    pub jerk: f64,
}

/// How a joint gets from one position to another.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Profile {
    /// A polynomial of degree five: velocities and accelerations at both ends are given.
    Quintic,
    /// A polynomial of degree three: velocities at both ends are given.
    Cubic,
    /// Constant acceleration, constant velocity, constant deceleration; at rest at both ends.
    Trapezoid,
    /// A trapezoid with jerk that is constant by phases: acceleration has no jumps.
    SCurve,
}

/// The motion of one joint over a duration, on the stack: an array of them is the trajectory of an
/// arm without a heap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisMotion {
    count: usize,
    /// Where each piece begins [s], and behind the last one the end.
    starts: [f64; MOST_PIECES + 1],
    terms: [[f64; TERMS]; MOST_PIECES],
}

/// Durations of the phases of a motion from rest to rest [s] (eq. 5).
#[derive(Clone, Copy)]
struct Phases {
    /// Each of the four with constant jerk.
    jerk: f64,
    /// Each of the two with constant acceleration.
    acceleration: f64,
    /// The one with constant velocity.
    cruise: f64,
}

impl AxisMotion {
    /// No motion, for a duration [s].
    #[must_use]
    pub fn still(position: f64, duration: f64) -> Self {
        Self::single([position, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0], duration)
    }

    fn single(terms: [f64; TERMS], duration: f64) -> Self {
        let mut motion =
            Self { count: 1, starts: [0.0; MOST_PIECES + 1], terms: [[0.0; TERMS]; MOST_PIECES] };
        motion.starts[1] = duration;
        motion.terms[0] = terms;
        motion
    }

    /// The polynomial of degree five between two states (eq. 1, 2).
    ///
    /// `duration` is positive [s].
    #[must_use]
    pub fn quintic(start: AxisState, end: AxisState, duration: f64) -> Self {
        let ends = [start, end].map(|state| [state.position, state.velocity, state.acceleration]);
        let [c0, c1, c2, c3, c4, c5] = quintic_between(ends[0], ends[1], duration);
        Self::single([c0, c1, c2, c3, c4, c5, 0.0], duration)
    }

    /// The polynomial of degree three between two positions with velocities (eq. 3).
    ///
    /// `duration` is positive [s]; the accelerations of the states are not looked at.
    #[must_use]
    pub fn cubic(start: AxisState, end: AxisState, duration: f64) -> Self {
        let positions = [start.position, end.position];
        let [c0, c1, c2, c3] = hermite(positions, [start.velocity, end.velocity], duration);
        Self::single([c0, c1, c2, c3, 0.0, 0.0, 0.0], duration)
    }

    /// From rest to rest over a duration, by constant acceleration for a third of it, constant
    /// velocity and constant deceleration.
    #[must_use]
    pub fn trapezoid(start: f64, end: f64, duration: f64) -> Self {
        let third = duration / 3.0;
        Self::rest_to_rest(start, end, Phases { jerk: 0.0, acceleration: third, cruise: third })
    }

    /// From rest to rest over a duration by constant jerk: a third of it to full velocity, half of
    /// that with rising and half with falling acceleration.
    #[must_use]
    pub fn s_curve(start: f64, end: f64, duration: f64) -> Self {
        let sixth = duration / 6.0;
        Self::rest_to_rest(
            start,
            end,
            Phases { jerk: sixth, acceleration: 0.0, cruise: 2.0 * sixth },
        )
    }

    /// The shortest motion of a profile from rest to rest within limits, in closed form (eq. 4 to
    /// 8); without any limit that binds it, of no duration.
    ///
    /// Limits are positive. A trapezoid has no limit of jerk, nor has a cubic.
    #[must_use]
    pub fn within(profile: Profile, start: f64, end: f64, limits: &AxisLimits) -> Self {
        let way = (end - start).abs();
        if way == 0.0 {
            return Self::still(start, 0.0);
        }
        let AxisLimits { velocity, acceleration, jerk } = *limits;
        match profile {
            Profile::Quintic => {
                // Peaks of the quintic from rest to rest: 15/8, 10/sqrt(3) and 60 (eq. 4).
                let duration = (1.875 * way / velocity)
                    .max((10.0 / 3.0_f64.sqrt() * way / acceleration).sqrt())
                    .max((60.0 * way / jerk).cbrt());
                Self::quintic(AxisState::at_rest(start), AxisState::at_rest(end), duration)
            }
            Profile::Cubic => {
                let duration = (1.5 * way / velocity).max((6.0 * way / acceleration).sqrt());
                Self::cubic(AxisState::at_rest(start), AxisState::at_rest(end), duration)
            }
            Profile::Trapezoid => {
                Self::rest_to_rest(start, end, shortest(way, velocity, acceleration, f64::INFINITY))
            }
            Profile::SCurve => {
                Self::rest_to_rest(start, end, shortest(way, velocity, acceleration, jerk))
            }
        }
    }

    /// The phases with these durations, scaled to the way (eq. 5, 6): whatever rounding does to
    /// the durations, both ends are met.
    fn rest_to_rest(start: f64, end: f64, phases: Phases) -> Self {
        let Phases { jerk: tj, acceleration: tc, cruise: tv } = phases;
        let way = end - start;
        let rise = 2.0 * tj + tc;
        if rise + tv == 0.0 {
            return Self::still(end, 0.0);
        }
        let v = way / (rise + tv);
        let a = v / (tj + tc);
        let j = if tj > 0.0 { a / tj } else { 0.0 };
        // Way and velocity after the first phase and after the second, from the start.
        let (s1, v1) = (j * tj * tj * tj / 6.0, 0.5 * a * tj);
        let (s2, v2) = (s1 + tc * (v1 + 0.5 * a * tc), v1 + a * tc);
        let (s3, s4) = (0.5 * v * rise, way - 0.5 * v * rise);
        let phase = |duration, way, velocity, acceleration, jerk| Phase {
            duration,
            start: AxisState { position: start + way, velocity, acceleration },
            jerk,
        };
        Self::of_phases(&[
            phase(tj, 0.0, 0.0, 0.0, j),
            phase(tc, s1, v1, a, 0.0),
            phase(tj, s2, v2, a, -j),
            phase(tv, s3, v, 0.0, 0.0),
            phase(tj, s4, v, 0.0, -j),
            phase(tc, way - s2, v2, -a, 0.0),
            phase(tj, way - s1, v1, -a, j),
        ])
    }

    /// The motion of phases, [`MOST_PIECES`] at most; without any length, the last one.
    pub(super) fn of_phases<const COUNT: usize>(phases: &[Phase; COUNT]) -> Self {
        let mut motion = Self::single(phases[COUNT - 1].terms(), 0.0);
        motion.count = 0;
        for phase in phases.iter().filter(|phase| phase.duration > 0.0) {
            let piece = motion.count;
            motion.terms[piece] = phase.terms();
            motion.starts[piece + 1] = motion.starts[piece] + phase.duration;
            motion.count += 1;
        }
        motion.count = motion.count.max(1);
        motion
    }

    /// Duration [s].
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.starts[self.count]
    }

    /// Stretch the motion to another duration, as long or longer: limits that it keeps are kept.
    #[must_use]
    pub fn stretched(mut self, duration: f64) -> Self {
        let own = self.duration();
        if own == 0.0 {
            return Self::still(self.terms[0][0], duration);
        }
        let factor = own / duration;
        for terms in &mut self.terms[..self.count] {
            let mut power = 1.0;
            for term in terms {
                *term *= power;
                power *= factor;
            }
        }
        for start in &mut self.starts[..self.count] {
            *start /= factor;
        }
        self.starts[self.count] = duration;
        self
    }

    /// A motion from 0 to 1 as one between two positions.
    pub(super) fn between(mut self, start: f64, end: f64) -> Self {
        for terms in &mut self.terms[..self.count] {
            for term in &mut *terms {
                *term *= end - start;
            }
            terms[0] += start;
        }
        self
    }

    /// The state at a time [s]; before the start and after the end, that at rest there.
    #[must_use]
    pub fn state(&self, time: f64) -> AxisState {
        let time = time.clamp(0.0, self.duration());
        let piece = (1..self.count).take_while(|piece| self.starts[*piece] <= time).count();
        let [position, velocity, acceleration, _] =
            derivatives(&self.terms[piece], time - self.starts[piece]);
        AxisState { position, velocity, acceleration }
    }

    /// Where the pieces begin [s], and the end.
    pub(super) fn knots(&self) -> &[f64] {
        &self.starts[..=self.count]
    }

    pub(super) fn terms(&self, piece: usize) -> &[f64; TERMS] {
        &self.terms[piece]
    }
}

/// The shortest phases over a way, from rest to rest, within limits (eq. 7, 8).
fn shortest(way: f64, velocity: f64, acceleration: f64, jerk: f64) -> Phases {
    // To full velocity: acceleration rises to its limit, or to where it must fall again.
    let tj = (acceleration / jerk).min((velocity / jerk).sqrt());
    let tj = if jerk.is_infinite() { 0.0 } else { tj };
    let tc = (velocity / acceleration - tj).max(0.0);
    let rise = 2.0 * tj + tc;
    if velocity * rise <= way {
        return Phases { jerk: tj, acceleration: tc, cruise: way / velocity - rise };
    }
    // The way is too short for full velocity, and for full acceleration too where it is shorter
    // than 2 a^3 / j^2.
    let tj = acceleration / jerk;
    if jerk.is_finite() && 2.0 * acceleration * tj * tj >= way {
        return Phases { jerk: (0.5 * way / jerk).cbrt(), acceleration: 0.0, cruise: 0.0 };
    }
    let tj = if jerk.is_infinite() { 0.0 } else { tj };
    // v of way = v (v / a + tj), by the form without cancellation.
    let v = 2.0 * way / (tj + (tj * tj + 4.0 * way / acceleration).sqrt());
    Phases { jerk: tj, acceleration: (v / acceleration - tj).max(0.0), cruise: 0.0 }
}
