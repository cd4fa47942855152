//! From a root of the determinant to the angles of all joints (eq. 89).

use fearless_simd::prelude::*;

use super::annihilator::Second;
use super::pose_link::PoseLink;
use super::split::Split;
use crate::kinematics::structure::closure::{Placed, Six};
use crate::lanes::{Number as _, Vector, cross, dot};

/// An angle in lanes, as its sine and cosine.
#[derive(Clone, Copy)]
pub(super) struct Angle<S: Simd> {
    pub(super) sin: Vector<S>,
    pub(super) cos: Vector<S>,
}

/// The power 0 to 2 of x3 in the powers 2 and 3 of x4: the null vector of the determinant.
pub(super) type Powers<S> = Six<S>;

/// Square of a length below which it has no direction [1].
const LEAST_SQUARE: f64 = 1e-280;

impl<S: Simd> Angle<S> {
    /// The angle of a direction of any length.
    #[inline(always)]
    fn of(sin: Vector<S>, cos: Vector<S>) -> Self {
        let square = sin.mul_add(sin, cos * cos);
        let scale = square.sqrt().inverse();
        // Without a direction any angle will do: it is free.
        let is_free = square.simd_lt(LEAST_SQUARE);
        Self {
            sin: is_free.select(square.like(0.0), sin * scale),
            cos: is_free.select(square.like(1.0), cos * scale),
        }
    }

    /// The angle with half of it in this direction.
    #[inline(always)]
    fn of_half(sin: Vector<S>, cos: Vector<S>) -> Self {
        Self::of(sin * cos * 2.0, cos.mul_add(cos, -(sin * sin)))
    }
}

/// Angles t4 and t3 of a null vector: `[w, x4 w]`, `w = (1, x3, x3^2)`, times any factor.
#[inline(always)]
pub(super) fn eliminated<S: Simd>(powers: &Powers<S>) -> [Angle<S>; 2] {
    let (a, b) = ([powers[0], powers[1], powers[2]], [powers[3], powers[4], powers[5]]);
    // Both are multiples of w: their sum, or difference, is the longest.
    let side = a[0].like(1.0).copysign(dot(a, b));
    let w = [side.mul_add(b[0], a[0]), side.mul_add(b[1], a[1]), side.mul_add(b[2], a[2])];
    let (cos, sin) = (w[0] - w[2], w[1] * 2.0);
    let sign = a[0].like(1.0).copysign(w[0] + w[2]);
    [Angle::of_half(dot(b, w), dot(a, w)), Angle::of(sign * sin, sign * cos)]
}

/// The two vectors of the pencil that two null vectors span: each is `[w, x4 w]`
/// (eq. 90).
#[inline(always)]
pub(super) fn pencil<S: Simd>(null: &[Powers<S>; 2]) -> [Powers<S>; 2] {
    let (a, b) = (tipped(&null[0]), tipped(&null[1]));
    let (aa, ab, bb) = (dot(a.0, a.0), dot(a.0, b.0), dot(b.0, b.0));
    let m = [[dot(a.0, a.1), dot(a.0, b.1)], [dot(b.0, a.1), dot(b.0, b.1)]];
    // det(M - x A) = 0
    let square = aa.mul_add(bb, -(ab * ab));
    let half = (aa * m[1][1] + bb * m[0][0] - ab * (m[0][1] + m[1][0])) * 0.5;
    let constant = m[0][0].mul_add(m[1][1], -(m[0][1] * m[1][0]));
    let root = half.mul_add(half, -(square * constant)).or_more(half.like(0.0)).sqrt();
    // The larger root by the sum, the smaller by the product.
    let sum = half + root.copysign(half);
    let mut vectors = *null;
    for (vector, [over, under]) in vectors.iter_mut().zip([[sum, square], [constant, sum]]) {
        // A row of `under M - over A`, the longer one.
        let top = [under.mul_add(m[0][0], -(over * aa)), under.mul_add(m[0][1], -(over * ab))];
        let bottom = [under.mul_add(m[1][0], -(over * ab)), under.mul_add(m[1][1], -(over * bb))];
        let of_top = top[0].mul_add(top[0], top[1] * top[1]);
        let is_top = of_top.simd_gt(bottom[0].mul_add(bottom[0], bottom[1] * bottom[1]));
        let y = [-is_top.select(top[1], bottom[1]), is_top.select(top[0], bottom[0])];
        for k in 0..6 {
            vector[k] = y[0].mul_add(null[0][k], y[1] * null[1][k]);
        }
    }
    vectors
}

/// The halves of a vector, turned by an angle so that no x4 of a structured pose is infinite.
#[inline(always)]
fn tipped<S: Simd>(vector: &Powers<S>) -> ([Vector<S>; 3], [Vector<S>; 3]) {
    let (sin, cos) = (0.295_520_206_661_339_6, 0.955_336_489_125_606);
    let [mut lower, mut upper] = [[vector[0]; 3]; 2];
    for k in 0..3 {
        lower[k] = vector[k].scaled_plus(cos, vector[3 + k] * sin);
        upper[k] = vector[3 + k].scaled_plus(cos, vector[k] * -sin);
    }
    (lower, upper)
}

/// The sines and cosines of the joint angles of candidates with these t3 to t5.
pub(super) fn completed<S: Simd>(
    split: &Split,
    pose: &PoseLink<Vector<S>>,
    angles: &[Angle<S>; 3],
) -> [Six<S>; 2] {
    // A function of its own for each instruction set: it is long.
    angles[0].sin.token().vectorize(
        #[inline(always)]
        || all_of(split, pose, *angles),
    )
}

#[inline(always)]
fn all_of<S: Simd>(
    split: &Split,
    pose: &PoseLink<Vector<S>>,
    [t3, t4, t5]: [Angle<S>; 3],
) -> [Six<S>; 2] {
    // The frame behind axis 2, from the right.
    let right = Placed::of(split.back(5, pose, t5.sin))
        .turned(-t5.sin, t5.cos)
        .times(&split.back(4, pose, t5.sin))
        .turned(-t4.sin, t4.cos)
        .times(&split.back(3, pose, t5.sin))
        .turned(-t3.sin, t3.cos)
        .times(&split.back(2, pose, t5.sin));
    let t1 = second(&pose.second, &right);
    let left = Placed::of(split.link(0, pose, t5.sin))
        .turned(t1.sin, t1.cos)
        .times(&split.link(1, pose, t5.sin));
    let [t0, t2] = outer(&left, &right);
    let (mut sin, mut cos) = ([t5.sin; 6], [t5.cos; 6]);
    for (angle, joint) in [t0, t1, t2, t3, t4, t5].into_iter().zip(split.joints) {
        (sin[joint], cos[joint]) = (angle.sin * split.sign, angle.cos);
    }
    [sin, cos]
}

/// t1, from the moments along z by least squares.
#[inline(always)]
fn second<S: Simd>(
    Second { along, weights }: &Second<Vector<S>>,
    right: &Placed<Vector<S>>,
) -> Angle<S> {
    let (p, l) = (right.origin, right.z);
    let (pp, pl) = (dot(p, p), dot(p, l));
    let last = pp.mul_add(l[2], -(pl * p[2] * 2.0));
    let moments = [p[2], l[2], pp, pl, cross(p, l)[2], last];
    let (mut sin, mut cos) = (pp.like(0.0), pp.like(0.0));
    for k in 0..6 {
        let rest = moments[k] - along[k];
        cos = rest.mul_add(weights[0][k], cos);
        sin = rest.mul_add(weights[1][k], sin);
    }
    Angle::of(sin, cos)
}

/// t0, which turns axis 2 of the left to the right side's, and t2, which then turns about it.
#[inline(always)]
fn outer<S: Simd>(left: &Placed<Vector<S>>, right: &Placed<Vector<S>>) -> [Angle<S>; 2] {
    let [px, py, _] = left.origin;
    let [lx, ly, _] = left.z;
    let ([to_px, to_py, _], [to_lx, to_ly, _]) = (right.origin, right.z);
    let cos = px.mul_add(to_px, py.mul_add(to_py, lx.mul_add(to_lx, ly * to_ly)));
    let sin = px.mul_add(to_py, lx.mul_add(to_ly, -py.mul_add(to_px, ly * to_lx)));
    let t0 = Angle::of(sin, cos);
    // The right side's x axis, turned back by t0, along the left side's x and y axis.
    let [x, y, z] = right.x;
    let back = [t0.cos.mul_add(x, t0.sin * y), t0.cos.mul_add(y, -(t0.sin * x)), z];
    [t0, Angle::of(dot(left.y, back), dot(left.x, back))]
}
