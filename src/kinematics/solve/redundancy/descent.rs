//! Descends the valleys of the cost along the curve of self-motion.

use core::ops::ControlFlow::{Break, Continue};

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::Search;
use super::samples::Sample;
use crate::kinematics::solve::self_motion_curve::{Joints, Point};
use crate::kinematics::structure::continuum::{Steps, walk};
use crate::kinematics::thresholds::LEAST_CURVE_STEP;

/// Steps along one curve [rad].
pub(super) const STEPS: Steps =
    Steps { first: 0.2, least: LEAST_CURVE_STEP, longest: 0.2, shorter: 0.5, most: 120 };

/// The last step of Newton's method to the bottom of a valley [rad]: what it leaves is rounding.
const AT_BOTTOM: f64 = 1e-7;

impl Search<'_> {
    /// The step along the tangent to the bottom of the valley, as its slope and its bend are here;
    /// a step of length `most` where these do not tell.
    fn step_down(&self, point: &Point, most: f64) -> f64 {
        let weights = Joints::from(self.weights);
        let force = (point.q - Joints::from(self.seed)).component_mul(&weights);
        let slope = force.dot(&point.along);
        let of_tangent = weights.dot(&point.along.component_mul(&point.along));
        let steepens = of_tangent + force.dot(&point.bend);
        if slope.abs() < most * steepens { -slope / steepens } else { -most.copysign(slope) }
    }

    /// Descend from a point of the curve, with a first step [rad], and, if the point is outside the
    /// limits, also from where the curve re-enters them.
    pub(super) fn descend(&mut self, start: Point, first: f64) {
        for edge in self.edges(&start).into_iter().flatten() {
            self.downhill(edge, first);
        }
        self.downhill(start, first);
    }

    /// Descend from a sample. From one outside the limits, look where the curve re-enters them: the
    /// valley behind is a neighbor's, unless both neighbors are outside, or slots are ordinals, so
    /// that a neighbor may be of another branch.
    pub(super) fn descend_from(&mut self, sample: &Sample, neighbors: [Option<&Sample>; 2]) {
        let mut near = neighbors.into_iter().flatten();
        let is_inside_near = self.are_named && near.any(|other| other.outside == 0.0);
        let Some(start) = self.curve.nearest(&Joints::from(sample.q)) else { return };
        if sample.outside == 0.0 {
            return self.downhill(start, STEPS.first);
        }
        for edge in self.edges(&start).into_iter().flatten() {
            self.keep(&edge.joints());
            if !is_inside_near {
                self.downhill(edge, STEPS.first);
            }
        }
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
        walk(start, Steps { first, ..STEPS }, |point, most| {
            let ahead = self.step_down(point, most);
            let on_parabola = point.q + ahead * (point.along + 0.5 * ahead * point.bend);
            let next = self.curve.across(&on_parabola, &point.along);
            let next = next.filter(|next| next.along.dot(&point.along) > 0.5)?;
            if self.joints_outside(&next.joints()) != self.joints_outside(&point.joints()) {
                for end in [point, &next] {
                    self.edges(end).iter().flatten().for_each(|edge| self.keep(&edge.joints()));
                }
            }
            self.keep(&next.joints());
            if ahead.abs() <= AT_BOTTOM {
                return Some(Break(()));
            }
            let is_lower = self.cost(&next.joints()) < self.cost(&point.joints());
            is_lower.then_some(Continue((next, 2.0)))
        });
    }
}
