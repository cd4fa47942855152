//! The resultant: a trigonometric polynomial of joint 6 whose zeros are the solutions.
//!
//! Docs: offset_wrist.md, eq. 50 to 58. Branch-free arithmetic, which runs in lanes.

use super::geometry::Lengths;
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::trigonometric::{SAMPLE_COS, SAMPLE_SIN, SAMPLES};
use crate::lanes::{Column, LANES, mul_add};

/// Wrist point and direction of axis 5, as they turn with joint 6: constant parts, factors of its
/// cosine and factors of its sine (eq. 50).
#[derive(Clone, Copy, Debug)]
pub(super) struct Hand {
    point: [[f64; 3]; 3],
    axis_5: [[f64; 3]; 3],
}

impl Hand {
    /// For frame 6 at theta_6 = 0, which is this frame turned back by joint 6.
    #[inline(always)]
    pub(super) fn of<const FUSED: bool>(lengths: &Lengths, last: &Frame) -> Self {
        let Lengths { a5, d5, sin_5, cos_5, .. } = *lengths;
        let mut hand = Self { point: [[0.0; 3]; 3], axis_5: [[0.0; 3]; 3] };
        for i in 0..3 {
            let [x, y, z] = last.rotation[i];
            let (along, across) = (d5 * cos_5, d5 * sin_5);
            hand.point[0][i] = mul_add::<FUSED>(-along, z, last.origin[i]);
            hand.point[1][i] = mul_add::<FUSED>(-a5, x, -(across * y));
            hand.point[2][i] = mul_add::<FUSED>(a5, y, -(across * x));
            hand.axis_5[0][i] = cos_5 * z;
            hand.axis_5[1][i] = sin_5 * y;
            hand.axis_5[2][i] = sin_5 * x;
        }
        hand
    }

    /// Wrist point and direction of axis 5 for joint 6.
    #[inline(always)]
    pub(super) fn at<const FUSED: bool>(&self, [sin, cos]: [f64; 2]) -> ([f64; 3], [f64; 3]) {
        (turned::<FUSED>(&self.point, sin, cos), turned::<FUSED>(&self.axis_5, sin, cos))
    }
}

#[inline(always)]
fn turned<const FUSED: bool>(parts: &[[f64; 3]; 3], sin: f64, cos: f64) -> [f64; 3] {
    let [constant, of_cos, of_sin] = parts;
    let part =
        |i: usize| mul_add::<FUSED>(cos, of_cos[i], mul_add::<FUSED>(sin, of_sin[i], constant[i]));
    [part(0), part(1), part(2)]
}

/// A number `u + sigma v`, where sigma is the distance of the wrist point from axis 1 along the
/// plane of the arm, known by its square (eq. 54).
#[derive(Clone, Copy)]
struct Ring {
    u: f64,
    v: f64,
}

impl Ring {
    #[inline(always)]
    fn times<const FUSED: bool>(self, other: Self, sigma2: f64) -> Self {
        Self {
            u: mul_add::<FUSED>(self.u, other.u, sigma2 * (self.v * other.v)),
            v: mul_add::<FUSED>(self.u, other.v, self.v * other.u),
        }
    }

    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        Self { u: self.u - other.u, v: self.v - other.v }
    }
}

/// The resultant for a wrist point and an axis 5 (eq. 55 to 58).
#[inline(always)]
fn resultant<const FUSED: bool>(
    lengths: &Lengths,
    [wx, wy, h]: [f64; 3],
    [zx, zy, zz]: [f64; 3],
) -> f64 {
    let Lengths { a1, upper, forearm, v: [v1, v2], b, s1, e, cos_3, cos_4, m, .. } = *lengths;
    let r2 = mul_add::<FUSED>(wx, wx, wy * wy);
    let along = mul_add::<FUSED>(zx, wx, zy * wy);
    let across = mul_add::<FUSED>(zy, wx, -(zx * wy));
    let sigma2 = mul_add::<FUSED>(-b, b, r2);
    // Axis 5 in the axes of the plane, times r2.
    let radial = Ring { u: s1 * b * across, v: along };
    let lateral = Ring { u: b * along, v: -s1 * across };
    let slant = e * cos_3;
    let bend = Ring { u: mul_add::<FUSED>(cos_4, r2, -(slant * lateral.u)), v: -slant * lateral.v };
    // The wrist point from axis 2.
    let square = Ring { u: mul_add::<FUSED>(h, h, mul_add::<FUSED>(a1, a1, sigma2)), v: -2.0 * a1 };
    let reach = Ring {
        u: (square.u + (forearm - upper) * (forearm + upper)) / (2.0 * forearm),
        v: -a1 / forearm,
    };
    let rise = m * r2 * zz;
    let first = Ring { u: rise * mul_add::<FUSED>(h, v2, -(a1 * v1)), v: rise * v1 };
    let turn = Ring { u: m * mul_add::<FUSED>(h, v1, a1 * v2), v: -m * v2 };
    let x =
        first.minus(radial.times::<FUSED>(turn, sigma2)).minus(bend.times::<FUSED>(reach, sigma2));
    let lateral = Ring { u: m * lateral.u, v: m * lateral.v };
    let y = Ring { u: (m * r2) * (m * r2), v: 0.0 }
        .minus(lateral.times::<FUSED>(lateral, sigma2))
        .minus(bend.times::<FUSED>(bend, sigma2));
    let z = square.minus(reach.times::<FUSED>(reach, sigma2));
    let f = x.times::<FUSED>(x, sigma2).minus(y.times::<FUSED>(z, sigma2));
    // On axis 1 the resultant of an arm without lateral offset is zero.
    let inverse = if r2 > 0.0 { 1.0 / r2 } else { 0.0 };
    if lengths.is_square {
        f.u * inverse
    } else {
        mul_add::<FUSED>(f.u, f.u, -(sigma2 * (f.v * f.v))) * (inverse * inverse)
    }
}

/// The resultant at multiples of 15 deg of joint 6.
#[inline(always)]
pub(super) fn samples<const FUSED: bool>(
    lengths: &Lengths,
    hand: &Hand,
) -> [Column; SAMPLES / LANES] {
    let mut values = [[0.0; LANES]; SAMPLES / LANES];
    for block in 0..SAMPLES / LANES {
        for lane in 0..LANES {
            let (sin, cos) = (SAMPLE_SIN[block][lane], SAMPLE_COS[block][lane]);
            let (point, axis_5) = hand.at::<FUSED>([sin, cos]);
            values[block][lane] = resultant::<FUSED>(lengths, point, axis_5);
        }
    }
    values
}
