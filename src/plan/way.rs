//! The best way through layers: how far apart the tool angles of neighbors need to be looked at, and
//! which turns need to be told apart.

use alloc::vec;
use alloc::vec::Vec;
use core::f64::consts::TAU;

use super::answer::PlanError;
use super::field::Field;
use super::layer::Node;
use super::options::PlanOrder;
use super::search::{Bound, Search, Window};
use super::step::Pass;
use super::turns::TurnStates;
use super::window::Most;
use crate::kinematics::thresholds::BOTTLENECK_ROUNDING;
use crate::lanes::nearest_whole;

/// How much wider the next window may be than one that was too narrow.
const WIDER: usize = 4;

/// A way through layers: continuous, as far as its nodes tell.
#[derive(Clone, Debug)]
pub(super) struct Way {
    /// The first layer.
    pub(super) from: usize,
    pub(super) nodes: Vec<Node>,
    /// Joint angles at each node, with their turns [rad].
    pub(super) q: Vec<[f64; 6]>,
    pub(super) bottleneck: f64,
    /// With what its nodes cost.
    pub(super) squares: f64,
    /// The last layer where each slot was reached.
    pub(super) alive: Vec<usize>,
}

impl Way {
    pub(super) fn cost(&self, order: PlanOrder) -> (f64, f64) {
        order.cost(self.bottleneck, self.squares)
    }

    /// The layer that the way ends at.
    pub(super) fn reached(&self) -> usize {
        self.from + self.nodes.len() - 1
    }
}

/// A way modulo turns of the joints that are not told apart.
pub(super) struct Found {
    pub(super) nodes: Vec<Node>,
    /// The turns of those that are, at the beginning and at the end.
    pub(super) states: [usize; 2],
    pub(super) bottleneck: f64,
    pub(super) squares: f64,
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
    ) -> Result<Option<Way>, PlanError> {
        loop {
            let Some(bounds) = self.bounds(from, states) else { return Ok(None) };
            let Some(found) = self.found(from, states, bounds)? else { return Ok(None) };
            match self.unwound(found, from, states) {
                Ok(way) => return Ok(Some(way)),
                Err(joint) => states.add(joint, self.joints)?,
            }
        }
    }

    /// The turns that a way must begin and end with; `None` if no state has those that are given.
    pub(super) fn bounds(&self, from: usize, states: &TurnStates) -> Option<[Bound; 2]> {
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

    /// The best way between bounds, with the turns of some joints told apart: a closed one to the
    /// last layer, or none; others as far as they can be.
    pub(super) fn found(
        &self,
        from: usize,
        states: &TurnStates,
        [first, last]: [Bound; 2],
    ) -> Result<Option<Found>, PlanError> {
        let full = self.full_window();
        // Beyond, every edge is too fast.
        let widest = if self.speed.is_finite() {
            self.windows(Most::Bottleneck(self.speed))
        } else {
            vec![full; self.layers.len()]
        };
        let needed_for = |most: f64| match self.order {
            PlanOrder::Bottleneck => self.windows(Most::Bottleneck(most)),
            PlanOrder::Sum => self.windows(Most::Sum(most)),
        };
        let within = |mut windows: Vec<Window>| {
            for (own, widest) in windows.iter_mut().zip(&widest) {
                *own = own.with(widest, usize::min);
            }
            windows
        };
        let mut windows = match self.expected {
            Some(expected) => within(needed_for(expected)),
            None => widest.iter().map(|own| own.each(|size| size.min(1))).collect(),
        };
        let mut to = self.layers.len() - 1;
        let searched = |windows: &[Window], pass: Pass, to: usize, cap: f64| {
            let Self { grid, joints, layers, freedom, soft, watch, .. } = *self;
            let search =
                Search { grid, joints, states, layers, freedom, windows, first, last, soft, watch };
            let passed = search.pass(pass, from, to, cap).ok_or(PlanError::Stopped)?;
            let cheapest = search.cheapest(&passed);
            let way = cheapest
                .filter(|_| pass == Pass::Squares)
                .map(|(number, state, _)| (search.way_to(&passed, from, (number, state)), state));
            Ok::<_, PlanError>((passed.reached, passed.alive, cheapest.map(|(_, _, at)| at), way))
        };
        let pass = match self.order {
            PlanOrder::Bottleneck => Pass::Bottleneck,
            PlanOrder::Sum => Pass::Squares,
        };
        let mut ends = None;
        let (least, alive, way) = loop {
            let (reached, alive, cost, way) = searched(&windows, pass, to, self.speed)?;
            // Where strands end shows when the search went farthest.
            let farthest = ends.clone().unwrap_or(alive);
            if let Some(cost) = cost.filter(|_| reached == to) {
                let needed = within(needed_for(cost));
                if windows
                    .iter()
                    .zip(&needed)
                    .all(|(own, needed)| own.with(needed, usize::max) == *own)
                {
                    windows = needed;
                    break (cost, farthest, way);
                }
                for (own, needed) in windows.iter_mut().zip(&needed) {
                    *own = own.with(needed, usize::max);
                }
            } else if windows != widest {
                for (own, most) in windows.iter_mut().zip(&widest) {
                    *own = own.each(|size| WIDER * size.max(1)).with(most, usize::min);
                }
            } else if self.whole {
                return Ok(None);
            } else {
                // What ends at the last layer, but not where it must, ends before it.
                let before = if reached == to { to.checked_sub(1) } else { Some(reached) };
                let is_none = |before: usize| before < from || (reached == to && to == from);
                let Some(before) = before.filter(|before| !is_none(*before)) else {
                    return Ok(None);
                };
                (to, ends) = (before, Some(farthest));
            }
        };
        let (way, squares) = match self.order {
            PlanOrder::Sum => (way, Some(least)),
            PlanOrder::Bottleneck => {
                let cap = least * (1.0 + BOTTLENECK_ROUNDING);
                let (_, _, squares, way) = searched(&windows, Pass::Squares, to, cap)?;
                (way, squares)
            }
        };
        let Some((((nodes, begin), end), squares)) = way.zip(squares) else { return Ok(None) };
        let bottleneck = match self.order {
            PlanOrder::Sum => self.bottleneck_along(&nodes, from),
            PlanOrder::Bottleneck => least,
        };
        Ok(Some(Found { nodes, states: [begin, end], bottleneck, squares, alive }))
    }

    /// The nodes of a layer that ways of bounded speed from layer `from` reach; `None` if no turns
    /// fit the ends, or the caller stops it.
    pub(super) fn reached(
        &self,
        from: usize,
        to: usize,
        states: &TurnStates,
    ) -> Option<Vec<usize>> {
        let Self { grid, joints, layers, freedom, soft, watch, .. } = *self;
        let [first, last] = self.bounds(from, states)?;
        let windows = &self.windows(Most::Bottleneck(self.speed));
        let search =
            Search { grid, joints, states, layers, freedom, windows, first, last, soft, watch };
        let passed = search.pass(Pass::Bottleneck, from, to, self.speed)?;
        Some(search.reached(&passed))
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
        if self.ends.closed && is_whole && shift != 0 {
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

    /// The joint angles of a way with their turns; a joint whose turns have to be told apart, because
    /// it would leave its limits or the ends, if there is one.
    pub(super) fn unwound(
        &self,
        found: Found,
        from: usize,
        states: &TurnStates,
    ) -> Result<Way, usize> {
        let Found { nodes, states: [begin, _], bottleneck, squares, alive } = found;
        let mut turns = states.turns(begin);
        for joint in (0..6).filter(|joint| !states.has(*joint)) {
            turns[joint] = self.turn_along(&nodes, from, joint).ok_or(joint)?;
        }
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
        Ok(Way { from, nodes, q: rows, bottleneck, squares, alive })
    }
}
