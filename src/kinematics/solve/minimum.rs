//! Minimizes a function of one variable without derivatives.
//!
//! Reference: Brent, Algorithms for Minimization without Derivatives, 1973, chapter 5.

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

/// Fraction that divides an interval in the golden section.
const GOLDEN: f64 = 0.381_966_011_250_105_1;

/// Evaluations, at most: a golden section of them leaves 1e-9 of the interval.
const MOST: u32 = 45;

/// Part of the interval within which the minimum is located [1]: a smooth one has the least value
/// to rounding there.
const CLOSE: f64 = 1e-9;

/// Locate a minimum of `f` between two places, given one between them and its value.
pub(super) fn minimum(mut f: impl FnMut(f64) -> f64, [mut low, x, mut high]: [f64; 3], at_x: f64) {
    let close = CLOSE * (high - low);
    let (mut x, mut at_x) = (x, at_x);
    let (mut second, mut third) = ((x, f64::INFINITY), (x, f64::INFINITY));
    let (mut step, mut before) = (0.0_f64, 0.0_f64);
    for _ in 0..MOST {
        let middle = 0.5 * (low + high);
        if (x - middle).abs() + 0.5 * (high - low) <= 2.0 * close {
            return;
        }
        // The vertex of the parabola through the three best.
        let (r, q) = ((x - second.0) * (at_x - third.1), (x - third.0) * (at_x - second.1));
        let (over, under) = ((x - third.0) * q - (x - second.0) * r, 2.0 * (q - r));
        let vertex = -over / under;
        let is_inside = vertex.abs() < 0.5 * before.abs() && x + vertex > low && x + vertex < high;
        before = step;
        if is_inside {
            let is_at_end = x + vertex - low < 2.0 * close || high - x - vertex < 2.0 * close;
            step = if is_at_end { close.copysign(middle - x) } else { vertex };
        } else {
            before = if x < middle { high - x } else { low - x };
            step = GOLDEN * before;
        }
        let tried = x + if step.abs() < close { close.copysign(step) } else { step };
        let at_tried = f(tried);
        if at_tried <= at_x {
            *(if tried < x { &mut high } else { &mut low }) = x;
            (third, second) = (second, (x, at_x));
            (x, at_x) = (tried, at_tried);
        } else {
            *(if tried < x { &mut low } else { &mut high }) = tried;
            if at_tried <= second.1 {
                (third, second) = (second, (tried, at_tried));
            } else if at_tried <= third.1 {
                third = (tried, at_tried);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn least(f: impl Fn(f64) -> f64) -> (f64, u32) {
        let (mut best, mut count) = ((0.0, f64::INFINITY), 0);
        let tried = |x| {
            count += 1;
            if f(x) < best.1 {
                best = (x, f(x));
            }
            f(x)
        };
        minimum(tried, [-0.1, 0.5, 0.9], f(0.5));
        (best.0, count)
    }

    #[test]
    fn smooth_and_sharp_minima_are_found() {
        let (smooth, few) = least(|x| (x - 0.3).powi(2));
        let (sharp, many) = least(|x| (x - 0.3).abs());
        assert!((smooth - 0.3).abs() < 1e-7 && few < 10, "{smooth} {few}");
        assert!((sharp - 0.3).abs() < 1e-9 && many <= MOST, "{sharp} {many}");
    }
}
