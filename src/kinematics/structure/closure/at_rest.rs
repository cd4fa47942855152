//! Which member of a self-motion represents it: the one with the first joint that moves at rest.
//!
//! Docs: general.md, eq. 103.

use super::accepted::{Accepted, Configuration, Kind};
use super::chain::{Closure, Target};
use super::self_motion::MOST_STEPS;
use crate::kinematics::pose::angles::wrap;

/// Part of a self-motion from which on a joint moves [1].
const MOVES: f64 = 1e-4;

/// Angle from which on a joint passes half a turn rather than its rest [rad].
const FAR: f64 = 1.0;

/// Angle of a joint that is at rest [rad].
const AT_REST: f64 = 1e-14;

/// Steps of the secant method, at most.
const MOST_SECANTS: usize = 8;

impl Accepted {
    /// Bring self-motions to where the first of their joints that moves is at rest, if they pass
    /// there; `rest` are the angles of all joints at rest [rad].
    pub(crate) fn bring_to_rest(&mut self, closure: &Closure, target: &Target, rest: &[f64; 6]) {
        for one in self.as_mut_slice() {
            if let Kind::Free { direction } = one.kind
                && let Some(joint) = direction.iter().position(|part| part.abs() > MOVES)
            {
                let ways = [direction, direction.map(|part| -part)];
                let at_rest = |way| closure.at_rest(target, one, way, joint, rest[joint]);
                if let Some(member) = ways.into_iter().find_map(at_rest) {
                    *one = member;
                }
            }
        }
    }
}

impl Closure {
    /// The member of a self-motion, in one direction, with a joint at an angle.
    fn at_rest(
        &self,
        target: &Target,
        start: &Configuration,
        mut way: [f64; 6],
        joint: usize,
        angle: f64,
    ) -> Option<Configuration> {
        let away = |theta: &[f64; 6]| wrap(theta[joint] - angle);
        let mut theta = start.theta;
        for _ in 0..MOST_STEPS {
            let (next, ahead) = self.advanced(target, &theta, &way)?;
            let (here, there) = (away(&theta), away(&next));
            if (here < 0.0) != (there < 0.0) && here.abs() + there.abs() < FAR {
                return self.where_zero(target, &theta, &next, away);
            }
            (theta, way) = (next, ahead);
        }
        None
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
            if last.1.abs() <= AT_REST {
                break;
            }
            let s = last.0 - last.1 * (last.0 - before.0) / (last.1 - before.1);
            theta = curve.at(s, &theta)?.theta;
            (before, last) = (last, (s, number(&theta)));
        }
        let there = self.curve(target, &theta)?;
        let kind = Kind::Free { direction: there.v.into() };
        self.accepted(target, theta, there.least, kind)
    }
}
