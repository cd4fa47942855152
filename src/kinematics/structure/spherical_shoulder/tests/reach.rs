//! At and beyond the edges of reach.

use nalgebra::{Rotation3, Unit, Vector3};

use super::*;
use crate::report::Reach;

const BEYOND: [f64; 5] = [1e-15, 1e-12, 9e-10, 1e-6, 1e-3];

/// Holds the answer for a hand that is `beyond` the edge [m].
fn judge(arm: &Arm, hand: &Pose, beyond: f64, far: bool, worst: &mut f64) -> f64 {
    let free = FreeChoice::rest([0.3; 7]);
    let branches = arm.geometry().solve_hand(hand, &free);
    if beyond < 1e-9 {
        assert!(branches.q.iter().flatten().count() > 0, "{}: {beyond:e} {branches:?}", arm.name);
        for q in branches.q.iter().flatten() {
            let off = PoseError::between(&arm.hand_pose(&arm.chain.fk(q), q[6]), hand);
            *worst = worst.max(off.position - 1.5 * beyond).max(off.rotation);
        }
        return beyond;
    }
    let shortfall = match branches.reach {
        Reach::TooFar { shortfall } if far => shortfall,
        Reach::TooNear { shortfall } if !far => shortfall,
        reach => panic!("{}: {reach:?}", arm.name),
    };
    assert_eq!(branches.q, [None; SLOTS]);
    shortfall
}

#[test]
fn beyond_the_stretched_arm_and_inside_the_folded_one_the_shortfall_is_told() {
    let mut rng = Rng::new(31);
    let mut worst = 0.0;
    for arm in arms() {
        let links = arm.geometry().links;
        let nearest = (links.upper - links.forearm).abs();
        for (elbow, sign) in [(0.0, 1.0), (PI, -1.0)] {
            for beyond in BEYOND.into_iter().filter(|beyond| sign > 0.0 || *beyond < nearest) {
                for _ in 0..poses(20_000) / 100 {
                    let mut theta = arm.geometry().theta(&rng.anywhere());
                    theta[3] += elbow - links.elbow_angle(theta[3]);
                    let q = arm.geometry().placement.joints(theta);
                    let mut hand = arm.hand_pose(&arm.chain.fk(&q), q[6]);
                    hand.translation.vector *= 1.0 + sign * beyond / hand.translation.vector.norm();
                    let shortfall = judge(&arm, &hand, beyond, sign > 0.0, &mut worst);
                    assert!(
                        (shortfall - beyond).abs() < 1e-15,
                        "{}: {shortfall:e} for {beyond:e}",
                        arm.name
                    );
                }
            }
        }
    }
    std::println!(
        "beyond stretched and folded: the residual is 1.5 of the distance at most, and {worst:e}"
    );
    assert!(worst < 1e-14);
}

#[test]
fn beyond_the_turn_of_the_wrist_the_shortfall_is_told() {
    let mut rng = Rng::new(32);
    let mut worst = 0.0;
    for arm in arms() {
        let mut judged = 0;
        for _ in 0..poses(20_000) / 20 {
            let mut theta = arm.geometry().theta(&rng.anywhere());
            theta[4] = FRAC_PI_2 * rng.sign();
            let q = arm.geometry().placement.joints(theta);
            let hand = arm.hand_pose(&arm.chain.fk(&q), q[6]);
            let seen = -(hand.rotation.inverse() * hand.translation.vector);
            let Some(axis) = Unit::try_new(seen.cross(&(Vector3::y() * seen.y.signum())), 1e-2)
            else {
                continue;
            };
            for beyond in BEYOND {
                // The hand turned so that the shoulder is nearer to axis 6 than this elbow can bring it.
                let turned = Pose::from_parts(
                    hand.translation,
                    hand.rotation * Rotation3::from_axis_angle(&axis, -beyond / seen.norm()),
                );
                let far = arm.geometry().solve_hand(&turned, &FreeChoice::rest(q));
                let other_elbow = 2 - 2 * ((arm.slot_of(&q) >> 1) & 1);
                if far.exists(other_elbow) || far.exists(other_elbow + 1) {
                    continue;
                }
                judged += 1;
                // The other elbow may be nearer.
                let shortfall = judge(&arm, &turned, beyond, true, &mut worst);
                assert!(
                    shortfall > 0.0 && shortfall < 1.01 * beyond + 1e-15,
                    "{}: {shortfall:e} for {beyond:e}",
                    arm.name
                );
            }
        }
        assert!(arm.name == "iiwa" || judged > 1000, "{}: {judged}", arm.name);
    }
    std::println!("beyond the wrist: the residual is 1.5 of the distance at most, and {worst:e}");
    assert!(worst < 1e-14);
}
