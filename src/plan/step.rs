//! From one layer to the next: the cost of every edge, and the best edge into every node, in lanes
//! (docs/plan.md, eq. 4 to 6).

use alloc::vec::Vec;
use core::f64::consts::TAU;

use super::turns::PlannedJoints;
use crate::lanes::{Column, Kernel, LANES, nearest_whole};

/// What the edges of a step cost.
#[derive(Clone, Copy)]
pub(super) struct Rates {
    /// Factor of the step of each joint that makes it a part of its velocity limit.
    pub(super) parts: [f64; 6],
    pub(super) weights: [f64; 6],
    pub(super) wraps: [bool; 6],
}

impl Rates {
    pub(super) fn of(joints: &PlannedJoints, time: f64) -> Self {
        Self { parts: joints.rates(time), weights: joints.weights, wraps: joints.wraps }
    }

    /// The largest part of a velocity limit and the weighted sum of squares of an edge (eq. 4): the
    /// same operations as in lanes.
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

/// How an edge adds to the cost of the way to its first node.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Pass {
    /// The larger of both (eq. 5).
    Bottleneck,
    /// The sum, over edges whose bottleneck is at most the cap (eq. 6).
    Squares,
}

impl Pass {
    /// The cost of a way that is continued by an edge; infinite if it may not be.
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

/// The columns of a layer as the kernel reads them: for each joint, and one for the costs, a number
/// for each place. The bins of a slot lie side by side, with a margin around them.
pub(super) struct Columns<'a> {
    pub(super) q: &'a [f64],
    pub(super) costs: &'a [f64],
}

/// The best edge into every node of a layer, of those that stay on their branch and, of joints whose
/// turns are told apart, on their turn.
pub(super) struct Step<'a, const SQUARES: bool> {
    /// Places of a column.
    pub(super) places: usize,
    pub(super) before: Columns<'a>,
    /// Joint angles of the next layer.
    pub(super) q: &'a [f64],
    /// A column of costs for each combination of turns.
    pub(super) costs: &'a mut [f64],
    /// For each of those, by which edge of the window the best one comes.
    pub(super) by: &'a mut [u32],
    /// The places that have nodes.
    pub(super) runs: &'a [Run],
    /// Where the edges into each run come from.
    pub(super) sources: &'a [Source],
    /// The edges come from this many bins below to as many above.
    pub(super) window: [usize; 2],
    pub(super) rates: Rates,
    /// Joints whose turns are told apart.
    pub(super) told: [bool; 6],
    pub(super) cap: f64,
    /// What each node costs, for each combination of turns; empty if nothing.
    pub(super) soft: &'a [f64],
    /// Room for the edges of a window.
    pub(super) room: &'a mut Vec<Edges>,
}

/// Places side by side, of one row or of several that have the same sources.
#[derive(Clone, Copy)]
pub(super) struct Run {
    pub(super) first: usize,
    pub(super) count: usize,
    /// First and last but one of its sources.
    pub(super) sources: [usize; 2],
}

/// A row that edges come from.
#[derive(Clone, Copy)]
pub(super) struct Source {
    /// How many places it is behind the row of the run.
    pub(super) shift: isize,
    /// What moving the free axes costs.
    pub(super) moved: Moved,
}

/// What moving the free axes costs: a part of a velocity limit, and a square (eq. 4).
#[derive(Clone, Copy, Default)]
pub(super) struct Moved {
    pub(super) most: f64,
    pub(super) squares: f64,
}

/// What a search needs from step to step, so that it allocates once.
#[derive(Default)]
pub(super) struct Room {
    pub(super) runs: Vec<Run>,
    pub(super) sources: Vec<Source>,
    /// Rows that no edge in lanes leads into.
    pub(super) unreached: Vec<usize>,
    pub(super) edges: Vec<Edges>,
}

/// Edges side by side, from a place and those after it.
#[derive(Clone, Copy)]
pub(super) struct Edges {
    /// By which edge of the window they come.
    by: usize,
    from: usize,
    most: Column,
    squares: Column,
}

impl<const SQUARES: bool> Kernel for Step<'_, SQUARES> {
    type Answer = ();
    const WIDE: bool = true;

    #[inline(always)]
    fn run<const FUSED: bool>(mut self) {
        let width = self.window[0] + self.window[1] + 1;
        for run in self.runs {
            let sources = &self.sources[run.sources[0]..run.sources[1]];
            let mut place = run.first;
            while place < run.first + run.count {
                let next: [Column; 6] =
                    core::array::from_fn(|joint| column(self.q, joint * self.places + place));
                self.room.clear();
                for (number, source) in sources.iter().enumerate() {
                    let first = place.wrapping_add_signed(source.shift) - self.window[0];
                    for offset in 0..width {
                        let (by, from) = (number * width + offset, first + offset);
                        if self.are_too_fast(from, &next) {
                            continue;
                        }
                        let [most, squares] = self.edges(from, &next, source.moved);
                        self.room.push(Edges { by, from, most, squares });
                    }
                }
                let mut state = 0;
                while state < self.costs.len() {
                    self.enter(state, place, &next[0]);
                    state += self.places;
                }
                place += LANES;
            }
        }
    }
}

impl<const SQUARES: bool> Step<'_, SQUARES> {
    /// The best edges into eight places of a column of costs, which begins at `state`.
    #[inline(always)]
    fn enter(&mut self, state: usize, place: usize, next: &Column) {
        let (mut best, mut best_by) = ([f64::INFINITY; LANES], [0_u64; LANES]);
        for Edges { by, from, most, squares } in self.room.iter() {
            let cost = column(self.before.costs, state + from);
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
                best_by[lane] = if better { *by as u64 } else { best_by[lane] };
            }
        }
        for lane in 0..LANES {
            // Of a node that is not there the angles are NaN.
            best[lane] = if next[lane].is_nan() { f64::INFINITY } else { best[lane] };
        }
        if SQUARES && !self.soft.is_empty() {
            let soft = column(self.soft, state + place);
            for lane in 0..LANES {
                best[lane] += soft[lane];
            }
        }
        self.costs[state + place..state + place + LANES].copy_from_slice(&best);
        if SQUARES {
            let by = &mut self.by[state + place..state + place + LANES];
            for (by, best) in by.iter_mut().zip(best_by) {
                #[expect(clippy::cast_possible_truncation, reason = "a window is small")]
                let best = best as u32;
                *by = best;
            }
        }
    }

    /// Whether none of eight edges counts, by the step of the last joint alone: of all joints, the
    /// tool angle moves it most.
    #[inline(always)]
    fn are_too_fast(&self, from: usize, next: &[Column; 6]) -> bool {
        const LAST: usize = 5;
        let before = column(self.before.q, LAST * self.places + from);
        let turn = if self.rates.wraps[LAST] { TAU } else { 0.0 };
        let mut any = false;
        for lane in 0..LANES {
            let step = next[LAST][lane] - before[lane];
            let step = step - turn * nearest_whole(step * (1.0 / TAU));
            // Of a node that is not there it is NaN.
            any |= step.abs() * self.rates.parts[LAST] <= self.cap;
        }
        !any
    }

    /// The two costs of eight edges side by side (eq. 3, 4).
    #[inline(always)]
    fn edges(&self, from: usize, next: &[Column; 6], moved: Moved) -> [Column; 2] {
        let (mut most, mut squares) = ([moved.most; LANES], [moved.squares; LANES]);
        for joint in 0..6 {
            let before = column(self.before.q, joint * self.places + from);
            let mut step = [0.0; LANES];
            for lane in 0..LANES {
                step[lane] = next[joint][lane] - before[lane];
            }
            if self.rates.wraps[joint] {
                let told = self.told[joint];
                for lane in 0..LANES {
                    let turns = nearest_whole(step[lane] * (1.0 / TAU));
                    step[lane] -= TAU * turns;
                    // To another turn: not here.
                    let leaves = told & (turns != 0.0);
                    most[lane] = if leaves { f64::INFINITY } else { most[lane] };
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
        [most, squares]
    }
}

#[inline(always)]
fn column(numbers: &[f64], first: usize) -> Column {
    let mut column = [0.0; LANES];
    column.copy_from_slice(&numbers[first..first + LANES]);
    column
}
