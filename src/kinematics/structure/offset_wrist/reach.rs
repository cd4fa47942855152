//! How far a pose is out of reach.

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use super::geometry::OffsetWrist;
use super::resultant::Hand;
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::trigonometric::{SAMPLE_COS, SAMPLE_SIN};
use crate::report::Reach;

impl OffsetWrist {
    /// How far the circle of the wrist point is from where upper arm and forearm bring it (eq. 65).
    pub(super) fn missed(&self, last: &Frame) -> Reach {
        let hand = Hand::of::<false>(&self.lengths, last);
        let angles = SAMPLE_SIN.as_flattened().iter().zip(SAMPLE_COS.as_flattened());
        let missed = angles
            .map(|(sin, cos)| self.missed_by(&hand, [*sin, *cos]))
            .fold(Reach::TooFar { shortfall: f64::INFINITY }, Reach::nearer);
        if missed.shortfall() > 0.0 { missed } else { Reach::NoRoots }
    }

    /// How far the wrist point is from there, for an angle of joint 6.
    fn missed_by(&self, hand: &Hand, sin_cos_6: [f64; 2]) -> Reach {
        let lengths = &self.lengths;
        let ([x, y, z], _) = hand.at::<false>(sin_cos_6);
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
