//! Self-motions: the walk along one, and the one configuration that stands for it.

use core::ops::ControlFlow;

use nalgebra::SVector;

use super::accepted::{Accepted, Configuration, Kind};
use super::chain::{Closure, Target};
use crate::kinematics::pose::angles::wrap;

/// Step along a self-motion [rad].
pub(super) const STEP: f64 = 0.1;

/// Steps along a self-motion, at most: four turns of its fastest joint.
const MOST_STEPS: usize = 400;

/// How far a configuration of the self-motion may be from its points [rad]: half of a step, and
/// what the curve bends in it.
const ON_CURVE: f64 = 0.07;

/// A self-motion.
pub(crate) struct SelfMotion<'a> {
    pub(super) closure: &'a Closure,
    pub(super) target: &'a Target,
    /// A member of it, and by how much each joint moves there.
    pub(super) start: [f64; 6],
    pub(super) direction: [f64; 6],
}

impl SelfMotion<'_> {
    /// Walk along it in both directions, or once around, until `pass` breaks off: it gets the ends
    /// of each step.
    pub(crate) fn around(&self, mut pass: impl FnMut(&[f64; 6], &[f64; 6]) -> ControlFlow<()>) {
        let Self { closure, target, start, direction } = self;
        let apart = |theta: &[f64; 6]| {
            theta.iter().zip(start).fold(0.0, |most: f64, (a, b)| most.max(wrap(a - b).abs()))
        };
        for way in [*direction, direction.map(|part| -part)] {
            let (mut theta, mut way) = (*start, way);
            let mut is_back = false;
            for step in 0..MOST_STEPS {
                let Some((next, ahead)) = closure.advanced(target, &theta, &way) else { break };
                // One step more than around, which passes the start.
                if pass(&theta, &next).is_break() || is_back {
                    return;
                }
                is_back = step > 2 && apart(&next) < 0.6 * STEP;
                (theta, way) = (next, ahead);
            }
        }
    }
}

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
                    self.remove_met(&motion, &one, [theta, next]);
                    ControlFlow::Continue(())
                });
            }
            // It is kept, though earlier ones may have been removed.
            index = self.as_slice().iter().position(|kept| *kept == one).map_or(index, |at| at + 1);
        }
    }

    /// Remove what is on a self-motion near the end of a step, but for the one that is kept.
    fn remove_met(&mut self, motion: &SelfMotion<'_>, kept: &Configuration, step: [&[f64; 6]; 2]) {
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
    /// The self-motion through a configuration.
    pub(crate) fn self_motion<'a>(
        &'a self,
        target: &'a Target,
        theta: &[f64; 6],
    ) -> Option<SelfMotion<'a>> {
        let direction = self.curve(target, theta)?.v.into();
        Some(SelfMotion { closure: self, target, start: *theta, direction })
    }

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
