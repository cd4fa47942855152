//! The deviation of a 3x3 matrix from a rotation, the rotation nearest to it, in arithmetic that
//! serves one matrix and a lane of many with the same bits; and the quaternion of a rotation.

use nalgebra::Rotation3;

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

pub(crate) type Rows3 = [[f64; 3]; 3];

/// The six independent elements of `R^T R - I`.
#[inline(always)]
pub(crate) fn gram_excess(r: &Rows3) -> [f64; 6] {
    let [[a, b, c], [d, e, f], [g, h, i]] = *r;
    [
        a * a + d * d + g * g - 1.0,
        b * b + e * e + h * h - 1.0,
        c * c + f * f + i * i - 1.0,
        a * b + d * e + g * h,
        a * c + d * f + g * i,
        b * c + e * f + h * i,
    ]
}

#[inline(always)]
pub(crate) fn determinant(r: &Rows3) -> f64 {
    let [[a, b, c], [d, e, f], [g, h, i]] = *r;
    a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
}

/// The rotation nearest to a matrix that deviates from orthonormal by at most 1e-5.
///
/// Newton's iteration for the orthogonal polar factor, `R <- R (3 I - R^T R) / 2`: each of two
/// steps squares the deviation.
#[inline(always)]
pub(crate) fn nearest_rotation(r: &Rows3) -> Rows3 {
    newton_step(&newton_step(r))
}

#[inline(always)]
fn newton_step(r: &Rows3) -> Rows3 {
    let excess = gram_excess(r);
    [newton_row(r[0], excess), newton_row(r[1], excess), newton_row(r[2], excess)]
}

/// A row times `(3 I - R^T R) / 2`, which is `I - excess / 2`.
#[inline(always)]
fn newton_row([a, b, c]: [f64; 3], [xx, yy, zz, xy, xz, yz]: [f64; 6]) -> [f64; 3] {
    [
        a - 0.5 * (a * xx + b * xy + c * xz),
        b - 0.5 * (a * xy + b * yy + c * yz),
        c - 0.5 * (a * xz + b * yz + c * zz),
    ]
}

/// The quaternion w, x, y, z of a rotation; w is not negative.
pub(crate) fn quaternion(rotation: &Rotation3<f64>) -> [f64; 4] {
    let r = rotation.matrix();
    // Shepperd's method: the largest of the four squares is computed first, the others follow from
    // it without cancellation.
    let squares = [
        1.0 + r[(0, 0)] + r[(1, 1)] + r[(2, 2)],
        1.0 + r[(0, 0)] - r[(1, 1)] - r[(2, 2)],
        1.0 - r[(0, 0)] + r[(1, 1)] - r[(2, 2)],
        1.0 - r[(0, 0)] - r[(1, 1)] + r[(2, 2)],
    ];
    let (xy, xz, yz) = (r[(0, 1)] + r[(1, 0)], r[(0, 2)] + r[(2, 0)], r[(1, 2)] + r[(2, 1)]);
    let (wx, wy, wz) = (r[(2, 1)] - r[(1, 2)], r[(0, 2)] - r[(2, 0)], r[(1, 0)] - r[(0, 1)]);
    let largest = (0..4).fold(0, |best, i| if squares[i] > squares[best] { i } else { best });
    let q = match largest {
        0 => [squares[0], wx, wy, wz],
        1 => [wx, squares[1], xy, xz],
        2 => [wy, xy, squares[2], yz],
        _ => [wz, xz, yz, squares[3]],
    };
    let norm = q.iter().map(|element| element * element).sum::<f64>().sqrt();
    let sign = if q[0] < 0.0 { -1.0 } else { 1.0 };
    q.map(|element| element * sign / norm)
}
