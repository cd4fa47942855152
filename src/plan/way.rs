//! The best way through layers: how far apart the tool angles of neighbors need to be looked at, and
//! which turns need to be told apart.

use alloc::vec;
use alloc::vec::Vec;
use core::f64::consts::TAU;

use super::layer::{Grid, Layer, Node};
use super::search::{Bound, Search};
use super::step::Pass;
use super::turns::{PlannedJoints, TurnStates};
use crate::error::Error;
use crate::kinematics::thresholds::BOTTLENECK_ROUNDING;
use crate::lanes::{nearest_whole, whole_below};

/// How much wider the next window may be than one that was too narrow.
const WIDER: usize = 4;

/// What a way must meet at its ends.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Ends {
    /// The turns of the joints at the first and at the last pose of the path, where they are given.
    pub(super) first: Option<[i32; 6]>,
    pub(super) last: Option<[i32; 6]>,
    /// The node where a closed way begins and ends.
    pub(super) closed_at: Option<usize>,
}

/// A way through layers: continuous, as far as its nodes tell.
#[derive(Clone, Debug)]
pub(super) struct Way {
    /// The first layer.
    pub(super) from: usize,
    pub(super) nodes: Vec<Node>,
    /// Joint angles at each node, with their turns [rad].
    pub(super) q: Vec<[f64; 6]>,
    pub(super) bottleneck: f64,
    pub(super) squares: f64,
    /// The last layer where each slot was reached.
    pub(super) alive: Vec<usize>,
}

impl Way {
    /// The layer that the way ends at.
    pub(super) fn reached(&self) -> usize {
        self.from + self.nodes.len() - 1
    }

    /// Whether the bottleneck or, if it is the same, the sum of squares is smaller.
    pub(super) fn is_better_than(&self, other: &Self) -> bool {
        (self.bottleneck, self.squares) < (other.bottleneck, other.squares)
    }
}

/// Layers with what a search through them needs.
#[derive(Clone, Copy)]
pub(super) struct Field<'a> {
    pub(super) grid: Grid,
    pub(super) joints: &'a PlannedJoints,
    pub(super) layers: &'a [Layer],
    /// The part of the velocity limits that no joint may exceed.
    pub(super) speed: f64,
    pub(super) ends: Ends,
    /// Whether tool angles a full turn apart are the same.
    pub(super) cyclic_angles: bool,
}

/// A way modulo turns of the joints that are not told apart.
struct Found {
    nodes: Vec<Node>,
    /// Turns of those that are, at the beginning.
    begin: [i32; 6],
    bottleneck: f64,
    squares: f64,
    alive: Vec<usize>,
}

impl Field<'_> {
    /// The best way from layer `from` to the last one, or to the last one that can be reached;
    /// `None` if there is no node to begin at.
    ///
    /// Turns are told apart only of joints for which the best way without would leave the limits:
    /// it is the best under fewer conditions, so if it meets all of them, it is the best.
    pub(super) fn best_way(
        &self,
        from: usize,
        states: &mut TurnStates,
    ) -> Result<Option<Way>, Error> {
        loop {
            let Some(found) = self.found_with(from, states) else { return Ok(None) };
            let mut begin = found.begin;
            let outside = (0..6).filter(|joint| !states.has(*joint)).find(|joint| {
                let turn = self.turn_along(&found.nodes, from, *joint);
                begin[*joint] = turn.unwrap_or_default();
                turn.is_none()
            });
            match outside {
                Some(joint) => states.add(joint, self.joints)?,
                None => return Ok(Some(self.unwound(found, from, begin))),
            }
        }
    }

    /// The best way with the turns of some joints told apart. A closed one begins and ends with the
    /// same.
    fn found_with(&self, from: usize, states: &TurnStates) -> Option<Found> {
        let state = |turns: &Option<[i32; 6]>| match turns {
            None => Some(None),
            // Turns that are given, but that no state has: no way.
            Some(turns) => states.state(turns).map(Some),
        };
        let first = if from == 0 { state(&self.ends.first)? } else { None };
        let last = state(&self.ends.last)?;
        let node = self.ends.closed_at;
        if node.is_none() {
            return self.found_between(
                from,
                states,
                [first, last].map(|state| Bound { node, state }),
            );
        }
        let mut best: Option<Found> = None;
        for state in 0..states.len() {
            if first.is_some_and(|first| first != state) {
                continue;
            }
            let Some(found) =
                self.found_between(from, states, [Bound { node, state: Some(state) }; 2])
            else {
                continue;
            };
            let cost = |found: &Found| (found.bottleneck, found.squares);
            if best.as_ref().is_none_or(|best| {
                found.nodes.len() > best.nodes.len()
                    || (found.nodes.len() == best.nodes.len() && cost(&found) < cost(best))
            }) {
                best = Some(found);
            }
        }
        best
    }

    fn found_between(
        &self,
        from: usize,
        states: &TurnStates,
        [first, last]: [Bound; 2],
    ) -> Option<Found> {
        let full = self.full_window();
        // Beyond, every edge is too fast.
        let widest = if self.speed.is_finite() {
            self.windows(self.speed)
        } else {
            vec![full; self.layers.len()]
        };
        let narrow = |own: &[usize; 2]| own.map(|size| size.min(1));
        let mut windows: Vec<_> = widest.iter().map(narrow).collect();
        let mut to = self.layers.len() - 1;
        let searched = |windows: &[[usize; 2]], pass: Pass, to: usize, cap: f64| {
            let Self { grid, joints, layers, .. } = *self;
            let search = Search { grid, joints, states, layers, windows, first, last };
            let passed = search.pass(pass, from, to, cap);
            let cheapest = search.cheapest(&passed);
            let way = cheapest
                .filter(|_| pass == Pass::Squares)
                .map(|(number, state, _)| search.way_to(&passed, from, (number, state)));
            (passed.reached, passed.alive, cheapest.map(|(_, _, cost)| cost), way)
        };
        let mut ends = None;
        let (bottleneck, alive) = loop {
            let (reached, alive, cost, _) = searched(&windows, Pass::Bottleneck, to, self.speed);
            // Where strands end shows when the search went farthest.
            let farthest = ends.clone().unwrap_or(alive);
            if let Some(cost) = cost.filter(|_| reached == to) {
                let needed = self.windows(cost);
                let is_enough = |(own, needed): (&[usize; 2], &[usize; 2])| {
                    own[0] >= needed[0] && own[1] >= needed[1]
                };
                if windows.iter().zip(&needed).all(is_enough) {
                    windows = needed;
                    break (cost, farthest);
                }
                for (own, needed) in windows.iter_mut().zip(needed) {
                    *own = [own[0].max(needed[0]), own[1].max(needed[1])];
                }
            } else if windows != widest {
                for (own, most) in windows.iter_mut().zip(&widest) {
                    *own = [(WIDER * own[0]).min(most[0]), (WIDER * own[1]).min(most[1])];
                }
            } else if self.ends.closed_at.is_some() {
                return None;
            } else {
                // What ends at the last layer, but not where it must, ends before it.
                let before = if reached == to { to.checked_sub(1)? } else { reached };
                if before < from || (reached == to && to == from) {
                    return None;
                }
                (to, ends) = (before, Some(farthest));
            }
        };
        let cap = bottleneck * (1.0 + BOTTLENECK_ROUNDING);
        let (_, _, squares, way) = searched(&windows, Pass::Squares, to, cap);
        let ((nodes, begin), squares) = way.zip(squares)?;
        Some(Found { nodes, begin, bottleneck, squares, alive })
    }

    /// A window of all tool angles.
    fn full_window(&self) -> [usize; 2] {
        let bins = self.grid.bins;
        if self.grid.cyclic { [(bins - 1) / 2, bins / 2] } else { [bins - 1; 2] }
    }

    /// Windows outside of which every edge has a larger bottleneck than `most` (eq. 7).
    fn windows(&self, most: f64) -> Vec<[usize; 2]> {
        let (full, step) = (self.full_window(), self.grid.step);
        let fastest: f64 = self.joints.velocity.iter().sum();
        let window = |(layer, before): (&Layer, &Layer)| {
            let time = layer.time - before.time;
            let turn = layer.turn.map_or(0.0, |turn| turn.angle);
            // The angle of a joint vector that is given is next to that of its bin.
            let beside = if before.own.or(layer.own).is_some() { step } else { 0.0 };
            let angle = turn + most * time * fastest + beside;
            let shift = before.base - layer.base;
            let shift = if self.cyclic_angles { wrapped(shift) } else { shift };
            let size = |angle: f64, full: usize| {
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    clippy::cast_precision_loss,
                    reason = "at most the number of tool angles; NaN of a single one is 0"
                )]
                let size = whole_below(angle / step + 1e-6).clamp(0.0, full as f64) as usize;
                size
            };
            [size(angle + shift, full[0]), size(angle - shift, full[1])]
        };
        // The first one has nothing before it.
        let before = self.layers.iter().take(1).chain(self.layers);
        self.layers.iter().zip(before).map(window).collect()
    }

    /// The turn of a joint at the beginning of a way, so that it stays inside its limits and meets
    /// the ends; `None` if there is none. Of several, that around which the limits are even.
    fn turn_along(&self, nodes: &[Node], from: usize, joint: usize) -> Option<i32> {
        let joints = self.joints;
        let mut range: Option<[i32; 2]> = None;
        let (mut shift, mut before) = (0, None);
        let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
        for (layer, node) in self.layers[from..].iter().zip(nodes) {
            let q = layer.joints(&self.grid, *node).unwrap_or_default()[joint];
            if let Some(before) = before {
                shift -= joints.step(joint, before, q).1;
            }
            before = Some(q);
            let [low, high] = range.unwrap_or([i32::MIN, i32::MAX]);
            range = Some([low.max(-shift), high.min(joints.last_turn(joint, q) - shift)]);
            let angle = q + TAU * f64::from(shift);
            (least, most) = (least.min(angle), most.max(angle));
        }
        let is_whole = from + nodes.len() == self.layers.len();
        if self.ends.closed_at.is_some() && is_whole && shift != 0 {
            return None;
        }
        let end = self.ends.last.filter(|_| is_whole).map(|turns| turns[joint] - shift);
        let begin = self.ends.first.filter(|_| from == 0).map(|turns| turns[joint]);
        if let (Some(begin), Some(end)) = (begin, end)
            && begin != end
        {
            return None;
        }
        let [low, high] = range?;
        let given = begin.or(end);
        if joints.is_unlimited(joint) {
            return Some(given.unwrap_or_else(|| joints.no_turn(joint)));
        }
        match given {
            Some(turn) => (low..=high).contains(&turn).then_some(turn),
            None if low > high => None,
            None => {
                let [lower, upper] = joints.limits(joint);
                let turns = nearest_whole((0.5 * (lower + upper) - 0.5 * (least + most)) / TAU);
                #[expect(clippy::cast_possible_truncation, reason = "limits are few turns wide")]
                let turn = turns as i32;
                Some(turn.clamp(low, high))
            }
        }
    }

    /// The joint angles of a way with their turns.
    fn unwound(&self, found: Found, from: usize, mut turns: [i32; 6]) -> Way {
        let Found { nodes, bottleneck, squares, alive, .. } = found;
        let mut before: Option<[f64; 6]> = None;
        let mut rows = Vec::with_capacity(nodes.len());
        for (layer, node) in self.layers[from..].iter().zip(&nodes) {
            let q = layer.joints(&self.grid, *node).unwrap_or_default();
            for joint in 0..6 {
                if let Some(before) = before {
                    turns[joint] -= self.joints.step(joint, before[joint], q[joint]).1;
                }
            }
            before = Some(q);
            rows.push(core::array::from_fn(|joint| {
                self.joints.angle(joint, q[joint], turns[joint])
            }));
        }
        Way { from, nodes, q: rows, bottleneck, squares, alive }
    }
}

/// The 2 pi equivalent of an angle that is nearest to zero.
fn wrapped(angle: f64) -> f64 {
    angle - TAU * nearest_whole(angle / TAU)
}
