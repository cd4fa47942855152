//! Simple roots by Newton's method, held inside their intervals.

use super::{MOST_ROOTS, Root, Roots, TrigonometricPolynomial};
use crate::lanes::{Column, LANES, sin_cos};

/// Step of Newton's method after which a root is taken, relative to the width of its interval [1]:
/// its error is of the order of the square.
const CONVERGED: f64 = 1e-5;

/// Largest step that may count as noise, relative to the width of the interval [1].
const MOST_NOISE: f64 = 1e-3;

/// Steps at most: halving alone takes 20 for an arc.
const MOST_STEPS: usize = 48;

impl TrigonometricPolynomial {
    /// Narrow the interval of each simple root to what the noise leaves.
    #[inline(always)]
    pub(super) fn refine<const FUSED: bool>(&self, roots: &mut Roots) {
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
            let (angle, radius) = self.bracketed::<FUSED>(low, high);
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
    fn bracketed<const FUSED: bool>(&self, mut low: Column, mut high: Column) -> (Column, Column) {
        let [at_low, _] = self.at::<FUSED>(&low);
        let [at_high, _] = self.at::<FUSED>(&high);
        let (mut angle, mut width) = ([0.0; LANES], [0.0; LANES]);
        for lane in 0..LANES {
            width[lane] = high[lane] - low[lane];
            let part = at_low[lane] / (at_low[lane] - at_high[lane]);
            let part = if part < 0.05 { 0.05 } else { part };
            let part = if part > 0.95 { 0.95 } else { part };
            angle[lane] = low[lane] + part * (high[lane] - low[lane]);
        }
        let (mut slopes, mut is_moving) = ([0.0; LANES], [true; LANES]);
        for _ in 0..MOST_STEPS {
            let [value, slope] = self.at::<FUSED>(&angle);
            let mut moving = 0;
            for lane in 0..LANES {
                let (x, y) = (angle[lane], value[lane]);
                let is_before = (y < 0.0) == (at_low[lane] < 0.0);
                low[lane] = if is_before { x } else { low[lane] };
                high[lane] = if is_before { high[lane] } else { x };
                let newton = x - y / slope[lane];
                let is_inside = (newton >= low[lane]) & (newton <= high[lane]);
                let next = if is_inside { newton } else { 0.5 * (low[lane] + high[lane]) };
                // A lane stops by itself: its root does not depend on the others.
                angle[lane] = if is_moving[lane] { next } else { x };
                slopes[lane] = slope[lane];
                let (noise, most) = (self.noise / slope[lane].abs(), MOST_NOISE * width[lane]);
                let noise = if noise < most { noise } else { most };
                is_moving[lane] &= (next - x).abs() > CONVERGED * width[lane] + noise;
                moving |= u64::from(is_moving[lane]);
            }
            if moving == 0 {
                break;
            }
        }
        let mut radius = [0.0; LANES];
        for lane in 0..LANES {
            let left = self.noise / slopes[lane].abs();
            // A slope of zero leaves the interval.
            radius[lane] = if left < width[lane] { left } else { width[lane] };
        }
        (angle, radius)
    }

    /// Values and derivatives at angles.
    #[inline(always)]
    fn at<const FUSED: bool>(&self, angles: &Column) -> [Column; 2] {
        let (mut sin, mut cos) = ([0.0; LANES], [0.0; LANES]);
        for lane in 0..LANES {
            (sin[lane], cos[lane]) = sin_cos::<FUSED>(angles[lane]);
        }
        self.values::<FUSED>(&sin, &cos)
    }
}
