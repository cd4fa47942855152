//! All real roots of a polynomial.

use core::slice;

use fearless_simd::Simd;

use super::brackets::Brackets;
use super::clusters::{Clusters, Progress};
use super::isolation::Search;
use super::polynomial::TrigonometricPolynomial;
use super::refinement::Refined;
use super::roots::{Root, Roots};
use super::tables::{DEGREE, ORDERS};
use crate::lanes::{LANES, sin_cos};

/// Highest order of a derivative that bounds the number of roots.
const MOST_MULTIPLICITY: usize = 8;

/// Order of the derivative that is only bounded, in the series of the others.
const TAYLOR: usize = 14;

impl TrigonometricPolynomial {
    /// Every real root, in a range of a full turn: complete up to the noise (eq. 96). Clusters that
    /// are known are taken as they are.
    pub(crate) fn roots<S: Simd>(&self, simd: S, known: &[Root]) -> Roots {
        let mut roots = Roots::NONE;
        if self.is_noise() {
            roots.is_complete = false;
            return roots;
        }
        for cluster in known {
            roots.push(*cluster);
        }
        let mut brackets = Brackets::new();
        let clusters = Clusters::Kept(&mut roots);
        Search::new(&mut brackets, clusters).isolate(simd, slice::from_ref(self), known);
        brackets.refine_into(simd, self, &mut roots);
        roots.join();
        for root in roots.as_mut_slice().iter_mut().filter(|root| !root.is_simple) {
            root.most = self.most_roots(*root);
        }
        roots
    }

    /// Every real root if each is simple and apart from the next; none as soon as there may be a
    /// cluster.
    pub(crate) fn simple_roots<S: Simd>(&self, simd: S) -> Option<Roots> {
        let (mut roots, mut progress) = (Roots::NONE, [Progress::NEW]);
        let mut brackets = Brackets::new();
        let clusters = Clusters::Left(&mut progress);
        Search::new(&mut brackets, clusters).isolate(simd, slice::from_ref(self), &[]);
        if self.is_noise() || progress[0].is_left || !brackets.is_complete {
            return None;
        }
        brackets.refine_into(simd, self, &mut roots);
        roots.join();
        Some(roots)
    }

    /// Most roots in an interval: k if the derivative of order k has no zero there, by Rolle's
    /// theorem. It is that in the middle, less what the derivatives of higher order change it by up
    /// to the ends, and what noise may be of it.
    fn most_roots(&self, root: Root) -> usize {
        let (sin, cos) = sin_cos::<false>(root.angle());
        let mut orders: [f64; DEGREE + 1] = [1.0; DEGREE + 1];
        let (mut derivatives, mut noises) = ([0.0; TAYLOR + 1], [0.0; TAYLOR + 1]);
        // What the last one may be anywhere.
        let mut bound = 0.0;
        for order in 0..=TAYLOR {
            let (mut s, mut c) = (0.0, 1.0);
            bound = 0.0;
            for k in 0..=DEGREE {
                // The derivative of order 1 of a cosine is minus the sine, and so on.
                let (a, b) = (self.cos[k] * orders[k], self.sin[k] * orders[k]);
                derivatives[order] += match order % 4 {
                    0 => a * c + b * s,
                    1 => b * c - a * s,
                    2 => -a * c - b * s,
                    _ => a * s - b * c,
                };
                bound += a.abs() + b.abs();
                // The noise is that of the sum of all coefficients.
                noises[order] += self.noise * orders[k] * (1.0 / 9.0);
                orders[k] *= ORDERS[k];
                (s, c) = (s * cos + c * sin, c * cos - s * sin);
            }
        }
        derivatives[TAYLOR] = bound;
        let has_no_zero = |order: &usize| {
            let (mut others, mut scale) = (noises[*order], 1.0);
            for (count, above) in (1_u8..).zip(&derivatives[order + 1..]) {
                scale *= root.radius() / f64::from(count);
                others += scale * above.abs();
            }
            derivatives[*order].abs() > others
        };
        (1..=MOST_MULTIPLICITY).find(has_no_zero).unwrap_or(2 * DEGREE)
    }
}

impl Brackets {
    /// Push the roots that they hold, which are those of one polynomial.
    fn refine_into<S: Simd>(&self, simd: S, of: &TrigonometricPolynomial, roots: &mut Roots) {
        roots.is_complete &= self.is_complete;
        let count = usize::from(self.count);
        for (first, block) in (0..count).step_by(LANES).zip(&self.blocks) {
            let Refined { angles, radii } = block.refined(simd, slice::from_ref(of));
            for lane in 0..LANES.min(count - first) {
                roots.push(Root::simple(angles[lane], radii[lane]));
            }
        }
    }
}
