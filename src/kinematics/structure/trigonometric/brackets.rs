//! Simple roots between places of an arc, before they are refined.

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

impl BracketBlock {
    pub(super) const NONE: Self = Self {
        of: [0; LANES],
        middles: [0.0; LANES],
        lows: [0.0; LANES],
        highs: [0.0; LANES],
        starts: [0.0; LANES],
        signs: [0.0; LANES],
    };

    /// Put a bracket in a lane.
    #[inline(always)]
    fn put(&mut self, lane: usize, of: usize, [middle, low, high, start, sign]: [f64; 5]) {
        self.of[lane] = of;
        self.middles[lane] = middle;
        (self.lows[lane], self.highs[lane], self.starts[lane]) = (low, high, start);
        self.signs[lane] = sign;
    }

    /// Repeat the first bracket in lanes without one.
    fn fill(&mut self, lanes: usize) {
        let (of, bracket) = self.bracket(0);
        for lane in lanes..LANES {
            self.put(lane, of, bracket);
        }
    }

    /// The bracket in a lane.
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
pub(super) struct Brackets<'a> {
    pub(super) blocks: &'a mut [BracketBlock],
    pub(super) count: usize,
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

impl<'a> Brackets<'a> {
    pub(super) fn none(blocks: &'a mut [BracketBlock]) -> Self {
        Self { blocks, count: 0, is_complete: true }
    }

    /// Repeat the first bracket of the last block in its lanes without one.
    pub(super) fn fill(&mut self) {
        if let Some(last) = self.blocks.get_mut(self.count / LANES) {
            last.fill(self.count % LANES);
        }
    }

    /// Put those of wanted polynomials, up to eight, in another order: first the blocks that the
    /// brackets of one polynomial fill, then the rest. Returns how many they are.
    pub(super) fn pack(
        &self,
        into: &mut [BracketBlock],
        is_wanted: impl Fn(usize) -> bool,
    ) -> usize {
        let all = (0..self.count).map(|index| self.blocks[index / LANES].bracket(index % LANES));
        let all = all.filter(|(of, _)| is_wanted(*of));
        let mut counts = [0; LANES];
        all.clone().for_each(|(of, _)| counts[of] += 1);
        // Places of the next full one and of the next of the rest, and how many are full.
        let mut next = [[0; 2]; LANES];
        let full = counts.map(|count| count - count % LANES);
        let (mut first, mut rest) = (0, full.iter().sum());
        for of in 0..LANES {
            next[of] = [first, rest];
            (first, rest) = (first + full[of], rest + counts[of] - full[of]);
        }
        let mut left = full;
        for (of, bracket) in all {
            let is_rest = usize::from(left[of] == 0);
            left[of] -= 1 - is_rest;
            let place = next[of][is_rest];
            next[of][is_rest] += 1;
            into[place / LANES].put(place % LANES, of, bracket);
        }
        if let Some(last) = into.get_mut(rest / LANES) {
            last.fill(rest % LANES);
        }
        rest
    }

    /// Take a root in a part of an arc, sought first at a part of the way through it, with the sign
    /// of the value before it.
    pub(super) fn push(&mut self, at: &Part, part: f64, sign: f64) {
        let lane = self.count % LANES;
        let Some(block) = self.blocks.get_mut(self.count / LANES) else {
            self.is_complete = false;
            return;
        };
        let Part { of, arc, low, high, .. } = *at;
        let [middle, start] = [middle(arc), low + part * (high - low)];
        block.put(lane, of, [middle, low, high, start, sign]);
        self.count += 1;
    }
}
