//! Self-motions: one configuration stands for each.

use core::ops::ControlFlow;

use nalgebra::SVector;

use super::accepted::{Accepted, Configuration, Kind};
use super::chain::{Closure, Target};
use super::members::SelfMotion;
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
                let motion = SelfMotion { closure, target, start: one.theta, direction };
                motion.around(|theta, next| {
                    self.remove_between(&motion, &one, [theta, next]);
                    ControlFlow::Continue(())
                });
            }
            // It is kept, though earlier ones may have been removed.
            index = self.as_slice().iter().position(|kept| *kept == one).map_or(index, |at| at + 1);
        }
    }

    /// Remove what is on a self-motion near the end of a step, but for the one that is kept.
    fn remove_between(
        &mut self,
        motion: &SelfMotion<'_>,
        kept: &Configuration,
        step: [&[f64; 6]; 2],
    ) {
        let mut other = 0;
        while other < self.as_slice().len() {
            let one = self.as_slice()[other];
            let is_met = one != *kept
                && one.kind != Kind::Regular
                && one.distance(step[1]) < ON_CURVE
                && motion.closure.is_on_curve(motion.target, step, &one.theta);
            if is_met {
                self.remove(other);
            } else {
                other += 1;
            }
        }
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
        Some((next, ahead(theta, &next)))
    }

    /// Whether a configuration near the end of a step along a self-motion is on it.
    fn is_on_curve(
        &self,
        target: &Target,
        [before, point]: [&[f64; 6]; 2],
        theta: &[f64; 6],
    ) -> bool {
        let Some(curve) = self.curve(target, point) else { return false };
        let way = ahead(before, point);
        let apart: [f64; 6] = core::array::from_fn(|i| wrap(theta[i] - point[i]));
        let s: f64 = (0..6).map(|i| curve.v[i] * apart[i]).sum();
        let guess = core::array::from_fn(|i| point[i] + s * way[i]);
        let is_same =
            |on_curve: [f64; 6]| (0..6).all(|i| wrap(theta[i] - on_curve[i]).abs() < 1e-5);
        curve.at(s, &guess).is_some_and(|on_curve| is_same(on_curve.theta))
    }
}

/// The direction of a step.
fn ahead(from: &[f64; 6], to: &[f64; 6]) -> [f64; 6] {
    SVector::<f64, 6>::from_fn(|i, _| to[i] - from[i]).normalize().into()
}
