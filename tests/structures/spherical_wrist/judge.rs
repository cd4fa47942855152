//! Judges answers at and near the singularities of an arm with a spherical wrist.

use irbkin::{FreeJoint, OpwParameters, Robot, SingularityKind, Solution, Solutions, thresholds};

use super::WristArm;
use crate::common::wrapped;
use crate::structures::Arm as _;
use crate::structures::place::{Made, Place, Verdict};

/// The elbow angle of a stretched arm below which it is straight to rounding: sqrt(2 rounding of
/// the position / lever), 9e-8 for an IRB 2600.
const STRAIGHT: f64 = 1e-7;
/// How near the joints that a pose determines must be to those that made it [rad].
const FOUND: f64 = 1e-6;

/// How far apart two joint vectors are in what a pose of these singularities determines [rad].
struct Apart {
    /// theta_2 and theta_3; theta_1 unless it is free.
    arm: f64,
    /// theta_5 up to its sign, and theta_4 + theta_6 at theta_5 = 0, theta_4 - theta_6 at 180 deg.
    wrist: f64,
    /// theta_4 and theta_6 each.
    split: f64,
}

impl Apart {
    fn of(arm: &WristArm, a: &[f64; 6], b: &[f64; 6], kinds: SingularityKind) -> Self {
        let (a, b) = (arm.theta(a), arm.theta(b));
        let off = |i: usize| wrapped(a[i] - b[i]);
        let free_1 = kinds.contains(SingularityKind::SHOULDER) && arm.opw.b == 0.0;
        let with_5 = |t: [f64; 6]| if t[4].cos() > 0.0 { t[3] + t[5] } else { t[3] - t[5] };
        let wrist = (wrapped(a[4]) - wrapped(b[4])).abs().max(wrapped(with_5(a) - with_5(b)));
        let undetermined = free_1 || kinds.contains(SingularityKind::WRIST);
        Self {
            arm: off(1).max(off(2)).max(if free_1 { 0.0 } else { off(0) }),
            wrist: if free_1 { 0.0 } else { wrist },
            split: if undetermined { 0.0 } else { off(3).max(off(4)).max(off(5)) },
        }
    }
}

/// How far the joints of the branch that made a pose may be from those found [rad]: (arm and
/// wrist, for the split of theta_4 and theta_6).
///
/// Next to an elbow limit, and with b != 0 near the shoulder's tangent plane, twins differ by
/// the square root of rounding, and below the merge threshold one stands for both
/// (docs/evidence/accuracy.md, section 4). A turn of the forearm turns the split of theta_4 and
/// theta_6 by itself over sin theta_5.
fn found_bound(arm: &WristArm, place: &Place) -> (f64, f64) {
    let (c2, k) = (arm.opw.c2, arm.k());
    let mut position = 8.0 * f64::EPSILON * (1.0 + arm.reach());
    let mut turned = position;
    if let Some(off) = place.shoulder() {
        let b = arm.opw.b.abs();
        if b > 0.0 {
            // x^2 = rho^2 - b^2.
            let x = (2.0 * b * position).sqrt().min(2.0 * b * position / off.max(1e-300));
            let merged = (2.0 * b * thresholds::POSITION_ROUNDING * (b + arm.reach())).sqrt();
            position += x + if off <= 2.0 * merged { 2.0 * (off + merged) } else { 0.0 };
            turned += position / b;
        } else if off > thresholds::SHOULDER_MERGE {
            turned += position / off;
        } else {
            position += 2.0 * off;
        }
    }
    if let Some(off) = place.elbow() {
        let lever = c2 * k / (c2 + k);
        let root = (2.0 * position / lever).sqrt().min(position / (lever * off.max(1e-300)));
        let merged = if off <= 2.0 * STRAIGHT { off + STRAIGHT } else { 0.0 };
        // Folded, the links turn by more than the elbow, by the longest over the shortest distance
        // of the wrist center.
        let gear = ((c2 + k) / (c2 - k).abs().max(off)).max(2.0);
        turned += (root + merged) * gear;
    }
    let sin_5 = place.wrist().unwrap_or(1.0).max(1e-300);
    (FOUND + turned, FOUND + turned / sin_5)
}

pub(super) fn judge(
    arm: &WristArm,
    robot: &Robot<6>,
    made: &Made<6>,
    solutions: &Solutions<6>,
) -> Verdict {
    let (bound, split_bound) = found_bound(arm, &made.place);
    let found = solutions.iter().any(|solution| {
        let apart = Apart::of(arm, &solution.q, &made.q, solution.singularities());
        apart.arm <= bound && apart.wrist <= bound && apart.split <= split_bound
    });
    let moves = |solution: &&Solution<6>| tool_moves(arm, robot, made, solution);
    let duplicates = solutions.iter().enumerate().map(|(i, solution)| {
        solutions.iter().skip(i + 1).filter(|other| are_one(arm, solution, other)).count()
    });
    Verdict {
        found,
        incorrect: solutions.iter().filter(moves).count(),
        duplicates: duplicates.sum(),
        flagged: is_flagged(arm, &made.place, solutions),
    }
}

/// How far beyond reach the pose is with the shoulder of a straight arm that did not make it, by no
/// more than such an arm is given for [m].
pub(super) fn beyond_in(arm: &WristArm, made: &Made<6>, solution: &Solution<6>) -> f64 {
    let own = arm.x(&made.theta);
    let x = arm.x(&arm.theta(&solution.q));
    let is_other = (own < 0.0) != (x < 0.0);
    if !is_other || !solution.singularities().contains(SingularityKind::ELBOW) {
        return 0.0;
    }
    // The wrist center of the pose, before axis 2 and over it; behind axis 1 it is as far away.
    let [_, t2, t3, ..] = made.theta;
    let OpwParameters { a1, a2, c2, c3, .. } = arm.opw;
    let ahead = -own - a1;
    let over = c2 * t2.cos() + c3 * (t2 + t3).cos() - a2 * (t2 + t3).sin();
    let distance = ahead.hypot(over);
    let missing = (distance - (c2 + arm.k())).max((c2 - arm.k()).abs() - distance).max(0.0);
    if missing <= thresholds::REACH_TOLERANCE { missing } else { 0.0 }
}

/// Whether the tool moves where the free joint goes, beyond rounding and the distance from the
/// singularity.
fn tool_moves(arm: &WristArm, robot: &Robot<6>, made: &Made<6>, solution: &Solution<6>) -> bool {
    let Some(free) = solution.free_joint else { return false };
    let moved = robot.with_free_joint(&made.pose, solution, 0.7).unwrap().unwrap();
    let residual = robot.residual(&moved.q, &made.pose);
    let distances = robot.singularity(&solution.q).distances.unwrap();
    let [w2, w4] = {
        let (frames, _) = robot.link_frames(&solution.q);
        [frames[1].translation.vector, frames[3].translation.vector]
    };
    let distance = match free {
        FreeJoint::Base => distances.shoulder,
        // From axis 2 to the wrist center, in the plane of the arm.
        FreeJoint::Upper => (w4 - w2).norm(),
        FreeJoint::WristSum | FreeJoint::WristDifference => distances.wrist,
        other => unreachable!("{other:?} is no joint that a spherical wrist leaves free"),
    };
    residual.largest() > made.beyond + 2.0 * distance + 1e-14 * (1.0 + arm.reach())
}

/// Whether two solutions are the same. Of the self-motion that q1 is free in, two with the same q1
/// are two.
fn are_one(arm: &WristArm, one: &Solution<6>, other: &Solution<6>) -> bool {
    let kinds = (other.singularities() | one.singularities()) - SingularityKind::SHOULDER;
    let apart = Apart::of(arm, &other.q, &one.q, kinds);
    apart.arm.max(apart.wrist).max(apart.split) < 1e-9
}

/// Whether the singularities of the branch that made the pose are flagged.
///
/// Where q1 is not determined, neither is the singularity of the wrist, and the shoulders that are
/// merged differ in reach by twice their distance from axis 1.
fn is_flagged(arm: &WristArm, place: &Place, solutions: &Solutions<6>) -> bool {
    let is_alone =
        place.shoulder().is_none_or(|off| arm.opw.b == 0.0 && off > thresholds::SHOULDER_MERGE);
    let flagged = |kind: SingularityKind, off: Option<f64>, threshold: f64| {
        off.is_none_or(|off| {
            solutions.iter().any(|s| s.singularities().contains(kind)) || off > 0.5 * threshold
        })
    };
    let wrist_and_elbow =
        flagged(SingularityKind::WRIST, place.wrist(), thresholds::WRIST_MERGE_SIN)
            && flagged(SingularityKind::ELBOW, place.elbow(), 1e-8);
    (!is_alone || wrist_and_elbow)
        && flagged(SingularityKind::SHOULDER, place.shoulder(), thresholds::SHOULDER_MERGE)
}
