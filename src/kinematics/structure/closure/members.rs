//! The members of a self-motion: which joints move, and where one of them has a given angle.
//!
//! Docs: general.md, eq. 103.

use super::accepted::{Accepted, Configuration, Kind};
use super::chain::{Closure, Target};
use super::self_motion::{MOST_STEPS, STEP};
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
    /// Bring self-motions to the member whose first joint that moves has its angle of `near`, where
    /// they have one, and to the nearest of several. Returns which joints move in each.
    pub(crate) fn bring_to(
        &mut self,
        closure: &Closure,
        target: &Target,
        near: &[f64; 6],
    ) -> impl Iterator<Item = [bool; 6]> {
        self.as_mut_slice().iter_mut().map(|one| {
            let Kind::Free { direction } = one.kind else { return [false; 6] };
            let moving = closure.moving(target, &one.theta, &direction);
            if let Some(first) = moving.iter().position(|moves| *moves) {
                let member = closure.member(target, &one.theta, &direction, first, near);
                *one = member.unwrap_or(*one);
            }
            moving
        })
    }
}

impl Closure {
    /// Which joints move along a self-motion.
    fn moving(&self, target: &Target, start: &[f64; 6], direction: &[f64; 6]) -> [bool; 6] {
        let mut moving = [false; 6];
        self.around(target, start, direction, |theta, next| {
            for joint in 0..6 {
                moving[joint] |= (next[joint] - theta[joint]).abs() > MOVES * STEP;
            }
        });
        moving
    }

    /// The member of a self-motion with a joint at its angle of `near`; of several the nearest.
    pub(crate) fn member(
        &self,
        target: &Target,
        start: &[f64; 6],
        direction: &[f64; 6],
        joint: usize,
        near: &[f64; 6],
    ) -> Option<Configuration> {
        let away = |theta: &[f64; 6]| wrap(theta[joint] - near[joint]);
        let mut nearest = None::<Configuration>;
        let mut take = |one: Option<Configuration>| {
            let is_nearer = |one: &Configuration| {
                nearest.is_none_or(|other| one.distance(near) < other.distance(near))
            };
            nearest = one.filter(is_nearer).or(nearest);
        };
        if away(start).abs() <= AT_PLACE {
            take(self.with_kind(target, start));
        }
        self.around(target, start, direction, |theta, next| {
            let (here, there) = (away(theta), away(next));
            if (here < 0.0) != (there < 0.0) && here.abs() + there.abs() < FAR {
                take(self.where_zero(target, theta, next, away));
            }
        });
        nearest
    }

    /// The direction of a self-motion at a configuration of it.
    pub(crate) fn direction(&self, target: &Target, theta: &[f64; 6]) -> Option<[f64; 6]> {
        self.curve(target, theta).map(|curve| curve.v.into())
    }

    /// Walk along a self-motion in both directions, or once around; `pass` gets the ends of each
    /// step.
    pub(crate) fn around(
        &self,
        target: &Target,
        start: &[f64; 6],
        direction: &[f64; 6],
        mut pass: impl FnMut(&[f64; 6], &[f64; 6]),
    ) {
        let apart = |theta: &[f64; 6]| {
            theta.iter().zip(start).fold(0.0, |most: f64, (a, b)| most.max(wrap(a - b).abs()))
        };
        for way in [*direction, direction.map(|part| -part)] {
            let (mut theta, mut way) = (*start, way);
            let mut is_back = false;
            for step in 0..MOST_STEPS {
                let Some((next, ahead)) = self.advanced(target, &theta, &way) else { break };
                pass(&theta, &next);
                // One step more, which passes the start.
                if is_back {
                    return;
                }
                is_back = step > 2 && apart(&next) < 0.6 * STEP;
                (theta, way) = (next, ahead);
            }
        }
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
