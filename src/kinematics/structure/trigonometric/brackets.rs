//! Simple roots between places of an arc, before they are refined.

use fearless_simd::prelude::*;

use super::part::{angle, middle};
use crate::lanes::{Column, LANES, Vector};

/// Columns of lanes that hold brackets: one more than there can be roots for.
const BLOCKS: usize = 3;

/// Brackets of simple roots, in columns of lanes.
pub(super) struct Brackets {
    /// Middles of the arcs [rad].
    middles: [Column; BLOCKS],
    /// Ends of each bracket and the place where the root is sought first, on the arc.
    lows: [Column; BLOCKS],
    highs: [Column; BLOCKS],
    starts: [Column; BLOCKS],
    /// Sign of the value before each root.
    signs: [Column; BLOCKS],
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

impl Brackets {
    pub(super) const NONE: Self = Self {
        middles: [[0.0; LANES]; BLOCKS],
        lows: [[0.0; LANES]; BLOCKS],
        highs: [[0.0; LANES]; BLOCKS],
        starts: [[0.0; LANES]; BLOCKS],
        signs: [[0.0; LANES]; BLOCKS],
        count: 0,
        is_complete: true,
    };

    /// Take a root between two places of an arc, sought first at a part of the way between them,
    /// with the sign of the value before it.
    pub(super) fn push(&mut self, (arc, low, high): (usize, f64, f64), part: f64, sign: f64) {
        let (block, lane) = (self.count / LANES, self.count % LANES);
        if block == BLOCKS {
            self.is_complete = false;
            return;
        }
        // The first of a block stands in its other lanes until there are others.
        let lanes = if lane == 0 { 0..LANES } else { lane..lane + 1 };
        self.middles[block][lanes.clone()].fill(middle(arc));
        self.lows[block][lanes.clone()].fill(low);
        self.highs[block][lanes.clone()].fill(high);
        self.starts[block][lanes.clone()].fill(low + part * (high - low));
        self.signs[block][lanes].fill(sign);
        self.count += 1;
    }

    /// A block of lanes.
    #[inline(always)]
    pub(super) fn block<S: Simd>(&self, simd: S, block: usize) -> Bracket<S> {
        let middle = Vector::load_array_ref(simd, &self.middles[block]);
        Bracket {
            low: angle(middle, Vector::load_array_ref(simd, &self.lows[block])),
            high: angle(middle, Vector::load_array_ref(simd, &self.highs[block])),
            start: angle(middle, Vector::load_array_ref(simd, &self.starts[block])),
            sign: Vector::load_array_ref(simd, &self.signs[block]),
        }
    }
}
