//! The best joint path through the layers: how wide its windows need to be, and the turns of which
//! joints need to be counted; the best closed one (docs/guide/plan.md, sections 3, 6).

use alloc::vec;
use alloc::vec::Vec;
use core::f64::consts::TAU;

use super::answer::PlanError;
use super::graph::{Node, Window};
use super::joints::TurnStates;
use super::ladder::{Ladder, Most};
use super::lanes::Pass;
use super::options::PlanOrder;
use super::search::{Bound, Passed, Search, SlotReach};
use crate::kinematics::thresholds::BOTTLENECK_ROUNDING;
use crate::lanes::nearest_whole;

/// How much wider the next window may be than one that was too narrow.
const WIDER: usize = 4;

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
struct Found {
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
    found: Found,
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
    /// limits: it is the best under fewer conditions, so if it meets all of them, it is the best.
    pub(super) fn best_path(
        &self,
        from: usize,
        states: &mut TurnStates,
    ) -> Result<Option<JointPath>, PlanError> {
        loop {
            let Some(bounds) = self.bounds(from, states) else { return Ok(None) };
            let Some(found) = self.found(from, states, bounds)? else { return Ok(None) };
            match self.with_turns(found, from, states) {
                Ok(path) => return Ok(Some(path)),
                Err(joint) => states.add(joint, self.joints)?,
            }
        }
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
                        Err(joint) => {
                            states.add(joint, self.joints)?;
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
    ) -> Result<Option<Found>, PlanError> {
        // Beyond, every edge is too fast.
        let widest = if self.speed.is_finite() {
            self.windows(Most::Bottleneck(self.speed))
        } else {
            vec![self.grid.full_window(); self.layers.len()]
        };
        let needed_for = |most: f64| {
            let needed = self.windows(match self.order {
                PlanOrder::Bottleneck => Most::Bottleneck(most),
                PlanOrder::Sum => Most::Sum(most),
            });
            combined(&needed, &widest, usize::min)
        };
        let mut windows = match self.expected {
            Some(expected) => needed_for(expected),
            None => combined(&widest, &widest, |size, _| size.min(1)),
        };
        let pass = match self.order {
            PlanOrder::Bottleneck => Pass::Bottleneck,
            PlanOrder::Sum => Pass::Squares,
        };
        let (mut to, mut ends) = (self.layers.len() - 1, None);
        let (least, slots) = loop {
            let search = Search { ladder: *self, states, windows: &windows, first, last };
            let passed = search.pass(pass, from, to, self.speed).ok_or(PlanError::Stopped)?;
            let cheapest = search.cheapest(&passed);
            let reached = passed.reached;
            // Where branches end shows when the search went farthest.
            let farthest = ends.clone().unwrap_or_else(|| passed.slots.clone());
            if let Some((_, _, cost)) = cheapest.filter(|_| reached == to) {
                let needed = needed_for(cost);
                let wider = combined(&windows, &needed, usize::max);
                if wider == windows {
                    if self.order == PlanOrder::Sum {
                        return Ok(self.traced(&search, &passed, from, farthest, None));
                    }
                    windows = needed;
                    break (cost, farthest);
                }
                windows = wider;
            } else if windows != widest {
                let wider = combined(&windows, &windows, |size, _| WIDER * size.max(1));
                windows = combined(&wider, &widest, usize::min);
            } else if self.whole {
                return Ok(None);
            } else {
                // Paths that miss the given end go as far as the layer before it.
                let before = if reached == to { to.checked_sub(1) } else { Some(reached) };
                let is_none = |before: usize| before < from || (reached == to && to == from);
                let Some(before) = before.filter(|before| !is_none(*before)) else {
                    return Ok(None);
                };
                (to, ends) = (before, Some(farthest));
            }
        };
        let search = Search { ladder: *self, states, windows: &windows, first, last };
        let cap = least * (1.0 + BOTTLENECK_ROUNDING);
        let passed = search.pass(Pass::Squares, from, to, cap).ok_or(PlanError::Stopped)?;
        Ok(self.traced(&search, &passed, from, slots, Some(least)))
    }

    /// The joint path to the cheapest node that was reached.
    fn traced(
        &self,
        search: &Search<'_>,
        passed: &Passed,
        from: usize,
        slots: Vec<SlotReach>,
        bottleneck: Option<f64>,
    ) -> Option<Found> {
        let (number, end, squares) = search.cheapest(passed)?;
        let (nodes, begin) = search.path_to(passed, from, (number, end));
        let bottleneck = bottleneck.unwrap_or_else(|| self.bottleneck_along(&nodes, from));
        Some(Found { nodes, states: [begin, end], bottleneck, squares, slots })
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

    /// The joint angles of a joint path with their turns; otherwise a joint whose turns have to be
    /// counted, because it would leave its limits or miss the ends.
    fn with_turns(
        &self,
        found: Found,
        from: usize,
        states: &TurnStates,
    ) -> Result<JointPath, usize> {
        let Found { nodes, states: [begin, _], bottleneck, squares, slots } = found;
        let mut turns = states.turns(begin);
        for joint in (0..6).filter(|joint| !states.has(*joint)) {
            turns[joint] = self.turn_along(&nodes, from, joint).ok_or(joint)?;
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
        Ok(JointPath { from, nodes, q: rows, bottleneck, squares, slots })
    }
}

/// Windows with sizes that two have together.
fn combined(one: &[Window], other: &[Window], size: impl Fn(usize, usize) -> usize) -> Vec<Window> {
    let sides =
        |own: [usize; 2], other: [usize; 2]| [0, 1].map(|side| size(own[side], other[side]));
    let window = |(own, other): (&Window, &Window)| {
        core::array::from_fn(|axis| sides(own[axis], other[axis]))
    };
    one.iter().zip(other).map(window).collect()
}
