//! The state of a joint, and a phase of constant jerk: every jerk-limited motion is a sequence of
//! them.

use super::polynomial::TERMS;
use crate::trajectory::thresholds::JOINED_POSITION;

/// Position, velocity and acceleration of a joint, or of a place along a path.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct AxisState {
    /// Position [rad].
    pub position: f64,
    /// Velocity [rad/s].
    pub velocity: f64,
    /// Acceleration [rad/s^2].
    pub acceleration: f64,
}

impl AxisState {
    /// At rest at a position.
    #[must_use]
    pub const fn at_rest(position: f64) -> Self {
        Self { position, velocity: 0.0, acceleration: 0.0 }
    }

    /// The state of the motion that is passed the other way.
    pub(super) fn reversed(self) -> Self {
        Self { velocity: -self.velocity, ..self }
    }

    /// Whether a velocity or an acceleration is zero: at most 1e-9 rad/s or rad/s^2, the rounding
    /// of a motion that ends at rest.
    #[doc(hidden)]
    pub fn is_rest(rate: f64) -> bool {
        rate.abs() <= JOINED_POSITION
    }
}

/// A phase of constant jerk, of a joint or along a path.
#[derive(Clone, Copy, Debug)]
pub(super) struct Phase {
    /// Its duration [s].
    pub(super) duration: f64,
    /// The state in which it begins.
    pub(super) start: AxisState,
    /// Its jerk [rad/s^3].
    pub(super) jerk: f64,
}

impl Phase {
    /// The state after a time [s] (docs/theory/jerk.md, eq. 1).
    pub(super) fn after(&self, t: f64) -> AxisState {
        let AxisState { position, velocity, acceleration } = self.start;
        let jerk = self.jerk;
        AxisState {
            position: position + t * (velocity + t * (acceleration / 2.0 + t * (jerk / 6.0))),
            velocity: velocity + t * (acceleration + t * jerk / 2.0),
            acceleration: acceleration + t * jerk,
        }
    }

    pub(super) fn end(&self) -> AxisState {
        self.after(self.duration)
    }

    /// The coefficients of the position in the time since the phase began.
    pub(super) fn terms(&self) -> [f64; TERMS] {
        let AxisState { position, velocity, acceleration } = self.start;
        [position, velocity, acceleration / 2.0, self.jerk / 6.0, 0.0, 0.0, 0.0]
    }
}
