//! The number of solutions, found in another way: by turning joint 6 until the arm closes.

use std::f64::consts::TAU;

use irbkin::Pose;
use nalgebra::Vector3;

use crate::common::poses_or;
use crate::rng::Rng;
use crate::structures::spherical_shoulder::{ShoulderArm, hand_of};
use crate::structures::{SEVEN, Subject};

/// Length of the upper arm that each angle of joint 6 would need, with the elbow on one or the
/// other side of axis 5, minus its length [m].
fn closures(arm: &ShoulderArm, hand: &Pose, theta_6: f64) -> [f64; 2] {
    let ShoulderArm { a4, c5, .. } = *arm;
    let (sin, cos) = theta_6.sin_cos();
    // Axis 5 is z of the hand turned back by joint 6.
    let axis_5 = hand.rotation * Vector3::new(-sin, 0.0, cos);
    let foot = hand.translation.vector - axis_5 * c5;
    let aside = -foot - axis_5 * axis_5.dot(&-foot);
    let towards = aside / aside.norm();
    [1.0, -1.0].map(|side| (foot - towards * (side * a4)).norm() - arm.upper())
}

/// The number of angles of joint 6 that close the arm; `None` if two cannot be distinguished from
/// none.
fn turns_that_close(arm: &ShoulderArm, hand: &Pose) -> Option<usize> {
    const STEPS: i32 = 2000;
    let angle = |step: i32| TAU * f64::from(step) / f64::from(STEPS);
    let mut crossings = 0;
    for side in 0..2 {
        let at = |theta_6: f64| closures(arm, hand, theta_6)[side];
        for step in 0..STEPS {
            let [before, here, next] = [step - 1, step, step + 1].map(|step| at(angle(step)));
            crossings += usize::from((here < 0.0) != (next < 0.0));
            if here.abs() > before.abs()
                || here.abs() > next.abs()
                || (before < 0.0) != (next < 0.0)
                || (here < 0.0) != (next < 0.0)
            {
                continue;
            }
            // Two may be hidden where the closure turns back towards zero.
            let nearest =
                least(|theta_6| at(theta_6) * here.signum(), angle(step - 1), angle(step + 1));
            if nearest.abs() < 1e-10 {
                return None;
            }
            crossings += if nearest < 0.0 { 2 } else { 0 };
        }
    }
    Some(crossings)
}

/// The least value of a function with one valley.
fn least(value: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    for _ in 0..80 {
        let third = (high - low) / 3.0;
        if value(low + third) < value(high - third) { high -= third } else { low += third }
    }
    value(0.5 * (low + high))
}

#[test]
fn there_are_no_other_solutions() {
    let mut rng = Rng::new(8);
    let arms = [
        ("Panda", ShoulderArm::panda()),
        ("oblique", ShoulderArm::oblique()),
        ("onto itself", ShoulderArm::onto_itself()),
    ];
    for (name, arm) in arms {
        let subject = Subject::new(name, arm.clone(), &SEVEN);
        let (mut by_count, mut unsure) = ([0_usize; 9], 0);
        let count = poses_or(20_000) / 20;
        for _ in 0..count {
            let q = rng.angles();
            let pose = subject.robot.fk(&q);
            let solutions = subject.ik(&pose, &q);
            let Some(expected) = turns_that_close(&arm, &hand_of(&subject.robot, &pose, q[6]))
            else {
                unsure += 1;
                continue;
            };
            let found = solutions.len();
            assert_eq!(found, 2 * expected, "{name}: {q:?}\n{solutions:#?}");
            by_count[found] += 1;
        }
        println!("{name}: poses by number of solutions {by_count:?}, not counted {unsure}");
        assert!(unsure <= count / 50, "{unsure} of {count} were not counted");
    }
}
