//! The members of a self-motion: which joints move, and where one of them has a given angle.
//!
//! Docs: general.md, eq. 103.

use core::ops::ControlFlow;

use super::accepted::{Accepted, Configuration, Kind, MOST};
use super::chain::{Closure, Target};
use super::self_motion::{STEP, SelfMotion};
use crate::kinematics::pose::angles::wrap;

/// Part of a step along a self-motion from which on a joint moves [1].
const MOVES: f64 = 1e-4;

/// Angle from which on a joint passes half a turn rather than its place [rad].
const FAR: f64 = 1.0;

/// How near a joint is brought to its angle [rad].
const AT_PLACE: f64 = 1e-14;

/// Steps of the secant method, at most.
const MOST_SECANTS: usize = 8;

impl Accepted {
    /// Bring self-motions to a member whose first joint that moves has its angle of `near`, if they
    /// have one; what then is the same stands once. Returns which joints move in each.
    pub(crate) fn bring_to(
        &mut self,
        closure: &Closure,
        target: &Target,
        near: &[f64; 6],
    ) -> [[bool; 6]; MOST] {
        let brought = self.emptied();
        let mut moving = [[false; 6]; MOST];
        for one in brought.as_slice() {
            let Kind::Free { direction } = one.kind else {
                self.insert(closure, *one);
                continue;
            };
            let motion = SelfMotion { closure, target, start: one.theta, direction };
            let moves = motion.moving();
            let first = moves.iter().position(|moves| *moves);
            let member = first.and_then(|first| motion.first_member(first, near));
            let count = self.as_slice().len();
            self.insert(closure, member.unwrap_or(*one));
            if self.as_slice().len() > count {
                moving[count] = moves;
            }
        }
        moving
    }
}

impl SelfMotion<'_> {
    /// Which joints move: the curve is analytic, so that what moves does so in any part of it.
    fn moving(&self) -> [bool; 6] {
        let next = self.closure.advanced(self.target, &self.start, &self.direction);
        core::array::from_fn(|joint| {
            let step = next.map_or(0.0, |(next, _)| next[joint] - self.start[joint]);
            step.abs().max(STEP * self.direction[joint].abs()) > MOVES * STEP
        })
    }

    /// The first member on the way, in either direction, with a joint at its angle of `near`.
    fn first_member(&self, joint: usize, near: &[f64; 6]) -> Option<Configuration> {
        let mut first = None;
        self.around(|theta, next| {
            first = self.closure.member_between(self.target, [theta, next], joint, near);
            if first.is_none() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        });
        first
    }

    /// The member with a joint at its angle of `near`; of several the nearest.
    pub(crate) fn member(&self, joint: usize, near: &[f64; 6]) -> Option<Configuration> {
        let mut nearest = None::<Configuration>;
        self.around(|theta, next| {
            let is_nearer = |one: &Configuration| {
                nearest.is_none_or(|other| one.distance(near) < other.distance(near))
            };
            let one = self.closure.member_between(self.target, [theta, next], joint, near);
            nearest = one.filter(is_nearer).or(nearest);
            ControlFlow::Continue(())
        });
        nearest
    }
}

impl Closure {
    /// The member between two of them, ends included, with a joint at its angle of `near`.
    fn member_between(
        &self,
        target: &Target,
        [start, end]: [&[f64; 6]; 2],
        joint: usize,
        near: &[f64; 6],
    ) -> Option<Configuration> {
        let away = |theta: &[f64; 6]| wrap(theta[joint] - near[joint]);
        let (here, there) = (away(start), away(end));
        if here.abs() <= AT_PLACE {
            return self.with_kind(target, start);
        }
        let is_passed = (here < 0.0) != (there < 0.0) && here.abs() + there.abs() < FAR;
        if is_passed { self.where_zero(target, start, end, away) } else { None }
    }

    /// The member between two of them where a number of it is zero, by the secant method.
    fn where_zero(
        &self,
        target: &Target,
        start: &[f64; 6],
        end: &[f64; 6],
        number: impl Fn(&[f64; 6]) -> f64,
    ) -> Option<Configuration> {
        let curve = self.curve(target, start)?;
        let s_end = (0..6).map(|i| curve.v[i] * (end[i] - start[i])).sum();
        let (mut before, mut last) = ((0.0, number(start)), (s_end, number(end)));
        let mut theta = *end;
        for _ in 0..MOST_SECANTS {
            if last.1.abs() <= AT_PLACE {
                break;
            }
            let s = last.0 - last.1 * (last.0 - before.0) / (last.1 - before.1);
            theta = curve.at(s, &theta)?.theta;
            (before, last) = (last, (s, number(&theta)));
        }
        self.with_kind(target, &theta)
    }

    /// A member of a self-motion as a configuration.
    fn with_kind(&self, target: &Target, theta: &[f64; 6]) -> Option<Configuration> {
        let there = self.curve(target, theta)?;
        self.accepted(target, *theta, there.least, Kind::Free { direction: there.v.into() })
    }
}
