//! The solutions next to the roots of the resultant: branches as candidates, which the closure of
//! the chain brings to the pose.
//!
//! Docs: offset_wrist.md, section 5.

use core::f64::consts::PI;

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::branch::{Branch, Plane, SIDES, branch_at};
use super::geometry::OffsetWrist;
use super::resultant::Hand;
use crate::kinematics::structure::closure::{Accepted, Candidates, Target};
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::trigonometric::Root;
use crate::lanes::LANES;

/// Size of z4 . z5 - cos alpha_4 at a root, by which a branch may be worse than the best one and
/// still be a candidate: at once [1], and as a multiple of the radius of the root [1/rad].
const ALSO: f64 = 1e-9;
const ALSO_BY_RADIUS: f64 = 30.0;

/// How far a branch may be out of reach and still be a candidate, relative to the squares of the
/// lengths [1].
const SLACK: f64 = 1e-3;

/// How far the wrist point may be from axis 1, or the upper arm from its length, for the condition
/// of axis 5 to decide there, relative to the lengths of the arm [1].
const NEAR: f64 = 1e-3;

/// A pose of an arm, the candidates that wait for their turn, and the solutions.
pub(super) struct Search<'a> {
    pub(super) arm: &'a OffsetWrist,
    pub(super) last: &'a Frame,
    pub(super) hand: Hand,
    pub(super) target: Target,
    pub(super) accepted: Accepted,
    candidates: Candidates,
    /// Number of candidates that wait.
    waiting: usize,
}

impl<'a> Search<'a> {
    #[inline(always)]
    pub(super) fn new<const FUSED: bool>(arm: &'a OffsetWrist, last: &'a Frame) -> Self {
        Self {
            arm,
            last,
            hand: Hand::of::<FUSED>(&arm.lengths, last),
            target: arm.general.closure().target(last),
            accepted: Accepted::NONE,
            candidates: Candidates::NEW,
            waiting: 0,
        }
    }

    pub(super) fn branch(&self, sides: [f64; 2], angle: f64, slack: f64) -> Option<Branch> {
        branch_at(&self.arm.lengths, &self.hand, sides, sin_cos(angle), slack)
    }

    /// Take a branch as a candidate.
    #[inline(always)]
    fn put<const FUSED: bool>(&mut self, branch: &Branch, sin_cos_6: [f64; 2]) {
        let OffsetWrist { lengths, twists, .. } = self.arm;
        let joints = branch.joints::<FUSED>(lengths, self.last, sin_cos_6, twists);
        if !joints.as_flattened().iter().copied().all(f64::is_finite) {
            return;
        }
        for (joint, [sin, cos]) in joints.into_iter().enumerate() {
            self.candidates.sin[joint][self.waiting] = sin;
            self.candidates.cos[joint][self.waiting] = cos;
        }
        self.waiting += 1;
        if self.waiting == LANES {
            self.converge::<FUSED>();
        }
    }

    /// Bring the waiting candidates to the pose.
    #[inline(always)]
    pub(super) fn converge<const FUSED: bool>(&mut self) {
        if self.waiting > 0 {
            let closure = self.arm.general.closure();
            closure.converge::<FUSED>(&self.target, &mut self.candidates);
            self.accepted.take(closure, &self.target, &self.candidates, self.waiting);
            self.waiting = 0;
        }
    }

    /// The candidates at a simple root: the branch that is nearest to a solution, one on each side
    /// of the shoulder if a root serves both.
    #[inline(always)]
    pub(super) fn at_root<const FUSED: bool>(&mut self, root: &Root) {
        let sin_cos_6 = sin_cos(root.angle());
        let lengths = &self.arm.lengths;
        let hand = self.hand.at::<FUSED>(sin_cos_6);
        let branches = [1.0, -1.0].map(|shoulder| {
            let plane = Plane::of::<FUSED>(lengths, hand, shoulder);
            [1.0, -1.0].map(|elbow| plane.with_elbow::<FUSED>(lengths, elbow, SLACK))
        });
        let off = |branch: &Option<Branch>| branch.map_or(f64::INFINITY, |found| found.off.abs());
        let best = branches.each_ref().map(|[one, other]| off(one).min(off(other)));
        let [front, behind] = best;
        let best = if lengths.is_square { best } else { [front.min(behind); 2] };
        let also = ALSO + ALSO_BY_RADIUS * root.radius();
        for (branches, best) in branches.iter().zip(best) {
            for branch in branches {
                if off(branch) <= best + also
                    && let Some(branch) = branch
                {
                    self.put::<FUSED>(branch, sin_cos_6);
                }
            }
        }
    }

    /// A candidate at an angle of joint 6, even if it is a little out of reach.
    pub(super) fn put_at(&mut self, sides: [f64; 2], angle: f64) {
        if let Some(branch) = self.branch(sides, angle, SLACK) {
            self.put::<false>(&branch, sin_cos(angle));
        }
    }

    /// The candidates with the wrist point on axis 1, or at the end of the upper arm's reach: there
    /// the condition of axis 5 determines joint 1 or the forearm (eq. 134).
    pub(super) fn at_degenerate(&mut self, angle: f64) {
        let lengths = &self.arm.lengths;
        let sin_cos_6 = sin_cos(angle);
        let (point, axis_5) = self.hand.at::<false>(sin_cos_6);
        for [shoulder, side] in SIDES {
            let plane = Plane::of::<false>(lengths, (point, axis_5), shoulder);
            if let Some(branch) = plane.with_axis_5::<false>(lengths, side, SLACK)
                && branch.misses(lengths) < NEAR * lengths.extent
            {
                self.put::<false>(&branch, sin_cos_6);
            }
        }
        if point[0].hypot(point[1]) > NEAR * lengths.extent || lengths.b != 0.0 {
            return;
        }
        for elbow in [1.0, -1.0] {
            let branch = |theta_1: f64| {
                let [sin, cos] = sin_cos(theta_1);
                let plane =
                    Plane::facing::<false>(lengths, [cos, sin], [0.0, point[2]], axis_5, 0.0);
                plane.with_elbow::<false>(lengths, elbow, SLACK)
            };
            let [Some(zero), Some(quarter), Some(half)] = [0.0, 0.5 * PI, PI].map(branch) else {
                continue;
            };
            // middle + radius cos(theta_1 - at) by three values.
            let middle = 0.5 * (zero.off + half.off);
            let (x, y) = (0.5 * (zero.off - half.off), quarter.off - middle);
            let (radius, at) = (x.hypot(y), y.atan2(x));
            let turn = (-middle / radius).clamp(-1.0, 1.0).acos();
            for theta_1 in [at + turn, at - turn] {
                if let Some(branch) = branch(theta_1) {
                    self.put::<false>(&branch, sin_cos_6);
                }
            }
        }
    }
}

pub(super) fn sin_cos(angle: f64) -> [f64; 2] {
    let (sin, cos) = crate::lanes::sin_cos::<false>(angle);
    [sin, cos]
}
