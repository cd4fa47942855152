//! The edges between two layers: the best one into every node.

use super::freedom::Values;
use super::layer::{Edge, Node};
use super::search::{CROSSED, Layers, Places, Search, Window};
use super::step::{Columns, Moved, Pass, Room, Run, Source, Step};
use super::turns::whole;
use crate::lanes::{LANES, run};

/// Difference of two angles of a joint that may lead to another turn [rad]: a little less than half
/// a turn.
const OTHER_TURN: f64 = 3.0;

impl Search<'_> {
    /// Edges on their own branch, in lanes.
    pub(super) fn step(
        &self,
        ends: &Layers<'_>,
        q: [&[f64]; 2],
        costs: [&mut [f64]; 2],
        by: &mut [u32],
        room: &mut Room,
    ) {
        self.find_runs(ends, room);
        let [before, after] = costs;
        match ends.pass {
            Pass::Bottleneck => run(self.kernel::<false>(ends, q, [before, after], &mut [], room)),
            Pass::Squares => run(self.kernel::<true>(ends, q, [before, after], by, room)),
        }
        // Rows without a way, where lanes may have written next to another row.
        let grid = &self.grid;
        for row in &room.unreached {
            let start = ends.places.row(*row);
            for costs in after.chunks_mut(ends.places.count) {
                costs[start..start + grid.bins].fill(f64::INFINITY);
            }
        }
        if self.states.len() > 1 {
            self.turn(ends, [before, after], by);
        }
    }

    fn kernel<'a, const SQUARES: bool>(
        &self,
        ends: &Layers<'a>,
        [q, q_next]: [&'a [f64]; 2],
        [before, after]: [&'a mut [f64]; 2],
        by: &'a mut [u32],
        room: &'a mut Room,
    ) -> Step<'a, SQUARES> {
        Step {
            places: ends.places.count,
            before: Columns { q, costs: before },
            q: q_next,
            costs: after,
            by,
            runs: &room.runs,
            sources: &room.sources,
            window: self.windows[ends.layer].bins,
            rates: self.rates(ends.layer),
            told: core::array::from_fn(|joint| self.states.has(joint)),
            cap: ends.cap,
            soft: ends.soft,
            room: &mut room.edges,
        }
    }

    /// The rows of a layer that have nodes, each with the rows that its edges come from.
    fn find_runs(&self, ends: &Layers<'_>, room: &mut Room) {
        let (grid, places) = (&self.grid, ends.places);
        let (previous, next) = (&self.layers[ends.layer - 1], &self.layers[ends.layer]);
        room.runs.clear();
        room.sources.clear();
        room.unreached.clear();
        // Rows of a few bins share the lanes where all come from the row itself.
        let is_shared = grid.bins < LANES && places.margin == 0 && grid.stations.len() == 1;
        let reach = self.windows[ends.layer].stations;
        let stations = grid.stations.len();
        let rows = (0..grid.slots).flat_map(|slot| (0..stations).map(move |at| (slot, at)));
        for (row, (slot, station)) in rows.enumerate() {
            let sources = || grid.stations.around(station, reach);
            let is_live = |from: usize| ends.live[grid.row(slot, from)];
            if !next.present[row] || !sources().any(is_live) {
                room.unreached.push(row);
                continue;
            }
            let first = places.row(row);
            if let Some(last) = room.runs.last_mut().filter(|_| is_shared) {
                last.count = first + grid.bins - last.first;
                continue;
            }
            let begin = room.sources.len();
            let values = next.values(grid, station);
            for from in sources() {
                let moved = self.moved(ends.layer, &previous.values(grid, from), &values);
                let place = places.row(grid.row(slot, from));
                room.sources.push(Source { shift: place.wrapping_sub(first).cast_signed(), moved });
            }
            let sources = [begin, room.sources.len()];
            room.runs.push(Run { first, count: grid.bins, sources });
        }
    }

    /// What moving the free axes from the layer before costs.
    fn moved(&self, layer: usize, from: &Values, to: &Values) -> Moved {
        let time = self.layers[layer].time - self.layers[layer - 1].time;
        self.freedom.moved(time, from, to)
    }

    /// The nodes of the layer before from which edges on the same branch come, with their labels.
    pub(super) fn sources(&self, layer: usize, to: Node) -> impl Iterator<Item = (Node, u32)> {
        let Window { bins: [below, above], stations } = self.windows[layer];
        let width = below + above + 1;
        let grid = self.grid;
        let from = grid.stations.around(to.station, stations).enumerate();
        from.flat_map(move |(number, station)| {
            (0..width).filter_map(move |offset| {
                let bin = grid.bin_at(to.bin, offset, below)?;
                let label = u32::try_from(number * width + offset).unwrap_or_default();
                Some((Node { station, bin, ..to }, label))
            })
        })
    }

    /// Of joints whose turns are told apart: edges that lead to another turn, and nodes that have
    /// fewer turns.
    fn turn(&self, ends: &Layers<'_>, [before, after]: [&mut [f64]; 2], by: &mut [u32]) {
        let grid = &self.grid;
        let (previous, next) = (&self.layers[ends.layer - 1], &self.layers[ends.layer]);
        let reach = self.windows[ends.layer].stations;
        for row in (0..grid.rows()).filter(|row| next.present[*row]) {
            let Node { slot, station, .. } = grid.node(row * grid.bins);
            let (mut has_fewer, mut leads_on) = (false, false);
            for joint in (0..6).filter(|joint| self.states.has(*joint)) {
                let [mut least, mut most] = range(next.angles(grid, row, joint));
                let all = self.joints.count(joint);
                has_fewer |= self.joints.last_turn(joint, most) + 1 < whole(all);
                for from in grid.stations.around(station, reach) {
                    let [low, high] = range(previous.angles(grid, grid.row(slot, from), joint));
                    (least, most) = (least.min(low), most.max(high));
                }
                leads_on |= most - least > OTHER_TURN;
            }
            for bin in (0..grid.bins).filter(|_| has_fewer || leads_on) {
                let to = Node { slot, station, bin };
                let Some(q) = next.joints(grid, to) else { continue };
                if has_fewer {
                    self.leave_out(ends.places, after, grid.number(to), &q);
                }
                if leads_on {
                    self.turn_into(ends, (to, &q), (&*before, &mut *after), by);
                }
            }
        }
    }

    /// No way to a node at turns that its joints do not have.
    fn leave_out(&self, places: Places, costs: &mut [f64], number: usize, q: &[f64; 6]) {
        for state in 0..self.states.len() {
            if !self.states.holds(self.joints, q, state) {
                costs[state * places.count + places.place(&self.grid, number)] = f64::INFINITY;
            }
        }
    }

    /// Edges into a node that lead to another turn.
    fn turn_into(
        &self,
        ends: &Layers<'_>,
        (to, q): (Node, &[f64; 6]),
        costs: (&[f64], &mut [f64]),
        by: &mut [u32],
    ) {
        let (grid, previous) = (&self.grid, &self.layers[ends.layer - 1]);
        let (before, after) = costs;
        for (from, label) in self.sources(ends.layer, to) {
            let row = grid.row(from.slot, from.station);
            let is_far = |joint: usize| {
                (q[joint] - previous.angles(grid, row, joint)[from.bin]).abs() > OTHER_TURN
            };
            if !(0..6).any(|joint| self.states.has(joint) && is_far(joint)) {
                continue;
            }
            let Some(q_before) = previous.joints(grid, from) else { continue };
            let edge = [from, to].map(|node| grid.number(node));
            self.relax(ends, edge, [&q_before, q], (before, &mut *after), (&mut *by, label));
        }
    }

    /// Edges on their own branch, one after the other: with turns told apart, or edges refused.
    pub(super) fn step_by_itself(&self, ends: &Layers<'_>, costs: [&mut [f64]; 2], by: &mut [u32]) {
        let grid = &self.grid;
        let [before, after] = costs;
        after.fill(f64::INFINITY);
        let (previous, next) = (&self.layers[ends.layer - 1], &self.layers[ends.layer]);
        for (to, q) in next.nodes(grid) {
            let number = grid.number(to);
            for (from, label) in self.sources(ends.layer, to) {
                let Some(q_before) = previous.joints(grid, from) else { continue };
                let edge = [grid.number(from), number];
                if next.refused.contains(&edge) {
                    continue;
                }
                self.relax(ends, edge, [&q_before, &q], (&*before, &mut *after), (&mut *by, label));
            }
        }
    }

    /// Edges from one branch to another.
    pub(super) fn cross(&self, ends: &Layers<'_>, costs: [&mut [f64]; 2], by: &mut [u32]) {
        let [before, after] = costs;
        let (previous, next) = (&self.layers[ends.layer - 1], &self.layers[ends.layer]);
        for (number, edge) in next.crossings.iter().enumerate() {
            if next.refused.contains(edge) {
                continue;
            }
            let [from, to] = edge.map(|number| self.grid.node(number));
            let q = (previous.joints(&self.grid, from), next.joints(&self.grid, to));
            let (Some(q_before), Some(q)) = q else { continue };
            let label = CROSSED | u32::try_from(number).unwrap_or_default();
            self.relax(ends, *edge, [&q_before, &q], (&*before, &mut *after), (&mut *by, label));
        }
    }

    /// Take an edge where it is better than what was taken, for every combination of turns.
    fn relax(
        &self,
        ends: &Layers<'_>,
        [from, to]: Edge,
        [q_before, q]: [&[f64; 6]; 2],
        (before, after): (&[f64], &mut [f64]),
        (by, label): (&mut [u32], u32),
    ) {
        let places = ends.places;
        let (mut steps, mut carried) = ([0.0; 6], [0; 6]);
        for joint in 0..6 {
            (steps[joint], carried[joint]) = self.joints.step(joint, q_before[joint], q[joint]);
        }
        let values = |layer: usize, number: usize| {
            self.layers[layer].values(&self.grid, self.grid.node(number).station)
        };
        let moved = self.moved(ends.layer, &values(ends.layer - 1, from), &values(ends.layer, to));
        let cost = self.rates(ends.layer).cost(&steps, moved);
        if cost.0 > ends.cap {
            return;
        }
        let [from, to] = [from, to].map(|number| places.place(&self.grid, number));
        for state in 0..self.states.len() {
            if !self.states.holds(self.joints, q, state) {
                continue;
            }
            let turns = self.states.turns(state);
            let turns_before = core::array::from_fn(|joint| turns[joint] + carried[joint]);
            let Some(state_before) = self.states.state(&turns_before) else { continue };
            let cost_before = before[state_before * places.count + from];
            let at = state * places.count + to;
            let soft = ends.soft.get(at).copied().unwrap_or_default();
            let continued = ends.pass.continued(cost_before, cost, ends.cap) + soft;
            if continued < after[at] {
                after[at] = continued;
                if ends.pass == Pass::Squares {
                    by[at] = label;
                }
            }
        }
    }
}

/// The least and the greatest number; NaN do not count.
fn range(numbers: &[f64]) -> [f64; 2] {
    numbers.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], number| {
        [if *number < least { *number } else { least }, if *number > most { *number } else { most }]
    })
}
