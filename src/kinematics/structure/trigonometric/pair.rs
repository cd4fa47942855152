//! Parts of arcs on which the polynomial bends one way: none, two or a double root (eq. 95a).
//!
//! Where the second differences of the Bernstein coefficients have one sign, the polynomial is
//! convex, or concave, and has one extreme value, which decides. Dividing a part with a double root
//! would take twenty steps.

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use super::brackets::Brackets;
use super::clusters::Clusters;
use super::part::{Coefficients, Part};
use super::tables::{POWERS, binomial};

/// Steps towards the extreme value, at most: Newton's method on the derivative, bracketed.
const MOST_STEPS: usize = 12;

/// How much of the noise the extreme value may be off [1].
const OFF: f64 = 0.1;

#[expect(clippy::cast_precision_loss, reason = "12")]
const N: f64 = POWERS as f64;

impl Part {
    /// Take the roots of a part whose ends are on the same certain side of zero, if it bends one
    /// way, by its Bernstein coefficients; returns whether it was decided.
    pub(super) fn take_pair(
        &self,
        b: &Coefficients<f64>,
        brackets: &mut Brackets,
        clusters: &mut Clusters<'_>,
    ) -> bool {
        let noise = self.noise;
        // Bent upward, with ends above zero.
        let sign = 1.0_f64.copysign(b[0]);
        let bend = |j: usize| sign * ((b[j + 2] - b[j + 1]) - (b[j + 1] - b[j]));
        let least = (0..POWERS - 1).map(bend).fold(f64::INFINITY, f64::min) - 4.0 * noise;
        let are_above = sign * b[0] > noise && sign * b[POWERS] > noise;
        if !(are_above && least > 0.0) {
            return false;
        }
        // A lower bound of the second derivative.
        let curvature = N * (N - 1.0) * least;
        let weighted = Weighted::of(b);
        let (mut low, mut high) = (0.0, 1.0);
        let mut place = 0.5;
        for _ in 0..MOST_STEPS {
            let [value, slope, second] = weighted.at(place).map(|part| sign * part);
            let below = slope * slope / (2.0 * curvature);
            if value - below > noise {
                return true;
            }
            // How far from here the polynomial may be below a value.
            let within = |most: f64| {
                let room = 2.0 * curvature * (most - value).max(0.0);
                (slope.abs() + (slope * slope + room).sqrt()) / curvature
            };
            let around = |radius: f64| [(place - radius).max(0.0), (place + radius).min(1.0)];
            if value < -noise {
                let [first, last] = around(within(2.0 * noise));
                // Where the parabola with this value, slope and bend has its zeros.
                let vertex = place - slope / second;
                let away = (slope * slope / second - 2.0 * value) / second;
                let [left, right] = [-1.0, 1.0].map(|side| vertex + side * away.sqrt());
                let part = |at: f64, low: f64, high: f64| {
                    let part = (at - low) / (high - low);
                    if (0.0..=1.0).contains(&part) { part } else { 0.5 }
                };
                let [low, middle, high] = [first, place, last].map(|place| self.place(place));
                brackets.push(&self.within(low, middle), part(left, first, place), sign);
                brackets.push(&self.within(middle, high), part(right, place, last), -sign);
                return true;
            }
            if below <= OFF * noise {
                let [first, last] = around(within(noise));
                let [first, last] = [first, last].map(|place| self.place(place));
                clusters.take(&self.within(first, last));
                return true;
            }
            (low, high) = if slope < 0.0 { (place, high) } else { (low, place) };
            let next = place - slope / second;
            place = if next > low && next < high { next } else { 0.5 * (low + high) };
        }
        false
    }

    /// The place of its arc at a place of this part.
    fn place(&self, place: f64) -> f64 {
        self.low + place * (self.high - self.low)
    }
}

/// The Bernstein coefficients of a polynomial and of its first two derivatives, each times its
/// binomial coefficient.
struct Weighted {
    value: [f64; POWERS + 1],
    slope: [f64; POWERS],
    second: [f64; POWERS - 1],
}

impl Weighted {
    fn of(b: &Coefficients<f64>) -> Self {
        let change = |j: usize| b[j + 1] - b[j];
        Self {
            value: core::array::from_fn(|j| BINOMIALS[0][j] * b[j]),
            slope: core::array::from_fn(|j| BINOMIALS[1][j] * N * change(j)),
            second: core::array::from_fn(|j| {
                BINOMIALS[2][j] * N * (N - 1.0) * (change(j + 1) - change(j))
            }),
        }
    }

    /// The value at a place in 0 ..= 1 and its first two derivatives, by Horner's rule from the
    /// farther end.
    fn at(&self, place: f64) -> [f64; 3] {
        let (rest, is_first) = (1.0 - place, place <= 0.5);
        let (near, ratio) = if is_first { (rest, place / rest) } else { (place, rest / place) };
        let mut powers = [1.0; POWERS + 1];
        for order in 1..=POWERS {
            powers[order] = powers[order - 1] * near;
        }
        [
            powers[POWERS] * sum(&self.value, ratio, is_first),
            powers[POWERS - 1] * sum(&self.slope, ratio, is_first),
            powers[POWERS - 2] * sum(&self.second, ratio, is_first),
        ]
    }
}

/// The sum of numbers times powers of a ratio, from the first number on or from the last.
fn sum(numbers: &[f64], ratio: f64, is_first: bool) -> f64 {
    let add = |sum: f64, number: &f64| sum * ratio + number;
    if is_first { numbers.iter().rev().fold(0.0, add) } else { numbers.iter().fold(0.0, add) }
}

/// Binomial coefficients of degree 12, 11 and 10.
const BINOMIALS: [[f64; POWERS + 1]; 3] = {
    let mut rows = [[0.0; POWERS + 1]; 3];
    let mut less = 0;
    while less < 3 {
        let mut j = 0;
        while j <= POWERS - less {
            rows[less][j] = binomial(POWERS - less, j);
            j += 1;
        }
        less += 1;
    }
    rows
};
