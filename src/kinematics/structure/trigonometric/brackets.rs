//! Simple roots between places of an arc, before they are refined.

use arrayvec::ArrayVec;
use fearless_simd::prelude::*;

use super::part::{Part, angle, middle};
use crate::lanes::{Column, LANES, Vector};

/// Up to eight brackets of simple roots, lane beside lane.
#[derive(Clone, Copy)]
pub(super) struct BracketBlock {
    /// Which of several polynomials.
    pub(super) of: [usize; LANES],
    /// Middles of the arcs [rad].
    middles: Column,
    /// Ends of each bracket and the place where the root is sought first, on the arc.
    lows: Column,
    highs: Column,
    starts: Column,
    /// Sign of the value before each root.
    signs: Column,
}

/// Blocks of brackets, at most: for sixteen roots of each of eight polynomials, and one.
const MOST_BLOCKS: usize = 17;

pub(super) const MOST_BRACKETS: usize = MOST_BLOCKS * LANES;

impl BracketBlock {
    /// Broadcast a bracket to every lane.
    #[inline(always)]
    fn splat(of: usize, [middle, low, high, start, sign]: [f64; 5]) -> Self {
        Self {
            of: [of; LANES],
            middles: [middle; LANES],
            lows: [low; LANES],
            highs: [high; LANES],
            starts: [start; LANES],
            signs: [sign; LANES],
        }
    }

    #[inline(always)]
    fn put(&mut self, lane: usize, of: usize, [middle, low, high, start, sign]: [f64; 5]) {
        self.of[lane] = of;
        self.middles[lane] = middle;
        (self.lows[lane], self.highs[lane], self.starts[lane]) = (low, high, start);
        self.signs[lane] = sign;
    }

    #[inline(always)]
    fn bracket(&self, lane: usize) -> (usize, [f64; 5]) {
        let Self { of, middles, lows, highs, starts, signs } = self;
        (of[lane], [middles, lows, highs, starts, signs].map(|column| column[lane]))
    }

    #[inline(always)]
    pub(super) fn in_lanes<S: Simd>(&self, simd: S) -> Bracket<S> {
        let middle = Vector::load_array_ref(simd, &self.middles);
        Bracket {
            low: angle(middle, Vector::load_array_ref(simd, &self.lows)),
            high: angle(middle, Vector::load_array_ref(simd, &self.highs)),
            start: angle(middle, Vector::load_array_ref(simd, &self.starts)),
            sign: Vector::load_array_ref(simd, &self.signs),
        }
    }
}

/// Brackets of simple roots, in blocks of lanes.
pub(super) struct Brackets {
    pub(super) blocks: ArrayVec<BracketBlock, MOST_BLOCKS>,
    pub(super) count: u8,
    /// Whether there was room for all.
    pub(super) is_complete: bool,
}

/// Up to eight brackets [rad].
pub(super) struct Bracket<S: Simd> {
    pub(super) low: Vector<S>,
    pub(super) high: Vector<S>,
    pub(super) start: Vector<S>,
    /// Sign of the value before the root.
    pub(super) sign: Vector<S>,
}

impl Brackets {
    #[inline(always)]
    pub(super) fn new() -> Self {
        Self { blocks: ArrayVec::new(), count: 0, is_complete: true }
    }

    /// Numbers of brackets of wanted polynomials, up to eight, in another order, and how many they
    /// are: first those that fill blocks with the brackets of one polynomial, then the rest.
    pub(super) fn packed(&self, is_wanted: impl Fn(usize) -> bool) -> ([u8; MOST_BRACKETS], usize) {
        let of =
            |number: u8| self.blocks[usize::from(number) / LANES].of[usize::from(number) % LANES];
        let all = (0..self.count).filter(|number| is_wanted(of(*number)));
        let mut counts = [0; LANES];
        all.clone().for_each(|number| counts[of(number)] += 1);
        // Places of the next full one and of the next of the rest, and how many are full.
        let mut next = [[0; 2]; LANES];
        let full = counts.map(|count| count - count % LANES);
        let (mut first, mut rest) = (0, full.iter().sum());
        for of in 0..LANES {
            next[of] = [first, rest];
            (first, rest) = (first + full[of], rest + counts[of] - full[of]);
        }
        let (mut left, mut order) = (full, [0; MOST_BRACKETS]);
        for number in all {
            let of = of(number);
            let is_rest = usize::from(left[of] == 0);
            left[of] -= 1 - is_rest;
            order[next[of][is_rest]] = number;
            next[of][is_rest] += 1;
        }
        (order, rest)
    }

    /// Up to eight with these numbers, one at least; lanes without one repeat the first.
    pub(super) fn block(&self, numbers: &[u8]) -> BracketBlock {
        let bracket = |lane: usize| {
            let number = usize::from(numbers[lane]);
            self.blocks[number / LANES].bracket(number % LANES)
        };
        let (of, first) = bracket(0);
        let mut block = BracketBlock::splat(of, first);
        for lane in 1..LANES.min(numbers.len()) {
            let (of, bracket) = bracket(lane);
            block.put(lane, of, bracket);
        }
        block
    }

    /// Take a root in a part of an arc, sought first at a part of the way through it, with the sign
    /// of the value before it.
    pub(super) fn push(&mut self, at: &Part, part: f64, sign: f64) {
        let Part { of, arc, low, high, .. } = *at;
        let [middle, start] = [middle(arc), low + part * (high - low)];
        self.put(of, [middle, low, high, start, sign]);
    }

    fn put(&mut self, of: usize, bracket: [f64; 5]) {
        let (block, lane) = (usize::from(self.count) / LANES, usize::from(self.count) % LANES);
        // The first of a block stands in its other lanes until there are others.
        if lane == 0 {
            if self.blocks.try_push(BracketBlock::splat(of, bracket)).is_err() {
                self.is_complete = false;
                return;
            }
        } else {
            self.blocks[block].put(lane, of, bracket);
        }
        self.count += 1;
    }
}
