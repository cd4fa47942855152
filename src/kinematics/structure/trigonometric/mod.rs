//! Trigonometric polynomials of degree 8, from samples: their noise, and all of their real roots.
//!
//! The condition for a six-joint chain to close, as a function of one joint angle, is such a
//! polynomial. Its roots are the values of that joint in all solutions (docs/general.md, eq. 91 to
//! 96).

mod isolation;
mod refinement;
mod roots;
mod tables;
#[cfg(test)]
mod tests;

pub(crate) use roots::{MOST_ROOTS, Root, Roots};
pub(crate) use tables::{SAMPLE_COS, SAMPLE_SIN, SAMPLES};

use crate::lanes::{Column, LANES, mul_add};
use tables::{FOURIER, ORDERS};

/// Degree of the polynomials: they have up to twice as many real roots.
pub(crate) const DEGREE: usize = 8;

/// Size of the noise of a value, as a multiple of the largest surplus harmonic: the noise of a
/// value is the sum of that of 17 coefficients, of which seven surplus ones are a sample.
const NOISE_OF_SURPLUS: f64 = 8.0;

/// Rounding of a value, relative to the sum of the sizes of the coefficients.
const NOISE_OF_ROUNDING: f64 = 16.0 * f64::EPSILON;

/// `T(x) = sum over k = 0 .. 8 of cos[k] cos(k x) + sin[k] sin(k x)` (eq. 91).
#[derive(Clone, Copy, Debug)]
pub(crate) struct TrigonometricPolynomial {
    pub(crate) cos: [f64; DEGREE + 1],
    pub(crate) sin: [f64; DEGREE + 1],
    /// Size below which a value counts as either sign.
    pub(crate) noise: f64,
}

impl TrigonometricPolynomial {
    /// The polynomial through values at the [`SAMPLES`] angles `2 pi j / 24`, in that order. The
    /// harmonics 9 to 12 that the values contain are its noise (eq. 92).
    #[inline(always)]
    pub(crate) fn of_samples<const FUSED: bool>(samples: &[Column; SAMPLES / LANES]) -> Self {
        let mut harmonics = [[0.0; LANES]; 3];
        for (sample, weights) in samples.as_flattened().iter().zip(&FOURIER) {
            for column in 0..3 {
                for lane in 0..LANES {
                    harmonics[column][lane] =
                        mul_add::<FUSED>(*sample, weights[column][lane], harmonics[column][lane]);
                }
            }
        }
        let [low_cos, [cos_8, surplus @ ..], high_sin] = harmonics;
        let mut polynomial = Self { cos: [0.0; 9], sin: [0.0; 9], noise: 0.0 };
        polynomial.cos[..8].copy_from_slice(&low_cos);
        polynomial.cos[8] = cos_8;
        polynomial.sin[1..].copy_from_slice(&high_sin);
        let surplus = surplus.iter().fold(0.0_f64, |most, harmonic| most.max(harmonic.abs()));
        polynomial.noise = NOISE_OF_SURPLUS * surplus + NOISE_OF_ROUNDING * polynomial.size();
        polynomial
    }

    /// The sum of the sizes of the coefficients: no value is larger.
    pub(crate) fn size(&self) -> f64 {
        self.cos.iter().chain(&self.sin).map(|coefficient| coefficient.abs()).sum()
    }

    /// Whether every value is below the noise: nothing is known of the roots.
    pub(crate) fn is_noise(&self) -> bool {
        // A polynomial with a coefficient that is not a number is noise too.
        let most = self.cos.iter().chain(&self.sin).fold(0.0_f64, |most, c| most.max(c.abs()));
        !(most > self.noise && self.size().is_finite())
    }

    /// The values and the derivatives at angles with these sines and cosines.
    #[inline(always)]
    pub(crate) fn values<const FUSED: bool>(&self, sin: &Column, cos: &Column) -> [Column; 2] {
        // Horner's rule in powers of exp(i x): the value is the real part of the sum of
        // (cos[k] - i sin[k]) exp(i k x), the derivative that of its k i fold.
        let mut sums = [[[0.0; LANES]; 2]; 2];
        for k in (1..=DEGREE).rev() {
            let (of_cos, of_sin) = (self.cos[k], -self.sin[k]);
            let [[re, im], [slope_re, slope_im]] = &mut sums;
            for lane in 0..LANES {
                let (a, b) = (re[lane] + of_cos, im[lane] + of_sin);
                re[lane] = mul_add::<FUSED>(a, cos[lane], -(b * sin[lane]));
                im[lane] = mul_add::<FUSED>(a, sin[lane], b * cos[lane]);
                let a = mul_add::<FUSED>(ORDERS[k], of_cos, slope_re[lane]);
                let b = mul_add::<FUSED>(ORDERS[k], of_sin, slope_im[lane]);
                slope_re[lane] = mul_add::<FUSED>(a, cos[lane], -(b * sin[lane]));
                slope_im[lane] = mul_add::<FUSED>(a, sin[lane], b * cos[lane]);
            }
        }
        let [[mut value, _], [_, mut slope]] = sums;
        for lane in 0..LANES {
            value[lane] += self.cos[0];
            slope[lane] = -slope[lane];
        }
        [value, slope]
    }
}
