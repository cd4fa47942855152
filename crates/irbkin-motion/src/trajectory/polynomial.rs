//! Polynomials in time, by their coefficients from the constant upwards.

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

/// Coefficients of a polynomial: a cubic in a path parameter that is itself quadratic in time has
/// degree six.
pub(crate) const TERMS: usize = 7;

/// Halvings that bring a bracket of a root to the last digit.
const HALVINGS: usize = 64;

/// In how many ways so many terms are chosen of the degree [1]: a coefficient over it is a
/// difference of Bernstein coefficients.
const CHOICES: [f64; TERMS] = [1.0, 6.0, 15.0, 20.0, 15.0, 6.0, 1.0];

/// Rounding of a Bernstein coefficient, as a part of the sum of the terms' sizes [1]: it has fewer
/// than 40 operations.
const HULL_ROUNDING: f64 = 1e-14;

/// Value, first, second and third derivative at `t`.
#[inline]
pub(crate) fn derivatives(coefficients: &[f64], t: f64) -> [f64; 4] {
    let [mut value, mut first, mut second, mut third] = [0.0; 4];
    for coefficient in coefficients.iter().rev() {
        third = third * t + second;
        second = second * t + first;
        first = first * t + value;
        value = value * t + coefficient;
    }
    [value, first, 2.0 * second, 6.0 * third]
}

pub(crate) fn derivative(coefficients: &[f64; TERMS]) -> [f64; TERMS] {
    let mut derivative = [0.0; TERMS];
    let mut order = 0.0;
    for index in 1..TERMS {
        order += 1.0;
        derivative[index - 1] = order * coefficients[index];
    }
    derivative
}

/// The coefficients of the same polynomial in `t - shift`, by repeated synthetic division.
pub(crate) fn shifted(coefficients: &[f64; TERMS], shift: f64) -> [f64; TERMS] {
    let mut shifted = *coefficients;
    for lowest in 0..TERMS - 1 {
        for index in (lowest..TERMS - 1).rev() {
            shifted[index] += shift * shifted[index + 1];
        }
    }
    shifted
}

/// The largest size of the polynomial for t in 0 ..= `end`.
pub(crate) fn largest_size(coefficients: &[f64; TERMS], end: f64) -> f64 {
    let [[_, least], [_, most]] = extremes(coefficients, end);
    most.max(-least)
}

/// A number that [`largest_size`] does not exceed: the largest size of [`hull`].
pub(crate) fn size_bound(coefficients: &[f64; TERMS], end: f64) -> f64 {
    let [least, most] = hull(coefficients, end);
    most.max(-least)
}

/// Two numbers between which the polynomial is from 0 to `end`: the least and the greatest of its
/// Bernstein coefficients, and more than their rounding.
pub(crate) fn hull(coefficients: &[f64; TERMS], end: f64) -> [f64; 2] {
    let (mut power, mut sum, mut bernstein) = (1.0, 0.0, *coefficients);
    for (term, choices) in bernstein.iter_mut().zip(CHOICES) {
        *term *= power;
        sum += term.abs();
        *term /= choices;
        power *= end;
    }
    for order in 1..TERMS {
        for index in (order..TERMS).rev() {
            bernstein[index] += bernstein[index - 1];
        }
    }
    let [least, most] = bernstein
        .iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], b| [low.min(*b), high.max(*b)]);
    [least - HULL_ROUNDING * sum, most + HULL_ROUNDING * sum]
}

/// The line near which the polynomial is from `-half` to `half`: its value in the middle, how far it
/// goes to the end, and how far the polynomial is beside it at most, with rounding.
pub(crate) fn line(coefficients: &[f64; TERMS], half: f64) -> [f64; 3] {
    let [mut middle, slope, ..] = *coefficients;
    let (mut beside, mut sum, mut power) = (0.0, middle.abs() + (slope * half).abs(), half);
    for (index, coefficient) in coefficients.iter().enumerate().skip(2) {
        power *= half;
        let term = power * coefficient;
        sum += term.abs();
        if index % 2 == 0 {
            // From zero to the term.
            middle += 0.5 * term;
            beside += 0.5 * term.abs();
        } else {
            beside += term.abs();
        }
    }
    [middle, slope * half, beside + HULL_ROUNDING * sum]
}

/// The least and the greatest value from 0 to `end`, and where they are.
pub(crate) fn extremes(coefficients: &[f64; TERMS], end: f64) -> [[f64; 2]; 2] {
    let mut inner = [0.0; TERMS + 1];
    let count = critical_points(coefficients, end, &mut inner);
    let at = |t: f64| [t, derivatives(coefficients, t)[0]];
    inner[..count].iter().copied().chain([end]).map(at).fold([at(0.0); 2], |[low, high], here| {
        [if here[1] < low[1] { here } else { low }, if here[1] > high[1] { here } else { high }]
    })
}

/// The zeros of the derivative in 0 ..= `end`, in order; returns how many there are.
///
/// They are found by recursion: between two neighboring zeros of its own derivative a polynomial is
/// monotone, so halving finds what it has there, without the ill-conditioned roots of a formula.
fn critical_points(coefficients: &[f64; TERMS], end: f64, points: &mut [f64; TERMS + 1]) -> usize {
    let slope = derivative(coefficients);
    if slope[1..].iter().all(|coefficient| *coefficient == 0.0) {
        return 0;
    }
    let mut turns = [0.0; TERMS + 1];
    let count = critical_points(&slope, end, &mut turns);
    turns[count] = end;
    let (mut found, mut low) = (0, 0.0);
    for high in &turns[..=count] {
        if let Some(root) = monotone_root(&slope, low, *high)
            && found < TERMS
        {
            points[found] = root;
            found += 1;
        }
        low = *high;
    }
    found
}

/// The zero between two places between which the polynomial is monotone; `None` where it keeps its
/// sign.
pub(super) fn monotone_root(
    coefficients: &[f64; TERMS],
    mut low: f64,
    mut high: f64,
) -> Option<f64> {
    let at = |t| derivatives(coefficients, t)[0];
    let (rises, falls) = (at(low) <= 0.0 && at(high) >= 0.0, at(low) >= 0.0 && at(high) <= 0.0);
    if !rises && !falls {
        return None;
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if (at(middle) < 0.0) == rises {
            low = middle;
        } else {
            high = middle;
        }
    }
    Some(0.5 * (low + high))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_are_those_of_a_known_polynomial() {
        // 1 + 2 t - 3 t^2 + t^5
        let polynomial = [1.0, 2.0, -3.0, 0.0, 0.0, 1.0, 0.0];
        assert_eq!(derivatives(&polynomial, 2.0), [25.0, 70.0, 154.0, 240.0]);
        assert_eq!(derivatives(&derivative(&polynomial), 2.0)[0], 70.0);
        assert_eq!(derivatives(&shifted(&polynomial, 0.5), 1.5), [25.0, 70.0, 154.0, 240.0]);
    }

    #[test]
    fn the_largest_size_is_at_an_end_or_at_a_turn() {
        // t (1 - t) has its top of 1/4 at 1/2; t (t - 1)(t - 2) has sizes of 2/sqrt(27).
        assert!((largest_size(&[0.0, 1.0, -1.0, 0.0, 0.0, 0.0, 0.0], 1.0) - 0.25).abs() < 1e-16);
        let cubic = [0.0, 2.0, -3.0, 1.0, 0.0, 0.0, 0.0];
        assert!((largest_size(&cubic, 2.0) - 2.0 / 27.0_f64.sqrt()).abs() < 1e-15);
        assert!((largest_size(&cubic, 3.0) - 6.0).abs() < 1e-15);
        for polynomial in [[1.0, -2.0, 3.0, -4.0, 5.0, -6.0, 7.0], cubic, [0.1; TERMS]] {
            for end in [0.0, 1e-3, 0.9, 4.0] {
                assert!(largest_size(&polynomial, end) <= size_bound(&polynomial, end));
                let ([low, high], [[_, least], [at, most]]) =
                    (hull(&polynomial, end), extremes(&polynomial, end));
                assert!(low <= least && most <= high);
                assert_eq!(derivatives(&polynomial, at)[0], most);
                for step in 0..=100 {
                    let value = derivatives(&polynomial, end * f64::from(step) / 100.0)[0];
                    assert!(least - 1e-14 <= value && value <= most + 1e-14);
                }
            }
        }
        assert_eq!(largest_size(&[-3.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0], 5.0), 3.0);
    }
}
