//! Angles: wrapping, the sines and cosines of constants, angles of rotations and between vectors.

use core::f64::consts::{FRAC_PI_2, PI, TAU};

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};
use nalgebra::{Rotation3, Vector3};

use super::rotation::quaternion;
use crate::lanes::nearest_whole;

/// How far a constant may be from a quarter turn and still be one [rad]: the rounding of
/// `90_f64.to_radians()` and of sums of it.
const QUARTER_TURN_ROUNDING: f64 = 4e-15;

/// Wrap an angle into (-pi, pi] [rad].
#[must_use]
#[inline(always)]
pub(crate) fn wrap(angle: f64) -> f64 {
    let turns = nearest_whole(angle * (1.0 / TAU));
    let wrapped = angle - TAU * turns;
    let wrapped = if wrapped <= -PI { wrapped + TAU } else { wrapped };
    if wrapped > PI { wrapped - TAU } else { wrapped }
}

/// The 2 pi equivalent of an angle that is nearest to another one [rad].
#[must_use]
#[inline(always)]
pub fn nearest_turn(angle: f64, near: f64) -> f64 {
    angle + TAU * nearest_whole((near - angle) / TAU)
}

/// 1, or -1 below zero.
#[must_use]
pub(crate) fn sign_of(value: f64) -> f64 {
    if value < 0.0 { -1.0 } else { 1.0 }
}

/// Distance of an angle from the nearest multiple of pi [rad], in 0 ..= pi / 2.
#[must_use]
pub(crate) fn distance_from_half_turns(angle: f64) -> f64 {
    (angle - PI * (angle / PI).round()).abs()
}

/// Sine and cosine of a model constant: exact (0, 1, -1) for a quarter turn, so that right angles
/// of an arm stay right angles.
#[doc(hidden)]
pub fn constant_sin_cos(angle: f64) -> (f64, f64) {
    let quarters = (angle / FRAC_PI_2).round();
    if (angle - quarters * FRAC_PI_2).abs() > QUARTER_TURN_ROUNDING {
        return angle.sin_cos();
    }
    match quarters - 4.0 * (quarters / 4.0).floor() {
        0.0 => (0.0, 1.0),
        1.0 => (1.0, 0.0),
        2.0 => (0.0, -1.0),
        _ => (-1.0, 0.0),
    }
}

/// The multiple of 90 deg within `snap` of an angle [rad], or the angle.
#[must_use]
pub fn snapped(angle: f64, snap: f64) -> f64 {
    let nearest = (angle / FRAC_PI_2).round() * FRAC_PI_2;
    if (angle - nearest).abs() <= snap { nearest } else { angle }
}

/// The rotation vector of a rotation [rad], of length 0 to pi; exact to rounding at both ends, where
/// the trace that nalgebra's `scaled_axis` takes the arc cosine of has none or half of the digits.
pub fn rotation_vector(rotation: &Rotation3<f64>) -> Vector3<f64> {
    let [w, x, y, z] = quaternion(rotation);
    let vector = Vector3::new(x, y, z);
    let sin = vector.norm();
    // w is not negative: below this sine the angle is twice the sine.
    if sin < f64::MIN_POSITIVE { vector * 2.0 } else { vector * (2.0 * sin.atan2(w) / sin) }
}

/// The angle between two vectors [rad], 0 to pi, exact to rounding at both ends.
#[doc(hidden)]
pub fn angle_between(a: &Vector3<f64>, b: &Vector3<f64>) -> f64 {
    a.cross(b).norm().atan2(a.dot(b))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Rng;

    #[test]
    fn wrap_keeps_plus_pi_and_turns_minus_pi() {
        assert_eq!(wrap(PI), PI);
        assert_eq!(wrap(-PI), PI);
        assert_eq!(wrap(0.25), 0.25);
        assert!((wrap(7.0) - (7.0 - TAU)).abs() < 1e-15);
        assert!((wrap(-100.0) - (-100.0 + 16.0 * TAU)).abs() < 1e-13);
    }

    #[test]
    fn quarter_turns_are_exact() {
        for quarter in -8_i32..=8 {
            let (sin, cos) = constant_sin_cos((f64::from(quarter) * 90.0).to_radians());
            let expected = [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)]
                [usize::try_from(quarter.rem_euclid(4)).unwrap()];
            assert_eq!((sin, cos), expected, "{quarter} quarters");
        }
        assert_eq!(constant_sin_cos(0.3), 0.3_f64.sin_cos());
    }

    #[test]
    fn an_angle_is_snapped_within_the_bound_and_unchanged_beyond() {
        for quarters in -8..=8 {
            let exact = f64::from(quarters) * FRAC_PI_2;
            for (snap, off) in [(1e-5, 0.99e-5), (1e-5, -3.7e-6), (1e-3, 0.9e-3), (0.0, 0.0)] {
                assert_eq!(snapped(exact + off, snap), exact);
            }
            for (snap, off) in [(1e-5, 1.01e-5), (0.0, 1e-9), (1e-3, -1.1e-3), (1e-3, 0.5)] {
                assert_eq!(snapped(exact + off, snap), exact + off);
            }
        }
        assert!(snapped(f64::NAN, 1e-3).is_nan() && snapped(f64::INFINITY, 1e-3).is_infinite());
    }

    #[test]
    fn half_turn_distance_is_even_and_periodic() {
        assert!((distance_from_half_turns(PI - 0.1) - 0.1).abs() < 1e-15);
        assert!((distance_from_half_turns(-0.1) - 0.1).abs() < 1e-15);
        assert!((distance_from_half_turns(2.0 * PI + 0.2) - 0.2).abs() < 1e-15);
    }

    #[test]
    fn rotation_vectors_are_exact_from_no_turn_to_a_half_turn() {
        let mut rng = Rng::new(41);
        for size in [0.0, 1e-300, 1e-16, 1e-9, 1e-4, 1.0, 3.0, PI - 1e-4, PI - 1e-9, PI - 1e-16] {
            for _ in 0..200 {
                let axis = Vector3::from_fn(|_, _| rng.between(-1.0, 1.0)).normalize();
                let found = rotation_vector(&Rotation3::new(axis * size));
                // Of a half turn either direction of the axis is right.
                let is_half = (PI - size).abs() < f64::EPSILON;
                let sign = if is_half { axis.dot(&found).signum() } else { 1.0 };
                let off = (found * sign - axis * size).norm();
                assert!(off <= 16.0 * f64::EPSILON, "{size} {axis} {found}");
            }
        }
    }

    #[test]
    fn a_rotation_next_to_none_has_a_vector_for_any_rounding() {
        let mut rng = Rng::new(42);
        for _ in 0..2000 {
            let vector = Vector3::from_fn(|_, _| rng.between(-PI, PI));
            let rotation = Rotation3::new(vector);
            let none = rotation.inverse() * rotation;
            assert!(rotation_vector(&none).norm() <= 4.0 * f64::EPSILON);
        }
    }
}
