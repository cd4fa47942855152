//! Laws of the kinematics, on random arms and random joint vectors.
#![allow(clippy::unwrap_used, clippy::float_cmp, clippy::cast_precision_loss, missing_docs)]

use crate::common;

use std::f64::consts::{FRAC_PI_2, PI};

use crate::common::{apart, central_difference, difference_bound, profile, reach_of};
use irbkin::{
    DhRow, JacobianFrame, JointLimits, Mdh, OpwParameters, Pose, PoseError, Robot, Sdh, Status,
    pose_from_euler_zyx,
};
use proptest::prelude::*;

const SLACK: f64 = 0.05;

fn angles() -> impl Strategy<Value = [f64; 6]> {
    prop::array::uniform6(-PI..PI)
}

/// Arms of the form, with offsets, signs and a lateral offset.
fn arms() -> impl Strategy<Value = OpwParameters> {
    let lengths = (
        -0.3..0.5,
        -0.3..0.3,
        prop_oneof![Just(0.0), -0.2..0.2],
        0.0..1.0,
        0.2..1.5,
        0.2..1.5,
        0.0..0.3,
    );
    let signs = prop::array::uniform6(prop_oneof![Just(1_i8), Just(-1_i8)]);
    (lengths, angles(), signs).prop_map(|((a1, a2, b, c1, c2, c3, c4), offsets, signs)| {
        OpwParameters { a1, a2, b, c1, c2, c3, c4, offsets, signs }
    })
}

fn poses() -> impl Strategy<Value = Pose> {
    (prop::array::uniform3(-2.0..2.0), prop::array::uniform3(-PI..PI))
        .prop_map(|(xyz, zyx)| pose_from_euler_zyx(xyz, zyx).unwrap())
}

/// A joint vector that is not next to a singularity, where rounding of the pose would be seen in the joints.
fn is_regular(robot: &Robot<6>, q: &[f64; 6]) -> bool {
    let d = robot.singularity(q).distances.unwrap();
    d.wrist > SLACK && d.elbow > SLACK && d.shoulder > SLACK
}

/// ABB's cfx by the tests of its definition, on the sign-corrected angles.
fn cfx(opw: &OpwParameters, q: &[f64; 6]) -> u8 {
    let theta: [f64; 6] = std::array::from_fn(|i| f64::from(opw.signs[i]) * q[i] - opw.offsets[i]);
    let [_, t2, t3, _, t5, _] = theta;
    let behind_axis_1 =
        opw.a1 + opw.c2 * t2.sin() + opw.c3 * (t2 + t3).sin() + opw.a2 * (t2 + t3).cos() < 0.0;
    let behind_lower_arm = opw.c3 * t3.sin() + opw.a2 * t3.cos() < 0.0;
    4 * u8::from(behind_axis_1) + 2 * u8::from(behind_lower_arm) + u8::from(t5.sin() < 0.0)
}

proptest! {
    #![proptest_config(profile())]

    #[test]
    fn all_branches_are_found(opw in arms(), q in angles()) {
        let robot = Robot::from_opw(opw).unwrap();
        prop_assume!(is_regular(&robot, &q));
        let pose = robot.fk(&q);
        let solutions = robot.ik(&pose).unwrap();
        let nearest = solutions.iter().map(|s| apart(&s.q, &q)).fold(f64::INFINITY, f64::min);
        // 40 roundings of the pose over the least singular value; a regular joint vector of these arms has one above 1e-4.
        let bound = 40.0 * f64::EPSILON * (1.0 + reach_of(&robot)) / robot.singularity(&q).min_singular_value;
        prop_assert!(nearest <= bound, "off by {nearest:e}, bound {bound:e}");
    }

    #[test]
    fn every_solution_closes(opw in arms(), q in angles()) {
        let robot = Robot::from_opw(opw).unwrap();
        let pose = robot.fk(&q);
        let solutions = robot.ik(&pose).unwrap();
        prop_assert!(!solutions.is_empty());
        for solution in &solutions {
            let residual = robot.residual(&solution.q, &pose);
            prop_assert!(residual.position <= 3e-15 * (1.0 + reach_of(&robot)), "{residual:?}");
            prop_assert!(residual.rotation <= 1e-14, "{residual:?}");
        }
    }

    #[test]
    fn slots_are_cfx(opw in arms(), q in angles()) {
        let robot = Robot::from_opw(opw).unwrap();
        for solution in &robot.ik(&robot.fk(&q)).unwrap() {
            if is_regular(&robot, &solution.q) {
                prop_assert_eq!(solution.slot, cfx(&opw, &solution.q));
            }
        }
    }

    #[test]
    fn wrist_flip_negates_q5(opw in arms(), q in angles()) {
        let robot = Robot::from_opw(OpwParameters { offsets: [0.0; 6], ..opw }).unwrap();
        let solutions = robot.ik(&robot.fk(&q)).unwrap();
        for slot in [0, 2, 4, 6] {
            if let (Some(plain), Some(flipped)) = (solutions.slot(slot), solutions.slot(slot + 1)) {
                prop_assert_eq!(plain.q[4], -flipped.q[4]);
                prop_assert_eq!(plain.q[..3].to_vec(), flipped.q[..3].to_vec());
            }
        }
    }

    #[test]
    fn jacobian_matches_central_differences(opw in arms(), q in angles(), tool in poses()) {
        let robot = Robot::from_opw(opw).unwrap().with_tool(&tool).unwrap();
        let jacobian = robot.jacobian(&q, JacobianFrame::Base);
        let bound = difference_bound(reach_of(&robot) + tool.translation.vector.norm());
        for joint in 0..6 {
            for (row, wanted) in central_difference(&robot, &q, joint).into_iter().enumerate() {
                prop_assert!((jacobian[(row, joint)] - wanted).abs() < bound);
            }
        }
    }

    #[test]
    fn the_tool_jacobian_is_the_base_jacobian_turned(opw in arms(), q in angles(), tool in poses()) {
        let robot = Robot::from_opw(opw).unwrap().with_tool(&tool).unwrap();
        let rotation = robot.fk(&q).rotation;
        let (base, tool) = (robot.jacobian(&q, JacobianFrame::Base), robot.jacobian(&q, JacobianFrame::Tool));
        for joint in 0..6 {
            for half in [0, 3] {
                let turned = rotation.inverse() * base.fixed_view::<3, 1>(half, joint);
                prop_assert!((turned - tool.fixed_view::<3, 1>(half, joint)).norm() < 1e-14 * (10.0 + reach_of(&robot)));
            }
        }
    }

    #[test]
    fn the_determinant_is_the_product_of_its_factors(opw in arms(), q in angles(), tool in poses()) {
        let robot = Robot::from_opw(opw).unwrap().with_tool(&tool).unwrap();
        let numeric = robot.jacobian(&q, JacobianFrame::Base).determinant();
        let closed = robot.spherical_wrist().unwrap().jacobian_determinant(&q);
        // An LU of six columns, each no longer than the reach with the tool.
        let scale = (1.0 + reach_of(&robot) + tool.translation.vector.norm()).powi(3);
        prop_assert!((numeric - closed).abs() < 1e-14 * scale, "{numeric} against {closed}");
        let singularity = robot.singularity(&q);
        prop_assert!((singularity.manipulability - closed.abs()).abs() < 1e-13 * scale);
    }

    #[test]
    fn a_table_of_the_arm_is_the_arm(opw in arms(), q in angles()) {
        let robot = Robot::from_opw(opw).unwrap();
        let from_table = Robot::from_mdh(robot.mdh().clone()).unwrap();
        let pose = robot.fk(&q);
        prop_assert!(PoseError::between(&pose, &from_table.fk(&q)).largest() < 1e-14 * (1.0 + reach_of(&robot)));
        let (ours, theirs) = (robot.ik(&pose).unwrap(), from_table.ik(&pose).unwrap());
        for solution in ours.iter().filter(|s| is_regular(&robot, &s.q)) {
            let nearest = theirs.iter().map(|other| apart(&other.q, &solution.q)).fold(f64::INFINITY, f64::min);
            prop_assert!(nearest < 1e-10, "off by {nearest:e}");
        }
        prop_assert_eq!(ours.len(), theirs.len());
    }

    #[test]
    fn both_conventions_describe_the_same_arm(opw in arms(), q in angles()) {
        let robot = Robot::from_opw(opw).unwrap();
        let standard = Sdh::from(robot.mdh().clone());
        let back = Robot::serial_chain(Mdh::from(standard)).unwrap();
        prop_assert!(PoseError::between(&robot.fk(&q), &back.fk(&q)).largest() < 1e-14 * (1.0 + reach_of(&robot)));
    }

    #[test]
    fn base_and_tool_move_the_pose_and_not_the_joints(opw in arms(), q in angles(), base in poses(), tool in poses()) {
        let plain = Robot::from_opw(opw).unwrap();
        prop_assume!(is_regular(&plain, &q));
        let robot = plain.clone().with_base(&base).unwrap().with_tool(&tool).unwrap();
        let (pose, flange) = (robot.fk(&q), plain.fk(&q));
        prop_assert!(PoseError::between(&pose, &(base * flange * tool)).largest() < 1e-14 * (10.0 + reach_of(&robot)));
        let (ours, theirs) = (robot.ik(&pose).unwrap(), plain.ik(&flange).unwrap());
        prop_assert_eq!(ours.len(), theirs.len());
        for (a, b) in ours.iter().zip(&theirs).filter(|(a, _)| is_regular(&plain, &a.q)) {
            prop_assert_eq!(a.slot, b.slot);
            // The pose is rounded where the base and the tool put it, up to 10 m from here.
            let bound = 400.0 * f64::EPSILON * (10.0 + reach_of(&robot)) / plain.singularity(&a.q).min_singular_value;
            prop_assert!(apart(&a.q, &b.q) <= bound, "{:e}", apart(&a.q, &b.q));
        }
    }

    #[test]
    fn link_frames_end_at_the_tool(opw in arms(), q in angles()) {
        let robot = Robot::from_opw(opw).unwrap();
        let (frames, tool) = robot.link_frames(&q);
        prop_assert_eq!(tool, robot.fk(&q));
        prop_assert_eq!(frames[5] * robot.mdh().flange, tool);
    }

    #[test]
    fn turns_are_solutions_inside_the_limits(q in angles()) {
        let robot: Robot<6> = Robot::named("IRB 2600-12/1.65").unwrap();
        let solutions = robot.ik(&robot.fk(&q)).unwrap();
        let turns: Vec<_> = solutions.turns().collect();
        prop_assert_eq!(turns.len().to_string(), solutions.turn_count().to_string());
        for turn in &turns {
            prop_assert!(robot.limits().contain(&turn.q));
            prop_assert!(robot.residual(&turn.q, solutions.pose()).largest() < 1e-14);
        }
        let nearest = solutions.nearest(&q, &[1.0; 6]);
        let cost = |s: &irbkin::Solution<6>| s.q.iter().zip(&q).map(|(a, b)| (a - b).powi(2)).sum::<f64>();
        let least = turns.iter().map(cost).fold(f64::INFINITY, f64::min);
        prop_assert_eq!(nearest.map_or(f64::INFINITY, |s| cost(&s)), least);
    }

    #[test]
    fn any_pose_has_an_answer_or_a_shortfall(pose in poses()) {
        let robot: Robot<6> = Robot::named("IRB 120-3/0.58").unwrap();
        let solutions = robot.ik(&pose).unwrap();
        prop_assert_eq!(solutions.is_empty(), solutions.reach().shortfall() > 0.0);
        prop_assert_eq!(solutions.status().iter().filter(|s| s.contains(Status::FOUND)).count(), solutions.len());
    }
}

#[test]
fn shortfall_is_the_way_back_to_reach() {
    let robot: Robot<6> = Robot::named("IRB 2600-12/1.65").unwrap();
    // Stretched upwards: theta_3 makes upper arm and forearm one line.
    let stretched = [0.4, 0.3, (0.115_f64).atan2(0.795) - FRAC_PI_2, 0.0, 0.5, 0.0];
    let mut pose = robot.fk(&stretched);
    let outward = nalgebra::Vector3::new(
        0.3_f64.sin() * 0.4_f64.cos(),
        0.3_f64.sin() * 0.4_f64.sin(),
        0.3_f64.cos(),
    );
    pose.translation.vector += outward * 0.012;
    let solutions = robot.ik(&pose).unwrap();
    assert!(solutions.is_empty());
    assert!((solutions.reach().shortfall() - 0.012).abs() < 1e-15);
    assert_eq!(solutions.explain().to_string(), "wrist centre 12.0 mm beyond reach");
}

#[test]
fn a_solution_stands_for_the_turn_inside_the_limits() {
    let robot: Robot<6> = Robot::named("IRB 1600-6/1.45").unwrap();
    let q = [0.2, 0.1, (-230.0_f64).to_radians(), 0.3, 0.4, 0.5];
    let found = robot.ik(&robot.fk(&q)).unwrap();
    let same = found.iter().find(|s| apart(&s.q, &q) < 1e-10).unwrap();
    assert!((same.q[2] - q[2]).abs() < 1e-10 && same.within_limits());
}

#[test]
fn limits_that_are_empty_are_refused_by_name() {
    let refused = JointLimits::new([[0.0, 1.0], [1.2, -0.5]]).unwrap_err();
    assert_eq!(refused.to_string(), "joint 2 limit is empty: lower 1.2 rad > upper -0.5 rad");
}

#[test]
fn a_lateral_offset_of_rounding_is_none() {
    let mut mdh = Robot::<6>::named("IRB 1200-5/0.9").unwrap().mdh().clone();
    (mdh.rows[1].d, mdh.rows[2].d) = (0.1 + 0.2, -0.3);
    let from_table = Robot::from_mdh(mdh).unwrap();
    let from_opw = Robot::from_opw(OpwParameters {
        b: 1e-12,
        ..OpwParameters::abb(0.0, -0.042, 0.3991, 0.448, 0.451, 0.082)
    })
    .unwrap();
    let over_the_base = pose_from_euler_zyx([0.0, 0.0, 1.2], [0.0; 3]).unwrap();
    for robot in [from_table, from_opw] {
        let solutions = robot.ik(&over_the_base).unwrap();
        assert!(!solutions.is_empty());
        for solution in &solutions {
            assert!(robot.residual(&solution.q, &over_the_base).largest() < 1e-14);
        }
    }
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
    assert_eq!(limits([f64::INFINITY; 2]), "lower limit of joint 1 is inf, it must be finite");
    assert!(JointLimits::new([[f64::NEG_INFINITY, f64::INFINITY]]).is_ok());
}

#[test]
fn a_solution_of_another_pose_has_no_family_here() {
    let robot: Robot<6> = Robot::named("IRB 2600-12/1.65").unwrap();
    let home = robot.fk(&[0.0; 6]);
    let free = *robot.ik(&home).unwrap().slot(0).unwrap();
    let other = robot.fk(&[0.3, -0.2, 0.4, 0.5, -0.6, 0.7]);
    assert!(robot.with_free(&home, &free, 0.4).unwrap().is_some());
    assert!(
        robot
            .with_free(&other, &free, 0.4)
            .unwrap_err()
            .to_string()
            .starts_with("solution: its tool is ")
    );
}

#[test]
fn the_choice_refuses_what_is_no_seed() {
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
    let refused = irbkin::batch::fk(&robot, &[0.0; 12], &mut [0.0; 16]).unwrap_err();
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
    irbkin::batch::fk(&robot, &q, &mut poses).unwrap();
    assert_eq!(irbkin::pose_to_rows(&robot.fk(&q)), poses);
    assert_eq!(robot.fk(&q), tool);
    assert_eq!(
        robot.jacobian(&q, JacobianFrame::Base).column(8).fixed_rows::<3>(3),
        frames[8].rotation.matrix().column(2)
    );
}

#[test]
fn a_short_forearm_and_far_offsets_cost_no_digit() {
    let short =
        OpwParameters { a2: 0.0, c3: 1e-3, ..OpwParameters::abb(0.0, 0.0, 0.3, 1.0, 0.0, 0.1) };
    let turned = OpwParameters {
        offsets: [100.0, -50.0, 1e4, 7.0, -7.0, 1e5],
        ..OpwParameters::abb(0.15, -0.11, 0.45, 0.7, 0.8, 0.1)
    };
    for opw in [short, turned] {
        let robot = Robot::from_opw(opw).unwrap();
        let mut rng = common::Rng::new(7);
        for _ in 0..2000 {
            let pose = robot.fk(&std::array::from_fn(|_| rng.between(-PI, PI)));
            let solutions = robot.ik(&pose).unwrap();
            assert!(!solutions.is_empty());
            for solution in &solutions {
                let residual = robot.residual(&solution.q, &pose);
                assert!(residual.position <= 3e-15 * (1.0 + reach_of(&robot)), "{residual:?}");
                assert!(residual.rotation <= 1e-14, "{residual:?}");
            }
        }
    }
}
