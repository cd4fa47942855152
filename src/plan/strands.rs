//! Branches of an arm whose slots are ordinals (docs/plan.md, section 1): those of each pose are put
//! in the order of those before, so that a row of nodes is a strand.

use super::certificate::{ARRIVED, Hop};
use super::layer::{Grid, Layer, Node};
use super::nodes::Arm;
use crate::error::Error;
use crate::kinematics::thresholds::{CROSSING_STEP, EXAMINED_STEP};
use crate::kinematics::{MOST_SLOTS, Solution, Solutions, largest, nearest_turn};

/// The joint angles of each slot at one pose.
type Slots = [Option<[f64; 6]>; MOST_SLOTS];

impl Arm<'_> {
    /// Whether slots have names, so that a branch has the same slot at every pose.
    pub(super) fn has_names(&self) -> bool {
        self.robot.slot_names().is_some()
    }

    /// Put the branches of a layer in the order of those of the layer before and, where it has
    /// none, of those at the tool angle or the station beside.
    pub(super) fn join_strands(&self, grid: &Grid, layers: &mut [Layer], number: usize) {
        let (before, rest) = layers.split_at_mut(number);
        let (before, Some(layer)) = (before.last(), rest.first_mut()) else { return };
        let start = before.and_then(|before| before.own).map_or(0, |own| own.bin);
        for station in 0..grid.stations.len() {
            let upward = (start..grid.bins).map(|bin| (bin, bin.checked_sub(1)));
            let downward = (0..start).rev().map(|bin| (bin, Some(bin + 1)));
            for (bin, beside) in upward.chain(downward) {
                let at = |layer: &Layer, station, bin| slots(grid, layer, station, bin);
                let own = at(layer, station, bin);
                if own.iter().all(Option::is_none) {
                    continue;
                }
                let beside = match beside.filter(|_| bin != start) {
                    Some(beside) => Some(at(layer, station, beside)),
                    None => station.checked_sub(1).map(|station| at(layer, station, bin)),
                };
                let follow = |slot: usize, q: &[f64; 6]| {
                    let nodes = [Node { slot, station, bin }; 2];
                    let hop = Hop::new(self, grid, [before?, layer], nodes, [*q; 2]);
                    hop.end(self, EXAMINED_STEP, false)
                };
                let slots_before = before.map(|before| at(before, station, bin));
                let joined = self.joined(own, slots_before.as_ref(), beside.as_ref(), follow);
                for (slot, q) in joined.into_iter().enumerate().take(grid.slots) {
                    layer.put(grid, Node { slot, station, bin }, q);
                }
            }
        }
    }

    /// Joint angles, each in the slot of those before that it is nearest to, or that lead to it, then
    /// of those beside; the others where there is room.
    fn joined(
        &self,
        mut own: Slots,
        before: Option<&Slots>,
        beside: Option<&Slots>,
        follow: impl Fn(usize, &[f64; 6]) -> Option<[f64; 6]>,
    ) -> Slots {
        let mut joined = Slots::default();
        if let Some(before) = before {
            self.take_nearest(&mut own, before, &mut joined);
            for (slot, q) in before.iter().enumerate() {
                let Some(q) = q.filter(|_| joined[slot].is_none()) else { continue };
                if own.iter().all(Option::is_none) {
                    break;
                }
                let Some(end) = follow(slot, &q) else { continue };
                let is_there = |own: &Option<[f64; 6]>| {
                    own.is_some_and(|own| largest(&self.joints.steps(&own, &end)) <= ARRIVED)
                };
                joined[slot] = own.iter_mut().find(|own| is_there(own)).and_then(Option::take);
            }
        }
        if let Some(beside) = beside {
            self.take_nearest(&mut own, beside, &mut joined);
        }
        for q in own.into_iter().flatten() {
            let is_free = |slot: &usize| joined[*slot].is_none();
            let is_used =
                |slot: usize| [before, beside].iter().flatten().any(|at| at[slot].is_some());
            // Nobody's slot before one that has only ended.
            let nobodys = (0..MOST_SLOTS).find(|slot| is_free(slot) && !is_used(*slot));
            if let Some(room) = nobodys.or_else(|| (0..MOST_SLOTS).find(is_free)) {
                joined[room] = Some(q);
            }
        }
        joined
    }

    /// Take joint angles into the free slots of others, the nearest first.
    fn take_nearest(&self, own: &mut Slots, others: &Slots, joined: &mut Slots) {
        while let Some((from, to)) = self.nearest_pair(own, others, joined) {
            joined[to] = own[from].take();
        }
    }

    /// The nearest of joint angles and those of free slots that one step leads between.
    fn nearest_pair(&self, own: &Slots, others: &Slots, taken: &Slots) -> Option<(usize, usize)> {
        let mut nearest = (CROSSING_STEP, None);
        for (to, other) in others.iter().enumerate().filter(|(to, _)| taken[*to].is_none()) {
            let Some(other) = other else { continue };
            for (from, q) in own.iter().enumerate() {
                let Some(q) = q else { continue };
                let step = largest(&self.joints.steps(other, q));
                if step < nearest.0 {
                    nearest = (step, Some((from, to)));
                }
            }
        }
        nearest.1
    }

    /// The ordinal of joint angles among the solutions of their pose.
    pub(super) fn ordinal(&self, q: &[f64; 6]) -> Result<usize, Error> {
        let solutions = self.robot.ik(&self.robot.fk(q))?;
        Ok(nearest_solution(&solutions, q).map_or(0, |(nearest, _)| nearest.slot.index()))
    }
}

/// The solution that is nearest to joint angles, and how far it is [rad].
pub(super) fn nearest_solution(
    solutions: &Solutions<6>,
    q: &[f64; 6],
) -> Option<(Solution<6>, f64)> {
    let off = |other: &[f64; 6]| {
        largest(&core::array::from_fn(|joint| nearest_turn(q[joint] - other[joint], 0.0)))
    };
    let each = solutions.iter().map(|solution| (*solution, off(&solution.q)));
    each.min_by(|a, b| a.1.total_cmp(&b.1))
}

fn slots(grid: &Grid, layer: &Layer, station: usize, bin: usize) -> Slots {
    core::array::from_fn(|slot| {
        let node = Node { slot, station, bin };
        if slot < grid.slots { layer.joints(grid, node) } else { None }
    })
}
