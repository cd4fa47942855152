//! A trigonometric polynomial of degree 8: its coefficients, noise and values.

use fearless_simd::prelude::*;

use super::tables::{DEGREE, FOURIER, ORDERS, SAMPLES};
use crate::lanes::{LANES, Number, Vector, same, transposed};

/// Size of the noise of a value, as a multiple of the largest surplus harmonic: the noise of a
/// value is the sum of 17 coefficients' noise, of which seven surplus ones are a sample.
const NOISE_OF_SURPLUS: f64 = 8.0;

/// Size of the noise of a value that comes of a pose, as a multiple of the arithmetic's: a
/// pose is rounded ten times as often as what is calculated of it, and that changes the polynomial
/// without leaving its degree, where no surplus harmonic shows it: with det J = 0 to rounding, a
/// value that should be zero may be several times the noise of the arithmetic.
const NOISE_OF_POSE: f64 = 8.0;

/// Rounding of a value, relative to the sum of the sizes of the coefficients.
const NOISE_OF_ROUNDING: f64 = 16.0 * f64::EPSILON;

/// `T(x) = sum over k = 0 .. 8 of cos[k] cos(k x) + sin[k] sin(k x)` (eq. 91), or one in each lane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TrigonometricPolynomial<T = f64> {
    pub(crate) cos: [T; DEGREE + 1],
    pub(crate) sin: [T; DEGREE + 1],
    /// Size below which a value counts as either sign.
    pub(crate) noise: T,
    /// How far a value may be off in all: the noise, and what conditioning makes of rounding, which no
    /// surplus harmonic shows.
    pub(crate) doubt: T,
}

impl TrigonometricPolynomial {
    /// Zero everywhere.
    pub(super) const NONE: Self =
        Self { cos: [0.0; DEGREE + 1], sin: [0.0; DEGREE + 1], noise: 0.0, doubt: 0.0 };

    /// One of which nothing is known.
    pub(crate) const UNKNOWN: Self =
        Self { noise: f64::INFINITY, doubt: f64::INFINITY, ..Self::NONE };

    /// The polynomial through values at the [`SAMPLES`] angles `2 pi j / 24`, in that order. The
    /// harmonics 9 to 12 that the values contain are its noise (eq. 92).
    #[inline(always)]
    pub(crate) fn of_samples<S: Simd>(samples: &[Vector<S>; SAMPLES / LANES]) -> Self {
        let zero = samples[0].like(0.0);
        let simd = zero.token();
        let mut harmonics = [zero; 3];
        for j in 0..SAMPLES {
            let sample = zero.like(samples[j / LANES][j % LANES]);
            for column in 0..3 {
                let weights = Vector::load_array_ref(simd, &FOURIER[j][column]);
                harmonics[column] = sample.mul_add(weights, harmonics[column]);
            }
        }
        let [low_cos, [cos_8, surplus @ ..], high_sin] =
            [harmonics[0].to_array(), harmonics[1].to_array(), harmonics[2].to_array()];
        let mut polynomial = Self { cos: [0.0; 9], sin: [0.0; 9], noise: 0.0, doubt: 0.0 };
        polynomial.cos[..8].copy_from_slice(&low_cos);
        polynomial.cos[8] = cos_8;
        polynomial.sin[1..].copy_from_slice(&high_sin);
        let mut most = 0.0_f64;
        for harmonic in surplus {
            most = most.max(harmonic.abs());
        }
        polynomial.noise = NOISE_OF_SURPLUS * most + NOISE_OF_ROUNDING * polynomial.size();
        polynomial
    }

    /// Return the polynomial with the noise of the pose from which the values are.
    pub(crate) fn of_pose(self) -> Self {
        Self { noise: NOISE_OF_POSE * self.noise, ..self }
    }

    /// Return the polynomial with all that its values may be off as noise: what it shows of its roots
    /// is certain.
    pub(crate) fn in_doubt(&self) -> Self {
        let noise = self.noise.max(self.doubt);
        Self { noise, doubt: noise, ..*self }
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
}

impl<T: Number> TrigonometricPolynomial<T> {
    /// The value and the first two derivatives at an angle with this sine and cosine.
    #[inline(always)]
    pub(crate) fn values(&self, sin: T, cos: T) -> [T; 3] {
        // Horner's rule in powers of exp(i x): the value is the real part of the sum of
        // (cos[k] - i sin[k]) exp(i k x), the derivatives are of its k i fold and -k k fold.
        let zero = sin.like(0.0);
        let mut sums = [[zero; 2]; 3];
        for k in (1..=DEGREE).rev() {
            let (of_cos, of_sin, mut factor) = (self.cos[k], -self.sin[k], 1.0);
            for [re, im] in &mut sums {
                let (a, b) = (of_cos.scaled_plus(factor, *re), of_sin.scaled_plus(factor, *im));
                (*re, *im) = (a.times_minus(cos, b * sin), a.times_plus(sin, b * cos));
                factor *= ORDERS[k];
            }
        }
        let [[value, _], [_, slope], [second, _]] = sums;
        [value + self.cos[0], -slope, -second]
    }
}

impl<S: Simd> TrigonometricPolynomial<Vector<S>> {
    /// Gather the ones with the given numbers, a lane for each.
    #[inline(always)]
    pub(super) fn of_lanes(
        simd: S,
        all: &[TrigonometricPolynomial],
        numbers: &[usize; LANES],
    ) -> Self {
        let zero = Vector::splat(simd, 0.0);
        let mut lanes =
            Self { cos: [zero; DEGREE + 1], sin: [zero; DEGREE + 1], noise: zero, doubt: zero };
        if let Some(one) = same(numbers) {
            let one = &all[one];
            for k in 0..=DEGREE {
                (lanes.cos[k], lanes.sin[k]) = (zero.like(one.cos[k]), zero.like(one.sin[k]));
            }
            lanes.noise = zero.like(one.noise);
            return lanes;
        }
        let (mut cos, mut sin, mut noise) =
            ([&all[0].cos; LANES], [&all[0].sin; LANES], [0.0; LANES]);
        for lane in 0..LANES {
            let one = &all[numbers[lane]];
            (cos[lane], sin[lane], noise[lane]) = (&one.cos, &one.sin, one.noise);
        }
        let noise = Vector::load_array(simd, noise);
        Self { cos: transposed(simd, &cos), sin: transposed(simd, &sin), noise, doubt: noise }
    }
}
