//! The curve through a configuration along which the closure hardly changes, eight at once.
//!
//! With the least singular vectors u, v of the derivatives J, the configurations `q(s)` that close
//! up to a part `g(s) u`, and are s ahead along v, are a curve (eq. 99). It is regular where J has
//! rank 5.
//!
//! Docs: general.md, section 6.

use fearless_simd::prelude::*;

use super::chain::{Closure, Conditions, Target, largest, sines};
use super::newton::Six;
use super::reflections::Triangle;
use crate::lanes::{Column, LANES, Number as _, Vector, VectorKernel, run_vectors, sin_cos_of};

/// Steps of Newton's method to a point, at most.
const MOST_STEPS: usize = 8;

/// Largest step [rad]: a point is near where it is looked for.
const MOST_STEP: f64 = 1.0;

/// Second singular value below which two directions are free, which is not analyzed [1].
pub(super) const SECOND: f64 = 1e-6;

/// Steps that are the last [rad]: of rounding's size, or near it and no longer much smaller than
/// the one before.
const OF_ROUNDING: f64 = 1e-15;
const NEAR_ROUNDING: f64 = 1e-8;
const SMALLER: f64 = 0.01;

/// A curve.
#[derive(Clone, Copy)]
pub(super) struct Curve {
    pub(super) start: [f64; 6],
    u: [f64; 6],
    v: [f64; 6],
    /// The least singular value at the start, and the next [1].
    pub(super) least: f64,
    pub(super) second: f64,
}

/// A point of a curve.
#[derive(Clone, Copy)]
pub(super) struct Point {
    pub(super) s: f64,
    pub(super) theta: [f64; 6],
    /// The closure that is left along u, and its derivative by s.
    pub(super) left: f64,
    pub(super) slope: f64,
}

/// A point that is wanted: s ahead on a curve, near a guess.
#[derive(Clone, Copy)]
pub(super) struct Wanted<'a> {
    curve: &'a Curve,
    s: f64,
    guess: [f64; 6],
}

impl Curve {
    /// The direction in which the closure hardly changes.
    pub(super) fn direction(&self) -> &[f64; 6] {
        &self.v
    }

    pub(super) fn at(&self, s: f64, guess: [f64; 6]) -> Wanted<'_> {
        Wanted { curve: self, s, guess }
    }

    /// The point `s` ahead, looked for where the curve would be if it were straight.
    pub(super) fn straight_ahead(&self, s: f64) -> Wanted<'_> {
        self.at(s, core::array::from_fn(|joint| self.start[joint] + s * self.v[joint]))
    }

    /// The start itself, brought to the curve.
    pub(super) fn at_start(&self) -> Wanted<'_> {
        self.at(0.0, self.start)
    }
}

impl Closure {
    /// The curve through a configuration; none where two directions are free.
    pub(super) fn curve(&self, target: &Target, theta: &[f64; 6]) -> Option<Curve> {
        let (sin, cos) = sines(theta);
        let Conditions { mut columns, .. } = self.conditions(target, &sin, &cos);
        let (least, u, v) = triangle(&columns).least_vectors();
        border(&mut columns, &u, &v);
        let second = triangle(&columns).least();
        (second > SECOND).then_some(Curve { start: *theta, u, v, least, second })
    }

    /// Points on curves, by Newton's method.
    #[inline(never)]
    pub(super) fn points<const N: usize>(
        &self,
        target: &Target,
        wanted: &[Option<Wanted<'_>>; N],
    ) -> [Option<Point>; N] {
        let mut points = [None; N];
        let mut waiting = wanted.iter().zip(&mut points).filter_map(|(one, place)| {
            let one = one.as_ref()?;
            Some((one, place))
        });
        while let Some(first) = waiting.next() {
            let mut lanes = Lanes::filled(first.0);
            let mut places = [const { None }; LANES];
            places[0] = Some(first.1);
            for (lane, (one, place)) in (1..LANES).zip(&mut waiting) {
                lanes.put(lane, one);
                places[lane] = Some(place);
            }
            let found = run_vectors(Along { closure: self, target, lanes: &lanes });
            for (lane, place) in places.into_iter().enumerate() {
                if let Some(place) = place {
                    *place = found.point(lane, lanes.s[lane]);
                }
            }
        }
        points
    }
}

/// Points that are wanted, lane beside lane.
struct Lanes {
    start: [Column; 6],
    u: [Column; 6],
    v: [Column; 6],
    guess: [Column; 6],
    s: Column,
}

impl Lanes {
    /// With one in all lanes.
    fn filled(wanted: &Wanted<'_>) -> Self {
        let Wanted { curve: Curve { start, u, v, .. }, s, guess } = *wanted;
        let of = |six: [f64; 6]| six.map(|one| [one; LANES]);
        Self { start: of(*start), u: of(*u), v: of(*v), guess: of(guess), s: [s; LANES] }
    }

    fn put(&mut self, lane: usize, wanted: &Wanted<'_>) {
        let Wanted { curve, s, guess } = wanted;
        for joint in 0..6 {
            self.start[joint][lane] = curve.start[joint];
            self.u[joint][lane] = curve.u[joint];
            self.v[joint][lane] = curve.v[joint];
            self.guess[joint][lane] = guess[joint];
        }
        self.s[lane] = *s;
    }
}

/// Newton's method to eight points.
struct Along<'a> {
    closure: &'a Closure,
    target: &'a Target,
    lanes: &'a Lanes,
}

/// Where it has led.
struct Found {
    theta: [Column; 6],
    left: Column,
    slope: Column,
    /// One where it has converged, else zero.
    converged: Column,
}

impl Found {
    fn point(&self, lane: usize, s: f64) -> Option<Point> {
        let theta = core::array::from_fn(|joint| self.theta[joint][lane]);
        let (left, slope) = (self.left[lane], self.slope[lane]);
        (self.converged[lane] > 0.0).then_some(Point { s, theta, left, slope })
    }
}

impl VectorKernel for Along<'_> {
    type Answer = Found;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Found {
        let Lanes { start, u, v, guess, s } = self.lanes;
        let (start, u, v) = (loaded(simd, start), loaded(simd, u), loaded(simd, v));
        let (mut theta, s) = (loaded(simd, guess), Vector::load_array_ref(simd, s));
        let (zero, one) = (s.like(0.0), s.like(1.0));
        let target = self.target.in_lanes(zero);
        let (mut left, mut slope, mut is_found) = (zero, zero, zero);
        let mut before = zero.like(f64::INFINITY);
        let mut is_moving = zero.simd_eq(zero);
        for _ in 0..MOST_STEPS {
            let (mut sin, mut cos) = (theta, theta);
            for joint in 0..6 {
                (sin[joint], cos[joint]) = sin_cos_of(theta[joint]);
            }
            let Conditions { missing, mut columns } = self.closure.conditions(&target, &sin, &cos);
            border(&mut columns, &u, &v);
            let triangle = Triangle::of(columns, [missing, u]);
            // Equation 99a.
            let [a, b] = [triangle.back(triangle.right[0]), triangle.back(triangle.right[1])];
            let (mut rest, mut v_a, mut v_b) = (s, zero, zero);
            for joint in 0..6 {
                rest = v[joint].mul_add(start[joint] - theta[joint], rest);
                v_a = v[joint].mul_add(a[joint], v_a);
                v_b = v[joint].mul_add(b[joint], v_b);
            }
            let part = (rest - v_a) / v_b;
            let mut step = a;
            for joint in 0..6 {
                step[joint] = b[joint].mul_add(part, a[joint]);
            }
            let size = largest(&step);
            is_moving &= size.simd_le(MOST_STEP);
            for joint in 0..6 {
                theta[joint] += is_moving.select(step[joint], zero);
            }
            left = is_moving.select(rest - part, left);
            slope = is_moving.select(one - v_b.inverse(), slope);
            // From here on rounding no longer shrinks it.
            let shrinks = size.simd_ge(NEAR_ROUNDING) | size.simd_le(before * SMALLER);
            let is_left = size.simd_ge(OF_ROUNDING) & shrinks;
            is_found = is_moving.select(is_left.select(zero, one), is_found);
            is_moving &= is_left;
            if !is_moving.any_true() {
                break;
            }
            before = size;
        }
        let mut found = Found {
            theta: [[0.0; LANES]; 6],
            left: left.to_array(),
            slope: slope.to_array(),
            converged: is_found.to_array(),
        };
        for joint in 0..6 {
            found.theta[joint] = theta[joint].to_array();
        }
        found
    }
}

/// The triangle of one configuration.
#[inline(never)]
fn triangle(columns: &[[f64; 6]; 6]) -> Triangle<f64, 0> {
    Triangle::of(*columns, [])
}

/// `J + u v^T`.
#[inline(always)]
fn border<T: crate::lanes::Number>(columns: &mut [[T; 6]; 6], u: &[T; 6], v: &[T; 6]) {
    for (column, v) in columns.iter_mut().zip(v) {
        for (element, u) in column.iter_mut().zip(u) {
            *element = u.times_plus(*v, *element);
        }
    }
}

#[inline(always)]
fn loaded<S: Simd>(simd: S, columns: &[Column; 6]) -> Six<S> {
    let mut six = [Vector::splat(simd, 0.0); 6];
    for joint in 0..6 {
        six[joint] = Vector::load_array_ref(simd, &columns[joint]);
    }
    six
}
