//! From a root of the determinant to the angles of all joints (eq. 89).

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use super::moments::{ALONG, Motion};
use super::split::{Posed, Split};
use crate::kinematics::structure::closure::Candidates;
use crate::lanes::{Column, LANES, mul_add};

/// An angle in lanes, as its sine and cosine.
#[derive(Clone, Copy)]
pub(super) struct Angle {
    pub(super) sin: Column,
    pub(super) cos: Column,
}

/// The power 0 to 2 of x3 in the powers 2 and 3 of x4: the null vector of the determinant.
pub(super) type Powers = [Column; 6];

/// Square of a length below which it has no direction [1].
const LEAST_SQUARE: f64 = 1e-280;

impl Angle {
    /// The angle of a direction of any length.
    #[inline(always)]
    fn of<const FUSED: bool>(sin: &Column, cos: &Column) -> Self {
        let mut angle = Self { sin: *sin, cos: *cos };
        for lane in 0..LANES {
            let (s, c) = (sin[lane], cos[lane]);
            let square = mul_add::<FUSED>(s, s, c * c);
            let scale = 1.0 / square.sqrt();
            // Without a direction any angle will do: it is free.
            let is_free = square < LEAST_SQUARE;
            angle.sin[lane] = if is_free { 0.0 } else { s * scale };
            angle.cos[lane] = if is_free { 1.0 } else { c * scale };
        }
        angle
    }

    /// The angle with half of it in this direction.
    #[inline(always)]
    fn of_half<const FUSED: bool>(sin: &Column, cos: &Column) -> Self {
        let (mut double_sin, mut double_cos) = ([0.0; LANES], [0.0; LANES]);
        for lane in 0..LANES {
            let (s, c) = (sin[lane], cos[lane]);
            double_sin[lane] = 2.0 * s * c;
            double_cos[lane] = mul_add::<FUSED>(c, c, -(s * s));
        }
        Self::of::<FUSED>(&double_sin, &double_cos)
    }
}

/// Angles t4 and t3 of a null vector: `[w, x4 w]`, `w = (1, x3, x3^2)`, times any factor.
#[inline(always)]
pub(super) fn eliminated<const FUSED: bool>(powers: &Powers) -> [Angle; 2] {
    let [a0, a1, a2, b0, b1, b2] = powers;
    let (mut sin_4, mut cos_4) = ([0.0; LANES], [0.0; LANES]);
    let (mut sin_3, mut cos_3) = ([0.0; LANES], [0.0; LANES]);
    for lane in 0..LANES {
        let a = [a0[lane], a1[lane], a2[lane]];
        let b = [b0[lane], b1[lane], b2[lane]];
        // Both are multiples of w: their sum, or difference, is the longest.
        let side = 1.0_f64.copysign(dot::<FUSED>(a, b));
        let w = [
            mul_add::<FUSED>(side, b[0], a[0]),
            mul_add::<FUSED>(side, b[1], a[1]),
            mul_add::<FUSED>(side, b[2], a[2]),
        ];
        (cos_4[lane], sin_4[lane]) = (dot::<FUSED>(a, w), dot::<FUSED>(b, w));
        (cos_3[lane], sin_3[lane]) = (w[0] - w[2], 2.0 * w[1]);
        let sum = w[0] + w[2];
        let (c, s) = (cos_3[lane], sin_3[lane]);
        (cos_3[lane], sin_3[lane]) = if sum < 0.0 { (-c, -s) } else { (c, s) };
    }
    [Angle::of_half::<FUSED>(&sin_4, &cos_4), Angle::of::<FUSED>(&sin_3, &cos_3)]
}

#[inline(always)]
fn dot<const FUSED: bool>(a: [f64; 3], b: [f64; 3]) -> f64 {
    mul_add::<FUSED>(a[0], b[0], mul_add::<FUSED>(a[1], b[1], a[2] * b[2]))
}

/// The two vectors of the pencil that two null vectors span: those of which each is `[w, x4 w]`
/// (eq. 90).
#[inline(always)]
pub(super) fn pencil<const FUSED: bool>(null: &[Powers; 2]) -> [Powers; 2] {
    // Turned by an angle, so that no x4 of a structured pose is infinite.
    let (sin, cos) = (0.295_520_206_661_339_6, 0.955_336_489_125_606);
    let mut vectors = *null;
    for lane in 0..LANES {
        let [a, b] = [0, 1].map(|i| {
            let vector = &null[i];
            let of = |k: usize| vector[k][lane];
            (
                [0, 1, 2].map(|k| mul_add::<FUSED>(cos, of(k), sin * of(3 + k))),
                [0, 1, 2].map(|k| mul_add::<FUSED>(cos, of(3 + k), -(sin * of(k)))),
            )
        });
        let (aa, ab, bb) = (dot::<FUSED>(a.0, a.0), dot::<FUSED>(a.0, b.0), dot::<FUSED>(b.0, b.0));
        let m = [
            [dot::<FUSED>(a.0, a.1), dot::<FUSED>(a.0, b.1)],
            [dot::<FUSED>(b.0, a.1), dot::<FUSED>(b.0, b.1)],
        ];
        // det(M - x A) = 0
        let square = mul_add::<FUSED>(aa, bb, -(ab * ab));
        let half = 0.5 * (aa * m[1][1] + bb * m[0][0] - ab * (m[0][1] + m[1][0]));
        let constant = mul_add::<FUSED>(m[0][0], m[1][1], -(m[0][1] * m[1][0]));
        let discriminant = mul_add::<FUSED>(half, half, -(square * constant));
        let root = if discriminant > 0.0 { discriminant.sqrt() } else { 0.0 };
        // The larger root by the sum, the smaller by the product.
        let sum = half + root.copysign(half);
        let roots = [[sum, square], [constant, sum]];
        for i in 0..2 {
            let [over, under] = roots[i];
            // A row of `under M - over A`, the longer one.
            let e = |row: usize, column: usize, a: f64| {
                mul_add::<FUSED>(under, m[row][column], -(over * a))
            };
            let top = [e(0, 0, aa), e(0, 1, ab)];
            let bottom = [e(1, 0, ab), e(1, 1, bb)];
            let size = |row: [f64; 2]| mul_add::<FUSED>(row[0], row[0], row[1] * row[1]);
            let row = if size(top) > size(bottom) { top } else { bottom };
            let y = [-row[1], row[0]];
            for k in 0..6 {
                vectors[i][k][lane] =
                    mul_add::<FUSED>(y[0], null[0][k][lane], y[1] * null[1][k][lane]);
            }
        }
    }
    vectors
}

/// A frame in lanes: the rows of its rotation, and its origin.
#[derive(Clone, Copy)]
struct Placed {
    r: [[Column; 3]; 3],
    t: [Column; 3],
}

impl Placed {
    #[inline(always)]
    fn of(motion: &Motion) -> Self {
        Self { r: motion.r.map(|row| row.map(|x| [x; LANES])), t: motion.t.map(|x| [x; LANES]) }
    }

    /// This frame times a constant one.
    #[inline(always)]
    fn times<const FUSED: bool>(&self, by: &Motion) -> Self {
        let mut product = *self;
        for i in 0..3 {
            for lane in 0..LANES {
                let row = [self.r[i][0][lane], self.r[i][1][lane], self.r[i][2][lane]];
                for j in 0..3 {
                    let column = [by.r[0][j], by.r[1][j], by.r[2][j]];
                    product.r[i][j][lane] = dot::<FUSED>(row, column);
                }
                product.t[i][lane] = self.t[i][lane] + dot::<FUSED>(row, by.t);
            }
        }
        product
    }

    /// This frame turned about its z axis, back if `way` is -1.
    #[inline(always)]
    fn turned<const FUSED: bool>(&self, by: &Angle, way: f64) -> Self {
        let mut turned = *self;
        for i in 0..3 {
            for lane in 0..LANES {
                let (s, c) = (way * by.sin[lane], by.cos[lane]);
                let (x, y) = (self.r[i][0][lane], self.r[i][1][lane]);
                turned.r[i][0][lane] = mul_add::<FUSED>(x, c, y * s);
                turned.r[i][1][lane] = mul_add::<FUSED>(y, c, -(x * s));
            }
        }
        turned
    }
}

/// The angles t0 to t5 of candidates with these t3 to t5, as joint angles.
#[inline(always)]
pub(super) fn completed<const FUSED: bool>(
    split: &Split,
    posed: &Posed,
    weights: &[[f64; 6]; 2],
    [t3, t4, t5]: [&Angle; 3],
) -> Candidates {
    let inverses = posed.links.map(|link| link.inverse());
    // The frame behind axis 2, from the right.
    let right = Placed::of(&inverses[5])
        .turned::<FUSED>(t5, -1.0)
        .times::<FUSED>(&inverses[4])
        .turned::<FUSED>(t4, -1.0)
        .times::<FUSED>(&inverses[3])
        .turned::<FUSED>(t3, -1.0)
        .times::<FUSED>(&inverses[2]);
    let t1 = second::<FUSED>(posed, weights, &right);
    let left =
        Placed::of(&posed.links[0]).turned::<FUSED>(&t1, 1.0).times::<FUSED>(&posed.links[1]);
    let (t0, t2) = outer::<FUSED>(&left, &right);
    let mut candidates = Candidates::NEW;
    for (angle, joint) in [&t0, &t1, &t2, t3, t4, t5].into_iter().zip(split.joints) {
        for lane in 0..LANES {
            candidates.sin[joint][lane] = split.sign * angle.sin[lane];
            candidates.cos[joint][lane] = angle.cos[lane];
        }
    }
    candidates
}

/// t1, from the moments along z by least squares.
#[inline(always)]
fn second<const FUSED: bool>(posed: &Posed, weights: &[[f64; 6]; 2], right: &Placed) -> Angle {
    let known = ALONG.map(|at| posed.left.of_1[0].0[at]);
    let (mut sin, mut cos) = ([0.0; LANES], [0.0; LANES]);
    for lane in 0..LANES {
        let p = right.t.map(|x| x[lane]);
        let l = [right.r[0][2][lane], right.r[1][2][lane], right.r[2][2][lane]];
        let (pp, pl) = (dot::<FUSED>(p, p), dot::<FUSED>(p, l));
        let across = mul_add::<FUSED>(p[0], l[1], -(p[1] * l[0]));
        let last = mul_add::<FUSED>(pp, l[2], -(2.0 * pl * p[2]));
        let moments = [p[2], l[2], pp, pl, across, last];
        for k in 0..6 {
            let rest = moments[k] - known[k];
            cos[lane] = mul_add::<FUSED>(weights[0][k], rest, cos[lane]);
            sin[lane] = mul_add::<FUSED>(weights[1][k], rest, sin[lane]);
        }
    }
    Angle::of::<FUSED>(&sin, &cos)
}

/// t0, which turns axis 2 of the left to that of the right, and t2, which then turns about it.
#[inline(always)]
fn outer<const FUSED: bool>(left: &Placed, right: &Placed) -> (Angle, Angle) {
    let (mut sin, mut cos) = ([0.0; LANES], [0.0; LANES]);
    for lane in 0..LANES {
        let pairs = [
            [left.t[0][lane], left.t[1][lane], right.t[0][lane], right.t[1][lane]],
            [left.r[0][2][lane], left.r[1][2][lane], right.r[0][2][lane], right.r[1][2][lane]],
        ];
        for [x, y, to_x, to_y] in pairs {
            cos[lane] = mul_add::<FUSED>(x, to_x, mul_add::<FUSED>(y, to_y, cos[lane]));
            sin[lane] = mul_add::<FUSED>(x, to_y, mul_add::<FUSED>(-y, to_x, sin[lane]));
        }
    }
    let t0 = Angle::of::<FUSED>(&sin, &cos);
    let (mut sin, mut cos) = ([0.0; LANES], [0.0; LANES]);
    for lane in 0..LANES {
        let (s, c) = (t0.sin[lane], t0.cos[lane]);
        let to = [right.r[0][0][lane], right.r[1][0][lane], right.r[2][0][lane]];
        // The right side's x axis, turned back by t0, along the left side's x and y axis.
        let back = [
            mul_add::<FUSED>(c, to[0], s * to[1]),
            mul_add::<FUSED>(c, to[1], -(s * to[0])),
            to[2],
        ];
        let axis = |j: usize| [left.r[0][j][lane], left.r[1][j][lane], left.r[2][j][lane]];
        (cos[lane], sin[lane]) = (dot::<FUSED>(axis(0), back), dot::<FUSED>(axis(1), back));
    }
    (t0, Angle::of::<FUSED>(&sin, &cos))
}
