//! The members of a self-motion where a joint has a given angle.
//!
//! Docs: general.md, eq. 103.

use core::ops::ControlFlow;

use super::configuration::{Configuration, Kind};
use super::member::Member;
use super::self_motion::SelfMotion;
use crate::kinematics::pose::angles::wrap;

/// Angle from which on a joint passes half a turn rather than its place [rad].
const FAR: f64 = 1.0;

/// How near a joint is brought to its angle [rad].
const AT_PLACE: f64 = 1e-14;

/// Steps of the secant method, at most.
const MOST_SECANTS: usize = 8;

impl SelfMotion<'_> {
    /// The member with a joint at its angle of `near`; of several the nearest.
    pub(crate) fn member(&self, joint: usize, near: &[f64; 6]) -> Option<Configuration> {
        let mut nearest = None::<Configuration>;
        self.around(&mut |one, next| {
            let is_nearer = |one: &Configuration| {
                nearest.is_none_or(|other| one.distance(near) < other.distance(near))
            };
            let member = self.member_between([one, next], joint, near);
            nearest = member.filter(is_nearer).or(nearest);
            ControlFlow::Continue(())
        });
        nearest
    }

    /// The member between two of them, ends included, with a joint at its angle of `near`.
    pub(super) fn member_between(
        &self,
        [start, end]: [&Member; 2],
        joint: usize,
        near: &[f64; 6],
    ) -> Option<Configuration> {
        let off = |one: &Member| wrap(one.theta[joint] - near[joint]);
        let starts_there = part_with([start, end], joint, near[joint])? == 0.0;
        let mut member = if starts_there { *start } else { self.where_zero(start, end, off)? };
        // Its last rounding goes, too: who asks for zero gets zero.
        let rounding = off(&member);
        if rounding.abs() <= AT_PLACE {
            member.theta[joint] -= rounding;
        }
        self.closure.accepted(self.target, member.theta, 0.0, Kind::FREE)
    }

    /// The member between two of them where a number of it is zero, by the secant method.
    fn where_zero(
        &self,
        start: &Member,
        end: &Member,
        number: impl Fn(&Member) -> f64,
    ) -> Option<Member> {
        let along = |i: usize| start.direction[i] * (end.theta[i] - start.theta[i]);
        let (mut before, mut last) =
            ((0.0, number(start)), ((0..6).map(along).sum::<f64>(), number(end)));
        let mut member = *end;
        for _ in 0..MOST_SECANTS {
            if last.1.abs() <= AT_PLACE {
                break;
            }
            let s = last.0 - last.1 * (last.0 - before.0) / (last.1 - before.1);
            member = self.closure.member_ahead(self.target, start, s, member.theta)?;
            (before, last) = (last, (s, number(&member)));
        }
        Some(member)
    }
}

/// At which part of the way between two members a joint passes an angle: zero if it starts there.
pub(super) fn part_with([start, end]: [&Member; 2], joint: usize, angle: f64) -> Option<f64> {
    let [here, there] = [start, end].map(|one| wrap(one.theta[joint] - angle));
    if here.abs() <= AT_PLACE {
        return Some(0.0);
    }
    let is_passed = (here < 0.0) != (there < 0.0) && here.abs() + there.abs() < FAR;
    is_passed.then(|| here / (here - there))
}
