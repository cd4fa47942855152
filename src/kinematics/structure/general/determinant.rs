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

use super::equated::Equated;
use super::split::Posed;
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

/// Change of the matrix by the rounding of a pose, in roundings of the closure [1]: an element of a
/// pose is rounded by a sixth of one, 72 elements of the matrix are of second degree in it. Measured
/// at det J = 0 of calibrated arms: with 1/2, two answers of 100,000 are certified that miss the
/// fold; with 4, none of 60,000.
const OF_THE_POSE: f64 = 4.0;

/// The rest of the matrix: six rows of six, for the powers 2 and 3 of x4, as a triangle.
pub(super) struct Rest<S: Simd> {
    columns: [Six<S>; 6],
    pivots: [Pivot<S>; 6],
    pub(super) determinant: Vector<S>,
    /// The least of its twelve factors, by size, and of the six before the rest.
    least: Vector<S>,
    least_before: Vector<S>,
    /// By how much it changes with the matrix; zero if it was not asked for.
    change: Vector<S>,
}

/// An element of the diagonal of a triangle.
#[derive(Clone, Copy)]
struct Pivot<S: Simd> {
    value: Vector<S>,
    /// Huge, and finite, for zero.
    inverse: Vector<S>,
}

impl Posed {
    /// The determinant as a polynomial of t5 (eq. 91), with the noise of a pose that is rounded
    /// (eq. 92): all of it is noise where it is zero at every angle, or says too little.
    pub(super) fn polynomial<S: Simd>(
        &self,
        simd: S,
        rounding: f64,
        least_noise: f64,
    ) -> TrigonometricPolynomial {
        // A function of its own for each instruction set: it is long.
        simd.vectorize(
            #[inline(always)]
            || self.sampled(simd, rounding, least_noise),
        )
    }

    #[inline(always)]
    fn sampled<S: Simd>(
        &self,
        simd: S,
        rounding: f64,
        least_noise: f64,
    ) -> TrigonometricPolynomial {
        if !self.is_single {
            return TrigonometricPolynomial::UNKNOWN;
        }
        let zero = Vector::splat(simd, 0.0);
        let (mut samples, mut regular, mut change) = ([zero; SAMPLES / LANES], zero, zero);
        for block in 0..SAMPLES / LANES {
            let sin = Vector::load_array_ref(simd, &SAMPLE_SIN[block]);
            let cos = Vector::load_array_ref(simd, &SAMPLE_COS[block]);
            let rest = Rest::at(&Equated::One(&self.equations), &sin, &cos, true);
            samples[block] = rest.determinant;
            regular = regular.max(rest.least * rest.least_before);
            change = change.max(rest.change);
        }
        let mut polynomial = TrigonometricPolynomial::of_samples(&samples).of_pose();
        let of_pose = change * (OF_THE_POSE * rounding);
        polynomial.noise = of_pose.to_array().into_iter().fold(polynomial.noise, f64::max);
        polynomial.doubt = polynomial.noise.max(least_noise);
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
            let rest = Rest::at(&Equated::One(&self.equations), &sin, &cos, false);
            // The reflections before the rest have enlarged rounding by their least factor.
            let size = rest.least_singular_value() * rest.least_before;
            !size.simd_gt(VANISHES * rounding).any_true()
        })
    }
}

impl<S: Simd> Rest<S> {
    /// The matrix at angles t5 with these sines and cosines.
    pub(super) fn at(
        equations: &Equated<'_>,
        sin: &Vector<S>,
        cos: &Vector<S>,
        want_change: bool,
    ) -> Self {
        // A function of its own for each instruction set: it is long.
        sin.token().vectorize(
            #[inline(always)]
            || Self::reduced(equations, *sin, *cos, want_change),
        )
    }

    #[inline(always)]
    fn reduced(equations: &Equated<'_>, sin: Vector<S>, cos: Vector<S>, want_change: bool) -> Self {
        let zero = sin.like(0.0);
        let mut first = equations.at(sin, cos);
        let u = [
            triangulate::<0, 6, 9, S>(&mut first),
            triangulate::<1, 6, 9, S>(&mut first),
            triangulate::<2, 6, 9, S>(&mut first),
        ];
        // [F1 F2 0; U A1 A2], with zeros where reflections left their normals: column k has none
        // of its elements below row k + 3.
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
            second[j][3 + j] = u[j].value;
        }
        let v = [
            triangulate::<0, 4, 9, S>(&mut second),
            triangulate::<1, 5, 9, S>(&mut second),
            triangulate::<2, 6, 9, S>(&mut second),
        ];
        // [G1 G2; F1 F2]
        let mut columns = [[zero; 6]; 6];
        for j in 0..6 {
            for row in 0..3 {
                columns[j][row] = second[3 + j][3 + row];
                columns[j][3 + row] = first[3 + j][3 + row];
            }
        }
        let pivots = [
            triangulate::<0, 6, 6, S>(&mut columns),
            triangulate::<1, 6, 6, S>(&mut columns),
            triangulate::<2, 6, 6, S>(&mut columns),
            triangulate::<3, 6, 6, S>(&mut columns),
            triangulate::<4, 6, 6, S>(&mut columns),
            Pivot::of(columns[5][5]),
        ];
        let (mut others, mut least) = (u[0].value, u[0].value.abs());
        for pivot in u[1..].iter().chain(&v) {
            others *= pivot.value;
            least = least.min(pivot.value.abs());
        }
        let least_before = least;
        for pivot in &pivots[..5] {
            others *= pivot.value;
            least = least.min(pivot.value.abs());
        }
        let determinant = others * pivots[5].value;
        least = least.min(pivots[5].value.abs());
        let mut change = zero;
        if want_change {
            // The pivots but the last, alone, would do without elements above the diagonal.
            change = others.abs() * last_column([&first, &second], &columns, [&u, &v], &pivots);
            // Where several pivots are zero the column is not finite, and nothing changes.
            change = zero.like(f64::MAX).if_above(change, change, zero);
        }
        Self { columns, pivots, determinant, least, least_before, change }
    }

    /// The least singular value of the rest, by inverse iteration.
    #[inline(always)]
    fn least_singular_value(&self) -> Vector<S> {
        let null = normalized(&self.null_vector());
        let mut square = self.determinant.like(0.0);
        for row in 0..6 {
            let mut sum = self.pivots[row].value * null[row];
            for column in row + 1..6 {
                sum = self.columns[column][row].mul_add(null[column], sum);
            }
            square = sum.mul_add(sum, square);
        }
        square.sqrt()
    }

    /// A vector, of any length, that the rest takes nearest to zero, by inverse iteration.
    #[inline(always)]
    pub(super) fn null_vector(&self) -> Six<S> {
        let mut vector = self.start(&START[0]);
        for _ in 0..2 {
            vector = self.inverted(&vector);
        }
        vector
    }

    /// Two orthonormal vectors that the rest takes nearest to zero.
    #[inline(always)]
    pub(super) fn null_vectors(&self) -> [Six<S>; 2] {
        let first = normalized(&self.null_vector());
        let mut second = self.start(&START[1]);
        for _ in 0..3 {
            orthogonalize(&mut second, &first);
            second = self.inverted(&second);
        }
        orthogonalize(&mut second, &first);
        [first, normalized(&second)]
    }

    #[inline(always)]
    fn start(&self, constants: &[f64; 6]) -> Six<S> {
        let mut vector = [self.determinant.like(0.0); 6];
        for (element, constant) in vector.iter_mut().zip(constants) {
            *element = self.determinant.like(*constant);
        }
        vector
    }

    /// `(R^T R)^-1 v`, with a largest element of 1.
    #[inline(always)]
    fn inverted(&self, v: &Six<S>) -> Six<S> {
        let mut x = *v;
        for k in 0..6 {
            for row in 0..k {
                x[k] = self.columns[k][row].mul_add(-x[row], x[k]);
            }
            x[k] *= self.pivots[k].inverse;
        }
        let mut x = scaled(&x);
        for k in (0..6).rev() {
            x[k] *= self.pivots[k].inverse;
            for row in 0..k {
                x[row] = self.columns[k][row].mul_add(-x[k], x[row]);
            }
        }
        scaled(&x)
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

/// With a largest element of 1: before, it may be as large as the inverse of the least.
#[inline(always)]
fn scaled<S: Simd>(v: &Six<S>) -> Six<S> {
    let mut most = v[0].size();
    for k in 1..6 {
        most = v[k].size().or_more(most);
    }
    times(v, most.inverse())
}

#[inline(always)]
fn normalized<S: Simd>(v: &Six<S>) -> Six<S> {
    times(v, dot(v, v).sqrt().inverse())
}

#[inline(always)]
fn times<S: Simd>(v: &Six<S>, scale: Vector<S>) -> Six<S> {
    let mut scaled = *v;
    for k in 0..6 {
        scaled[k] *= scale;
    }
    scaled
}

#[inline(always)]
fn orthogonalize<S: Simd>(v: &mut Six<S>, to: &Six<S>) {
    let along = dot(v, to);
    for k in 0..6 {
        v[k] = to[k].mul_add(-along, v[k]);
    }
}

/// The length of the last column of the inverse of the matrix, times the last pivot: of the vector
/// that ends with one and is taken to the last row alone.
#[inline(always)]
fn last_column<S: Simd>(
    [first, second]: [&[Six<S>; 9]; 2],
    rest: &[Six<S>; 6],
    [u, v]: [&[Pivot<S>; 3]; 2],
    pivots: &[Pivot<S>; 6],
) -> Vector<S> {
    let mut x = [rest[0][0].like(1.0); 12];
    solve_back::<6, 5, 6, 6, S>(&mut x, rest, pivots);
    solve_back::<3, 3, 9, 3, S>(&mut x, second, v);
    solve_back::<0, 3, 9, 3, S>(&mut x, first, u);
    let mut square = x[0] * x[0];
    for element in &x[1..] {
        square = element.mul_add(*element, square);
    }
    square.sqrt()
}

/// Find elements `FROM` and on of a vector, as many as there are `ROWS`, from those behind them: a
/// triangle takes all of them to zero.
#[inline(always)]
fn solve_back<const FROM: usize, const ROWS: usize, const C: usize, const P: usize, S: Simd>(
    x: &mut [Vector<S>; 12],
    triangle: &[Six<S>; C],
    pivots: &[Pivot<S>; P],
) {
    let mut sums = [x[11].like(0.0); ROWS];
    for column in ROWS..C {
        for row in 0..ROWS {
            sums[row] = triangle[column][row].mul_add(x[FROM + column], sums[row]);
        }
    }
    for column in (0..ROWS).rev() {
        x[FROM + column] = -(sums[column] * pivots[column].inverse);
        for row in 0..column {
            sums[row] = triangle[column][row].mul_add(x[FROM + column], sums[row]);
        }
    }
}

impl<S: Simd> Pivot<S> {
    fn of(value: Vector<S>) -> Self {
        let inverse = value.abs().max(LEAST).copysign(value).inverse();
        Self { value, inverse }
    }
}

/// Reflect rows K to `END - 1` so that column K is zero below row K, as it is from row `END` on;
/// returns its element there.
#[inline(always)]
fn triangulate<const K: usize, const END: usize, const C: usize, S: Simd>(
    columns: &mut [Six<S>; C],
) -> Pivot<S> {
    let (mirrors, rest) = columns.split_at_mut(K + 1);
    let mirror = &mut mirrors[K];
    let mut square = mirror[K] * mirror[K];
    for row in K + 1..END {
        square = mirror[row].mul_add(mirror[row], square);
    }
    let (length, first) = (square.sqrt(), mirror[K]);
    let sum = length + first.abs();
    let product = length * sum;
    // A column of zeros needs no reflection.
    let zero = first.like(0.0);
    let scale = product.if_above(zero, first.like(-1.0) / product, zero);
    // 1 / length, without another division.
    let inverse = product.if_above(zero, -(scale * sum), first.like(1.0 / LEAST));
    let pivot = Pivot { value: -length.copysign(first), inverse: -inverse.copysign(first) };
    mirror[K] = first - pivot.value;
    for column in rest {
        reflect::<END, _>(mirror, scale, column, K);
    }
    pivot
}
