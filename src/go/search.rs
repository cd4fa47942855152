//! Two trees of free motions, from the start and from the goal, until they meet (RRT-Connect:
//! Kuffner and LaValle, 2000).

use alloc::vec::Vec;
use core::array;
use core::mem::swap;

use super::samples::Samples;
use super::tree::Tree;
use crate::cell::{Cell, Placed};
use crate::error::Error;
use crate::go::fault::GoFault;
use crate::interrupt::Interrupt;
use crate::kinematics::Robot;
use crate::trajectory::distance;

/// Links that come nearer than this count as touching in the search [m].
pub(super) const RESOLUTION: f64 = 1e-3;

/// Length of an edge of a tree [rad].
const STEP: f64 = 1.0;

/// Even motions that are tried first.
const DIRECT: usize = 16;

/// Most nodes of both trees: they fill 13 MB.
const MOST_NODES: usize = 200_000;

/// Where a free motion is sought.
pub(super) struct Space<'a, const N: usize> {
    pub(super) robot: &'a Robot<N>,
    pub(super) cell: &'a Cell,
    pub(super) placed: Placed<'a, N>,
}

impl<const N: usize> Space<'_, N> {
    /// How much of the even motion between two joint vectors is free, as a part of it.
    pub(super) fn free_part(&mut self, from: &[f64; N], to: &[f64; N]) -> f64 {
        self.cell.free_part(&mut self.placed, [from, to], RESOLUTION)
    }

    /// The shortest even motion from a start to a goal, of those that are free.
    pub(super) fn direct(&mut self, [starts, goals]: &[Vec<[f64; N]>; 2]) -> Option<Vec<[f64; N]>> {
        let goals = |start| goals.iter().map(move |goal| (distance(start, goal), [start, goal]));
        let mut both: Vec<_> = starts.iter().flat_map(goals).collect();
        both.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        let mut nearest = both.into_iter().take(DIRECT).map(|(_, ends)| ends);
        let ends = nearest.find(|[start, goal]| self.free_part(start, goal) >= 1.0)?;
        Some(ends.map(|q| *q).into())
    }

    /// A path from a start to a goal: even motions that are free.
    pub(super) fn path(
        &mut self,
        [starts, goals]: [Vec<[f64; N]>; 2],
        mut from: Samples<N>,
        interrupt: Interrupt<'_>,
    ) -> Result<Vec<[f64; N]>, Error> {
        let (mut own, mut other) = (Tree::new(starts), Tree::new(goals));
        let (mut samples, mut is_swapped) = (0, false);
        while !interrupt.is_raised() && own.len() + other.len() < MOST_NODES {
            samples += 1;
            let sample = from.next();
            if self.robot.limits().contains(&sample) {
                let (node, _) = self.grown(&mut own, &sample, STEP);
                if let Some(node) = node {
                    let target = *own.at(node);
                    let (met, is_there) = self.grown(&mut other, &target, f64::INFINITY);
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
        Err(GoFault::NotFound { samples }.into())
    }

    /// Add nodes from the nearest one of a tree towards a joint vector, as far as it is free and at
    /// most `most` far [rad]: the last one, and whether that is where it was to go.
    fn grown(&mut self, tree: &mut Tree<N>, to: &[f64; N], most: f64) -> (Option<usize>, bool) {
        let mut node = tree.nearest(to);
        let start = *tree.at(node);
        let length = distance(&start, to);
        if length == 0.0 {
            return (Some(node), true);
        }
        let whole = (most / length).min(1.0);
        let at =
            |part: f64| array::from_fn(|joint| start[joint] + part * (to[joint] - start[joint]));
        let end = if whole < 1.0 { at(whole) } else { *to };
        let free = self.free_part(&start, &end);
        let (mut last, mut part) = (None, STEP / length);
        while part < free * whole {
            node = tree.add(at(part), node);
            last = Some(node);
            part += STEP / length;
        }
        if free >= 1.0 {
            last = Some(tree.add(end, node));
        }
        (last, free >= 1.0 && whole >= 1.0)
    }
}
