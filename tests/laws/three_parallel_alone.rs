//! Laws of arms with three parallel axes alone.

use std::cell::Cell;
use std::f64::consts::PI;

use irbkin::{FreeJoint, Mdh, Pose, PoseDifference, Reach, Robot, thresholds};
use nalgebra::Vector3;
use proptest::prelude::*;
use proptest::test_runner::TestRunner;

use crate::common::{apart, divisor, enough, poses, profile, wrapped};
use crate::rng::Rng;
use crate::structures::three_parallel::{ParallelArm, arms, equal_links};
use crate::structures::{SIX, Subject};

fn angles() -> impl Strategy<Value = [f64; 6]> {
    prop::array::uniform6(-PI..PI)
}

fn is_regular(arm: &ParallelArm, theta: &[f64; 6]) -> bool {
    arm.x(theta).abs() > SLACK && theta[2].sin().abs() > SLACK && theta[4].sin().abs() > SLACK
}

const SLACK: f64 = 0.05;

/// The sum of the lengths that contribute to a position [m].
fn lengths(arm: &ParallelArm) -> f64 {
    1.0 + arm.reach()
}

proptest! {
    #![proptest_config(profile())]

    #[test]
    fn the_table_of_the_tests_is_that_of_their_geometry(arm in arms(), q in angles()) {
        // The wrist and the approach axis of forward kinematics are where the lengths put them.
        let (theta, pose) = (arm.theta(&q), arm.robot().fk(&q));
        let (wrist, _) = arm.wrist(&pose);
        let (sin_1, cos_1) = theta[0].sin_cos();
        let along = [wrist.x * cos_1 + wrist.y * sin_1, wrist.y * cos_1 - wrist.x * sin_1];
        let off = (along[0] - arm.x(&theta)).abs().max((along[1] - arm.b()).abs());
        prop_assert!(off < 1e-14 * lengths(&arm));
    }

    #[test]
    fn every_shoulder_and_wrist_that_reaches_has_both_elbows(arm in arms(), q in angles()) {
        let (robot, theta) = (arm.robot(), arm.theta(&q));
        let pose = robot.fk(&q);
        prop_assume!(is_regular(&arm, &theta));
        let asked = arm.asked(&pose).unwrap().concat();
        // Not at the edge of reach, where rounding decides.
        prop_assume!(asked.iter().all(|asked| arm.margin(asked.end).abs() > 1e-9));
        let reached = asked.iter().filter(|asked| arm.missing(asked.end) == 0.0).count();
        let solutions = robot.ik(&pose).unwrap();
        prop_assert_eq!(solutions.len(), 2 * reached);
        for pair in [0, 1, 4, 5] {
            prop_assert_eq!(solutions.slot(pair).is_some(), solutions.slot(pair + 2).is_some());
        }
    }

    /// Lengths of either sign: a different arm with its own solutions.
    #[test]
    fn lengths_may_be_negative(
        arm in arms(),
        q in angles(),
        mirror in prop::array::uniform3(prop::bool::ANY),
    ) {
        let signed = |negative: bool, length: f64| if negative { -length } else { length };
        let b = if mirror[0] { arm.b.map(|b| -b) } else { arm.b };
        let (d5, d6) = (signed(mirror[1], arm.d5), signed(mirror[2], arm.d6));
        let subject = Subject::new("mirrored", ParallelArm { b, d5, d6, ..arm }, &SIX);
        prop_assert_eq!(subject.robot.structure(), "three parallel axes");
        let pose = subject.robot.fk(&q);
        let solutions = subject.ik(&pose, &q);
        for solution in &solutions {
            let residual = subject.robot.residual(&solution.q, &pose);
            prop_assert!(residual.position <= subject.closure()[0] && residual.rotation <= 1e-14);
        }
        // Another case is drawn in its place.
        prop_assume!(subject.is_regular(&q));
        let nearest = solutions.iter().map(|s| apart(&s.q, &q)).fold(f64::INFINITY, f64::min);
        prop_assert!(nearest <= subject.joint_bound(&q), "off by {nearest:e}");
    }
}

#[test]
fn shortfall_is_that_of_the_nearest_branch() {
    // Poses inside the cylinder of the lateral offset, out of reach of the links, and in reach.
    let [inside, beyond, reached] = [Cell::new(0), Cell::new(0), Cell::new(0)];
    let count = |cell: &Cell<usize>| cell.set(cell.get() + 1);
    let law = |(arm, place, kind): (ParallelArm, Pose, u8)| {
        let robot = arm.robot();
        let mut flange = place.translation.vector * (0.5 * (arm.c2 + arm.c3 + arm.d5));
        if kind == 0 {
            // The wrist in and around the cylinder.
            let wrist = place.translation.vector * (0.45 * arm.b());
            let approach: Vector3<f64> = place.rotation.matrix().column(1).into();
            flange = wrist + approach * arm.d6 + Vector3::z() * arm.c1;
        }
        let pose = arm.base * Pose::from_parts(flange.into(), place.rotation) * arm.flange;
        let solutions = robot.ik(&pose).unwrap();
        let (reach, shortfall) = (solutions.reach(), solutions.reach().shortfall());
        let bound = 1e-14 * lengths(&arm);
        let asked = match arm.asked(&pose) {
            Ok(asked) => asked,
            Err(missing) => {
                count(&inside);
                prop_assert_eq!(reach, Reach::TooNear { shortfall });
                prop_assert!((shortfall - missing).abs() < bound);
                return Ok(());
            }
        };
        let nearer = |a: f64, b: f64| if b.abs() < a.abs() { b } else { a };
        let least = asked.concat().iter().map(|asked| asked.missing).fold(f64::INFINITY, nearer);
        // Near axis 1, rounding of the wrist's distance from it has a large effect.
        let x = asked[0][0].end[0] + arm.a1;
        prop_assume!(x.abs() > SLACK && (least == 0.0 || least.abs() > 1e-6));
        count(if least == 0.0 { &reached } else { &beyond });
        prop_assert!((shortfall - least.abs()).abs() < 20.0 * bound, "{reach:?} {least:e}");
        prop_assert_eq!(solutions.is_empty(), least != 0.0);
        prop_assert_eq!(matches!(reach, Reach::TooFar { .. }), least > 0.0);
        Ok(())
    };
    TestRunner::new(profile()).run(&(arms(), poses(2.0), 0..4_u8), law).unwrap();
    println!("inside {inside:?}, beyond {beyond:?}, reached {reached:?}");
    let least = 200 / divisor();
    assert!(enough([inside, beyond, reached].iter().all(|count| count.get() > least)));
}

#[test]
fn the_arm_of_the_tests_is_that_of_the_catalog() {
    let mut rng = Rng::new(1);
    for name in ["UR3", "UR5e", "UR10e", "UR20"] {
        let (arm, robot) = ParallelArm::universal(name);
        let built = arm.robot();
        for _ in 0..100 {
            let q = std::array::from_fn(|_| rng.between(-PI, PI));
            let off = PoseDifference::between(&robot.fk(&q), &built.fk(&q)).largest();
            assert!(off < 1e-14 * (1.0 + arm.reach()), "{name}: {off:e}");
        }
    }
}

#[test]
fn a_table_of_another_structure_is_general_and_notes_the_axes_that_deviate() {
    let refused = |spoil: fn(&mut Mdh<6>)| {
        let mut mdh = Robot::<6>::named("UR3").unwrap().mdh().clone();
        spoil(&mut mdh);
        let words = match Robot::from_mdh(mdh) {
            Ok(robot) => {
                assert_eq!(robot.structure(), "general");
                robot.missing_form().unwrap().to_string()
            }
            // Without an upper arm, two axes are one.
            Err(refusal) => refusal.to_string(),
        };
        words
            .rsplit_once("for three parallel axes, ")
            .unwrap()
            .1
            // Whether snap takes it is told last.
            .split(" (write the angles")
            .next()
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
        "axes 2 and 3 must be parallel, they are 0.020000 deg off; axes 4 and 5 must meet, they \
         pass 2.000000 mm apart"
    );
    let short = |field: &str| format!("{field} is 0 m, it must be at least 1e-6 m");
    assert_eq!(refused(|mdh| mdh.rows[2].a = 0.0), short("upper arm (distance of axes 2 and 3)"));
    assert_eq!(refused(|mdh| mdh.rows[3].a = 0.0), short("forearm (distance of axes 3 and 4)"));
    let lateral =
        "lateral offset (of the wrist from the plane through axis 1 that is square to axis 2)";
    assert_eq!(refused(|mdh| mdh.rows[3].d = 0.0), short(lateral));
}

#[test]
fn a_table_in_text_is_made_exact() {
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

/// Poses with joint 6 free on an arc of a few degrees, or past axis 2 by a picometer, each with the
/// joint 6 of a seed: a member is nearer to the seed than the ends of the arc are.
#[test]
fn no_member_of_a_narrow_family_is_nearer_than_the_answer() {
    let [ur_3, ur_10e] = ["UR3", "UR10e"].map(|name| ParallelArm::universal(name).0);
    let equal = equal_links();
    let pinned: [(&ParallelArm, [f64; 6], f64); 5] = [
        (&ur_3, [0.32, 0.592, -1e-7, -0.0167, PI, 3.079], -3.035),
        (&ur_10e, [-0.0064, -0.486, 0.0, -0.0356, PI, 0.2065], 0.2484),
        (&equal, [0.73, -0.94, 2e-9, -0.0087, PI, -2.827], -2.785),
        (&equal, [2.56, 2.255, -1e-4, -0.0242, PI, -1.587], -1.507),
        (&equal, [-1.33, -2.3, PI - 1e-12, 1.43, PI, -1.505], -0.921),
    ];
    for (arm, theta, seed_6) in pinned {
        let (robot, q) = (arm.robot(), arm.q(theta));
        let (pose, mut seed) = (robot.fk(&q), q);
        seed[5] = arm.q([seed_6; 6])[5];
        let cost = |q: &[f64; 6]| (0..6).map(|i| wrapped(q[i] - seed[i]).powi(2)).sum::<f64>();
        let found = robot.ik_nearest(&pose, &seed, &[1.0; 6]).unwrap();
        let solutions = robot.ik(&pose).unwrap();
        let families =
            solutions.iter().filter(|found| found.free_joint == Some(FreeJoint::Parallel));
        let members = families.flat_map(|family| {
            let angles = (-500..=500).map(|step| q[5] + 2e-4 * f64::from(step));
            angles.filter_map(|six| robot.with_free_joint(&pose, family, six).ok()?)
        });
        let met = members.map(|member| member.q).filter(|q| {
            robot.residual(q, &pose).largest() <= thresholds::POSITION_ROUNDING * arm.reach()
        });
        let least = met.map(|q| cost(&q)).fold(cost(&q), f64::min);
        assert!(cost(&found.q) <= least + 1e-9, "{theta:?}: {} {least}", cost(&found.q));
    }
}
