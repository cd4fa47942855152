//! What a search through layers needs.

use super::caller::Watch;
use super::freedom::Freedom;
use super::layer::{Grid, Layer, Node};
use super::options::PlanOrder;
use super::soft::Soft;
use super::step::Rates;
use super::turns::PlannedJoints;

/// What a way must meet at its ends.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Ends {
    /// The turns of the joints at the first and at the last pose of the path, where they are given.
    pub(super) first: Option<[i32; 6]>,
    pub(super) last: Option<[i32; 6]>,
    /// Whether a way to the last layer ends with the joint angles that it begins with.
    pub(super) closed: bool,
}

/// Layers with what a search through them needs.
#[derive(Clone, Copy)]
pub(super) struct Field<'a> {
    pub(super) grid: Grid,
    pub(super) joints: &'a PlannedJoints,
    pub(super) freedom: &'a Freedom,
    pub(super) layers: &'a [Layer],
    /// The part of the velocity limits that no joint may exceed.
    pub(super) speed: f64,
    /// What the best way costs, about, if that is known: of the cost that comes first.
    pub(super) expected: Option<f64>,
    pub(super) ends: Ends,
    /// Whether only ways through all layers count.
    pub(super) whole: bool,
    pub(super) order: PlanOrder,
    pub(super) soft: Option<Soft<'a>>,
    pub(super) watch: Watch<'a>,
}

impl Field<'_> {
    /// The bottleneck of an edge into a layer.
    pub(super) fn bottleneck(&self, layer: usize, [from, to]: [Node; 2]) -> f64 {
        let (before, layer) = (&self.layers[layer - 1], &self.layers[layer]);
        let q = [before.joints(&self.grid, from), layer.joints(&self.grid, to)];
        let [q_before, q] = q.map(Option::unwrap_or_default);
        let time = layer.time - before.time;
        let values = before.values(&self.grid, from.station);
        let moved = self.freedom.moved(time, &values, &layer.values(&self.grid, to.station));
        Rates::of(self.joints, time).cost(&self.joints.steps(&q_before, &q), moved).0
    }

    /// The largest bottleneck of the edges along nodes.
    pub(super) fn bottleneck_along(&self, nodes: &[Node], from: usize) -> f64 {
        let edges = nodes.windows(2).enumerate();
        let each = edges.map(|(step, two)| self.bottleneck(from + step + 1, [two[0], two[1]]));
        each.fold(0.0, f64::max)
    }
}
