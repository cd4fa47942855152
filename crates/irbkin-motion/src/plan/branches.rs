//! Branches from one layer to the next: the edges between two of them, the order of the slots of
//! arms whose slots are ordinals, the limits at singular poses (docs/theory/plan.md, sections 1, 2).

use core::f64::consts::TAU;
use core::ops::Range;

use super::certificate::{ARRIVED, Step};
use super::graph::{Grid, Layer, Node};
use super::nodes::PlannedArm;
use crate::error::Error;
use crate::plan::thresholds::{CONTINUOUS_STEP, CROSSING_JUMP, CROSSING_STEP};
use crate::prelude::*;
use irbkin::internal::lanes::{Column, Kernel, LANES, nearest_whole, run};
use irbkin::internal::thresholds::EXAMINED_STEP;
use irbkin::internal::{MOST_SLOTS, largest, nearest_turn};
use irbkin::{Solution, Solutions};

/// How many times farther than the nearest joint angles others have to be, so that these are on the
/// same branch without a doubt [1].
const RIVAL: f64 = 4.0;

type Slots = [Option<[f64; 6]>; MOST_SLOTS];

impl PlannedArm<'_> {
    /// Find the edges into layers that lead from one branch to another: where a branch ends or
    /// jumps, and another one continues it.
    pub(super) fn find_crossings(&self, grid: &Grid, layers: &mut [Layer], range: Range<usize>) {
        let mut most = vec![[0.0; LANES]; grid.len() / LANES];
        let has_names = self.has_names();
        // The branch of an ordinal may go on in any other slot: where that is nearer.
        let jump = if has_names { CROSSING_JUMP } else { CONTINUOUS_STEP };
        for layer in range {
            if self.interrupt.ends(layer) {
                return;
            }
            let (before, after) = layers.split_at_mut(layer);
            let (before, after) = (&before[layer - 1], &mut after[0]);
            let (wraps, largest_steps) = (self.joints.wraps, &mut most[..]);
            run(LargestSteps { before: &before.q, after: &after.q, wraps, most: largest_steps });
            after.crossings.clear();
            for (number, own) in most.as_flattened().iter().enumerate() {
                // NaN where a node is missing.
                if *own <= jump {
                    continue;
                }
                let node = grid.node(number);
                let Some(q) = before.joints(grid, node) else { continue };
                let bound = if has_names { CROSSING_STEP } else { own.min(CROSSING_STEP) };
                for slot in (0..grid.slots).filter(|slot| *slot != node.slot) {
                    let to = Node { slot, ..node };
                    let Some(next) = after.joints(grid, to) else { continue };
                    if largest(&self.joints.steps(&q, &next)) <= bound {
                        after.crossings.push([number, grid.number(to)]);
                    }
                }
            }
        }
    }

    /// Put the slots of a layer, if they are ordinals, in the order of the layer before and, where
    /// it has none, of a neighboring cell.
    pub(super) fn order_branches(&self, grid: &Grid, layers: &mut [Layer], number: usize) {
        let (before, rest) = layers.split_at_mut(number);
        let (before, Some(layer)) = (before.last(), rest.first_mut()) else { return };
        let start = before.and_then(|before| before.own).map_or(0, |own| own.cell);
        for (cell, beside) in grid.outward(start) {
            let own = slots(grid, layer, cell);
            if own.iter().all(Option::is_none) {
                continue;
            }
            let beside = beside.map(|beside| slots(grid, layer, beside));
            let follow = |slot: usize, q: &[f64; 6]| {
                let nodes = [Node { slot, cell }; 2];
                let step = Step::new(grid, [before?, layer], nodes, [self.joints.amid(q); 2]);
                step.end(self, EXAMINED_STEP, false)
            };
            let slots_before = before.map(|before| slots(grid, before, cell));
            let joined = self.joined(own, slots_before.as_ref(), beside.as_ref(), follow);
            for (slot, q) in joined.into_iter().enumerate().take(grid.slots) {
                layer.put(grid, Node { slot, cell }, q);
            }
        }
    }

    /// Joint angles in slots: of the joint angles before that are near without a doubt, of those
    /// that lead to them, of the nearest, then of the nearest beside; the others in free slots.
    fn joined(
        &self,
        mut own: Slots,
        before: Option<&Slots>,
        beside: Option<&Slots>,
        follow: impl Fn(usize, &[f64; 6]) -> Option<[f64; 6]>,
    ) -> Slots {
        let mut joined = Slots::default();
        if let Some(before) = before {
            self.take_nearest(&mut own, before, &mut joined, true);
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
            self.take_nearest(&mut own, before, &mut joined, false);
        }
        if let Some(beside) = beside {
            self.take_nearest(&mut own, beside, &mut joined, false);
        }
        for q in own.into_iter().flatten() {
            let is_free = |slot: &usize| joined[*slot].is_none();
            let is_used =
                |slot: usize| [before, beside].iter().flatten().any(|at| at[slot].is_some());
            // Nobody's slot before one that has only ended.
            let nobodys = (0..MOST_SLOTS).find(|slot| is_free(slot) && !is_used(*slot));
            if let Some(free) = nobodys.or_else(|| (0..MOST_SLOTS).find(is_free)) {
                joined[free] = Some(q);
            }
        }
        joined
    }

    /// Take joint angles into the free slots of others, the nearest first. If they are to be sure,
    /// only where a step is small, and smaller than any other from or to it.
    fn take_nearest(&self, own: &mut Slots, others: &Slots, joined: &mut Slots, sure: bool) {
        let all = *own;
        while let Some((step, from, to)) = self.nearest_pair(own, others, joined) {
            let rival = |one: &[f64; 6], other: &Option<[f64; 6]>| {
                other.is_some_and(|other| largest(&self.joints.steps(one, &other)) < RIVAL * step)
            };
            let rivals = |one: Option<[f64; 6]>, others: &Slots| {
                one.map_or(0, |one| others.iter().filter(|other| rival(&one, other)).count())
            };
            let doubtful = rivals(others[to], &all) + rivals(own[from], others) > 2;
            if sure && (step > EXAMINED_STEP || doubtful) {
                return;
            }
            joined[to] = own[from].take();
        }
    }

    /// The nearest pair of joint angles and of others in free slots, within one step, and how far
    /// apart it is [rad].
    fn nearest_pair(
        &self,
        own: &Slots,
        others: &Slots,
        taken: &Slots,
    ) -> Option<(f64, usize, usize)> {
        let mut nearest = (CROSSING_STEP, None);
        for (to, other) in others.iter().enumerate().filter(|(to, _)| taken[*to].is_none()) {
            let Some(other) = other else { continue };
            for (from, q) in own.iter().enumerate() {
                let Some(q) = q else { continue };
                let step = largest(&self.joints.steps(other, q));
                if step < nearest.0 {
                    nearest = (step, Some((step, from, to)));
                }
            }
        }
        nearest.1
    }

    /// At singular poses, choose the joint angles on each branch that continue the layer before, or
    /// the layer after where there are none.
    pub(super) fn join_singular(
        &self,
        grid: &Grid,
        layers: &mut [Layer],
        singular: &[(usize, Node)],
    ) {
        let mut open = Vec::new();
        for (layer, node) in singular {
            for slot in 0..grid.slots {
                let node = Node { slot, ..*node };
                let before = layer.checked_sub(1);
                if !self.join(grid, layers, *layer, before, node) {
                    open.push((*layer, node));
                }
            }
        }
        for (layer, node) in open.into_iter().rev() {
            self.join(grid, layers, layer, Some(layer + 1), node);
        }
    }

    /// Put the joint angles at a node that its branch tends to from the same node of a neighboring
    /// layer; whether there are such.
    fn join(
        &self,
        grid: &Grid,
        layers: &mut [Layer],
        layer: usize,
        neighbor: Option<usize>,
        node: Node,
    ) -> bool {
        let beside = neighbor.and_then(|neighbor| layers.get(neighbor));
        let seed = beside.and_then(|layer| layer.joints(grid, node));
        let Some((beside, seed)) = beside.zip(seed) else { return false };
        let (way, along) = if neighbor < Some(layer) {
            ([beside, &layers[layer]], [0.0, 1.0])
        } else {
            ([&layers[layer], beside], [1.0, 0.0])
        };
        let nearest = Step::new(grid, way, [node; 2], [seed; 2]).limit(self, seed, along);
        let Some(nearest) = nearest else { return false };
        if largest(&self.joints.steps(&seed, &nearest.q)) > CROSSING_STEP {
            return false;
        }
        let q = core::array::from_fn(|joint| self.joints.first_turn(joint, nearest.q[joint]));
        layers[layer].put(grid, node, Some(q));
        true
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
        largest::<6>(&core::array::from_fn(|joint| nearest_turn(q[joint] - other[joint], 0.0)))
    };
    let each = solutions.iter().map(|solution| (*solution, off(&solution.q)));
    each.min_by(|a, b| a.1.total_cmp(&b.1))
}

fn slots(grid: &Grid, layer: &Layer, cell: usize) -> Slots {
    core::array::from_fn(|slot| {
        if slot < grid.slots { layer.joints(grid, Node { slot, cell }) } else { None }
    })
}

/// The largest step of a joint from each node of a layer to the node of the next one with the same
/// number; NaN where one is missing.
struct LargestSteps<'a> {
    /// Joint angles of each joint [rad].
    before: &'a [[Column; 6]],
    after: &'a [[Column; 6]],
    /// Whether the step of a joint is taken modulo a turn.
    wraps: [bool; 6],
    /// The answer for each node [rad].
    most: &'a mut [Column],
}

impl Kernel for LargestSteps<'_> {
    type Answer = ();
    const WIDE: bool = true;

    #[inline(always)]
    fn run<const FUSED: bool>(self) {
        for ((most, from), to) in self.most.iter_mut().zip(self.before).zip(self.after) {
            *most = [0.0; LANES];
            for joint in 0..6 {
                let turn = if self.wraps[joint] { TAU } else { 0.0 };
                for lane in 0..LANES {
                    let step = to[joint][lane] - from[joint][lane];
                    let size = (step - turn * nearest_whole(step * (1.0 / TAU))).abs();
                    most[lane] = if size <= most[lane] { most[lane] } else { size };
                }
            }
        }
    }
}
