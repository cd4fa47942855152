//! One joint vector among obstacles: up to eight groups of capsules at once beside each of them.
//!
//! The lanes of a block would be empty but for one: among 3 obstacles that takes 6 to 13 % more
//! instructions for a posture, among 20 half as many more.

use fearless_simd::prelude::*;

use super::block::{Block, ROUNDING, bits};
use super::distance_bounds::{ALL, Point, ball_beyond, inverse_of, is_beyond_box, load};
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
            let [mut middles, mut halves] = [[[0.0; LANES]; 3]; 2];
            let [mut inverses, mut radii, mut balls] = [[0.0; LANES]; 3];
            for lane in 0..groups.len() {
                let [middle, half] = &around[lane];
                for axis in 0..3 {
                    middles[axis][lane] = middle[axis][0];
                    halves[axis][lane] = half[axis][0];
                }
                let own = &groups[lane].around;
                inverses[lane] = inverse_of(own.square);
                radii[lane] = self.limit + own.radius;
                balls[lane] = self.limit + own.ball;
            }
            let [centers, halves] = [&middles, &halves].map(|columns| load(simd, columns));
            let [inverses, reaches, limits] =
                [&inverses, &radii, &balls].map(|column| Vector::load_array_ref(simd, column));
            let axes = [centers, halves];
            let is_touched = self.any_touches(groups, self.cell.endless(), centers, limits)
                || self.cell.tree().stops_near(
                    #[inline(always)]
                    |bounds| is_beyond_box(bounds, axes, inverses, reaches) != ALL,
                    #[inline(always)]
                    |parts| self.any_touches(groups, parts.iter().copied(), centers, limits),
                );
            if is_touched {
                return true;
            }
        }
        false
    }
}

impl PostureKernel<'_> {
    /// Whether any of the groups, which have these balls in the lanes, touches any of some parts.
    #[inline(always)]
    fn any_touches<S: Simd>(
        &self,
        groups: &[Group],
        parts: impl Iterator<Item = usize>,
        centers: Point<S>,
        limits: Vector<S>,
    ) -> bool {
        for part in parts {
            let near = !ball_beyond(self.cell.part(part), centers, limits);
            if near & ALL != 0 && self.touches(groups, part, near) {
                return true;
            }
        }
        false
    }

    /// Whether any of the groups that are near a part of an obstacle, as bits, touches it.
    fn touches(&self, groups: &[Group], part: usize, near: u64) -> bool {
        let shape = self.cell.part(part);
        bits(near).filter_map(|lane| groups.get(lane)).any(|group| {
            if !self.cell.compares(part, group.number) {
                return false;
            }
            let pose = self.block.frames[group.link].pose(0);
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
