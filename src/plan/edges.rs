//! The edges between two layers: the best one into every node.

use alloc::vec::Vec;

use super::layer::{Edge, Node};
use super::search::{CROSSED, Layers, Places, Search};
use super::step::{Columns, Pass, Step};
use super::turns::whole;
use crate::kinematics::MOST_SLOTS;
use crate::lanes::{Column, LANES, run};

/// Difference of two angles of a joint that may lead to another turn [rad]: a little less than half
/// a turn.
const OTHER_TURN: f64 = 3.0;

impl Search<'_> {
    /// Edges on their own branch, in lanes.
    pub(super) fn step(
        &self,
        ends: &Layers,
        q: [&[f64]; 2],
        costs: [&mut [f64]; 2],
        by: &mut [u16],
        room: &mut Vec<[Column; 2]>,
    ) {
        let (grid, places) = (&self.grid, ends.places);
        let next = &self.layers[ends.layer];
        let mut runs = [[0; 2]; MOST_SLOTS];
        let mut count = 0;
        for slot in (0..grid.slots).filter(|slot| next.present[*slot]) {
            let start = places.slot(slot);
            // Slots of a few bins share the lanes.
            match runs[..count].last_mut() {
                Some([first, length]) if grid.bins < LANES && places.margin == 0 => {
                    *length = start + grid.bins - *first;
                }
                _ => {
                    runs[count] = [start, grid.bins];
                    count += 1;
                }
            }
        }
        let [before, after] = costs;
        let (q, q_next) = (q[0], q[1]);
        let step = Step::<false> {
            places: places.count,
            before: Columns { q, costs: before },
            q: q_next,
            costs: &mut *after,
            by: &mut [],
            runs: &runs[..count],
            window: self.windows[ends.layer],
            rates: self.rates(ends.layer),
            told: core::array::from_fn(|joint| self.states.has(joint)),
            cap: ends.cap,
            room,
        };
        match ends.pass {
            Pass::Bottleneck => run(step),
            Pass::Squares => run(Step::<true> {
                places: step.places,
                before: step.before,
                q: step.q,
                costs: step.costs,
                by,
                runs: step.runs,
                window: step.window,
                rates: step.rates,
                told: step.told,
                cap: step.cap,
                room: step.room,
            }),
        }
        // What lanes wrote next to a slot.
        for slot in (0..grid.slots).filter(|slot| !next.present[*slot]) {
            let start = places.slot(slot);
            for costs in after.chunks_mut(places.count) {
                costs[start..start + grid.bins].fill(f64::INFINITY);
            }
        }
        if self.states.len() > 1 {
            self.turn(ends, [before, after], by);
        }
    }

    /// Of joints whose turns are told apart: edges that lead to another turn, and nodes that have
    /// fewer turns.
    fn turn(&self, ends: &Layers, [before, after]: [&mut [f64]; 2], by: &mut [u16]) {
        let grid = &self.grid;
        let (previous, next) = (&self.layers[ends.layer - 1], &self.layers[ends.layer]);
        for slot in (0..grid.slots).filter(|slot| next.present[*slot]) {
            let (mut has_fewer, mut leads_on) = (false, false);
            for joint in (0..6).filter(|joint| self.states.has(*joint)) {
                let [least, most] = range(next.angles(grid, slot, joint));
                let [least_before, most_before] = range(previous.angles(grid, slot, joint));
                let all = self.joints.count(joint);
                has_fewer |= self.joints.last_turn(joint, most) + 1 < whole(all);
                leads_on |= most.max(most_before) - least.min(least_before) > OTHER_TURN;
            }
            for bin in (0..grid.bins).filter(|_| has_fewer || leads_on) {
                let to = Node { slot, bin };
                let Some(q) = next.joints(grid, to) else { continue };
                if has_fewer {
                    self.leave_out(ends.places, after, grid.number(to), &q);
                }
                if leads_on && previous.present[slot] {
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
        ends: &Layers,
        (to, q): (Node, &[f64; 6]),
        costs: (&[f64], &mut [f64]),
        by: &mut [u16],
    ) {
        let (grid, previous) = (&self.grid, &self.layers[ends.layer - 1]);
        let [below, above] = self.windows[ends.layer];
        let (before, after) = costs;
        for offset in 0..=below + above {
            let Some(bin) = self.bin_at(to.bin, offset, below) else { continue };
            let is_far = |joint: usize| {
                (q[joint] - previous.angles(grid, to.slot, joint)[bin]).abs() > OTHER_TURN
            };
            if !(0..6).any(|joint| self.states.has(joint) && is_far(joint)) {
                continue;
            }
            let from = Node { slot: to.slot, bin };
            let Some(q_before) = previous.joints(grid, from) else { continue };
            let edge = [from, to].map(|node| grid.number(node));
            let label = u16::try_from(offset).unwrap_or_default();
            self.relax(ends, edge, [&q_before, q], (before, &mut *after), (&mut *by, label));
        }
    }

    /// Edges on their own branch, one after the other: with turns told apart, or edges refused.
    pub(super) fn step_by_itself(&self, ends: &Layers, costs: [&mut [f64]; 2], by: &mut [u16]) {
        let grid = &self.grid;
        let [before, after] = costs;
        after.fill(f64::INFINITY);
        let (previous, next) = (&self.layers[ends.layer - 1], &self.layers[ends.layer]);
        let [below, above] = self.windows[ends.layer];
        for (to, q) in next.nodes(grid) {
            let number = grid.number(to);
            for offset in 0..=below + above {
                let Some(bin) = self.bin_at(to.bin, offset, below) else { continue };
                let from = Node { slot: to.slot, bin };
                let Some(q_before) = previous.joints(grid, from) else { continue };
                let edge = [grid.number(from), number];
                if next.refused.contains(&edge) {
                    continue;
                }
                let label = u16::try_from(offset).unwrap_or_default();
                self.relax(ends, edge, [&q_before, &q], (&*before, &mut *after), (&mut *by, label));
            }
        }
    }

    /// Edges from one branch to another.
    pub(super) fn cross(&self, ends: &Layers, costs: [&mut [f64]; 2], by: &mut [u16]) {
        let [before, after] = costs;
        let (previous, next) = (&self.layers[ends.layer - 1], &self.layers[ends.layer]);
        for (number, edge) in next.crossings.iter().enumerate() {
            if next.refused.contains(edge) {
                continue;
            }
            let [from, to] = edge.map(|number| self.grid.node(number));
            let q = (previous.joints(&self.grid, from), next.joints(&self.grid, to));
            let (Some(q_before), Some(q)) = q else { continue };
            let label = CROSSED | u16::try_from(number).unwrap_or_default();
            self.relax(ends, *edge, [&q_before, &q], (&*before, &mut *after), (&mut *by, label));
        }
    }

    /// Take an edge where it is better than what was taken, for every combination of turns.
    fn relax(
        &self,
        ends: &Layers,
        [from, to]: Edge,
        [q_before, q]: [&[f64; 6]; 2],
        (before, after): (&[f64], &mut [f64]),
        (by, label): (&mut [u16], u16),
    ) {
        let places = ends.places;
        let (mut steps, mut carried) = ([0.0; 6], [0; 6]);
        for joint in 0..6 {
            (steps[joint], carried[joint]) = self.joints.step(joint, q_before[joint], q[joint]);
        }
        let cost = self.rates(ends.layer).cost(&steps);
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
            let continued = ends.pass.continued(cost_before, cost, ends.cap);
            let at = state * places.count + to;
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
