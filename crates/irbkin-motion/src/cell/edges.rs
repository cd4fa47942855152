//! Even motions in a search: proven free where that is fast, else looked at.

use core::array;

use super::block::{Looked, bits};
use super::checker::Checker;
use super::path::Motion as _;
use irbkin::internal::lanes::LANES;

impl<const N: usize> Checker<'_, N> {
    /// Whether an even motion is free: at eight states spread over it, and in each eighth, by a proof
    /// or at `blocks` more states.
    #[expect(clippy::cast_precision_loss, reason = "there are fewer than 2^52")]
    pub(crate) fn is_free_or_looked_at(&mut self, blocks: usize, ends: &[[f64; N]; 2]) -> bool {
        let eighth = |lane: usize| [lane, lane + 1].map(|end| end as f64 / LANES as f64);
        let at = |part| ends[..].range(0, [part; 2]).middle;
        if !self.are_free(1, at) {
            return false;
        }
        let ranges: [_; LANES] = array::from_fn(|lane| ends[..].range(0, eighth(lane)));
        let open = self.touching(&ranges.map(|range| range.middle), Looked::Roughly(&ranges));
        // An eighth takes a block of states at least.
        let own = blocks.div_ceil(LANES);
        if open.count_ones() as usize * own >= blocks {
            return self.are_free(blocks, at);
        }
        bits(open).all(|lane| {
            let [from, to] = eighth(lane);
            self.are_free(own, |part| at(from + part * (to - from)))
        })
    }
}
