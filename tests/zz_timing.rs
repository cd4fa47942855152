#![allow(missing_docs, clippy::all)]
mod common;
use common::Rng;
use irbkin::*;
use std::time::Instant;
fn iiwa() -> Robot<7> {
    let rows = [
        [0.0, 0.0, 0.36, 0.0],
        [-90.0, 0.0, 0.0, 0.0],
        [90.0, 0.0, 0.42, 0.0],
        [90.0, 0.0, 0.0, 0.0],
        [-90.0, 0.0, 0.4, 0.0],
        [-90.0, 0.0, 0.0, 0.0],
        [90.0, 0.0, 0.126, 0.0f64],
    ];
    let rows = rows.map(|[alpha, a, d, theta]| DhRow::new(alpha.to_radians(), a, d, theta));
    let limits = [170.0, 120.0, 170.0, 120.0, 170.0, 120.0, 175.0_f64]
        .map(|l| [-l.to_radians(), l.to_radians()]);
    Robot::from_mdh(Mdh { base: Pose::identity(), rows, flange: Pose::identity() })
        .unwrap()
        .with_limits(JointLimits::new(limits).unwrap())
}
#[test]
fn timing() {
    let arms = [
        ("Panda", Robot::<7>::named("Panda").unwrap()),
        ("FR3", Robot::named("FR3").unwrap()),
        ("iiwa", iiwa()),
    ];
    for (name, robot) in &arms {
        for noise in [0.01, 0.3, 10.0, 99.0] {
            let mut rng = Rng::new(7);
            let (mut sum, mut worst, mut cost, n) = (0.0, 0.0f64, 0.0, 1500);
            for _ in 0..n {
                let q = rng.inside(robot.limits());
                let seed: [f64; 7] = if noise > 5.0 {
                    rng.inside(robot.limits())
                } else {
                    q.map(|a| a + rng.between(-noise, noise))
                };
                let pose = robot.fk(&q);
                let pose = if noise > 50.0 {
                    let mut p = pose;
                    p.translation.vector *= 1.5;
                    p
                } else {
                    pose
                };
                let start = Instant::now();
                let found = robot.ik_nearest(&pose, &seed, &[1.0; 7]);
                let t = start.elapsed().as_secs_f64() * 1e3;
                sum += t;
                worst = worst.max(t);
                if let Ok(s) = found {
                    cost +=
                        s.q.iter().zip(&seed).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt();
                }
            }
            println!(
                "{name} noise {noise}: mean {:.3} ms worst {worst:.1} ms  mean distance {:.9}",
                sum / n as f64,
                cost / n as f64
            );
        }
    }
}
