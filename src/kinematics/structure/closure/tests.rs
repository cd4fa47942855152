//! Laws of the closure: candidates converge, folds are one or two, self-motions stand once.
#![allow(clippy::cast_precision_loss, clippy::unreadable_literal, clippy::too_many_lines)]

use core::f64::consts::FRAC_PI_2;

use super::*;
use crate::kinematics::chain::dh::DhRow;
use crate::lanes::LANES;
use crate::rng::Rng;

/// A planar elbow under a wrist with three axes that meet: folds where theta_3 = 0, self-motions
/// where theta_5 = 0.
fn elbow() -> Closure {
    Closure::of(&[
        DhRow::new(0.0, 0.0, 0.4, 0.0),
        DhRow::new(-FRAC_PI_2, 0.1, 0.0, 0.0),
        DhRow::new(0.0, 0.7, 0.0, 0.0),
        DhRow::new(-FRAC_PI_2, 0.0, 0.6, 0.0),
        DhRow::new(FRAC_PI_2, 0.0, 0.0, 0.0),
        DhRow::new(-FRAC_PI_2, 0.0, 0.0, 0.0),
    ])
}

fn random(rng: &mut Rng) -> Closure {
    Closure::of(&core::array::from_fn(|_| {
        let (a, d) = (rng.between(-0.5, 0.5), rng.between(-0.5, 0.5));
        DhRow::new(rng.between(0.4, 2.7) * rng.sign(), a, d, 0.0)
    }))
}

/// Candidates around a configuration, converged and taken.
fn found(closure: &Closure, target: &Target, around: &[f64; 6], off: f64) -> Accepted {
    let mut rng = Rng::new(3);
    let mut accepted = Accepted::new();
    let mut theta = [[0.0; LANES]; 6];
    for lane in 0..LANES {
        for joint in 0..6 {
            theta[joint][lane] = around[joint] + rng.between(-off, off);
        }
    }
    let candidates = closure.converged(target, &theta);
    accepted.take(closure, target, &candidates, LANES);
    accepted
}

#[test]
fn candidates_converge_to_one_solution() {
    let mut rng = Rng::new(1);
    let mut singular = 0;
    for _ in 0..2000 {
        let closure = random(&mut rng);
        let theta: [f64; 6] = rng.angles();
        let target = closure.reached(&theta);
        let accepted = found(&closure, &target, &theta, 1e-4);
        let nearest =
            accepted.as_slice().iter().map(|one| one.distance(&theta)).fold(9.0, f64::min);
        let (jacobian, _) = closure.linear(&target, &theta);
        let least = jacobian.singular_values()[5];
        singular += usize::from(least < 3e-3);
        assert!(nearest < 1e-13 / least + 1e-7, "{nearest:e} {least:e} {accepted:?}");
        assert!(least < 3e-3 || accepted.as_slice().len() == 1, "{least:e} {accepted:?}");
        for one in accepted.as_slice() {
            assert!(one.residual <= closure.accepts());
        }
    }
    assert!(singular < 200, "{singular}");
}

#[test]
fn candidates_from_afar_close_to_rounding() {
    let mut rng = Rng::new(6);
    let mut taken = 0;
    for _ in 0..5000 {
        let closure = random(&mut rng);
        let theta: [f64; 6] = rng.angles();
        let target = closure.reached(&theta);
        // Some of them need all steps.
        for one in found(&closure, &target, &theta, 0.7).as_slice() {
            taken += 1;
            assert!(one.residual <= closure.rounding, "{one:?}");
        }
    }
    assert!(taken > 5000, "{taken}");
}

#[test]
fn the_least_singular_value_is_estimated() {
    let mut rng = Rng::new(2);
    for _ in 0..1000 {
        let closure = random(&mut rng);
        let theta: [f64; 6] = rng.angles();
        let target = closure.reached(&theta);
        let candidates = closure.converged(&target, &theta.map(|angle| [angle; LANES]));
        let (jacobian, _) = closure.linear(&target, &theta);
        let least = jacobian.singular_values()[5];
        let ratio = candidates.least[0] / least;
        assert!(ratio > 0.99 && ratio < 5.0, "{ratio}");
    }
}

#[test]
fn two_solutions_next_to_a_fold_are_two_and_at_it_one() {
    let mut rng = Rng::new(4);
    let closure = elbow();
    for off in [0.0, 1e-10, 1e-8, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2] {
        let mut counts = [0; 3];
        for _ in 0..300 {
            let mut theta: [f64; 6] = rng.angles();
            // The arm from axis 3 to the wrist is in line with the upper arm.
            theta[2] = -FRAC_PI_2 + off;
            theta[4] = rng.between(0.3, 2.8) * rng.sign();
            let target = closure.reached(&theta);
            let (jacobian, _) = closure.linear(&target, &theta);
            if jacobian.singular_values()[4] < 0.01 {
                continue;
            }
            let accepted = found(&closure, &target, &theta, 1e-3);
            let count = accepted.as_slice().len();
            assert!((1..=2).contains(&count), "{off:e} {accepted:?}");
            counts[count] += 1;
            let near = accepted.as_slice().iter().map(|one| one.distance(&theta));
            let nearest = near.fold(9.0, f64::min);
            assert!(nearest < 1e-6 && (off < 1e-5 || nearest < 1e-9), "{off:e}: {nearest:e}");
        }
        assert!(off > 1e-9 || counts[2] == 0, "{counts:?}");
        assert!(!(1e-6..=1e-4).contains(&off) || counts[1] == 0, "{counts:?}");
        assert!(counts[1] + counts[2] > 200, "{counts:?}");
    }
}

#[test]
fn a_self_motion_stands_once_with_its_direction() {
    let mut rng = Rng::new(5);
    let closure = elbow();
    let mut compared = 0;
    for _ in 0..200 {
        let mut theta: [f64; 6] = rng.angles();
        theta[4] = 0.0;
        let target = closure.reached(&theta);
        let (jacobian, _) = closure.linear(&target, &theta);
        if jacobian.singular_values()[4] < 0.02 {
            continue;
        }
        compared += 1;
        // Points all along the self-motion.
        let mut accepted = Accepted::new();
        let mut points = theta.map(|angle| [angle; LANES]);
        for lane in 0..LANES {
            let turn = 0.7 * lane as f64;
            points[3][lane] += turn;
            points[5][lane] -= turn;
        }
        let candidates = closure.converged(&target, &points);
        accepted.take(&closure, &target, &candidates, LANES);
        accepted.represent(&closure, &target, &[0.0; 6]);
        assert!(accepted.as_slice().len() == 1, "{accepted:?}");
        let moving = accepted.as_slice()[0].moving;
        assert_eq!(moving, Some([false, false, false, true, false, true]), "{accepted:?}");
    }
    assert!(compared > 100);
}

#[test]
fn out_of_reach_nothing_is_accepted() {
    let closure = elbow();
    let mut target = closure.reached(&[0.1, 0.2, 0.3, 0.4, 0.5, 0.6]);
    target.frame.origin[0] += 2.0;
    assert!(found(&closure, &target, &[0.1, 0.2, 0.3, 0.4, 0.5, 0.6], 1.0).as_slice().is_empty());
}
