//! Two trees of free motions, from the start and from the goal, until they meet (RRT-Connect:
//! Kuffner and LaValle, 2000).

use core::array;
use core::mem::swap;

use super::samples::Samples;
use crate::cell::Checker;
use crate::error::Error;
use crate::go::fault::GoFault;
use crate::prelude::*;
use crate::trajectory::distance;
use irbkin::{Interrupt, Robot};

/// Links that come nearer than this count as touching in the search [m].
pub(super) const RESOLUTION: f64 = 1e-3;

/// Length of an edge of a tree [rad].
const STEP: f64 = 1.0;

/// Length of a motion of which eight states are looked at: they are at most 0.04 rad apart [rad].
const BLOCK: f64 = 0.32;

/// Blocks of states from which on a proof of eighths of the motion is tried first [1].
const FEWEST: usize = 3;

/// Most nodes of both trees: they fill 13 MB.
const MOST_NODES: usize = 200_000;

/// Where a free motion is sought.
pub(super) struct Space<'a, const N: usize> {
    pub(super) robot: &'a Robot<N>,
    pub(super) checker: Checker<'a, N>,
    pub(super) evidence: Evidence,
    /// Samples that were taken so far.
    pub(super) samples: usize,
}

/// By what an even motion counts as free.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Evidence {
    /// States of it are free.
    States,
    /// So are these, and each part of it is proven to be.
    Proof,
}

impl<const N: usize> Space<'_, N> {
    /// Whether the even motion between two joint vectors, the first of which is free, is free at
    /// states of it, and proven free if that is asked.
    pub(super) fn is_free(&mut self, from: &[f64; N], to: &[f64; N]) -> bool {
        let ends = [*from, *to];
        let at = |part| between(from, to, part);
        let blocks = blocks(distance(from, to));
        let checker = &mut self.checker;
        match self.evidence {
            Evidence::States if blocks < FEWEST => checker.are_free(blocks, at),
            Evidence::States => checker.is_free_or_looked_at(blocks, &ends),
            Evidence::Proof => {
                checker.are_free(blocks, at) && checker.is_free(&ends[..], RESOLUTION)
            }
        }
    }

    /// Whether states of a motion are free, by its length [rad].
    pub(super) fn are_free(&mut self, length: f64, at: impl Fn(f64) -> [f64; N]) -> bool {
        self.checker.are_free(blocks(length), at)
    }

    /// A path from a start to a goal: even motions that are free.
    pub(super) fn path(
        &mut self,
        ends: &[Vec<[f64; N]>; 2],
        seed: u64,
        interrupt: Interrupt<'_>,
    ) -> Result<Vec<[f64; N]>, Error> {
        let mut from = Samples::new(self.robot, ends, seed);
        let [mut own, mut other] = ends.clone().map(Tree::new);
        let mut is_swapped = false;
        while !interrupt.is_raised() && own.len() + other.len() < MOST_NODES {
            self.samples += 1;
            let sample = from.next();
            if self.robot.limits().contains(&sample) {
                let (node, _) = self.grown(&mut own, &sample, true);
                if let Some(node) = node {
                    let target = *own.at(node);
                    let (met, is_there) = self.grown(&mut other, &target, false);
                    if let (Some(met), true) = (met, is_there) {
                        let mut path = own.to_root(node);
                        path.reverse();
                        path.extend_from_slice(&other.to_root(met)[1..]);
                        if is_swapped {
                            path.reverse();
                        }
                        return Ok(path);
                    }
                }
            }
            if own.len() > other.len() {
                swap(&mut own, &mut other);
                is_swapped = !is_swapped;
            }
        }
        Err(GoFault::NotFound { samples: self.samples }.into())
    }

    /// Add nodes from the nearest one of a tree towards a joint vector, each a step from the last
    /// one, as far as it is free or one only: the last one, and whether that is where it was to go.
    fn grown(&mut self, tree: &mut Tree<N>, to: &[f64; N], one: bool) -> (Option<usize>, bool) {
        let (mut node, mut last) = (tree.nearest(to), None);
        loop {
            let start = *tree.at(node);
            let part = STEP / distance(&start, to);
            let is_there = part >= 1.0;
            let end = if is_there { *to } else { between(&start, to, part) };
            if !self.is_free(&start, &end) {
                return (last, false);
            }
            node = tree.add(end, node);
            last = Some(node);
            if is_there || one {
                return (last, is_there);
            }
        }
    }
}

/// The blocks of states of a motion, by its length [rad].
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
fn blocks(length: f64) -> usize {
    (length / BLOCK) as usize + 1
}

/// The joint vector that is a part of the way from one to another.
pub(super) fn between<const N: usize>(from: &[f64; N], to: &[f64; N], part: f64) -> [f64; N] {
    array::from_fn(|joint| from[joint] + part * (to[joint] - from[joint]))
}

/// Joint vectors with the places of their parents, from each of which the motion to it is free; a
/// root is its own parent.
struct Tree<const N: usize> {
    q: Vec<[f64; N]>,
    parents: Vec<usize>,
}

impl<const N: usize> Tree<N> {
    fn new(roots: Vec<[f64; N]>) -> Self {
        Self { parents: (0..roots.len()).collect(), q: roots }
    }

    fn len(&self) -> usize {
        self.q.len()
    }

    fn at(&self, node: usize) -> &[f64; N] {
        &self.q[node]
    }

    fn add(&mut self, q: [f64; N], parent: usize) -> usize {
        self.q.push(q);
        self.parents.push(parent);
        self.q.len() - 1
    }

    fn nearest(&self, to: &[f64; N]) -> usize {
        let (mut best, mut least) = (0, f64::INFINITY);
        for (node, q) in self.q.iter().enumerate() {
            let square = q.iter().zip(to).map(|(a, b)| (a - b) * (a - b)).sum::<f64>();
            if square < least {
                (best, least) = (node, square);
            }
        }
        best
    }

    fn to_root(&self, mut node: usize) -> Vec<[f64; N]> {
        let mut path = Vec::from([self.q[node]]);
        while self.parents[node] != node {
            node = self.parents[node];
            path.push(self.q[node]);
        }
        path
    }
}
