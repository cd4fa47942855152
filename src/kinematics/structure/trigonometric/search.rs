//! The search for all real roots of a trigonometric polynomial, or of several whose roots are simple.

use core::slice;

use arrayvec::ArrayVec;
use fearless_simd::Simd;

use super::brackets::{Brackets, MOST_BRACKETS};
use super::clusters::{Clusters, Progress};
use super::isolation::Search;
use super::polynomial::TrigonometricPolynomial;
use super::refinement::Refined;
use super::roots::{Root, Roots};
use super::tables::{DEGREE, ORDERS};
use crate::lanes::{Column, LANES, sin_cos};

/// Highest order of a derivative that bounds the number of roots.
const MOST_MULTIPLICITY: usize = 8;

/// Order of the derivative that is only bounded, in the series of the others.
const TAYLOR: usize = 14;

impl TrigonometricPolynomial {
    /// Return every real root, in a range of a full turn: complete up to the noise (eq. 96). Parts
    /// of arcs of a width [1] are clusters if they may have more than one.
    pub(crate) fn roots<S: Simd>(&self, simd: S, width: f64) -> Roots {
        let mut roots = Roots { all: ArrayVec::new(), is_complete: !self.is_noise() };
        if !roots.is_complete {
            return roots;
        }
        let mut brackets = Brackets::new();
        Search::new(&mut brackets, Clusters::Kept(&mut roots, width))
            .isolate(simd, slice::from_ref(self));
        roots.is_complete &= brackets.is_complete;
        let count = usize::from(brackets.count);
        for (first, block) in (0..count).step_by(LANES).zip(&brackets.blocks) {
            let Refined { angles, radii } = block.refined(simd, slice::from_ref(self));
            for lane in 0..LANES.min(count - first) {
                roots.push(Root::simple(angles[lane], radii[lane]));
            }
        }
        roots.join();
        for root in roots.all.iter_mut().filter(|root| !root.is_simple) {
            root.most = self.most_roots(root);
        }
        roots
    }

    /// Return the most roots in an interval: k if the derivative of order k has no zero there, by
    /// Rolle's theorem. It is its value in the middle, less what the derivatives of higher order
    /// change it by up to the ends, and what noise may be of it.
    fn most_roots(&self, root: &Root) -> usize {
        let (sin, cos) = sin_cos::<false>(root.angle());
        let mut orders: [f64; DEGREE + 1] = [1.0; DEGREE + 1];
        let (mut derivatives, mut noises) = ([0.0; TAYLOR + 1], [0.0; TAYLOR + 1]);
        // The most that the last one is anywhere.
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
                // The noise of a value is the sum of all coefficients' noise.
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

/// The roots of up to eight polynomials. One is abandoned, without an answer, as soon as it has a
/// cluster of roots or takes many divisions: its answer does not depend on the others.
pub(crate) struct SimpleRoots {
    polynomials: ArrayVec<TrigonometricPolynomial, LANES>,
    progress: ArrayVec<Progress, LANES>,
    brackets: Brackets,
    /// Numbers of the brackets, by blocks, and how many they are.
    order: [u8; MOST_BRACKETS],
    count: usize,
}

/// Up to eight roots [rad]: lanes without one repeat the first.
#[derive(Clone, Copy)]
pub(crate) struct RootBlock {
    /// Numbers of the polynomials.
    pub(crate) of: [usize; LANES],
    pub(crate) angles: Column,
    pub(crate) count: usize,
}

impl RootBlock {
    /// Return up to eight angles of one polynomial [rad], one at least.
    pub(crate) fn of_one(angles: &[f64]) -> Self {
        let mut block = Self { of: [0; LANES], angles: [angles[0]; LANES], count: angles.len() };
        block.angles[..angles.len()].copy_from_slice(angles);
        block
    }

    /// Repeat all roots, one time behind the other.
    #[inline(always)]
    pub(crate) fn repeated(&self, times: usize) -> Self {
        let (mut repeated, count) = (*self, self.count * times);
        for lane in self.count..count {
            repeated.of[lane] = self.of[lane % self.count];
            repeated.angles[lane] = self.angles[lane % self.count];
        }
        Self { count, ..repeated }
    }
}

impl SimpleRoots {
    #[inline(always)]
    pub(crate) fn new() -> Self {
        Self {
            polynomials: ArrayVec::new(),
            progress: ArrayVec::new(),
            brackets: Brackets::new(),
            order: [0; MOST_BRACKETS],
            count: 0,
        }
    }

    pub(crate) fn push(&mut self, polynomial: TrigonometricPolynomial) {
        let is_noise = polynomial.is_noise();
        self.progress.push(if is_noise { Progress::ABANDONED } else { Progress::NEW });
        self.polynomials.push(polynomial);
    }

    /// Isolate the roots. Returns the number of blocks: most have the roots of one polynomial.
    pub(crate) fn isolate<S: Simd>(&mut self, simd: S) -> usize {
        let Self { polynomials, progress, brackets, order, count } = self;
        Search::new(brackets, Clusters::Abandoned(progress)).isolate(simd, polynomials);
        (*order, *count) = brackets.packed(|of| !progress[of].is_abandoned);
        count.div_ceil(LANES)
    }

    /// Return the roots of a block.
    pub(crate) fn block<S: Simd>(&self, simd: S, number: usize) -> RootBlock {
        let numbers = &self.order[LANES * number..self.count];
        let block = self.brackets.block(numbers);
        let Refined { angles, .. } = block.refined(simd, &self.polynomials);
        RootBlock { of: block.of, angles, count: LANES.min(numbers.len()) }
    }

    /// Whether the roots of a polynomial are all known.
    pub(crate) fn are_all(&self, number: usize) -> bool {
        self.brackets.is_complete && !self.progress[number].is_abandoned
    }
}
