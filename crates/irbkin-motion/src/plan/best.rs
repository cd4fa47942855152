//! The best joint path through the layers: how wide its windows need to be, and the turns of which
//! joints need to be counted; the best closed one (docs/theory/plan.md, sections 3, 6).

use core::f64::consts::{PI, TAU};

use super::answer::PlanError;
use super::graph::Node;
use super::joints::TurnStates;
use super::ladder::Ladder;
use super::lanes::Pass;
use super::options::PlanOrder;
use super::search::{Bound, Passed, Search, SlotReach};
use super::windows::Windows;
use crate::plan::thresholds::BOTTLENECK_ROUNDING;
use crate::prelude::*;
use irbkin::internal::lanes::nearest_whole;

/// Difference in the room to joint limits that is none, as a part of half a range [1].
const SAME_ROOM: f64 = 1e-6;

/// A joint path through layers, by its nodes.
#[derive(Clone, Debug)]
pub(super) struct JointPath {
    /// The first layer.
    pub(super) from: usize,
    pub(super) nodes: Vec<Node>,
    /// Joint angles at each node, with their turns [rad].
    pub(super) q: Vec<[f64; 6]>,
    pub(super) bottleneck: f64,
    /// With the costs of its nodes.
    pub(super) squares: f64,
    /// How far each slot was reached.
    pub(super) slots: Vec<SlotReach>,
}

impl JointPath {
    pub(super) fn cost(&self, order: PlanOrder) -> (f64, f64) {
        order.cost(self.bottleneck, self.squares)
    }

    /// The layer that the joint path ends at.
    pub(super) fn reached(&self) -> usize {
        self.from + self.nodes.len() - 1
    }
}

/// A joint path modulo the turns that are not counted.
struct BestPath {
    nodes: Vec<Node>,
    /// The turns that are counted, at the beginning and at the end.
    states: [usize; 2],
    bottleneck: f64,
    squares: f64,
    slots: Vec<SlotReach>,
}

/// Nodes and turns, with the best joint path that begins at one of them and ends at one of them: no
/// closed one from there is better.
struct Region {
    bound: Bound,
    found: BestPath,
}

impl Region {
    /// Two parts that the ends of the joint path are not both in; `None` if it is closed.
    fn split(&self, numbers: [usize; 2]) -> Option<[Bound; 2]> {
        let cut = |[first, end]: [usize; 2], [one, other]: [usize; 2]| {
            let middle = (one + other).div_ceil(2);
            (one != other).then_some([[first, middle], [middle, end]])
        };
        let bound = self.bound;
        match cut(bound.nodes, numbers) {
            Some(parts) => Some(parts.map(|nodes| Bound { nodes, ..bound })),
            None => cut(bound.states, self.found.states)
                .map(|parts| parts.map(|states| Bound { states, ..bound })),
        }
    }
}

impl Ladder<'_> {
    /// The best joint path from layer `from` to the last one, or to the last one that can be
    /// reached; `None` without a node to begin at.
    ///
    /// Turns are counted only of joints for which the best joint path without would leave the
    /// limits, or cost more than at the turns amid them: it is the best under fewer conditions, so
    /// if it meets all of them, it is the best.
    pub(super) fn best_path(
        &self,
        from: usize,
        states: &mut TurnStates,
    ) -> Result<Option<JointPath>, PlanError> {
        loop {
            let Some(bounds) = self.bounds(from, states) else { return Ok(None) };
            let mut ties = self.found(from, states, bounds)?.into_iter();
            let Some(best) = ties.next() else { return Ok(None) };
            match self.with_turns(best, from, states) {
                Ok(path) => {
                    let others = ties.filter_map(|tie| self.with_turns(tie, from, states).ok());
                    return Ok(Some(self.with_most_room(path, others)));
                }
                Err(joints) => states.add(&joints, self.joints)?,
            }
        }
    }

    /// Of joint paths that cost the same, the one that leaves the most room to joint limits; if
    /// they leave the same, the one nearest to the middle of the ranges.
    fn with_most_room(
        &self,
        path: JointPath,
        others: impl Iterator<Item = JointPath>,
    ) -> JointPath {
        let limited = || (0..6).filter(|joint| !self.joints.is_unlimited(*joint));
        let rooms = |path: &JointPath| {
            let (mut room, mut off) = (1.0_f64, 0.0);
            for q in &path.q {
                for joint in limited() {
                    let [lower, upper] = self.joints.limits(joint);
                    let (middle, half) = (0.5 * (lower + upper), 0.5 * (upper - lower));
                    let own = (q[joint] - middle).abs();
                    room = room.min(1.0 - own / half);
                    off += own;
                }
            }
            (room, off)
        };
        let mut best = (rooms(&path), path);
        for path in others {
            let (room, off) = rooms(&path);
            let (most, least) = best.0;
            let is_nearer = off < least * (1.0 - BOTTLENECK_ROUNDING);
            if room > most + SAME_ROOM || (room > most - SAME_ROOM && is_nearer) {
                best = ((room, off), path);
            }
        }
        best.1
    }

    /// The best closed joint path through all layers, if there is one.
    ///
    /// Branch and bound: of the regions of nodes to begin at, the one with the best joint path is
    /// halved between the ends of that path, until they are one.
    pub(super) fn best_closed_path(
        &self,
        states: &mut TurnStates,
    ) -> Result<Option<JointPath>, PlanError> {
        'with_turns: loop {
            let Some([whole, _]) = self.bounds(0, states) else { return Ok(None) };
            let mut regions: Vec<Region> = Vec::new();
            let mut open = Vec::from([whole]);
            loop {
                for bound in open.drain(..) {
                    let found = self.found(0, states, [bound; 2])?;
                    let found = found.into_iter().next();
                    regions.extend(found.map(|found| Region { bound, found }));
                }
                let cost = |region: &Region| {
                    self.order.cost(region.found.bottleneck, region.found.squares)
                };
                let best = regions.iter().enumerate().min_by(|(_, a), (_, b)| {
                    cost(a).partial_cmp(&cost(b)).unwrap_or(core::cmp::Ordering::Equal)
                });
                let Some(best) = best.map(|(number, _)| number) else { return Ok(None) };
                let region = regions.swap_remove(best);
                let nodes = &region.found.nodes;
                let numbers = [nodes[0], nodes[nodes.len() - 1]].map(|n| self.grid.number(n));
                match region.split(numbers) {
                    Some(parts) => open.extend(parts),
                    None => match self.with_turns(region.found, 0, states) {
                        Ok(path) => return Ok(Some(path)),
                        Err(joints) => {
                            states.add(&joints, self.joints)?;
                            continue 'with_turns;
                        }
                    },
                }
            }
        }
    }

    /// The turns that a joint path must begin and end with; `None` if no state has given ones.
    fn bounds(&self, from: usize, states: &TurnStates) -> Option<[Bound; 2]> {
        let bound = |turns: Option<[i32; 6]>| match turns {
            None => Some(Bound::NONE),
            Some(turns) => {
                let state = states.state(&turns)?;
                Some(Bound { states: [state, state + 1], ..Bound::NONE })
            }
        };
        let first = self.ends.first.filter(|_| from == 0);
        Some([bound(first)?, bound(self.ends.last)?])
    }

    /// The best joint path between bounds: a closed one to the last layer, or none; others as far
    /// as they can go. The windows widen until they hold all that the best one may use (eq. 7).
    fn found(
        &self,
        from: usize,
        states: &TurnStates,
        [first, last]: [Bound; 2],
    ) -> Result<Vec<BestPath>, PlanError> {
        let mut windows = Windows::new(self);
        let pass = match self.order {
            PlanOrder::Bottleneck => Pass::Bottleneck,
            PlanOrder::Sum => Pass::Squares,
        };
        let (mut to, mut ends) = (self.layers.len() - 1, None);
        let (least, slots) = loop {
            let search = Search { ladder: *self, states, windows: &windows, first, last };
            let passed = search.pass(pass, from, to, self.speed).ok_or(PlanError::Stopped)?;
            let cheapest = search.cheapest(&passed).first().map(|end| end.cost);
            let reached = passed.reached;
            // Where branches end shows when the search went farthest.
            let farthest = ends.clone().unwrap_or_else(|| passed.slots.clone());
            if let Some(cost) = cheapest.filter(|_| reached == to) {
                if windows.hold_all(cost, from + 1..=to) {
                    if self.order == PlanOrder::Sum {
                        return Ok(self.traced(&search, &passed, from, &farthest, None));
                    }
                    windows.hold_only(cost);
                    break (cost, farthest);
                }
                windows.hold(cost);
            } else if !windows.widen(from + 1..=to.min(reached + 1)) {
                if self.whole {
                    return Ok(Vec::new());
                }
                // Paths that miss the given end go as far as the layer before it.
                let before = if reached == to { to.checked_sub(1) } else { Some(reached) };
                let is_none = |before: usize| before < from || (reached == to && to == from);
                let Some(before) = before.filter(|before| !is_none(*before)) else {
                    return Ok(Vec::new());
                };
                (to, ends) = (before, Some(farthest));
            }
        };
        let search = Search { ladder: *self, states, windows: &windows, first, last };
        let cap = least * (1.0 + BOTTLENECK_ROUNDING);
        let passed = search.pass(Pass::Squares, from, to, cap).ok_or(PlanError::Stopped)?;
        Ok(self.traced(&search, &passed, from, &slots, Some(least)))
    }

    /// The joint paths to the cheapest nodes that were reached, of each branch that costs the same.
    fn traced(
        &self,
        search: &Search<'_>,
        passed: &Passed,
        from: usize,
        slots: &[SlotReach],
        bottleneck: Option<f64>,
    ) -> Vec<BestPath> {
        let ends = search.cheapest(passed);
        let least = ends.first().map_or(0.0, |end| end.cost);
        let ties =
            ends.into_iter().take_while(|end| end.cost <= least * (1.0 + BOTTLENECK_ROUNDING));
        ties.map(|end| {
            let (nodes, begin) = search.path_to(passed, from, (end.number, end.state));
            let bottleneck = bottleneck.unwrap_or_else(|| self.bottleneck_along(&nodes, from));
            let (states, slots) = ([begin, end.state], slots.to_vec());
            BestPath { nodes, states, bottleneck, squares: end.cost, slots }
        })
        .collect()
    }

    /// The turn of a joint at the beginning of a joint path, so that it stays inside its limits and
    /// meets the ends; if there is one. Of several, the one around which the limits are
    /// even.
    fn turn_along(&self, nodes: &[Node], from: usize, joint: usize) -> Option<i32> {
        let joints = self.joints;
        let [mut low, mut high] = [i32::MIN, i32::MAX];
        let (mut shift, mut before) = (0, None);
        let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
        for (layer, node) in self.layers[from..].iter().zip(nodes) {
            let q = layer.joints(&self.grid, *node).unwrap_or_default()[joint];
            if let Some(before) = before.replace(q) {
                shift -= joints.step(joint, before, q).1;
            }
            low = low.max(-shift);
            high = high.min(joints.last_turn(joint, q) - shift);
            let angle = q + TAU * f64::from(shift);
            (least, most) = (least.min(angle), most.max(angle));
        }
        let is_whole = from + nodes.len() == self.layers.len();
        if self.ends.closed && is_whole && shift != 0 {
            return None;
        }
        let end = self.ends.last.filter(|_| is_whole).map(|turns| turns[joint] - shift);
        let begin = self.ends.first.filter(|_| from == 0).map(|turns| turns[joint]);
        if begin.zip(end).is_some_and(|(begin, end)| begin != end) {
            return None;
        }
        let given = begin.or(end);
        if joints.is_unlimited(joint) {
            return Some(given.unwrap_or_else(|| -joints.offset(joint)));
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

    /// Of the joints whose turns are not counted, those whose turns along a joint path cost more
    /// than those that the search assumed, the ones amid the limits.
    fn costlier_turns(
        &self,
        from: usize,
        rows: &[[f64; 6]],
        states: &TurnStates,
        squares: f64,
    ) -> Vec<usize> {
        let Some(cost) = self.node_cost else { return Vec::new() };
        let mut above = [0.0; 6];
        // The first node costs nothing.
        for (step, q) in rows.iter().enumerate().skip(1) {
            let amid = self.joints.amid(q);
            for joint in (0..6).filter(|joint| !states.has(*joint)) {
                if !self.joints.is_wide(joint) && (q[joint] - amid[joint]).abs() > PI {
                    let mut other = *q;
                    other[joint] = amid[joint];
                    let time = self.time(from + step);
                    above[joint] += cost.at(q, time) - cost.at(&other, time);
                }
            }
        }
        (0..6).filter(|joint| above[*joint] > BOTTLENECK_ROUNDING * squares).collect()
    }

    /// The joint angles of a joint path with their turns; otherwise joints whose turns have to be
    /// counted, because they would leave their limits, miss the ends or cost more.
    fn with_turns(
        &self,
        found: BestPath,
        from: usize,
        states: &TurnStates,
    ) -> Result<JointPath, Vec<usize>> {
        let BestPath { nodes, states: [begin, _], bottleneck, squares, slots } = found;
        let mut turns = states.turns[begin];
        for joint in (0..6).filter(|joint| !states.has(*joint)) {
            turns[joint] = self.turn_along(&nodes, from, joint).ok_or_else(|| vec![joint])?;
        }
        let mut before: Option<[f64; 6]> = None;
        let mut rows = Vec::with_capacity(nodes.len());
        for (layer, node) in self.layers[from..].iter().zip(&nodes) {
            let q = layer.joints(&self.grid, *node).unwrap_or_default();
            if let Some(before) = before.replace(q) {
                for joint in 0..6 {
                    turns[joint] -= self.joints.step(joint, before[joint], q[joint]).1;
                }
            }
            let angle = |joint: usize| self.joints.angle(joint, q[joint], turns[joint]);
            rows.push(core::array::from_fn(angle));
        }
        let costlier = self.costlier_turns(from, &rows, states, squares);
        if !costlier.is_empty() {
            return Err(costlier);
        }
        Ok(JointPath { from, nodes, q: rows, bottleneck, squares, slots })
    }
}
