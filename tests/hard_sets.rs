//! Poses at and near every singularity: each branch is found, no solution is incorrect, none is a
//! duplicate. Poses slightly out of reach: no solution, and the correct shortfall.
//!
//! `make evidence SUITE=hardsets` prints one row per set with more poses; `make test` runs fewer.

use irbkin::thresholds;

use crate::common::tally::Tally;
use crate::common::{Rng, asked_set, poses_or};
use crate::structures::place::{At, Made, Place};
use crate::structures::{Structure, Subject};

crate::structures::on_every_structure!(
    every_branch_is_found_at_and_near_singularities,
    beyond_reach_there_is_no_solution_and_the_shortfall_is_correct,
);

/// Distances from a singularity, around the thresholds at which branches merge [rad, m].
const NEAR: [f64; 8] = [0.0, 1e-12, 1e-9, 2e-9, 1e-7, 1e-6, 1e-5, 1e-4];
const BEYOND: [f64; 5] = [1e-15, 1e-12, 9e-10, 1e-6, 1e-3];

/// Poses per set: one singularity, two of them, three.
fn poses() -> [usize; 3] {
    let of_one = poses_or(60);
    [of_one, of_one.div_ceil(2), of_one.div_ceil(4)]
}

/// Draws that may fail before a place counts as one that the arm cannot reach.
const MISSES: usize = 2000;

fn every_branch_is_found_at_and_near_singularities<const N: usize>(structure: &Structure<N>) {
    asked_set();
    let mut report = String::new();
    for subject in &structure.subjects {
        let subject = unlimited(subject);
        let mut rng = Rng::new(7);
        for posture in subject.arm.postures() {
            let draw = |rng: &mut Rng| (posture.draw)(rng);
            let tally = run(&subject, &posture.place, poses()[0], draw, &mut rng);
            report += &tally.row(&subject.name, posture.name);
        }
        let mut attained = 0;
        for place in places(subject.arm.singular_places()) {
            let count = poses()[place.0.len() - 1];
            let tally = run(&subject, &place, count, |rng| subject.arm.at(&place, rng), &mut rng);
            attained += usize::from(tally.poses > 0);
            if tally.poses > 0 {
                report += &tally.row(&subject.name, &place.name());
            }
        }
        // Every arm can attain wrist, shoulder and one elbow, alone and in pairs.
        assert!(attained >= 3 * NEAR.len() + 3 * NEAR.len().pow(2), "{}: {attained}", subject.name);
    }
    assert!(report.is_empty(), "\n{report}");
}

/// The arm without limits, base and tool.
fn unlimited<const N: usize>(subject: &Subject<N>) -> Subject<N> {
    subject.clone().with_robot(|_| subject.arm.robot())
}

/// Every singularity, every two that belong to different joints and, at one distance, every three.
fn places(singular: &[At]) -> Vec<Place> {
    let is_joint_4 = |at: At| !matches!(at, At::Wrist | At::Shoulder);
    let mut places = Vec::new();
    for (i, one) in singular.iter().enumerate() {
        places.extend(NEAR.map(|off| Place::of(*one, off)));
        for two in &singular[..i] {
            if is_joint_4(*one) && is_joint_4(*two) {
                continue;
            }
            // Of two, the elbow's comes first: it may place the wrist too.
            for (a, b) in NEAR.iter().flat_map(|a| NEAR.map(|b| (*a, b))) {
                places.push(Place(vec![(*one, a), (*two, b)]));
            }
        }
        if is_joint_4(*one) {
            for (off, wrist) in NEAR.iter().flat_map(|a| NEAR.map(|b| (*a, b))) {
                places.push(Place(vec![(*one, off), (At::Wrist, wrist), (At::Shoulder, off)]));
            }
        }
    }
    places
}

fn run<const N: usize>(
    subject: &Subject<N>,
    place: &Place,
    count: usize,
    draw: impl Fn(&mut Rng) -> Option<[f64; N]>,
    rng: &mut Rng,
) -> Tally {
    let mut tally = Tally::default();
    let mut misses = 0;
    while tally.poses < count && misses < MISSES {
        let Some(theta) = draw(rng) else {
            misses += 1;
            continue;
        };
        let made = Made::new(&subject.robot, place, theta, subject.arm.q(theta));
        judge(subject, &made, &mut tally, rng);
    }
    tally
}

fn judge<const N: usize>(subject: &Subject<N>, made: &Made<N>, tally: &mut Tally, rng: &mut Rng) {
    let before = tally.amiss();
    let solutions = subject.ik(&made.pose, &made.q);
    let position =
        subject.arm.spread() * made.beyond + subject.arm.singular_residual() * subject.reach();
    let answers = solutions.iter().map(|solution| {
        let [beyond, turned] = subject.arm.beyond_in(&subject.robot, made, solution);
        (&solution.q, [position.max(beyond + position), 1e-14 + turned])
    });
    tally.take_residuals(&subject.robot, &made.pose, answers);
    let verdict = subject.arm.judge(&subject.robot, made, &solutions, rng);
    tally.found += usize::from(verdict.found);
    tally.incorrect += verdict.incorrect;
    tally.duplicates += verdict.duplicates;
    tally.flags += usize::from(!verdict.flagged);
    if tally.amiss() > before && tally.example.is_none() {
        let slots: Vec<_> = solutions.iter().collect();
        let example =
            format!("{verdict:?} of q = {:?}, theta = {:?}: {slots:#?}", made.q, made.theta);
        tally.example = Some(example);
    }
}

/// Up to a nanometer beyond reach the arm is stretched or folded, off by no more than that; farther
/// out there is no solution, and the correct shortfall.
fn beyond_reach_there_is_no_solution_and_the_shortfall_is_correct<const N: usize>(
    structure: &Structure<N>,
) {
    asked_set();
    let mut report = String::new();
    for subject in &structure.subjects {
        let subject = unlimited(subject);
        let mut rng = Rng::new(8);
        for beyond in BEYOND {
            let mut tally = Tally::default();
            while tally.poses < poses()[0] {
                let Some(made) = subject.arm.beyond(beyond, &mut rng) else { continue };
                if beyond <= thresholds::REACH_TOLERANCE {
                    judge(&subject, &made, &mut tally, &mut rng);
                } else {
                    let bound = 3e-15 * (1.0 + subject.reach());
                    tally.take_missed(&subject.ik(&made.pose, &made.q), beyond, bound);
                }
            }
            report += &tally.row(&subject.name, &format!("beyond reach by {beyond:e} m"));
        }
    }
    assert!(report.is_empty(), "\n{report}");
}
