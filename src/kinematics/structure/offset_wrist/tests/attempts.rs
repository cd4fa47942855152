//! Attempts by themselves: one that is certain has every solution, whatever the others know.

use super::*;
use crate::kinematics::structure::by_roots::certifies;

#[test]
fn an_attempt_that_is_certain_has_every_solution() {
    for (name, arm) in arms() {
        let mut certain = 0;
        for (set, change) in SETS {
            for q in joints(9).take(asked()).filter_map(|q| change(&arm, q)) {
                let frame = Frame::of(&arm.chain.fk(&q));
                let mut found = Accepted::new();
                if certifies(&arm.constants, &frame, &mut found) {
                    let is_it = |one: &Configuration| one.distance(&q) < 1e-6;
                    let is_found = found.as_slice().iter().any(is_it);
                    assert!(is_found, "{name}, {set}: {q:?}");
                    certain += 1;
                }
            }
        }
        std::println!("{name}: {certain} certain");
        assert!(certain > 0, "{name}");
    }
}
