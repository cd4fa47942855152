//! Cubic splines with continuous second derivative through rows of numbers.

use alloc::vec;
use alloc::vec::Vec;

/// How a cubic spline ends.
#[derive(Clone, Copy)]
pub(crate) enum Ends<'a> {
    /// With given derivatives, a row each.
    Clamped([&'a [f64]; 2]),
    /// The first two pieces are one cubic, and so are the last two: nothing is assumed of the ends.
    /// Of three knots the curve is a parabola, of two a line.
    NotAKnot,
}

/// The derivatives of a cubic spline at its knots, by knot and column.
///
/// `points` has a row of `columns` numbers for each of `knots`, of which there are at least two.
/// The derivatives solve a tridiagonal system, one for all columns (eq. 9, 10 of docs/motion.md).
pub(crate) fn cubic_slopes(
    knots: &[f64],
    points: &[f64],
    columns: usize,
    ends: Ends<'_>,
) -> Vec<f64> {
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

/// The cubic over a length between two positions with slopes: its coefficients from the constant
/// upwards (eq. 3).
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
