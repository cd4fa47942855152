//! The hand of an arm with an offset wrist: wrist point and axis 5, as they turn with joint 6.
//!
//! Docs: offset_wrist.md, eq. 121. Branch-free arithmetic, which runs in lanes.

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use super::geometry::Lengths;
use crate::kinematics::structure::end_frames::Frame;
use crate::lanes::Number;

/// Wrist point and direction of axis 5, as they turn with joint 6: constant parts, factors of its
/// cosine and factors of its sine (eq. 121).
#[derive(Clone, Copy, Debug)]
pub(super) struct Hand<T = f64> {
    point: [[T; 3]; 3],
    axis_5: [[T; 3]; 3],
}

/// Wrist point and direction of axis 5 at an angle of joint 6, and their derivatives by it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moving<T> {
    pub(super) at: ([T; 3], [T; 3]),
    pub(super) rates: ([T; 3], [T; 3]),
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

    /// Wrist point and direction of axis 5 for joint 6.
    #[inline(always)]
    pub(super) fn at(&self, [sin, cos]: [T; 2]) -> ([T; 3], [T; 3]) {
        (turned(&self.point, sin, cos), turned(&self.axis_5, sin, cos))
    }

    /// Return both, and how they change with joint 6.
    #[inline(always)]
    pub(super) fn moving(&self, [sin, cos]: [T; 2]) -> Moving<T> {
        let rates = (rate(&self.point, sin, cos), rate(&self.axis_5, sin, cos));
        Moving { at: self.at([sin, cos]), rates }
    }
}

impl Hand {
    /// The middle of the circle of the wrist point.
    #[inline(always)]
    pub(super) fn middle(&self) -> [f64; 3] {
        self.point[0]
    }

    /// Half of the height of that circle along axis 1.
    #[inline(always)]
    pub(super) fn half_height(&self) -> f64 {
        self.point[1][2].hypot(self.point[2][2])
    }

    /// Broadcast to the lanes of a number.
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
