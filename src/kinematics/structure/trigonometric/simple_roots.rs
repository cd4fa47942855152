//! The roots of several polynomials, each of which has simple ones alone.

use fearless_simd::Simd;

use super::brackets::BracketBlock;
use super::clusters::{Clusters, Progress};
use super::isolation::{Room, Search, Space};
use super::polynomial::TrigonometricPolynomial;
use super::refinement::Refined;
use crate::lanes::{Column, LANES};

/// Room for the roots of several polynomials, with so many blocks of parts and of roots.
pub(crate) struct RootRoom<const MANY: usize, const PARTS: usize, const ROOTS: usize> {
    polynomials: [TrigonometricPolynomial; MANY],
    progress: [Progress; MANY],
    room: Room<PARTS, ROOTS>,
    packed: [BracketBlock; ROOTS],
}

impl<const MANY: usize, const PARTS: usize, const ROOTS: usize> RootRoom<MANY, PARTS, ROOTS> {
    pub(crate) const NEW: Self = Self {
        polynomials: [TrigonometricPolynomial::NONE; MANY],
        progress: [Progress::LEFT; MANY],
        room: Room::NEW,
        packed: [BracketBlock::NONE; ROOTS],
    };

    /// A search for the roots of so many polynomials, which are to be put.
    pub(crate) fn search(&mut self, many: usize) -> SimpleRoots<'_> {
        let Self { polynomials, progress, room, packed } = self;
        let (polynomials, progress) = (&mut polynomials[..many], &mut progress[..many]);
        let space = room.space();
        SimpleRoots { polynomials, progress, space, packed, count: 0, is_complete: true }
    }
}

/// The search for the roots of several polynomials. One is left, without an answer, as soon as it
/// has a cluster of roots, or takes many divisions: its answer does not depend on the others.
pub(crate) struct SimpleRoots<'a> {
    polynomials: &'a mut [TrigonometricPolynomial],
    progress: &'a mut [Progress],
    space: Space<'a>,
    /// The brackets that are found, in another order.
    packed: &'a mut [BracketBlock],
    count: usize,
    is_complete: bool,
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

impl SimpleRoots<'_> {
    /// Put a polynomial in a place.
    pub(crate) fn put(&mut self, number: usize, polynomial: TrigonometricPolynomial) {
        let is_noise = polynomial.is_noise();
        self.progress[number] = if is_noise { Progress::LEFT } else { Progress::NEW };
        self.polynomials[number] = polynomial;
    }

    /// Isolate the roots. Returns the number of blocks: most have the roots of one polynomial.
    pub(crate) fn isolate<S: Simd>(&mut self, simd: S) -> usize {
        let Self { polynomials, progress, space, packed, .. } = self;
        let mut search = space.search(Clusters::Left(progress));
        search.isolate(simd, polynomials, &[]);
        let Search { brackets, .. } = search;
        self.count = brackets.pack(packed, |of| !progress[of].is_left);
        self.is_complete = brackets.is_complete;
        self.count.div_ceil(LANES)
    }

    /// The roots of a block.
    pub(crate) fn block<S: Simd>(&self, simd: S, number: usize) -> RootBlock {
        let block = &self.packed[number];
        let count = LANES.min(self.count - LANES * number);
        let Refined { angles, .. } = block.refined(simd, self.polynomials);
        RootBlock { of: block.of, angles, count }
    }

    /// Whether the roots of a polynomial are all that it has.
    pub(crate) fn are_all(&self, number: usize) -> bool {
        self.is_complete && !self.progress[number].is_left
    }
}
