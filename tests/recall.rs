//! Every joint vector that makes a pose is found again, nothing else is, nothing twice, on many random poses.
//!
//! `make million` runs a million poses and prints the table; `make test` runs fewer.
#![allow(clippy::unwrap_used, missing_docs)]

mod common;

use common::{Rng, apart, reach_of};
use irbkin::{Error, OpwParameters, Robot};

#[derive(Default)]
struct Tally {
    poses: usize,
    lost: usize,
    coarse: usize,
    wrong: usize,
    twice: usize,
    solutions: usize,
    position: f64,
    rotation: f64,
    recall: f64,
}

fn poses() -> usize {
    std::env::var("IRBKIN_POSES").ok().map_or(20_000, |count| count.parse().unwrap())
}

/// Solves random poses inside the limits and holds every answer against forward kinematics.
fn tally(robot: &Robot<6>, reach: f64) -> Tally {
    let mut rng = Rng::new(0x5eed);
    let mut tally = Tally::default();
    for _ in 0..poses() {
        let q = rng.inside(robot.limits());
        let pose = robot.fk(&q);
        let solutions = robot.ik(&pose).unwrap();
        tally.poses += 1;
        tally.solutions += solutions.len();
        let nearest = solutions.iter().map(|solution| apart(&solution.q, &q)).fold(f64::INFINITY, f64::min);
        tally.recall = tally.recall.max(nearest);
        tally.lost += usize::from(nearest > 1e-9 && nearest > rounding_bound(robot, reach, &q));
        tally.coarse += usize::from(nearest > 1e-9);
        for (i, solution) in solutions.iter().enumerate() {
            let residual = robot.residual(&solution.q, &pose);
            tally.position = tally.position.max(residual.position);
            tally.rotation = tally.rotation.max(residual.rotation);
            tally.wrong += usize::from(residual.position > 3e-15 * reach || residual.rotation > 1e-14);
            tally.twice += solutions.iter().skip(i + 1).filter(|other| apart(&other.q, &solution.q) < 1e-9).count();
        }
    }
    tally
}

/// How far rounding of the pose may move the joints: a pose is rounded by its forward kinematics (measured: 1e-15 x reach, 2e-15 rad) and
/// the inverse of the Jacobian turns that into joint angles. Only next to a singularity is this above 1e-9.
fn rounding_bound(robot: &Robot<6>, reach: f64, q: &[f64; 6]) -> f64 {
    4e-15 * (1.0 + reach) / robot.singularity(q).min_singular_value
}

fn check(name: &str, robot: &Robot<6>) {
    let reach = reach_of(robot);
    let Tally { poses, lost, coarse, wrong, twice, solutions, position, rotation, recall } = tally(robot, reach);
    #[expect(clippy::cast_precision_loss, reason = "a mean")]
    let mean = solutions as f64 / poses as f64;
    println!(
        "{name:20} {poses:8} poses  {lost} lost ({coarse} found only to worse than 1e-9 rad)  {wrong} wrong  {twice} twice  {mean:.2} solutions  \
         worst: {position:.1e} m ({:.2e} x reach)  {rotation:.1e} rad  recall {recall:.1e} rad",
        position / reach
    );
    assert_eq!((lost, wrong, twice), (0, 0, 0), "{name}");
}

#[test]
fn every_generating_joint_vector_is_found() {
    for name in ["IRB 2600-12/1.65", "IRB 120-3/0.58", "IRB 140-6/0.81", "IRB 1600-6/1.45", "IRB 6700-150/3.2"] {
        check(name, &Robot::named(name).unwrap());
    }
}

#[test]
fn arms_of_other_makers_lose_nothing() -> Result<(), Error> {
    check("KUKA KR 6 R700", &common::kuka_kr6()?);
    let lateral = OpwParameters { b: 0.05, ..OpwParameters::abb(0.15, -0.11, 0.45, 0.6, 0.64, 0.1) };
    check("lateral offset 50 mm", &Robot::from_opw(lateral)?);
    Ok(())
}
