//! Towards a reference as far and as fast as the bounds of a joint allow (docs/theory/stream.md,
//! eq. 11, 12).

use super::brake::{Bounds, Brake, End, braking};

/// How far from the reference a joint may come to rest and be there [rad]: rounding of the phases
/// of a braking motion.
const LANDED: f64 = 1e-14;

/// Rounds in which a second difference is sought [1]: false position converges in a few, and what
/// is left of the way remains for the next cycle.
const ROUNDS: usize = 16;

/// Where a joint is to go.
#[derive(Clone, Copy)]
pub(super) struct Goal {
    /// The reference and its last differences [rad].
    pub(super) motion: End,
    /// Bound of the third difference with which the joint comes to rest beside it [rad].
    pub(super) third: f64,
    /// Whether the joint is at the last one.
    pub(super) is_followed: bool,
}

pub(super) struct Limited<'a> {
    pub(super) bounds: &'a Bounds,
    pub(super) end: End,
    pub(super) limits: [f64; 2],
}

impl Limited<'_> {
    /// The next control point.
    pub(super) fn toward(&self, goal: &Goal) -> f64 {
        let [lower, upper] = self.limits;
        let point = goal.motion.point.max(lower).min(upper);
        let is_inside = point - goal.motion.point == 0.0;
        let goal = if is_inside { *goal } else { self.at_rest(point) };
        let brake = braking(self.end, self.bounds);
        let [low, high] = self.bounds.seconds(self.end);
        let range = [low.min(brake), high.max(brake)];
        let arriving = point - self.end.point - self.end.first;
        let fits = arriving >= range[0] - LANDED && arriving <= range[1] + LANDED;
        let arrives = fits && (goal.is_followed || self.beyond(arriving, &goal).abs() <= LANDED);
        let second = if arrives { arriving } else { self.aimed(range, &goal) };
        let [least, most] = Brake::new(self.end.then(second), self.bounds).extent();
        if most > upper {
            self.end.then(second.min(self.aimed(range, &self.at_rest(upper)))).point
        } else if least < lower {
            self.end.then(second.max(self.aimed(range, &self.at_rest(lower)))).point
        } else if arrives {
            point
        } else {
            self.end.then(second).point
        }
    }

    /// A reference at rest.
    fn at_rest(&self, point: f64) -> Goal {
        let motion = End { point, ..End::default() };
        Goal { motion, third: self.bounds.third, is_followed: false }
    }

    /// The end of the control points, seen beside a reference in motion.
    fn beside(end: End, goal: &Goal) -> End {
        let End { first, second, .. } = goal.motion;
        End { first: end.first - first, second: end.second - second, ..end }
    }

    /// How far beyond a reference in motion a joint comes to rest beside it, after a step by a
    /// second difference (eq. 11).
    fn beyond(&self, second: f64, goal: &Goal) -> f64 {
        let bounds = Bounds { third: goal.third, ..*self.bounds };
        let next = Self::beside(self.end.then(second), goal);
        Brake::new(next, &bounds).stop - goal.motion.point
    }

    /// The second difference with which the joint comes to rest at the reference, or the one that
    /// comes nearest (eq. 12).
    fn aimed(&self, [mut low, mut high]: [f64; 2], goal: &Goal) -> f64 {
        let beyond = |second: f64| self.beyond(second, goal);
        let (mut below, mut above) = (beyond(low), beyond(high));
        if above <= 0.0 {
            return high;
        }
        if below >= 0.0 {
            return low;
        }
        // On the way to rest the law is the answer.
        let bounds = Bounds { third: goal.third, ..*self.bounds };
        let law = goal.motion.second + braking(Self::beside(self.end, goal), &bounds);
        let mut next = law;
        for round in 0..ROUNDS {
            if low < next && next < high {
                let value = beyond(next);
                if value.abs() <= LANDED {
                    return next;
                }
                if value < 0.0 {
                    (low, below) = (next, value);
                    above *= if round > 0 { 0.5 } else { 1.0 };
                } else {
                    (high, above) = (next, value);
                    below *= if round > 0 { 0.5 } else { 1.0 };
                }
            }
            next = low - below * ((high - low) / (above - below));
        }
        low
    }
}
