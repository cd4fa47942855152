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
    of_1: [Moments; 3],
}

/// The equations of the left side in t1, or one in each lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Second<T = f64> {
    /// The moments along z that do not depend on t1.
    pub(super) along: [T; 6],
    /// Weights of what the moments along z differ from these, in cos t1 and sin t1.
    pub(super) weights: [[T; 6]; 2],
}

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

    /// Whether the moments along z tell t1, by more than a part of them that depends on it. Where
    /// axes 0, 1 and 2 meet in one point, or are parallel, they are even in an angle: of each root
    /// there are two solutions, or none.
    pub(super) fn tells_second(&self, part: f64) -> bool {
        let [_, c, s] = self.of_1.map(|moments| ALONG.map(|at| moments.0[at]));
        let (long, short) = if dot(c, c) > dot(s, s) { (c, s) } else { (s, c) };
        let along = dot(long, short) / dot(long, long);
        let across: [f64; 6] = core::array::from_fn(|k| short[k] - along * long[k]);
        // Not if there is no number.
        dot(across, across) > part * part * dot(long, long)
    }

    /// t1, by least squares (eq. 89).
    pub(super) fn second(&self) -> Second {
        let [along, c, s] = self.of_1.map(|moments| ALONG.map(|at| moments.0[at]));
        let (cc, cs, ss) = (dot(c, c), dot(c, s), dot(s, s));
        let determinant = cc * ss - cs * cs;
        Second {
            along,
            weights: [
                core::array::from_fn(|k| (ss * c[k] - cs * s[k]) / determinant),
                core::array::from_fn(|k| (cc * s[k] - cs * c[k]) / determinant),
            ],
        }
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

/// A unit vector n with `sum of n_k a_k = 0` for three complex vectors, which may depend on one
/// another: by three reflections that take their conjugates to the first three axes.
#[inline(always)]
fn orthogonal(vectors: [[Complex; 4]; 3]) -> [Complex; 4] {
    let mut normals = [[[0.0; 2]; 4]; 3];
    for (from, vector) in vectors.iter().enumerate() {
        let conjugate = vector.map(|[re, im]| [re, -im]);
        let turned = normals[..from].iter().fold(conjugate, complex_reflected);
        normals[from] = complex_mirror(turned, from);
    }
    let last = [[0.0, 0.0], [0.0, 0.0], [0.0, 0.0], [1.0, 0.0]];
    // A vector orthogonal to the conjugates is so without them.
    normals.iter().rev().fold(last, complex_reflected)
}

/// [`mirror`] of a complex vector.
#[inline(always)]
fn complex_mirror(of: [Complex; 4], from: usize) -> [Complex; 4] {
    let mut normal = of;
    normal[..from].fill([0.0; 2]);
    let square = |v: &[Complex; 4]| v.iter().map(|[re, im]| re * re + im * im).sum::<f64>();
    let length = square(&normal).sqrt();
    let [re, im] = normal[from];
    let size = (re * re + im * im).sqrt();
    let ahead = if size > 0.0 { [re / size, im / size] } else { [1.0, 0.0] };
    normal[from] = [re + length * ahead[0], im + length * ahead[1]];
    let left = square(&normal);
    let scale = if left > 0.0 { (2.0 / left).sqrt() } else { 0.0 };
    normal.map(|[re, im]| [re * scale, im * scale])
}

/// `v - n (n* v)`, which is unitary.
#[inline(always)]
fn complex_reflected(v: [Complex; 4], normal: &[Complex; 4]) -> [Complex; 4] {
    let mut along = [0.0; 2];
    for k in 0..4 {
        let [re, im] = product([normal[k][0], -normal[k][1]], v[k]);
        along = [along[0] + re, along[1] + im];
    }
    core::array::from_fn(|k| difference(v[k], product(normal[k], along)))
}
