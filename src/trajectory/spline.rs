//! Smooth curves through waypoints: C2 cubic and C4 quintic splines.

use alloc::vec;
use alloc::vec::Vec;

use super::axis::{AxisMotion, AxisState};
use super::polynomial::TERMS;
use crate::spline::{Ends, cubic_slopes};

/// The pieces of a cubic spline with continuous second derivative, by piece and column.
///
/// `points` has a row of `dof` numbers for each of `knots`, of which there are at least two.
/// The derivatives at the knots solve a tridiagonal system, one for all columns (eq. 9, 10).
pub(super) fn cubic(
    knots: &[f64],
    points: &[f64],
    dof: usize,
    ends: Ends<'_>,
) -> Vec<[f64; TERMS]> {
    let slopes = cubic_slopes(knots, points, dof, ends);
    pieces(
        knots,
        dof,
        |knot, joint| {
            let index = knot * dof + joint;
            AxisState { position: points[index], velocity: slopes[index], acceleration: 0.0 }
        },
        AxisMotion::cubic,
    )
}

type Block = [[f64; 2]; 2];

/// The pieces of a quintic spline, at rest at both ends, whose first four derivatives are
/// continuous.
///
/// Velocity and acceleration at the inner knots solve a block tridiagonal system (eq. 11, 12).
pub(super) fn quintic(knots: &[f64], points: &[f64], dof: usize) -> Vec<[f64; TERMS]> {
    let count = knots.len();
    let way = |piece: usize, joint: usize| {
        points[(piece + 1) * dof + joint] - points[piece * dof + joint]
    };
    // The elimination of what is left of each inner knot: x = side - factor * x of the next one.
    let mut factors: Vec<Block> = vec![[[0.0; 2]; 2]; count];
    let mut states = vec![[0.0; 2]; count * dof];
    for knot in 1..count - 1 {
        let (l, r) = (knots[knot] - knots[knot - 1], knots[knot + 1] - knots[knot]);
        let (l2, r2) = (l * l, r * r);
        let (l3, r3) = (l2 * l, r2 * r);
        let left = [[-24.0 / l2, -3.0 / l], [-168.0 / l3, -24.0 / l2]];
        let middle = [
            [-36.0 / l2 + 36.0 / r2, 9.0 / l + 9.0 / r],
            [-192.0 / l3 - 192.0 / r3, 36.0 / l2 - 36.0 / r2],
        ];
        let right = [[24.0 / r2, -3.0 / r], [-168.0 / r3, 24.0 / r2]];
        let pivot = inverse(minus(middle, product(left, factors[knot - 1])));
        factors[knot] = product(pivot, right);
        for joint in 0..dof {
            let (before, after) = (way(knot - 1, joint), way(knot, joint));
            let side = [
                60.0 * (after / r3 - before / l3),
                -360.0 * (after / (r3 * r) + before / (l3 * l)),
            ];
            let known = applied(left, states[(knot - 1) * dof + joint]);
            states[knot * dof + joint] = applied(pivot, [side[0] - known[0], side[1] - known[1]]);
        }
    }
    for knot in (1..count - 1).rev() {
        for joint in 0..dof {
            let next = applied(factors[knot], states[(knot + 1) * dof + joint]);
            let state = &mut states[knot * dof + joint];
            *state = [state[0] - next[0], state[1] - next[1]];
        }
    }
    pieces(
        knots,
        dof,
        |knot, joint| {
            let [velocity, acceleration] = states[knot * dof + joint];
            AxisState { position: points[knot * dof + joint], velocity, acceleration }
        },
        AxisMotion::quintic,
    )
}

fn pieces(
    knots: &[f64],
    dof: usize,
    state: impl Fn(usize, usize) -> AxisState,
    piece: impl Fn(AxisState, AxisState, f64) -> AxisMotion,
) -> Vec<[f64; TERMS]> {
    let mut terms = Vec::with_capacity((knots.len() - 1) * dof);
    for knot in 0..knots.len() - 1 {
        let length = knots[knot + 1] - knots[knot];
        terms.extend(
            (0..dof)
                .map(|joint| *piece(state(knot, joint), state(knot + 1, joint), length).terms(0)),
        );
    }
    terms
}

fn product(a: Block, b: Block) -> Block {
    let element = |row: usize, column: usize| a[row][0] * b[0][column] + a[row][1] * b[1][column];
    [[element(0, 0), element(0, 1)], [element(1, 0), element(1, 1)]]
}

fn minus(a: Block, b: Block) -> Block {
    [[a[0][0] - b[0][0], a[0][1] - b[0][1]], [a[1][0] - b[1][0], a[1][1] - b[1][1]]]
}

fn inverse([[a, b], [c, d]]: Block) -> Block {
    let determinant = a * d - b * c;
    [[d / determinant, -b / determinant], [-c / determinant, a / determinant]]
}

fn applied(a: Block, x: [f64; 2]) -> [f64; 2] {
    [a[0][0] * x[0] + a[0][1] * x[1], a[1][0] * x[0] + a[1][1] * x[1]]
}
