//! The closure along a curve as a polynomial, through its values at eight places.
//!
//! Docs: general.md, eq. 102c and 102d.

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use super::chain::{Closure, Target};
use super::curve::Curve;
use crate::lanes::LANES;

/// How far the curve is sampled to either side [rad].
pub(super) const SPAN: f64 = 0.05;

/// The samples, the zeros of the eighth Chebyshev polynomial, as parts of that.
pub(super) const SAMPLES: [f64; LANES] = [
    -0.980_785_280_403_230_4,
    -0.831_469_612_302_545_2,
    -0.555_570_233_019_602_2,
    -0.195_090_322_016_128_27,
    0.195_090_322_016_128_27,
    0.555_570_233_019_602_2,
    0.831_469_612_302_545_2,
    0.980_785_280_403_230_4,
];

/// How far the polynomial may be off a quadratic one at its complex roots, as a part of its highest
/// term [1].
const QUADRATIC: f64 = 0.1;

/// Halvings of an interval to a root: an extreme value is then known to rounding, and Newton's
/// method goes on from a root.
const HALVINGS: usize = 26;

/// A polynomial by its coefficients of powers.
pub(super) type Powers = [f64; LANES];

impl Closure {
    /// The closure along a curve, by powers of the part of the sampled way.
    pub(super) fn powers(&self, target: &Target, curve: &Curve) -> Option<Powers> {
        let wanted = SAMPLES.map(|part| Some(curve.straight_ahead(part * SPAN)));
        let points = self.points(target, &wanted);
        let mut values = [0.0; LANES];
        for (value, point) in values.iter_mut().zip(&points) {
            *value = point.as_ref()?.left;
        }
        Some(interpolated(values))
    }
}

/// The polynomial with these values at the samples, by divided differences.
pub(super) fn interpolated(values: Powers) -> Powers {
    let mut differences = values;
    for order in 1..LANES {
        for i in (order..LANES).rev() {
            let width = SAMPLES[i] - SAMPLES[i - order];
            differences[i] = (differences[i] - differences[i - 1]) / width;
        }
    }
    let mut powers = [0.0; LANES];
    for (sample, difference) in SAMPLES.iter().zip(&differences).rev() {
        for k in (1..LANES).rev() {
            powers[k] = powers[k - 1] - sample * powers[k];
        }
        powers[0] = difference - sample * powers[0];
    }
    powers
}

/// The polynomial about another place.
pub(super) fn shifted(powers: &Powers, by: f64) -> Powers {
    let mut shifted = *powers;
    for first in 0..LANES {
        for k in (first..LANES - 1).rev() {
            shifted[k] += by * shifted[k + 1];
        }
    }
    shifted
}

/// The value at a place.
pub(super) fn value(powers: &Powers, at: f64) -> f64 {
    powers.iter().rev().fold(0.0, |sum, power| sum * at + power)
}

/// The derivative.
fn derivative(powers: &Powers) -> Powers {
    let mut degree = 0.0;
    core::array::from_fn(|k| {
        degree += 1.0;
        powers.get(k + 1).map_or(0.0, |power| degree * power)
    })
}

/// The two complex roots beside a real one, where three nearly merge: their real part and the size
/// of their imaginary part.
pub(super) fn complex_beside(powers: &Powers, root: f64) -> Option<[f64; 2]> {
    // Without the factor of the root, whose coefficient is zero.
    let [_, constant, linear, square, rest @ ..] = shifted(powers, root);
    let (middle, product) = (-0.5 * linear / square, constant / square);
    let higher = rest.iter().rev().fold(0.0, |sum, power| sum * product.abs().sqrt() + power.abs());
    let is_quadratic = higher * product.abs().sqrt() <= QUADRATIC * square.abs();
    let aside = (product - middle * middle).sqrt();
    (is_quadratic && aside.is_finite()).then_some([root + middle, aside])
}

/// The roots of a polynomial between -1 and 1.
pub(super) struct SimpleRoots {
    pub(super) all: [Option<f64>; LANES],
    /// Whether there are no others: no extreme value and no end is within the noise.
    pub(super) are_all: bool,
}

impl SimpleRoots {
    /// Between two extreme values of different signs, beyond the noise, there is one root. The
    /// extreme values are where the derivative has its roots, and so on.
    pub(super) fn of(powers: &Powers, noise: f64) -> Self {
        let mut roots = Self { all: [None; LANES], are_all: true };
        let [constant, rest @ ..] = powers;
        if constant.abs() > noise + rest.iter().map(|power| power.abs()).sum::<f64>() {
            return roots;
        }
        let mut derivatives = [*powers; LANES - 1];
        for order in 1..LANES - 1 {
            derivatives[order] = derivative(&derivatives[order - 1]);
        }
        for (order, powers) in derivatives.iter().enumerate().rev() {
            let least = if order == 0 { noise } else { 0.0 };
            let (mut new, mut count) = ([None; LANES], 0);
            let mut before: Option<[f64; 2]> = None;
            for place in [Some(-1.0)].into_iter().chain(roots.all).chain([Some(1.0)]).flatten() {
                let at_place = value(powers, place);
                if at_place.abs() <= least {
                    roots.are_all &= order > 0;
                    continue;
                }
                if let Some([start, at_start]) = before
                    && (at_start < 0.0) != (at_place < 0.0)
                {
                    let is_before = |place| (value(powers, place) < 0.0) == (at_start < 0.0);
                    new[count] = Some(bisected([start, place], is_before));
                    count += 1;
                }
                before = Some([place, at_place]);
            }
            roots.all = new;
        }
        roots
    }
}

/// Where a condition ends that holds at the start of an interval.
fn bisected([mut low, mut high]: [f64; 2], holds: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        *(if holds(middle) { &mut low } else { &mut high }) = middle;
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn through(polynomial: impl Fn(f64) -> f64) -> Powers {
        interpolated(SAMPLES.map(polynomial))
    }

    #[test]
    fn every_simple_root_in_sight_is_found() {
        let all = [-0.9, -0.3, -0.29, 0.05, 0.4, 0.41, 0.8];
        for count in 0..=all.len() {
            let of = |x: f64| all[..count].iter().map(|root| x - root).product::<f64>();
            let SimpleRoots { all: found, are_all } = SimpleRoots::of(&through(of), 1e-12);
            assert!(are_all);
            assert_eq!(found.iter().flatten().count(), count);
            for (found, root) in found.iter().flatten().zip(all) {
                assert!((found - root).abs() < 1e-7, "{found} {root}");
            }
        }
    }

    #[test]
    fn a_root_that_noise_may_have_made_or_hidden_is_none() {
        for none in [|x: f64| x * x + 1e-3, |x: f64| x * x, |x: f64| 1e-13 * x, |x: f64| x - 1.1] {
            assert_eq!(SimpleRoots::of(&through(none), 1e-12).all, [None; LANES]);
        }
        // Nearly three at zero, of which one is real.
        let found = SimpleRoots::of(&through(|x: f64| x * x * x + 1e-8 * x), 1e-14);
        assert!(found.are_all && found.all[1].is_none());
        assert!(found.all[0].unwrap().abs() < 1e-7, "{:?}", found.all);
        let [middle, aside] = complex_beside(&through(|x: f64| x * x * x + 1e-4 * x), 0.0).unwrap();
        assert!(middle.abs() < 1e-9 && (aside - 1e-2).abs() < 1e-6, "{middle} {aside}");
        // Three real ones, and terms of higher order that move the complex ones.
        assert_eq!(complex_beside(&through(|x: f64| x * x * x - 1e-4 * x), 0.0), None);
        let bent = through(|x: f64| x * (1e-2 + x * x + 5.0 * x * x * x));
        assert_eq!(complex_beside(&bent, 0.0), None);
        // A double root that noise may have made, beside a simple one.
        let found = SimpleRoots::of(&through(|x: f64| x * x * (x - 0.5)), 1e-12);
        assert!(!found.are_all && found.all[1].is_none());
    }
}
