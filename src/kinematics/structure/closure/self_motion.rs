//! Self-motions: the walk along one.
//!
//! Docs: general.md, eq. 103.

use core::ops::ControlFlow;

use nalgebra::SVector;

use super::chain::{Closure, Target};
use super::member::{Member, interpolated};
use crate::kinematics::pose::angles::wrap;

/// Step along a self-motion [rad], and the least where it bends.
pub(super) const STEP: f64 = 0.2;
const LEAST_STEP: f64 = STEP / 512.0;

/// How far from where it is foreseen a member may be, as a part of the step [1]: farther away it is
/// one of another self-motion, which nearly crosses this one, or the way bends sharply.
const FORESEEN: f64 = 0.05;

/// Steps along a self-motion, at most: eight turns of its fastest joint.
const MOST_STEPS: usize = 400;

/// How far a configuration of the self-motion may be from the polynomial between two members [rad].
const ON_CURVE: f64 = 0.02;

/// How far it may be from the place of the self-motion that is found for it [rad].
const ON_MOTION: f64 = 1e-5;

/// How far from there it may be if the chain closes between the two, too [rad]: where self-motions
/// cross or nearly do, the closure is below its rounding as far as the root of that.
const SAME_IF_JOINED: f64 = 2e-3;

/// How far beyond the ends of a step it may be, as a part of it [1].
const BEYOND: f64 = 0.05;

/// A self-motion.
pub(crate) struct SelfMotion<'a> {
    pub(super) closure: &'a Closure,
    pub(super) target: &'a Target,
    pub(super) start: Member,
}

impl SelfMotion<'_> {
    /// Walk along it in both directions, or once around, until `pass` breaks off: it gets the ends
    /// of each step.
    pub(crate) fn around(&self, pass: &mut dyn FnMut(&Member, &Member) -> ControlFlow<()>) {
        let Self { closure, target, start: Member { theta, direction } } = *self;
        let apart = |other: &[f64; 6]| {
            theta.iter().zip(other).fold(0.0, |most: f64, (a, b)| most.max(wrap(a - b).abs()))
        };
        for direction in [direction, direction.map(|part| -part)] {
            let mut one = Member { theta, direction };
            // The change of the direction along the way.
            let mut bend = [0.0; 6];
            let (mut length, mut walked, mut is_back) = (STEP, 0.0, false);
            for _ in 0..MOST_STEPS {
                let guess = core::array::from_fn(|i| {
                    one.theta[i] + length * (one.direction[i] + 0.5 * length * bend[i])
                });
                let next = closure.member_ahead(target, &one, length, guess);
                let is_near = |next: &Member| next.is_within(FORESEEN * length, &guess);
                // A crossing that is nearer than the least step is passed straight on.
                let Some(next) = next.filter(|next| length == LEAST_STEP || is_near(next)) else {
                    if length == LEAST_STEP {
                        break;
                    }
                    length = (0.5 * length).max(LEAST_STEP);
                    continue;
                };
                // One step more than around, which passes the start.
                if pass(&one, &next).is_break() || is_back {
                    return;
                }
                walked += length;
                is_back = walked > 3.5 * STEP && apart(&next.theta) < 0.6 * STEP;
                bend = core::array::from_fn(|i| (next.direction[i] - one.direction[i]) / length);
                (one, length) = (next, (2.0 * length).min(STEP));
            }
        }
    }

    /// Whether a configuration is on the way between two members.
    pub(super) fn passes(&self, ends: [&Member; 2], theta: &[f64; 6]) -> bool {
        let [one, next] = ends.map(|end| SVector::from(end.theta));
        let place = one.zip_map(&SVector::from(*theta), |one, angle| one + wrap(angle - one));
        let chord = next - one;
        let part = (place - one).dot(&chord) / chord.norm_squared();
        // What is next to an end counts for both steps.
        if !(-BEYOND..=1.0 + BEYOND).contains(&part) {
            return false;
        }
        let between = interpolated(ends, part);
        let off = (place - between).amax();
        off < ON_MOTION
            || off < ON_CURVE && {
                let s = SVector::from(ends[0].direction).dot(&(between - one));
                let member = self.closure.member_ahead(self.target, ends[0], s, between.into());
                member.is_some_and(|member| {
                    let apart = place - SVector::from(member.theta);
                    apart.amax() < ON_MOTION
                        || apart.amax() < SAME_IF_JOINED && self.is_flat(&member, &apart)
                })
            }
    }

    /// Whether the chain closes half of a way from a member, too.
    fn is_flat(&self, member: &Member, way: &SVector<f64, 6>) -> bool {
        let Member { theta, .. } = *member;
        let from = Member { theta, direction: way.normalize().into() };
        let middle = SVector::from(theta) + way * 0.5;
        let half = self.closure.member_ahead(self.target, &from, 0.5 * way.norm(), middle.into());
        half.is_some_and(|half| (SVector::from(half.theta) - middle).norm() < 0.25 * way.norm())
    }
}
