//! Joint limits, and the full turns of an angle inside them.

use core::f64::consts::{PI, TAU};

use crate::error::{Error, ModelFault};
use crate::kinematics::thresholds::{LIMIT_TOLERANCE, MOST_ANGLE};
use crate::lanes::{nearest_whole, whole_above, whole_below};

/// Lower and upper limit of each joint [rad]; infinite where a joint has none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointLimits<const N: usize> {
    lower: [f64; N],
    upper: [f64; N],
    linkage: Option<[f64; 2]>,
}

impl<const N: usize> JointLimits<N> {
    /// No limits at all.
    pub const UNLIMITED: Self =
        Self { lower: [f64::NEG_INFINITY; N], upper: [f64::INFINITY; N], linkage: None };

    /// Limits from (lower, upper) of each joint [rad].
    ///
    /// # Errors
    ///
    /// [`Error::InvalidModel`] when a limit is NaN or a lower limit is above its upper limit.
    pub fn new(limits: [[f64; 2]; N]) -> Result<Self, Error> {
        for (i, [lower, upper]) in limits.into_iter().enumerate() {
            check(["lower limit of joint", "upper limit of joint"], i + 1, [lower, upper])?;
            if lower > upper {
                return Err(ModelFault::EmptyLimit { joint: i + 1, lower, upper }.into());
            }
        }
        Ok(Self {
            lower: limits.map(|limit| limit[0]),
            upper: limits.map(|limit| limit[1]),
            linkage: None,
        })
    }

    /// The same limits with those of the linkage of coupled axes 2 and 3: (lower, upper) of q3 - q2
    /// [rad], at whatever turn.
    pub(crate) fn with_linkage(self, linkage: Option<[f64; 2]>) -> Result<Self, Error> {
        if let Some([lower, upper]) = linkage {
            check(["lower limit of the linkage", "upper limit of the linkage"], 0, [lower, upper])?;
            if lower > upper {
                return Err(ModelFault::EmptyRodLimit { lower, upper }.into());
            }
        }
        Ok(Self { linkage, ..self })
    }

    /// The same limits with the linkage's of others.
    pub(crate) fn with_linkage_of(self, others: &Self) -> Self {
        Self { linkage: others.linkage, ..self }
    }

    /// (lower, upper) of q3 - q2 [rad], for an arm whose linkage has limits that are known.
    #[must_use]
    pub fn linkage(&self) -> Option<[f64; 2]> {
        self.linkage
    }

    /// (lower, upper) of each joint [rad].
    #[must_use]
    pub fn to_array(&self) -> [[f64; 2]; N] {
        core::array::from_fn(|i| [self.lower[i], self.upper[i]])
    }

    /// The least and the greatest angles that count as inside [rad].
    pub(crate) fn bounds(&self) -> [[f64; N]; 2] {
        [
            self.lower.map(|lower| lower - LIMIT_TOLERANCE),
            self.upper.map(|upper| upper + LIMIT_TOLERANCE),
        ]
    }

    /// Those of the coupled twin: the limit of joint 3 is the linkage's.
    pub(crate) fn coupled(self) -> Self {
        self.twin(
            1.0,
            Some([self.lower[2], self.upper[2]])
                .filter(|linkage| linkage.iter().any(|limit| limit.is_finite())),
        )
    }

    /// Those of the serial twin: the limit of joint 3 is the linkage's, where that is known.
    pub(crate) fn uncoupled(self) -> Self {
        let mut twin = self.twin(-1.0, None);
        if let Some([lower, upper]) = self.linkage {
            (twin.lower[2], twin.upper[2]) = (lower, upper);
        }
        twin
    }

    /// With joint 3 wherever `q3 + sign * q2` may be.
    fn twin(mut self, sign: f64, linkage: Option<[f64; 2]>) -> Self {
        let (low, high) = (sign * self.lower[1], sign * self.upper[1]);
        let (lower, upper) = (self.lower[2] + low.min(high), self.upper[2] + low.max(high));
        // What is too large to calculate with is no limit.
        self.lower[2] = if lower < -MOST_ANGLE { f64::NEG_INFINITY } else { lower };
        self.upper[2] = if upper > MOST_ANGLE { f64::INFINITY } else { upper };
        Self { linkage, ..self }
    }

    /// These limits, and a narrower range (lower, upper) of some joints, from 0 [rad]; `None` where
    /// they leave a joint nothing.
    pub(crate) fn narrowed(mut self, ranges: &[(usize, [f64; 2])]) -> Option<Self> {
        for (joint, [lower, upper]) in ranges {
            let (low, high) = (self.lower[*joint].max(*lower), self.upper[*joint].min(*upper));
            if low > high + LIMIT_TOLERANCE {
                return None;
            }
            (self.lower[*joint], self.upper[*joint]) = (low, high.max(low));
        }
        Some(self)
    }

    /// Whether every joint is inside its limits, within [`LIMIT_TOLERANCE`].
    #[must_use]
    pub fn contains(&self, q: &[f64; N]) -> bool {
        q.iter().enumerate().all(|(joint, angle)| angle.is_finite() && self.holds(joint, *angle))
            && self.linkage_excess(q) == 0.0
    }

    /// How far q3 - q2, at its best turn, is outside the limits of the linkage, beyond
    /// [`LIMIT_TOLERANCE`] [rad]; zero inside.
    pub(crate) fn linkage_excess(&self, q: &[f64; N]) -> f64 {
        let excess = self.linkage_overrun(q);
        if excess <= LIMIT_TOLERANCE { 0.0 } else { excess }
    }

    /// How far q3 - q2, at its best turn, is outside the limits of the linkage [rad]; negative
    /// inside.
    pub(crate) fn linkage_overrun(&self, q: &[f64; N]) -> f64 {
        let (Some([lower, upper]), [_, q2, q3, ..]) = (self.linkage, &q[..]) else {
            return f64::NEG_INFINITY;
        };
        overrun(lower, upper, q3 - q2)
    }

    /// Whether an angle of joint `joint` (from 0) is inside its limits, within [`LIMIT_TOLERANCE`].
    /// Lanes compare in the same way.
    fn holds(&self, joint: usize, angle: f64) -> bool {
        angle >= self.lower[joint] - LIMIT_TOLERANCE && angle <= self.upper[joint] + LIMIT_TOLERANCE
    }

    /// How far an angle of joint `joint` (from 0) is outside its limits [rad]; zero inside.
    pub(crate) fn excess(&self, joint: usize, angle: f64) -> f64 {
        (self.lower[joint] - angle).max(angle - self.upper[joint]).max(0.0)
    }

    /// How far an angle of joint `joint` (from 0), at its best turn, is outside its limits [rad];
    /// negative inside.
    pub(crate) fn overrun(&self, joint: usize, angle: f64) -> f64 {
        overrun(self.lower[joint], self.upper[joint], angle)
    }

    /// [`Self::overrun`] of the joint that is outside the most.
    pub(crate) fn worst_overrun(&self, q: &[f64; N]) -> f64 {
        let linkage = self.linkage_overrun(q);
        q.iter()
            .enumerate()
            .map(|(joint, angle)| self.overrun(joint, *angle))
            .fold(linkage, f64::max)
    }

    /// The turn of each angle that stands for it in a solution (eq. 20): the angle in (-pi, pi],
    /// or, where that is outside the limits and a full turn of it is not, the first such turn.
    pub(crate) fn wrap(&self, q: [f64; N]) -> [f64; N] {
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

    /// Zero where the limits hold it, and the middle of them where they do not [rad]: what a free
    /// joint takes by itself.
    pub(crate) fn rest(&self) -> [f64; N] {
        core::array::from_fn(|joint| {
            let middle = 0.5 * (self.lower[joint] + self.upper[joint]);
            if self.excess(joint, 0.0) > 0.0 && middle.is_finite() { middle } else { 0.0 }
        })
    }

    /// Every angle at its turn inside the limits that is nearest to `seed`; `None` where one has no
    /// such turn, or the linkage is outside its limits, which no turn changes.
    pub(crate) fn turned_to(&self, q: &[f64; N], seed: &[f64; N]) -> Option<[f64; N]> {
        if self.linkage_excess(q) > 0.0 {
            return None;
        }
        let mut turned = *q;
        for (joint, angle) in turned.iter_mut().enumerate() {
            *angle = self.turn_nearest(joint, *angle, seed[joint])?;
        }
        Some(turned)
    }

    /// [`Self::turned_to`], of which a joint that is outside by `slack` [rad] at most is put on the
    /// limit; the linkage is not looked at.
    pub(crate) fn clamped_to(&self, q: &[f64; N], seed: &[f64; N], slack: f64) -> Option<[f64; N]> {
        let mut clamped = *q;
        for (joint, angle) in clamped.iter_mut().enumerate() {
            let limits = [self.lower[joint], self.upper[joint]];
            let nearest = |limit: &f64| {
                (*limit - *angle - TAU * nearest_whole((limit - *angle) / TAU)).abs() <= slack
            };
            *angle = self
                .turn_nearest(joint, *angle, seed[joint])
                .or_else(|| limits.into_iter().find(nearest))?;
        }
        Some(clamped)
    }

    /// First and last number of turns that, added to `angle`, keep it inside the limits; `None`
    /// where no number does.
    pub(crate) fn turns(&self, joint: usize, angle: f64) -> Option<(f64, f64)> {
        let first = whole_above((self.lower[joint] - LIMIT_TOLERANCE - angle) / TAU);
        let last = whole_below((self.upper[joint] + LIMIT_TOLERANCE - angle) / TAU);
        (first <= last).then_some((first, last))
    }

    /// [`Self::turns`], of which a joint without limits has only the angle itself.
    pub(crate) fn countable_turns(&self, joint: usize, angle: f64) -> Option<(f64, f64)> {
        self.turns(joint, angle).map(|(first, last)| {
            if first.is_finite() && last.is_finite() { (first, last) } else { (0.0, 0.0) }
        })
    }
}

/// Limits that are numbers, or none: minus infinity below, infinity above.
fn check(fields: [&'static str; 2], index: usize, limits: [f64; 2]) -> Result<(), Error> {
    for ((field, value), none) in
        fields.into_iter().zip(limits).zip([f64::NEG_INFINITY, f64::INFINITY])
    {
        if value.total_cmp(&none).is_ne() {
            ModelFault::check(field, index, value, MOST_ANGLE)?;
        }
    }
    Ok(())
}

/// How far an angle, at its best turn, is outside limits [rad]; negative inside.
fn overrun(lower: f64, upper: f64, angle: f64) -> f64 {
    let middle = 0.5 * (lower + upper);
    // A turn is always inside where one side has no limit.
    if !middle.is_finite() {
        return f64::NEG_INFINITY;
    }
    let angle = angle + TAU * nearest_whole((middle - angle) / TAU);
    (lower - angle).max(angle - upper)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn limits() -> JointLimits<2> {
        JointLimits::new([[-400.0_f64.to_radians(), 400.0_f64.to_radians()], [-4.3, 1.1]]).unwrap()
    }

    #[test]
    fn wrapped_angles_are_inside_where_a_turn_is() {
        let settled = limits().wrap([1.0, 2.5]);
        assert_eq!(settled[0], 1.0);
        assert!((settled[1] - (2.5 - TAU)).abs() < 1e-15);
        assert_eq!(limits().wrap([1.0, 1.5])[1], 1.5);
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
        assert!(limits().contains(&[0.0, 1.1 + 1e-10]));
        assert!(!limits().contains(&[0.0, 1.1 + 1e-8]));
    }
}
