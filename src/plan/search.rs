//! The cheapest way through layers, by dynamic programming: exact, linear in the number of layers,
//! no edge stored (docs/plan.md, eq. 5, 6).

use alloc::vec;
use alloc::vec::Vec;

use super::caller::Watch;
use super::freedom::Freedom;
use super::layer::{Grid, Layer, Node};
use super::soft::Soft;
use super::stations::Reach;
use super::step::{Pass, Rates, Room};
use super::turns::{PlannedJoints, TurnStates};
use crate::lanes::LANES;

/// Marks a node that is entered by an edge from another branch, with the number of that edge.
pub(super) const CROSSED: u32 = 1 << 31;

/// The nodes and turns that a way may begin or end with: from the first to the last but one.
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

/// For the edges into a layer: where in the layer before they come from.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Window {
    /// How many bins below and above.
    pub(super) bins: [usize; 2],
    /// How far along each free axis.
    pub(super) stations: Reach,
}

/// A search through layers.
pub(super) struct Search<'a> {
    pub(super) grid: Grid,
    pub(super) joints: &'a PlannedJoints,
    pub(super) states: &'a TurnStates,
    pub(super) layers: &'a [Layer],
    pub(super) freedom: &'a Freedom,
    pub(super) windows: &'a [Window],
    pub(super) first: Bound,
    pub(super) last: Bound,
    pub(super) soft: Option<Soft<'a>>,
    pub(super) watch: Watch<'a>,
}

/// Costs of the best ways to the nodes of the layer that was reached last.
pub(super) struct Passed {
    /// That layer.
    pub(super) reached: usize,
    /// The last layer where each slot was reached.
    pub(super) alive: Vec<usize>,
    /// The places of the pass, which had layers up to the one that was asked for.
    places: Places,
    costs: Vec<f64>,
    by: Vec<u32>,
}

/// Where the costs and columns of nodes stand.
#[derive(Clone, Copy)]
pub(super) struct Places {
    pub(super) margin: usize,
    pitch: usize,
    /// Places of a column.
    pub(super) count: usize,
}

impl Places {
    fn of(grid: &Grid, widest: usize) -> Self {
        let pitch = grid.bins + 2 * widest;
        Self { margin: widest, pitch, count: 2 * widest + grid.rows() * pitch + LANES }
    }

    pub(super) fn place(self, grid: &Grid, number: usize) -> usize {
        let node = grid.node(number);
        self.row(grid.row(node.slot, node.station)) + node.bin
    }

    /// First place of a row's bins.
    pub(super) fn row(self, row: usize) -> usize {
        self.margin + row * self.pitch
    }
}

impl Search<'_> {
    /// The best ways from layer `from` to each node of layer `to`, or of the last layer before it
    /// that is reached; `None` if the caller stops it.
    pub(super) fn pass(&self, pass: Pass, from: usize, to: usize, cap: f64) -> Option<Passed> {
        let grid = &self.grid;
        let places = self.places(from, to);
        let states = self.states.len();
        let size = states * places.count;
        let mut costs = [vec![f64::INFINITY; size], vec![f64::INFINITY; size]];
        let mut q = [vec![f64::NAN; 6 * places.count], vec![f64::NAN; 6 * places.count]];
        let mut by = if pass == Pass::Squares { vec![0; (to - from) * size] } else { Vec::new() };
        let mut unused = vec![0; if pass == Pass::Squares { 0 } else { size }];
        let mut alive = vec![from; grid.slots];
        let mut live = vec![true; grid.rows()];
        let mut room = Room::default();
        let soft = self.soft.filter(|_| pass == Pass::Squares);
        let mut soft_costs = vec![0.0; if soft.is_some() { size } else { 0 }];
        self.begin(from, places, &mut costs[0]);
        self.load(places, &self.layers[from], &mut q[0]);
        self.fill_margins(places, &mut costs[0]);
        if !self.watch.goes_on() {
            return None;
        }
        for layer in from + 1..=to {
            if self.watch.ends_at(layer) {
                return None;
            }
            if let Some(soft) = soft {
                self.load_soft(places, layer, soft, &mut soft_costs);
            }
            let [before, after] = &mut q;
            self.load(places, &self.layers[layer], after);
            let [costs_before, costs_after] = &mut costs;
            let by_step = match pass {
                Pass::Squares => &mut by[(layer - from - 1) * size..(layer - from) * size],
                Pass::Bottleneck => &mut unused[..],
            };
            // Edges to another turn are infinitely fast in lanes, and are left out there.
            let cap = cap.min(self.layers[layer].cap).min(f64::MAX);
            let ends = Layers { layer, places, pass, cap, soft: &soft_costs, live: &live };
            if self.layers[layer].refused.is_empty() {
                self.step(&ends, [before, after], [costs_before, costs_after], by_step, &mut room);
            } else {
                self.step_by_itself(&ends, [costs_before, costs_after], by_step);
            }
            self.cross(&ends, [costs_before, costs_after], by_step);
            if !self.survives(places, costs_after, &mut live) {
                let [costs, _] = costs;
                return Some(Passed { reached: layer - 1, alive, places, costs, by });
            }
            for (last, rows) in alive.iter_mut().zip(live.chunks(grid.stations.len())) {
                *last = if rows.contains(&true) { layer } else { *last };
            }
            self.fill_margins(places, costs_after);
            q.swap(0, 1);
            costs.swap(0, 1);
        }
        let [costs, _] = costs;
        Some(Passed { reached: to, alive, places, costs, by })
    }

    /// What each node of a layer costs, with each combination of turns.
    fn load_soft(&self, places: Places, layer: usize, soft: Soft<'_>, costs: &mut [f64]) {
        let time = self.layers[layer].time - self.layers[layer - 1].time;
        for (node, q) in self.layers[layer].nodes(&self.grid) {
            let place = places.place(&self.grid, self.grid.number(node));
            for state in 0..self.states.len() {
                let turns = self.states.turns(state);
                let q =
                    core::array::from_fn(|joint| self.joints.angle(joint, q[joint], turns[joint]));
                costs[state * places.count + place] = soft.cost(&q, time);
            }
        }
    }

    /// The nodes that a way may begin at cost nothing so far.
    fn begin(&self, from: usize, places: Places, costs: &mut [f64]) {
        let bound = if from == 0 { self.first } else { Bound::NONE };
        for (node, q) in self.layers[from].nodes(&self.grid) {
            let number = self.grid.number(node);
            for state in 0..self.states.len() {
                if bound.admits(number, state) && self.states.holds(self.joints, &q, state) {
                    costs[state * places.count + places.place(&self.grid, number)] = 0.0;
                }
            }
        }
    }

    /// The joint angles of a layer as columns, with those from around the circle in the margins.
    fn load(&self, places: Places, layer: &Layer, q: &mut [f64]) {
        let grid = &self.grid;
        if places.margin == 0 {
            // Without margins the places are the nodes.
            for (joint, q) in q.chunks_mut(places.count).enumerate() {
                q[..grid.len()].copy_from_slice(layer.column(grid, joint));
            }
            return;
        }
        for row in 0..grid.rows() {
            if !layer.present[row] && grid.bins >= LANES {
                continue;
            }
            for joint in 0..6 {
                let angles = layer.angles(grid, row, joint);
                let start = joint * places.count + places.row(row);
                copy(angles, &mut q[start..]);
                if grid.cyclic {
                    wrap(q, start, grid.bins, places.margin);
                }
            }
        }
    }

    /// Costs in the margins: those from around the circle, or none.
    fn fill_margins(&self, places: Places, costs: &mut [f64]) {
        let (bins, margin) = (self.grid.bins, places.margin);
        if margin == 0 {
            return;
        }
        for costs in costs.chunks_mut(places.count) {
            for row in 0..self.grid.rows() {
                let start = places.row(row);
                if self.grid.cyclic {
                    wrap(costs, start, bins, margin);
                } else {
                    costs[start - margin..start].fill(f64::INFINITY);
                    costs[start + bins..start + bins + margin].fill(f64::INFINITY);
                }
            }
        }
    }

    pub(super) fn rates(&self, layer: usize) -> Rates {
        let time = self.layers[layer].time - self.layers[layer - 1].time;
        Rates::of(self.joints, time)
    }

    /// Whether any node of a layer is reached; notes the rows that are.
    fn survives(&self, places: Places, costs: &[f64], live: &mut [bool]) -> bool {
        let bins = self.grid.bins;
        for (row, live) in live.iter_mut().enumerate() {
            let start = places.row(row);
            let mut columns = costs.chunks(places.count);
            *live = columns
                .any(|costs| costs[start..start + bins].iter().any(|cost| *cost < f64::INFINITY));
        }
        live.contains(&true)
    }

    /// The cheapest node of the layer that was reached, with its turns and its cost; of the last
    /// layer, among those where the way may end.
    pub(super) fn cheapest(&self, passed: &Passed) -> Option<(usize, usize, f64)> {
        let is_last = passed.reached + 1 == self.layers.len();
        let bound = if is_last { self.last } else { Bound::NONE };
        let places = passed.places;
        let mut best: Option<(usize, usize, f64)> = None;
        for number in 0..self.grid.len() {
            for state in 0..self.states.len() {
                let place = places.place(&self.grid, number);
                let cost = passed.costs[state * places.count + place];
                let is_better = cost < best.map_or(f64::INFINITY, |(_, _, least)| least);
                if is_better && bound.admits(number, state) {
                    best = Some((number, state, cost));
                }
            }
        }
        best
    }

    /// The nodes of the layer that was reached, with any turns.
    pub(super) fn reached(&self, passed: &Passed) -> Vec<usize> {
        let is_reached = |number: &usize| {
            let place = passed.places.place(&self.grid, *number);
            let mut columns = passed.costs.chunks(passed.places.count);
            columns.any(|costs| costs[place] < f64::INFINITY)
        };
        (0..self.grid.len()).filter(is_reached).collect()
    }

    /// The way to a node, from layer `from` on: its nodes, and its state at the beginning.
    pub(super) fn way_to(
        &self,
        passed: &Passed,
        from: usize,
        (mut number, mut state): (usize, usize),
    ) -> (Vec<Node>, usize) {
        let grid = &self.grid;
        let places = passed.places;
        let size = self.states.len() * places.count;
        let mut nodes = vec![grid.node(number)];
        for layer in (from + 1..=passed.reached).rev() {
            let at = (layer - from - 1) * size + state * places.count + places.place(grid, number);
            let label = passed.by[at];
            let to = grid.node(number);
            let before = if label & CROSSED != 0 {
                self.layers[layer].crossings[(label & !CROSSED) as usize][0]
            } else {
                let mut sources = self.sources(layer, to);
                let from = sources.find(|(_, own)| *own == label);
                grid.number(from.map_or(to, |(from, _)| from))
            };
            let q = self.layers[layer].joints(grid, to).unwrap_or_default();
            let from = grid.node(before);
            let q_before = self.layers[layer - 1].joints(grid, from).unwrap_or_default();
            let turns = self.states.turns(state);
            let turns_before = core::array::from_fn(|joint| {
                turns[joint] + self.joints.step(joint, q_before[joint], q[joint]).1
            });
            state = self.states.state(&turns_before).unwrap_or_default();
            number = before;
            nodes.push(from);
        }
        nodes.reverse();
        (nodes, state)
    }

    fn places(&self, from: usize, to: usize) -> Places {
        Places::of(&self.grid, self.widest(from, to))
    }

    fn widest(&self, from: usize, to: usize) -> usize {
        let bins = self.windows[from + 1..=to].iter().flat_map(|window| window.bins);
        bins.fold(0, usize::max)
    }
}

/// The layers between which a step is taken, and how.
pub(super) struct Layers<'a> {
    /// The later one.
    pub(super) layer: usize,
    pub(super) places: Places,
    pub(super) pass: Pass,
    pub(super) cap: f64,
    /// What each node of it costs, for each combination of turns; empty if nothing.
    pub(super) soft: &'a [f64],
    /// Which rows of the earlier one are reached.
    pub(super) live: &'a [bool],
}

/// Copy a few numbers: by lanes, without a call.
fn copy(from: &[f64], to: &mut [f64]) {
    let (lanes, rest) = from.as_chunks::<LANES>();
    let (to_lanes, _) = to.as_chunks_mut::<LANES>();
    for (from, to) in lanes.iter().zip(to_lanes) {
        *to = *from;
    }
    for (from, to) in rest.iter().zip(&mut to[LANES * lanes.len()..]) {
        *to = *from;
    }
}

/// Copy both ends of a run of numbers to the margins beyond the opposite ends.
fn wrap(numbers: &mut [f64], start: usize, bins: usize, margin: usize) {
    let end = start + bins;
    numbers.copy_within(end - margin..end, start - margin);
    numbers.copy_within(start..start + margin, end);
}
