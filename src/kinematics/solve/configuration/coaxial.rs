//! Two axes of a YuMi on one line: axes 1 and 7 with axis 2 at zero, axes 4 and 6 with axis 5 at
//! zero. They turn against each other with the tool and the arm angle standing still.
//!
//! A pose and an arm angle then have a whole self-motion of joint vectors: one of them is chosen.

use core::f64::consts::TAU;

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use crate::kinematics::answer::solutions::Solution;
use crate::kinematics::answer::status::Status;
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::pose::angles::wrap;
use crate::kinematics::solve::self_motion_curve::{Joints, SelfMotion};
use crate::lanes::{whole_above, whole_below};
use crate::report::FreeJoint;

/// The joints, from 0, of two axes with the one between them, and what is free where that is zero.
const PAIRS: [([usize; 3], FreeJoint); 2] =
    [([0, 1, 2], FreeJoint::ShoulderSum), ([4, 5, 6], FreeJoint::LastSum)];

/// Angle of the axis between them below which two axes may be one [rad]: above, Newton's method
/// tells the members of the self-motion apart by their arm angles.
const STRAIGHT: f64 = 2e-9;

/// The common part of the members of a solution's self-motion: all but how two axes share their
/// sum.
pub(super) fn shared(solution: &Solution<7>) -> [f64; 7] {
    let mut q = solution.q;
    for ([one, _, other], free) in PAIRS {
        if solution.free_joint == Some(free) {
            (q[one], q[other]) = (0.0, q[one] + q[other]);
        }
    }
    q
}

/// The angles of two axes with a sum [rad], at any number of turns, that are inside limits and the
/// nearest to others.
fn shares(sum: f64, limits: [[f64; 2]; 2], to: [f64; 2]) -> Option<[f64; 2]> {
    let inside = |at: f64, [low, high]: [f64; 2]| at.max(low).min(high);
    let [one, other] = limits;
    // The cost of a sum is convex, so its whole turns next to the best real number are enough.
    let turns = (inside(to[0], one) + inside(to[1], other) - sum) / TAU;
    let at_turn = |turns: f64| {
        let sum = sum + TAU * turns;
        let (low, high) = (one[0].max(sum - other[1]), one[1].min(sum - other[0]));
        let angle = inside(0.5 * (sum + to[0] - to[1]), [low, high]);
        (low <= high).then_some([angle, sum - angle])
    };
    let cost = |at: &[f64; 2]| (at[0] - to[0]).powi(2) + (at[1] - to[1]).powi(2);
    let nearest = [whole_below(turns), whole_above(turns)].into_iter().filter_map(at_turn);
    nearest.min_by(|a, b| cost(a).total_cmp(&cost(b)))
}

impl SelfMotion<'_> {
    /// The member of a solution's self-motion that is nearest to a seed [rad] of those whose two
    /// axes are inside limits; `None` if no two axes are one, if none is inside, or if its arm angle
    /// is another.
    pub(super) fn member_nearest(
        &self,
        solution: &Solution<7>,
        limits: &JointLimits<7>,
        seed: &[f64; 7],
        has_arm_angle: impl Fn(&[f64; 7]) -> bool,
    ) -> Option<Solution<7>> {
        let is_free = |([_, between, _], free): &([usize; 3], FreeJoint)| {
            wrap(solution.q[*between]).abs() <= STRAIGHT || solution.free_joint == Some(*free)
        };
        let ([one, _, other], free) = PAIRS.into_iter().find(is_free)?;
        let (bounds, mut q) = (limits.to_array(), solution.q);
        let of_two = |q: &[f64; 7]| [q[one], q[other]];
        let sum = q[one] + q[other];
        [q[one], q[other]] = shares(sum, [bounds[one], bounds[other]], of_two(seed))?;
        let member = self.with_joint_at(&Joints::from(q), one, q[one]);
        let q = member.map_or(q, |member| member.joints());
        let mut status = solution.status;
        status.set(Status::WITHIN_LIMITS, self.robot.limits().contains(&q));
        has_arm_angle(&q).then_some(Solution { q, status, free_joint: Some(free), ..*solution })
    }
}
