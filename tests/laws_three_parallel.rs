//! Laws of arms with three parallel axes, on random arms and random joint vectors.
#![allow(clippy::unwrap_used, missing_docs)]

use crate::common;

use std::f64::consts::PI;

use crate::common::parallel_arm::{ParallelArm, turn, wrapped};
use crate::common::{Rng, apart, profile};
use irbkin::{JacobianFrame, Mdh, Pose, PoseError, Reach, Robot, Sdh, pose_from_euler_zyx};
use nalgebra::{Matrix3, Vector3};
use proptest::prelude::*;

const SLACK: f64 = 0.05;

fn angles() -> impl Strategy<Value = [f64; 6]> {
    prop::array::uniform6(-PI..PI)
}

fn poses() -> impl Strategy<Value = Pose> {
    (prop::array::uniform3(-2.0..2.0), prop::array::uniform3(-PI..PI))
        .prop_map(|(xyz, zyx)| pose_from_euler_zyx(xyz, zyx).unwrap())
}

/// Arms of the form, with signs, offsets, a base and a flange; the parallel axes drawn at any places along themselves.
fn arms() -> impl Strategy<Value = ParallelArm> {
    let wrist = prop_oneof![Just(0.0), 0.01..0.3];
    let lengths = (
        -0.3..0.5,
        (0.02..0.3, -0.5..0.5, -0.5..0.5),
        0.0..1.0,
        0.2..1.5,
        0.2..1.5,
        wrist,
        0.01..0.3,
    );
    let signs = prop::array::uniform6(prop_oneof![Just(1.0), Just(-1.0)]);
    (lengths, signs, angles(), poses(), poses()).prop_map(
        |((a1, (b, b2, b3), c1, c2, c3, d5, d6), signs, offsets, base, flange)| ParallelArm {
            a1,
            b: [b2, b3, b - b2 - b3],
            c1,
            c2,
            c3,
            d5,
            d6,
            signs,
            offsets,
            base,
            flange,
        },
    )
}

/// How much of a pose's rounding there is: what it is summed from [m].
fn lengths(arm: &ParallelArm) -> f64 {
    let ends = arm.base.translation.vector.norm() + arm.flange.translation.vector.norm();
    1.0 + arm.reach() + arm.b.iter().map(|b| b.abs()).sum::<f64>() + ends
}

/// A joint vector that is not next to a singularity, where rounding of the pose would be seen in the joints.
fn is_regular(arm: &ParallelArm, theta: &[f64; 6]) -> bool {
    arm.x(theta).abs() > SLACK && theta[2].sin().abs() > SLACK && theta[4].sin().abs() > SLACK
}

/// How far rounding of the pose moves the joints: 40 roundings over the least singular value.
fn joint_bound(arm: &ParallelArm, robot: &Robot<6>, q: &[f64; 6]) -> f64 {
    40.0 * f64::EPSILON * lengths(arm) / robot.singularity(q).min_singular_value
}

proptest! {
    #![proptest_config(profile())]

    #[test]
    fn the_table_of_the_tests_is_that_of_their_geometry(arm in arms(), q in angles()) {
        // The wrist and the approach axis of forward kinematics stand where the lengths put them.
        let (theta, pose) = (arm.theta(&q), arm.robot().fk(&q));
        let (wrist, _) = arm.wrist(&pose);
        let (sin_1, cos_1) = theta[0].sin_cos();
        let along = [wrist.x * cos_1 + wrist.y * sin_1, wrist.y * cos_1 - wrist.x * sin_1];
        prop_assert!((along[0] - arm.x(&theta)).abs().max((along[1] - arm.b()).abs()) < 1e-14 * lengths(&arm));
    }

    #[test]
    fn all_branches_are_found(arm in arms(), q in angles()) {
        let robot = arm.robot();
        prop_assume!(is_regular(&arm, &arm.theta(&q)));
        let solutions = robot.ik(&robot.fk(&q)).unwrap();
        let nearest = solutions.iter().map(|s| apart(&s.q, &q)).fold(f64::INFINITY, f64::min);
        let bound = joint_bound(&arm, &robot, &q);
        prop_assert!(nearest <= bound, "off by {nearest:e}, bound {bound:e}");
    }

    #[test]
    fn every_solution_closes(arm in arms(), q in angles()) {
        let robot = arm.robot();
        let pose = robot.fk(&q);
        let solutions = robot.ik(&pose).unwrap();
        prop_assert!(!solutions.is_empty());
        for solution in &solutions {
            let residual = robot.residual(&solution.q, &pose);
            prop_assert!(residual.position <= 3e-15 * lengths(&arm), "{residual:?}");
            prop_assert!(residual.rotation <= 1e-14, "{residual:?}");
        }
    }

    #[test]
    fn every_shoulder_and_wrist_that_reaches_has_both_elbows(arm in arms(), q in angles()) {
        let (robot, theta) = (arm.robot(), arm.theta(&q));
        let pose = robot.fk(&q);
        prop_assume!(is_regular(&arm, &theta));
        let asked = arm.asked(&pose).unwrap().concat();
        // Beside the edge of reach, where rounding decides.
        prop_assume!(asked.iter().all(|asked| arm.margin(asked.end).abs() > 1e-9));
        let reached = asked.iter().filter(|asked| arm.missing(asked.end) == 0.0).count();
        let solutions = robot.ik(&pose).unwrap();
        prop_assert_eq!(solutions.len(), 2 * reached);
        for pair in [0, 1, 4, 5] {
            prop_assert_eq!(solutions.slot(pair).is_some(), solutions.slot(pair + 2).is_some());
        }
    }

    #[test]
    fn slots_are_the_signs_of_x_theta_3_and_theta_5(arm in arms(), q in angles()) {
        // Without a length, axis 5 points as its joint turns.
        let arm = ParallelArm { d5: arm.d5.max(0.01), ..arm };
        let robot = arm.robot();
        for solution in &robot.ik(&robot.fk(&q)).unwrap() {
            let theta = arm.theta(&solution.q);
            if is_regular(&arm, &theta) {
                prop_assert_eq!(usize::from(solution.slot), arm.slot(&theta));
            }
        }
    }

    #[test]
    fn wrist_flip_negates_theta_5(arm in arms(), q in angles()) {
        let arm = ParallelArm { offsets: [0.0; 6], ..arm };
        let robot = arm.robot();
        let solutions = robot.ik(&robot.fk(&q)).unwrap();
        let mut flips = 0;
        for slot in [0, 2, 4, 6] {
            if let (Some(told), Some(flipped)) = (solutions.slot(slot), solutions.slot(slot + 1)) {
                flips += 1;
                prop_assert_eq!(told.q[4].to_bits(), (-flipped.q[4]).to_bits());
                prop_assert_eq!(told.q[0].to_bits(), flipped.q[0].to_bits());
                prop_assert!((wrapped(told.q[5] - flipped.q[5]) - PI).abs() < 1e-15);
                let [phi, turned] = [told, flipped].map(|solution| arm.theta(&solution.q)[1..4].iter().sum::<f64>());
                prop_assert!((wrapped(phi - turned) - PI).abs() < 1e-14);
            }
        }
        prop_assume!(flips > 0);
    }

    #[test]
    fn the_determinant_is_the_product_of_its_factors(arm in arms(), q in angles(), tool in poses()) {
        let robot = arm.robot().with_tool(&tool).unwrap();
        let numeric = robot.jacobian(&q, JacobianFrame::Base).determinant();
        let closed = robot.three_parallel().unwrap().jacobian_determinant(&q);
        // A determinant of 6 x 6 has three rows of lengths; each is rounded as a pose is, and so are the factors.
        let scale = (lengths(&arm) + tool.translation.vector.norm()).powi(3);
        prop_assert!((numeric - closed).abs() < 1e-14 * scale, "{numeric} against {closed}");
        prop_assert!((robot.singularity(&q).manipulability - closed.abs()).abs() < 1e-13 * scale);
    }

    #[test]
    fn slots_are_stable_along_a_path(arm in arms(), q in angles(), velocity in prop::array::uniform6(-1.0..1.0_f64)) {
        let robot = arm.robot();
        let mut slots = Vec::new();
        for step in 0..200 {
            let ahead: [f64; 6] = std::array::from_fn(|i| q[i] + 0.02 * f64::from(step) * velocity[i]);
            if !is_regular(&arm, &arm.theta(&ahead)) {
                break;
            }
            let solutions = robot.ik(&robot.fk(&ahead)).unwrap();
            let bound = joint_bound(&arm, &robot, &ahead);
            slots.push(solutions.iter().find(|solution| apart(&solution.q, &ahead) <= bound).map(|solution| solution.slot));
        }
        prop_assume!(slots.len() > 10);
        prop_assert!(slots.iter().all(|slot| slot.is_some() && *slot == slots[0]), "{slots:?}");
    }

    #[test]
    fn shortfall_is_what_the_nearest_branch_lacks(arm in arms(), place in poses()) {
        let robot = arm.robot();
        let far = Vector3::from(place.translation.vector) * 0.5 * (arm.c2 + arm.c3 + arm.d5);
        let pose = arm.base * Pose::from_parts(far.into(), place.rotation) * arm.flange;
        let solutions = robot.ik(&pose).unwrap();
        let bound = 1e-14 * lengths(&arm);
        match arm.asked(&pose) {
            Err(inside) => {
                prop_assert_eq!(solutions.reach(), Reach::TooNear { shortfall: solutions.reach().shortfall() });
                prop_assert!((solutions.reach().shortfall() - inside).abs() < bound);
            }
            Ok(asked) => {
                let least = asked.concat().iter().map(|asked| asked.missing).fold(f64::INFINITY, |a, b| if b.abs() < a.abs() { b } else { a });
                // Rounding of the wrist's distance from axis 1 counts for much next to it.
                let x = asked[0][0].end[0] + arm.a1;
                prop_assume!(x.abs() > SLACK && (least == 0.0 || least.abs() > 1e-6));
                prop_assert!((solutions.reach().shortfall() - least.abs()).abs() < 20.0 * bound, "{:?} {least:e}", solutions.reach());
                prop_assert_eq!(solutions.is_empty(), least != 0.0);
                prop_assert_eq!(matches!(solutions.reach(), Reach::TooFar { .. }), least > 0.0);
            }
        }
    }

    #[test]
    fn base_and_tool_move_the_pose_and_not_the_joints(arm in arms(), q in angles(), base in poses(), tool in poses()) {
        let plain = arm.robot();
        prop_assume!(is_regular(&arm, &arm.theta(&q)));
        let robot = plain.clone().with_base(&base).unwrap().with_tool(&tool).unwrap();
        let (pose, flange) = (robot.fk(&q), plain.fk(&q));
        prop_assert!(PoseError::between(&pose, &(base * flange * tool)).largest() < 1e-14 * (10.0 + lengths(&arm)));
        let (ours, theirs) = (robot.ik(&pose).unwrap(), plain.ik(&flange).unwrap());
        for ours in ours.iter().filter(|solution| is_regular(&arm, &arm.theta(&solution.q))) {
            let theirs = theirs.slot(usize::from(ours.slot)).unwrap();
            let bound = 10.0 * joint_bound(&arm, &plain, &ours.q);
            prop_assert!(apart(&ours.q, &theirs.q) <= bound, "{:e}", apart(&ours.q, &theirs.q));
        }
    }

    #[test]
    fn a_table_may_have_its_frames_anywhere(arm in arms(), q in angles(), over in prop::array::uniform6(prop::bool::ANY), mirror in prop::array::uniform3(prop::bool::ANY)) {
        // Lengths of either sign: the arm is another one, and its own.
        let signed = |negative: bool, length: f64| if negative { -length } else { length };
        let b = if mirror[0] { arm.b.map(|b| -b) } else { arm.b };
        let arm = ParallelArm { b, d5: signed(mirror[1], arm.d5), d6: signed(mirror[2], arm.d6), ..arm };
        let (plain, table) = (arm.robot(), with_x_turned_over(arm.mdh(), over));
        let robot = Robot::from_mdh(table.clone()).unwrap();
        prop_assert_eq!(robot.family(), "three parallel axes");
        let pose = robot.fk(&q);
        prop_assert!(PoseError::between(&pose, &plain.fk(&q)).largest() < 1e-14 * lengths(&arm));
        let standard = Robot::from_sdh(Sdh::from(table)).unwrap();
        prop_assert!(PoseError::between(&pose, &standard.fk(&q)).largest() < 1e-14 * lengths(&arm));
        for robot in [robot, standard] {
            let solutions = robot.ik(&pose).unwrap();
            for solution in &solutions {
                prop_assert!(robot.residual(&solution.q, &pose).position <= 3e-15 * lengths(&arm));
                prop_assert!(robot.residual(&solution.q, &pose).rotation <= 1e-14);
            }
            let nearest = solutions.iter().map(|s| apart(&s.q, &q)).fold(f64::INFINITY, f64::min);
            prop_assert!(!is_regular(&arm, &arm.theta(&q)) || nearest <= joint_bound(&arm, &robot, &q), "off by {nearest:e}");
        }
    }
}

/// The same chain with the x axes of some frames turned over: `Rz(pi) Rx(alpha) Tx(a) = Rx(-alpha) Tx(-a) Rz(pi)`.
fn with_x_turned_over(mut mdh: Mdh<6>, over: [bool; 6]) -> Mdh<6> {
    let mut turned = false;
    for (row, over) in mdh.rows.iter_mut().zip(over) {
        if turned {
            (row.alpha, row.a, row.theta) = (-row.alpha, -row.a, row.theta - PI);
        }
        row.theta += if over { PI } else { 0.0 };
        turned = over;
    }
    if turned {
        mdh.flange = turn(Matrix3::from_diagonal(&Vector3::new(-1.0, -1.0, 1.0))) * mdh.flange;
    }
    mdh
}

#[test]
fn the_arm_of_the_tests_is_the_catalogues() {
    let mut rng = Rng::new(1);
    for name in ["UR3", "UR5e", "UR10e", "UR20"] {
        let (arm, robot) = ParallelArm::universal(name);
        let built = arm.robot();
        for _ in 0..100 {
            let q = std::array::from_fn(|_| rng.between(-PI, PI));
            let off = PoseError::between(&robot.fk(&q), &built.fk(&q)).largest();
            assert!(off < 1e-14 * (1.0 + arm.reach()), "{name}: {off:e}");
        }
    }
}

#[test]
fn what_is_not_the_form_is_refused_by_the_axes_that_are_off() {
    let refused = |spoil: fn(&mut Mdh<6>)| {
        let mut mdh = Robot::<6>::named("UR3").unwrap().mdh().clone();
        spoil(&mut mdh);
        let words = Robot::from_mdh(mdh).unwrap_err().to_string();
        words
            .strip_prefix(
                "no closed-form inverse kinematics for this arm: for three parallel axes, ",
            )
            .unwrap()
            .to_owned()
    };
    let two =
        |mdh: &mut Mdh<6>| (mdh.rows[2].alpha, mdh.rows[4].a) = (-0.02_f64.to_radians(), -2e-3);
    assert_eq!(
        refused(|mdh| mdh.rows[3].alpha += 0.01_f64.to_radians()),
        "axes 3 and 4 must be parallel, they are 0.010000 deg off"
    );
    assert_eq!(
        refused(|mdh| mdh.rows[1].alpha += 1e-3),
        "axes 1 and 2 must be at right angles, they are 0.057296 deg off"
    );
    assert_eq!(
        refused(|mdh| mdh.rows[5].a = 1e-3),
        "axes 5 and 6 must meet, they pass 1.000000 mm apart"
    );
    assert_eq!(
        refused(two),
        "axes 2 and 3 must be parallel, they are 0.020000 deg off; axes 4 and 5 must meet, they pass 2.000000 mm apart"
    );
    let short = |field: &str| format!("{field} is 0 m, it must be at least 1e-6 m");
    assert_eq!(refused(|mdh| mdh.rows[2].a = 0.0), short("upper arm (distance of axes 2 and 3)"));
    assert_eq!(refused(|mdh| mdh.rows[3].a = 0.0), short("forearm (distance of axes 3 and 4)"));
    let lateral =
        "lateral offset (of the wrist from the plane through axis 1 that is square to axis 2)";
    assert_eq!(refused(|mdh| mdh.rows[3].d = 0.0), short(lateral));
}

#[test]
fn a_table_in_text_is_made_exactly_the_form() {
    let (arm, exact) = ParallelArm::universal("UR5e");
    let mut mdh = exact.mdh().clone();
    // Ten digits.
    for (row, off) in mdh.rows.iter_mut().zip([3e-10, -4e-10, 2e-10, 5e-10, -3e-10, 1e-10]) {
        row.alpha += off;
        row.a += off;
    }
    let robot = Robot::from_mdh(mdh).unwrap();
    let q = [0.3, -1.2, 0.9, 0.4, -0.7, 1.1];
    let pose = robot.fk(&q);
    for solution in &robot.ik(&pose).unwrap() {
        let residual = robot.residual(&solution.q, &pose);
        assert!(
            residual.position <= 3e-15 * lengths(&arm) && residual.rotation <= 1e-14,
            "{residual:?}"
        );
    }
}
