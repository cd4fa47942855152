//! What capsules leave in doubt, decided by hulls (docs/theory/cell.md, hulls of links).

use alloc::vec::Vec;
use core::array;
use core::mem::take;

use fearless_simd::prelude::*;
use nalgebra::Vector3;

use super::apart::{Axis, Plane, Point, ball_beyond, load, minus, plane_to};
use super::block::{Block, ROUNDING, Touch, bits};
use super::drift::Drift;
use crate::body::{Asked, Centered, RoundedHull, Way};
use crate::lanes::{Column, Number as _, Vector, dot};

/// Numbers of ways between two groups: more hulls than these have some in common.
const OF_TWO: usize = 11;

/// Ways that are kept.
const WAYS: usize = 128;

impl<const N: usize> Block<N> {
    /// Make room for doubts about all places, so that none is made later.
    pub(super) fn reserve(&mut self, places: usize) {
        self.doubts.reserve(places);
        self.ways.resize(WAYS, (0, None));
    }
}

impl<const N: usize> Touch<'_, N> {
    /// Decide by hulls what is in doubt.
    #[inline(always)]
    pub(super) fn decide<S: Simd>(&mut self, simd: S) {
        while let Some((at, lanes)) = self.block.doubts.pop() {
            let pairs = &self.outline.pairs;
            match pairs.get(at) {
                Some(pair) => self.decide_links(simd, at, *pair, lanes),
                None => self.decide_obstacle(simd, at, at - pairs.len(), lanes),
            }
        }
    }

    #[inline(always)]
    fn decide_links<S: Simd>(&mut self, simd: S, at: usize, pair: [usize; 2], lanes: u64) {
        let [one, other] = pair.map(|group| &self.outline.groups[group]);
        let limits = array::from_fn(|lane| ROUNDING + self.hulls_moved(pair[1], one.link, lane));
        let limit = Vector::load_array_ref(simd, &limits);
        let drift = self.hulls_drift(simd, pair[1], one.link);
        let hulls = one.hulls.iter().flat_map(|own| other.hulls.iter().map(move |two| [own, two]));
        for (number, [own, two]) in (OF_TWO * at..).zip(hulls) {
            if lanes & self.asked == 0 || self.is_done() {
                return;
            }
            let center = self.placed(simd, other.link, two.center());
            let mut way = minus(self.placed(simd, one.link, own.center()), center);
            let balls = limit + (own.ball() + two.ball());
            let are_near = dot(way, way).simd_le(balls * balls).to_bitmask();
            let mut open = lanes & self.asked & are_near;
            if open == 0 {
                continue;
            }
            let facing = self.axis_in(simd, other.link, two);
            let axis = self.axis_in(simd, one.link, own);
            for _ in 0..2 {
                let reach = self.reach(simd, other.link, two, way);
                let plane = Plane { way, reach, radius: two.radius() };
                let gap = self.gap(simd, one.link, own, &plane);
                open &= !plane.is_below(gap, limit + own.radius());
                if self.has_lines {
                    open &= !drift.leaves(&plane, gap, own.radius() + ROUNDING);
                }
                if open == 0 {
                    break;
                }
                way = axis.way_from(&facing).0;
            }
            self.settle([at, number], open, &limits, |block, lane, asked, way| {
                let [pose, to] = [one.link, other.link].map(|link| block.frame(link).pose(lane));
                own.separation(&pose, (two, &to), asked, way).distance
            });
        }
    }

    #[inline(always)]
    fn decide_obstacle<S: Simd>(&mut self, simd: S, at: usize, place: usize, lanes: u64) {
        let groups = &self.outline.groups;
        let (group, shape) = (place % groups.len(), &self.cell.obstacles()[place / groups.len()].1);
        let (own, margin) = (&groups[group], ROUNDING + self.cell.margin());
        let limits = array::from_fn(|lane| margin + self.hulls_moved(group, 0, lane));
        let limit = Vector::load_array_ref(simd, &limits);
        let drift = self.hulls_drift(simd, group, 0);
        for (number, hull) in (OF_TWO * at..).zip(&own.hulls) {
            if lanes & self.asked == 0 || self.is_done() {
                return;
            }
            let center = self.placed(simd, own.link, hull.center());
            let mut open = lanes & self.asked & !ball_beyond(shape, center, limit + hull.ball());
            if open == 0 {
                continue;
            }
            if let Some(plane) = plane_to(shape, &self.axis_in(simd, own.link, hull)) {
                let gap = self.gap(simd, own.link, hull, &plane);
                open &= !plane.is_below(gap, limit + hull.radius());
                if self.has_lines {
                    open &= !drift.leaves(&plane, gap, hull.radius() + margin);
                }
            }
            self.settle([at, number], open, &limits, |block, lane, asked, way| {
                let pose = block.frame(own.link).pose(lane);
                shape.separation_of_hull(hull, &pose, asked, way).distance
            });
        }
    }

    /// Decide lanes of two hulls or a hull and a shape, the ways of which have a number, by their
    /// distance: whether it is above a limit [m].
    #[inline(always)]
    fn settle(
        &mut self,
        [at, number]: [usize; 2],
        lanes: u64,
        limits: &Column,
        distance: impl Fn(&Block<N>, usize, Asked, &mut Way) -> f64,
    ) {
        // Joint vectors that are near each other have ways in common.
        let mut ways = take(&mut self.block.ways);
        for lane in bits(lanes & self.asked) {
            let asked = Asked::whether_above(limits[lane]);
            let mut none = None;
            let way =
                if self.is_swept() || self.is_enough() { of(&mut ways, number) } else { &mut none };
            if !self.is_done() && distance(self.block, lane, asked, way) <= limits[lane] {
                self.asked &= !(1 << lane);
                self.block.last = at;
            }
        }
        self.block.ways = ways;
    }

    /// The axis of the capsule inside of a hull of a link, or its middle.
    #[inline(always)]
    fn axis_in<S: Simd>(&self, simd: S, link: usize, hull: &RoundedHull) -> Axis<S> {
        let core = hull.core().map(Centered::of);
        let (center, half) =
            core.map_or((*hull.center(), Vector3::zeros()), |core| (core.center, core.half));
        let middle = self.placed(simd, link, &center);
        Axis::new(middle, self.turned(simd, link, &half), half.norm_squared())
    }

    /// How far the points of a hull of a link reach along ways, times their lengths.
    #[inline(always)]
    fn reach<S: Simd>(&self, simd: S, link: usize, hull: &RoundedHull, way: Point<S>) -> Vector<S> {
        let frame = self.block.frame(link);
        let (x, y, z) = (load(simd, &frame.x), load(simd, &frame.y), load(simd, &frame.z));
        let own = [dot(way, x), dot(way, y), dot(way, z)];
        dot(way, load(simd, &frame.origin)) + hull.reach(simd, &own)
    }

    /// How far the points of a hull of a link are beyond a plane, times the length of its way.
    #[inline(always)]
    fn gap<S: Simd>(
        &self,
        simd: S,
        link: usize,
        hull: &RoundedHull,
        plane: &Plane<S>,
    ) -> Vector<S> {
        let back = [-plane.way[0], -plane.way[1], -plane.way[2]];
        -self.reach(simd, link, hull, back) - plane.reach
    }

    /// How a group moves, with what its hulls reach beyond its capsules.
    #[inline(always)]
    fn hulls_drift<S: Simd>(&self, simd: S, group: usize, from: usize) -> Drift<S> {
        let own = &self.outline.groups[group];
        let mut drift = self.drift(simd, group, from);
        if !self.has_lines {
            return drift;
        }
        let (mut moved, mut bent) = (drift.bent.like(0.0), drift.bent.like(0.0));
        for joint in (from..own.link).rev() {
            let span = Vector::load_array_ref(simd, &self.block.spans[joint]);
            let beside = Vector::load_array_ref(simd, &self.block.beside[joint]);
            let radius = moved + 1.0;
            let turned = span * radius;
            bent = beside.times_plus(radius, span.times_plus(turned.scaled_plus(0.5, moved), bent));
            moved += turned;
        }
        drift.bent = bent.scaled_plus(own.beyond, drift.bent);
        drift.extent = own.spread + own.beyond;
        drift
    }

    /// How far points of hulls of a group move, seen from a link; zero for joint vectors (eq. 8).
    fn hulls_moved(&self, group: usize, from: usize, lane: usize) -> f64 {
        let own = &self.outline.groups[group];
        if !self.is_swept() || own.link <= from {
            return 0.0;
        }
        let spans = self.block.spans[from..own.link].iter();
        let farther = spans.map(|span| 1.0 + span[lane]).product::<f64>() - 1.0;
        self.block.moves[group][from][lane] + own.beyond * farther
    }
}

/// The way of a number.
fn of(ways: &mut Vec<(usize, Way)>, number: usize) -> &mut Way {
    ways.resize(WAYS, (0, None));
    let (own, way) = &mut ways[number % WAYS];
    if *own != number {
        (*own, *way) = (number, None);
    }
    way
}
