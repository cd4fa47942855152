//! The search over all joint paths, one after the other: the oracle of the tests.

use std::vec::Vec;

use core::f64::consts::{PI, TAU};

use super::graph::{Layer, Node};
use super::ladder::Ladder;
use super::options::PlanOrder;

/// A node with its turns.
pub(super) struct Turned {
    pub(super) number: usize,
    pub(super) node: Node,
    pub(super) q: [f64; 6],
}

/// Every node of a layer at every turn inside the limits.
pub(super) fn turned(ladder: &Ladder<'_>, layer: &Layer) -> Vec<Turned> {
    let mut all = Vec::new();
    for (node, q) in layer.nodes(&ladder.grid) {
        let mut rows = std::vec![q];
        for joint in 0..6 {
            let [lower, upper] = ladder.joints.limits(joint);
            rows = rows
                .into_iter()
                .flat_map(|row: [f64; 6]| {
                    (-4..=4).filter_map(move |turn| {
                        let mut row = row;
                        row[joint] += TAU * f64::from(turn);
                        let is_inside = row[joint] >= lower && row[joint] <= upper;
                        is_inside.then_some(row)
                    })
                })
                .collect();
        }
        let number = ladder.grid.number(node);
        all.extend(rows.into_iter().map(|q| Turned { number, node, q }));
    }
    all
}

/// The bottleneck and the squares of an edge, if it exists.
pub(super) fn edge(
    ladder: &Ladder<'_>,
    layer: usize,
    from: &Turned,
    to: &Turned,
) -> Option<(f64, f64)> {
    let after = &ladder.layers[layer];
    let pair = [from.number, to.number];
    if after.refused.contains(&pair)
        || (from.node.slot != to.node.slot && !after.crossings.contains(&pair))
    {
        return None;
    }
    let time = after.time - ladder.layers[layer - 1].time;
    let (mut most, mut squares): (f64, f64) = (0.0, 0.0);
    for joint in 0..6 {
        let step = to.q[joint] - from.q[joint];
        if ladder.joints.wraps[joint] && step.abs() > PI {
            return None;
        }
        most = most.max(step.abs() / (ladder.joints.velocity[joint] * time));
        squares += ladder.joints.weights[joint] * step * step;
    }
    let at = |layer: usize, node: Node| ladder.layers[layer].values(&ladder.grid, node.cell);
    let values = at(layer - 1, from.node).into_iter().zip(at(layer, to.node));
    for (axis, (from, to)) in ladder.freedom.axes.iter().zip(values) {
        most = most.max((to - from).abs() / (axis.velocity * time));
        squares += axis.weight * (to - from) * (to - from);
    }
    squares += ladder.node_cost.map_or(0.0, |cost| cost.at(&to.q, time));
    (most <= ladder.speed).then_some((most, squares))
}

/// The best of all joint paths whose end fits their start: how many layers it has, its
/// bottleneck and its squares.
pub(super) fn exhaustive(
    ladder: &Ladder<'_>,
    fits: impl Fn(&Turned, &Turned) -> bool,
) -> (usize, f64, f64) {
    let layers: Vec<_> = ladder.layers.iter().map(|layer| turned(ladder, layer)).collect();
    let mut best = (0, f64::INFINITY, f64::INFINITY);
    let mut open: Vec<(usize, usize, usize, f64, f64)> =
        (0..layers[0].len()).map(|node| (0, node, node, 0.0, 0.0)).collect();
    while let Some((layer, start, node, most, squares)) = open.pop() {
        let is_whole = layer + 1 == layers.len();
        if is_whole && !fits(&layers[0][start], &layers[layer][node]) {
            continue;
        }
        let ((first, second), (best_first, best_second)) = match ladder.order {
            PlanOrder::Bottleneck => ((most, squares), (best.1, best.2)),
            PlanOrder::Sum => ((squares, most), (best.2, best.1)),
        };
        let is_better = layer + 1 > best.0
            || (layer + 1 == best.0
                && (first < best_first * (1.0 - 1e-12)
                    || (first <= best_first * (1.0 + 1e-12) && second < best_second)));
        if is_better {
            best = (layer + 1, most, squares);
        }
        if is_whole {
            continue;
        }
        for (next, to) in layers[layer + 1].iter().enumerate() {
            if let Some((step, own)) = edge(ladder, layer + 1, &layers[layer][node], to) {
                open.push((layer + 1, start, next, most.max(step), squares + own));
            }
        }
    }
    best
}
