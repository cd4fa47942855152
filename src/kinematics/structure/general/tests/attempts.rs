//! Attempts by themselves: one that is certain has every solution, whatever the others know.

use std::vec::Vec;

use super::{General, STRUCTURED, arms, near_folds, poses_or};
use crate::kinematics::structure::by_roots::InCluster;
use crate::kinematics::structure::closure::{Accepted, Configuration};
use crate::kinematics::structure::general::attempt::Attempt;
use crate::lanes::run_vectors;
use crate::rng::Rng;

pub(super) const IN_CLUSTER: [InCluster; 3] =
    [InCluster::Nowhere, InCluster::Middle, InCluster::Everywhere];

/// How many attempts of each kind were certain, and how many of these lack the angles that made the
/// pose.
fn lacking(arm: &General, all: &[[f64; 6]]) -> [[usize; 2]; 3] {
    let closure = &arm.closure;
    let mut counts = [[0; 2]; 3];
    for theta in all {
        let target = &closure.reached(theta);
        for split in arm.splits.iter() {
            for (in_cluster, count) in IN_CLUSTER.into_iter().zip(&mut counts) {
                let mut found = Accepted::NONE;
                let accepted = &mut found;
                if run_vectors(Attempt { split, closure, target, in_cluster, accepted }) {
                    // Next to a fold rounding moves a solution by its root.
                    let is_it = |one: &Configuration| one.distance(theta) < 1e-3;
                    let is_found = found.as_slice().iter().any(is_it);
                    if !is_found {
                        std::println!("{in_cluster:?} {:?} {theta:?}", split.joints);
                    }
                    *count = [count[0] + 1, count[1] + usize::from(!is_found)];
                }
            }
        }
    }
    counts
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
        let counts = lacking(&arm, &all);
        std::println!("{name}, {} poses: {counts:?}", all.len());
        for [certain, lacking] in counts {
            assert!(certain > 0 && lacking == 0, "{name}: {counts:?}");
        }
    }
}
