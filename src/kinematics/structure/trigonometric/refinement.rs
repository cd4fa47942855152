//! Simple roots by Newton's method, held inside their intervals.

use fearless_simd::prelude::*;

use super::brackets::{Bracket, Brackets};
use super::polynomial::TrigonometricPolynomial;
use super::roots::{Root, Roots};
use crate::lanes::{Column, LANES, Number as _, Vector, sin_cos_of};

/// Step of Newton's method after which a root is taken, relative to the width of its interval, or
/// to the length on which the slope changes [1]: its error is of the order of the square.
const CONVERGED: f64 = 1e-5;

/// Largest step that may count as noise, relative to the width of the interval [1].
const MOST_NOISE: f64 = 1e-3;

/// Steps at most: halving alone takes 20 for an arc.
const MOST_STEPS: usize = 48;

impl TrigonometricPolynomial {
    /// Narrow brackets of simple roots to what the noise leaves of them.
    #[inline(always)]
    pub(super) fn refine<S: Simd>(&self, simd: S, brackets: &Brackets, roots: &mut Roots) {
        for first in (0..brackets.count).step_by(LANES) {
            let (angle, radius) = self.bracketed(&brackets.block(simd, first / LANES));
            for lane in 0..LANES.min(brackets.count - first) {
                roots.push(Root {
                    low: angle[lane] - radius[lane],
                    high: angle[lane] + radius[lane],
                    is_simple: true,
                    most: 1,
                });
            }
        }
    }

    /// The roots in brackets, and what the noise leaves of them: angles and radii [rad].
    #[inline(always)]
    fn bracketed<S: Simd>(&self, bracket: &Bracket<S>) -> (Column, Column) {
        let Bracket { mut low, mut high, start, sign } = *bracket;
        let zero = low.like(0.0);
        let width = high - low;
        let mut angle = start;
        // Before the first step no change of the slope is known.
        let (mut before, mut slopes) = (start, zero.like(f64::NAN));
        let mut is_moving = zero.simd_eq(zero);
        for _ in 0..MOST_STEPS {
            let [value, slope] = self.at(angle);
            let is_before = !(value.simd_lt(0.0) ^ sign.simd_lt(0.0));
            low = is_before.select(angle, low);
            high = is_before.select(high, angle);
            let newton = angle - value / slope;
            let is_inside = newton.simd_ge(low) & newton.simd_le(high);
            let next = is_inside.select(newton, (low + high) * 0.5);
            // The length on which the slope changes: the distance of a root from the next, if that
            // is near.
            let turning = (slope * (angle - before) / (slope - slopes)).abs();
            let length = width.if_above(turning, turning, width);
            (before, slopes) = (angle, slope);
            let (noise, most) = (slope.abs().like(self.noise) / slope.abs(), width * MOST_NOISE);
            let noise = most.if_above(noise, noise, most);
            let stays = (next - angle).abs().simd_gt(length.mul_add(CONVERGED, noise));
            // A lane stops by itself: its root does not depend on the others.
            angle = is_moving.select(next, angle);
            is_moving &= stays;
            if !is_moving.any_true() {
                break;
            }
        }
        let left = slopes.like(self.noise) / slopes.abs();
        // A slope of zero leaves the interval.
        (angle.to_array(), width.if_above(left, left, width).to_array())
    }

    /// Values and derivatives at angles.
    #[inline(always)]
    fn at<S: Simd>(&self, angles: Vector<S>) -> [Vector<S>; 2] {
        let (sin, cos) = sin_cos_of(angles);
        self.values(sin, cos)
    }
}
