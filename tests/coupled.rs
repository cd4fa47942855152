//! Laws of arms with axes 2 and 3 coupled by a parallelogram linkage: their joint vectors are the
//! controller's, with axis 3 measured from the base.
#![allow(clippy::unwrap_used, clippy::float_cmp, missing_docs)]

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use crate::common::coupled_arm::{limited, odd, opw, unlimited, with_linkage};
use crate::common::{Rng, apart, central_difference, difference_bound, reach_of};
use irbkin::batch::Batch;
use irbkin::{
    Error, Explanation, FreeJoint, JacobianFrame, JointLimits, OpwParameters, Robot, pose,
};
use nalgebra::Matrix6;

const SLOTS: usize = 8;

fn serial(mut q: [f64; 6]) -> [f64; 6] {
    q[2] -= q[1];
    q
}

const CASES: usize = 2000;

#[test]
fn forward_kinematics_equals_that_of_the_uncoupled_arm() {
    let mut rng = Rng::new(1);
    for robot in [unlimited(), odd()] {
        let twin = robot.clone().uncoupled();
        assert!(robot.is_coupled() && !twin.is_coupled());
        for _ in 0..CASES {
            let q = rng.inside(robot.limits());
            assert_eq!(robot.fk(&q), twin.fk(&serial(q)));
            assert_eq!(robot.link_frames(&q), twin.link_frames(&serial(q)));
            assert_eq!(robot.singularity(&q).distances, twin.singularity(&serial(q)).distances);
        }
    }
}

#[test]
fn axis_3_keeps_the_forearm_level_while_axis_2_turns() {
    let robot = unlimited();
    let level = robot.fk(&[0.0; 6]).rotation;
    for q2 in [-1.0, -0.3, 0.4, 1.2] {
        let turned = robot.fk(&[0.0, q2, 0.0, 0.0, 0.0, 0.0]).rotation;
        assert!(level.angle_to(&turned) < 1e-15, "{q2}");
    }
}

/// J of the controller's joints is J of the serial ones times their derivative, in which q2 turns
/// the serial q3 back.
#[test]
fn the_jacobian_follows_from_the_uncoupled_one_by_the_chain_rule() {
    let mut derivative = Matrix6::identity();
    derivative[(2, 1)] = -1.0;
    let mut rng = Rng::new(2);
    for robot in [unlimited(), odd()] {
        let twin = robot.clone().uncoupled();
        for _ in 0..CASES {
            let q = rng.inside(robot.limits());
            for frame in [JacobianFrame::Base, JacobianFrame::Tool] {
                let expected = twin.jacobian(&serial(q), frame) * derivative;
                assert!(
                    (robot.jacobian(&q, frame) - expected).amax()
                        <= 4.0 * f64::EPSILON * reach_of(&robot)
                );
            }
        }
    }
}

#[test]
fn the_jacobian_matches_central_differences() {
    let robot = odd();
    let mut rng = Rng::new(3);
    for _ in 0..200 {
        let q = rng.inside(robot.limits());
        let jacobian = robot.jacobian(&q, JacobianFrame::Base);
        for joint in 0..6 {
            for (row, wanted) in central_difference(&robot, &q, joint).into_iter().enumerate() {
                assert!(
                    (jacobian[(row, joint)] - wanted).abs() < difference_bound(reach_of(&robot))
                );
            }
        }
    }
}

#[test]
fn solutions_equal_those_of_the_uncoupled_arm_slot_for_slot() {
    let mut rng = Rng::new(4);
    for robot in [unlimited(), odd()] {
        let twin = robot.clone().uncoupled();
        for _ in 0..CASES {
            let q = rng.inside(robot.limits());
            let pose = robot.fk(&q);
            let (solutions, serials) = (robot.ik(&pose).unwrap(), twin.ik(&pose).unwrap());
            assert!(solutions.iter().any(|solution| apart(&solution.q, &q) < 1e-9));
            for slot in 0..SLOTS {
                let (Some(solution), Some(other)) = (solutions.slot(slot), serials.slot(slot))
                else {
                    assert_eq!(solutions.slot(slot).is_none(), serials.slot(slot).is_none());
                    continue;
                };
                assert!(apart(&serial(solution.q), &other.q) < 1e-14);
                assert!(solution.q.iter().all(|angle| *angle > -PI && *angle <= PI));
                let residual = robot.residual(&solution.q, &pose);
                assert!(
                    residual.position <= 3e-15 * reach_of(&robot) && residual.rotation <= 1e-14,
                    "{residual:?}"
                );
            }
        }
    }
}

#[test]
fn limits_are_those_of_the_controllers_angles() {
    let mut rng = Rng::new(5);
    for robot in [limited(), with_linkage()] {
        let limits = *robot.limits();
        for _ in 0..CASES {
            let q = rng.inside(&limits);
            for solution in &robot.ik(&robot.fk(&q)).unwrap() {
                let linkage = solution.q[2] - solution.q[1];
                let holds =
                    |[low, high]: [f64; 2], angle: f64| angle >= low - 1e-9 && angle <= high + 1e-9;
                let inside = limits
                    .to_array()
                    .into_iter()
                    .zip(solution.q)
                    .all(|(limit, angle)| holds(limit, angle))
                    && limits.linkage().is_none_or(|limit| {
                        [-TAU, 0.0, TAU].iter().any(|turn| holds(limit, linkage + turn))
                    });
                assert_eq!(solution.is_within_limits(), inside, "{solution:?}");
            }
        }
    }
}

#[test]
fn forward_kinematics_and_jacobian_of_rows_equal_single_calls() {
    let (robot, mut rng) = (odd(), Rng::new(7));
    let joints: Vec<_> = (0..13).map(|_| rng.inside(robot.limits())).collect();
    let (mut poses, mut jacobians) = (vec![[0.0; 16]; 13], vec![[[0.0; 6]; 6]; 13]);
    Batch::new(None).fk(&robot, joints.as_flattened(), poses.as_flattened_mut()).unwrap();
    Batch::new(None)
        .jacobian(
            &robot,
            joints.as_flattened(),
            JacobianFrame::Tool,
            jacobians.as_flattened_mut().as_flattened_mut(),
        )
        .unwrap();
    for (row, q) in joints.iter().enumerate() {
        assert_eq!(poses[row], pose::to_rows(&robot.fk(q)));
        let one = robot.jacobian(q, JacobianFrame::Tool);
        assert_eq!(jacobians[row], std::array::from_fn(|i| std::array::from_fn(|j| one[(i, j)])));
    }
}

#[test]
fn turns_and_the_nearest_keep_the_linkage_inside() {
    let (robot, mut rng) = (with_linkage(), Rng::new(8));
    let mut kept_out = 0;
    for _ in 0..CASES {
        let q = rng.inside(robot.limits());
        let solutions = robot.ik(&robot.fk(&q)).unwrap();
        let turns: Vec<_> = solutions.turns().collect();
        assert!(turns.iter().all(|turn| robot.limits().contains(&turn.q)));
        assert_eq!(Some(turns.len()), solutions.turn_count());
        match solutions.nearest(&q, &[1.0; 6]) {
            Ok(nearest) => assert!(robot.limits().contains(&nearest.q)),
            Err(Error::Unreachable(Explanation::OutsideLinkage { excess, .. })) => {
                kept_out += 1;
                assert!(excess > 0.0);
                assert!(turns.is_empty());
            }
            Err(error) => assert!(
                matches!(error, Error::Unreachable(Explanation::OutsideLimits { .. })),
                "{error}"
            ),
        }
    }
    assert!(kept_out > 100, "{kept_out}");
}

#[test]
fn coupling_and_uncoupling_lose_no_posture() {
    let mut rng = Rng::new(9);
    for robot in [limited(), with_linkage()] {
        let twin = robot.clone().uncoupled();
        let back = twin.clone().coupled().unwrap();
        for _ in 0..CASES {
            let q = rng.inside(robot.limits());
            if robot.limits().contains(&q) {
                assert!(twin.limits().contains(&serial(q)));
                assert!(back.limits().contains(&q));
            }
        }
        assert_eq!(
            robot.limits().linkage().is_some(),
            twin.limits().to_array()[2] == [-100.0, 40.0].map(f64::to_radians)
        );
    }
    assert_eq!(unlimited().uncoupled(), Robot::from_opw(opw()).unwrap());
    assert_eq!(unlimited().uncoupled().coupled().unwrap(), unlimited());
    assert_eq!(unlimited().coupled().unwrap(), unlimited());
    let far = unlimited().with_limits(JointLimits::new([[-1e5, 1e5]; 6]).unwrap()).uncoupled();
    assert_eq!(far.limits().to_array()[2], [f64::NEG_INFINITY, f64::INFINITY]);
}

#[test]
fn coupling_adds_the_velocity_of_joint_2_to_that_of_joint_3() {
    let robot = unlimited().with_max_velocity(Some([1.0, 2.0, 3.0, 4.0, 5.0, 6.0])).unwrap();
    assert_eq!(robot.max_velocity(), Some(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]));
    assert_eq!(robot.uncoupled().max_velocity(), Some(&[1.0, 2.0, 5.0, 4.0, 5.0, 6.0]));
}

#[test]
fn invalid_limits_are_reported() {
    let message = |result: Result<Robot<6>, Error>| result.unwrap_err().to_string();
    assert_eq!(
        message(limited().with_linkage_limits(Some([0.5, -0.5]))),
        "linkage limit is empty: lower 0.5 rad > upper -0.5 rad"
    );
    assert_eq!(
        message(limited().with_linkage_limits(Some([f64::NAN, 0.0]))),
        "lower limit of the linkage is NaN, it must not be NaN (-inf is allowed: no limit)"
    );
    let serial = Robot::<6>::named("IRB 2600-12/1.65").unwrap();
    assert!(
        message(serial.with_linkage_limits(Some([0.0, 1.0])))
            .starts_with("this robot has no parallelogram linkage")
    );
    let senses = OpwParameters { signs: [1, 1, -1, 1, 1, 1], ..opw() };
    assert_eq!(
        message(Robot::from_opw(senses).unwrap().coupled()),
        "axes 2 and 3 cannot be coupled: they turn in opposite senses"
    );
    assert_eq!(
        message(Robot::named("UR3").unwrap().coupled()),
        "axes 2 and 3 cannot be coupled: the arm has no spherical wrist"
    );
}

#[test]
fn with_the_wrist_on_axis_2_the_coupled_axis_3_follows_axis_2() {
    let robot = Robot::from_opw(OpwParameters::abb(0.1, 0.0, 0.5, 0.7, 0.7, 0.1))
        .unwrap()
        .coupled()
        .unwrap();
    // Folded: the serial axis 3 at 90 deg.
    let q = [0.2, 0.3, FRAC_PI_2 + 0.3, 0.4, 0.5, 0.6];
    let pose = robot.fk(&q);
    let solutions = robot.ik(&pose).unwrap();
    let free = solutions
        .iter()
        .find(|solution| solution.free_joint == Some(FreeJoint::UpperCoupled))
        .unwrap();
    assert_eq!(free.free_joint.unwrap().fixed(), "q1, q3 - q2");
    let moved = robot.with_free_joint(&pose, free, 0.3).unwrap().unwrap();
    assert!((moved.q[2] - moved.q[1] - FRAC_PI_2).abs() < 1e-12);
    assert!(robot.residual(&moved.q, &pose).largest() < 1e-12);
}
