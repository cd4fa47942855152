//! Laws of arms with three parallel axes, on random arms and random joint vectors.
#![allow(clippy::unwrap_used, clippy::float_cmp, missing_docs)]

mod common;

use common::Rng;
use common::parallel_arm::ParallelArm;
use irbkin::PoseError;
use std::f64::consts::PI;

#[test]
fn the_arm_of_the_tests_is_the_catalogues() {
    let mut rng = Rng::new(1);
    for name in ["UR3", "UR5e", "UR10e", "UR20"] {
        let (arm, robot) = ParallelArm::universal(name);
        let built = arm.robot();
        for _ in 0..100 {
            let q = std::array::from_fn(|_| rng.between(-PI, PI));
            let off = PoseError::between(&robot.fk(&q), &built.fk(&q)).largest();
            assert!(off < 1e-14 * (1.0 + arm.reach()), "{name}: {off:e} {} {}", robot.fk(&q), built.fk(&q));
        }
    }
}
