//! Singular values of Jacobians in lanes: the least of them, and the product of all.
//!
//! Reflections from both sides leave a lower bidiagonal matrix L with the singular values of the
//! Jacobian J. The squares of its elements are all that is needed of it: the product of those on
//! the diagonal is det(J J^T), and the least root of det(L^T L - x) is the square of the least
//! singular value. A full decomposition takes many more instructions, and branches for each row.
//! Reference: Golub and Van Loan, Matrix Computations, 2013, 5.4.8; Fernando and Parlett, Accurate
//! singular values and differential qd algorithms, Numer. Math. 67, 1994.

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use crate::kinematics::chain::Chain;
use crate::kinematics::chain::forward::{is_finite, sines_of_joints, sines_of_rows};
use crate::kinematics::chain::jacobian::{JacobianFrame, jacobian_rows};
use crate::kinematics::thresholds::REFLECTED_SQUARE;
use crate::lanes::{Kernel, LANES, mul_add, run};

/// Laguerre's steps to the least root. Three are usual; of two roots that are one but for a rounding
/// each step leaves a quarter of the distance.
const MOST_ROOT_STEPS: usize = 32;

/// Figures of the singular values of a Jacobian.
#[derive(Clone, Copy)]
pub(in crate::kinematics) struct SingularValues {
    pub(in crate::kinematics) least: f64,
    /// The product of all, at most six.
    pub(in crate::kinematics) product: f64,
}

impl<const N: usize> Chain<N> {
    /// Of the Jacobian at the tool for the joint angles `q` [rad], its rows in m and rad as they
    /// are.
    pub(in crate::kinematics) fn singular_values(&self, q: &[f64; N]) -> SingularValues {
        run(OneJoints { chain: self, q })
    }

    /// [`Self::singular_values`] of up to a block of rows; anything of one that is not finite.
    pub(in crate::kinematics) fn singular_values_of_rows(
        &self,
        q: &[[f64; N]],
    ) -> [SingularValues; LANES] {
        run(Block { chain: self, q })
    }
}

/// One joint vector.
struct OneJoints<'a, const N: usize> {
    chain: &'a Chain<N>,
    q: &'a [f64; N],
}

/// Up to a block of joint vectors.
struct Block<'a, const N: usize> {
    chain: &'a Chain<N>,
    q: &'a [[f64; N]],
}

impl<const N: usize> Kernel for OneJoints<'_, N> {
    type Answer = SingularValues;
    const WIDE: bool = false;

    #[inline(always)]
    fn run<const FUSED: bool>(self) -> SingularValues {
        if !is_finite(self.q) {
            return SingularValues { least: f64::NAN, product: f64::NAN };
        }
        let (sin, cos) = sines_of_joints::<N, FUSED>(&self.chain.uncoupled(self.q));
        let [values] = singular_values::<N, 1, FUSED>(self.chain, &sin, &cos);
        values
    }
}

impl<const N: usize> Kernel for Block<'_, N> {
    type Answer = [SingularValues; LANES];
    const WIDE: bool = true;

    #[inline(always)]
    fn run<const FUSED: bool>(self) -> [SingularValues; LANES] {
        let (mut sin, mut cos) = ([[0.0; LANES]; N], [[0.0; LANES]; N]);
        sines_of_rows::<N, FUSED>(self.chain, self.q, &mut sin, &mut cos);
        singular_values::<N, LANES, FUSED>(self.chain, &sin, &cos)
    }
}

/// Return the singular values for these sines and cosines.
#[inline(always)]
fn singular_values<const N: usize, const W: usize, const FUSED: bool>(
    chain: &Chain<N>,
    sin: &[[f64; W]; N],
    cos: &[[f64; W]; N],
) -> [SingularValues; W] {
    let rows = jacobian_rows::<N, W, true, FUSED>(chain, JacobianFrame::Base, sin, cos);
    let squares = if N < 6 {
        Bidiagonal::of_few::<N, FUSED>(&rows)
    } else {
        Bidiagonal::of::<N, FUSED>(rows)
    };
    let (least, product) = (squares.least_root::<FUSED>(), squares.product(N));
    core::array::from_fn(|lane| SingularValues {
        least: least[lane].sqrt(),
        product: product[lane].sqrt(),
    })
}

/// Return the least singular value of a matrix by its rows.
pub(in crate::kinematics) fn least_singular_value(rows: &[[f64; 6]; 6]) -> f64 {
    let rows = rows.map(|row| row.map(|element| [element]));
    Bidiagonal::of::<6, false>(rows).least_root::<false>()[0].sqrt()
}

/// The squares of a bidiagonal matrix.
struct Bidiagonal<const W: usize> {
    diagonal: [[f64; W]; 6],
    beside: [[f64; W]; 5],
}

impl<const W: usize> Bidiagonal<W> {
    /// Of the rows, in turn: row k is turned onto its element k, and what is below that onto the
    /// element next to it.
    #[inline(always)]
    fn of<const N: usize, const FUSED: bool>(mut rows: [[[f64; W]; N]; 6]) -> Self {
        let (mut diagonal, mut beside) = ([[0.0; W]; 6], [[0.0; W]; 5]);
        for k in 0..6 {
            diagonal[k] = along_row::<N, W, FUSED>(&mut rows, k);
            if k < 5 && k < N {
                beside[k] = down_column::<N, W, FUSED>(&mut rows, k);
            }
        }
        Self { diagonal, beside }
    }

    /// Of fewer than six joints: of the transposed matrix, whose missing rows get a singular value
    /// that is not the least.
    #[inline(always)]
    fn of_few<const N: usize, const FUSED: bool>(rows: &[[[f64; W]; N]; 6]) -> Self {
        let mut transposed = [[[0.0; W]; 6]; 6];
        let mut all = [0.0; W];
        for (i, row) in rows.iter().enumerate() {
            for (j, element) in row.iter().enumerate() {
                transposed[j][i] = *element;
                for lane in 0..W {
                    all[lane] += element[lane] * element[lane];
                }
            }
        }
        let mut squares = Self::of::<6, FUSED>(transposed);
        squares.diagonal[N..].fill(all);
        squares
    }

    /// The product of the squares of the singular values of `joints` joints.
    #[inline(always)]
    fn product(&self, joints: usize) -> [f64; W] {
        let mut product = [1.0; W];
        for squares in self.diagonal.iter().take(joints) {
            for lane in 0..W {
                product[lane] *= squares[lane];
            }
        }
        product
    }

    /// The least root of `det(L^T L - x)`: Laguerre's steps climb to it from zero and never pass it,
    /// for all roots are real.
    ///
    /// The pivots of `L^T L - x` come from the squares without a difference but for x itself, and
    /// their derivatives are sums of positive numbers: the root is exact for squares that are off by
    /// a few roundings, however small it is.
    #[inline(always)]
    fn least_root<const FUSED: bool>(&self) -> [f64; W] {
        let mut root = [0.0; W];
        for _ in 0..MOST_ROOT_STEPS {
            let mut climbing = 0;
            for lane in 0..W {
                let x = root[lane];
                let [sum, squares] = self.inverse_distances::<FUSED>(x, lane);
                // Not past the root by a rounding, and not where pivots are zero: then it is zero.
                let climbs = sum > 0.0 && sum * (2.0 * f64::EPSILON * x) < 1.0;
                let spread = (5.0 * mul_add::<FUSED>(-sum, sum, 6.0 * squares)).max(0.0).sqrt();
                root[lane] = if climbs { x + 6.0 / (sum + spread) } else { x };
                climbing |= u64::from(climbs);
            }
            if climbing == 0 {
                break;
            }
        }
        root
    }

    /// The sums of `1 / (root - x)` and of its square over all roots: `-p' / p` of `p(x) =
    /// det(L^T L - x)`, the product of the pivots, and its derivative. Slope and bend of a pivot
    /// are its derivatives, less the sign.
    #[inline(always)]
    fn inverse_distances<const FUSED: bool>(&self, x: f64, lane: usize) -> [f64; 2] {
        let mut rest = self.diagonal[0][lane] - x;
        let (mut slope, mut bend, mut sum, mut squares) = (1.0, 0.0, 0.0, 0.0);
        for k in 0..5 {
            let beside = self.beside[k][lane];
            let inverse = 1.0 / (rest + beside);
            let ratio = self.diagonal[k + 1][lane] * inverse;
            let weight = slope * inverse;
            sum += weight;
            squares += mul_add::<FUSED>(bend, inverse, weight * weight);
            let part = beside * ratio;
            bend = part * inverse * mul_add::<FUSED>(2.0 * slope, weight, bend);
            slope = mul_add::<FUSED>(weight, part, 1.0);
            rest = mul_add::<FUSED>(rest, ratio, -x);
        }
        let weight = slope / rest;
        [sum + weight, squares + mul_add::<FUSED>(weight, weight, bend / rest)]
    }
}

/// Reflects joints so that row `k` has nothing behind its element `k`; the square of that is what
/// comes out.
#[inline(always)]
fn along_row<const N: usize, const W: usize, const FUSED: bool>(
    rows: &mut [[[f64; W]; N]; 6],
    k: usize,
) -> [f64; W] {
    let mut square = [0.0; W];
    for joint in k..N {
        for lane in 0..W {
            let element = rows[k][joint][lane];
            square[lane] = mul_add::<FUSED>(element, element, square[lane]);
        }
    }
    if k >= 5 || k >= N {
        return square;
    }
    let mut scale = [0.0; W];
    for lane in 0..W {
        (rows[k][k][lane], scale[lane]) = mirror(rows[k][k][lane], square[lane]);
    }
    let (mirror, below) = rows[k..].split_at_mut(1);
    for row in below {
        let mut dot = [0.0; W];
        for joint in k..N {
            for lane in 0..W {
                dot[lane] = mul_add::<FUSED>(mirror[0][joint][lane], row[joint][lane], dot[lane]);
            }
        }
        for lane in 0..W {
            dot[lane] *= -scale[lane];
        }
        for joint in k..N {
            for lane in 0..W {
                row[joint][lane] =
                    mul_add::<FUSED>(mirror[0][joint][lane], dot[lane], row[joint][lane]);
            }
        }
    }
    square
}

/// Reflects the rows below `k` so that column `k` has nothing below its element `k + 1`; the square
/// of that is what comes out.
#[inline(always)]
fn down_column<const N: usize, const W: usize, const FUSED: bool>(
    rows: &mut [[[f64; W]; N]; 6],
    k: usize,
) -> [f64; W] {
    let mut square = [0.0; W];
    for i in k + 1..6 {
        for lane in 0..W {
            let element = rows[i][k][lane];
            square[lane] = mul_add::<FUSED>(element, element, square[lane]);
        }
    }
    if k >= 4 {
        return square;
    }
    let mut scale = [0.0; W];
    for lane in 0..W {
        (rows[k + 1][k][lane], scale[lane]) = mirror(rows[k + 1][k][lane], square[lane]);
    }
    for joint in k + 1..N {
        let mut dot = [0.0; W];
        for row in &rows[k + 1..] {
            for lane in 0..W {
                dot[lane] = mul_add::<FUSED>(row[k][lane], row[joint][lane], dot[lane]);
            }
        }
        for lane in 0..W {
            dot[lane] *= -scale[lane];
        }
        for row in &mut rows[k + 1..] {
            for lane in 0..W {
                row[joint][lane] = mul_add::<FUSED>(row[k][lane], dot[lane], row[joint][lane]);
            }
        }
    }
    square
}

/// The first element of the normal v of the mirror that turns a vector of this first element and
/// square of the length onto its first axis, and 2 / |v|^2. No mirror, and so zero, where there is
/// nothing to turn.
#[inline(always)]
fn mirror(first: f64, square: f64) -> (f64, f64) {
    let length = square.sqrt();
    let scale = 1.0 / (length * (length + first.abs()));
    (first + length.copysign(first), if square < REFLECTED_SQUARE { 0.0 } else { scale })
}
