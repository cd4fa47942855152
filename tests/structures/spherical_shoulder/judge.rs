//! Judges answers at and near the singularities of an arm with a spherical shoulder.

use irbkin::{Robot, SingularityKind, Solution, Solutions, Status, thresholds};

use super::ShoulderArm;
use crate::common::apart;
use crate::rng::Rng;
use crate::structures::place::{Made, Verdict};

const SLOTS: usize = 8;

/// With a larger uncertainty, a joint is not determined by the pose [rad].
const UNDETERMINED: f64 = 0.1;

pub(super) fn judge(
    arm: &ShoulderArm,
    robot: &Robot<7>,
    made: &Made<7>,
    solutions: &Solutions<7>,
    rng: &mut Rng,
) -> Verdict {
    let duplicates = solutions.iter().enumerate().map(|(i, one)| {
        solutions.iter().skip(i + 1).filter(|other| apart(&one.q, &other.q) < 1e-9).count()
    });
    let duplicates = duplicates.sum();
    if made.beyond > 0.0 {
        return Verdict { found: !solutions.is_empty(), incorrect: 0, duplicates, flagged: true };
    }
    let opened =
        solutions.iter().filter(|solution| !self_motion_closes(robot, made, solution)).count();
    let q7 = made.q[6];
    let beside: [f64; 7] = std::array::from_fn(|i| made.q[i] + rng.between(-1e-4, 1e-4));
    let beside = [beside[0], beside[1], beside[2], beside[3], beside[4], beside[5], q7];
    let neighbor = robot.ik(&robot.fk(&beside), q7).unwrap();
    Verdict {
        found: solutions.iter().any(|solution| is_found(arm, robot, made, solution))
            || is_kept(arm, robot, made),
        incorrect: opened + usize::from(differ(arm, robot, made, [solutions, &neighbor])),
        duplicates,
        flagged: solutions.iter().all(|solution| is_flagged(arm, robot, solution)),
    }
}

/// Whether a solution, or the one of its self-motion that has the joints of the arm that made the
/// pose, is that arm's branch.
fn is_found(arm: &ShoulderArm, robot: &Robot<7>, made: &Made<7>, solution: &Solution<7>) -> bool {
    let bounds = arm.bounds(&made.theta, thresholds::SHOULDER_MERGE);
    let mut moved = *solution;
    for _ in 0..3 {
        if ShoulderArm::is_branch(&arm.theta(&moved.q), &made.theta, &bounds) {
            return true;
        }
        let Some(free) = moved.free_joint else { return false };
        match robot.with_free_joint(&made.pose, &moved, made.q[free.joint() - 1]) {
            Ok(Some(next)) => moved = next,
            _ => return false,
        }
    }
    false
}

/// Whether the solve that has the joint vector for a seed finds its branch. Where the pose leaves
/// several joints open at once, no solution declares them all, and another branch may be as near.
fn is_kept(arm: &ShoulderArm, robot: &Robot<7>, made: &Made<7>) -> bool {
    let Ok(kept) = robot.ik_nearest(&made.pose, &made.q, &[1.0; 7]) else { return false };
    let bounds = arm.bounds(&made.theta, thresholds::SEEDED_FREE);
    let is_undetermined = arm.bounds(&made.theta, 0.0).iter().any(|bound| *bound > UNDETERMINED);
    let residual = robot.residual(&kept.q, &made.pose).largest();
    residual <= 4.0 * thresholds::SEEDED_FREE
        && (is_undetermined || ShoulderArm::is_branch(&arm.theta(&kept.q), &made.theta, &bounds))
}

/// Whether a solution whose free joint is given another angle is one of the pose, to twice the
/// distance from the singularity.
fn self_motion_closes(robot: &Robot<7>, made: &Made<7>, solution: &Solution<7>) -> bool {
    let Some(free) = solution.free_joint else { return true };
    let Ok(Some(moved)) = robot.with_free_joint(&made.pose, solution, 0.7) else { return false };
    (moved.q[free.joint() - 1] - 0.7).abs() < 1e-15
        && robot.residual(&moved.q, &made.pose).largest() < 4e-9
}

/// Whether two answers have different slots, but for those where the wrist of an elbow that is not
/// that of the pose is at its edge.
fn differ(
    arm: &ShoulderArm,
    robot: &Robot<7>,
    made: &Made<7>,
    answers: [&Solutions<7>; 2],
) -> bool {
    let elbow_distance = robot.singularity(&made.q).distances.unwrap().elbow;
    let exists = |answer: &Solutions<7>, slot: usize| {
        answer.status()[slot].intersects(Status::FOUND | Status::MERGED)
    };
    let own = arm.slot(&made.theta) & 2;
    (0..SLOTS).any(|slot| {
        let edge = answers.iter().any(|answer| {
            answer.iter().any(|solution| {
                let same_elbow = (solution.slot.index() ^ slot) & 2 == 0;
                same_elbow && arm.aside(&arm.theta(&solution.q)).abs() < 0.02
            })
        });
        let excused =
            edge && slot & 2 != own || elbow_distance < 0.01 && arm.aside(&made.theta).abs() < 0.02;
        exists(answers[0], slot) != exists(answers[1], slot) && !excused
    })
}

/// Whether the singularities that a solution is at are flagged, and its slot is its own but for the
/// bits that are open.
fn is_flagged(arm: &ShoulderArm, robot: &Robot<7>, solution: &Solution<7>) -> bool {
    let bits =
        [(SingularityKind::SHOULDER, 4), (SingularityKind::ELBOW, 2), (SingularityKind::WRIST, 1)];
    let open: usize = bits
        .iter()
        .filter(|(kind, _)| solution.singularities().contains(*kind))
        .map(|(_, bit)| bit)
        .sum();
    let flagged = solution.singularities() | edge_of_merging(arm, robot, &solution.q);
    let slot = arm.slot(&arm.theta(&solution.q));
    flagged.contains(robot.singularity(&solution.q).kinds)
        && (slot ^ solution.slot.index()) & !open == 0
}

/// The wrist and the elbow where they are about as far from singular as still merges: rounding
/// decides.
fn edge_of_merging(arm: &ShoulderArm, robot: &Robot<7>, q: &[f64; 7]) -> SingularityKind {
    let theta = arm.theta(q);
    let elbow = arm.elbow(theta[3]);
    let (across, aside) = (elbow.across.abs(), arm.aside(&theta).abs());
    let rho = aside.hypot(elbow.along);
    let ratio = aside * aside / (2.0 * arm.position_rounding() * across.min(rho));
    let elbow = robot.singularity(q).distances.unwrap().elbow;
    let mut edge = SingularityKind::empty();
    edge.set(SingularityKind::WRIST, (0.1..10.0).contains(&ratio));
    edge.set(SingularityKind::ELBOW, (1e-8..1e-6).contains(&elbow));
    edge
}
