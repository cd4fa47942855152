//! One piece of a path: what limits leave of the paces at both of its ends.

use super::polynomial::TERMS;
use crate::prelude::*;

/// Remainder of a sum of numbers that cancel, as a part of them.
const CANCELED: f64 = 64.0 * f64::EPSILON;

/// Rounds of a search that ends after a few: each leaves a corner of a polygon behind.
const MOST_ROUNDS: usize = 64;

/// A piece of a path: a cubic in s for each joint, from 0 to a length.
pub(super) struct Piece<'a> {
    pub(super) length: f64,
    pub(super) terms: &'a [[f64; TERMS]],
}

impl Piece<'_> {
    /// The largest pace at which no joint exceeds its velocity anywhere on the piece (eq. 14).
    pub(super) fn pace_bound(&self, max_velocity: &[f64]) -> f64 {
        let bound = |(joint, limit): (usize, &f64)| {
            let ratio = limit / self.steepest(joint);
            ratio * ratio
        };
        max_velocity.iter().enumerate().map(bound).fold(f64::INFINITY, f64::min)
    }

    /// dq/ds and d2q/ds2 of a joint, from 0, at a length from the start of the piece.
    pub(super) fn slope_and_bend(&self, joint: usize, s: f64) -> [f64; 2] {
        let [_, c1, c2, c3, ..] = self.terms[joint];
        [c1 + s * (2.0 * c2 + s * 3.0 * c3), 2.0 * c2 + s * 6.0 * c3]
    }

    /// The largest size of dq/ds of a joint, from 0, on the piece: at an end or where its
    /// derivative is zero.
    pub(super) fn steepest(&self, joint: usize) -> f64 {
        let [_, c1, c2, c3, ..] = self.terms[joint];
        let slope = |s: f64| (c1 + s * (2.0 * c2 + s * 3.0 * c3)).abs();
        let turn = -c2 / (3.0 * c3);
        let inner = if 0.0 < turn && turn < self.length { slope(turn) } else { 0.0 };
        slope(0.0).max(slope(self.length)).max(inner)
    }

    /// The first joint that moves, from 1.
    pub(super) fn first_moving(&self) -> usize {
        let moves = |terms: &[f64; TERMS]| terms[1..].iter().any(|term| *term != 0.0);
        self.terms.iter().position(moves).map_or(1, |joint| joint + 1)
    }
}

/// The limits of acceleration as conditions on the paces x before and y after a piece:
/// `-limit <= by_before * x + by_after * y <= limit` for each Bernstein coefficient of each joint
/// (eq. 15). Rest at both ends is always inside.
#[derive(Default)]
pub(super) struct Strips {
    /// Conditions with a part of x, solved for it: |x - slope * y| <= half.
    lines: Vec<Line>,
    /// The largest y by those without.
    most_after: f64,
}

#[derive(Clone, Copy)]
struct Line {
    slope: f64,
    half: f64,
}

impl Line {
    const OPEN: Self = Self { slope: 0.0, half: f64::INFINITY };

    fn upper(self, y: f64) -> f64 {
        self.slope * y + self.half
    }

    fn lower(self, y: f64) -> f64 {
        self.slope * y - self.half
    }
}

impl Strips {
    pub(super) fn set(&mut self, piece: &Piece<'_>, max_acceleration: &[f64]) {
        let h = piece.length;
        self.lines.clear();
        self.most_after = f64::INFINITY;
        for ([_, c1, c2, c3, ..], limit) in piece.terms.iter().zip(max_acceleration) {
            // dq/ds and d2q/ds2 at both ends, and the middle Bernstein coefficient of the former.
            let (first, middle, last) = (*c1, c1 + c2 * h, c1 + h * (2.0 * c2 + h * 3.0 * c3));
            let (bend, bend_after) = (2.0 * c2, 2.0 * c2 + 6.0 * c3 * h);
            let rate = 0.5 / h;
            self.add(bend - first * rate, first * rate, *limit);
            self.add(0.5 * bend_after - middle * rate, 0.5 * bend + middle * rate, *limit);
            self.add(-last * rate, bend_after + last * rate, *limit);
        }
    }

    fn add(&mut self, by_before: f64, by_after: f64, limit: f64) {
        // Where a path turns back, the parts of one of the paces cancel up to rounding.
        if by_before.abs() <= CANCELED * by_after.abs() {
            if by_after != 0.0 {
                self.most_after = self.most_after.min(limit / by_after.abs());
            }
        } else if limit.is_finite() {
            self.lines.push(Line { slope: -by_after / by_before, half: limit / by_before.abs() });
        }
    }

    /// The upper line that binds at y, and the lower one.
    fn binding(&self, y: f64) -> [Line; 2] {
        let [mut upper, mut lower] = [Line::OPEN; 2];
        for line in &self.lines {
            if line.upper(y) < upper.upper(y) {
                upper = *line;
            }
            if line.lower(y) > lower.lower(y) {
                lower = *line;
            }
        }
        [upper, lower]
    }

    /// The largest x up to `bound` from which some y in 0 ..= `most_after` is allowed (eq. 16).
    pub(super) fn most_before(&self, bound: f64, most_after: f64) -> f64 {
        let mut right = most_after.min(self.most_after);
        if !right.is_finite() {
            // No limit of what follows: nor of what precedes it.
            return bound;
        }
        // The largest y that is allowed with any x >= 0: Newton's iteration from above on a convex
        // function that consists of lines ends at its zero.
        for _ in 0..MOST_ROUNDS {
            let [upper, lower] = self.binding(right);
            let highest = upper.upper(right).min(bound);
            if highest >= lower.lower(right).max(0.0) {
                break;
            }
            let (slope, half) =
                if upper.upper(right) <= bound { (upper.slope, upper.half) } else { (0.0, bound) };
            // Where the upper line meets the lower one, or zero.
            let (low_slope, low_half) =
                if lower.lower(right) > 0.0 { (lower.slope, -lower.half) } else { (0.0, 0.0) };
            let next = (half - low_half) / (low_slope - slope);
            // No progress: only rounding is left.
            if next.is_nan() || next >= right {
                break;
            }
            right = next.max(0.0);
        }
        // The highest point of the upper lines, a concave function, between 0 and there: where the
        // lines that bind at both ends meet, until one of them binds there too.
        let mut left = 0.0;
        let [mut rising, _] = self.binding(left);
        let [mut falling, _] = self.binding(right);
        let (mut low, mut high) = (rising.upper(left), falling.upper(right));
        if falling.slope >= 0.0 || rising.slope <= 0.0 {
            let most = if falling.slope >= 0.0 { high } else { low };
            return most.min(bound).max(0.0);
        }
        for _ in 0..MOST_ROUNDS {
            let y = (falling.half - rising.half) / (rising.slope - falling.slope);
            if !(left < y && y < right) {
                break;
            }
            let [line, _] = self.binding(y);
            let top = line.upper(y);
            if top >= rising.upper(y).min(falling.upper(y)) {
                return top.min(bound).max(0.0);
            }
            if line.slope > 0.0 {
                (left, rising, low) = (y, line, top);
            } else {
                (right, falling, high) = (y, line, top);
            }
        }
        low.max(high).min(bound).max(0.0)
    }

    /// The largest y up to `bound` that is allowed after a pace of x, which allows one.
    pub(super) fn most_after(&self, x: f64, bound: f64) -> f64 {
        let mut most = bound.min(self.most_after);
        for line in &self.lines {
            // |x - slope y| <= half. Where y has a small part in it, x may be at the edge, and the
            // rounding of x - half says nothing about y.
            let is_small = line.slope.abs() * most <= line.half;
            let half = if is_small { line.half * (1.0 + CANCELED) } else { line.half };
            if line.slope != 0.0 {
                let ends = [(x - half) / line.slope, (x + half) / line.slope];
                most = most.min(ends[0].max(ends[1]));
            }
        }
        most.max(0.0)
    }
}
