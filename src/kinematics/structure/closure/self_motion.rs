//! Self-motions: one configuration stands for each.

use nalgebra::SVector;

use super::accepted::{Accepted, Configuration, Kind};
use super::chain::{Closure, Target};
use crate::kinematics::pose::angles::wrap;

/// Step along a self-motion [rad].
pub(super) const STEP: f64 = 0.1;

/// Steps along a self-motion, at most: four turns of its fastest joint.
pub(super) const MOST_STEPS: usize = 400;

/// How far a configuration of the self-motion may be from its points [rad]: half of a step, and
/// what the curve bends in it.
const ON_CURVE: f64 = 0.07;

impl Accepted {
    /// Keep the first configuration of each self-motion. What a self-motion passes through is one
    /// of its own.
    pub(crate) fn thin(&mut self, closure: &Closure, target: &Target) {
        let mut index = 0;
        while index < self.as_slice().len() {
            let one = self.as_slice()[index];
            if let Kind::Free { direction } = one.kind
                && self.as_slice().len() > 1
            {
                for way in [direction, direction.map(|part| -part)] {
                    let is_closed = self.thin_along(closure, target, index, &one, way);
                    if is_closed {
                        break;
                    }
                }
            }
            index += 1;
        }
    }

    /// Remove what is on the self-motion of a configuration in one direction; whether it returned
    /// to its start.
    fn thin_along(
        &mut self,
        closure: &Closure,
        target: &Target,
        index: usize,
        start: &Configuration,
        mut way: [f64; 6],
    ) -> bool {
        let mut theta = start.theta;
        for step in 0..MOST_STEPS {
            let Some((next, ahead)) = closure.advanced(target, &theta, &way) else { return false };
            (theta, way) = (next, ahead);
            let mut other = 0;
            while other < self.as_slice().len() {
                let one = self.as_slice()[other];
                let is_met = other != index
                    && one.kind != Kind::Regular
                    && one.distance(&theta) < ON_CURVE
                    && closure.is_on_curve(target, &theta, &way, &one.theta);
                if is_met {
                    self.remove(other);
                    if other < index {
                        return false;
                    }
                } else {
                    other += 1;
                }
            }
            if step > 2 && start.distance(&theta) < 0.6 * STEP {
                return true;
            }
        }
        false
    }
}

impl Closure {
    /// A step ahead on a self-motion, and its direction there.
    pub(super) fn advanced(
        &self,
        target: &Target,
        theta: &[f64; 6],
        way: &[f64; 6],
    ) -> Option<([f64; 6], [f64; 6])> {
        let guess = core::array::from_fn(|i| theta[i] + STEP * way[i]);
        let curve = self.curve(target, theta)?;
        let forward: f64 = (0..6).map(|i| curve.v[i] * way[i]).sum();
        let next = curve.at(STEP.copysign(forward), &guess)?;
        if next.left.abs() > self.accepts() {
            return None;
        }
        let next = next.theta;
        let ahead = SVector::<f64, 6>::from_fn(|i, _| next[i] - theta[i]).normalize();
        Some((next, ahead.into()))
    }

    /// Whether a configuration near a point of a self-motion is on it.
    fn is_on_curve(
        &self,
        target: &Target,
        point: &[f64; 6],
        way: &[f64; 6],
        theta: &[f64; 6],
    ) -> bool {
        let Some(curve) = self.curve(target, point) else { return false };
        let apart: [f64; 6] = core::array::from_fn(|i| wrap(theta[i] - point[i]));
        let s: f64 = (0..6).map(|i| curve.v[i] * apart[i]).sum();
        let guess = core::array::from_fn(|i| point[i] + s * way[i]);
        let is_same =
            |on_curve: [f64; 6]| (0..6).all(|i| wrap(theta[i] - on_curve[i]).abs() < 1e-5);
        curve.at(s, &guess).is_some_and(|on_curve| is_same(on_curve.theta))
    }
}
