//! The narrow phase: what capsules leave undecided, by separating planes and distances of hulls
//! (docs/theory/cell.md, hulls of links).

use core::array;
use core::mem::take;

use fearless_simd::prelude::*;
use nalgebra::Vector3;

use super::block::{Block, CollisionKernel, ROUNDING};
use super::distance_bounds::{
    Axis, Plane, Point, ball_beyond, constant, load, minus, plane_across, plane_to,
};
use super::link_motion::Drift;
use crate::body::{Centered, DistanceQuery, RoundedHull, SeparatingDirection, Shape};
use crate::prelude::*;
use irbkin::internal::lanes::{Column, Number as _, Vector, dot};

/// Numbers of directions between two groups: more hulls than these have some in common.
const OF_PAIR: usize = 11;

/// Separating directions that are kept.
const DIRECTIONS: usize = 128;

impl Block {
    /// Make room for all places that may be undecided, so that none is made later.
    pub(super) fn reserve(&mut self, places: usize) {
        self.undecided.reserve(places);
        self.places.reserve(places + 1);
        self.directions.resize(DIRECTIONS, (0, None));
    }
}

/// Where the search for a separating plane along a line stops, between the distance at which a pair
/// certainly does not touch (0) and the one at which it does (1): nearer pairs take the longest and
/// are hardly ever apart.
const SEARCH_END: f64 = 0.5;

/// How far points move at least where it goes on so far [m]: the last parts before a contact are
/// decided by the distance alone, the same of a box and of its mesh.
const LEAST: f64 = 1e-3;

/// A hull of a link, and the hull or obstacle that it is compared with.
struct HullPair<'a, S: Simd> {
    link: usize,
    hull: &'a RoundedHull,
    other: Counterpart<'a>,
    /// Distances above which they are certain to stay apart, and the one above which they are [m].
    limits: &'a Column,
    least: f64,
    drift: &'a Drift<S>,
}

/// A hull of a link, or an obstacle.
enum Counterpart<'a> {
    Hull(usize, &'a RoundedHull),
    Shape(&'a Shape),
}

impl CollisionKernel<'_> {
    /// Decide by hulls what capsules leave undecided.
    #[inline(always)]
    pub(super) fn decide<S: Simd>(&mut self, simd: S) {
        while let Some((at, lanes)) = self.block.undecided.pop() {
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
        let limits = &array::from_fn(|lane| ROUNDING + self.hulls_moved(pair[1], one.link, lane));
        let limit = Vector::load_array_ref(simd, limits);
        let drift = self.hulls_drift(simd, pair[1], one.link);
        let hulls = one.hulls.iter().flat_map(|own| other.hulls.iter().map(move |two| [own, two]));
        for (number, [own, two]) in (OF_PAIR * at..).zip(hulls) {
            if lanes & self.asked == 0 || self.is_done() {
                return;
            }
            let center = self.placed(simd, other.link, two.center());
            let way = minus(self.placed(simd, one.link, own.center()), center);
            let balls = limit + (own.ball() + two.ball());
            let are_near = dot(way, way).simd_le(balls * balls).to_bitmask();
            let mut open = lanes & self.asked & are_near;
            if open == 0 {
                continue;
            }
            let both = HullPair {
                link: one.link,
                hull: own,
                other: Counterpart::Hull(other.link, two),
                limits,
                least: ROUNDING,
                drift: &drift,
            };
            open &= !self.beyond(simd, &both, &self.plane(simd, other.link, two, way));
            if open != 0 {
                let axis = self.axis_in(simd, other.link, two);
                let way = self.axis_in(simd, one.link, own).way_from(&axis).0;
                open &= !self.beyond(simd, &both, &self.plane(simd, other.link, two, way));
            }
            self.settle(simd, [at, number], &both, open);
        }
    }

    #[inline(always)]
    fn decide_obstacle<S: Simd>(&mut self, simd: S, at: usize, place: usize, lanes: u64) {
        let groups = &self.outline.groups;
        let (group, shape) = (place % groups.len(), self.cell.part(place / groups.len()));
        let (own, least) = (&groups[group], ROUNDING + self.cell.margin());
        let limits = &array::from_fn(|lane| least + self.hulls_moved(group, 0, lane));
        let limit = Vector::load_array_ref(simd, limits);
        let drift = self.hulls_drift(simd, group, 0);
        for (number, hull) in (OF_PAIR * at..).zip(&own.hulls) {
            if lanes & self.asked == 0 || self.is_done() {
                return;
            }
            let center = self.placed(simd, own.link, hull.center());
            let mut open = lanes & self.asked & !ball_beyond(shape, center, limit + hull.ball());
            if open == 0 {
                continue;
            }
            let other = Counterpart::Shape(shape);
            let two = HullPair { link: own.link, hull, other, limits, least, drift: &drift };
            if let Some(plane) = plane_to(shape, &self.axis_in(simd, own.link, hull)) {
                open &= !self.beyond(simd, &two, &plane);
            }
            self.settle(simd, [at, number], &two, open);
        }
    }

    /// Decide lanes of a pair, whose separating directions have a number, by its distance.
    #[inline(always)]
    fn settle<S: Simd>(
        &mut self,
        simd: S,
        [at, number]: [usize; 2],
        two: &HullPair<'_, S>,
        mut lanes: u64,
    ) {
        // Joint vectors that are near each other have separating directions in common.
        let has_directions = self.is_swept() || self.is_enough();
        let mut directions = take(&mut self.block.directions);
        lanes &= self.asked;
        while lanes != 0 && !self.is_done() {
            let lane = lanes.trailing_zeros() as usize;
            lanes &= lanes - 1;
            let far = two.limits[lane];
            let moved = far - two.least;
            let near = if self.has_lines && moved > LEAST { far - SEARCH_END * moved } else { far };
            let mut none = None;
            let way = if has_directions { direction(&mut directions, number) } else { &mut none };
            let found = self.distance(two, lane, DistanceQuery { far, near }, way);
            let mut beyond = u64::from(found > far) << lane;
            // The plane that keeps them apart may do so in other lanes, and along a line.
            if let Some(way) = way
                && has_directions
                && found > near
                && (lanes != 0 || beyond == 0)
            {
                beyond |= self.beyond_across(simd, two, way);
            }
            lanes &= !beyond;
            if beyond >> lane & 1 == 0 {
                self.asked &= !(1 << lane);
                self.block.last = at;
            }
        }
        self.block.directions = directions;
    }

    /// How far two are apart in a lane [m], or what of it is asked, by a way in the frame of the first
    /// link, or of the cell before an obstacle.
    fn distance<S: Simd>(
        &self,
        two: &HullPair<'_, S>,
        lane: usize,
        asked: DistanceQuery,
        way: &mut SeparatingDirection,
    ) -> f64 {
        let pose = |link: usize| self.block.frames[link].pose(lane);
        let apart = match two.other {
            Counterpart::Hull(link, hull) => {
                two.hull.separation(&pose(two.link), (hull, &pose(link)), asked, way)
            }
            Counterpart::Shape(shape) => {
                shape.separation_of_hull(two.hull, &pose(two.link), asked, way)
            }
        };
        apart.distance
    }

    /// The lanes in which a plane across such a way keeps two apart.
    #[inline(always)]
    fn beyond_across<S: Simd>(&self, simd: S, two: &HullPair<'_, S>, way: &Vector3<f64>) -> u64 {
        let plane = match two.other {
            Counterpart::Hull(link, hull) => {
                Some(self.plane(simd, link, hull, self.turned(simd, two.link, way)))
            }
            Counterpart::Shape(shape) => plane_across(shape, constant(simd, way)),
        };
        plane.map_or(0, |plane| self.beyond(simd, two, &plane))
    }

    /// The lanes in which the first one of two is farther beyond a plane than they may be, or stays
    /// beyond it.
    fn beyond<S: Simd>(&self, simd: S, two: &HullPair<'_, S>, plane: &Plane<S>) -> u64 {
        // A function of its own for each instruction set: it is long.
        simd.vectorize(
            #[inline(always)]
            || {
                let back = [-plane.way[0], -plane.way[1], -plane.way[2]];
                let gap = -self.reach(simd, two.link, two.hull, back) - plane.reach;
                let radius = two.hull.radius();
                let limit = Vector::load_array_ref(simd, two.limits);
                let beyond = plane.is_below(gap, limit + radius);
                if self.has_lines {
                    beyond | two.drift.leaves(plane, gap, two.least + radius)
                } else {
                    beyond
                }
            },
        )
    }

    /// The plane across a way beyond which a hull of a link does not go.
    #[inline(always)]
    fn plane<S: Simd>(&self, simd: S, link: usize, hull: &RoundedHull, way: Point<S>) -> Plane<S> {
        Plane { way, reach: self.reach(simd, link, hull, way), radius: hull.radius() }
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
        let frame = &self.block.frames[link];
        let (x, y, z) = (load(simd, &frame.x), load(simd, &frame.y), load(simd, &frame.z));
        let own = [dot(way, x), dot(way, y), dot(way, z)];
        dot(way, load(simd, &frame.origin)) + hull.reach(simd, &own)
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
        self.block.moves[self.block.seen(group, from)][lane] + own.beyond * farther
    }
}

/// The separating direction of a number.
fn direction(
    directions: &mut Vec<(usize, SeparatingDirection)>,
    number: usize,
) -> &mut SeparatingDirection {
    directions.resize(DIRECTIONS, (0, None));
    let (own, way) = &mut directions[number % DIRECTIONS];
    if *own != number {
        (*own, *way) = (number, None);
    }
    way
}
