//! The six combinations of moments that do not depend on the first two joints of a split (eq. 85,
//! 86).

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use super::moments::{ACROSS, ALONG, MOMENTS, Moments};
use crate::kinematics::structure::end_frames::Frame;
use crate::lanes::{Column, LANES};

/// The left side of a split: moments of axis 2 before axis 0, as `of_1[0] + c1 of_1[1] + s1 of_1[2]`
/// before it is turned by t0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Left {
    pub(super) of_1: [Moments; 3],
}

/// A complex number.
type Complex = [f64; 2];

#[inline(always)]
fn product(a: Complex, b: Complex) -> Complex {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

#[inline(always)]
fn difference(a: Complex, b: Complex) -> Complex {
    [a[0] - b[0], a[1] - b[1]]
}

impl Left {
    pub(super) fn of(m0: &Frame, m1: &Frame) -> Self {
        let of_1 = Moments::AXIS.moved(m1).harmonics();
        Self { of_1: of_1.map(|moments| moments.moved(m0)) }
    }

    /// The combinations, one to a lane, by moments: the sum over the moments of the right side with
    /// these weights is zero. Four are of the moments along z, two of those across.
    #[inline(always)]
    pub(super) fn annihilator(&self) -> [Column; MOMENTS] {
        let mut weights = [[0.0; LANES]; MOMENTS];
        let [q0, q1, q2] = self.of_1.map(|moments| ALONG.map(|at| moments.0[at]));
        let rows = complement(q1, q2);
        for (lane, row) in rows.iter().enumerate() {
            for (k, at) in ALONG.into_iter().enumerate() {
                weights[at][lane] = row[k];
                weights[0][lane] -= row[k] * q0[k];
            }
        }
        let across = self.of_1.map(|moments| ACROSS.map(|at| [moments.0[at], moments.0[at + 1]]));
        for (k, [re, im]) in orthogonal(across).into_iter().enumerate() {
            let at = ACROSS[k];
            (weights[at][4], weights[at + 1][4]) = (re, -im);
            (weights[at][5], weights[at + 1][5]) = (im, re);
        }
        weights
    }

    /// The weights of the moments along z, less those for t1 = none, in cos t1 and sin t1: least
    /// squares (eq. 89).
    pub(super) fn weights_of_1(&self) -> [[f64; 6]; 2] {
        let [_, c, s] = self.of_1.map(|moments| ALONG.map(|at| moments.0[at]));
        let (cc, cs, ss) = (dot(c, c), dot(c, s), dot(s, s));
        let determinant = cc * ss - cs * cs;
        [
            core::array::from_fn(|k| (ss * c[k] - cs * s[k]) / determinant),
            core::array::from_fn(|k| (cc * s[k] - cs * c[k]) / determinant),
        ]
    }
}

fn dot(a: [f64; 6], b: [f64; 6]) -> f64 {
    (0..6).map(|k| a[k] * b[k]).sum()
}

/// Four orthonormal rows that are orthogonal to two vectors: by two reflections that take these to
/// the first two axes.
#[inline(always)]
fn complement(a: [f64; 6], b: [f64; 6]) -> [[f64; 6]; 4] {
    let first = mirror(a, 0);
    let second = mirror(reflected(b, &first), 1);
    core::array::from_fn(|row| {
        let mut axis = [0.0; 6];
        axis[2 + row] = 1.0;
        reflected(reflected(axis, &second), &first)
    })
}

/// The normal of the reflection that takes elements `from` and on of a vector to the first of them;
/// of length root 2, or zero.
#[inline(always)]
fn mirror(of: [f64; 6], from: usize) -> [f64; 6] {
    let mut normal = of;
    normal[..from].fill(0.0);
    let length = dot(normal, normal).sqrt();
    normal[from] += length.copysign(normal[from]);
    let square = dot(normal, normal);
    let scale = if square > 0.0 { (2.0 / square).sqrt() } else { 0.0 };
    normal.map(|x| x * scale)
}

#[inline(always)]
fn reflected(v: [f64; 6], normal: &[f64; 6]) -> [f64; 6] {
    let along = dot(v, *normal);
    core::array::from_fn(|k| v[k] - along * normal[k])
}

/// The unit vector n with `sum of n_k a_k = 0` for three complex vectors: their minors.
#[inline(always)]
fn orthogonal([a, b, c]: [[Complex; 4]; 3]) -> [Complex; 4] {
    // The 2x2 minors of the last two.
    let minor = |i: usize, j: usize| difference(product(b[i], c[j]), product(b[j], c[i]));
    let mut n: [Complex; 4] = core::array::from_fn(|without| {
        let mut left = [0, 1, 2].map(|k| if k < without { k } else { k + 1 });
        if without % 2 == 1 {
            left.swap(0, 1);
        }
        let [i, j, k] = left;
        let (x, y, z) =
            (product(a[i], minor(j, k)), product(a[j], minor(k, i)), product(a[k], minor(i, j)));
        [x[0] + y[0] + z[0], x[1] + y[1] + z[1]]
    });
    let square: f64 = n.iter().map(|[re, im]| re * re + im * im).sum();
    let scale = 1.0 / square.sqrt();
    for part in n.iter_mut().flatten() {
        *part *= scale;
    }
    n
}
