//! How wide the windows of a search are: as wide as the costs found so far need, layer by layer
//! where it looks (docs/theory/plan.md, eq. 7).

use core::ops::RangeInclusive;

use super::graph::Window;
use super::ladder::{Farthest, Ladder, Most};
use super::options::PlanOrder;

/// How much wider the next window may be than one that was too narrow.
const WIDER: usize = 4;

#[derive(Clone)]
pub(super) struct Windows<'a> {
    ladder: Ladder<'a>,
    /// Beyond, every edge is too fast.
    widest: Option<Farthest>,
    /// A cost up to which all edges are inside, and how far these go.
    holds: f64,
    needed: Option<Farthest>,
    /// How many times wider they are.
    times: usize,
    /// The narrowest window, before it is made wider.
    least: usize,
}

impl<'a> Windows<'a> {
    /// For the cost that is expected; of neighboring values if none is.
    pub(super) fn new(ladder: &Ladder<'a>) -> Self {
        let widest =
            ladder.speed.is_finite().then(|| ladder.farthest(Most::Bottleneck(ladder.speed)));
        let least = usize::from(ladder.expected.is_none());
        let mut windows =
            Self { ladder: *ladder, widest, holds: 0.0, needed: None, times: 1, least };
        if let Some(expected) = ladder.expected {
            windows.hold(expected);
        }
        windows
    }

    /// Hold all edges that cost as much, and those that were held before.
    pub(super) fn hold(&mut self, cost: f64) {
        let holds = self.holds.max(cost);
        *self = Self { holds, needed: Some(self.farthest(holds)), times: 1, ..self.clone() };
    }

    /// Hold exactly the edges that cost as much.
    pub(super) fn hold_only(&mut self, cost: f64) {
        (self.holds, self.least) = (0.0, 0);
        self.hold(cost);
    }

    /// Whether all edges into layers that cost as much are inside.
    pub(super) fn hold_all(&self, cost: f64, mut layers: RangeInclusive<usize>) -> bool {
        if self.ladder.grid.cells == 1 {
            return true;
        }
        let farthest = self.farthest(cost);
        layers.all(|layer| {
            let needed =
                combined(self.ladder.window(layer, &farthest), self.widest(layer), usize::min);
            let own = self.at(layer);
            combined(own, needed, usize::max) == own
        })
    }

    /// Widen; `false` if they are as wide as they can be at all of the layers.
    pub(super) fn widen(&mut self, mut layers: RangeInclusive<usize>) -> bool {
        if self.ladder.grid.cells == 1 || layers.all(|layer| self.at(layer) == self.widest(layer)) {
            return false;
        }
        (self.times, self.least) = (WIDER * self.times, 1);
        true
    }

    pub(super) fn at(&self, layer: usize) -> Window {
        if self.ladder.grid.cells == 1 {
            return Window::default();
        }
        let needed = self.needed.as_ref().map(|farthest| self.ladder.window(layer, farthest));
        let (times, least) = (self.times, self.least);
        let wider = |size: usize, _| times * size.max(least);
        let own = needed.unwrap_or_default();
        combined(combined(own, own, wider), self.widest(layer), usize::min)
    }

    fn widest(&self, layer: usize) -> Window {
        match &self.widest {
            Some(farthest) => self.ladder.window(layer, farthest),
            None => self.ladder.grid.full_window(),
        }
    }

    fn farthest(&self, cost: f64) -> Farthest {
        self.ladder.farthest(match self.ladder.order {
            PlanOrder::Bottleneck => Most::Bottleneck(cost),
            PlanOrder::Sum => Most::Sum(cost),
        })
    }
}

/// A window with sizes that two have together.
fn combined(one: Window, other: Window, size: impl Fn(usize, usize) -> usize) -> Window {
    core::array::from_fn(|axis| [0, 1].map(|side| size(one[axis][side], other[axis][side])))
}
