//! Branch-free arc tangent, sine and cosine, for kernels.
//!
//! Within 2 ulp of the correctly rounded value for every argument (`docs/theory/lanes.md`), with
//! the special values of the standard library's functions. `docs/theory/lanes/coefficients.py`
//! computes the constants.

use core::f64::consts::{FRAC_2_PI, FRAC_PI_2};

/// (pi/2 - `FRAC_PI_2`) / `FRAC_PI_2`: the rounding error of pi/2, and so of pi, relative to its
/// rounded value.
const PI_REST_RATIO: f64 = 3.898_171_832_519_375_5e-17;

/// `atan(t) = t + t u P(u)`, `u = t^2` in 0 ..= 1; P by ascending powers. Relative error of the arc
/// tangent: 2^-57.6.
const ATAN: [f64; 20] = [
    -0.333_333_333_333_330_7,
    0.199_999_999_999_517_56,
    -0.142_857_142_825_885_85,
    0.111_111_110_073_566_24,
    -0.090_909_070_080_359_62,
    0.076_922_798_913_425_84,
    -0.066_664_044_401_970_71,
    0.058_805_298_911_339_544,
    -0.052_535_270_801_063_19,
    0.047_223_491_610_865_836,
    -0.042_192_451_695_655,
    0.036_643_183_320_019_3,
    -0.029_905_771_444_552_195,
    0.021_987_092_471_471_667,
    -0.013_902_577_679_779_189,
    0.007_197_874_759_566_654,
    -0.002_885_598_500_632_556_3,
    0.000_831_553_810_942_137_4,
    -0.000_152_209_512_913_062_57,
    1.322_980_287_561_736_2e-5,
];

/// `sin(r) = r + r z S(z)`, `z = r^2`, `|r| <= pi/4`. Relative error of the sine: 2^-57.9.
const SIN: [f64; 6] = [
    -0.166_666_666_666_666_3,
    0.008_333_333_333_321_846,
    -0.000_198_412_698_293_648_03,
    2.755_731_354_114_195e-6,
    -2.505_073_484_906_274_4e-8,
    1.589_546_201_604_782_7e-10,
];

/// `cos(r) = 1 - z/2 + z^2 C(z)`, `|r| <= pi/4`. Relative error of the cosine: 2^-63.9.
const COS: [f64; 6] = [
    0.041_666_666_666_666_595,
    -0.001_388_888_888_887_334_2,
    2.480_158_728_900_227e-5,
    -2.755_731_421_715_662e-7,
    2.087_570_541_994_286e-9,
    -1.135_875_083_077_524_6e-11,
];

/// pi/2 in three parts, of which the first two have 37 bits: their products with whole numbers
/// below 2^16 are exact. The sum is off by 2^-130.5.
const PI_2_PARTS: [f64; 3] =
    [1.570_796_326_792_333_3, 2.563_344_151_583_955_8e-12, 1.056_299_906_698_742_8e-23];

/// 1.5 * 2^52: adding it to a number rounds that to a whole one, whose low bits are then the
/// sum's.
const ROUND: f64 = 6_755_399_441_055_744.0;

/// The smallest positive number, which replaces the zero in 0/0.
const LEAST: f64 = 5e-324;

const SIGN: u64 = 1 << 63;

/// `a * b + c`, in one rounding where the instruction set has it.
#[inline(always)]
pub(crate) fn mul_add<const FUSED: bool>(a: f64, b: f64, c: f64) -> f64 {
    #[cfg(feature = "std")]
    if FUSED {
        return a.mul_add(b, c);
    }
    a * b + c
}

/// The nearest whole number, for a number below 2^51 in size or infinite; ties to even. Without a
/// call on any processor.
#[inline(always)]
pub fn nearest_whole(number: f64) -> f64 {
    (number + ROUND) - ROUND
}

/// The largest whole number that is not above.
#[inline(always)]
pub fn whole_below(number: f64) -> f64 {
    let nearest = nearest_whole(number);
    if nearest > number { nearest - 1.0 } else { nearest }
}

/// The smallest whole number that is not below.
#[inline(always)]
pub(crate) fn whole_above(number: f64) -> f64 {
    let nearest = nearest_whole(number);
    if nearest < number { nearest + 1.0 } else { nearest }
}

/// The angle of the direction (x, y) [rad], for every argument as [`f64::atan2`].
#[inline(always)]
#[expect(clippy::float_cmp, reason = "both infinite")]
pub(crate) fn atan2<const FUSED: bool>(y_signed: f64, x: f64) -> f64 {
    let y = y_signed.abs();
    let width = x.abs();
    let steep = y > width;
    // t = least / most, written so that the compiler divides once, and that a NaN in either makes
    // it NaN.
    let least = if steep { width } else { y };
    let width = if width < LEAST { LEAST } else { width };
    let most = if width < y { y } else { width };
    let t = least / most;
    // Both may be infinite.
    let t = if least == most { 1.0 } else { t };
    // The angle up to its sign is base + atan(t): 0 or -pi/2 for x > 0, -pi or pi/2 for x < 0.
    let side = FRAC_PI_2.copysign(x);
    let base = if steep { -side } else { side - FRAC_PI_2 };
    let rest = base * PI_REST_RATIO;
    let u = t * t;
    let u2 = u * u;
    let u4 = u2 * u2;
    let p = mul_add::<FUSED>(
        four::<FUSED>(ATAN[16], ATAN[17], ATAN[18], ATAN[19], u, u2),
        u4,
        four::<FUSED>(ATAN[12], ATAN[13], ATAN[14], ATAN[15], u, u2),
    );
    let p = mul_add::<FUSED>(p, u4, four::<FUSED>(ATAN[8], ATAN[9], ATAN[10], ATAN[11], u, u2));
    let p = mul_add::<FUSED>(p, u4, four::<FUSED>(ATAN[4], ATAN[5], ATAN[6], ATAN[7], u, u2));
    let p = mul_add::<FUSED>(p, u4, four::<FUSED>(ATAN[0], ATAN[1], ATAN[2], ATAN[3], u, u2));
    (base + (t + mul_add::<FUSED>(t * u, p, rest))).copysign(y_signed)
}

/// `a + b u + c u^2 + d u^3`
#[inline(always)]
fn four<const FUSED: bool>(a: f64, b: f64, c: f64, d: f64, u: f64, u2: f64) -> f64 {
    mul_add::<FUSED>(mul_add::<FUSED>(d, u, c), u2, mul_add::<FUSED>(b, u, a))
}

/// Largest angle of [`sin_cos`] [rad].
pub(crate) const MOST_SIN_COS: f64 = 1e5;

/// Sine and cosine of an angle of at most [`MOST_SIN_COS`] [rad]; incorrect beyond. NaN for an
/// argument that is not finite.
#[inline(always)]
pub(crate) fn sin_cos<const FUSED: bool>(angle: f64) -> (f64, f64) {
    let [first, second, third] = PI_2_PARTS;
    // turns = -(angle / (pi/2), rounded); high + low = angle + turns * pi/2. Near a multiple of
    // pi/2 the two differences are exact.
    let sum = mul_add::<FUSED>(angle, FRAC_2_PI, ROUND);
    let turns = ROUND - sum;
    let a = mul_add::<FUSED>(turns, first, angle);
    let b = turns * second;
    let high = a + b;
    let low = mul_add::<FUSED>(turns, third, (a - high) + b);
    let z = high * high;
    let z2 = z * z;
    let sin = high + mul_add::<FUSED>(high * z, six::<FUSED>(&SIN, z, z2), low);
    let cos = 1.0
        + mul_add::<FUSED>(z, -0.5, mul_add::<FUSED>(z2, six::<FUSED>(&COS, z, z2), -(high * low)));
    // The two lowest bits are the quadrant.
    let quadrant = sum.to_bits();
    let odd = quadrant & 1 != 0;
    let (s, c) = (if odd { cos } else { sin }, if odd { sin } else { cos });
    let s = f64::from_bits(s.to_bits() ^ ((quadrant << 62) & SIGN));
    let c = f64::from_bits(c.to_bits() ^ ((quadrant.wrapping_add(1) << 62) & SIGN));
    (if angle == 0.0 { angle } else { s }, c)
}

#[inline(always)]
fn six<const FUSED: bool>(c: &[f64; 6], z: f64, z2: f64) -> f64 {
    let high =
        mul_add::<FUSED>(mul_add::<FUSED>(c[5], z, c[4]), z2, mul_add::<FUSED>(c[3], z, c[2]));
    mul_add::<FUSED>(high, z2, mul_add::<FUSED>(c[1], z, c[0]))
}

#[cfg(test)]
mod tests;
mod vectors;

pub(crate) use vectors::{atan2_of, sin_cos_of};
