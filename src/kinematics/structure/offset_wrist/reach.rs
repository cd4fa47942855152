//! Whether a pose is out of reach, and how far.
//!
//! Docs: offset_wrist.md, eq. 135 and 135a.
#![expect(clippy::cast_precision_loss, reason = "a few angles")]

use core::f64::consts::PI;

use fearless_simd::prelude::*;
#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use super::geometry::Constants;
use super::hand::Hand;
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::thresholds::REACH_TOLERANCE;
use crate::lanes::{Column, LANES, Number, Vector, VectorKernel, run_vectors, sin_cos_of};
use crate::report::Reach;

/// The middles of eight parts of an interval, in halves of the interval [1].
const PARTS: Column = [-0.875, -0.625, -0.375, -0.125, 0.125, 0.375, 0.625, 0.875];

/// Intervals of joint 6, in whose parts the distance is taken first.
const INTERVALS: usize = 3;

/// How often the interval about a least distance is narrowed, to a quarter each time.
const NARROWINGS: usize = 12;

impl Constants {
    /// Whether the whole circle of the wrist point is certain to be out of reach, by bounds of its
    /// distances from axis 1 and along it (eq. 135a).
    #[inline(always)]
    pub(super) fn is_circle_beyond(&self, last: &Frame) -> bool {
        let lengths = &self.lengths;
        let hand = Hand::of(lengths, last);
        let [x, y, z] = hand.middle();
        let across = (x * x + y * y).sqrt();
        let [low, high] =
            [-lengths.circle, lengths.circle].map(|change| self.aside((across + change).max(0.0)));
        let up = [z - hand.half_height(), z + hand.half_height()];
        let [shortest, longest] = lengths.span();
        [[low, high], [-high, -low]].into_iter().all(|sides| {
            let [near, far] = distances(sides.map(|side| side - lengths.a1), up);
            near > longest + REACH_TOLERANCE || far < shortest - REACH_TOLERANCE
        })
    }

    /// How far the circle of the wrist point is from where upper arm and forearm bring it (eq.
    /// 135).
    #[cold]
    pub(super) fn missed(&self, last: &Frame) -> Reach {
        let hand = Hand::of(&self.lengths, last);
        let angle = run_vectors(Nearest { constants: self, hand: &hand });
        let [too_far, too_near] = self.excesses(&hand, angle.sin_cos().into());
        if too_far > too_near.max(0.0) {
            Reach::TooFar { shortfall: too_far }
        } else if too_near > 0.0 {
            Reach::TooNear { shortfall: too_near }
        } else {
            Reach::NoRoots
        }
    }

    /// How much too far and how much too near the wrist point is, for an angle of joint 6: on the
    /// side of the shoulder where that is less.
    #[inline(always)]
    pub(super) fn excesses<T: Number>(&self, hand: &Hand<T>, sin_cos_6: [T; 2]) -> [T; 2] {
        let lengths = &self.lengths;
        let ([x, y, h], _) = hand.at(sin_cos_6);
        let (zero, a1, b) = (h.like(0.0), h.like(lengths.a1), h.like(lengths.b.abs()));
        let across = x.times_plus(x, y * y).root();
        let sigma = ((across - b) * (across + b)).or_more(zero).root();
        let front = self.beyond([sigma - a1, h]);
        let behind = self.beyond([-sigma - a1, h]);
        let [of_front, of_behind] = [shortfall(front), shortfall(behind)];
        // Inside the cylinder of the lateral offset there is neither.
        let inside = b - across;
        let too_far = of_front.if_above(of_behind, behind[0], front[0]);
        let too_near = of_front.if_above(of_behind, behind[1], front[1]);
        [inside.if_above(zero, zero, too_far), inside.if_above(zero, inside, too_near)]
    }

    /// How far a point in the plane of the arm, from axis 2, is beyond what the links span, and how
    /// far inside.
    #[inline(always)]
    fn beyond<T: Number>(&self, [along, up]: [T; 2]) -> [T; 2] {
        let distance = along.times_plus(along, up * up).root();
        let [shortest, longest] = self.lengths.span().map(|length| up.like(length));
        [distance - longest, shortest - distance]
    }
}

#[inline(always)]
pub(super) fn shortfall<T: Number>([too_far, too_near]: [T; 2]) -> T {
    too_far.or_more(too_near).or_more(too_far.like(0.0))
}

/// The least and the greatest distance from the origin of points in a rectangle.
fn distances(x: [f64; 2], y: [f64; 2]) -> [f64; 2] {
    let nearest = |[low, high]: [f64; 2]| low.max(-high).max(0.0);
    let farthest = |[low, high]: [f64; 2]| high.max(-low);
    [nearest(x).hypot(nearest(y)), farthest(x).hypot(farthest(y))]
}

/// The angle of joint 6 at which the wrist point is nearest to where the links bring it.
struct Nearest<'a> {
    constants: &'a Constants,
    hand: &'a Hand,
}

impl VectorKernel for Nearest<'_> {
    type Answer = f64;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> f64 {
        let half = PI / INTERVALS as f64;
        let mut places = [[0.0; 2]; INTERVALS * LANES];
        for (interval, places) in places.as_chunks_mut::<LANES>().0.iter_mut().enumerate() {
            *places = self.places(simd, [half * (2 * interval) as f64, half]);
        }
        let mut nearest = places[0];
        for (number, place) in places.iter().enumerate() {
            let neighbors = [1, places.len() - 1].map(|on| places[(number + on) % places.len()][1]);
            if place[1] > neighbors[0] || place[1] > neighbors[1] {
                continue;
            }
            let (mut best, mut half) = (*place, half);
            for _ in 0..NARROWINGS {
                half *= 0.25;
                best = self.places(simd, [best[0], half]).into_iter().fold(best, nearer);
            }
            nearest = nearer(nearest, best);
        }
        nearest[0]
    }
}

impl Nearest<'_> {
    /// Eight angles of an interval with this middle and half, and the distance at each.
    #[inline(always)]
    fn places<S: Simd>(&self, simd: S, [middle, half]: [f64; 2]) -> [[f64; 2]; LANES] {
        let angles = Vector::load_array_ref(simd, &PARTS) * half + middle;
        let (sin, cos) = sin_cos_of(angles);
        let excesses = self.constants.excesses(&self.hand.in_lanes(angles), [sin, cos]);
        let (angles, distances) = (angles.to_array(), shortfall(excesses).to_array());
        core::array::from_fn(|lane| [angles[lane], distances[lane]])
    }
}

/// The one of two angles with the smaller distance, the first if they are equal.
fn nearer(one: [f64; 2], two: [f64; 2]) -> [f64; 2] {
    if two[1] < one[1] { two } else { one }
}
