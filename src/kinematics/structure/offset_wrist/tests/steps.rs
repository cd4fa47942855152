//! Laws of the step of joint 6 alone (eq. 138 to 142).

use std::vec::Vec;

use super::turns::{area, sigma};
use super::*;

/// The configurations to which the branches next to the joint vector step from so far beside it
/// [rad], with the size of the determinant before the step [m^3].
fn stepped(arm: &OffsetWrist, q: &[f64; 6], beside: f64) -> Vec<([f64; 6], f64)> {
    let Constants { lengths, twists, .. } = &arm.constants;
    let frame = Frame::of(&arm.chain.fk(q));
    let (sin, cos) = (q[5] + beside).sin_cos();
    let hand = Hand::of(lengths, &frame).moving([sin, cos]);
    let branch = |[shoulder, elbow]: &[f64; 2]| {
        Plane::of(lengths, hand.at, *shoulder).with_elbow(lengths, *elbow, 1e-12)
    };
    let step = |branch: Branch<f64>| {
        let Stepped { branch, sin_cos_6, determinant } = branch.stepped(lengths, &hand, [sin, cos]);
        (angles(&branch.joints(lengths, &frame, sin_cos_6, twists)), determinant)
    };
    SIDES.iter().map(branch).filter(|branch| branch.off.abs() < 1e-2).map(step).collect()
}

/// The nearest of these to a joint vector: how far it is, and its determinant.
fn nearest(found: &[([f64; 6], f64)], q: &[f64; 6]) -> [f64; 2] {
    let each = found.iter().map(|(theta, determinant)| [apart(theta, q), *determinant]);
    each.min_by(|a, b| a[0].total_cmp(&b[0])).unwrap()
}

/// Joint vectors so far from det J = 0, relative to the cube of the lengths, and ten times as far
/// from where two branches meet, relative to their square.
fn regular(arm: &OffsetWrist, seed: u64, least: f64) -> impl Iterator<Item = [f64; 6]> {
    let reach = arm.constants.closure.reach;
    joints(seed).take(2000).filter(move |q| {
        let meets = (sigma(arm, q) * reach).abs().min(area(arm, q).abs());
        arm.determinant(q).abs() > least * reach.powi(3) && meets > 10.0 * least * reach * reach
    })
}

#[test]
fn the_determinant_is_that_of_the_jacobian() {
    for (name, arm) in arms() {
        let (mut worst, mut count) = (0.0_f64, 0);
        for q in regular(&arm, 6, 1e-4) {
            let expected = arm.determinant(&q).abs();
            let [_, determinant] = nearest(&stepped(&arm, &q, 0.0), &q);
            worst = worst.max((determinant - expected).abs() / expected);
            count += 1;
        }
        std::println!("{name}: {worst:e} of {count}");
        // Some roundings, over the 1e-4 that are left of the determinant, and a margin.
        assert!(worst < 1e-9 && count > 500, "{name}: {worst:e} of {count}");
    }
}

#[test]
fn what_a_step_leaves_is_the_square_of_what_was_missing() {
    for (name, arm) in arms() {
        let (mut worst, mut count) = ([0.0_f64; 2], 0);
        for q in regular(&arm, 7, 1e-3) {
            for (worst, beside) in worst.iter_mut().zip([1e-4, 1e-8]) {
                *worst = worst.max(nearest(&stepped(&arm, &q, beside), &q)[0]);
            }
            count += 1;
        }
        std::println!("{name}: {worst:?} of {count}");
        // The square of 1e-4, over the 1e-3 that are left of the determinant, and a margin of ten.
        assert!(worst[0] < 1e-4 && worst[1] < 1e-12 && count > 500, "{name}: {worst:?} of {count}");
    }
}
