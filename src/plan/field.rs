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
    pub(super) ends: Ends,
    /// Whether only ways through all layers count.
    pub(super) whole: bool,
    pub(super) order: PlanOrder,
    pub(super) soft: Option<Soft<'a>>,
    pub(super) watch: Watch<'a>,
}

impl Field<'_> {
    /// The largest bottleneck of the edges along nodes.
    pub(super) fn bottleneck_along(&self, nodes: &[Node], from: usize) -> f64 {
        let at = |step: usize| {
            let (layer, node) = (&self.layers[from + step], nodes[step]);
            (layer, layer.joints(&self.grid, node).unwrap_or_default(), node.station)
        };
        let edge = |step: usize| {
            let ((before, q_before, station_before), (layer, q, station)) =
                (at(step - 1), at(step));
            let time = layer.time - before.time;
            let from = before.values(&self.grid, station_before);
            let moved = self.freedom.moved(time, &from, &layer.values(&self.grid, station));
            Rates::of(self.joints, time).cost(&self.joints.steps(&q_before, &q), moved).0
        };
        (1..nodes.len()).map(edge).fold(0.0, f64::max)
    }
}
