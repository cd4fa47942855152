//! Joint limits, and the full turns of an angle inside them.

use core::f64::consts::{PI, TAU};

use super::thresholds::{LIMIT_TOLERANCE, MOST_ANGLE};
use crate::error::{Error, ModelFault};
use crate::lanes::{nearest_whole, whole_above, whole_below};

/// Lower and upper limit of each joint [rad]; infinite where a joint has none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointLimits<const N: usize> {
    lower: [f64; N],
    upper: [f64; N],
}

impl<const N: usize> JointLimits<N> {
    /// No limits at all.
    pub const UNLIMITED: Self = Self { lower: [f64::NEG_INFINITY; N], upper: [f64::INFINITY; N] };

    /// Limits from (lower, upper) of each joint [rad].
    ///
    /// # Errors
    ///
    /// [`Error::InvalidModel`] when a limit is NaN or a lower limit is above its upper limit.
    pub fn new(limits: [[f64; 2]; N]) -> Result<Self, Error> {
        for (i, [lower, upper]) in limits.into_iter().enumerate() {
            // No limit is minus infinity below and infinity above.
            for (field, value, none) in [("lower limit of joint", lower, f64::NEG_INFINITY), ("upper limit of joint", upper, f64::INFINITY)]
            {
                if value.total_cmp(&none).is_ne() {
                    ModelFault::check(field, i + 1, value, MOST_ANGLE)?;
                }
            }
            if lower > upper {
                return Err(ModelFault::EmptyLimit { joint: i + 1, lower, upper }.into());
            }
        }
        Ok(Self { lower: limits.map(|limit| limit[0]), upper: limits.map(|limit| limit[1]) })
    }

    /// (lower, upper) of each joint [rad].
    #[must_use]
    pub fn to_array(&self) -> [[f64; 2]; N] {
        core::array::from_fn(|i| [self.lower[i], self.upper[i]])
    }

    /// Whether every joint is inside its limits, within [`LIMIT_TOLERANCE`].
    #[must_use]
    pub fn contain(&self, q: &[f64; N]) -> bool {
        q.iter().enumerate().all(|(joint, angle)| angle.is_finite() && self.holds(joint, *angle))
    }

    /// Whether an angle of joint `joint` (from 0) is inside its limits, within [`LIMIT_TOLERANCE`]. Lanes compare in the same way.
    fn holds(&self, joint: usize, angle: f64) -> bool {
        angle >= self.lower[joint] - LIMIT_TOLERANCE && angle <= self.upper[joint] + LIMIT_TOLERANCE
    }

    /// How far an angle of joint `joint` (from 0) is outside its limits [rad]; zero inside.
    pub(crate) fn excess(&self, joint: usize, angle: f64) -> f64 {
        (self.lower[joint] - angle).max(angle - self.upper[joint]).max(0.0)
    }

    /// How far an angle of joint `joint` (from 0), at its best turn, is outside its limits [rad]; negative inside.
    pub(crate) fn overrun(&self, joint: usize, angle: f64) -> f64 {
        let middle = 0.5 * (self.lower[joint] + self.upper[joint]);
        // A turn is always inside where one side has no limit.
        if !middle.is_finite() {
            return f64::NEG_INFINITY;
        }
        let angle = angle + TAU * nearest_whole((middle - angle) / TAU);
        (self.lower[joint] - angle).max(angle - self.upper[joint])
    }

    /// [`Self::overrun`] of the joint that is outside the most.
    pub(crate) fn worst_overrun(&self, q: &[f64; N]) -> f64 {
        q.iter().enumerate().map(|(joint, angle)| self.overrun(joint, *angle)).fold(f64::NEG_INFINITY, f64::max)
    }

    /// The turn of each angle that stands for it in a solution (eq. 20): the angle in (-pi, pi], or, where that is outside the limits
    /// and a full turn of it is not, the first such turn.
    pub(crate) fn settle(&self, q: [f64; N]) -> [f64; N] {
        core::array::from_fn(|joint| {
            if self.holds(joint, q[joint]) {
                return q[joint];
            }
            self.turn_nearest(joint, q[joint], q[joint]).unwrap_or(q[joint])
        })
    }

    /// The turn of `angle` inside the limits that is nearest to `seed`.
    pub(crate) fn turn_nearest(&self, joint: usize, angle: f64, seed: f64) -> Option<f64> {
        // Without a division where most angles are.
        if (seed - angle).abs() < PI && self.holds(joint, angle) {
            return Some(angle);
        }
        let (first, last) = self.turns(joint, angle)?;
        let turn = nearest_whole((seed - angle) / TAU).clamp(first, last);
        Some(if turn == 0.0 { angle } else { angle + TAU * turn })
    }

    /// Zero where the limits hold it, and the middle of them where they do not [rad]: what a free joint takes by itself.
    pub(crate) fn rest(&self) -> [f64; N] {
        core::array::from_fn(|joint| {
            let middle = 0.5 * (self.lower[joint] + self.upper[joint]);
            if self.excess(joint, 0.0) > 0.0 && middle.is_finite() { middle } else { 0.0 }
        })
    }

    /// Every angle at its turn inside the limits that is nearest to `seed`; `None` where one has no such turn.
    pub(crate) fn turned_to(&self, q: &[f64; N], seed: &[f64; N]) -> Option<[f64; N]> {
        let mut turned = *q;
        for (joint, angle) in turned.iter_mut().enumerate() {
            *angle = self.turn_nearest(joint, *angle, seed[joint])?;
        }
        Some(turned)
    }

    /// First and last number of turns that, added to `angle`, keep it inside the limits; `None` where no number does.
    pub(crate) fn turns(&self, joint: usize, angle: f64) -> Option<(f64, f64)> {
        let first = whole_above((self.lower[joint] - LIMIT_TOLERANCE - angle) / TAU);
        let last = whole_below((self.upper[joint] + LIMIT_TOLERANCE - angle) / TAU);
        (first <= last).then_some((first, last))
    }

    /// [`Self::turns`], of which a joint without limits has only the angle itself.
    pub(crate) fn countable_turns(&self, joint: usize, angle: f64) -> Option<(f64, f64)> {
        self.turns(joint, angle).map(|(first, last)| if first.is_finite() && last.is_finite() { (first, last) } else { (0.0, 0.0) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn limits() -> JointLimits<2> {
        JointLimits::new([[-400.0_f64.to_radians(), 400.0_f64.to_radians()], [-4.3, 1.1]]).unwrap()
    }

    #[test]
    fn settled_angles_are_inside_where_a_turn_is() {
        let settled = limits().settle([1.0, 2.5]);
        assert_eq!(settled[0], 1.0);
        assert!((settled[1] - (2.5 - TAU)).abs() < 1e-15);
        assert_eq!(limits().settle([1.0, 1.5])[1], 1.5);
    }

    #[test]
    fn the_nearest_turn_follows_the_seed_up_to_the_limit() {
        assert_eq!(limits().turn_nearest(0, 0.5, 6.5), Some(0.5 + TAU));
        assert_eq!(limits().turn_nearest(0, 0.5, 60.0), Some(0.5 + TAU));
        assert_eq!(limits().turn_nearest(0, 1.0, -60.0), Some(1.0 - TAU));
        assert_eq!(limits().turn_nearest(1, 1.5, 0.0), None);
    }

    #[test]
    fn an_angle_at_the_limit_is_inside() {
        assert!(limits().contain(&[0.0, 1.1 + 1e-10]));
        assert!(!limits().contain(&[0.0, 1.1 + 1e-8]));
    }
}
