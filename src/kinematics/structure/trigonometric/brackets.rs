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

    /// Take a root in a part of an arc, sought first at a part of the way through it, with the sign
    /// of the value before it.
    pub(super) fn push(&mut self, at: &Part, part: f64, sign: f64) {
        let lane = self.count % LANES;
        let Some(block) = self.blocks.get_mut(self.count / LANES) else {
            self.is_complete = false;
            return;
        };
        // The first of a block stands in its other lanes until there are others.
        let lanes = if lane == 0 { 0..LANES } else { lane..lane + 1 };
        let Part { of, arc, low, high, .. } = *at;
        block.of[lanes.clone()].fill(of);
        block.middles[lanes.clone()].fill(middle(arc));
        block.lows[lanes.clone()].fill(low);
        block.highs[lanes.clone()].fill(high);
        block.starts[lanes.clone()].fill(low + part * (high - low));
        block.signs[lanes].fill(sign);
        self.count += 1;
    }
}
