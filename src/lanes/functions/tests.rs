//! Compares the functions with correctly rounded ones (crate `pxfm`), with fused multiplication and
//! addition and without. Functions of the C library are no reference: mingw-w64's are not
//! correctly rounded.
//!
//! `make evidence SUITE=ulp` uses ten million points and prints the worst; `make test` uses fewer.

use core::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};
use std::{println, vec::Vec};

use super::*;
use crate::lanes::{Column, Kernel, LANES, run};
use crate::rng::Rng;
use crate::sets::on_each_set;

/// Largest permitted distance from the correctly rounded value [ulp].
const BOUND: u64 = 2;

/// Quarter turns up to the largest angle.
const QUARTERS: u32 = 63_661;

fn points() -> u64 {
    std::env::var("IRBKIN_POINTS").map_or(300_000, |count| count.parse().unwrap())
}

/// Further random values of the tests: numbers of every size, directions, angles.
trait Draws {
    fn signed(&mut self, number: f64) -> f64;
    fn sized(&mut self, low: f64, high: f64) -> f64;
    fn direction(&mut self, a: f64, b: f64) -> (f64, f64);
    fn on_circle(&mut self, length: f64) -> (f64, f64);
    fn y_and_x(&mut self, kind: u64) -> (f64, f64);
    fn angle_of(&mut self, kind: u64) -> f64;
}

impl Draws for Rng {
    fn signed(&mut self, number: f64) -> f64 {
        if self.bits() & 1 == 0 { number } else { -number }
    }

    /// Any size from 2^low to 2^high.
    fn sized(&mut self, low: f64, high: f64) -> f64 {
        let exponent = self.between(low, high).floor();
        (1.0 + self.unit()) * exponent.exp2()
    }

    /// Two numbers of either sign, in random order.
    fn direction(&mut self, a: f64, b: f64) -> (f64, f64) {
        let (a, b) = (self.signed(a), self.signed(b));
        if self.bits() & 1 == 0 { (a, b) } else { (b, a) }
    }

    /// Sine and cosine of an angle, times a length.
    fn on_circle(&mut self, length: f64) -> (f64, f64) {
        let (sin, cos) = self.between(-PI, PI).sin_cos();
        (sin * length, cos * length)
    }

    /// y and x, from a different distribution for each `kind`.
    fn y_and_x(&mut self, kind: u64) -> (f64, f64) {
        let (wide, near_one, middling) =
            (self.sized(-1000.0, 1000.0), self.sized(-20.0, 20.0), self.sized(-3.0, 3.0));
        let (tiny, other_tiny) = (self.sized(-1074.0, -1000.0), self.sized(-1074.0, -1000.0));
        match kind % 8 {
            0 => self.on_circle(1.0),
            1 => self.on_circle(wide.min(1e300)),
            2 => {
                let (a, b) = (self.sized(-1074.0, 1024.0), self.sized(-1074.0, 1024.0));
                self.direction(a, b)
            }
            // Near a diagonal, and near an axis.
            3 => {
                let off = self.sized(-53.0, -20.0);
                self.direction(wide, wide * (1.0 + off))
            }
            4 => {
                let off = self.sized(-1074.0, 0.0);
                self.direction(near_one, near_one * off)
            }
            5 => self.direction(tiny, other_tiny),
            6 => {
                let part = self.unit();
                self.direction(near_one, near_one * part)
            }
            // Where the rounding of the quotient has the largest effect.
            _ => {
                let part = self.between(0.5, 0.6);
                self.direction(middling, middling * part)
            }
        }
    }

    /// An angle, from a different distribution for each `kind`.
    fn angle_of(&mut self, kind: u64) -> f64 {
        let quarters = self.between(0.0, f64::from(QUARTERS)).floor();
        let size = match kind % 6 {
            0 => self.between(0.0, MOST_SIN_COS),
            1 => self.sized(-1074.0, 16.6),
            2 => self.between(0.0, TAU),
            3 => self.between(0.0, FRAC_PI_4),
            // Near a quarter turn, and near where the quadrants change.
            4 => quarters * FRAC_PI_2 + self.sized(-50.0, -1.0),
            _ => (quarters + 0.5) * FRAC_PI_2 + self.between(-0.1, 0.1),
        };
        self.signed(size.min(MOST_SIN_COS))
    }
}

/// The number of doubles between two values; two NaN are equal, zeros of different sign are not.
fn ulps(a: f64, b: f64) -> u64 {
    // The bits of doubles, minus zero's, count them on each side of zero.
    let place = |number: f64| {
        let size = (number.to_bits() & !SIGN).cast_signed();
        if number.is_sign_negative() { -1 - size } else { size }
    };
    match (a.is_nan(), b.is_nan()) {
        (true, true) => 0,
        (false, false) => place(a).abs_diff(place(b)),
        _ => u64::MAX,
    }
}

fn stepped(number: f64, steps: i64) -> f64 {
    f64::from_bits(number.to_bits().wrapping_add_signed(steps))
}

/// pxfm 0.1.30 gives +0 for an arc tangent that underflows below zero.
fn exact_atan2(y: f64, x: f64) -> f64 {
    let angle = pxfm::f_atan2(y, x);
    if angle == 0.0 { angle.copysign(y) } else { angle }
}

/// The worst of many points, and how many are off by 0, 1, 2 and more.
struct Worst {
    name: &'static str,
    ulps: u64,
    at: (f64, f64),
    counts: [u64; 4],
}

impl Worst {
    fn of(name: &'static str) -> Self {
        Self { name, ulps: 0, at: (0.0, 0.0), counts: [0; 4] }
    }

    fn take(&mut self, found: f64, exact: f64, at: (f64, f64)) {
        let off = ulps(found, exact);
        self.counts[usize::try_from(off.min(3)).unwrap()] += 1;
        if off > self.ulps {
            (self.ulps, self.at) = (off, at);
        }
    }

    fn check(&self) {
        let Self { name, ulps, at, counts } = self;
        println!(
            "{name:16} worst {ulps} ulp at {at:?}  points off by 0, 1, 2 and more ulp: {counts:?}"
        );
        assert!(*ulps <= BOUND, "{name}: {ulps} ulp at {at:?}");
    }
}

#[test]
fn the_arc_tangent_is_within_two_ulp() {
    let mut random = Rng::new(42);
    let (mut fused, mut unfused) = (Worst::of("atan2, fused"), Worst::of("atan2, unfused"));
    for kind in 0..points() / 2 {
        let (y, x) = random.y_and_x(kind);
        let exact = exact_atan2(y, x);
        fused.take(atan2::<true>(y, x), exact, (y, x));
        unfused.take(atan2::<false>(y, x), exact, (y, x));
    }
    [fused, unfused].iter().for_each(Worst::check);
}

#[test]
fn sine_and_cosine_are_within_two_ulp() {
    let mut random = Rng::new(43);
    let mut worst = ["sin, fused", "cos, fused", "sin, unfused", "cos, unfused"].map(Worst::of);
    let mut take = |angle: f64| {
        let (sin, cos) = (pxfm::f_sin(angle), pxfm::f_cos(angle));
        let (fused, unfused) = (sin_cos::<true>(angle), sin_cos::<false>(angle));
        for (worst, (found, exact)) in worst.iter_mut().zip([
            (fused.0, sin),
            (fused.1, cos),
            (unfused.0, sin),
            (unfused.1, cos),
        ]) {
            worst.take(found, exact, (angle, 0.0));
        }
    };
    for kind in 0..points() / 2 {
        take(random.angle_of(kind));
    }
    // A double times a whole number below 2^16 is at most one double from the one nearest to the
    // true multiple.
    for quarter in 1..=QUARTERS {
        for steps in -4..=4 {
            let angle = stepped(f64::from(quarter) * FRAC_PI_2, steps).min(MOST_SIN_COS);
            take(angle);
            take(-angle);
        }
    }
    worst.iter().for_each(Worst::check);
}

/// Sizes of every kind: zero, the least, those that round off, ordinary ones, the greatest,
/// infinite, NaN.
const SIZES: [f64; 19] = [
    0.0,
    5e-324,
    1e-320,
    f64::MIN_POSITIVE,
    1e-300,
    1e-17,
    0.5,
    1.0 - f64::EPSILON / 2.0,
    1.0,
    1.0 + f64::EPSILON,
    2.0,
    3.7,
    1e5,
    1e17,
    1e300,
    f64::MAX / 2.0,
    f64::MAX,
    f64::INFINITY,
    f64::NAN,
];

#[test]
fn special_values_of_the_arc_tangent_are_correctly_rounded() {
    for (a, b) in SIZES.iter().flat_map(|a| SIZES.map(|b| (*a, b))) {
        // Directions along an axis or a diagonal have the correctly rounded angle, with its sign;
        // for the others the sign is correct.
        let special = a == b || [a, b].iter().any(|size| *size == 0.0 || !size.is_finite());
        let bound = if special { 0 } else { BOUND };
        for (y, x) in [(a, b), (-a, b), (a, -b), (-a, -b)] {
            for found in [atan2::<true>(y, x), atan2::<false>(y, x)] {
                assert!(
                    ulps(found, exact_atan2(y, x)) <= bound,
                    "atan2({y:e}, {x:e}) is {found:e}"
                );
                assert!(
                    found.is_nan() || found.is_sign_negative() == y.is_sign_negative(),
                    "atan2({y:e}, {x:e}) is {found:e}"
                );
            }
        }
    }
}

#[test]
fn special_values_of_sine_and_cosine_are_correctly_rounded() {
    for size in SIZES.into_iter().filter(|size| *size <= MOST_SIN_COS || !size.is_finite()) {
        for angle in [size, -size] {
            let exact = (pxfm::f_sin(angle), pxfm::f_cos(angle));
            for (sin, cos) in [sin_cos::<true>(angle), sin_cos::<false>(angle)] {
                // An angle this small is its own sine.
                let bound = if size <= 1e-17 || !size.is_finite() { 0 } else { BOUND };
                assert!(ulps(sin, exact.0) <= bound, "sin({angle:e}) is {sin:e}");
                assert!(ulps(cos, exact.1) <= bound, "cos({angle:e}) is {cos:e}");
            }
        }
    }
}

/// The functions of one number, with the scalar instructions of a set.
pub(super) struct One {
    pub(super) y: f64,
    pub(super) x: f64,
    pub(super) angle: f64,
}

impl Kernel for One {
    /// Arc tangent of y and x; sine and cosine of the angle.
    type Answer = [f64; 3];
    const WIDE: bool = true;

    #[inline(always)]
    fn run<const FUSED: bool>(self) -> [f64; 3] {
        let (sin, cos) = sin_cos::<FUSED>(self.angle);
        [atan2::<FUSED>(self.y, self.x), sin, cos]
    }
}

/// Arc tangents and sines of columns, as kernels take them.
struct InLanes<'a> {
    y: &'a [Column],
    x: &'a [Column],
    out: &'a mut [[Column; 3]],
}

impl Kernel for InLanes<'_> {
    type Answer = ();
    const WIDE: bool = true;

    #[inline(always)]
    fn run<const FUSED: bool>(self) {
        for ((y, x), [angle, sin, cos]) in self.y.iter().zip(self.x).zip(self.out) {
            for lane in 0..LANES {
                angle[lane] = atan2::<FUSED>(y[lane], x[lane]);
                (sin[lane], cos[lane]) = sin_cos::<FUSED>(x[lane]);
            }
        }
    }
}

#[test]
fn vector_and_scalar_instructions_give_the_same_bits() {
    const COLUMNS: usize = 2000;
    let mut random = Rng::new(44);
    let (mut y, mut x) = (Vec::new(), Vec::new());
    for kind in 0..COLUMNS as u64 {
        let directions: [(f64, f64); LANES] =
            core::array::from_fn(|lane| random.y_and_x(kind + lane as u64));
        y.push(directions.map(|direction| direction.0));
        // Half of the columns for sines, some of which are near quarter turns.
        x.push(if kind % 2 == 0 {
            directions.map(|direction| direction.1)
        } else {
            core::array::from_fn(|_| random.angle_of(kind / 2))
        });
    }
    y.push(SIZES[..LANES].try_into().unwrap());
    x.push(SIZES[SIZES.len() - LANES..].try_into().unwrap());
    on_each_set(|set| {
        let mut out = std::vec![[[0.0; LANES]; 3]; y.len()];
        run(InLanes { y: &y, x: &x, out: &mut out });
        for ((y, x), found) in y.iter().zip(&x).zip(&out) {
            for lane in 0..LANES {
                let (y, x) = (y[lane], x[lane]);
                let numbers = run(One { y, x, angle: x });
                for (column, number) in found.iter().zip(numbers) {
                    assert_eq!(ulps(column[lane], number), 0, "{y:e} {x:e}, {}", set.name());
                }
            }
        }
    });
}

#[test]
fn rounding_to_whole_numbers_matches_the_standard_library() {
    for number in [
        0.0,
        -0.0,
        0.25,
        0.75,
        -0.25,
        -0.75,
        1.0,
        -1.0,
        7.5,
        -7.5,
        1e6 + 0.1,
        -1e6 - 0.1,
        f64::INFINITY,
        f64::NEG_INFINITY,
    ] {
        assert_eq!(nearest_whole(number), number.round_ties_even(), "{number}");
        assert_eq!(whole_below(number), number.floor(), "{number}");
        assert_eq!(whole_above(number), number.ceil(), "{number}");
    }
}
