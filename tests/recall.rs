//! Every joint vector that makes a pose is found, with no incorrect and no duplicate solution, for
//! many random poses.
//!
//! One by one and in a batch. `make evidence SUITE=million` runs a million poses on each
//! instruction set and prints the table; `make test` runs fewer.

use std::f64::consts::PI;

use irbkin::{JointLimits, Pose, Robot, SingularityKind, Status, pose};

use crate::common::tally::Tally;
use crate::common::{Rng, apart, poses_or};
use crate::structures::{self, Structure, Subject};

crate::structures::on_every_structure!(every_generating_joint_vector_is_found);
crate::structures::on_structures_of_ordinals!(every_generating_joint_vector_is_found);

/// Poses per batch: a million at once would take half a gigabyte. Not a multiple of any lane count.
const PART: usize = 1003;

fn every_generating_joint_vector_is_found<const N: usize>(structure: &Structure<N>) {
    let report: String = structure.subjects.iter().map(check).collect();
    assert!(report.is_empty(), "{report}");
}

#[test]
fn other_arms_of_abb_miss_no_solution() {
    for name in ["IRB 140-6/0.81", "IRB 1600-6/1.45", "IRB 6700-150/3.2", "IRB 2400-10/1.55"] {
        let robot: Robot<6> = Robot::named(name).unwrap();
        // As it is, with its axes coupled or not.
        let report = check(&structures::spherical_wrist::named(name).with_robot(|_| robot));
        assert!(report.is_empty(), "{report}");
    }
}

#[test]
fn the_largest_arm_of_universal_robots_misses_no_solution() {
    let report = check(&structures::three_parallel::named("UR20"));
    assert!(report.is_empty(), "{report}");
}

/// Prints what is found of an arm; returns what is not as it must be.
fn check<const N: usize>(subject: &Subject<N>) -> String {
    // Limits of more than a turn: each pose would be drawn as often with full turns as without.
    let is_wide = |[low, high]: &[f64; 2]| high - low > 3.9 * PI;
    let subject = if subject.robot.limits().to_array().iter().all(is_wide) {
        let half_turns = JointLimits::new([[-PI, PI]; N]).unwrap();
        subject.clone().with_robot(|robot| robot.with_limits(half_turns))
    } else {
        subject.clone()
    };
    let mut reports = String::new();
    for (way, tally) in ["one by one", "in a batch"].iter().zip(tallies(&subject)) {
        reports += &tally.row(&subject.name, way);
        println!(
            "    {} found only to worse than 1e-9 rad, the worst {:.1e} rad; position {:.2e} x \
             reach",
            tally.coarse,
            tally.recall,
            tally.position / subject.reach()
        );
        // Of arms without a closed form, one pose in 10^4 may say that it is not certain; fewer
        // than three are no rate.
        if tally.uncertain > 2 + tally.poses / 10_000 {
            let uncertain = tally.uncertain.to_string();
            reports.extend([&subject.name, " ", way, ": ", &uncertain, " uncertain\n"]);
        }
    }
    reports
}

/// Solves random poses inside the limits, one by one and in batches.
fn tallies<const N: usize>(subject: &Subject<N>) -> [Tally; 2] {
    let mut rng = Rng::new(0x5eed);
    let [mut alone, mut together] = [Tally::default(), Tally::default()];
    let mut left = poses_or(if subject.has_ordinals() { 3_000 } else { 20_000 });
    while left > 0 {
        let joints: Vec<_> =
            (0..left.min(PART)).map(|_| rng.inside(subject.robot.limits())).collect();
        let poses: Vec<_> = joints.iter().map(|q| subject.robot.fk(q)).collect();
        let answers = solved_together(subject, &poses, &joints);
        for ((q, pose), answers) in joints.iter().zip(&poses).zip(answers) {
            let solutions = subject.ik(pose, q);
            let solved =
                solutions.iter().map(|s| (usize::from(s.slot), s.q, s.singularities())).collect();
            let solved = (solved, solutions.is_certified());
            take(&mut alone, subject, q, pose, &solved);
            take(&mut together, subject, q, pose, &answers);
        }
        left -= joints.len();
    }
    [alone, together]
}

/// A solution: its slot, its joint angles, the reported singularities.
type Answer<const N: usize> = (usize, [f64; N], SingularityKind);

/// The solutions of a pose, and whether they are certified.
type Answers<const N: usize> = (Vec<Answer<N>>, bool);

/// The solutions of each pose of a batch.
fn solved_together<const N: usize>(
    subject: &Subject<N>,
    poses: &[Pose],
    joints: &[[f64; N]],
) -> Vec<Answers<N>> {
    let rows: Vec<f64> = poses.iter().flat_map(pose::to_rows).collect();
    let slots = subject.robot.slot_count();
    let (mut q, mut status) = (vec![[0.0; N]; slots * poses.len()], vec![0; slots * poses.len()]);
    (subject.calls.ik_rows)(&subject.robot, &rows, joints, q.as_flattened_mut(), &mut status, 1)
        .unwrap();
    let found = |(slot, (q, flags)): (usize, (&[f64; N], &u8))| {
        let status = Status::from_bits_retain(*flags);
        status.contains(Status::FOUND).then_some((slot, *q, status.singularities()))
    };
    let of_a_pose = |(q, status): (&[[f64; N]], &[u8])| {
        let is_certified = !Status::from_bits_retain(status[0]).contains(Status::UNCERTIFIED);
        (q.iter().zip(status).enumerate().filter_map(found).collect(), is_certified)
    };
    q.chunks(slots).zip(status.chunks(slots)).map(of_a_pose).collect()
}

/// Judges the answers for a pose by forward kinematics, by the joint vector that made it and by its
/// slots and flags.
fn take<const N: usize>(
    tally: &mut Tally,
    subject: &Subject<N>,
    q: &[f64; N],
    pose: &Pose,
    (answers, is_certified): &Answers<N>,
) {
    let before = tally.amiss();
    // Singular values take longer than everything else.
    let sampled = tally.poses.is_multiple_of(8);
    // Newton's steps on a closure end where one is not better than the last.
    let roundings = if subject.has_ordinals() { 1e-14 } else { 3e-15 };
    let bounds = [roundings * subject.reach(), 1e-14];
    tally.take_residuals(&subject.robot, pose, answers.iter().map(|(_, q, _)| (q, bounds)));
    let nearest =
        answers.iter().map(|(_, answer, _)| apart(answer, q)).fold(f64::INFINITY, f64::min);
    tally.recall = tally.recall.max(nearest);
    let is_found = nearest <= 1e-9 || nearest <= rounding_bound(subject, q);
    tally.found += usize::from(is_found);
    tally.uncertain += usize::from(!is_found && !is_certified);
    tally.coarse += usize::from(nearest > 1e-9);
    for (i, (slot, answer, kinds)) in answers.iter().enumerate() {
        tally.duplicates +=
            answers.iter().skip(i + 1).filter(|(_, other, _)| apart(other, answer) < 1e-9).count();
        // This near a singularity, rounding decides.
        let is_clear = |answer| subject.clearance(answer) > 1e-6;
        let is_elsewhere = || !subject.has_ordinals() && *slot != subject.slot(answer);
        tally.incorrect += usize::from(is_elsewhere() && is_clear(answer));
        let is_flagged = || *kinds == subject.robot.singularity(answer).kinds;
        tally.flags += usize::from(sampled && is_clear(answer) && !is_flagged());
    }
    if tally.amiss() > before && tally.example.is_none() {
        tally.example = Some(format!("q = {q:?}, nearest {nearest:e}: {answers:?}"));
    }
}

/// How far rounding of the pose may move the joints: a pose is rounded by its forward kinematics
/// (measured: 1e-15 x reach, 2e-15 rad), and the inverse of the Jacobian of the solved joints
/// converts that to joint angles. Only near a singularity is this above 1e-9.
fn rounding_bound<const N: usize>(subject: &Subject<N>, q: &[f64; N]) -> f64 {
    3.5e-15 * (1.0 + subject.reach()) / subject.least_singular_value(q)
}
