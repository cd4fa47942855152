//! Laws of arms with axes 2 and 3 coupled by a parallelogram linkage: their joint vectors are the
//! controller's, with axis 3 measured from the base.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use crate::common::coupled_arm::{
    limited, odd, opposed, opw, others, serial, unlimited, with_linkage,
};
use crate::common::{Rng, apart, central_difference, difference_bound, reach_of};
use irbkin::batch::Batch;
use irbkin::{
    DhRow, Error, Explanation, FreeJoint, JacobianFrame, JointLimits, Mdh, OpwParameters, Pose,
    Robot, pose,
};
use nalgebra::Matrix6;

const SLOTS: usize = 8;

const CASES: usize = 2000;

/// Arms of every structure whose axes 2 and 3 may be coupled, in both senses.
fn arms() -> Vec<Robot<6>> {
    let [crx, ur, crooked] = others();
    vec![unlimited(), odd(), opposed(), crx, ur, crooked]
}

#[test]
fn forward_kinematics_equals_that_of_the_uncoupled_arm() {
    let mut rng = Rng::new(1);
    for robot in arms() {
        let twin = robot.clone().uncoupled();
        assert!(robot.is_coupled() && !twin.is_coupled());
        for _ in 0..CASES {
            let q = rng.inside(robot.limits());
            assert_eq!(robot.fk(&q), twin.fk(&serial(&robot, q)));
            assert_eq!(robot.link_frames(&q), twin.link_frames(&serial(&robot, q)));
            assert_eq!(
                robot.singularity(&q).distances,
                twin.singularity(&serial(&robot, q)).distances
            );
        }
    }
}

#[test]
fn axis_3_keeps_the_forearm_level_while_axis_2_turns() {
    let [crx, ur, _] = others();
    for robot in [unlimited(), odd(), opposed(), crx, ur] {
        let level = robot.fk(&[0.0; 6]).rotation;
        for q2 in [-1.0, -0.3, 0.4, 1.2] {
            let turned = robot.fk(&[0.0, q2, 0.0, 0.0, 0.0, 0.0]).rotation;
            assert!((level.matrix() - turned.matrix()).amax() < 1e-15, "{q2}");
        }
    }
}

/// Joints of a URDF and what the pendant shows: J3 = q3 - q2.
#[test]
fn a_fanuc_pendant_measures_joint_3_from_the_base() {
    let urdf = [0.1, 0.5467, -0.0352, 0.2, -1.1, 0.3];
    let pendant = [0.1, 0.5467, (-33.340_f64).to_radians(), 0.2, -1.1, 0.3];
    for robot in [Robot::<6>::named("CRX-10iA").unwrap(), opposed().uncoupled()] {
        let coupled = robot.clone().coupled().unwrap();
        let off = coupled.residual(&pendant, &robot.fk(&urdf));
        assert!(off.largest() < 3e-5, "{off:?}");
        let seen = coupled.ik_nearest(&robot.fk(&urdf), &pendant, &[1.0; 6]).unwrap();
        assert!((seen.q[2] - (urdf[2] - urdf[1])).abs() < 1e-12, "{seen:?}");
        // Limits of the URDF's joint 3 are limits of the linkage.
        assert_eq!(coupled.limits().linkage(), Some(robot.limits().to_array()[2]));
    }
}

/// J of the controller's joints is J of the serial ones times their derivative, in which q2 turns
/// the serial q3 back.
#[test]
fn the_jacobian_follows_from_the_uncoupled_one_by_the_chain_rule() {
    let mut rng = Rng::new(2);
    for robot in arms() {
        let twin = robot.clone().uncoupled();
        let mut derivative = Matrix6::identity();
        derivative[(2, 1)] = serial(&robot, [0.0, 1.0, 0.0, 0.0, 0.0, 0.0])[2];
        for _ in 0..CASES {
            let q = rng.inside(robot.limits());
            for frame in [JacobianFrame::Base, JacobianFrame::Tool] {
                let expected = twin.jacobian(&serial(&robot, q), frame) * derivative;
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
    let mut rng = Rng::new(3);
    for (robot, _) in arms().iter().zip(0..4) {
        for _ in 0..100 {
            let q = rng.inside(robot.limits());
            let jacobian = robot.jacobian(&q, JacobianFrame::Base);
            for joint in 0..6 {
                for (row, wanted) in central_difference(robot, &q, joint).into_iter().enumerate() {
                    let off = (jacobian[(row, joint)] - wanted).abs();
                    assert!(off < difference_bound(reach_of(robot)), "{off}");
                }
            }
        }
    }
}

#[test]
fn solutions_equal_those_of_the_uncoupled_arm_slot_for_slot() {
    let mut rng = Rng::new(4);
    for robot in [unlimited(), odd(), opposed()] {
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
                assert!(apart(&serial(&robot, solution.q), &other.q) < 1e-14);
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

/// Solutions in ordinal slots have the order of the serial angles.
#[test]
fn solutions_of_other_structures_equal_those_of_the_uncoupled_arm() {
    let mut rng = Rng::new(10);
    for robot in others() {
        let free = robot.with_limits(JointLimits::UNLIMITED).with_linkage_limits(None).unwrap();
        let twin = free.clone().uncoupled();
        let mut regular = 0;
        for _ in 0..200 {
            let q: [f64; 6] = rng.angles();
            let pose = free.fk(&q);
            let (solutions, serials) = (free.ik(&pose).unwrap(), twin.ik(&pose).unwrap());
            assert_eq!(solutions.status(), serials.status());
            assert!(solutions.iter().any(|solution| apart(&solution.q, &q) < 1e-8));
            for (solution, other) in solutions.iter().zip(&serials) {
                assert!(apart(&serial(&free, solution.q), &other.q) < 1e-9);
                assert!(solution.q.iter().all(|angle| *angle > -PI && *angle <= PI));
                regular += 1;
            }
        }
        assert!(regular > 400, "{regular}");
    }
}

/// A joint that a singular pose leaves undetermined is the controller's.
#[test]
fn the_free_joint_of_a_coupled_arm_takes_its_value() {
    let [crx, ur, _] = others();
    let angles = [0.0, FRAC_PI_2, -FRAC_PI_2];
    let singular = |i: usize| [0.3, angles[i % 3], angles[i / 3 % 3], 0.0, angles[i / 9], 0.2];
    let cases = (0..27).flat_map(|i| [(&crx, singular(i)), (&ur, singular(i))]);
    let (mut moved, mut third) = (0, 0);
    for (robot, q) in cases {
        let limits = JointLimits::UNLIMITED;
        let robot = robot.clone().with_limits(limits).with_linkage_limits(None).unwrap();
        let pose = robot.fk(&q);
        for solution in &robot.ik(&pose).unwrap() {
            let Some(free) = solution.free_joint else { continue };
            let value = solution.q[free.joint() - 1] + 0.05;
            let Ok(Some(other)) = robot.with_free_joint(&pose, solution, value) else { continue };
            assert_eq!(other.q[free.joint() - 1], value);
            assert!(robot.residual(&other.q, &pose).largest() < 1e-8);
            let turns = |joint: usize| (other.q[joint] - solution.q[joint]).abs() > 1e-6;
            let is_named = |joint: usize| !free.fixed().contains(&format!("q{}", joint + 1));
            assert!((0..6).all(|joint| !turns(joint) || is_named(joint)), "{free:?}");
            moved += 1;
            third += usize::from(turns(2));
        }
    }
    assert!(moved > 10 && third > 0, "{moved} {third}");
}

#[test]
fn limits_are_those_of_the_controllers_angles() {
    let mut rng = Rng::new(5);
    let fanuc = opposed().with_linkage_limits(Some([-1.0, 2.0])).unwrap();
    let [crx, ur, crooked] = others();
    for (robot, cases) in [
        (limited(), CASES),
        (with_linkage(), CASES),
        (fanuc, CASES),
        (ur, CASES),
        (crx, CASES / 10),
        (crooked, CASES / 10),
    ] {
        let limits = *robot.limits();
        for _ in 0..cases {
            let q = rng.inside(&limits);
            for solution in &robot.ik(&robot.fk(&q)).unwrap() {
                let linkage = serial(&robot, solution.q)[2];
                let holds =
                    |[low, high]: [f64; 2], angle: f64| angle >= low - 1e-9 && angle <= high + 1e-9;
                let inside = limits
                    .to_array()
                    .into_iter()
                    .zip(solution.q)
                    .all(|(limit, angle)| holds(limit, angle))
                    && limits.linkage().is_none_or(|limit| {
                        (-2..=2).any(|turn| holds(limit, linkage + TAU * f64::from(turn)))
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
    let fanuc = opposed().with_linkage_limits(Some([-1.0, 2.0])).unwrap();
    for robot in [with_linkage(), fanuc] {
        assert_linkage_is_kept(&robot);
    }
}

fn assert_linkage_is_kept(robot: &Robot<6>) {
    let (mut kept_out, mut rng) = (0, Rng::new(8));
    for _ in 0..CASES {
        let q = rng.inside(robot.limits());
        let solutions = robot.ik(&robot.fk(&q)).unwrap();
        let turns: Vec<_> = solutions.turns().collect();
        assert!(turns.iter().all(|turn| robot.limits().contains(&turn.q)));
        assert_eq!(u32::try_from(turns.len()).map(f64::from), Ok(solutions.turn_total()));
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
    for robot in [limited(), with_linkage(), opposed()] {
        let twin = robot.clone().uncoupled();
        let back = twin.clone().coupled().unwrap();
        for _ in 0..CASES {
            let q = rng.inside(robot.limits());
            if robot.limits().contains(&q) {
                let [q1, q2, q3, rest @ ..] = serial(&robot, q);
                // The linkage is compared modulo 2 pi.
                let turned = |turn: f64| [q1, q2, q3 + turn, rest[0], rest[1], rest[2]];
                let is_inside = |turn| twin.limits().contains(&turned(turn));
                assert!([0.0, TAU, -TAU].into_iter().any(is_inside));
                assert!(back.limits().contains(&q));
            }
        }
        if let Some(linkage) = robot.limits().linkage() {
            assert_eq!(twin.limits().to_array()[2], linkage);
        }
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
    assert_eq!(
        Robot::<7>::named("Panda").unwrap().coupled().unwrap_err().to_string(),
        "axes 2 and 3 cannot be coupled: they are 90.0 deg off parallel, at most 2.9 deg is possible"
    );
    assert_eq!(
        message(Robot::named("CRB 15000-5/0.95").unwrap().coupled()),
        "axes 2 and 3 cannot be coupled: the controller of this arm measures joint 3 from the \
         upper arm"
    );
    let seven = std::array::from_fn(|i| DhRow::new(if i == 2 { 0.0 } else { 1.0 }, 0.3, 0.2, 0.0));
    let (base, flange) = (Pose::identity(), Pose::identity());
    let seven: Robot<7> = Robot::serial_chain(Mdh { base, rows: seven, flange }).unwrap();
    assert_eq!(
        seven.coupled().unwrap_err().to_string(),
        "axes 2 and 3 cannot be coupled: the arm has 7 joints, a linkage needs six"
    );
}

#[test]
fn with_the_wrist_on_axis_2_the_coupled_axis_3_follows_axis_2() {
    let abb = OpwParameters::abb(0.1, 0.0, 0.5, 0.7, 0.7, 0.1);
    let fanuc = OpwParameters { signs: [1, 1, -1, 1, 1, 1], ..abb };
    for (opw, sense, free_joint, fixed) in [
        (abb, 1.0, FreeJoint::UpperCoupled, "q1, q3 - q2"),
        (fanuc, -1.0, FreeJoint::UpperOpposed, "q1, q3 + q2"),
    ] {
        let robot = Robot::from_opw(opw).unwrap().coupled().unwrap();
        // Folded: the serial axis 3 at 90 deg.
        let q = [0.2, 0.3, sense * (FRAC_PI_2 + 0.3), 0.4, 0.5, 0.6];
        let pose = robot.fk(&q);
        let solutions = robot.ik(&pose).unwrap();
        let free =
            solutions.iter().find(|solution| solution.free_joint == Some(free_joint)).unwrap();
        assert_eq!(free.free_joint.unwrap().fixed(), fixed);
        let moved = robot.with_free_joint(&pose, free, 0.7).unwrap().unwrap();
        assert!((moved.q[2] - sense * (moved.q[1] + FRAC_PI_2)).abs() < 1e-12);
        assert!(robot.residual(&moved.q, &pose).largest() < 1e-12);
        let nearest = robot.ik_nearest(&pose, &q, &[1.0; 6]).unwrap();
        assert!(apart(&nearest.q, &q) < 1e-6, "{nearest:?}");
    }
}
