//! All real roots of a polynomial.

use fearless_simd::Simd;

use super::polynomial::TrigonometricPolynomial;
use super::roots::{Root, Roots};
use super::tables::{DEGREE, ORDERS};
use crate::lanes::sin_cos;

/// Highest order of a derivative that bounds the number of roots.
const MOST_MULTIPLICITY: usize = 6;

impl TrigonometricPolynomial {
    /// Every real root, in a range of a full turn: complete up to the noise (eq. 96). Clusters that
    /// are known are taken as they are.
    pub(crate) fn roots<S: Simd>(&self, simd: S, known: &[Root]) -> Roots {
        // A function of its own for each instruction set: it is long.
        simd.vectorize(
            #[inline(always)]
            || self.roots_in(simd, known),
        )
    }

    #[inline(always)]
    fn roots_in<S: Simd>(&self, simd: S, known: &[Root]) -> Roots {
        let mut roots = Roots::NONE;
        if self.is_noise() {
            roots.is_complete = false;
            return roots;
        }
        let brackets = self.isolate(simd, known, &mut roots);
        roots.is_complete &= brackets.is_complete;
        self.refine(simd, &brackets, &mut roots);
        roots.join();
        for root in roots.as_mut_slice().iter_mut().filter(|root| !root.is_simple) {
            root.most = self.most_roots(*root);
        }
        roots
    }

    /// Most roots in an interval: k if the derivative of order k has no zero there, by Rolle's
    /// theorem. The derivative is that in the middle, less what it changes up to the ends and what
    /// noise may be of it.
    fn most_roots(&self, root: Root) -> usize {
        let (sin, cos) = sin_cos::<false>(root.angle());
        let mut orders: [f64; DEGREE + 1] = [1.0; DEGREE + 1];
        for order in 1..=MOST_MULTIPLICITY {
            let (mut derivative, mut next, mut noise) = (0.0, 0.0, 0.0);
            let (mut s, mut c) = (0.0, 1.0);
            for k in 0..=DEGREE {
                orders[k] *= ORDERS[k];
                // The derivative of order 1 of a cosine is minus the sine, and so on.
                let (a, b) = (self.cos[k] * orders[k], self.sin[k] * orders[k]);
                derivative += match order % 4 {
                    1 => b * c - a * s,
                    2 => -a * c - b * s,
                    3 => a * s - b * c,
                    _ => a * c + b * s,
                };
                next += ORDERS[k] * orders[k] * (self.cos[k].abs() + self.sin[k].abs());
                noise += orders[k];
                (s, c) = (s * cos + c * sin, c * cos - s * sin);
            }
            // The noise is that of the sum of all coefficients.
            let noise = self.noise * noise * (1.0 / 9.0);
            if derivative.abs() > next * root.radius() + noise {
                return order;
            }
        }
        2 * DEGREE
    }
}
