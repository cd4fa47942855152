//! Real zeros of a quartic, each between two neighbors of its stationary points.

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

/// Maximum number of steps in which a bracketed zero is found to rounding: at least every second
/// one halves the bracket.
const ROUNDS: u32 = 120;

/// The zeros and the stationary points of a quartic, in ascending order.
pub(super) struct Places {
    pub(super) zeros: [Option<f64>; 4],
    pub(super) stationary: [Option<f64>; 3],
}

/// The zeros and stationary points of the quartic with these coefficients, constant first: the
/// zeros of each derivative separate those of the previous one. Radicals are avoided: they lose
/// half of the digits near a double zero.
pub(super) fn places(quartic: &[f64; 5]) -> Places {
    let [_, a, b, c, d] = *quartic;
    let inflection = zeros::<1>(&[6.0 * c, 24.0 * d], &[]);
    let bends = zeros::<2>(&[2.0 * b, 6.0 * c, 12.0 * d], &inflection);
    let stationary = zeros::<3>(&[a, 2.0 * b, 3.0 * c, 4.0 * d], &bends);
    Places { zeros: zeros::<4>(quartic, &stationary), stationary }
}

/// The zeros of a polynomial, constant first, separated by its stationary points.
fn zeros<const N: usize>(polynomial: &[f64], stationary: &[Option<f64>]) -> [Option<f64>; N] {
    let mut found = [None; N];
    let bound = bound(polynomial);
    let ends = stationary.iter().flatten().copied().chain([bound]);
    let mut low = -bound;
    for (place, high) in found.iter_mut().zip(ends) {
        *place = zero_between(polynomial, low, high);
        low = high;
    }
    found
}

/// Upper bound of the size of a zero (Cauchy).
fn bound(polynomial: &[f64]) -> f64 {
    let Some((leading, others)) = polynomial.split_last() else { return 0.0 };
    1.0 + others.iter().map(|other| (other / leading).abs()).fold(0.0, f64::max)
}

/// Newton's method in a bracket that is halved if a step leaves it or gains too little.
fn zero_between(polynomial: &[f64], mut low: f64, mut high: f64) -> Option<f64> {
    let (at_low, at_high) = (value(polynomial, low).0, value(polynomial, high).0);
    if !(at_low * at_high <= 0.0 && low < high) {
        return None;
    }
    let rising = at_low < 0.0 || at_high > 0.0;
    let mut at = 0.5 * (low + high);
    for round in 0..ROUNDS {
        let (here, slope) = value(polynomial, at);
        *(if (here > 0.0) == rising { &mut high } else { &mut low }) = at;
        let newton = at - here / slope;
        let middle = 0.5 * (low + high);
        let next = if round % 2 == 0 && newton > low && newton < high { newton } else { middle };
        if (next - at).abs() <= f64::EPSILON * at.abs() || !next.is_finite() {
            break;
        }
        at = next;
    }
    Some(at)
}

/// Value and slope, by Horner's scheme.
fn value(polynomial: &[f64], at: f64) -> (f64, f64) {
    polynomial
        .iter()
        .rev()
        .fold((0.0, 0.0), |(value, slope), next| (value * at + next, slope * at + value))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The quartic with these zeros.
    fn with_zeros(zeros: [f64; 4]) -> [f64; 5] {
        let mut quartic = [1.0, 0.0, 0.0, 0.0, 0.0];
        for zero in zeros {
            for power in (0..5).rev() {
                let before = if power > 0 { quartic[power - 1] } else { 0.0 };
                quartic[power] = before - zero * quartic[power];
            }
        }
        quartic
    }

    #[test]
    fn every_zero_is_found() {
        for zeros in [
            [-2.0, -0.5, 0.25, 3.0],
            [-1e3, -1.0, 1.0, 1e3],
            [-1.0, 0.5, 0.5 + 1e-5, 2.0],
            [-1.0, -1.0 + 1e-6, 1.0 - 1e-6, 1.0],
        ] {
            let found = places(&with_zeros(zeros)).zeros;
            for (found, zero) in found.iter().zip(zeros) {
                // Two zeros at a distance d are known to rounding over d.
                assert!((found.unwrap() - zero).abs() < 1e-9 * zero.abs(), "{zeros:?} {found:?}");
            }
        }
    }

    #[test]
    fn a_quartic_without_zeros_has_none_and_is_stationary_once_or_thrice() {
        let found = places(&[1.0, 0.0, 1.0, 0.0, 1.0]);
        assert!(found.zeros.iter().all(Option::is_none));
        assert!(found.stationary.iter().flatten().any(|at| at.abs() < 1e-15));
        let touching = places(&with_zeros([-1.0, -1.0, 2.0, 2.0])).stationary;
        let at = |place: f64| touching.iter().flatten().any(|at| (at - place).abs() < 1e-14);
        assert!(at(-1.0) && at(0.5) && at(2.0), "{touching:?}");
    }
}
