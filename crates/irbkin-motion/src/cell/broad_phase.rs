//! The broad phase: what of an arm may touch itself or obstacles, by bounds around groups of capsules,
//! then by the capsules; what these leave undecided is for the narrow phase.

use fearless_simd::prelude::*;

use super::block::{CollisionKernel, QueryKind, ROUNDING, bits};
use super::distance_bounds::{against_shape, ball_beyond, load};
use irbkin::internal::lanes::{Number as _, Vector};

impl CollisionKernel<'_> {
    /// Look at two groups of capsules of the arm.
    #[inline(always)]
    pub(super) fn apart_of_links<S: Simd>(&mut self, simd: S, at: usize) {
        let pair = self.outline.pairs[at];
        let [one, other] = pair.map(|group| &self.outline.groups[group]);
        let moved = self.moved(simd, pair[1], one.link) + ROUNDING;
        let around = moved + (one.around.radius + other.around.radius);
        let facing = self.around(simd, pair[1]);
        let near =
            self.asked & !self.around(simd, pair[0]).against_axis(&facing, around, self.asked).far;
        if near == 0 {
            return;
        }
        let drift = self.drift(simd, pair[1], one.link);
        let mut near = near;
        if self.has_lines {
            let limit = ROUNDING + (one.around.radius + other.around.radius);
            let plane = self.around(simd, pair[0]).plane_to(&facing);
            near &= !drift.stays_beyond(&plane, &facing, limit);
            if near == 0 {
                return;
            }
        }
        self.place(simd, pair[0]);
        self.place(simd, pair[1]);
        let mut doubtful = 0;
        for index in one.capsules.clone() {
            let capsule = &self.outline.capsules[index];
            let own = self.axis(simd, index);
            let limit = moved + (capsule.radius + other.around.radius);
            let near = near & self.asked & !doubtful;
            let near = near & !own.against_axis(&facing, limit, near).far;
            if near == 0 {
                continue;
            }
            for second in other.capsules.clone() {
                let limit = moved + (capsule.radius + self.outline.capsules[second].radius);
                let asked = near & !doubtful;
                let two = self.axis(simd, second);
                let decided = own.against_axis(&two, limit, asked);
                let mut asked = asked & !decided.far;
                if self.has_lines && asked != 0 {
                    let radii = capsule.radius + self.outline.capsules[second].radius;
                    asked &= !drift.stays_beyond(&own.plane_to(&two), &two, ROUNDING + radii);
                }
                let open = asked & !decided.near;
                doubtful |= asked & decided.near;
                if open != 0 {
                    doubtful |= self.settle_links(open, [index, second], limit);
                }
            }
        }
        if doubtful == 0 || self.look == QueryKind::Roughly || !(one.has_hulls || other.has_hulls) {
            self.asked &= !doubtful;
            return;
        }
        for first in one.cores.clone() {
            for second in other.cores.clone() {
                let both = [first, second].map(|core| &self.outline.capsules[core]);
                let limit = moved.like(both[0].radius + both[1].radius);
                let (own, facing) = (self.axis(simd, first), self.axis(simd, second));
                self.asked &= !(doubtful & own.against_axis(&facing, limit, doubtful).near);
            }
        }
        self.block.undecided.push((at, doubtful));
    }

    /// Look at a group of capsules and a part of an obstacle.
    #[inline(always)]
    pub(super) fn apart_of_part<S: Simd>(&mut self, simd: S, place: usize, at: usize) {
        let groups = &self.outline.groups;
        let (part, group) = (place / groups.len(), place % groups.len());
        let (own, shape) = (&groups[group], self.cell.part(part));
        if !self.cell.compares(part, own.number) {
            return;
        }
        let margin = self.cell.margin() + ROUNDING;
        let moved = self.moved(simd, group, 0) + margin;
        let center = load(simd, &self.block.around[group][0]);
        let near = self.asked & !ball_beyond(shape, center, moved + own.around.ball);
        if near == 0 {
            return;
        }
        let limit = moved + own.around.radius;
        let around = self.around(simd, group);
        let mut near = near & !against_shape(&around, shape, limit, near).far;
        if near == 0 {
            return;
        }
        let drift = self.drift(simd, group, 0);
        if self.has_lines {
            near &= !drift.stays_off(shape, &around, margin + own.around.radius);
            if near == 0 {
                return;
            }
        }
        self.place(simd, group);
        let mut doubtful = 0;
        for index in own.capsules.clone() {
            let radius = self.outline.capsules[index].radius;
            let axis = self.axis(simd, index);
            let asked = near & self.asked & !doubtful;
            let decided = against_shape(&axis, shape, moved + radius, asked);
            let mut asked = asked & !decided.far;
            if self.has_lines && asked != 0 {
                asked &= !drift.stays_off(shape, &axis, margin + radius);
            }
            let open = asked & !decided.near;
            doubtful |= asked & decided.near;
            if open != 0 {
                doubtful |= self.settle_obstacle(open, [index, part], moved);
            }
        }
        if doubtful == 0 || self.look == QueryKind::Roughly || !own.has_hulls {
            self.asked &= !doubtful;
            return;
        }
        for core in own.cores.clone() {
            let limit = moved.like(margin + self.outline.capsules[core].radius);
            let decided = against_shape(&self.axis(simd, core), shape, limit, doubtful);
            self.asked &= !(doubtful & decided.near);
        }
        self.block.undecided.push((at, doubtful));
    }

    /// The lanes in which two capsules touch, of those that bounds leave open.
    #[cold]
    #[inline(never)]
    fn settle_links<S: Simd>(&self, open: u64, [one, other]: [usize; 2], limit: Vector<S>) -> u64 {
        let radii = self.outline.capsules[one].radius + self.outline.capsules[other].radius;
        lanes_in(open, |lane| {
            let own = self.block.capsule(self.outline, one, lane);
            let apart = own.separation(&self.block.capsule(self.outline, other, lane));
            apart.distance <= limit.as_array()[lane] - radii
        })
    }

    /// The lanes in which a capsule and an obstacle touch, of those that bounds leave open.
    #[cold]
    #[inline(never)]
    fn settle_obstacle<S: Simd>(&self, open: u64, [own, at]: [usize; 2], least: Vector<S>) -> u64 {
        lanes_in(open, |lane| {
            let capsule = self.block.capsule(self.outline, own, lane);
            self.cell.part(at).is_within(&capsule, least.as_array()[lane])
        })
    }
}

/// The lanes of some, as bits, for which something is so.
fn lanes_in(lanes: u64, is_so: impl Fn(usize) -> bool) -> u64 {
    bits(lanes).filter(|lane| is_so(*lane)).fold(0, |all, lane| all | 1 << lane)
}
