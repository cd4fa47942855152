//! Bounds of a guard, and its answers.

use super::reason::Reason;
use crate::error::{Error, MotionFault};
use crate::trajectory::check::{check_finite, check_limits, check_positive};
use irbkin::Robot;
use irbkin::internal::ModelFault;

/// The longest cycle [s]: one of 4 or 8 is in milliseconds.
const LONGEST_CYCLE: f64 = 0.5;

/// The longest time for which a guard goes on without a reference [s].
const LONGEST_HOLD: f64 = 10.0;

/// The response of a guard to a reference that does not fit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum OnViolation {
    /// It brakes; but goes towards references that stay near, as those with noise do.
    #[default]
    Brake,
    /// It goes towards the reference as far and as fast as the bounds allow.
    Limit,
}

/// Bounds of a [`Guard`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GuardOptions<const N: usize> {
    /// Time from one set point to the next [s].
    pub cycle: f64,
    /// Limits of the velocities [rad/s]; the robot's if `None`.
    pub max_velocity: Option<[f64; N]>,
    /// Limits of the accelerations [rad/s^2].
    pub max_acceleration: [f64; N],
    /// Limits of the jerks [rad/s^3]; none if `None`.
    pub max_jerk: Option<[f64; N]>,
    /// How far the arm stays from obstacles, beyond the margin of the cell [m].
    pub margin: f64,
    /// Limit of the speed of the tool center point [m/s].
    pub max_tool_speed: Option<f64>,
    /// The response to a reference that does not fit.
    pub on_violation: OnViolation,
    /// For how long the guard goes on towards the last reference if none comes, before it brakes
    /// [s].
    pub hold: f64,
}

impl<const N: usize> GuardOptions<N> {
    /// Bounds of the accelerations [rad/s^2] alone, for a cycle [s].
    #[must_use]
    pub fn new(cycle: f64, max_acceleration: [f64; N]) -> Self {
        Self {
            cycle,
            max_velocity: None,
            max_acceleration,
            max_jerk: None,
            margin: 0.0,
            max_tool_speed: None,
            on_violation: OnViolation::Brake,
            hold: 0.0,
        }
    }

    /// Check them, and return the limits of velocity, acceleration and jerk of an arm.
    pub(super) fn checked(&self, robot: &Robot<N>) -> Result<[[f64; N]; 3], Error> {
        check_positive("cycle", self.cycle)?;
        if self.cycle > LONGEST_CYCLE {
            return Err(MotionFault::Cycle { value: self.cycle, bound: LONGEST_CYCLE }.into());
        }
        if !(0.0..=LONGEST_HOLD).contains(&self.hold) {
            return Err(MotionFault::Hold { value: self.hold, bound: LONGEST_HOLD }.into());
        }
        let velocity = self.max_velocity.or_else(|| robot.max_velocity().copied());
        let velocity = velocity.ok_or(ModelFault::NoVelocity)?;
        let limits = [velocity, self.max_acceleration, self.max_jerk.unwrap_or([f64::INFINITY; N])];
        let fields = ["max_velocity", "max_acceleration", "max_jerk"];
        for (field, limits) in fields.into_iter().zip(&limits) {
            check_limits(field, limits)?;
            // Without a jerk limit the accelerations still bound it.
            if field != "max_jerk" {
                check_finite(field, limits)?;
            }
        }
        if let Some(speed) = self.max_tool_speed {
            check_positive("max_tool_speed", speed)?;
        }
        Ok(limits)
    }
}

/// The state of a guard.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// It goes to the reference, or towards it.
    Following,
    /// It brakes.
    Braking,
    /// It is at rest, without a reference that fits.
    Holding,
}

impl State {
    /// "following", "braking" or "holding".
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Following => "following",
            Self::Braking => "braking",
            Self::Holding => "holding",
        }
    }
}

/// A set point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step<const N: usize> {
    /// Joint angles [rad].
    pub q: [f64; N],
    /// Velocities [rad/s].
    pub dq: [f64; N],
    /// Accelerations [rad/s^2].
    pub ddq: [f64; N],
    /// Whether the reference is followed as it is.
    pub accepted: bool,
    /// The state after the step.
    pub state: State,
    /// Why the reference is not followed as it is.
    pub reason: Option<Reason>,
}
