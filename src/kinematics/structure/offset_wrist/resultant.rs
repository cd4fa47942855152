//! The resultant: a trigonometric polynomial of joint 6 whose zeros are the solutions.
//!
//! Docs: offset_wrist.md, eq. 121 to 128. Branch-free arithmetic, which runs in lanes.

use fearless_simd::prelude::*;

use super::geometry::Lengths;
use super::step::Moving;
use crate::kinematics::structure::closure::Closure;
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::general::quasi_random;
use crate::kinematics::structure::trigonometric::{
    SAMPLE_COS, SAMPLE_SIN, SAMPLES, TrigonometricPolynomial,
};
use crate::lanes::{LANES, Number, Vector, VectorKernel, run_vectors};

/// What the rounding of a pose changes of the resultant, relative to its coefficients [1]: they are
/// of degree 8 in the pose's elements, and no surplus harmonic shows it.
const NOISE_OF_DEGREE_8: f64 = 64.0 * f64::EPSILON;

/// The same where joint 6 does not move the wrist point, relative to the resultant at other poses
/// [1]: each branch has a factor of its own then, which vanishes where its wrist is straight, but
/// not the rounding of what it is the difference of.
const NOISE_OF_STRAIGHT: f64 = 32.0 * NOISE_OF_DEGREE_8;

/// Poses that tell how large the resultant is.
const POSES: usize = 16;

/// Wrist point and direction of axis 5, as they turn with joint 6: constant parts, factors of its
/// cosine and factors of its sine (eq. 121).
#[derive(Clone, Copy, Debug)]
pub(super) struct Hand<T = f64> {
    point: [[T; 3]; 3],
    axis_5: [[T; 3]; 3],
}

impl<T: Number> Hand<T> {
    /// For frame 6 at theta_6 = 0, which is this frame turned back by joint 6.
    #[inline(always)]
    pub(super) fn of(lengths: &Lengths, last: &Frame<T>) -> Self {
        let Lengths { a5, d5, sin_5, cos_5, .. } = *lengths;
        let zero = last.origin[0].like(0.0);
        let mut hand = Self { point: [[zero; 3]; 3], axis_5: [[zero; 3]; 3] };
        for i in 0..3 {
            let [x, y, z] = last.rotation[i];
            let (along, across) = (d5 * cos_5, d5 * sin_5);
            hand.point[0][i] = last.origin[i] - z * along;
            hand.point[1][i] = x * -a5 - y * across;
            hand.point[2][i] = y * a5 - x * across;
            hand.axis_5[0][i] = z * cos_5;
            hand.axis_5[1][i] = y * sin_5;
            hand.axis_5[2][i] = x * sin_5;
        }
        hand
    }

    /// The vertical component of axis 5: constant, factors of the cosine and sine of joint 6.
    pub(super) fn rise_of_axis_5(&self) -> [T; 3] {
        self.axis_5.map(|part| part[2])
    }

    /// Wrist point and direction of axis 5 for joint 6.
    #[inline(always)]
    pub(super) fn at(&self, [sin, cos]: [T; 2]) -> ([T; 3], [T; 3]) {
        (turned(&self.point, sin, cos), turned(&self.axis_5, sin, cos))
    }

    /// The same, and how both change with joint 6.
    #[inline(always)]
    pub(super) fn moving(&self, [sin, cos]: [T; 2]) -> Moving<T> {
        let rates = (rate(&self.point, sin, cos), rate(&self.axis_5, sin, cos));
        Moving { at: self.at([sin, cos]), rates }
    }
}

impl Hand {
    /// The same, in the lanes of a number.
    #[inline(always)]
    pub(super) fn in_lanes<T: Number>(&self, like: T) -> Hand<T> {
        let zero = like.like(0.0);
        let mut hand = Hand { point: [[zero; 3]; 3], axis_5: [[zero; 3]; 3] };
        for part in 0..3 {
            for i in 0..3 {
                hand.point[part][i] = zero.like(self.point[part][i]);
                hand.axis_5[part][i] = zero.like(self.axis_5[part][i]);
            }
        }
        hand
    }
}

#[inline(always)]
fn turned<T: Number>([constant, of_cos, of_sin]: &[[T; 3]; 3], sin: T, cos: T) -> [T; 3] {
    let mut turned = [sin; 3];
    for i in 0..3 {
        turned[i] = cos.times_plus(of_cos[i], sin.times_plus(of_sin[i], constant[i]));
    }
    turned
}

#[inline(always)]
fn rate<T: Number>([_, of_cos, of_sin]: &[[T; 3]; 3], sin: T, cos: T) -> [T; 3] {
    let mut rate = [sin; 3];
    for i in 0..3 {
        rate[i] = cos.times_minus(of_sin[i], sin * of_cos[i]);
    }
    rate
}

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

/// The resultant as a polynomial, through its values at multiples of 15 deg of joint 6, for the hand
/// of a pose.
pub(super) fn polynomial<S: Simd>(
    simd: S,
    lengths: &Lengths,
    hand: &Hand,
) -> TrigonometricPolynomial {
    // A function of its own for each instruction set: it is long.
    simd.vectorize(
        #[inline(always)]
        || {
            let values = samples(simd, lengths, hand);
            let mut polynomial = TrigonometricPolynomial::of_samples(&values).of_pose();
            polynomial.noise += NOISE_OF_DEGREE_8 * polynomial.size() + lengths.least_noise;
            polynomial
        },
    )
}

/// The size of the resultant of a pose.
struct Size<'a>(&'a Lengths, Hand);

impl VectorKernel for Size<'_> {
    type Answer = f64;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> f64 {
        polynomial(simd, self.0, &self.1).size()
    }
}

/// The least noise of the resultant of an arm, whatever its size at a pose.
pub(super) fn least_noise(lengths: &Lengths, closure: &Closure) -> f64 {
    if lengths.turns_wrist_point() {
        return 0.0;
    }
    let size = |index| {
        let hand = Hand::of(lengths, &closure.last_frame(&quasi_random(index)));
        run_vectors(Size(lengths, hand))
    };
    NOISE_OF_STRAIGHT * (0..POSES).map(size).fold(0.0, f64::max)
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
