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

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use super::split::Equations;
use crate::lanes::{Column, LANES, mul_add};

type Rows = [Column; 6];

/// What is left of the matrix: six rows of six, for the powers 2 and 3 of x4, as a triangle.
pub(super) struct Rest {
    columns: [Rows; 6],
    diagonal: [Column; 6],
    /// The determinant.
    pub(super) determinant: Column,
}

impl Rest {
    /// The matrix at angles t5 with these sines and cosines.
    #[inline(always)]
    pub(super) fn at<const FUSED: bool>(equations: &Equations, sin: &Column, cos: &Column) -> Self {
        let mut first = [[[0.0; LANES]; 6]; 9];
        for (product, rows) in first.iter_mut().enumerate() {
            let [constant, of_cos, of_sin] = [0, 9, 18].map(|i| &equations[i + product]);
            for (row, column) in rows.iter_mut().enumerate() {
                for lane in 0..LANES {
                    let along = mul_add::<FUSED>(of_cos[row], cos[lane], constant[row]);
                    column[lane] = mul_add::<FUSED>(of_sin[row], sin[lane], along);
                }
            }
        }
        let mut determinant = [1.0; LANES];
        let u = [
            reflect::<0, 9, FUSED>(&mut first),
            reflect::<1, 9, FUSED>(&mut first),
            reflect::<2, 9, FUSED>(&mut first),
        ];
        // [F1 F2 0; U A1 A2], with zeros where reflections left their normals.
        let mut second = [[[0.0; LANES]; 6]; 9];
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
            reflect::<0, 9, FUSED>(&mut second),
            reflect::<1, 9, FUSED>(&mut second),
            reflect::<2, 9, FUSED>(&mut second),
        ];
        // [G1 G2; F1 F2]
        let mut columns = [[[0.0; LANES]; 6]; 6];
        for j in 0..6 {
            for row in 0..3 {
                columns[j][row] = second[3 + j][3 + row];
                columns[j][3 + row] = first[3 + j][3 + row];
            }
        }
        let diagonal = [
            reflect::<0, 6, FUSED>(&mut columns),
            reflect::<1, 6, FUSED>(&mut columns),
            reflect::<2, 6, FUSED>(&mut columns),
            reflect::<3, 6, FUSED>(&mut columns),
            reflect::<4, 6, FUSED>(&mut columns),
            columns[5][5],
        ];
        for factor in u.iter().chain(&v).chain(&diagonal) {
            for lane in 0..LANES {
                determinant[lane] *= factor[lane];
            }
        }
        Self { columns, diagonal, determinant }
    }

    /// Two orthonormal vectors that the rest takes nearest to zero, by inverse iteration.
    #[inline(always)]
    pub(super) fn null_vectors<const FUSED: bool>(&self, want_second: bool) -> [Rows; 2] {
        let mut first = START[0].map(|x| [x; LANES]);
        for _ in 0..2 {
            first = self.inverted::<FUSED>(&first);
        }
        if !want_second {
            return [first, first];
        }
        let mut second = START[1].map(|x| [x; LANES]);
        for _ in 0..3 {
            orthogonalize::<FUSED>(&mut second, &first);
            second = self.inverted::<FUSED>(&second);
        }
        orthogonalize::<FUSED>(&mut second, &first);
        [first, normalized::<FUSED>(&second)]
    }

    /// `(R^T R)^-1 v`, normalized.
    #[inline(always)]
    fn inverted<const FUSED: bool>(&self, v: &Rows) -> Rows {
        let mut x = *v;
        for k in 0..6 {
            for row in 0..k {
                for lane in 0..LANES {
                    x[k][lane] =
                        mul_add::<FUSED>(-self.columns[k][row][lane], x[row][lane], x[k][lane]);
                }
            }
            for lane in 0..LANES {
                x[k][lane] *= inverse(self.diagonal[k][lane]);
            }
        }
        let mut x = normalized::<FUSED>(&x);
        for k in (0..6).rev() {
            for lane in 0..LANES {
                x[k][lane] *= inverse(self.diagonal[k][lane]);
            }
            for row in 0..k {
                for lane in 0..LANES {
                    x[row][lane] =
                        mul_add::<FUSED>(-self.columns[k][row][lane], x[k][lane], x[row][lane]);
                }
            }
        }
        normalized::<FUSED>(&x)
    }
}

/// Vectors that inverse iteration starts from: orthogonal to nothing in particular.
const START: [[f64; 6]; 2] = [[0.9, -0.7, 0.6, 0.8, 0.5, -1.1], [-0.4, 0.9, 1.0, -0.6, 0.7, 0.3]];

/// The inverse of a diagonal element; huge, and finite, for zero.
#[inline(always)]
fn inverse(element: f64) -> f64 {
    let size = element.abs();
    1.0 / (if size < LEAST { LEAST } else { size }).copysign(element)
}

/// Least size of a diagonal element [1]: its inverse has a square.
const LEAST: f64 = 1e-60;

#[inline(always)]
fn dot<const FUSED: bool>(a: &Rows, b: &Rows) -> Column {
    let mut sum = [0.0; LANES];
    for k in 0..6 {
        for lane in 0..LANES {
            sum[lane] = mul_add::<FUSED>(a[k][lane], b[k][lane], sum[lane]);
        }
    }
    sum
}

#[inline(always)]
fn normalized<const FUSED: bool>(v: &Rows) -> Rows {
    // Elements may be as large as the inverse of the least.
    let mut most = [0.0; LANES];
    for k in 0..6 {
        for lane in 0..LANES {
            let size = v[k][lane].abs();
            most[lane] = if size > most[lane] { size } else { most[lane] };
        }
    }
    let mut unit = *v;
    for k in 0..6 {
        for lane in 0..LANES {
            unit[k][lane] /= most[lane];
        }
    }
    let square = dot::<FUSED>(&unit, &unit);
    for k in 0..6 {
        for lane in 0..LANES {
            unit[k][lane] /= square[lane].sqrt();
        }
    }
    unit
}

#[inline(always)]
fn orthogonalize<const FUSED: bool>(v: &mut Rows, to: &Rows) {
    let along = dot::<FUSED>(v, to);
    for k in 0..6 {
        for lane in 0..LANES {
            v[k][lane] = mul_add::<FUSED>(-along[lane], to[k][lane], v[k][lane]);
        }
    }
}

/// Reflect rows K and below so that column K is zero below row K; returns its element there, up to
/// a sign that all have in common.
#[inline(always)]
fn reflect<const K: usize, const C: usize, const FUSED: bool>(columns: &mut [Rows; C]) -> Column {
    let mut square = [0.0; LANES];
    for row in K..6 {
        for lane in 0..LANES {
            let element = columns[K][row][lane];
            square[lane] = mul_add::<FUSED>(element, element, square[lane]);
        }
    }
    let (mut scale, mut diagonal) = ([0.0; LANES], [0.0; LANES]);
    for lane in 0..LANES {
        let first = columns[K][K][lane];
        let length = square[lane].sqrt();
        let product = mul_add::<FUSED>(length, first.abs(), square[lane]);
        // A column of zeros needs no reflection.
        scale[lane] = if product > 0.0 { -1.0 / product } else { 0.0 };
        diagonal[lane] = -length.copysign(first);
        columns[K][K][lane] = first - diagonal[lane];
    }
    let (mirrors, rest) = columns.split_at_mut(K + 1);
    let mirror = &mirrors[K];
    for column in rest {
        let mut along = [0.0; LANES];
        for row in K..6 {
            for lane in 0..LANES {
                along[lane] = mul_add::<FUSED>(mirror[row][lane], column[row][lane], along[lane]);
            }
        }
        for lane in 0..LANES {
            along[lane] *= scale[lane];
        }
        for row in K..6 {
            for lane in 0..LANES {
                column[row][lane] =
                    mul_add::<FUSED>(mirror[row][lane], along[lane], column[row][lane]);
            }
        }
    }
    diagonal
}
