//! The solutions next to the roots of the resultant: branches as candidates, which the closure of
//! the chain brings to the pose.
//!
//! Docs: offset_wrist.md, section 5.

use core::f64::consts::PI;

use fearless_simd::prelude::*;
#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::at_roots::AtRoots;
use super::branch::{Branch, Plane, SIDES, SLACK};
use super::geometry::{Constants, OffsetWrist};
use super::hand::Hand;
use crate::kinematics::structure::closure::{Accepted, Candidates, Target};
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::trigonometric::Root;
use crate::lanes::{
    Column, LANES, Number as _, Vector, VectorKernel, atan2, run_vectors, sin_cos_of,
};

/// How far the wrist point may be from axis 1, or the upper arm from its length, for the condition
/// of axis 5 to decide there, relative to the lengths of the arm [1].
const NEAR: f64 = 1e-3;

/// A pose of an arm, the candidates that wait for their turn, and the solutions.
pub(super) struct Search<'a> {
    pub(super) arm: &'a OffsetWrist,
    pub(super) last: &'a Frame,
    pub(super) hand: Hand,
    pub(super) target: Target,
    pub(super) accepted: &'a mut Accepted,
    places: Places,
}

/// Candidates that wait: branches at angles of joint 6.
struct Places {
    /// Sides of shoulder and elbow: signs.
    shoulders: Column,
    elbows: Column,
    /// Joint 6 [rad].
    angles: Column,
    count: usize,
}

impl Places {
    const NONE: Self =
        Self { shoulders: [1.0; LANES], elbows: [1.0; LANES], angles: [0.0; LANES], count: 0 };

    fn put(&mut self, angle: f64, [shoulder, elbow]: [f64; 2]) {
        let Self { shoulders, elbows, angles, count } = self;
        (shoulders[*count], elbows[*count], angles[*count]) = (shoulder, elbow, angle);
        *count += 1;
    }

    /// With the first candidate repeated in the lanes that none waits in.
    fn filled(mut self) -> Self {
        for lanes in [&mut self.shoulders, &mut self.elbows, &mut self.angles] {
            let first = lanes[0];
            lanes[self.count..].fill(first);
        }
        self
    }
}

/// Candidates, brought to the pose.
struct AtPlaces<'a, 'b> {
    search: &'a Search<'b>,
    places: &'a Places,
    /// Which condition the forearm is to meet.
    by: Condition,
}

/// A condition that determines the direction of the forearm.
#[derive(Clone, Copy, PartialEq)]
enum Condition {
    /// The upper arm has its length (eq. 124).
    Length,
    /// Axis 5 has its angle from axis 4 (eq. 123), the length being nearly met.
    Axis5,
}

impl VectorKernel for AtPlaces<'_, '_> {
    /// None where there is no branch.
    type Answer = Option<Candidates>;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Option<Candidates> {
        let Search { arm, last, hand, target, .. } = self.search;
        let Constants { lengths, twists, closure } = &arm.constants;
        let Places { shoulders, elbows, angles, .. } = self.places;
        let (sin, cos) = sin_cos_of(Vector::load_array_ref(simd, angles));
        let shoulders = Vector::load_array_ref(simd, shoulders);
        let elbows = Vector::load_array_ref(simd, elbows);
        let (hand, last) = (hand.in_lanes(sin), last.in_lanes(sin));
        let plane = Plane::of(lengths, hand.at([sin, cos]), shoulders);
        let (branch, is_near) = if self.by == Condition::Length {
            let least = -SLACK * lengths.extent * lengths.extent;
            (plane.with_elbow(lengths, elbows, SLACK), plane.sigma2.simd_ge(least))
        } else {
            let branch = plane.with_axis_5(lengths, elbows, SLACK);
            (branch, branch.misses(lengths).simd_lt(NEAR * lengths.extent))
        };
        let is_one = branch.off.simd_lt(f64::INFINITY) & is_near;
        if !is_one.any_true() {
            return None;
        }
        let [mut sin, mut cos] = branch.joints(lengths, &last, [sin, cos], twists);
        // Far from a solution they are no unit vectors.
        for joint in 0..6 {
            let scale = sin[joint].mul_add(sin[joint], cos[joint] * cos[joint]).sqrt().inverse();
            (sin[joint], cos[joint]) = (sin[joint] * scale, cos[joint] * scale);
        }
        sin[0] = is_one.select(sin[0], shoulders.like(f64::NAN));
        Some(closure.converge(&target.in_lanes(cos[0]), &sin, &cos))
    }
}

impl<'a> Search<'a> {
    pub(super) fn new(arm: &'a OffsetWrist, last: &'a Frame, accepted: &'a mut Accepted) -> Self {
        Self {
            arm,
            last,
            hand: Hand::of(&arm.constants.lengths, last),
            target: arm.constants.closure.target(*last),
            accepted,
            places: Places::NONE,
        }
    }

    /// Take what candidates in these lanes, which have converged, lead to.
    fn take(&mut self, candidates: &Candidates, lanes: usize) {
        self.accepted.take(&self.arm.constants.closure, &self.target, candidates, lanes);
    }

    /// Take a branch at an angle of joint 6 as a candidate, even if it is a little out of reach.
    pub(super) fn put_at(&mut self, sides: [f64; 2], angle: f64) {
        self.places.put(angle, sides);
        if self.places.count == LANES {
            self.converge();
        }
    }

    /// Bring the waiting candidates to the pose.
    pub(super) fn converge(&mut self) {
        if self.places.count > 0 {
            let places = core::mem::replace(&mut self.places, Places::NONE);
            self.converge_at(&places.filled(), Condition::Length);
        }
    }

    fn converge_at(&mut self, places: &Places, by: Condition) {
        if let Some(candidates) = run_vectors(AtPlaces { search: self, places, by }) {
            self.take(&candidates, places.count);
        }
    }

    /// Take all branches at an angle of joint 6 as candidates.
    pub(super) fn put_all_at(&mut self, angle: f64) {
        for sides in SIDES {
            self.put_at(sides, angle);
        }
    }

    /// Take a branch as the only candidate.
    fn put(&mut self, branch: &Branch<f64>, sin_cos_6: [f64; 2]) {
        let Constants { lengths, twists, closure } = &self.arm.constants;
        let [sin, cos] = branch.joints(lengths, self.last, sin_cos_6, twists);
        let theta = core::array::from_fn(|joint| [atan2::<false>(sin[joint], cos[joint]); LANES]);
        let candidates = closure.converged(&self.target, &theta);
        self.take(&candidates, 1);
    }

    /// The solutions at simple roots, and those of the candidates that wait.
    pub(super) fn at_all_roots<'r, S: Simd>(
        &mut self,
        simd: S,
        roots: impl Iterator<Item = &'r Root>,
    ) {
        // A function of its own for each instruction set: it is long.
        simd.vectorize(
            #[inline(always)]
            || self.at_each_eight(simd, roots),
        );
        self.converge();
    }

    #[inline(always)]
    fn at_each_eight<'r, S: Simd>(&mut self, simd: S, mut roots: impl Iterator<Item = &'r Root>) {
        loop {
            let (mut block, mut lanes) = ([Root::NONE; LANES], 0);
            for (place, root) in block.iter_mut().zip(&mut roots) {
                *place = *root;
                lanes += 1;
            }
            if lanes == 0 {
                break;
            }
            self.at_roots(simd, &block[..lanes]);
        }
    }

    /// The solutions at up to eight simple roots: of the branch that is nearest to one, and of those
    /// that are hardly worse.
    #[inline(always)]
    fn at_roots<S: Simd>(&mut self, simd: S, roots: &[Root]) {
        let (mut angles, mut radii) = ([0.0; LANES], [0.0; LANES]);
        for lane in 0..LANES {
            // Lanes without a root repeat the first.
            let root = &roots[if lane < roots.len() { lane } else { 0 }];
            (angles[lane], radii[lane]) = (root.angle(), root.radius());
        }
        let constants = &self.arm.constants;
        let angles = Vector::load_array(simd, angles);
        let at_roots = AtRoots::new(constants, &self.last.in_lanes(angles), angles);
        for number in 0..constants.lengths.per_root() {
            let served = at_roots.served(number);
            let candidates = at_roots.converge(&served.nearest);
            self.take(&candidates, roots.len());
            let [most, count] = served.candidates(&radii);
            if !count.simd_gt(1.5).any_true() {
                continue;
            }
            let sides = &SIDES[number * served.branches.len()..];
            for (lane, root) in roots.iter().enumerate().filter(|(lane, _)| count[*lane] > 1.5) {
                for (sides, branch) in sides.iter().zip(served.branches) {
                    if branch.off[lane].abs() <= most[lane] {
                        self.put_at(*sides, root.angle());
                    }
                }
            }
        }
    }

    /// The candidates with the wrist point on axis 1, or at the end of the upper arm's reach: there
    /// the condition of axis 5 determines joint 1 or the forearm (eq. 134).
    pub(super) fn at_degenerate(&mut self, angle: f64) {
        let lengths = &self.arm.constants.lengths;
        let sin_cos_6 = sin_cos(angle);
        let (point, axis_5) = self.hand.at(sin_cos_6);
        let mut places = Places::NONE;
        for sides in SIDES {
            places.put(angle, sides);
        }
        self.converge_at(&places.filled(), Condition::Axis5);
        if point[0].hypot(point[1]) > NEAR * lengths.extent || lengths.b != 0.0 {
            return;
        }
        for elbow in [1.0, -1.0] {
            let branch = |theta_1: f64| {
                let [sin, cos] = sin_cos(theta_1);
                let plane = Plane::facing(lengths, [cos, sin], [0.0, point[2]], axis_5, 0.0);
                plane.with_elbow(lengths, elbow, SLACK)
            };
            let [zero, quarter, half] = [0.0, 0.5 * PI, PI].map(branch);
            if zero.off.max(quarter.off).max(half.off) == f64::INFINITY {
                continue;
            }
            // middle + radius cos(theta_1 - at) by three values.
            let middle = 0.5 * (zero.off + half.off);
            let (x, y) = (0.5 * (zero.off - half.off), quarter.off - middle);
            let (radius, at) = (x.hypot(y), y.atan2(x));
            let turn = (-middle / radius).clamp(-1.0, 1.0).acos();
            for theta_1 in [at + turn, at - turn] {
                let branch = branch(theta_1);
                if branch.off < f64::INFINITY {
                    self.put(&branch, sin_cos_6);
                }
            }
        }
    }
}

pub(super) fn sin_cos(angle: f64) -> [f64; 2] {
    let (sin, cos) = crate::lanes::sin_cos::<false>(angle);
    [sin, cos]
}
