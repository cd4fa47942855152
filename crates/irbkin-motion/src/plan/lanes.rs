//! The best edge into every node of a layer, eight slots of a cell in lanes (docs/guide/plan.md,
//! eq. 3 to 6).

use core::f64::consts::TAU;

use super::graph::Moved;
use super::joints::{PlannedJoints, TurnStates};
use crate::prelude::*;
use irbkin::internal::lanes::{Column, Kernel, LANES, nearest_whole};

/// Factors of the costs of the edges into a layer.
#[derive(Clone, Copy)]
pub(super) struct Rates {
    /// Factor of the step of each joint that makes it a part of its velocity limit.
    pub(super) parts: [f64; 6],
    weights: [f64; 6],
    wraps: [bool; 6],
}

impl Rates {
    /// Of steps that take `time` [s].
    pub(super) fn of(joints: &PlannedJoints, time: f64) -> Self {
        let parts = joints.velocity.map(|velocity| 1.0 / (velocity * time));
        Self { parts, weights: joints.weights, wraps: joints.wraps }
    }

    /// The largest part of a velocity limit and the weighted sum of squares of an edge (eq. 4): the
    /// operations of the lanes.
    pub(super) fn cost(&self, steps: &[f64; 6], moved: Moved) -> (f64, f64) {
        let (mut most, mut squares) = (moved.most, moved.squares);
        for joint in 0..6 {
            let part = steps[joint].abs() * self.parts[joint];
            most = if part > most { part } else { most };
            squares += self.weights[joint] * (steps[joint] * steps[joint]);
        }
        (most, squares)
    }
}

/// How an edge adds to the cost of the path to its first node.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Pass {
    /// The larger of both (eq. 5).
    Bottleneck,
    /// The sum, over edges whose bottleneck is at most the cap (eq. 6).
    Squares,
}

impl Pass {
    /// The cost of a path that is continued by an edge; infinite if it may not be.
    pub(super) fn continued(self, before: f64, (most, squares): (f64, f64), cap: f64) -> f64 {
        if most > cap {
            return f64::INFINITY;
        }
        match self {
            Self::Bottleneck => before.max(most),
            Self::Squares => before + squares,
        }
    }
}

/// Eight nodes that edges come from.
#[derive(Clone, Copy)]
pub(super) struct Source {
    /// Their lanes in the layer before.
    pub(super) block: usize,
    /// Whether each is reached.
    pub(super) live: [bool; LANES],
    /// The cost of moving the free axes.
    pub(super) moved: Moved,
}

/// Eight nodes that edges lead into, from some of the sources.
#[derive(Clone, Copy)]
pub(super) struct Target {
    /// Their lanes in the next layer.
    pub(super) block: usize,
    /// The first source, and the last but one.
    pub(super) sources: [usize; 2],
}

/// The costs of eight edges side by side.
#[derive(Clone, Copy)]
struct Edges {
    block: usize,
    most: Column,
    squares: Column,
    /// The code of the turns that each carries, if any does.
    carried: Option<Column>,
}

/// Memory that a search keeps from layer to layer.
#[derive(Default)]
pub(super) struct Work {
    pub(super) targets: Vec<Target>,
    pub(super) sources: Vec<Source>,
    edges: Vec<Edges>,
}

/// The best edges into the targets from nodes on their branches.
pub(super) struct Relaxation<'a, const SQUARES: bool> {
    /// Joint angles of the layer before, and the costs of the paths to its nodes: for each
    /// combination of turns, of each node.
    pub(super) q: &'a [[Column; 6]],
    pub(super) before: &'a [Column],
    /// Joint angles of the next layer.
    pub(super) next: &'a [[Column; 6]],
    /// Costs of the paths to the nodes of the next layer, and which node each comes from.
    pub(super) after: &'a mut [Column],
    pub(super) by: &'a mut [[u32; LANES]],
    pub(super) rates: Rates,
    pub(super) states: &'a TurnStates,
    /// Whether a joint path leads to each combination of turns.
    pub(super) live: &'a [bool],
    pub(super) cap: f64,
    pub(super) work: &'a mut Work,
}

impl<const SQUARES: bool> Kernel for Relaxation<'_, SQUARES> {
    type Answer = ();
    const WIDE: bool = true;

    #[inline(always)]
    fn run<const FUSED: bool>(mut self) {
        for number in 0..self.work.targets.len() {
            let Target { block, sources: [begin, end] } = self.work.targets[number];
            let next = &self.next[block];
            self.work.edges.clear();
            for number in begin..end {
                let source = self.work.sources[number];
                if self.are_too_fast(&source, next) {
                    continue;
                }
                let [most, squares, carried] = self.costs(&source, next);
                if self.is_any_within(&source, &most) {
                    let turned = core::array::from_fn(|lane| {
                        if carried[lane] == 0.0 { f64::NAN } else { most[lane] }
                    });
                    let is_turned = self.states.len() > 1 && self.is_any_within(&source, &turned);
                    let carried = is_turned.then_some(carried);
                    self.work.edges.push(Edges { block: source.block, most, squares, carried });
                }
            }
            let is_any_carried = self.work.edges.iter().any(|edges| edges.carried.is_some());
            for state in 0..self.states.len() {
                if self.live[state] || is_any_carried {
                    self.enter(state, block, next);
                }
            }
        }
    }
}

impl<const SQUARES: bool> Relaxation<'_, SQUARES> {
    /// Take the best edges for a combination of turns.
    #[inline(always)]
    fn enter(&mut self, state: usize, block: usize, next: &[Column; 6]) {
        let size = self.q.len();
        let at = state * size + block;
        let (mut best, mut best_block) = ([f64::INFINITY; LANES], [0_u64; LANES]);
        for Edges { block, most, squares, carried } in &self.work.edges {
            let mut cost = self.before[state * size + block];
            if let Some(carried) = carried {
                for lane in 0..LANES {
                    let before = self.states.before(state, carried[lane]);
                    let cost_before = before.map(|before| self.before[before * size + block][lane]);
                    cost[lane] = cost_before.unwrap_or(f64::INFINITY);
                }
            }
            for lane in 0..LANES {
                let continued = if SQUARES {
                    cost[lane] + squares[lane]
                } else if cost[lane] > most[lane] {
                    cost[lane]
                } else {
                    most[lane]
                };
                let better = (continued < best[lane]) & (most[lane] <= self.cap);
                best[lane] = if better { continued } else { best[lane] };
                best_block[lane] = if better { *block as u64 } else { best_block[lane] };
            }
        }
        for lane in 0..LANES {
            // A node that is not there has angles that are NaN.
            best[lane] = if next[0][lane].is_nan() { f64::INFINITY } else { best[lane] };
        }
        if SQUARES {
            let by = &mut self.by[at];
            for lane in 0..LANES {
                #[expect(clippy::cast_possible_truncation, reason = "nodes of a layer are few")]
                let number = (LANES as u64 * best_block[lane]) as u32 + lane as u32;
                by[lane] = number;
            }
        }
        self.after[at] = best;
    }

    /// Whether all of eight edges are above the cap, by the step of the last joint alone: of all
    /// joints, the tool angle moves it most.
    #[inline(always)]
    fn are_too_fast(&self, source: &Source, next: &[Column; 6]) -> bool {
        const LAST: usize = 5;
        let (before, next) = (&self.q[source.block][LAST], &next[LAST]);
        let turn = if self.rates.wraps[LAST] { TAU } else { 0.0 };
        let mut parts = [0.0; LANES];
        for lane in 0..LANES {
            let step = next[lane] - before[lane];
            let step = step - turn * nearest_whole(step * (1.0 / TAU));
            parts[lane] = step.abs() * self.rates.parts[LAST];
        }
        !self.is_any_within(source, &parts)
    }

    /// Whether the bottleneck of any edge from a node that is reached is at most the cap.
    #[inline(always)]
    fn is_any_within(&self, source: &Source, most: &Column) -> bool {
        let mut any = false;
        for lane in 0..LANES {
            // NaN if a node is not there.
            any |= source.live[lane] & (most[lane] <= self.cap);
        }
        any
    }

    /// The two costs of eight edges side by side (eq. 3, 4), and the codes of the turns that they
    /// carry.
    #[inline(always)]
    fn costs(&self, source: &Source, next: &[Column; 6]) -> [Column; 3] {
        let (mut most, mut squares) = ([source.moved.most; LANES], [source.moved.squares; LANES]);
        let mut carried = [0.0; LANES];
        for joint in 0..6 {
            let before = &self.q[source.block][joint];
            let mut step = [0.0; LANES];
            for lane in 0..LANES {
                step[lane] = next[joint][lane] - before[lane];
            }
            if self.rates.wraps[joint] {
                let stride = self.states.strides[joint];
                for lane in 0..LANES {
                    let turns = nearest_whole(step[lane] * (1.0 / TAU));
                    step[lane] -= TAU * turns;
                    carried[lane] += stride * turns;
                }
            }
            for lane in 0..LANES {
                let part = step[lane].abs() * self.rates.parts[joint];
                most[lane] = if part > most[lane] { part } else { most[lane] };
                if SQUARES {
                    squares[lane] += self.rates.weights[joint] * (step[lane] * step[lane]);
                }
            }
        }
        [most, squares, carried]
    }
}
