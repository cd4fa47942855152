//! Searches the joint vectors of a pose that have an arm angle.
//!
//! All solutions at some angles of one joint, the last or another, are points of the curves on
//! which the arm moves while its tool stands still. Each curve is followed from one of these angles
//! to the next, past the places where the joint turns back; where the arm angle passes the wanted
//! one, Newton's method finds it.

use core::f64::consts::{PI, TAU};
use core::ops::ControlFlow::{Break, Continue};

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::arm_angle::ArmAngle;
use super::coaxial;
use crate::error::Error;
use crate::kinematics::answer::slot::{MOST_SLOTS, Slot};
use crate::kinematics::answer::solutions::Solution;
use crate::kinematics::answer::status::Status;
use crate::kinematics::pose::angles::wrap;
use crate::kinematics::robot::Robot;
use crate::kinematics::solve::self_motion_curve::{Joints, Point, SelfMotion};
use crate::kinematics::structure::continuum::{Steps, walk};
use crate::kinematics::structure::locked::LockedJoint;

/// Spacing of the angles of the joint at which all solutions are computed [rad]: a self-motion that
/// turns it by less may be missed.
const SPACING: f64 = PI / 180.0;

/// Steps along one piece of a curve [rad], after which it is given up.
const STEPS: Steps = Steps { first: 0.06, least: 1e-7, longest: 0.06, shorter: 0.5, most: 2000 };

/// Largest change of the arm angle in a step [rad].
const LARGEST_CHANGE: f64 = 0.3;

/// Cosine of the largest angle between the directions of a curve at the ends of a step [1].
const LEAST_COSINE: f64 = 0.95;

/// How far the arm angle may be from the wanted one where it is the nearest, for Newton's method to
/// start there [rad].
const NEAR: f64 = 0.02;

/// Angle by which joints differ from another solution's, at least [rad].
const APART: f64 = 1e-6;

/// Angle by which the common part of the members of a self-motion differs from another's, at
/// least [rad]: along it, it may change by as much as the arm angle may, and a singularity adds.
const FREE_APART: f64 = 1e-5;

/// Number of solutions of one pose and arm angle that are kept: the most seen is sixteen.
pub(super) const MOST: usize = 48;

/// The solutions found.
pub(super) type Members = [Option<Solution<7>>; MOST];

/// The solutions with one joint at an angle, and which of them a curve has passed.
#[derive(Clone, Copy)]
struct Section {
    /// The angle of the joint [rad].
    at: f64,
    solutions: [Option<[f64; 7]>; MOST_SLOTS],
    passed: [bool; MOST_SLOTS],
}

/// The search for the joint vectors of a pose that have an arm angle.
pub(super) struct Search<'a> {
    pub(super) curve: SelfMotion<'a>,
    pub(super) angle: ArmAngle<'a>,
    pub(super) wanted: f64,
    /// The arm with the joint of the sections locked, if that is not the last.
    pub(super) locked: Option<Robot<7>>,
    pub(super) found: Members,
}

fn largest_difference(a: &[f64; 7], b: &[f64; 7]) -> f64 {
    a.iter().zip(b).map(|(a, b)| wrap(a - b).abs()).fold(0.0, f64::max)
}

impl Search<'_> {
    /// The joint of the sections, from 0.
    fn joint(&self) -> usize {
        self.locked.as_ref().map_or(6, Robot::locked_index)
    }

    /// Search with the joint of the sections between two angles.
    pub(super) fn run(&mut self, [from, to]: [f64; 2]) -> Result<(), Error> {
        // Another angle of a joint between the ends is another chain: one section, all around.
        let is_between = !LockedJoint::is_end(self.joint());
        let spacing = if is_between { TAU } else { SPACING };
        let count = ((to - from) / spacing).ceil().max(1.0);
        let mut before = self.section(from)?;
        let mut number = 1.0;
        while number <= count {
            let mut after = self.section(from + (to - from) * number / count)?;
            for slot in 0..MOST_SLOTS {
                self.follow_from(&mut before, slot, &mut after, 1.0);
            }
            for slot in 0..MOST_SLOTS {
                if !after.passed[slot] {
                    self.follow_from(&mut after, slot, &mut before, -1.0);
                }
            }
            after.passed = [false; MOST_SLOTS];
            (before, number) = (after, number + 1.0);
        }
        Ok(())
    }

    fn section(&self, at: f64) -> Result<Section, Error> {
        let robot = self.locked.as_ref().unwrap_or(self.curve.robot);
        let found = robot.ik_checked(*self.curve.pose, at)?;
        let mut solutions = [None; MOST_SLOTS];
        for (place, solution) in solutions.iter_mut().zip(&found) {
            let mut q = solution.q;
            q[self.joint()] = at;
            *place = Some(q);
        }
        Ok(Section { at, solutions, passed: [false; MOST_SLOTS] })
    }

    /// How far the arm angle is from the wanted one.
    fn off(&self, q: &[f64; 7]) -> Option<f64> {
        self.angle.off(q, self.wanted)
    }

    /// Follow the curve of a solution into the strip between two sections, the joint turning by the
    /// sign of `way` at first, to where it leaves the strip.
    fn follow_from(&mut self, from: &mut Section, slot: usize, to: &mut Section, way: f64) {
        let Some(start) = from.solutions[slot].filter(|_| !from.passed[slot]) else { return };
        from.passed[slot] = true;
        let Some(mut point) = self.curve.nearest(&Joints::from(start)) else {
            self.refine(&start);
            return;
        };
        let joint = self.joint();
        if point.along[joint] * way < 0.0 {
            point.along = -point.along;
        }
        let Some(off) = self.off(&point.joints()) else { return };
        let mut slope = 0.0;
        walk((point, off), STEPS, |(point, off), step| {
            let (next, next_off) = self.step(point, *off, step)?;
            let change = wrap(next_off - off);
            // Both signs also meet half a turn away from the wanted angle.
            if off * next_off <= 0.0 && off.abs() < 1.0 {
                let part = if change == 0.0 { 0.0 } else { -off / change };
                self.refine(&(point.q + part * (next.q - point.q)).into());
            } else if slope * change <= 0.0 && off.abs() <= NEAR {
                // The nearest that the arm angle comes, here or next to it.
                self.refine(&point.joints());
            }
            let crossed = if way * (next.q[joint] - from.at) < 0.0 {
                &mut *from
            } else if way * (next.q[joint] - to.at) > 0.0 {
                &mut *to
            } else {
                slope = change;
                return Some(Continue(((next, next_off), 2.0)));
            };
            crossed.pass(&self.curve, joint, &next);
            Some(Break(()))
        });
    }

    /// A step along the curve, if neither the curve nor the arm angle turns far on it.
    fn step(&self, point: &Point, off: f64, step: f64) -> Option<(Point, f64)> {
        let next = self.curve.across(&(point.q + step * point.along), &point.along)?;
        let next_off = self.off(&next.joints())?;
        let is_small = next.along.dot(&point.along) >= LEAST_COSINE
            && (next.q - point.q).norm() <= 2.0 * step
            && wrap(next_off - off).abs() <= LARGEST_CHANGE;
        is_small.then_some((next, next_off))
    }

    /// Find the wanted arm angle near joint angles of the pose.
    fn refine(&mut self, near: &[f64; 7]) {
        let seventh = |q: &Joints| self.angle.seventh(q, self.wanted);
        let Some(point) = self.curve.newton(Joints::from(*near), seventh) else { return };
        let q = self.curve.robot.limits().wrap(point.joints().map(wrap));
        if self.has_wanted(&q) {
            self.keep(q);
        }
    }

    fn has_wanted(&self, q: &[f64; 7]) -> bool {
        self.angle.is_of(q, self.wanted)
    }

    fn keep(&mut self, q: [f64; 7]) {
        let robot = self.curve.robot;
        let mut status = Status::FOUND | Status::from(robot.singularity(&q).kinds);
        status.set(Status::WITHIN_LIMITS, robot.limits().contains(&q));
        let slot = robot.slot_of(&q).unwrap_or(Slot::new(0));
        let one = Solution { q, slot, status, free_joint: None };
        let (limits, rest) = (robot.limits(), robot.limits().rest());
        let has_arm_angle = |q: &[f64; 7]| self.has_wanted(q);
        let member = self.curve.member_nearest(&one, limits, &rest, has_arm_angle);
        let solution = member.unwrap_or(one);
        let apart = if solution.free_joint.is_some() { FREE_APART } else { APART };
        let known = |found: &Solution<7>| {
            found.free_joint == solution.free_joint
                && largest_difference(&coaxial::shared(found), &coaxial::shared(&solution)) <= apart
        };
        if self.found.iter().flatten().any(known) {
            return;
        }
        if let Some(place) = self.found.iter_mut().find(|place| place.is_none()) {
            *place = Some(solution);
        }
    }
}

impl Section {
    /// Note the solution at which a curve passes the section, of which a point near it is given.
    fn pass(&mut self, curve: &SelfMotion<'_>, joint: usize, near: &Point) {
        let Some(at) = curve.with_joint_at(&near.q, joint, self.at) else { return };
        let at = at.joints();
        for (solution, passed) in self.solutions.iter().zip(&mut self.passed) {
            if solution.is_some_and(|solution| largest_difference(&solution, &at) <= 1e3 * APART) {
                *passed = true;
            }
        }
    }
}
