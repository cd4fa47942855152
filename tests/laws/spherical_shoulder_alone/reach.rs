//! Poses beyond the reach of the wrist.

use std::f64::consts::FRAC_PI_2;

use irbkin::{Pose, Reach, thresholds};
use nalgebra::{Rotation3, Unit, Vector3};

use crate::common::poses_or;
use crate::rng::Rng;
use crate::structures::spherical_shoulder::{self, ShoulderArm, hand_of};
use crate::structures::{SEVEN, Subject};

const BEYOND: [f64; 5] = [1e-15, 1e-12, 9e-10, 1e-6, 1e-3];

/// The hand rotated so that the shoulder is nearer to axis 6 than this elbow can bring it.
fn turned(subject: &Subject<7>, q: &[f64; 7], beyond: f64) -> Option<Pose> {
    let pose = subject.robot.fk(q);
    let hand = hand_of(&subject.robot, &pose, q[6]);
    let seen = -(hand.rotation.inverse() * hand.translation.vector);
    let axis = Unit::try_new(seen.cross(&(Vector3::y() * seen.y.signum())), 1e-2)?;
    let turn = Rotation3::from_axis_angle(&axis, -beyond / seen.norm());
    // About the hand, in the world: the position of axes 5 and 6 stays.
    let in_world = hand.rotation * turn * hand.rotation.inverse();
    let about = subject.robot.link_frames(q).0[4].translation.vector;
    let arm = in_world * (pose.translation.vector - about);
    Some(Pose::from_parts((about + arm).into(), in_world * pose.rotation))
}

#[test]
fn beyond_the_reach_of_the_wrist_the_shortfall_is_reported() {
    let arms = [
        ("Panda", ShoulderArm::panda()),
        ("iiwa", ShoulderArm::iiwa()),
        ("oblique", ShoulderArm::oblique()),
        ("onto itself", ShoulderArm::onto_itself()),
    ];
    let mut rng = Rng::new(32);
    for (name, arm) in arms {
        let subject = Subject::new(name, arm.clone(), &SEVEN);
        let (mut judged, mut worst) = (0, 0.0_f64);
        for _ in 0..poses_or(20_000) / 20 {
            let mut theta = rng.angles();
            theta[4] = FRAC_PI_2 * rng.sign();
            let q = arm.q(theta);
            for beyond in BEYOND {
                let Some(pose) = turned(&subject, &q, beyond) else { continue };
                let solutions = subject.ik(&pose, &q);
                let other_elbow = 2 - 2 * ((arm.slot(&theta) >> 1) & 1);
                let of_other = |slot: usize| !solutions.status()[slot].is_empty();
                if (0..8).any(|slot| slot & 2 == other_elbow && of_other(slot)) {
                    continue;
                }
                judged += 1;
                if beyond <= thresholds::REACH_TOLERANCE {
                    assert!(!solutions.is_empty(), "{name}: {beyond:e}");
                    for solution in &solutions {
                        let residual = subject.robot.residual(&solution.q, &pose);
                        worst = worst.max(residual.position - 1.5 * beyond).max(residual.rotation);
                    }
                    continue;
                }
                let reach = solutions.reach();
                assert!(matches!(reach, Reach::TooFar { .. }), "{name}: {reach:?}");
                let shortfall = reach.shortfall();
                // The other elbow may be nearer.
                let is_right = shortfall > 0.0 && shortfall < 1.01 * beyond + 1e-15;
                assert!(is_right, "{name}: {shortfall:e} for {beyond:e}");
            }
        }
        println!("{name}: {judged} judged, residual {worst:e} above 1.5 of the distance");
        assert!(name == "iiwa" || judged > poses_or(20_000) / 20, "{name}: {judged}");
        assert!(worst < 1e-14, "{name}: {worst:e}");
    }
    assert_eq!(spherical_shoulder::structure().subjects.len(), 5);
}
