//! Laws of arms with a spherical shoulder alone.

mod complete;
mod reach;
mod recognized;

use std::f64::consts::FRAC_PI_2;

use irbkin::{PoseDifference, Robot};

use crate::common::enough;
use crate::rng::Rng;
use crate::structures::spherical_shoulder::{ShoulderArm, named};
use crate::structures::{Arm as _, SEVEN, Subject};

#[test]
fn the_arm_of_the_tests_is_that_of_the_catalog() {
    let mut rng = Rng::new(1);
    for name in ["Panda", "FR3"] {
        let (robot, built) = (Robot::<7>::named(name).unwrap(), ShoulderArm::panda().robot());
        for _ in 0..100 {
            let q = rng.angles();
            let off = PoseDifference::between(&robot.fk(&q), &built.fk(&q)).largest();
            assert!(off < 1e-14, "{name}: {off:e}");
        }
    }
}

#[test]
fn the_slots_of_a_panda_follow_from_its_own_joints() {
    let arm = named("Panda");
    // Where the arm is stretched: 0.0825 m beside 0.316 m above the elbow, and beside 0.384 m below.
    let stretched = -(0.0825_f64.atan2(0.316) + 0.0825_f64.atan2(0.384));
    let mut rng = Rng::new(1);
    let mut compared = 0;
    for _ in 0..2000 {
        let q = rng.inside(arm.robot.limits());
        for solution in &arm.ik(&arm.robot.fk(&q), &q) {
            if arm.clearance(&solution.q) < 1e-6 {
                continue;
            }
            let wrapped = |angle: f64| angle.sin().atan2(angle.cos());
            let slot = 4 * usize::from(wrapped(solution.q[1]) < 0.0)
                + 2 * usize::from(wrapped(solution.q[3] - stretched) > 0.0)
                + usize::from(wrapped(solution.q[4]).abs() > FRAC_PI_2);
            assert_eq!(solution.slot.index(), slot, "{q:?}");
            compared += 1;
        }
    }
    assert!(enough(compared > 4000), "{compared}");
    assert_eq!(arm.slot(&[0.0, 0.1, 0.0, -1.5, 0.0, 1.5, 0.0]), 0);
}

#[test]
fn joint_7_is_returned_bit_for_bit() {
    let arm = Subject::new("Panda", ShoulderArm::panda(), &SEVEN);
    let mut rng = Rng::new(6);
    for _ in 0..200 {
        let mut q: [f64; 7] = rng.angles();
        q[6] *= 3.0;
        let solutions = arm.ik(&arm.robot.fk(&q), &q);
        assert!(!solutions.is_empty());
        assert!(solutions.iter().all(|solution| solution.q[6].to_bits() == q[6].to_bits()));
    }
}
