//! The solution that represents a self-motion.

use core::f64::consts::PI;

use crate::Status;
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::pose::Pose;
use crate::kinematics::pose::angles::wrap;
use crate::kinematics::robot::Robot;
use crate::rng::Rng;

#[test]
fn a_self_motion_is_represented_with_its_first_joint_at_zero() {
    let zero = |q: f64| wrap(q).abs() < 1e-12;
    // Axes 1 and 6 of a GoFa in one line turn against one another, whatever the others are.
    let gofa = Robot::<6>::named("GoFa 5").unwrap().with_limits(JointLimits::UNLIMITED);
    for (height, turn) in [(0.9, 0.3), (0.8, -1.4), (0.7, 2.9)] {
        let turn = Pose::rotation(nalgebra::Vector3::z() * turn);
        let pose = Pose::translation(0.0, 0.0, height) * turn;
        let solutions = gofa.ik(&pose).unwrap();
        assert!(!solutions.is_empty() && !solutions.is_certified(), "{height}");
        for one in &solutions {
            assert!(one.status.contains(Status::WRIST) && zero(one.q[0]), "{one:?}");
            assert!(gofa.residual(&one.q, &pose).largest() < 1e-13);
        }
    }
    // A CRX with equal links moves where the wrist point is on axis 2: where joint 1 passes zero.
    let crx = Robot::<6>::named("CRX-10iA").unwrap().with_limits(JointLimits::UNLIMITED);
    let mut rng = Rng::new(8);
    let (mut at_zero, mut elsewhere) = (0, 0);
    for _ in 0..100 {
        let mut q: [f64; 6] = rng.angles();
        q[2] = -0.5 * PI;
        for one in &crx.ik(&crx.fk(&q)).unwrap() {
            if one.status.contains(Status::WRIST) {
                *(if zero(one.q[0]) { &mut at_zero } else { &mut elsewhere }) += 1;
            }
        }
    }
    std::println!("joint 1 at zero: {at_zero}, not: {elsewhere}");
    assert!(at_zero > elsewhere, "{at_zero} {elsewhere}");
}
