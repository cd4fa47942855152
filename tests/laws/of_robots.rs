//! Laws of everything around a solve: limits, choices, batches, chains without a solver.
#![allow(clippy::cast_precision_loss)]

use irbkin::batch::Batch;
use irbkin::{DhRow, JacobianFrame, JointLimits, Mdh, OpwParameters, Pose, Robot};

use crate::common::apart;

#[test]
fn solutions_are_wrapped_inside_the_limits() {
    let robot: Robot<6> = Robot::named("IRB 1600-6/1.45").unwrap();
    let q = [0.2, 0.1, (-230.0_f64).to_radians(), 0.3, 0.4, 0.5];
    let found = robot.ik(&robot.fk(&q)).unwrap();
    let same = found.iter().find(|s| apart(&s.q, &q) < 1e-10).unwrap();
    assert!((same.q[2] - q[2]).abs() < 1e-10 && same.is_within_limits());
}

#[test]
fn limits_that_are_empty_are_refused_by_name() {
    let refused = JointLimits::new([[0.0, 1.0], [1.2, -0.5]]).unwrap_err();
    assert_eq!(refused.to_string(), "joint 2 limit is empty: lower 1.2 rad > upper -0.5 rad");
}

#[test]
fn numbers_too_large_to_calculate_with_are_refused_by_name() {
    let opw = OpwParameters::abb(0.15, -0.115, 0.445, 0.7, 0.795, 0.085);
    let refused = |opw| Robot::from_opw(opw).unwrap_err().to_string();
    assert_eq!(
        refused(OpwParameters { c2: 1e100, ..opw }),
        "c2 is 1e100, its size must be at most 1e6"
    );
    assert_eq!(
        refused(OpwParameters { offsets: [0.0, 1e17, 0.0, 0.0, 0.0, 0.0], ..opw }),
        "offset of joint 2 is 1e17, its size must be at most 1e5"
    );
    let limits = |limit| JointLimits::new([limit]).unwrap_err().to_string();
    assert_eq!(
        limits([1e16, 1e16 + 4.0]),
        "lower limit of joint 1 is 1e16, its size must be at most 1e5"
    );
    assert_eq!(
        limits([f64::INFINITY; 2]),
        "lower limit of joint 1 is inf, it must be finite (-inf is allowed: no limit)"
    );
    assert!(JointLimits::new([[f64::NEG_INFINITY, f64::INFINITY]]).is_ok());
}

#[test]
fn self_motion_is_refused_for_a_solution_of_another_pose() {
    let robot: Robot<6> = Robot::named("IRB 2600-12/1.65").unwrap();
    let home = robot.fk(&[0.0; 6]);
    let free = *robot.ik(&home).unwrap().slot(0).unwrap();
    let other = robot.fk(&[0.3, -0.2, 0.4, 0.5, -0.6, 0.7]);
    assert!(robot.with_free_joint(&home, &free, 0.4).unwrap().is_some());
    assert!(
        robot
            .with_free_joint(&other, &free, 0.4)
            .unwrap_err()
            .to_string()
            .starts_with("solution does not reach this pose: residual ")
    );
}

#[test]
fn a_seed_or_weight_that_is_not_a_number_is_refused() {
    let robot: Robot<6> = Robot::named("IRB 2600-12/1.65").unwrap();
    let solutions = robot.ik(&robot.fk(&[0.1; 6])).unwrap();
    assert_eq!(
        solutions.nearest(&[f64::NAN; 6], &[1.0; 6]).unwrap_err().to_string(),
        "seed: joint 1 is NaN, every angle must be finite [rad]"
    );
    assert!(solutions.least_motion(&[0.0; 6], &[-1.0; 6]).is_err());
    assert!(robot.singularity(&[f64::NAN; 6]).min_singular_value.is_nan());
}

#[test]
fn a_batch_of_another_length_is_refused() {
    let robot: Robot<6> = Robot::named("IRB 2600-12/1.65").unwrap();
    let refused = Batch::new(None).fk(&robot, &[0.0; 12], &mut [0.0; 16]).unwrap_err();
    assert_eq!(refused.to_string(), "poses has 16 elements, it must have 32");
}

#[test]
fn arms_of_more_joints_than_lanes_have_forward_kinematics() {
    let rows = std::array::from_fn(|i| DhRow::new(0.3 * (i as f64 - 4.0), 0.1, 0.2, 0.5));
    let robot: Robot<9> =
        Robot::serial_chain(Mdh { base: Pose::identity(), rows, flange: Pose::identity() })
            .unwrap();
    let q = std::array::from_fn(|i| 0.4 * i as f64 - 1.0);
    let (frames, tool) = robot.link_frames(&q);
    let mut poses = [0.0; 16];
    Batch::new(None).fk(&robot, &q, &mut poses).unwrap();
    assert_eq!(irbkin::pose::to_rows(&robot.fk(&q)), poses);
    assert_eq!(robot.fk(&q), tool);
    assert_eq!(
        robot.jacobian(&q, JacobianFrame::Base).column(8).fixed_rows::<3>(3),
        frames[8].rotation.matrix().column(2)
    );
}
