//! A bound on the work of a plan: how many poses between poses are solved (docs/guide/plan.md,
//! section 4).

use core::cell::Cell;

use super::graph::Grid;

/// Solves that every search may make [1]: a seventh of a second of an arm without a closed form.
const LEAST: usize = 30_000;

/// Solves for each layer [1]: a step, followed in sixteenths.
const OF_LAYER: usize = 24;

/// Solves in the time of one that finds nothing [1]: that tries every way.
const FAILED: usize = 8;

/// Nodes that are searched in the time of one solve [1].
const NODES: usize = 256;

/// Searches of the whole grid in the bound [1].
const SEARCHES: usize = 16;

/// How many solves are left.
#[derive(Default)]
pub(super) struct Work(Cell<usize>);

impl Work {
    /// Allow as many as a search through layers may take.
    pub(super) fn refill(&self, grid: &Grid, layers: usize) {
        let searched = SEARCHES * grid.len() / NODES;
        self.0.set(LEAST.saturating_add(layers.saturating_mul(OF_LAYER + searched)));
    }

    /// Count a solve; whether it may be made.
    pub(super) fn solves(&self) -> bool {
        self.takes(1)
    }

    /// Count a solve that failed: it takes longer.
    pub(super) fn fails(&self) {
        self.takes(FAILED);
    }

    /// Count a search through layers.
    pub(super) fn searches(&self, grid: &Grid, layers: usize) {
        self.takes(1 + layers.saturating_mul(grid.len()) / NODES);
    }

    fn takes(&self, count: usize) -> bool {
        let left = self.0.get();
        self.0.set(left.saturating_sub(count));
        left >= count
    }

    pub(super) fn is_done(&self) -> bool {
        self.0.get() == 0
    }
}
