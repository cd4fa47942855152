//! Axis 5 parallel to axes 2 and 3: roots of the resultant that noise does not separate.
//!
//! Docs: offset_wrist.md, eq. 137.

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::geometry::Lengths;
use super::hand::Hand;
use crate::kinematics::pose::angles::wrap;
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::trigonometric::Root;

/// Half the width of the cluster of roots [rad]: at its ends the resultant is above its noise.
const RADIUS: f64 = 2e-3;

/// How far the wrist point may be along a horizontal axis 5 for the roots to be in the cluster,
/// relative to the lengths of the arm [1].
const NEAR: f64 = 3e-4;

/// Distance of two clusters that are apart [rad]: more than an arc.
const APART: f64 = 0.5;

impl Lengths {
    /// Whether the roots where axis 5 is parallel to axes 2 and 3 are a cluster. In the square case
    /// they are a double root.
    pub(super) fn has_parallel(&self) -> bool {
        self.vanishes() && !self.is_square
    }

    /// Whether axis 5 is parallel to axes 2 and 3 at a pose of frame 6, or nearly so.
    pub(super) fn is_parallel_at(&self, last: &Frame) -> bool {
        self.vanishes() && Parallel::of(self, &Hand::of(self, last)).count > 0
    }

    /// Whether the condition of axis 5 vanishes where it is parallel to axes 2 and 3, whichever
    /// side of the shoulder.
    fn vanishes(&self) -> bool {
        [self.cos_3, self.cos_4, self.b].iter().all(|term| *term == 0.0)
    }
}

/// Clusters where axis 5 is parallel to axes 2 and 3, or nearly so.
pub(super) struct Parallel {
    clusters: [Root; 2],
    count: usize,
}

impl Parallel {
    pub(super) const NONE: Self = Self { clusters: [Root::NONE; 2], count: 0 };

    /// The angles of joint 6 at which axis 5 is horizontal and the wrist point is perpendicular to
    /// it.
    pub(super) fn of(lengths: &Lengths, hand: &Hand) -> Self {
        let mut found = Self::NONE;
        let [constant, of_cos, of_sin] = hand.rise_of_axis_5();
        let square = of_cos * of_cos + of_sin * of_sin;
        let rest = square - constant * constant;
        if rest <= 0.0 {
            return found;
        }
        for across in [rest.sqrt(), -rest.sqrt()] {
            let cos = (-constant * of_cos - across * of_sin) / square;
            let sin = (-constant * of_sin + across * of_cos) / square;
            let ([x, y, _], [zx, zy, _]) = hand.at([sin, cos]);
            if (x * zx + y * zy).abs() < NEAR * lengths.extent {
                found.clusters[found.count] = Root::cluster(sin.atan2(cos), RADIUS);
                found.count += 1;
            }
        }
        let [one, other] = &found.clusters;
        let are_apart = wrap(one.angle() - other.angle()).abs() > APART;
        if found.count == 2 && !are_apart { Self::NONE } else { found }
    }

    pub(super) fn as_slice(&self) -> &[Root] {
        &self.clusters[..self.count]
    }
}
