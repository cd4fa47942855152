//! The members of a self-motion: which joints move, and where one of them has a given angle.
//!
//! Docs: general.md, eq. 103.

use core::ops::ControlFlow;

use super::accepted::{Accepted, MOST};
use super::chain::{Closure, Target};
use super::configuration::{Configuration, Kind};
use super::member::Member;
use super::self_motion::SelfMotion;
use crate::kinematics::pose::angles::wrap;

/// Angle by which a joint that moves does so on the way [rad].
const MOVES: f64 = 1e-3;

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
            let motion = one.is_free().then(|| closure.self_motions(target, &one.theta).next());
            let Some(motion) = motion.flatten() else {
                self.insert(closure, *one);
                continue;
            };
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
    /// Which joints move: anywhere, for those of two self-motions that nearly cross may stand still
    /// to rounding on a long part of the way.
    fn moving(&self) -> [bool; 6] {
        // Where self-motions cross, a start that is off closes to rounding too: the members behind
        // it count.
        let (mut first, mut most) = (None, [0.0; 6]);
        self.around(&mut |_, next| {
            let from = first.get_or_insert(next.theta);
            for joint in 0..6 {
                most[joint] = (next.theta[joint] - from[joint]).abs().max(most[joint]);
            }
            ControlFlow::Continue(())
        });
        most.map(|most| most > MOVES)
    }

    /// The first member on the way, in either direction, with a joint at its angle of `near`.
    fn first_member(&self, joint: usize, near: &[f64; 6]) -> Option<Configuration> {
        let mut first = None;
        self.around(&mut |one, next| {
            first = self.member_between([one, next], joint, near);
            if first.is_none() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        });
        first
    }

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
    fn member_between(
        &self,
        [start, end]: [&Member; 2],
        joint: usize,
        near: &[f64; 6],
    ) -> Option<Configuration> {
        let away = |one: &Member| wrap(one.theta[joint] - near[joint]);
        let (here, there) = (away(start), away(end));
        if here.abs() <= AT_PLACE {
            return self.configuration(start);
        }
        let is_passed = (here < 0.0) != (there < 0.0) && here.abs() + there.abs() < FAR;
        if is_passed { self.where_zero(start, end, away) } else { None }
    }

    /// The member between two of them where a number of it is zero, by the secant method.
    fn where_zero(
        &self,
        start: &Member,
        end: &Member,
        number: impl Fn(&Member) -> f64,
    ) -> Option<Configuration> {
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
        self.configuration(&member)
    }

    /// A member as a configuration.
    fn configuration(&self, member: &Member) -> Option<Configuration> {
        self.closure.accepted(self.target, member.theta, 0.0, Kind::Free)
    }
}
