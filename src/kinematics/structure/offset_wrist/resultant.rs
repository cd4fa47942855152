//! The resultant: a trigonometric polynomial of joint 6 whose zeros are the solutions.
//!
//! Docs: offset_wrist.md, eq. 122 to 128. Branch-free arithmetic, which runs in lanes.

use fearless_simd::prelude::*;

use super::geometry::Lengths;
use super::hand::Hand;
use crate::kinematics::structure::closure::Closure;
use crate::kinematics::structure::trigonometric::{
    SAMPLE_COS, SAMPLE_SIN, SAMPLES, TrigonometricPolynomial,
};
use crate::lanes::{LANES, Number, Vector};

/// Noise of the resultant by the rounding of a pose, relative to its coefficients [1]: they are
/// of degree 8 in the pose's elements, and no surplus harmonic shows it.
const NOISE_OF_DEGREE_8: f64 = 64.0 * f64::EPSILON;

/// How far values may be off, in roundings of the closure times the sizes of (133) [1]. Measured
/// against 80 bits: a sixth of this or of the noise at most, in the square case a third.
const OFF: f64 = 1.0 / 64.0;

/// How far the wrist point is off its circle for these sizes, which vanish on axis 1, as a part of the
/// reach [1].
const SLACK: f64 = 1e-3;

/// A number `u + sigma v`, where sigma is the distance of the wrist point from axis 1 along the
/// plane of the arm, known by its square (eq. 127).
#[derive(Clone, Copy)]
struct Ring<T> {
    u: T,
    v: T,
}

impl<T: Number> Ring<T> {
    #[inline(always)]
    fn times(self, other: Self, sigma2: T) -> Self {
        Self {
            u: self.u.times_plus(other.u, sigma2 * (self.v * other.v)),
            v: self.u.times_plus(other.v, self.v * other.u),
        }
    }

    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        Self { u: self.u - other.u, v: self.v - other.v }
    }
}

/// The resultant for a wrist point and an axis 5 (eq. 125 to 128).
#[inline(always)]
pub(super) fn resultant<T: Number>(
    lengths: &Lengths,
    [wx, wy, h]: [T; 3],
    [zx, zy, zz]: [T; 3],
) -> T {
    let Lengths { a1, upper, forearm, v: [v1, v2], b, s1, e, cos_3, cos_4, m, .. } = *lengths;
    let zero = h.like(0.0);
    let r2 = wx.times_plus(wx, wy * wy);
    let along = zx.times_plus(wx, zy * wy);
    let across = zy.times_minus(wx, zx * wy);
    let sigma2 = r2 - r2.like(b * b);
    // Axis 5 in the axes of the plane, times r2.
    let radial = Ring { u: across * (s1 * b), v: along };
    let lateral = Ring { u: along * b, v: across * -s1 };
    let slant = e * cos_3;
    let bend = Ring { u: lateral.u.scaled_plus(-slant, r2 * cos_4), v: lateral.v * -slant };
    // The wrist point from axis 2.
    let square = Ring { u: h.times_plus(h, sigma2 + zero.like(a1 * a1)), v: zero.like(-2.0 * a1) };
    let excess = zero.like((forearm - upper) * (forearm + upper));
    let reach = Ring { u: (square.u + excess) * (0.5 / forearm), v: zero.like(-a1 / forearm) };
    let rise = r2 * zz * m;
    let first = Ring { u: rise * h.scaled_plus(v2, zero.like(-a1 * v1)), v: rise * v1 };
    let turn = Ring { u: h.scaled_plus(v1, zero.like(a1 * v2)) * m, v: zero.like(-m * v2) };
    let x = first.minus(radial.times(turn, sigma2)).minus(bend.times(reach, sigma2));
    let lateral = Ring { u: lateral.u * m, v: lateral.v * m };
    let whole = r2 * m;
    let y = Ring { u: whole * whole, v: zero }
        .minus(lateral.times(lateral, sigma2))
        .minus(bend.times(bend, sigma2));
    let z = square.minus(reach.times(reach, sigma2));
    let f = x.times(x, sigma2).minus(y.times(z, sigma2));
    // On axis 1 the resultant of an arm without lateral offset is zero.
    let inverse = r2.if_above(zero, r2.inverse(), zero);
    if lengths.is_square {
        f.u * inverse
    } else {
        f.u.times_minus(f.u, sigma2 * (f.v * f.v)) * (inverse * inverse)
    }
}

/// How far the resultant may be off: by roundings of what it is the difference of, and of the hand
/// (eq. 133).
fn doubt(lengths: &Lengths, hand: &Hand, closure: &Closure) -> f64 {
    let Lengths { a1, upper, forearm, b, cos_3, cos_4, m, circle, .. } = *lengths;
    let ([x, y, z], radius) = (hand.middle(), circle + SLACK * closure.reach);
    let across = ((x * x + y * y).root() + radius).max(b.abs());
    let (r, h) = (across + a1.abs(), z.abs() + radius);
    let (p2, half) = (r * r + h * h, 0.5 / forearm);
    let k = (p2 + ((forearm - upper) * (forearm + upper)).abs()) * half;
    let bend = cos_3.abs() + cos_4.abs();
    let factor = (m * m + bend * bend) * across;
    let sum = p2 + k * k;
    let size = factor * across * sum;
    let rate = 2.0 * factor * (sum + across * (r + h) * (1.0 + 2.0 * k * half));
    let change = closure.reach * rate;
    let all = if lengths.is_square { size + change } else { size * (size + 2.0 * change) };
    OFF * closure.rounding * all
}

/// The resultant as a polynomial, through its values at multiples of 15 deg of joint 6, for the hand
/// of a pose.
pub(super) fn polynomial<S: Simd>(
    simd: S,
    lengths: &Lengths,
    hand: &Hand,
    closure: &Closure,
) -> TrigonometricPolynomial {
    // A function of its own for each instruction set: it is long.
    simd.vectorize(
        #[inline(always)]
        || {
            let values = samples(simd, lengths, hand);
            let mut polynomial = TrigonometricPolynomial::of_samples(&values).of_pose();
            polynomial.noise += NOISE_OF_DEGREE_8 * polynomial.size();
            polynomial.doubt = polynomial.noise.max(doubt(lengths, hand, closure));
            polynomial
        },
    )
}

#[inline(always)]
fn samples<S: Simd>(simd: S, lengths: &Lengths, hand: &Hand) -> [Vector<S>; SAMPLES / LANES] {
    let zero = Vector::splat(simd, 0.0);
    let (hand, mut values) = (hand.in_lanes(zero), [zero; SAMPLES / LANES]);
    for block in 0..SAMPLES / LANES {
        let sin = Vector::load_array_ref(simd, &SAMPLE_SIN[block]);
        let cos = Vector::load_array_ref(simd, &SAMPLE_COS[block]);
        let (point, axis_5) = hand.at([sin, cos]);
        values[block] = resultant(lengths, point, axis_5);
    }
    values
}
