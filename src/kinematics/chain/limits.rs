//! Joint limits, and the 2 pi equivalents of an angle inside them.

use core::f64::consts::{PI, TAU};

use crate::error::{Error, ModelFault};
use crate::kinematics::pose::angles::nearest_turn;
use crate::kinematics::thresholds::{DEGREE_LIMITS, LIMIT_TOLERANCE, MOST_ANGLE, START_TOLERANCE};
use crate::lanes::{nearest_whole, whole_above, whole_below};

/// Lower and upper limit of each joint [rad]; infinite where a joint has none.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "StoredLimits<N>", into = "StoredLimits<N>"))]
pub struct JointLimits<const N: usize> {
    pub(super) lower: [f64; N],
    pub(super) upper: [f64; N],
    pub(super) linkage: Option<[f64; 2]>,
    /// Factor of q2 in the controller's q3; zero without limits of the linkage.
    pub(super) coupling: f64,
}

impl<const N: usize> JointLimits<N> {
    /// No limits at all.
    pub const UNLIMITED: Self = Self {
        lower: [f64::NEG_INFINITY; N],
        upper: [f64::INFINITY; N],
        linkage: None,
        coupling: 0.0,
    };

    /// Limits from (lower, upper) of each joint [rad].
    ///
    /// # Errors
    ///
    /// [`Error::InvalidModel`] when a limit is NaN, a lower limit is above its upper limit, or the
    /// limits of most joints are beyond eight turns, as limits in degrees are.
    pub fn new(limits: [[f64; 2]; N]) -> Result<Self, Error> {
        let limits = Self::stored(limits)?;
        limits.check_radians()?;
        Ok(limits)
    }

    /// Limits that a robot had: of a coupled twin, most of them may be wide.
    pub(crate) fn stored(limits: [[f64; 2]; N]) -> Result<Self, Error> {
        for (i, [lower, upper]) in limits.into_iter().enumerate() {
            check(["lower limit of joint", "upper limit of joint"], i + 1, [lower, upper])?;
            if lower > upper {
                return Err(ModelFault::EmptyLimit { joint: i + 1, lower, upper }.into());
            }
        }
        Ok(Self {
            lower: limits.map(|limit| limit[0]),
            upper: limits.map(|limit| limit[1]),
            ..Self::UNLIMITED
        })
    }

    /// Checks that not most of the joints have limits as those in degrees are.
    fn check_radians(&self) -> Result<(), Error> {
        let in_degrees = |joint: &usize| {
            let (lower, upper) = (self.lower[*joint], self.upper[*joint]);
            let size = [lower, upper].into_iter().filter(|limit| limit.is_finite());
            DEGREE_LIMITS.contains(&size.fold(0.0, |most: f64, limit| most.max(limit.abs())))
        };
        if 2 * (0..N).filter(in_degrees).count() <= N {
            return Ok(());
        }
        let joint = (0..N).find(in_degrees).unwrap_or_default();
        let (lower, upper) = (self.lower[joint], self.upper[joint]);
        let bound = *DEGREE_LIMITS.start();
        Err(ModelFault::LimitsInDegrees { joint: joint + 1, lower, upper, bound }.into())
    }

    /// (lower, upper) of each joint [rad].
    #[must_use]
    pub fn to_array(&self) -> [[f64; 2]; N] {
        core::array::from_fn(|i| [self.lower[i], self.upper[i]])
    }

    /// The limits of the six others of seven joints, without joint `out`, from 0.
    pub(crate) fn without(&self, out: usize) -> JointLimits<6> {
        let six = |all: &[f64; N]| core::array::from_fn(|i| all[i + usize::from(i >= out)]);
        JointLimits { lower: six(&self.lower), upper: six(&self.upper), ..JointLimits::UNLIMITED }
    }

    /// The least and the greatest angles that count as inside [rad].
    pub(crate) fn bounds(&self) -> [[f64; N]; 2] {
        [
            self.lower.map(|lower| lower - LIMIT_TOLERANCE),
            self.upper.map(|upper| upper + LIMIT_TOLERANCE),
        ]
    }

    /// These limits, narrowed to (lower, upper) for some joints, from 0 [rad]; `None` if that
    /// leaves a joint without a range.
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

    /// These limits, each wider by `beyond` [rad].
    #[doc(hidden)]
    pub fn widened(mut self, beyond: f64) -> Self {
        self.lower = self.lower.map(|lower| lower - beyond);
        self.upper = self.upper.map(|upper| upper + beyond);
        self
    }

    /// Whether every joint is inside its limits, within [`LIMIT_TOLERANCE`].
    #[must_use]
    pub fn contains(&self, q: &[f64; N]) -> bool {
        q.iter().enumerate().all(|(joint, angle)| angle.is_finite() && self.holds(joint, *angle))
            && self.linkage_excess(q) == 0.0
    }

    /// Whether an angle of joint `joint` (from 0) is inside its limits, within [`LIMIT_TOLERANCE`].
    /// The lanes use the same comparison.
    fn holds(&self, joint: usize, angle: f64) -> bool {
        angle >= self.lower[joint] - LIMIT_TOLERANCE && angle <= self.upper[joint] + LIMIT_TOLERANCE
    }

    /// How far an angle of joint `joint` (from 0) is outside its limits [rad]; zero inside.
    #[doc(hidden)]
    pub fn excess(&self, joint: usize, angle: f64) -> f64 {
        (self.lower[joint] - angle).max(angle - self.upper[joint]).max(0.0)
    }

    /// A joint vector that exceeds limits by rounding, at most [`START_TOLERANCE`], at these limits;
    /// `None` of any other.
    pub(crate) fn rounded_in(&self, q: &[f64; N]) -> Option<[f64; N]> {
        if (0..N).all(|joint| self.holds(joint, q[joint])) {
            return None;
        }
        let mut inside = *q;
        for (angle, limits) in inside.iter_mut().zip(self.to_array()) {
            *angle = at_limit(*angle, limits)?;
        }
        Some(inside)
    }

    /// How far an angle of joint `joint` (from 0), at its best 2 pi equivalent, exceeds its limits
    /// [rad]; negative inside.
    #[doc(hidden)]
    pub fn overrun(&self, joint: usize, angle: f64) -> f64 {
        overrun(self.lower[joint], self.upper[joint], angle)
    }

    /// How far the angle of a solution is outside its limits [rad], at its best 2 pi equivalent; zero
    /// inside. One that has an equivalent inside was given as it is, and counts so.
    pub(crate) fn least_excess(&self, joint: usize, angle: f64) -> f64 {
        let overrun = self.overrun(joint, angle);
        if overrun > 0.0 { overrun } else { self.excess(joint, angle) }
    }

    /// The joint (from 1) that is nearest to one of its limits, and how far inside it is [rad];
    /// negative outside. `None` without limits.
    #[must_use]
    pub fn nearest(&self, q: &[f64; N]) -> Option<(usize, f64)> {
        let room = |joint: usize| (q[joint] - self.lower[joint]).min(self.upper[joint] - q[joint]);
        let rooms = (0..N).map(|joint| (joint + 1, room(joint)));
        let nearest = rooms.min_by(|(_, one), (_, other)| one.total_cmp(other));
        nearest.filter(|(_, room)| room.is_finite())
    }

    /// [`Self::overrun`] of the joint that exceeds its limits most.
    pub(crate) fn worst_overrun(&self, q: &[f64; N]) -> f64 {
        let linkage = self.linkage_overrun(q);
        q.iter()
            .enumerate()
            .map(|(joint, angle)| self.overrun(joint, *angle))
            .fold(linkage, f64::max)
    }

    /// Wrap each angle into its limits (eq. 20): the angle in (-pi, pi] or, if that is outside the
    /// limits and a 2 pi equivalent is inside, the first such.
    pub(crate) fn wrap(&self, q: [f64; N]) -> [f64; N] {
        core::array::from_fn(|joint| {
            if self.holds(joint, q[joint]) {
                return q[joint];
            }
            self.turn_nearest(joint, q[joint], q[joint]).unwrap_or(q[joint])
        })
    }

    /// The 2 pi equivalent of `angle` inside the limits that is nearest to `seed`.
    pub(crate) fn turn_nearest(&self, joint: usize, angle: f64, seed: f64) -> Option<f64> {
        // The common case, without a division.
        if (seed - angle).abs() < PI && self.holds(joint, angle) {
            return Some(angle);
        }
        let (first, last) = self.turns(joint, angle)?;
        let turn = nearest_whole((seed - angle) / TAU).clamp(first, last);
        Some(if turn == 0.0 { angle } else { angle + TAU * turn })
    }

    /// The angle that an undetermined joint takes without a seed [rad]: zero if that is inside the
    /// limits, otherwise their middle.
    #[doc(hidden)]
    pub fn rest(&self) -> [f64; N] {
        core::array::from_fn(|joint| {
            let middle = 0.5 * (self.lower[joint] + self.upper[joint]);
            if self.excess(joint, 0.0) > 0.0 && middle.is_finite() { middle } else { 0.0 }
        })
    }

    /// Every angle at its 2 pi equivalent inside the limits that is nearest to `seed`; `None` if an
    /// angle has none, or if the linkage is outside its limits, which no turn changes.
    #[doc(hidden)]
    pub fn wrapped_near(&self, q: &[f64; N], seed: &[f64; N]) -> Option<[f64; N]> {
        if self.linkage_excess(q) > 0.0 {
            return None;
        }
        let mut wrapped = *q;
        for (joint, angle) in wrapped.iter_mut().enumerate() {
            *angle = self.turn_nearest(joint, *angle, seed[joint])?;
        }
        Some(wrapped)
    }

    /// [`Self::wrapped_near`], with a joint that is outside by at most `slack` [rad] put on the
    /// limit; the linkage is not checked.
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

    /// First and last number of turns that keep `angle` inside the limits when added to it; `None`
    /// if no number does.
    pub(crate) fn turns(&self, joint: usize, angle: f64) -> Option<(f64, f64)> {
        let first = whole_above((self.lower[joint] - LIMIT_TOLERANCE - angle) / TAU);
        let last = whole_below((self.upper[joint] + LIMIT_TOLERANCE - angle) / TAU);
        (first <= last).then_some((first, last))
    }

    /// [`Self::turns`], restricted to the angle itself for a joint without limits.
    pub(crate) fn countable_turns(&self, joint: usize, angle: f64) -> Option<(f64, f64)> {
        self.turns(joint, angle).map(|(first, last)| {
            if first.is_finite() && last.is_finite() { (first, last) } else { (0.0, 0.0) }
        })
    }
}

/// An angle inside its limits, or at the one that it exceeds by at most [`START_TOLERANCE`].
pub fn at_limit(angle: f64, [lower, upper]: [f64; 2]) -> Option<f64> {
    let is_near = angle >= lower - START_TOLERANCE && angle <= upper + START_TOLERANCE;
    is_near.then(|| angle.max(lower).min(upper))
}

/// Check limits, each a number or infinite: minus infinity below, infinity above.
pub(super) fn check(
    fields: [&'static str; 2],
    index: usize,
    limits: [f64; 2],
) -> Result<(), Error> {
    for ((field, value), none) in
        fields.into_iter().zip(limits).zip([f64::NEG_INFINITY, f64::INFINITY])
    {
        if value.is_nan() || (value.is_infinite() && value.total_cmp(&none).is_ne()) {
            return Err(ModelFault::NoLimit { field, index, value, none }.into());
        }
        if value.is_finite() {
            ModelFault::check(field, index, value, MOST_ANGLE)?;
        }
    }
    Ok(())
}

/// How far an angle, at its best 2 pi equivalent, exceeds its limits [rad]; negative inside.
pub(super) fn overrun(lower: f64, upper: f64, angle: f64) -> f64 {
    let middle = 0.5 * (lower + upper);
    // With one side unlimited, some 2 pi equivalent is always inside.
    if !middle.is_finite() {
        return f64::NEG_INFINITY;
    }
    let angle = nearest_turn(angle, middle);
    (lower - angle).max(angle - upper)
}

/// Joint limits as serde reads and writes them: `None` for no limit, as text has no infinity.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(rename = "JointLimits")]
struct StoredLimits<const N: usize> {
    /// (lower, upper) of each joint [rad].
    #[serde(with = "serde_big_array::BigArray")]
    joints: [[Option<f64>; 2]; N],
    /// (lower, upper) of the linkage [rad].
    linkage: Option<[Option<f64>; 2]>,
    /// Whether axes 2 and 3 turn in opposite senses, so that the linkage's angle is q3 + q2.
    #[serde(default)]
    is_opposed: bool,
}

#[cfg(feature = "serde")]
impl<const N: usize> From<JointLimits<N>> for StoredLimits<N> {
    fn from(limits: JointLimits<N>) -> Self {
        let stored = |pair: [f64; 2]| pair.map(|limit| limit.is_finite().then_some(limit));
        Self {
            joints: limits.to_array().map(stored),
            linkage: limits.linkage().map(stored),
            is_opposed: limits.coupling < 0.0,
        }
    }
}

#[cfg(feature = "serde")]
impl<const N: usize> TryFrom<StoredLimits<N>> for JointLimits<N> {
    type Error = Error;

    fn try_from(stored: StoredLimits<N>) -> Result<Self, Error> {
        let limits = |[lower, upper]: [Option<f64>; 2]| {
            [lower.unwrap_or(f64::NEG_INFINITY), upper.unwrap_or(f64::INFINITY)]
        };
        let coupling = if stored.is_opposed { -1.0 } else { 1.0 };
        Self::new(stored.joints.map(limits))?.with_linkage(stored.linkage.map(limits), coupling)
    }
}

#[cfg(test)]
mod tests {
    use std::string::ToString;

    use super::*;

    fn limits() -> JointLimits<2> {
        JointLimits::new([[-400.0_f64.to_radians(), 400.0_f64.to_radians()], [-4.3, 1.1]]).unwrap()
    }

    #[test]
    fn an_angle_is_wrapped_inside_the_limits_if_an_equivalent_is_inside() {
        let wrapped = limits().wrap([1.0, 2.5]);
        assert_eq!(wrapped[0], 1.0);
        assert!((wrapped[1] - (2.5 - TAU)).abs() < 1e-15);
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
    fn limits_of_most_joints_in_degrees_are_refused_and_wide_ones_of_some_are_not() {
        let refused = |limits: [[f64; 2]; 6]| JointLimits::new(limits).unwrap_err().to_string();
        assert_eq!(
            refused([[-180.0, 180.0]; 6]),
            "joint 1 limit is -180 to 180 rad, beyond 50 rad as are the limits of most joints (did you \
             pass degrees? for no limit give inf)"
        );
        let degrees =
            [[-180.0, 180.0], [-95.0, 155.0], [-180.0, 75.0], [-400.0, 400.0], [-120.0, 120.0]];
        let five: [[f64; 2]; 5] = degrees;
        assert!(JointLimits::new(five).is_err());
        // 242 revolutions of axes 1, 4 and 6; every joint as good as without limits; none at all.
        let (axis, wide) = ([-2.0, 2.0], [-242.0 * TAU, 242.0 * TAU]);
        assert!(JointLimits::new([wide, axis, axis, wide, axis, wide]).is_ok());
        assert!(JointLimits::new([[-100.0, 100.0], axis, axis, wide, axis, [-99.0, 99.0]]).is_ok());
        for every in [[-7.9 * TAU, 7.9 * TAU], [-1e4, 1e4], [f64::NEG_INFINITY, f64::INFINITY]] {
            assert!(JointLimits::new([every; 6]).is_ok(), "{every:?}");
        }
    }

    #[test]
    fn an_angle_at_the_limit_is_inside() {
        assert!(limits().contains(&[0.0, 1.1 + 1e-10]));
        assert!(!limits().contains(&[0.0, 1.1 + 1e-8]));
    }
}
