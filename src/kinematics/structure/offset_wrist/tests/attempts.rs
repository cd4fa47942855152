//! Attempts by themselves: one that is certain has every solution, whatever the others know.

use super::*;
use crate::kinematics::structure::by_roots::InCluster;

#[test]
fn an_attempt_that_is_certain_has_every_solution() {
    for (name, arm) in arms() {
        let mut certain = [0; 2];
        for (set, change) in SETS {
            for q in joints(9).take(asked()).filter_map(|q| change(&arm, q)) {
                let frame = Frame::of(&arm.chain.fk(&q));
                let both = [InCluster::Middle, InCluster::Everywhere];
                for (in_cluster, certain) in both.into_iter().zip(&mut certain) {
                    let mut found = Accepted::NONE;
                    if arm.attempt(&frame, in_cluster, &mut found) {
                        // Next to a fold rounding moves a solution by its root.
                        let is_it = |one: &Configuration| one.distance(&q) < 3e-3;
                        let is_found = found.as_slice().iter().any(is_it);
                        assert!(is_found, "{name}, {set}, {in_cluster:?}: {q:?}");
                        *certain += 1;
                    }
                }
            }
        }
        std::println!("{name}: {certain:?} certain");
        // With the wrist point on axis 6 a root tells nothing, and nothing is counted.
        let is_counted = arm.constants.lengths.turns_wrist_point();
        assert!((certain[0] > 0) == is_counted && certain[1] >= certain[0], "{name}: {certain:?}");
    }
}
