//! How far a pose is out of reach.
#![expect(clippy::cast_precision_loss, reason = "a few angles")]

use core::f64::consts::TAU;

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use super::geometry::Constants;
use super::hand::Hand;
use crate::kinematics::structure::end_frames::Frame;
use crate::lanes::sin_cos;
use crate::report::Reach;

/// Angles of joint 6 at which the distance is taken first.
const ANGLES: usize = 24;

/// Steps by which the least distance is then narrowed: each takes a third of the interval.
const NARROWINGS: usize = 40;

impl Constants {
    /// How far the circle of the wrist point is from where upper arm and forearm bring it (eq.
    /// 135).
    #[cold]
    pub(super) fn missed(&self, last: &Frame) -> Reach {
        let hand = Hand::of(&self.lengths, last);
        let at = |angle: f64| {
            let (sin, cos) = sin_cos::<false>(angle);
            self.missed_by(&hand, [sin, cos])
        };
        let step = TAU / ANGLES as f64;
        let (mut best, mut least) = (0.0, f64::INFINITY);
        for number in 0..ANGLES {
            let angle = step * number as f64;
            let shortfall = at(angle).shortfall();
            (best, least) = if shortfall < least { (angle, shortfall) } else { (best, least) };
        }
        let (mut low, mut high) = (best - step, best + step);
        for _ in 0..NARROWINGS {
            let third = (high - low) / 3.0;
            if at(low + third).shortfall() < at(high - third).shortfall() {
                high -= third;
            } else {
                low += third;
            }
        }
        let missed = at(0.5 * (low + high)).nearer(at(best));
        if missed.shortfall() > 0.0 { missed } else { Reach::NoRoots }
    }

    /// How far the wrist point is from there, for an angle of joint 6.
    fn missed_by(&self, hand: &Hand, sin_cos_6: [f64; 2]) -> Reach {
        let lengths = &self.lengths;
        let ([x, y, z], _) = hand.at(sin_cos_6);
        let r = x.hypot(y);
        if r < lengths.b.abs() {
            return Reach::TooNear { shortfall: lengths.b.abs() - r };
        }
        let sigma = ((r - lengths.b) * (r + lengths.b)).sqrt();
        let (longest, shortest) =
            (lengths.upper.abs() + lengths.forearm, (lengths.upper.abs() - lengths.forearm).abs());
        let miss = |sigma: f64| {
            let distance = (sigma - lengths.a1).hypot(z);
            if distance > longest {
                Reach::TooFar { shortfall: distance - longest }
            } else {
                Reach::TooNear { shortfall: (shortest - distance).max(0.0) }
            }
        };
        miss(sigma).nearer(miss(-sigma))
    }
}
