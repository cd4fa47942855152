//! Simple roots by Halley's method, held inside their intervals.

use fearless_simd::prelude::*;

use super::brackets::{Bracket, BracketBlock};
use super::polynomial::TrigonometricPolynomial;
use crate::lanes::{Column, Number as _, Vector, sin_cos_of};

/// Step after which a root is taken, relative to the width of its interval, or to the length on which
/// the slope changes [1]: its error is of the order of the third power.
const CONVERGED: f64 = 3e-4;

/// Largest step that may count as noise, relative to the width of the interval [1].
const MOST_NOISE: f64 = 1e-3;

/// Steps at most: halving alone takes 12 for an arc.
const MOST_STEPS: usize = 48;

/// Up to eight roots, to the noise [rad].
pub(super) struct Refined {
    pub(super) angles: Column,
    pub(super) radii: Column,
}

impl BracketBlock {
    /// Narrow brackets of roots of these polynomials to what the noise leaves of them.
    pub(super) fn refined<S: Simd>(&self, simd: S, all: &[TrigonometricPolynomial]) -> Refined {
        // A function of its own for each instruction set: it is long.
        simd.vectorize(
            #[inline(always)]
            || {
                let polynomials = TrigonometricPolynomial::of_lanes(simd, all, &self.of);
                polynomials.refined(&self.in_lanes(simd))
            },
        )
    }
}

impl<S: Simd> TrigonometricPolynomial<Vector<S>> {
    /// The roots in brackets, and what the noise leaves of them.
    #[inline(always)]
    fn refined(&self, bracket: &Bracket<S>) -> Refined {
        let Bracket { mut low, mut high, start, sign } = *bracket;
        let zero = low.like(0.0);
        let width = high - low;
        let mut angle = start;
        let mut last = zero;
        let mut is_moving = zero.simd_eq(zero);
        for _ in 0..MOST_STEPS {
            let (sin, cos) = sin_cos_of(angle);
            let [value, slope, second] = self.values(sin, cos);
            let is_before = !(value.simd_lt(0.0) ^ sign.simd_lt(0.0));
            low = is_before.select(angle, low);
            high = is_before.select(high, angle);
            let square = slope * slope;
            let halley = angle - value * slope / (value * second).mul_add(-0.5, square);
            let is_inside = halley.simd_ge(low) & halley.simd_le(high);
            let next = is_inside.select(halley, (low + high) * 0.5);
            // The length on which the slope changes: the distance of a root from the next, if that
            // is near.
            let turning = (slope / second).abs();
            let length = width.if_above(turning, turning, width);
            last = is_moving.select(slope, last);
            let (noise, most) = (self.noise / slope.abs(), width * MOST_NOISE);
            let noise = most.if_above(noise, noise, most);
            let stays = (next - angle).abs().simd_gt(length.mul_add(CONVERGED, noise));
            // A lane stops by itself: its root does not depend on the others.
            angle = is_moving.select(next, angle);
            is_moving &= stays;
            if !is_moving.any_true() {
                break;
            }
        }
        let left = self.noise / last.abs();
        // A slope of zero leaves the interval.
        let radius = width.if_above(left, left, width);
        Refined { angles: angle.to_array(), radii: radius.to_array() }
    }
}
