//! Descends the valleys of the cost along the curve of self-motion.

use core::ops::ControlFlow::{Break, Continue};

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::Search;
use crate::kinematics::solve::self_motion_curve::Point;
use crate::kinematics::structure::continuum::{Steps, walk};
use crate::kinematics::thresholds::LEAST_CURVE_STEP;

/// Steps along one curve [rad], and rounds that locate the bottom of a valley between two of them.
const STEPS: Steps =
    Steps { first: 0.05, least: LEAST_CURVE_STEP, longest: 0.2, shorter: 0.5, most: 120 };
const ROUNDS: u32 = 40;

impl Search<'_> {
    /// How the cost changes along the curve.
    fn slope(&self, point: &Point) -> f64 {
        (0..7)
            .map(|joint| {
                self.weights[joint] * (point.q[joint] - self.seed[joint]) * point.along[joint]
            })
            .sum()
    }

    /// Descend from a point of the curve and, if the point is outside the limits, also from where
    /// the curve re-enters them.
    pub(super) fn descend(&mut self, start: Point) {
        self.descend_by(start, STEPS.first);
    }

    /// Descend with a first step [rad].
    pub(super) fn descend_by(&mut self, start: Point, first: f64) {
        for edge in self.edges(&start).into_iter().flatten() {
            self.downhill(edge, first);
        }
        self.downhill(start, first);
    }

    /// Where the curve re-enters the limits: one of the joints outside them is at its limit, and
    /// none is outside.
    fn edges(&self, point: &Point) -> [Option<Point>; 7] {
        let limits = self.robot.limits().to_array();
        core::array::from_fn(|joint| {
            let angle = point.q[joint];
            let [low, high] = limits[joint];
            let limit = if angle < low { low } else { high };
            let edge = (self.robot.limits().excess(joint, angle) > 0.0)
                .then(|| self.curve.with_joint_at(&point.q, joint, limit))??;
            (self.outside(&edge.joints()) == 0.0).then_some(edge)
        })
    }

    /// Descend to the bottom of the valley that a point of the curve is in, inside the limits or
    /// not; keep the points inside.
    fn downhill(&mut self, start: Point, first: f64) {
        self.keep(&start.joints());
        walk(start, Steps { first, ..STEPS }, |point, step| {
            let slope = self.slope(point);
            if slope == 0.0 {
                return Some(Break(()));
            }
            let ahead = -step.copysign(slope);
            let next = self.curve.across(&(point.q + ahead * point.along), &point.along);
            let next = next.filter(|next| next.along.dot(&point.along) > 0.5)?;
            if self.joints_outside(&next.joints()) != self.joints_outside(&point.joints()) {
                for end in [point, &next] {
                    self.edges(end).iter().flatten().for_each(|edge| self.keep(&edge.joints()));
                }
            }
            let slope_ahead = self.slope(&next);
            if slope_ahead * slope <= 0.0 {
                self.bottom(point, ahead, [slope, slope_ahead]);
                return Some(Break(()));
            }
            self.keep(&next.joints());
            Some(Continue((next, 2.0)))
        });
    }

    /// Find the bottom of a valley between a point and one ahead of it, with the slopes at both:
    /// the zero of the slope, by false position.
    fn bottom(&mut self, point: &Point, ahead: f64, slopes: [f64; 2]) {
        let curve = self.curve;
        let at = |part: f64| curve.across(&(point.q + part * ahead * point.along), &point.along);
        let (mut low, mut high) = ((0.0, slopes[0]), (1.0, slopes[1]));
        for _ in 0..ROUNDS {
            let part = low.0 - low.1 * (high.0 - low.0) / (high.1 - low.1);
            let Some(middle) = at(part) else { return };
            self.keep(&middle.joints());
            let slope = self.slope(&middle);
            // The cost is a square: the change from a step this small is below rounding.
            if slope == 0.0 || ((part - high.0) * ahead).abs() < LEAST_CURVE_STEP {
                return;
            }
            // An end that is kept twice gets half the weight (Illinois).
            if slope * high.1 < 0.0 {
                low = high;
            } else {
                low.1 *= 0.5;
            }
            high = (part, slope);
        }
    }
}
