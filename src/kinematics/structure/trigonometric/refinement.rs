//! Simple roots by Newton's method, held inside their intervals.

use fearless_simd::prelude::*;

use super::polynomial::TrigonometricPolynomial;
use super::roots::{MOST_ROOTS, Root, Roots};
use crate::lanes::{Column, LANES, Number as _, Vector, sin_cos_of};

/// Step of Newton's method after which a root is taken, relative to the width of its interval, or
/// to the length on which the slope changes [1]: its error is of the order of the square.
const CONVERGED: f64 = 1e-5;

/// Largest step that may count as noise, relative to the width of the interval [1].
const MOST_NOISE: f64 = 1e-3;

/// Steps at most: halving alone takes 20 for an arc.
const MOST_STEPS: usize = 48;

impl TrigonometricPolynomial {
    /// Narrow the interval of each simple root to what the noise leaves.
    #[inline(always)]
    pub(super) fn refine<S: Simd>(&self, simd: S, roots: &mut Roots) {
        let mut simple = [0; MOST_ROOTS];
        let mut count = 0;
        for (index, root) in roots.as_slice().iter().enumerate() {
            if root.is_simple {
                simple[count] = index;
                count += 1;
            }
        }
        let roots = roots.as_mut_slice();
        for block in simple[..count].chunks(LANES) {
            let (mut low, mut high) = ([0.0; LANES], [0.0; LANES]);
            for lane in 0..LANES {
                // Lanes without a root repeat the first.
                let root = roots[block[if lane < block.len() { lane } else { 0 }]];
                (low[lane], high[lane]) = (root.low, root.high);
            }
            let [low, high] = [Vector::load_array(simd, low), Vector::load_array(simd, high)];
            let (angle, radius) = self.bracketed(low, high);
            for (lane, index) in block.iter().enumerate() {
                let radius = radius[lane];
                roots[*index] = Root {
                    low: angle[lane] - radius,
                    high: angle[lane] + radius,
                    is_simple: true,
                    most: 1,
                };
            }
        }
    }

    /// The roots between angles where the signs differ, and what the noise leaves of them: angles
    /// and radii [rad].
    #[inline(always)]
    fn bracketed<S: Simd>(&self, mut low: Vector<S>, mut high: Vector<S>) -> (Column, Column) {
        let [at_low, slope_low] = self.at(low);
        let [at_high, _] = self.at(high);
        let zero = low.like(0.0);
        let width = high - low;
        let part = at_low / (at_low - at_high);
        let part = part.or_more(zero.like(0.05));
        let part = part.if_above(zero.like(0.95), zero.like(0.95), part);
        let mut angle = part.mul_add(width, low);
        let (mut before, mut slopes) = (low, slope_low);
        let mut is_moving = zero.simd_eq(zero);
        for _ in 0..MOST_STEPS {
            let [value, slope] = self.at(angle);
            let is_before = !(value.simd_lt(0.0) ^ at_low.simd_lt(0.0));
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
