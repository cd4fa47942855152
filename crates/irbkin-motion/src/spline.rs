//! Splines through rows of numbers, cubic and quintic: their pieces by coefficients from the
//! constant upwards (docs/theory/motion.md, eq. 1 to 3, 9 to 12).

use crate::prelude::*;
use nalgebra::{Matrix2, Vector2};

#[derive(Clone, Copy)]
pub(crate) enum Ends<'a> {
    /// With given derivatives, a row each.
    Clamped([&'a [f64]; 2]),
    /// The first two pieces are one cubic, and so are the last two: nothing is assumed of the ends.
    /// Of three knots the curve is a parabola, of two a line.
    NotAKnot,
}

/// The pieces of a cubic spline with continuous second derivative, by piece and column.
///
/// `points` has a row of `columns` numbers for each of `knots`, of which there are at least two.
pub(crate) fn cubic<const TERMS: usize>(
    knots: &[f64],
    points: &[f64],
    columns: usize,
    ends: Ends<'_>,
) -> Vec<[f64; TERMS]> {
    let slopes = cubic_slopes(knots, points, columns, ends);
    pieces(knots, columns, |[start, end], length| {
        let [positions, slopes] = [points, &slopes].map(|rows| [rows[start], rows[end]]);
        hermite(positions, slopes, length)
    })
}

/// The derivatives of a cubic spline at its knots, by knot and column.
///
/// They solve a tridiagonal system, one for all columns (eq. 9, 10).
fn cubic_slopes(knots: &[f64], points: &[f64], columns: usize, ends: Ends<'_>) -> Vec<f64> {
    let system = System { knots, points, columns, ends };
    let last = knots.len() - 1;
    // Thomas' elimination: what is left of a row is x = side - factor * x of the next one.
    let mut factors = vec![0.0; knots.len()];
    let mut sides = vec![0.0; knots.len() * columns];
    for knot in 0..=last {
        let [left, middle, right] = system.row(knot);
        let before = if knot == 0 { 0.0 } else { factors[knot - 1] };
        let pivot = middle - left * before;
        factors[knot] = right / pivot;
        for column in 0..columns {
            let index = knot * columns + column;
            let known = if knot == 0 { 0.0 } else { left * sides[index - columns] };
            sides[index] = (system.side(knot, column) - known) / pivot;
        }
    }
    for index in (0..last * columns).rev() {
        sides[index] -= factors[index / columns] * sides[index + columns];
    }
    sides
}

/// The cubic over a length between two positions with slopes: its coefficients (eq. 3).
#[inline]
pub(crate) fn hermite(positions: [f64; 2], slopes: [f64; 2], length: f64) -> [f64; 4] {
    let ([start, end], [first, last]) = (positions, slopes);
    let way = end - start;
    let c2 = (3.0 * way - length * (2.0 * first + last)) / (length * length);
    let c3 = (-2.0 * way + length * (first + last)) / (length * length * length);
    [start, first, c2, c3]
}

/// The equations of the slopes.
struct System<'a> {
    knots: &'a [f64],
    points: &'a [f64],
    columns: usize,
    ends: Ends<'a>,
}

impl System<'_> {
    fn length(&self, piece: usize) -> f64 {
        self.knots[piece + 1] - self.knots[piece]
    }

    fn slope(&self, piece: usize, column: usize) -> f64 {
        let index = piece * self.columns + column;
        (self.points[index + self.columns] - self.points[index]) / self.length(piece)
    }

    /// The coefficients of the slopes before, at and after a knot.
    fn row(&self, knot: usize) -> [f64; 3] {
        let last = self.knots.len() - 1;
        if knot == 0 || knot == last {
            // Of three knots, both ends would say the same of a parabola: one slope is given.
            let is_given = last == 1 || (last == 2 && knot == last);
            return match self.ends {
                Ends::NotAKnot if is_given => [0.0, 1.0, 0.0],
                Ends::NotAKnot if knot == 0 => {
                    [0.0, self.length(1), self.length(0) + self.length(1)]
                }
                Ends::NotAKnot => {
                    let (before, near) = (self.length(last - 2), self.length(last - 1));
                    [before + near, before, 0.0]
                }
                Ends::Clamped(_) => [0.0, 1.0, 0.0],
            };
        }
        let (before, after) = (1.0 / self.length(knot - 1), 1.0 / self.length(knot));
        [before, 2.0 * (before + after), after]
    }

    /// The right side of a column.
    fn side(&self, knot: usize, column: usize) -> f64 {
        let last = self.knots.len() - 1;
        if 0 < knot && knot < last {
            let before = self.slope(knot - 1, column) / self.length(knot - 1);
            return 3.0 * (before + self.slope(knot, column) / self.length(knot));
        }
        match self.ends {
            Ends::Clamped([start, _]) if knot == 0 => start[column],
            Ends::Clamped([_, end]) => end[column],
            Ends::NotAKnot if last == 1 => self.slope(0, column),
            Ends::NotAKnot if last == 2 && knot == last => {
                let (before, after) = (self.slope(0, column), self.slope(1, column));
                let (h, next) = (self.length(0), self.length(1));
                after + (after - before) / (h + next) * next
            }
            Ends::NotAKnot => {
                let (near, far) = if knot == 0 { (0, 1) } else { (last - 1, last - 2) };
                let (h, next) = (self.length(near), self.length(far));
                let both = h + next;
                let sum = (h + 2.0 * both) * next * self.slope(near, column);
                (sum + h * h * self.slope(far, column)) / both
            }
        }
    }
}

/// The pieces of a quintic spline, at rest at both ends, whose first four derivatives are
/// continuous.
///
/// Velocity and acceleration at the inner knots solve a block tridiagonal system (eq. 11, 12).
pub(crate) fn quintic<const TERMS: usize>(
    knots: &[f64],
    points: &[f64],
    columns: usize,
) -> Vec<[f64; TERMS]> {
    let count = knots.len();
    let way = |piece: usize, column: usize| {
        points[(piece + 1) * columns + column] - points[piece * columns + column]
    };
    // The elimination of what is left of each inner knot: x = side - factor * x of the next one.
    let mut factors = vec![Matrix2::zeros(); count];
    let mut states = vec![Vector2::zeros(); count * columns];
    for knot in 1..count - 1 {
        let (l, r) = (knots[knot] - knots[knot - 1], knots[knot + 1] - knots[knot]);
        let (l2, r2) = (l * l, r * r);
        let (l3, r3) = (l2 * l, r2 * r);
        let left = Matrix2::new(-24.0 / l2, -3.0 / l, -168.0 / l3, -24.0 / l2);
        let middle = Matrix2::new(
            -36.0 / l2 + 36.0 / r2,
            9.0 / l + 9.0 / r,
            -192.0 / l3 - 192.0 / r3,
            36.0 / l2 - 36.0 / r2,
        );
        let right = Matrix2::new(24.0 / r2, -3.0 / r, -168.0 / r3, 24.0 / r2);
        let inverse = (middle - left * factors[knot - 1]).try_inverse();
        let pivot = inverse.unwrap_or(Matrix2::repeat(f64::NAN));
        factors[knot] = pivot * right;
        for column in 0..columns {
            let (before, after) = (way(knot - 1, column), way(knot, column));
            let side = Vector2::new(
                60.0 * (after / r3 - before / l3),
                -360.0 * (after / (r3 * r) + before / (l3 * l)),
            );
            let known = left * states[(knot - 1) * columns + column];
            states[knot * columns + column] = pivot * (side - known);
        }
    }
    for knot in (1..count - 1).rev() {
        for column in 0..columns {
            let next = factors[knot] * states[(knot + 1) * columns + column];
            states[knot * columns + column] -= next;
        }
    }
    pieces(knots, columns, |ends, length| {
        let [start, end] = ends.map(|index| [points[index], states[index][0], states[index][1]]);
        quintic_between(start, end, length)
    })
}

/// The quintic over a length between two positions with velocities and accelerations: its
/// coefficients (eq. 1, 2).
#[inline]
pub(crate) fn quintic_between(start: [f64; 3], end: [f64; 3], length: f64) -> [f64; 6] {
    let ([p, v, a], t) = (start, length);
    // The remainder for the three free terms after the terms that the start fixes.
    let position = end[0] - p - t * (v + 0.5 * t * a);
    let velocity = t * (end[1] - v - t * a);
    let acceleration = 0.5 * t * t * (end[2] - a);
    let c3 = (10.0 * position - 4.0 * velocity + acceleration) / (t * t * t);
    let c4 = (-15.0 * position + 7.0 * velocity - 2.0 * acceleration) / (t * t * t * t);
    let c5 = (6.0 * position - 3.0 * velocity + acceleration) / (t * t * t * t * t);
    [p, v, 0.5 * a, c3, c4, c5]
}

/// The pieces of a spline: of each column, between the numbers at two indices, over a length.
fn pieces<const N: usize, const TERMS: usize>(
    knots: &[f64],
    columns: usize,
    piece: impl Fn([usize; 2], f64) -> [f64; N],
) -> Vec<[f64; TERMS]> {
    let mut pieces = Vec::with_capacity((knots.len() - 1) * columns);
    for (knot, ends) in knots.windows(2).enumerate() {
        for start in knot * columns..(knot + 1) * columns {
            let mut terms = [0.0; TERMS];
            terms[..N].copy_from_slice(&piece([start, start + columns], ends[1] - ends[0]));
            pieces.push(terms);
        }
    }
    pieces
}
