//! The functions for vectors, with the same bits.

use core::f64::consts::{FRAC_2_PI, FRAC_PI_2};

use fearless_simd::prelude::*;

use super::{ATAN, COS, LEAST, PI_2_PARTS, PI_REST_RATIO, ROUND, SIGN, SIN};
use crate::lanes::{Number as _, Vector};

/// The angles of directions (x, y) of finite lengths [rad].
#[inline(always)]
pub(crate) fn atan2_of<S: Simd>(y_signed: Vector<S>, x: Vector<S>) -> Vector<S> {
    let (y, width) = (y_signed.abs(), x.abs());
    let is_steep = y.simd_gt(width);
    let least = is_steep.select(width, y);
    let width = x.like(LEAST).if_above(width, x.like(LEAST), width);
    let t = least / y.if_above(width, y, width);
    let side = x.like(FRAC_PI_2).copysign(x);
    let base = is_steep.select(-side, side - FRAC_PI_2);
    let u = t * t;
    let u2 = u * u;
    let u4 = u2 * u2;
    let mut p = four(16, u, u2);
    for at in [12, 8, 4, 0] {
        p = p.mul_add(u4, four(at, u, u2));
    }
    (base + (t + (t * u).mul_add(p, base * PI_REST_RATIO))).copysign(y_signed)
}

/// Four terms of the arc tangent.
#[inline(always)]
fn four<S: Simd>(at: usize, u: Vector<S>, u2: Vector<S>) -> Vector<S> {
    let high = u.mul_add(ATAN[at + 3], u.like(ATAN[at + 2]));
    high.mul_add(u2, u.mul_add(ATAN[at + 1], u.like(ATAN[at])))
}

/// Sines and cosines of angles of at most [`super::MOST_SIN_COS`] [rad].
#[inline(always)]
pub(crate) fn sin_cos_of<S: Simd>(angle: Vector<S>) -> (Vector<S>, Vector<S>) {
    let [first, second, third] = PI_2_PARTS;
    let sum = angle.mul_add(FRAC_2_PI, angle.like(ROUND));
    let turns = angle.like(ROUND) - sum;
    let a = turns.mul_add(first, angle);
    let b = turns * second;
    let high = a + b;
    let low = turns.mul_add(third, (a - high) + b);
    let z = high * high;
    let z2 = z * z;
    let sin = high + (high * z).mul_add(six(&SIN, z, z2), low);
    let cos = z.mul_add(-0.5, z2.mul_add(six(&COS, z, z2), -(high * low))) + 1.0;
    let quadrant = sum.to_bits();
    let is_odd = (quadrant & 1).simd_eq(1);
    let (s, c) = (is_odd.select(cos, sin), is_odd.select(sin, cos));
    let s = Vector::from_bits(s.to_bits() ^ ((quadrant << 62) & SIGN));
    let c = Vector::from_bits(c.to_bits() ^ (((quadrant + 1) << 62) & SIGN));
    (angle.simd_eq(0.0).select(angle, s), c)
}

#[inline(always)]
fn six<S: Simd>(c: &[f64; 6], z: Vector<S>, z2: Vector<S>) -> Vector<S> {
    let high = z.mul_add(c[5], z.like(c[4])).mul_add(z2, z.mul_add(c[3], z.like(c[2])));
    high.mul_add(z2, z.mul_add(c[1], z.like(c[0])))
}

#[cfg(test)]
mod tests {
    use core::f64::consts::PI;
    use std::vec::Vec;

    use super::super::tests::One;
    use super::*;
    use crate::lanes::{Column, VectorKernel, run, run_on};
    use crate::rng::Rng;
    use crate::sets::on_each_set;

    /// The arc tangents of y and x, and the sines and cosines of y.
    struct All<'a>(&'a [Column; 2]);

    impl VectorKernel for All<'_> {
        type Answer = [Column; 3];

        #[inline(always)]
        fn run<S: Simd>(self, simd: S) -> [Column; 3] {
            let [y, x] = self.0;
            let y = Vector::load_array_ref(simd, y);
            let (sin, cos) = sin_cos_of(y);
            let angle = atan2_of(y, Vector::load_array_ref(simd, x));
            [angle.to_array(), sin.to_array(), cos.to_array()]
        }
    }

    #[test]
    fn vectors_have_the_bits_of_numbers() {
        let mut rng = Rng::new(1);
        let special = [0.0, -0.0, 1.0, -1.0, PI, -PI / 2.0, 1e-300, 1e5];
        let columns: Vec<[Column; 2]> = (0..20_000)
            .map(|round| {
                core::array::from_fn(|_| {
                    core::array::from_fn(|lane| {
                        let size = [1.0, 4.0, 1e-9, 1e4][round % 4];
                        let is_special = rng.unit() < 0.1;
                        if is_special { special[lane] } else { rng.between(-size, size) }
                    })
                })
            })
            .collect();
        on_each_set(|set| {
            for both in &columns {
                let vectors = run_on(set, All(both));
                for (lane, (&y, &x)) in both[0].iter().zip(&both[1]).enumerate() {
                    let bits = |all: [f64; 3]| all.map(f64::to_bits);
                    let numbers = run(One { y, x, angle: y });
                    assert_eq!(
                        bits(vectors.map(|column| column[lane])),
                        bits(numbers),
                        "{set:?} {y:e} {x:e}"
                    );
                }
            }
        });
    }
}
