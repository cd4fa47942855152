//! One joint vector among obstacles: up to eight groups of capsules at once beside each of them.
//!
//! The lanes of a block would be empty but for one: among 3 obstacles that takes 6 to 13 % more
//! instructions for a posture, among 20 half as many more.

use fearless_simd::prelude::*;

use super::block::{Block, ROUNDING, bits};
use super::distance_bounds::{ball_beyond, load};
use super::obstacles::Cell;
use crate::body::{Centered, DistanceQuery, Group, Outline};
use irbkin::internal::lanes::{LANES, Vector, VectorKernel, run_vectors};

/// Whether an arm touches an obstacle where the first lane of a block has it.
pub(super) fn is_obstructed(block: &Block, outline: &Outline, cell: &Cell) -> bool {
    let limit = cell.margin() + ROUNDING;
    !cell.obstacles().is_empty() && run_vectors(PostureKernel { block, outline, cell, limit })
}

struct PostureKernel<'a> {
    block: &'a Block,
    outline: &'a Outline,
    cell: &'a Cell,
    /// How near an obstacle may be and count as touched [m].
    limit: f64,
}

impl VectorKernel for PostureKernel<'_> {
    type Answer = bool;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> bool {
        for (groups, around) in
            self.outline.groups.chunks(LANES).zip(self.block.around.chunks(LANES))
        {
            let (mut centers, mut limits) = ([[0.0; LANES]; 3], [0.0; LANES]);
            for lane in 0..groups.len() {
                let [center, _] = &around[lane];
                (centers[0][lane], centers[1][lane], centers[2][lane]) =
                    (center[0][0], center[1][0], center[2][0]);
                limits[lane] = self.limit + groups[lane].around.ball;
            }
            let (centers, limits) = (load(simd, &centers), Vector::load_array_ref(simd, &limits));
            for at in 0..self.cell.obstacles().len() {
                let far = ball_beyond(&self.cell.obstacles()[at].1, centers, limits);
                if self.touches(groups, at, !far) {
                    return true;
                }
            }
        }
        false
    }
}

impl PostureKernel<'_> {
    /// Whether any of the groups that are near an obstacle, as bits, touches it.
    fn touches(&self, groups: &[Group], obstacle: usize, near: u64) -> bool {
        let shape = &self.cell.obstacles()[obstacle].1;
        bits(near).filter_map(|lane| groups.get(lane)).any(|group| {
            if !self.cell.compares(obstacle, group.number) {
                return false;
            }
            let pose = self.block.frame(group.link).pose(0);
            let is_near = |own: &Centered| {
                let center = pose.rotation * own.center + pose.translation.vector;
                shape.is_within(&own.at(center, pose.rotation * own.half), self.limit)
            };
            is_near(&group.around)
                && self.outline.capsules[group.capsules.clone()].iter().any(is_near)
                && (!group.has_hulls
                    || self.outline.capsules[group.cores.clone()].iter().any(is_near)
                    || group.hulls.iter().any(|hull| {
                        let asked = DistanceQuery::whether_above(self.limit);
                        let apart = shape.separation_of_hull(hull, &pose, asked, &mut None);
                        apart.distance <= self.limit
                    }))
        })
    }
}
