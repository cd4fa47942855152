//! Attempts by themselves: one that is certain has every solution, whatever the others know.

use std::vec::Vec;

use super::{General, STRUCTURED, arms, near_folds, poses_or};
use crate::kinematics::structure::by_roots::certifies;
use crate::kinematics::structure::closure::{Accepted, Configuration};
use crate::rng::Rng;

/// How many attempts were certain, and how many of these lack the angles that made the pose.
fn lacking(arm: &General, all: &[[f64; 6]]) -> [usize; 2] {
    let [mut certain, mut lacking] = [0; 2];
    for theta in all {
        let last = &arm.closure.last_frame(theta);
        for number in 0..arm.splits.len() {
            let mut found = Accepted::new();
            if certifies(&arm.split(number), last, &mut found) {
                certain += 1;
                let is_it = |one: &Configuration| one.distance(theta) < 1e-6;
                if !found.as_slice().iter().any(is_it) {
                    lacking += 1;
                    std::println!("{number} {theta:?}");
                }
            }
        }
    }
    [certain, lacking]
}

#[test]
fn an_attempt_that_is_certain_has_every_solution() {
    let mut rng = Rng::new(10);
    for (name, mdh) in arms() {
        let arm = General::of(&mdh).unwrap();
        let count = poses_or(10).min(1000);
        let mut all: Vec<_> = (0..count).map(|_| rng.angles()).collect();
        for (_, change) in STRUCTURED {
            all.extend((0..count).map(|_| change(rng.angles())));
        }
        for off in [0.0, 1e-9, 1e-6, 1e-4] {
            all.extend(near_folds(&arm, &mut rng, off).take(count));
        }
        let [certain, lacking] = lacking(&arm, &all);
        std::println!("{name}, {} poses: {certain} certain, {lacking} lacking", all.len());
        assert!(certain > 0 && lacking == 0, "{name}");
    }
}
