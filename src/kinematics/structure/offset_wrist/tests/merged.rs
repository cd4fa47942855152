//! Places where more than two solutions merge.

use core::f64::consts::{FRAC_PI_2, PI};

use crate::Status;
use crate::kinematics::answer::solutions::Solution;
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::pose::angles::wrap;
use crate::kinematics::robot::Robot;
use crate::rng::Rng;

#[test]
fn where_five_solutions_merge_one_is_found_at_that_place() {
    // The closure about them is below its rounding as far as 3e-3 rad.
    let mut rng = Rng::new(12);
    for name in ["GoFa 5", "GoFa 10", "GoFa 12"] {
        let robot = Robot::<6>::named(name).unwrap().with_limits(JointLimits::UNLIMITED);
        for wrist in [[0.0, 0.0], [PI, PI]] {
            for elbow in [-FRAC_PI_2, FRAC_PI_2] {
                let [first, last] = rng.angles();
                let q = [first, 0.0, elbow, wrist[0], wrist[1], last];
                let pose = robot.fk(&q);
                let solutions = robot.ik(&pose).unwrap();
                let apart = |one: &Solution<6>| {
                    let apart = |(a, b): (&f64, f64)| wrap(a - b).abs();
                    one.q.iter().zip(q).map(apart).fold(0.0, f64::max)
                };
                let near: std::vec::Vec<_> =
                    solutions.iter().filter(|one| apart(one) < 0.1).collect();
                assert_eq!(near.len(), 1, "{name} {q:?}: {solutions}");
                assert!(apart(near[0]) < 3e-3, "{name} {q:?}: {}", apart(near[0]));
                assert!(near[0].status.contains(Status::ELBOW), "{near:?}");
            }
        }
    }
}
