//! Bounds of velocity, acceleration and jerk as bounds of the differences of control points
//! (docs/theory/stream.md, eq. 2, 3, 6).

use super::brake::{Bounds, End, peak, ramp_to_zero};
use super::reason::Bound;
use crate::trajectory::thresholds::LIMIT_ROUNDING;

/// By how much a difference may exceed its bound, as a part of it [1]: a checked trajectory may
/// exceed its own by [`LIMIT_ROUNDING`], its second difference may have changed what is left of the
/// first.
const ROUNDING: f64 = 2.0 * LIMIT_ROUNDING;

/// Rounding of a third difference, as a part of the control points and a radian [1]: of eight of
/// them, each given to a few digits of the last place.
const DIGITS: f64 = 32.0 * f64::EPSILON;

/// Rounding of a third difference of control points near one [rad].
pub(super) fn digits_of(point: f64) -> f64 {
    DIGITS * (1.0 + point.abs())
}

/// Whether a difference is beyond its bound (eq. 3).
pub(super) fn exceeds(value: f64, limit: f64, digits: f64) -> bool {
    value.is_nan() || value.abs() > limit * (1.0 + ROUNDING) + digits
}

/// A bound that a reference exceeds, the value and the bound [rad, s].
pub(super) type Exceeded = (Bound, f64, f64);

impl Bounds {
    /// The control point behind `end`, or what of it exceeds a bound (eq. 3, 6).
    pub(super) fn check(&self, end: End, next: f64, cycle: f64) -> Result<End, Exceeded> {
        let first = next - end.point;
        let behind = End { point: next, first, second: first - end.first };
        let digits = digits_of(next.abs().max(end.point.abs()));
        let left = peak(behind, self.third);
        let square = cycle * cycle;
        for (bound, value, limit, unit) in [
            (Bound::Velocity, first, self.first, cycle),
            (Bound::Acceleration, behind.second, self.second, square),
            (Bound::Jerk, behind.second - end.second, self.third, square * cycle),
            (Bound::VelocityAhead, left, self.first * (1.0 + ROUNDING), cycle),
        ] {
            if exceeds(value, limit, digits) {
                return Err((bound, value / unit, limit / unit));
            }
        }
        Ok(behind)
    }

    /// The least and the greatest second difference of the next control point; the braking motion's
    /// is between them.
    pub(super) fn seconds(&self, end: End) -> [f64; 2] {
        let ahead = |room: f64| -ramp_to_zero(room.max(0.0), self.third);
        let low = (-self.second).max(end.second - self.third).max(-ahead(self.first + end.first));
        let high = self.second.min(end.second + self.third).min(ahead(self.first - end.first));
        [low, high]
    }
}
