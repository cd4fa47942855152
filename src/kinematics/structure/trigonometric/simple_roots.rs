//! The roots of several polynomials, each of which has simple ones alone.

use arrayvec::ArrayVec;
use fearless_simd::Simd;

use super::brackets::{Brackets, MOST_BRACKETS};
use super::clusters::{Clusters, Progress};
use super::isolation::Search;
use super::polynomial::TrigonometricPolynomial;
use super::refinement::Refined;
use crate::lanes::{Column, LANES};

/// The roots of up to eight polynomials. One is left, without an answer, as soon as it has a cluster
/// of roots, or takes many divisions: its answer does not depend on the others.
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
    /// The same, each root so many times: as a whole, one behind the other.
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

    /// Put a polynomial behind the others.
    pub(crate) fn push(&mut self, polynomial: TrigonometricPolynomial) {
        self.progress.push(if polynomial.is_noise() { Progress::LEFT } else { Progress::NEW });
        self.polynomials.push(polynomial);
    }

    /// Isolate the roots. Returns the number of blocks: most have the roots of one polynomial.
    pub(crate) fn isolate<S: Simd>(&mut self, simd: S) -> usize {
        let Self { polynomials, progress, brackets, order, count } = self;
        let clusters = Clusters::Left(progress);
        Search::new(brackets, clusters).isolate(simd, polynomials, &[]);
        (*order, *count) = brackets.packed(|of| !progress[of].is_left);
        count.div_ceil(LANES)
    }

    /// The roots of a block.
    pub(crate) fn block<S: Simd>(&self, simd: S, number: usize) -> RootBlock {
        let numbers = &self.order[LANES * number..self.count];
        let block = self.brackets.block(numbers);
        let Refined { angles, .. } = block.refined(simd, &self.polynomials);
        RootBlock { of: block.of, angles, count: LANES.min(numbers.len()) }
    }

    /// Whether the roots of a polynomial are all that it has.
    pub(crate) fn are_all(&self, number: usize) -> bool {
        self.brackets.is_complete && !self.progress[number].is_left
    }
}
