//! Minimizes a function of one angle without derivatives.
//!
//! Reference: Kiefer, Sequential Minimax Search for a Maximum, 1953.

use crate::error::Error;

/// Fraction that divides an interval in the golden section.
const GOLDEN: f64 = 0.381_966_011_250_105_1;

/// Number of cuts, each of which leaves 62 % of the interval: of ten degrees, 1e-10 rad.
const CUTS: u32 = 45;

/// The minimum of `f` between `low` and `high`, if it has one valley there, and its value.
pub(super) fn golden_section(
    mut f: impl FnMut(f64) -> Result<f64, Error>,
    mut low: f64,
    mut high: f64,
) -> Result<(f64, f64), Error> {
    let mut left = low + GOLDEN * (high - low);
    let mut right = high - GOLDEN * (high - low);
    let (mut at_left, mut at_right) = (f(left)?, f(right)?);
    for _ in 0..CUTS {
        if at_left < at_right {
            (high, right, at_right) = (right, left, at_left);
            left = low + GOLDEN * (high - low);
            at_left = f(left)?;
        } else {
            (low, left, at_left) = (left, right, at_right);
            right = high - GOLDEN * (high - low);
            at_right = f(right)?;
        }
    }
    Ok(if at_left < at_right { (left, at_left) } else { (right, at_right) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn smooth_and_sharp_minima_are_found() {
        let smooth = golden_section(|x| Ok((x - 0.3).powi(2)), -0.1, 0.9).unwrap();
        let sharp = golden_section(|x| Ok((x - 0.3).abs()), -0.1, 0.9).unwrap();
        assert!((smooth.0 - 0.3).abs() < 1e-7 && (sharp.0 - 0.3).abs() < 1e-9);
    }
}
