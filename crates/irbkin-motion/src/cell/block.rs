//! Eight joint vectors, or boxes of joint vectors, at once: which of them touch something.

use core::mem::take;

use fearless_simd::prelude::*;
use nalgebra::Vector3;

use super::distance_bounds::{ALL, Axis, Point, inverse_of, is_beyond_box, load, minus};
use super::link_motion::Drift;
use super::obstacles::Cell;
use super::path::Range;
use crate::body::{Capsule, Group, Outline, SeparatingDirection};
use crate::prelude::*;
use irbkin::Robot;
use irbkin::internal::Axes;
use irbkin::internal::lanes::{
    Column, LANES, Number as _, Vector, VectorKernel, cross, dot, run_vectors,
};

/// How near shapes may be and count as touching, for the rounding of poses and distances [m].
pub(super) const ROUNDING: f64 = 1e-9;

/// What of joint vectors is looked at.
#[derive(Clone, Copy)]
pub(super) enum Query<'a, const N: usize> {
    /// Which of them touch something.
    All,
    /// One that touches something, if there is one.
    Any,
    /// Which of them may touch something while the joints are in ranges of which they are the middles.
    Swept(&'a [Range<N>]),
    /// As [`Self::Swept`], by capsules alone.
    Roughly(&'a [Range<N>]),
}

/// What the kernel looks at: [`Query`] for any number of joints, so that it is compiled once.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum QueryKind {
    All,
    Any,
    Swept,
    Roughly,
}

/// Where everything of an arm is, in eight lanes.
#[derive(Clone, Default)]
pub(crate) struct Block {
    /// The frames of the base and of each joint's link.
    pub(super) frames: Vec<Axes<LANES>>,
    /// How far the joints turn to either side [rad]; zero for joint vectors.
    pub(super) spans: Vec<Column>,
    /// How far they do along a line, and beside it.
    pub(super) turns: Vec<Column>,
    pub(super) beside: Vec<Column>,
    /// The middles and the halves of the axes of the capsules around the groups.
    pub(super) around: Vec<[[Column; 3]; 2]>,
    /// How far the axes of a group move, by the link from which it is seen: [`Self::seen`].
    pub(super) moves: Vec<Column>,
    /// How far they are then from where their velocities would lead.
    pub(super) bends: Vec<Column>,
    /// The middles and the halves of the capsules' axes, of the groups that are placed.
    axes: Vec<[[Column; 3]; 2]>,
    is_placed: Vec<bool>,
    /// Pairs of links, and groups with parts of obstacles, to look at, by their places among all.
    pub(super) places: Vec<usize>,
    /// What hulls are to decide, by its place among all that is looked at, and the lanes, as bits.
    pub(super) undecided: Vec<(usize, u64)>,
    /// Ways that hulls were apart along, with the numbers of two.
    pub(super) directions: Vec<(usize, SeparatingDirection)>,
    /// What touched last, by its place.
    pub(super) last: usize,
}

impl Block {
    pub(super) fn new<const N: usize>(robot: &Robot<N>, outline: &Outline) -> Self {
        let mut block = Self::default();
        block.fit(robot, outline);
        block
    }

    /// Take the place of the memory for another arm, of which no answer is left.
    pub(super) fn fit<const N: usize>(&mut self, robot: &Robot<N>, outline: &Outline) {
        let (groups, zero) = (outline.groups.len(), [0.0; LANES]);
        let base = Axes::of(robot.base());
        self.frames.resize(N + 1, base);
        self.frames[0] = base;
        for columns in [&mut self.spans, &mut self.turns, &mut self.beside] {
            columns.resize(N, zero);
        }
        self.around.resize(groups, [[zero; 3]; 2]);
        self.moves.resize(groups * N, zero);
        self.bends.resize(groups * N, zero);
        self.axes.resize(outline.capsules.len(), [[zero; 3]; 2]);
        self.is_placed.resize(groups, false);
        self.directions.clear();
        self.last = 0;
    }

    /// The place of a group, seen from a link, among `moves` and `bends`.
    pub(super) fn seen(&self, group: usize, from: usize) -> usize {
        group * self.spans.len() + from
    }

    /// Which of up to eight joint vectors touch themselves or come nearer to an obstacle than the
    /// margin [m], as bits, exact to rounding. Where joints turn, all that do not are certain not to
    /// (eq. 2).
    pub(super) fn touching<const N: usize>(
        &mut self,
        robot: &Robot<N>,
        outline: &Outline,
        cell: &Cell,
        q: &[[f64; N]],
        looked: Query<'_, N>,
    ) -> u64 {
        robot.frames(q, &mut self.frames[1..]);
        let mut has_lines = false;
        if let Query::Swept(ranges) | Query::Roughly(ranges) = looked {
            for (lane, range) in ranges.iter().enumerate() {
                let spans = robot.table_spans(range.spans());
                let turns = robot.table_turns(&range.turns);
                let beside = robot.table_spans(range.beside);
                for joint in 0..N {
                    self.spans[joint][lane] = spans[joint];
                    self.turns[joint][lane] = turns[joint];
                    self.beside[joint][lane] = beside[joint];
                    has_lines |= turns[joint] != 0.0;
                }
            }
        }
        let look = match looked {
            Query::All => QueryKind::All,
            Query::Any => QueryKind::Any,
            Query::Swept(_) => QueryKind::Swept,
            Query::Roughly(_) => QueryKind::Roughly,
        };
        self.touching_in_frames(outline, cell, q.len(), look, has_lines)
    }

    /// [`Self::touching`] where the frames are: without the number of joints, so that the kernel is
    /// compiled once.
    fn touching_in_frames(
        &mut self,
        outline: &Outline,
        cell: &Cell,
        count: usize,
        look: QueryKind,
        has_lines: bool,
    ) -> u64 {
        let all = ALL >> (LANES - count);
        let block = self;
        run_vectors(CollisionKernel { block, outline, cell, look, has_lines, all, asked: all })
    }

    pub(super) fn capsule(&self, outline: &Outline, index: usize, lane: usize) -> Capsule {
        let [middle, half] = self.axes[index].map(|point| point.map(|component| component[lane]));
        outline.capsules[index].at(middle.into(), half.into())
    }
}

/// Whether lanes touch something.
pub(super) struct CollisionKernel<'a> {
    pub(super) block: &'a mut Block,
    pub(super) outline: &'a Outline,
    pub(super) cell: &'a Cell,
    pub(super) look: QueryKind,
    /// Whether joints turn along lines.
    pub(super) has_lines: bool,
    /// The lanes, as bits.
    all: u64,
    /// The lanes in which nothing touches yet, as bits.
    pub(super) asked: u64,
}

impl VectorKernel for CollisionKernel<'_> {
    type Answer = u64;

    #[inline(always)]
    fn run<S: Simd>(mut self, simd: S) -> u64 {
        self.block.undecided.clear();
        for group in 0..self.outline.groups.len() {
            self.block.is_placed[group] = false;
            self.put_around(simd, group);
            if self.is_swept() {
                self.moves(simd, group);
            }
        }
        let (pairs, groups) = (self.outline.pairs.len(), self.outline.groups.len());
        // If one is enough, what touched last is looked at first; then links, then each group with
        // the parts near it. Hulls decide at the end, when capsules have found what they can.
        let is_last_first =
            self.is_enough() && self.block.last < pairs + groups * self.cell.part_count();
        let mut places = take(&mut self.block.places);
        for round in 0..groups + 2 {
            places.clear();
            match round {
                0 => places.extend(is_last_first.then_some(self.block.last)),
                1 => places.extend(0..pairs),
                _ => self.parts_near(simd, round - 2, &mut places),
            }
            for at in places.iter().copied() {
                match at.checked_sub(pairs) {
                    None => self.apart_of_links(simd, at),
                    Some(place) => self.apart_of_part(simd, place, at),
                }
                if self.is_done() {
                    self.block.last = at;
                    break;
                }
            }
            if self.is_done() {
                break;
            }
            if round == 0 || round == groups + 1 {
                self.decide(simd);
            }
        }
        self.block.places = places;
        self.all & !self.asked
    }
}

impl CollisionKernel<'_> {
    /// Whether the joints turn.
    pub(super) fn is_swept(&self) -> bool {
        matches!(self.look, QueryKind::Swept | QueryKind::Roughly)
    }

    /// Whether one lane that touches is enough.
    pub(super) fn is_enough(&self) -> bool {
        self.look == QueryKind::Any
    }

    pub(super) fn is_done(&self) -> bool {
        self.asked == 0 || self.is_enough() && self.asked != self.all
    }

    /// Add the places of a group with the parts of obstacles that are near it.
    #[inline(always)]
    fn parts_near<S: Simd>(&self, simd: S, group: usize, places: &mut Vec<usize>) {
        let Group { around: own, number, .. } = &self.outline.groups[group];
        // The arm stands on link 0.
        if *number == 0 {
            return;
        }
        let around = self.around(simd, group);
        let inverse = Vector::splat(simd, inverse_of(around.square));
        let limit = self.moved(simd, group, 0) + (self.cell.margin() + ROUNDING + own.radius);
        let axis = [around.middle, around.half];
        let (pairs, groups) = (self.outline.pairs.len(), self.outline.groups.len());
        let place = |part: usize| pairs + groups * part + group;
        places.extend(self.cell.endless().map(place));
        self.cell.tree().stops_near(
            #[inline(always)]
            |bounds| self.asked & !is_beyond_box(bounds, axis, inverse, limit) != 0,
            |parts| {
                places.extend(parts.iter().copied().map(place));
                false
            },
        );
    }

    /// A point of a link's frame.
    #[inline(always)]
    pub(super) fn placed<S: Simd>(&self, simd: S, link: usize, point: &Vector3<f64>) -> Point<S> {
        let turned = self.turned(simd, link, point);
        let origin = load(simd, &self.block.frames[link].origin);
        [origin[0] + turned[0], origin[1] + turned[1], origin[2] + turned[2]]
    }

    /// A direction of a link's frame.
    #[inline(always)]
    pub(super) fn turned<S: Simd>(&self, simd: S, link: usize, way: &Vector3<f64>) -> Point<S> {
        let frame = &self.block.frames[link];
        let (x, y, z) = (load(simd, &frame.x), load(simd, &frame.y), load(simd, &frame.z));
        [
            x[0].scaled_plus(way.x, y[0].scaled_plus(way.y, z[0] * way.z)),
            x[1].scaled_plus(way.x, y[1].scaled_plus(way.y, z[1] * way.z)),
            x[2].scaled_plus(way.x, y[2].scaled_plus(way.y, z[2] * way.z)),
        ]
    }

    #[inline(always)]
    fn put_around<S: Simd>(&mut self, simd: S, group: usize) {
        let Group { link, around, .. } = &self.outline.groups[group];
        let middle = self.placed(simd, *link, &around.center);
        let half = self.turned(simd, *link, &around.half);
        store(middle, &mut self.block.around[group][0]);
        store(half, &mut self.block.around[group][1]);
    }

    /// The axis of the capsule around a group.
    #[inline(always)]
    pub(super) fn around<S: Simd>(&self, simd: S, group: usize) -> Axis<S> {
        let [middle, half] = &self.block.around[group];
        Axis::new(load(simd, middle), load(simd, half), self.outline.groups[group].around.square)
    }

    /// How far the axes of a group move at most while its joints turn, seen from the links before
    /// it: the joints turn one after another, the last one first (eq. 1); and how far from where
    /// their velocities would lead (eq. 9).
    #[inline(always)]
    fn moves<S: Simd>(&mut self, simd: S, group: usize) {
        let Group { link, spread, .. } = &self.outline.groups[group];
        let center = load(simd, &self.block.around[group][0]);
        let (mut moved, mut bent) = (Vector::splat(simd, 0.0), Vector::splat(simd, 0.0));
        for joint in (0..*link).rev() {
            let frame = &self.block.frames[joint + 1];
            let arm = minus(center, load(simd, &frame.origin));
            let around = cross(load(simd, &frame.z), arm);
            let span = Vector::load_array_ref(simd, &self.block.spans[joint]);
            let beside = Vector::load_array_ref(simd, &self.block.beside[joint]);
            let radius = dot(around, around).root() + *spread + moved;
            let own = span * radius;
            bent = beside.times_plus(radius, span.times_plus(own.scaled_plus(0.5, moved), bent));
            moved += own;
            let seen = self.block.seen(group, joint);
            moved.store_array(&mut self.block.moves[seen]);
            bent.store_array(&mut self.block.bends[seen]);
        }
    }

    /// How a group moves along the line of its joint angles, seen from a link (eq. 9); not at all
    /// where there are no lines.
    #[inline(always)]
    pub(super) fn drift<S: Simd>(&self, simd: S, group: usize, from: usize) -> Drift<S> {
        let Group { link, .. } = &self.outline.groups[group];
        let center = load(simd, &self.block.around[group][0]);
        let mut drift = Drift::none(center);
        if !self.has_lines || *link <= from {
            return drift;
        }
        drift.bent = Vector::load_array_ref(simd, &self.block.bends[self.block.seen(group, from)]);
        for joint in from..*link {
            let frame = &self.block.frames[joint + 1];
            let turn = Vector::load_array_ref(simd, &self.block.turns[joint]);
            drift.turn(load(simd, &frame.z), load(simd, &frame.origin), turn);
        }
        drift
    }

    /// How far the axes of a group move, seen from a link; zero for joint vectors.
    #[inline(always)]
    pub(super) fn moved<S: Simd>(&self, simd: S, group: usize, from: usize) -> Vector<S> {
        if self.is_swept() {
            Vector::load_array_ref(simd, &self.block.moves[self.block.seen(group, from)])
        } else {
            Vector::splat(simd, 0.0)
        }
    }

    #[inline(always)]
    pub(super) fn place<S: Simd>(&mut self, simd: S, group: usize) {
        if self.block.is_placed[group] {
            return;
        }
        self.block.is_placed[group] = true;
        let Group { link, capsules, cores, .. } = &self.outline.groups[group];
        for index in capsules.start..cores.end {
            let own = &self.outline.capsules[index];
            let middle = self.placed(simd, *link, &own.center);
            let half = self.turned(simd, *link, &own.half);
            store(middle, &mut self.block.axes[index][0]);
            store(half, &mut self.block.axes[index][1]);
        }
    }

    #[inline(always)]
    pub(super) fn axis<S: Simd>(&self, simd: S, index: usize) -> Axis<S> {
        let [middle, half] = &self.block.axes[index];
        Axis::new(load(simd, middle), load(simd, half), self.outline.capsules[index].square)
    }
}

/// The numbers of the lanes in bits.
pub(super) fn bits(bits: u64) -> impl Iterator<Item = usize> {
    (0..LANES).filter(move |lane| bits >> lane & 1 == 1)
}

#[inline(always)]
fn store<S: Simd>(point: Point<S>, columns: &mut [Column; 3]) {
    for index in 0..3 {
        point[index].store_array(&mut columns[index]);
    }
}
