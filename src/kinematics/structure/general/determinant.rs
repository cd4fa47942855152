//! The determinant that is zero where the six equations have a common root in t3 and t4, and the
//! vectors that it then takes to zero (eq. 88, 90).
//!
//! With the equations `[E0 E1 E2]` by powers of x4, each 6 x 3 by powers of x3, the matrix is
//!
//! ```text
//! [ E0 E1 E2 0  ]
//! [ 0  E0 E1 E2 ]
//! ```
//!
//! Reflections of six rows take E0 to a triangle U, and the same for both copies; then F1 and U to
//! another one; what is left are six rows of six.

use fearless_simd::prelude::*;

use super::split::{Equations, Posed};
use crate::kinematics::structure::closure::{Six, reflect};
use crate::kinematics::structure::trigonometric::{
    SAMPLE_COS, SAMPLE_SIN, SAMPLES, TrigonometricPolynomial,
};
use crate::lanes::{LANES, Number as _, Vector};

/// Least singular value of the matrix, in roundings of the closure, that is more than what rounding
/// makes of zero [1]. Measured: up to 3 where it should be zero.
const VANISHES: f64 = 16.0;

/// Least factor of the determinant above which no singular value is that small, in the same unit.
/// Measured: up to 1e4 where one should be zero, above 1e9 elsewhere.
const REGULAR: f64 = 1e7;

/// Change of the matrix by the rounding of a pose, in roundings of the closure [1]: its elements
/// are of second degree in the pose, lengths in units of the arm. Measured next to folds: with 2,
/// one answer of 5000 is certified that is not complete.
const OF_THE_POSE: f64 = 4.0;

/// What is left of the matrix: six rows of six, for the powers 2 and 3 of x4, as a triangle.
pub(super) struct Rest<S: Simd> {
    columns: [Six<S>; 6],
    diagonal: Six<S>,
    /// The determinant.
    pub(super) determinant: Vector<S>,
    /// The least of its twelve factors, by size, and of the six before the rest.
    least: Vector<S>,
    least_before: Vector<S>,
}

impl Posed {
    /// The determinant as a polynomial of t5 (eq. 91), with the noise of a pose that is rounded
    /// (eq. 92): all of it is noise where it is zero at every angle.
    #[inline(always)]
    pub(super) fn polynomial<S: Simd>(&self, simd: S, rounding: f64) -> TrigonometricPolynomial {
        let zero = Vector::splat(simd, 0.0);
        let (mut samples, mut regular, mut others) = ([zero; SAMPLES / LANES], zero, zero);
        for block in 0..SAMPLES / LANES {
            let sin = Vector::load_array_ref(simd, &SAMPLE_SIN[block]);
            let cos = Vector::load_array_ref(simd, &SAMPLE_COS[block]);
            let rest = Rest::at(&self.equations, &sin, &cos);
            samples[block] = rest.determinant;
            regular = regular.max(rest.least * rest.least_before);
            others = others.max(rest.others());
        }
        let mut polynomial = TrigonometricPolynomial::of_samples(&samples).of_pose();
        let of_pose = others * (OF_THE_POSE * rounding);
        polynomial.noise = of_pose.to_array().into_iter().fold(polynomial.noise, f64::max);
        if !regular.simd_gt(REGULAR * rounding).any_true() && self.vanishes(simd, rounding) {
            polynomial.noise = f64::INFINITY;
        }
        polynomial
    }

    /// Whether the matrix is singular to rounding at every angle.
    #[cold]
    #[inline(never)]
    fn vanishes<S: Simd>(&self, simd: S, rounding: f64) -> bool {
        (0..SAMPLES / LANES).all(|block| {
            let sin = Vector::load_array_ref(simd, &SAMPLE_SIN[block]);
            let cos = Vector::load_array_ref(simd, &SAMPLE_COS[block]);
            let rest = Rest::at(&self.equations, &sin, &cos);
            // The reflections before the rest have enlarged rounding by their least factor.
            let size = rest.least_singular_value() * rest.least_before;
            !size.simd_gt(VANISHES * rounding).any_true()
        })
    }
}

impl<S: Simd> Rest<S> {
    /// The matrix at angles t5 with these sines and cosines.
    pub(super) fn at(equations: &Equations, sin: &Vector<S>, cos: &Vector<S>) -> Self {
        // A function of its own for each instruction set: it is long.
        sin.token().vectorize(
            #[inline(always)]
            || Self::reduced(equations, *sin, *cos),
        )
    }

    #[inline(always)]
    fn reduced(equations: &Equations, sin: Vector<S>, cos: Vector<S>) -> Self {
        let zero = sin.like(0.0);
        let mut first = [[zero; 6]; 9];
        for product in 0..9 {
            let constant = &equations[product];
            let (of_cos, of_sin) = (&equations[9 + product], &equations[18 + product]);
            for row in 0..6 {
                let along = cos.scaled_plus(of_cos[row], sin.like(constant[row]));
                first[product][row] = sin.scaled_plus(of_sin[row], along);
            }
        }
        let u = [
            triangulate::<0, 9, S>(&mut first),
            triangulate::<1, 9, S>(&mut first),
            triangulate::<2, 9, S>(&mut first),
        ];
        // [F1 F2 0; U A1 A2], with zeros where reflections left their normals.
        let mut second = [[zero; 6]; 9];
        for j in 0..3 {
            for row in 0..3 {
                second[j][row] = first[3 + j][3 + row];
                second[3 + j][row] = first[6 + j][3 + row];
                second[3 + j][3 + row] = first[3 + j][row];
                second[6 + j][3 + row] = first[6 + j][row];
                if row < j {
                    second[j][3 + row] = first[j][row];
                }
            }
            second[j][3 + j] = u[j];
        }
        let v = [
            triangulate::<0, 9, S>(&mut second),
            triangulate::<1, 9, S>(&mut second),
            triangulate::<2, 9, S>(&mut second),
        ];
        // [G1 G2; F1 F2]
        let mut columns = [[zero; 6]; 6];
        for j in 0..6 {
            for row in 0..3 {
                columns[j][row] = second[3 + j][3 + row];
                columns[j][3 + row] = first[3 + j][3 + row];
            }
        }
        let diagonal = [
            triangulate::<0, 6, S>(&mut columns),
            triangulate::<1, 6, S>(&mut columns),
            triangulate::<2, 6, S>(&mut columns),
            triangulate::<3, 6, S>(&mut columns),
            triangulate::<4, 6, S>(&mut columns),
            columns[5][5],
        ];
        let (mut determinant, mut least) = (u[0], u[0].abs());
        for factor in u[1..].iter().chain(&v) {
            determinant *= *factor;
            least = least.min(factor.abs());
        }
        let least_before = least;
        for factor in &diagonal {
            determinant *= *factor;
            least = least.min(factor.abs());
        }
        Self { columns, diagonal, determinant, least, least_before }
    }

    /// The least singular value of the rest, by inverse iteration.
    #[inline(always)]
    fn least_singular_value(&self) -> Vector<S> {
        let [null, _] = self.null_vectors(false);
        let mut square = self.determinant.like(0.0);
        for row in 0..6 {
            let mut sum = self.diagonal[row] * null[row];
            for column in row + 1..6 {
                sum = self.columns[column][row].mul_add(null[column], sum);
            }
            square = sum.mul_add(sum, square);
        }
        square.sqrt()
    }

    /// The determinant but for its least factor: what a change of an element makes of it, at most.
    #[inline(always)]
    fn others(&self) -> Vector<S> {
        self.determinant.abs() / self.least.max(LEAST)
    }

    /// Two orthonormal vectors that the rest takes nearest to zero, by inverse iteration.
    #[inline(always)]
    pub(super) fn null_vectors(&self, want_second: bool) -> [Six<S>; 2] {
        let mut inverse = self.diagonal;
        for k in 0..6 {
            let element = self.diagonal[k];
            // Huge, and finite, for zero.
            inverse[k] = element.size().or_more(element.like(LEAST)).copysign(element).inverse();
        }
        let mut first = self.start(&START[0]);
        for _ in 0..2 {
            first = self.inverted(&inverse, &first);
        }
        if !want_second {
            return [first, first];
        }
        let mut second = self.start(&START[1]);
        for _ in 0..3 {
            orthogonalize(&mut second, &first);
            second = self.inverted(&inverse, &second);
        }
        orthogonalize(&mut second, &first);
        [first, normalized(&second)]
    }

    #[inline(always)]
    fn start(&self, constants: &[f64; 6]) -> Six<S> {
        let mut start = self.diagonal;
        for k in 0..6 {
            start[k] = self.determinant.like(constants[k]);
        }
        start
    }

    /// `(R^T R)^-1 v`, normalized.
    #[inline(always)]
    fn inverted(&self, inverse: &Six<S>, v: &Six<S>) -> Six<S> {
        let mut x = *v;
        for k in 0..6 {
            for row in 0..k {
                x[k] = self.columns[k][row].mul_add(-x[row], x[k]);
            }
            x[k] *= inverse[k];
        }
        let mut x = normalized(&x);
        for k in (0..6).rev() {
            x[k] *= inverse[k];
            for row in 0..k {
                x[row] = self.columns[k][row].mul_add(-x[k], x[row]);
            }
        }
        normalized(&x)
    }
}

/// Vectors that inverse iteration starts from: orthogonal to nothing in particular.
const START: [[f64; 6]; 2] = [[0.9, -0.7, 0.6, 0.8, 0.5, -1.1], [-0.4, 0.9, 1.0, -0.6, 0.7, 0.3]];

/// Least size of a diagonal element [1]: its inverse has a square.
const LEAST: f64 = 1e-60;

#[inline(always)]
fn dot<S: Simd>(a: &Six<S>, b: &Six<S>) -> Vector<S> {
    let mut sum = a[0] * b[0];
    for k in 1..6 {
        sum = a[k].mul_add(b[k], sum);
    }
    sum
}

#[inline(always)]
fn normalized<S: Simd>(v: &Six<S>) -> Six<S> {
    // Elements may be as large as the inverse of the least.
    let mut most = v[0].size();
    for k in 1..6 {
        most = v[k].size().or_more(most);
    }
    let (mut unit, scale) = (*v, most.inverse());
    for k in 0..6 {
        unit[k] *= scale;
    }
    let scale = dot(&unit, &unit).sqrt().inverse();
    for k in 0..6 {
        unit[k] *= scale;
    }
    unit
}

#[inline(always)]
fn orthogonalize<S: Simd>(v: &mut Six<S>, to: &Six<S>) {
    let along = dot(v, to);
    for k in 0..6 {
        v[k] = to[k].mul_add(-along, v[k]);
    }
}

/// Reflect rows K and below so that column K is zero below row K; returns its element there, up to
/// a sign that all have in common.
#[inline(always)]
fn triangulate<const K: usize, const C: usize, S: Simd>(columns: &mut [Six<S>; C]) -> Vector<S> {
    let (mirrors, rest) = columns.split_at_mut(K + 1);
    let mirror = &mut mirrors[K];
    let mut square = mirror[K] * mirror[K];
    for row in K + 1..6 {
        square = mirror[row].mul_add(mirror[row], square);
    }
    let (length, first) = (square.sqrt(), mirror[K]);
    let product = length.mul_add(first.abs(), square);
    // A column of zeros needs no reflection.
    let zero = first.like(0.0);
    let scale = product.if_above(zero, first.like(-1.0) / product, zero);
    let diagonal = -length.copysign(first);
    mirror[K] = first - diagonal;
    for column in rest {
        reflect(mirror, scale, column, K);
    }
    diagonal
}
