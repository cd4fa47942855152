//! Self-motions of the chain: joint vectors of one pose along a curve, followed by predictor and
//! corrector.
//!
//! Docs: general.md, eq. 103.

use core::ops::ControlFlow::{Break, Continue};

use nalgebra::{SMatrix, SVector};

use super::chain::{Closure, Target, sines};
use super::configuration::{Configuration, apart};
use crate::kinematics::pose::angles::wrap;
use crate::kinematics::structure::continuum::{Steps, walk};

/// How near two configurations may be to be examined for being the same [rad].
const NEAR: f64 = 0.02;

/// Steps along a self-motion, down to the least where it bends [rad]: up to eight turns of its
/// fastest joint.
const STEPS: Steps =
    Steps { first: 0.2, least: 0.2 / 512.0, longest: 0.2, shorter: 0.5, most: 400 };

/// Step by which a singular configuration is tried for a self-motion [rad]: at a fold the closure
/// is then off by the square of it.
const TRIED: f64 = 0.02;

/// How far from where it is predicted a member may be, as a part of the step [1]: farther away it is
/// one of another self-motion, which nearly crosses this one, or the curve bends sharply.
const PREDICTED: f64 = 0.05;

/// Steps of Newton's method to a member, at most, and the one that is its last [rad].
const MOST_CORRECTIONS: usize = 8;
const CONVERGED: f64 = 1e-8;

/// Singular value below which a direction is free [1].
const FREE: f64 = 1e-6;

/// Sweeps of a singular value decomposition, at most.
const SWEEPS: usize = 60;

/// How far a configuration of the self-motion may be from the polynomial between two members [rad],
/// and beyond these, as a part of the step.
const ON_CURVE: f64 = 0.02;
const BEYOND: f64 = 0.05;

/// Angle by which a joint that moves does so on the way [rad].
const MOVES: f64 = 1e-3;

/// How near a joint is brought to its angle [rad].
const AT_PLACE: f64 = 1e-14;

/// Angle from which on a joint passes half a turn rather than its place [rad].
const FAR: f64 = 1.0;

/// Steps of the secant method, at most.
const MOST_SECANTS: usize = 8;

/// Condition that may be left on the way between the solutions next to a self-motion [1]: at a fold,
/// [`TRIED`] leaves more.
const NEARLY: f64 = 1e-4;

/// A joint vector of a self-motion, and by how much each joint moves there, as a unit vector.
#[derive(Clone, Copy)]
pub(crate) struct Member {
    pub(crate) theta: [f64; 6],
    direction: SVector<f64, 6>,
    /// The conditions that are left, and how they change by the way: of a self-motion neither.
    pub(super) missing: SVector<f64, 6>,
    pub(super) rate: SVector<f64, 6>,
}

impl Member {
    /// Return a member of a self-motion.
    fn closed(theta: [f64; 6], direction: SVector<f64, 6>) -> Self {
        Self { theta, direction, missing: SVector::zeros(), rate: SVector::zeros() }
    }
}

/// A self-motion, or the curve on which solutions are that are left of one.
pub(crate) struct SelfMotion<'a> {
    pub(super) closure: &'a Closure,
    target: &'a Target,
    start: Member,
    /// Condition that may be left on the way [1].
    accepts: f64,
}

/// The findings of a walk along a self-motion.
pub(super) struct Way {
    /// How far each joint was from its first angle, at most [rad].
    most: [f64; 6],
    /// The member with the first joint that moves at its given angle; of several the nearest.
    pub(super) member: Option<[f64; 6]>,
}

impl Way {
    pub(super) fn moving(&self) -> [bool; 6] {
        self.most.map(|most| most > MOVES)
    }
}

impl Closure {
    /// Whether two configurations that close are one: they are near one another and the chain
    /// closes in the middle, too, where two solutions do not (eq. 98c).
    pub(super) fn are_one(&self, target: &Target, a: &Configuration, b: &Configuration) -> bool {
        let way: [f64; 6] = core::array::from_fn(|i| wrap(b.theta[i] - a.theta[i]));
        way.iter().all(|angle| angle.abs() < NEAR) && {
            let middle = core::array::from_fn(|i| a.theta[i] + 0.5 * way[i]);
            self.residual(target, &middle) <= self.accepts()
                || a.is_singular() && b.is_singular() && self.joins(target, &a.theta, way)
        }
    }

    /// Whether the chain closes half of a way from a configuration, too.
    fn joins(&self, target: &Target, theta: &[f64; 6], way: [f64; 6]) -> bool {
        let way = SVector::from(way);
        let from = Member::closed(*theta, way.normalize());
        let middle = SVector::from(*theta) + way * 0.5;
        let ahead = (0.5 * way.norm(), self.accepts());
        let half = self.member_ahead(target, &from, ahead, middle.into());
        half.is_some_and(|half| (SVector::from(half.theta) - middle).norm() < 0.25 * way.norm())
    }

    fn closes(&self, target: &Target, theta: &[f64; 6]) -> bool {
        self.residual(target, theta) <= self.accepts()
    }

    /// Return the member that is `s` ahead of another one along its direction and leaves no more than
    /// a condition (eq. 103), by Newton's method from a guess.
    fn member_ahead(
        &self,
        target: &Target,
        from: &Member,
        (s, accepts): (f64, f64),
        guess: [f64; 6],
    ) -> Option<Member> {
        let mut theta = SVector::from(guess);
        for _ in 0..MOST_CORRECTIONS {
            let (jacobian, missing) = self.linear(target, &theta.into());
            let done = from.direction.dot(&(theta - SVector::from(from.theta)));
            let (correction, ahead) = correction(&jacobian, &missing, &from.direction, s - done)?;
            let size = correction.amax();
            if size.is_nan() || size > 1.0 {
                return None;
            }
            theta += correction;
            if size < CONVERGED {
                let (sin, cos) = sines(&theta.into());
                let missing = SVector::from(self.missing(target, &sin, &cos));
                let direction = ahead.normalize();
                let rate = -(jacobian * direction);
                let member = Member { theta: theta.into(), direction, missing, rate };
                return (missing.amax() <= accepts).then_some(member);
            }
        }
        None
    }
}

/// The correction that meets the conditions and the step along a direction best, and its derivative
/// by the step: by the normal equations; where self-motions cross, the shortest one.
fn correction(
    jacobian: &SMatrix<f64, 6, 6>,
    missing: &SVector<f64, 6>,
    along: &SVector<f64, 6>,
    step: f64,
) -> Option<(SVector<f64, 6>, SVector<f64, 6>)> {
    let normal = jacobian.transpose() * jacobian + along * along.transpose();
    if let Some(triangle) = normal.cholesky()
        && triangle.l_dirty().diagonal().amin() > FREE
    {
        let right = jacobian.transpose() * missing + along * step;
        return Some((triangle.solve(&right), triangle.solve(along)));
    }
    let svd = jacobian.try_svd(true, true, f64::EPSILON, SWEEPS)?;
    let (u, v_t) = (svd.u?, svd.v_t?);
    let mut shortest = SVector::<f64, 6>::zeros();
    for (row, value) in svd.singular_values.iter().enumerate().filter(|(_, value)| **value > FREE) {
        shortest += v_t.row(row).transpose() * (u.column(row).dot(missing) / value);
    }
    Some((shortest + along * (step - along.dot(&shortest)), *along))
}

impl<'a> SelfMotion<'a> {
    /// Return the self-motion through a configuration that closes, if it is on one: the chain closes
    /// a step ahead along the direction in which it hardly changes, too.
    pub(crate) fn through(
        closure: &'a Closure,
        target: &'a Target,
        theta: &[f64; 6],
    ) -> Option<Self> {
        Self::leaving(closure, target, theta, closure.accepts())
    }

    /// Return the curve through a solution on which others are that are left of a self-motion.
    pub(super) fn near(closure: &'a Closure, target: &'a Target, theta: &[f64; 6]) -> Option<Self> {
        Self::leaving(closure, target, theta, NEARLY)
    }

    /// Return the curve on which no more than a condition is left.
    fn leaving(
        closure: &'a Closure,
        target: &'a Target,
        theta: &[f64; 6],
        accepts: f64,
    ) -> Option<Self> {
        let svd = closure.derivatives(theta).try_svd(false, true, f64::EPSILON, SWEEPS)?;
        let (values, v_t) = (svd.singular_values, svd.v_t?);
        // Two directions may be free at once.
        for row in if values[4] < FREE { [5, 4] } else { [5, 5] } {
            let direction = v_t.row(row).transpose();
            let from = Member::closed(*theta, direction);
            let guess = (SVector::from(*theta) + direction * TRIED).into();
            if let Some(start) = closure.member_ahead(target, &from, (TRIED, accepts), guess) {
                return Some(Self { closure, target, start, accepts });
            }
        }
        None
    }

    /// Follow it in both directions, or once around: `pass` gets the ends of each step.
    pub(crate) fn around(&self, pass: &mut dyn FnMut([&Member; 2])) {
        let Self { closure, target, start, accepts } = self;
        for sign in [1.0, -1.0] {
            // The change of the direction along the way.
            let mut bend = SVector::zeros();
            let (mut walked, mut is_back) = (0.0, false);
            let first = Member { direction: start.direction * sign, ..*start };
            let is_around = walk(first, STEPS, |one, step| {
                let guess = SVector::from(one.theta) + (one.direction + bend * (0.5 * step)) * step;
                let next = closure.member_ahead(target, one, (step, *accepts), guess.into());
                let is_near =
                    |next: &Member| (SVector::from(next.theta) - guess).amax() <= PREDICTED * step;
                // A crossing that is nearer than the least step is passed straight on.
                let next = next.filter(|next| step == STEPS.least || is_near(next))?;
                pass([one, &next]);
                // One step more than around, which passes the start.
                if is_back {
                    return Some(Break(()));
                }
                walked += step;
                is_back = walked > 3.5 * STEPS.longest
                    && apart(&start.theta, &next.theta) < 0.6 * STEPS.longest;
                bend = (next.direction - one.direction) / step;
                Some(Continue((next, 2.0)))
            });
            if is_around {
                return;
            }
        }
    }

    /// Follow it, and find the member whose first joint that moves is at its angle of `near`.
    pub(super) fn followed(&self, near: &[f64; 6], pass: &mut dyn FnMut([&Member; 2])) -> Way {
        let mut most = [0.0_f64; 6];
        let mut passed: [Option<(f64, [f64; 6])>; 6] = [None; 6];
        self.around(&mut |ends| {
            pass(ends);
            for joint in 0..6 {
                let far = wrap(ends[1].theta[joint] - self.start.theta[joint]).abs();
                most[joint] = most[joint].max(far);
                if let Some(theta) = self.member_between(ends, joint, near[joint]) {
                    let far = apart(&theta, near);
                    if passed[joint].is_none_or(|(least, _)| far < least) {
                        passed[joint] = Some((far, theta));
                    }
                }
            }
        });
        let first = most.iter().position(|most| *most > MOVES);
        Way { most, member: first.and_then(|first| passed[first]).map(|(_, theta)| theta) }
    }

    /// Return the member between two of them, ends included, with a joint at an angle.
    fn member_between(&self, ends: [&Member; 2], joint: usize, at: f64) -> Option<[f64; 6]> {
        let off = |one: &Member| wrap(one.theta[joint] - at);
        let [here, there] = ends.map(off);
        // A joint passes half a turn, too.
        if here.abs() > AT_PLACE && here.abs() + there.abs() >= FAR {
            return None;
        }
        let mut member = self.zero_between(ends, off, AT_PLACE)?;
        // Its last rounding goes, too: who asks for zero gets zero.
        let rounding = off(&member);
        if rounding.abs() <= AT_PLACE {
            member.theta[joint] -= rounding;
        }
        self.closure.closes(self.target, &member.theta).then_some(member.theta)
    }

    /// Return the member between two of them, ends included, at which a quantity is zero, to a
    /// rounding: by the secant method.
    pub(super) fn zero_between(
        &self,
        [start, end]: [&Member; 2],
        off: impl Fn(&Member) -> f64,
        rounding: f64,
    ) -> Option<Member> {
        let [here, there] = [off(start), off(end)];
        if here.abs() <= rounding {
            return Some(*start);
        }
        if (here < 0.0) == (there < 0.0) {
            return None;
        }
        let along = |one: &Member| {
            start.direction.dot(&(SVector::from(one.theta) - SVector::from(start.theta)))
        };
        let mut member = *end;
        let (mut before, mut last) = ((0.0, here), (along(end), there));
        for _ in 0..MOST_SECANTS {
            if last.1.abs() <= rounding {
                break;
            }
            let s = last.0 - last.1 * (last.0 - before.0) / (last.1 - before.1);
            let ahead = (s, self.accepts);
            member = self.closure.member_ahead(self.target, start, ahead, member.theta)?;
            (before, last) = (last, (s, off(&member)));
        }
        Some(member)
    }

    /// Return the member with a joint at its angle of `near`; of several the nearest.
    pub(crate) fn member(&self, joint: usize, near: &[f64; 6]) -> Option<[f64; 6]> {
        let mut nearest: Option<(f64, [f64; 6])> = None;
        self.around(&mut |ends| {
            if let Some(theta) = self.member_between(ends, joint, near[joint]) {
                let far = apart(&theta, near);
                if nearest.is_none_or(|(least, _)| far < least) {
                    nearest = Some((far, theta));
                }
            }
        });
        nearest.map(|(_, theta)| theta)
    }

    /// Whether a configuration is on the way between two members.
    pub(super) fn passes(&self, [one, next]: [&Member; 2], other: &Configuration) -> bool {
        let from = SVector::from(one.theta);
        let place = from.zip_map(&SVector::from(other.theta), |one, angle| one + wrap(angle - one));
        let chord = SVector::from(next.theta) - from;
        let part = (place - from).dot(&chord) / chord.norm_squared();
        if !(-BEYOND..=1.0 + BEYOND).contains(&part) {
            return false;
        }
        let between = interpolated([one, next], part);
        (place - between).amax() < ON_CURVE && {
            let s = one.direction.dot(&(between - from));
            let ahead = (s, self.accepts);
            let member = self.closure.member_ahead(self.target, one, ahead, between.into());
            member.is_some_and(|member| {
                let member = Configuration { theta: member.theta, least: 0.0, ..*other };
                self.closure.are_one(self.target, &member, other)
            })
        }
    }
}

/// The place at a part of the way between two members, by a cubic polynomial.
fn interpolated([one, next]: [&Member; 2], part: f64) -> SVector<f64, 6> {
    let [from, to] = [one, next].map(|end| SVector::from(end.theta));
    // The arc is longer than its chord, by what its direction changes.
    let length =
        (to - from).norm() * (1.0 + (next.direction - one.direction).norm_squared() / 24.0);
    let rest = 1.0 - part;
    from * (rest * rest * (1.0 + 2.0 * part))
        + to * (part * part * (1.0 + 2.0 * rest))
        + (one.direction * rest - next.direction * part) * (part * rest * length)
}
