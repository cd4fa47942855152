//! The triangle that reflections make of the derivatives of the conditions, for one configuration
//! or eight at once.

use crate::lanes::Number;

/// `Q^T A` of six columns A, and of right sides.
pub(super) struct Triangle<T, const N: usize> {
    /// By column and row; below the diagonal is what is left of the reflections.
    columns: [[T; 6]; 6],
    pub(super) right: [[T; 6]; N],
    /// Inverses of the diagonal.
    inverse: [T; 6],
}

impl<T: Number, const N: usize> Triangle<T, N> {
    /// Reflect one column after the other (Householder); written out, solves take a twentieth less
    /// time.
    #[inline(always)]
    pub(super) fn of(columns: [[T; 6]; 6], right: [[T; 6]; N]) -> Self {
        let mut triangle = Self { columns, right, inverse: columns[0] };
        triangle.reflect(0);
        triangle.reflect(1);
        triangle.reflect(2);
        triangle.reflect(3);
        triangle.reflect(4);
        triangle.reflect(5);
        triangle
    }

    /// Reflect rows k and below so that column k is zero below row k.
    #[inline(always)]
    fn reflect(&mut self, k: usize) {
        let (done, rest) = self.columns.split_at_mut(k + 1);
        let mirror = &mut done[k];
        let (length, first) = (product_of::<6, T>(mirror, mirror, k).root(), mirror[k]);
        let (sum, zero) = (length + first.size(), first.like(0.0));
        let product = length * sum;
        // A zero needs no reflection.
        let scale = product.if_above(zero, first.like(-1.0) / product, zero);
        // 1 / length, without another division.
        let of_length = product.if_above(zero, -(scale * sum), first.like(f64::INFINITY));
        self.inverse[k] = -of_length.signed_as(first);
        mirror[k] = first + length.signed_as(first);
        for column in rest {
            reflect::<6, T>(mirror, scale, column, k);
        }
        for right in &mut self.right {
            reflect::<6, T>(mirror, scale, right, k);
        }
    }

    /// The solution `R x = right`.
    #[inline(always)]
    pub(super) fn back(&self, mut right: [T; 6]) -> [T; 6] {
        for k in (0..6).rev() {
            right[k] = right[k] * self.inverse[k];
            for row in 0..k {
                right[row] = self.columns[k][row].times_plus(-right[k], right[row]);
            }
        }
        right
    }

    /// The solution `R^T y = +-1`, with the signs for which y grows. Reference: Cline, Moler,
    /// Stewart and Wilkinson, An estimate for the condition number of a matrix, SIAM J. Numer.
    /// Anal. 16, 1979.
    #[inline(always)]
    fn grown(&self) -> [T; 6] {
        let zero = self.inverse[0].like(0.0);
        let mut y = [zero; 6];
        for k in 0..6 {
            let mut sum = zero;
            for row in 0..k {
                sum = self.columns[k][row].times_plus(-y[row], sum);
            }
            y[k] = (sum + zero.like(1.0).signed_as(sum)) * self.inverse[k];
        }
        y
    }

    /// The least singular value to a small factor: `|y| / |x|` for that y, and `R x = y`.
    #[inline(always)]
    pub(super) fn least(&self) -> T {
        let y = self.grown();
        let x = self.back(y);
        let zero = y[0].like(0.0);
        // Infinite or not a number: singular.
        (square(&y) / square(&x)).root().or_more(zero)
    }
}

/// Reflect rows k to `END - 1` of a column in a mirror with this normal; the scale is minus two
/// over the square of its length.
#[inline(always)]
pub(crate) fn reflect<const END: usize, T: Number>(
    mirror: &[T; 6],
    scale: T,
    column: &mut [T; 6],
    k: usize,
) {
    let along = product_of::<END, T>(mirror, column, k) * scale;
    for row in k..END {
        column[row] = mirror[row].times_plus(along, column[row]);
    }
}

/// The product of two columns in rows k to `END - 1`, by two sums that do not wait for one another.
#[inline(always)]
fn product_of<const END: usize, T: Number>(a: &[T; 6], b: &[T; 6], k: usize) -> T {
    let mut sums = [a[k] * b[k], a[k].like(0.0)];
    for row in k + 1..END {
        let sum = &mut sums[(row - k) % 2];
        *sum = a[row].times_plus(b[row], *sum);
    }
    sums[0] + sums[1]
}

/// The square of a vector's length.
#[inline(always)]
fn square<T: Number>(of: &[T; 6]) -> T {
    let mut sum = of[0].like(0.0);
    for part in of {
        sum = part.times_plus(*part, sum);
    }
    sum
}
