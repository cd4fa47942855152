//! Where the references of a joint go: their motion without noise, jitter and rounding
//! (docs/theory/stream.md, eq. 14 to 17).

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use super::brake::{Bounds, End, digits_of, exceeds};
use super::limit::Goal;

/// Cycles of the window for a misfit of one bound of the third difference (eq. 15).
const WINDOW: f64 = 2.75;

/// Windows after which references that had several misfits fit again, and the least number of
/// cycles.
const QUIET: (f64, f64) = (4.0, 48.0);

/// Cycles in which third differences are of one misfit: a step has three.
const MISFIT: f64 = 3.0;

/// A first difference beyond so many bounds is of a jump: the joint is to go to another place.
const JUMP: f64 = 10.0;

/// Part of the third difference with which a joint arrives at references that do not fit: the rest
/// is for their own.
const SHARE: f64 = 0.5;

/// How far beyond the recent references a joint may come to rest, as a part of their range (eq. 17).
const BEYOND: f64 = 12.0;

#[derive(Clone, Copy, Debug)]
pub(super) struct Track {
    /// The last one and its differences.
    last: End,
    /// The fitted value, and its derivatives by cycles.
    fit: [f64; 4],
    /// Cycles that count in the fit; one if the references fit as they are.
    window: f64,
    /// Cycles in which a smaller misfit does not shorten the window.
    kept: f64,
    /// Cycles since a misfit began.
    since: f64,
    is_noise: bool,
    /// The least and the greatest recent reference.
    range: [f64; 2],
}

impl Track {
    /// References at rest.
    pub(super) fn new(at: f64) -> Self {
        Self {
            last: End { point: at, ..End::default() },
            fit: [at, 0.0, 0.0, 0.0],
            window: 1.0,
            kept: 0.0,
            since: f64::INFINITY,
            is_noise: false,
            range: [at; 2],
        }
    }

    /// The last reference [rad].
    pub(super) fn point(&self) -> f64 {
        self.last.point
    }

    /// Whether the references move within the bound of the third difference, and have for a while.
    pub(super) fn fits(&self) -> bool {
        self.window <= 1.0
    }

    pub(super) fn take(&mut self, point: f64, bounds: &Bounds) {
        let memory = bounds.first / bounds.second + bounds.second / bounds.third + QUIET.1;
        let [low, high] = self.range;
        self.range =
            [point.min(low + (point - low) / memory), point.max(high + (point - high) / memory)];
        let first = point - self.last.point;
        let second = first - self.last.first;
        let third = second - self.last.second;
        if first.abs() > JUMP * bounds.first {
            *self = Self { range: self.range, ..Self::new(point) };
            return;
        }
        self.last = End { point, first, second };
        if exceeds(third, bounds.third, digits_of(point)) {
            self.misfit(point, (third / bounds.third).abs(), memory);
        }
        let several = (QUIET.0 * self.window).max(QUIET.1);
        let quiet = if self.is_noise { several } else { self.window };
        if self.since >= quiet {
            (self.window, self.kept) = (1.0, 0.0);
        }
        self.kept -= 1.0;
        self.since += 1.0;
        self.fit_to(point);
    }

    /// A third difference of so many bounds (eq. 15).
    fn misfit(&mut self, point: f64, size: f64, memory: f64) {
        let window = (WINDOW * size.sqrt().sqrt()).min(memory);
        let is_another = self.since > MISFIT;
        if is_another {
            let quiet = (QUIET.0 * self.window.max(window)).max(QUIET.1);
            self.is_noise = self.since < quiet;
            self.since = 0.0;
        }
        let is_step = is_another && !self.is_noise;
        if is_step {
            // Beside a step the motion goes on as before.
            let [_, velocity, acceleration, jerk] = self.fit;
            self.fit[0] = point - velocity - acceleration / 2.0 - jerk / 6.0;
        }
        if is_step || QUIET.0 * window >= self.kept {
            (self.window, self.kept) = (window, QUIET.0 * window);
        }
    }

    /// The fit with one more reference (eq. 14).
    fn fit_to(&mut self, point: f64) {
        let End { first, second, .. } = self.last;
        if self.fits() {
            self.fit = [point, first + second / 2.0, second, 0.0];
            return;
        }
        let [value, velocity, acceleration, jerk] = self.fit;
        let fading = 1.0 - 1.0 / self.window;
        let rest = 1.0 - fading;
        let predicted = value + velocity + acceleration / 2.0 + jerk / 6.0;
        let error = point - predicted;
        let fit = [
            predicted + (1.0 - fading.powi(4)) * error,
            velocity
                + acceleration
                + jerk / 2.0
                + rest * rest * (11.0 + fading * (14.0 + 11.0 * fading)) / 6.0 * error,
            acceleration + jerk + 2.0 * rest.powi(3) * (1.0 + fading) * error,
            jerk + rest.powi(4) * error,
        ];
        let is_finite = fit.iter().copied().all(f64::is_finite);
        self.fit = if is_finite { fit } else { [point, 0.0, 0.0, 0.0] };
    }

    /// Where the joint is to go. `is_followed`: it is at the reference before the last one.
    pub(super) fn goal(&self, bounds: &Bounds, is_followed: bool) -> Goal {
        let [value, velocity, acceleration, jerk] = self.fit;
        let (first, second) = (bounds.first, bounds.second);
        if self.fits() {
            let End { point, first: pace, second: bend } = self.last;
            let motion = End {
                point,
                first: pace.clamp(-first, first),
                second: bend.clamp(-second, second),
            };
            return Goal { motion, third: bounds.third, is_followed };
        }
        let motion = End {
            point: value,
            first: (velocity - acceleration / 2.0 + jerk / 6.0).clamp(-first, first),
            second: (acceleration - jerk).clamp(-second, second),
        };
        Goal { motion, third: SHARE * bounds.third, is_followed: false }
    }

    /// Limits within which the joint comes to rest (eq. 17).
    pub(super) fn limits(&self, [lower, upper]: [f64; 2]) -> [f64; 2] {
        let [low, high] = self.range;
        let beyond = BEYOND * (high - low);
        [lower.max(low - beyond), upper.min(high + beyond)]
    }
}
