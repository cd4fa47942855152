//! The cheapest joint path through the layers by dynamic programming: exact, linear in the number
//! of layers, no edge stored (docs/theory/plan.md, eq. 5, 6).

use super::graph::{Edge, Node, Window};
use super::joints::TurnStates;
use super::ladder::Ladder;
use super::lanes::{Pass, Relaxation, Source, Target, Work};
use super::windows::Windows;
use crate::prelude::*;
use irbkin::internal::lanes::{LANES, run};

/// Sources of edges that are kept at a time.
const MOST_SOURCES: usize = 4096;

/// The nodes and turns that a joint path may begin or end with: from the first to the last but one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bound {
    pub(super) nodes: [usize; 2],
    pub(super) states: [usize; 2],
}

impl Bound {
    /// Everything.
    pub(super) const NONE: Self = Self { nodes: [0, usize::MAX], states: [0, usize::MAX] };

    fn admits(self, node: usize, state: usize) -> bool {
        let within = |[first, end]: [usize; 2], number| first <= number && number < end;
        within(self.nodes, node) && within(self.states, state)
    }
}

pub(super) struct Search<'a> {
    pub(super) ladder: Ladder<'a>,
    pub(super) states: &'a TurnStates,
    pub(super) windows: &'a Windows<'a>,
    pub(super) first: Bound,
    pub(super) last: Bound,
}

/// Costs of the best joint paths to the nodes of the layer that was reached last.
pub(super) struct Passed {
    pub(super) reached: usize,
    /// How far each slot was reached.
    pub(super) slots: Vec<SlotReach>,
    /// For each combination of turns, of each node.
    costs: Vec<f64>,
    /// Which node each node of each layer is entered from.
    by: Vec<u32>,
}

/// How far a slot was reached: the last layer, and the nodes there.
#[derive(Clone, Debug, Default)]
pub(super) struct SlotReach {
    pub(super) layer: usize,
    pub(super) nodes: Vec<usize>,
}

/// Where a joint path may end: a node with its turns, and the cost so far.
#[derive(Clone, Copy)]
pub(super) struct End {
    pub(super) number: usize,
    pub(super) state: usize,
    pub(super) cost: f64,
}

/// A step to a layer, and how it is taken.
struct Step {
    layer: usize,
    pass: Pass,
    cap: f64,
    window: Window,
}

/// The costs before and after a step, and which node each node is entered from.
struct Costs<'a> {
    before: &'a [f64],
    after: &'a mut [f64],
    by: &'a mut [u32],
    /// Whether any node is reached, for each combination of turns.
    live: &'a [bool],
}

impl Search<'_> {
    /// The best joint paths from layer `from` to each node of layer `to`, or of the last layer
    /// before it that is reached; `None` if the caller stops it.
    pub(super) fn pass(&self, pass: Pass, from: usize, to: usize, cap: f64) -> Option<Passed> {
        let Ladder { grid, layers, interrupt, .. } = self.ladder;
        // Of an interrupted plan not all layers are there.
        if interrupt.is_raised() {
            return None;
        }
        let size = self.states.len() * grid.len();
        let (mut before, mut after) = (vec![f64::INFINITY; size], vec![f64::INFINITY; size]);
        let is_summed = pass == Pass::Squares;
        let mut all_by = vec![0; if is_summed { (to - from) * size } else { 0 }];
        let mut unused = vec![0; if is_summed { 0 } else { size }];
        let mut slots = vec![SlotReach { layer: from, nodes: Vec::new() }; grid.slots];
        let mut live = vec![[true; LANES]; grid.len() / LANES];
        let mut work = Work::default();
        self.begin(from, &mut before);
        for layer in interrupt.over(from + 1..=to) {
            if interrupt.ends(layer) {
                return None;
            }
            let by = if is_summed {
                &mut all_by[(layer - from - 1) * size..(layer - from) * size]
            } else {
                &mut unused[..]
            };
            let cap = cap.min(layers[layer].cap);
            let window = self.windows.at(layer);
            let step = Step { layer, pass, cap, window };
            let is_live = |costs: &[f64]| {
                self.states.len() == 1 || costs.iter().any(|cost| *cost < f64::INFINITY)
            };
            let states: Vec<bool> = before.chunks(grid.len()).map(is_live).collect();
            let mut costs = Costs { before: &before, after: &mut after, by, live: &states };
            self.step(&step, &mut costs, &live, &mut work);
            self.relax_singly(&step, &mut costs);
            if is_summed {
                self.add_node_costs(layer, &mut after);
            }
            if !self.notes_reached(layer, [&before, &after], &mut live, &mut slots) {
                return Some(Passed { reached: layer - 1, slots, costs: before, by: all_by });
            }
            core::mem::swap(&mut before, &mut after);
        }
        Some(Passed { reached: to, slots, costs: before, by: all_by })
    }

    /// Add the cost of each node of a layer that is reached, with each combination of turns.
    fn add_node_costs(&self, layer: usize, costs: &mut [f64]) {
        let Ladder { grid, joints, layers, node_cost: Some(node_cost), .. } = self.ladder else {
            return;
        };
        for (node, q) in layers[layer].nodes(&grid) {
            let amid = joints.amid(&q);
            let own = costs.iter_mut().skip(grid.number(node)).step_by(grid.len());
            for (state, cost) in own.enumerate().filter(|(_, cost)| **cost < f64::INFINITY) {
                let turns = self.states.turns[state];
                // Of a joint whose turns are not counted, no turn costs less than the one amid.
                let q = core::array::from_fn(|joint| {
                    if !self.states.has(joint) {
                        return amid[joint];
                    }
                    joints.angle(joint, q[joint], turns[joint])
                });
                *cost += node_cost.at(&q, self.ladder.time(layer));
            }
        }
    }

    /// The nodes that a joint path may begin at cost nothing so far.
    fn begin(&self, from: usize, costs: &mut [f64]) {
        let Ladder { grid, joints, layers, .. } = self.ladder;
        let bound = if from == 0 { self.first } else { Bound::NONE };
        for (node, q) in layers[from].nodes(&grid) {
            let number = grid.number(node);
            for state in 0..self.states.len() {
                if bound.admits(number, state) && self.states.holds(joints, &q, state) {
                    costs[state * grid.len() + number] = 0.0;
                }
            }
        }
    }

    /// Note the nodes and slots of a layer that are reached; whether there are any.
    fn notes_reached(
        &self,
        layer: usize,
        [before, after]: [&[f64]; 2],
        live: &mut [[bool; LANES]],
        slots: &mut [SlotReach],
    ) -> bool {
        let grid = self.ladder.grid;
        live.fill([false; LANES]);
        for costs in after.chunks(grid.len()) {
            for (live, costs) in live.iter_mut().zip(costs.as_chunks::<LANES>().0) {
                for (live, cost) in live.iter_mut().zip(costs) {
                    *live |= *cost < f64::INFINITY;
                }
            }
        }
        for nodes in live.as_flattened().chunks(grid.width) {
            for (slot, is_reached) in slots.iter_mut().zip(nodes) {
                slot.layer = if *is_reached { layer } else { slot.layer };
            }
        }
        for (slot, own) in slots.iter_mut().enumerate().filter(|(_, own)| own.layer + 1 == layer) {
            let is_reached = |number: &usize| {
                before.iter().skip(*number).step_by(grid.len()).any(|cost| *cost < f64::INFINITY)
            };
            own.nodes = (slot..grid.len()).step_by(grid.width).filter(is_reached).collect();
        }
        slots.iter().any(|slot| slot.layer == layer)
    }

    /// The cheapest node of each slot in the layer that was reached, the cheapest of all first; in
    /// the last layer, of those where the joint path may end.
    pub(super) fn cheapest(&self, passed: &Passed) -> Vec<End> {
        let grid = self.ladder.grid;
        let is_last = passed.reached + 1 == self.ladder.layers.len();
        let bound = if is_last { self.last } else { Bound::NONE };
        let mut ends = vec![End { number: 0, state: 0, cost: f64::INFINITY }; grid.width];
        for (at, cost) in passed.costs.iter().enumerate() {
            let (state, number) = (at / grid.len(), at % grid.len());
            let end = &mut ends[number % grid.width];
            if *cost < end.cost && bound.admits(number, state) {
                *end = End { number, state, cost: *cost };
            }
        }
        ends.retain(|end| end.cost < f64::INFINITY);
        ends.sort_by(|one, other| one.cost.total_cmp(&other.cost));
        ends
    }

    /// The joint path to a node, from layer `from` on: its nodes, and its state at the beginning.
    pub(super) fn path_to(
        &self,
        passed: &Passed,
        from: usize,
        (mut number, mut state): (usize, usize),
    ) -> (Vec<Node>, usize) {
        let Ladder { grid, joints, layers, .. } = self.ladder;
        let size = self.states.len() * grid.len();
        let mut nodes = vec![grid.node(number)];
        for layer in (from + 1..=passed.reached).rev() {
            let q = layers[layer].joints(&grid, grid.node(number)).unwrap_or_default();
            let at = (layer - from - 1) * size + state * grid.len() + number;
            number = passed.by[at] as usize;
            let q_before = layers[layer - 1].joints(&grid, grid.node(number)).unwrap_or_default();
            let turns = self.states.turns[state];
            let turns_before = core::array::from_fn(|joint| {
                turns[joint] + joints.step(joint, q_before[joint], q[joint]).1
            });
            state = self.states.state(&turns_before).unwrap_or_default();
            nodes.push(grid.node(number));
        }
        nodes.reverse();
        (nodes, state)
    }

    /// Take the edges on their own branch.
    fn step(&self, step: &Step, costs: &mut Costs<'_>, live: &[[bool; LANES]], work: &mut Work) {
        let Ladder { grid, layers, .. } = self.ladder;
        let blocks = grid.width / LANES;
        costs.after.fill(f64::INFINITY);
        for (block, q) in layers[step.layer].q.iter().enumerate() {
            if q[0].iter().all(|angle| angle.is_nan()) {
                continue;
            }
            let (cell, lanes) = (block / blocks, block % blocks);
            let begin = work.sources.len();
            for from in grid.around(cell, &step.window) {
                let block = from * blocks + lanes;
                if live[block].contains(&true) {
                    let moved = self.ladder.moved(step.layer, [from, cell]);
                    work.sources.push(Source { block, live: live[block], moved });
                }
            }
            work.targets.push(Target { block, sources: [begin, work.sources.len()] });
            if work.sources.len() >= MOST_SOURCES {
                self.step_in_lanes(step, costs, work);
            }
        }
        self.step_in_lanes(step, costs, work);
    }

    /// Take the edges from sources into targets, in lanes; empty both.
    fn step_in_lanes(&self, step: &Step, costs: &mut Costs<'_>, work: &mut Work) {
        let layers = self.ladder.layers;
        macro_rules! relax {
            ($squares:literal) => {
                run(Relaxation::<'_, $squares> {
                    q: &layers[step.layer - 1].q,
                    before: costs.before.as_chunks().0,
                    next: &layers[step.layer].q,
                    after: costs.after.as_chunks_mut().0,
                    by: costs.by.as_chunks_mut().0,
                    rates: self.ladder.rates(step.layer),
                    states: self.states,
                    live: costs.live,
                    cap: step.cap,
                    work: &mut *work,
                })
            };
        }
        match step.pass {
            Pass::Bottleneck => relax!(false),
            Pass::Squares => relax!(true),
        }
        work.targets.clear();
        work.sources.clear();
    }

    /// Take the edges that lanes do not take: those into nodes with a refused edge, and those from
    /// one branch to another. Leave out the turns that a node does not have.
    fn relax_singly(&self, step: &Step, costs: &mut Costs<'_>) {
        let Ladder { grid, joints, layers, .. } = self.ladder;
        let next = &layers[step.layer];
        let mut refused: Vec<usize> = next.refused.iter().map(|[_, to]| *to).collect();
        refused.sort_unstable();
        refused.dedup();
        for number in refused {
            for state in 0..self.states.len() {
                costs.after[state * grid.len() + number] = f64::INFINITY;
            }
            self.enter(step, number, costs);
        }
        if self.states.len() > 1 {
            for (node, q) in next.nodes(&grid) {
                let own = costs.after.iter_mut().skip(grid.number(node)).step_by(grid.len());
                for (state, cost) in own.enumerate().filter(|(_, cost)| **cost < f64::INFINITY) {
                    if !self.states.holds(joints, &q, state) {
                        *cost = f64::INFINITY;
                    }
                }
            }
        }
        for edge in next.crossings.iter().filter(|edge| !next.refused.contains(edge)) {
            self.relax(step, *edge, costs);
        }
    }

    /// Take all edges on its own branch into a node.
    fn enter(&self, step: &Step, number: usize, costs: &mut Costs<'_>) {
        let Ladder { grid, layers, .. } = self.ladder;
        let node = grid.node(number);
        for cell in grid.around(node.cell, &step.window) {
            let edge = [grid.number(Node { cell, ..node }), number];
            if !layers[step.layer].refused.contains(&edge) {
                self.relax(step, edge, costs);
            }
        }
    }

    /// Take an edge if it is better than the one that was taken, for every combination of turns.
    fn relax(&self, step: &Step, edge: Edge, costs: &mut Costs<'_>) {
        let Ladder { grid, joints, layers, .. } = self.ladder;
        let [from, to] = edge.map(|number| grid.node(number));
        let q_before = layers[step.layer - 1].joints(&grid, from);
        let Some((q_before, q)) = q_before.zip(layers[step.layer].joints(&grid, to)) else {
            return;
        };
        let (mut steps, mut carried) = ([0.0; 6], [0; 6]);
        for joint in 0..6 {
            (steps[joint], carried[joint]) = joints.step(joint, q_before[joint], q[joint]);
        }
        let moved = self.ladder.moved(step.layer, [from.cell, to.cell]);
        let cost = self.ladder.rates(step.layer).cost(&steps, moved);
        if cost.0 > step.cap {
            return;
        }
        let [from, to] = edge;
        for state in (0..self.states.len()).filter(|state| self.states.holds(joints, &q, *state)) {
            let turns = self.states.turns[state];
            let turns_before = core::array::from_fn(|joint| turns[joint] + carried[joint]);
            let Some(state_before) = self.states.state(&turns_before) else { continue };
            let (before, at) = (state_before * grid.len() + from, state * grid.len() + to);
            let continued = step.pass.continued(costs.before[before], cost, step.cap);
            if continued < costs.after[at] {
                costs.after[at] = continued;
                if let Some(by) = costs.by.get_mut(at) {
                    *by = u32::try_from(from).unwrap_or_default();
                }
            }
        }
    }
}
