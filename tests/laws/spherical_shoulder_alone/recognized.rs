//! Tables with any frames and any zero pose.

use std::f64::consts::PI;

use irbkin::{Mdh, PoseDifference, Robot, Sdh};

use crate::common::{enough, poses_or, random_pose};
use crate::rng::Rng;
use crate::structures::spherical_shoulder::{self, ShoulderArm};
use crate::structures::three_parallel::arm::{quarters_about_x, turn};
use crate::structures::{SEVEN, Subject};

/// The same arm by another table. Frames are flipped about x (joint signs), rotated about z by half
/// a turn (the sides of x), and joints have other zeros. `signs` and `shifts` receive the change of
/// the joint angles: `q_old = sign q_new + shift`.
fn rewritten(rng: &mut Rng, mdh: &Mdh<7>) -> (Mdh<7>, [f64; 7], [f64; 7]) {
    let mut rows = mdh.rows;
    let (mut signs, mut shifts) = ([1.0; 7], [0.0; 7]);
    let mut flange = mdh.flange;
    for i in 0..7 {
        let d = rows[i].d;
        if rng.sign() < 0.0 {
            // Rz(-q) = Rx(pi) Rz(q) Rx(-pi).
            signs[i] = -1.0;
            rows[i].alpha += PI;
            (rows[i].theta, rows[i].d) = (-rows[i].theta, -d);
            match rows.get_mut(i + 1) {
                Some(next) => next.alpha -= PI,
                None => flange = turn(quarters_about_x(2)) * flange,
            }
        }
        if i > 0 && rng.sign() < 0.0 {
            // Rx(alpha) Tx(a) = Rz(pi) Rx(-alpha) Tx(-a) Rz(-pi).
            (rows[i].alpha, rows[i].a) = (-rows[i].alpha, -rows[i].a);
            rows[i - 1].theta += PI;
            rows[i].theta -= PI;
        }
        shifts[i] = rng.between(-PI, PI);
        rows[i].theta += signs[i] * shifts[i];
    }
    (Mdh { base: mdh.base, rows, flange }, signs, shifts)
}

/// Compares the forward kinematics and solves poses of the rewritten table.
fn assert_same_arm(
    original: &Subject<7>,
    table: &Mdh<7>,
    [signs, shifts]: [&[f64; 7]; 2],
    rng: &mut Rng,
) {
    let robot = Robot::from_mdh(table.clone()).unwrap();
    let rewritten = original.clone().with_robot(|_| robot);
    for _ in 0..10 {
        let q = rng.angles();
        let pose = rewritten.robot.fk(&q);
        let q_original = std::array::from_fn(|i| signs[i] * q[i] + shifts[i]);
        let error = PoseDifference::between(&original.robot.fk(&q_original), &pose);
        assert!(error.position < 1e-14 && error.rotation < 1e-14, "{error:?}\n{table:?}");
        let solutions = rewritten.ik(&pose, &q);
        let off =
            solutions.iter().map(|s| crate::common::apart(&s.q, &q)).fold(f64::INFINITY, f64::min);
        let bound = (8e-15 / rewritten.least_singular_value(&q)).max(1e-9);
        assert!(off < bound, "{q:?}\n{table:?}\n{solutions:?}");
        for solution in &solutions {
            let residual = rewritten.robot.residual(&solution.q, &pose).largest();
            assert!(residual < 1e-14, "{residual:e} of {solution:?}\n{table:?}");
        }
    }
}

fn subjects() -> impl Iterator<Item = Subject<7>> {
    let bare = |subject: Subject<7>| {
        let robot = subject.arm.robot();
        subject.with_robot(|_| robot)
    };
    spherical_shoulder::structure().subjects.into_iter().map(bare)
}

#[test]
fn tables_with_any_frames_and_zero_pose_are_recognized() {
    let mut rng = Rng::new(20);
    for subject in subjects() {
        for _ in 0..poses_or(20_000) / 100 {
            let (mut table, signs, shifts) = rewritten(&mut rng, subject.robot.mdh());
            let ends = [random_pose(&mut rng, 0.8), random_pose(&mut rng, 0.8)];
            let [before, behind] = ends;
            let original = subject
                .clone()
                .with_robot(|robot| robot.with_base(&before).unwrap().with_tool(&behind).unwrap());
            (table.base, table.flange) = (before * table.base, table.flange * behind);
            assert_same_arm(&original, &table, [&signs, &shifts], &mut rng);
        }
    }
}

#[test]
fn a_standard_table_is_recognized() {
    let mut rng = Rng::new(21);
    for subject in subjects() {
        for _ in 0..50 {
            let (table, signs, shifts) = rewritten(&mut rng, subject.robot.mdh());
            let table = Mdh::from(Sdh::from(table));
            assert_same_arm(&subject, &table, [&signs, &shifts], &mut rng);
        }
    }
}

/// Slots of elbow and wrist only: the bit of the shoulder is the sign of joint 2, which may count
/// the other way.
#[test]
fn slots_do_not_depend_on_the_frames_of_a_table() {
    let mut rng = Rng::new(22);
    let arm = Subject::new("Panda", ShoulderArm::panda(), &SEVEN);
    let mut compared = 0;
    for _ in 0..200 {
        let (mut table, signs, shifts) = rewritten(&mut rng, arm.robot.mdh());
        // The joints have the same zeros.
        for i in 0..7 {
            table.rows[i].theta -= signs[i] * shifts[i];
        }
        let other = arm.clone().with_robot(|_| Robot::from_mdh(table.clone()).unwrap());
        let q = rng.angles();
        let turned = std::array::from_fn(|i| signs[i] * q[i]);
        let pose = arm.robot.fk(&q);
        let (ours, theirs) = (arm.ik(&pose, &q), other.ik(&pose, &turned));
        for ours in ours.iter().filter(|solution| arm.is_regular(&solution.q)) {
            let same = |solution: &&irbkin::Solution<7>| {
                let back = std::array::from_fn(|i| signs[i] * solution.q[i]);
                crate::common::apart(&back, &ours.q) < 1e-9
            };
            let theirs = theirs.iter().find(same).unwrap();
            assert_eq!(theirs.slot.index() & 3, ours.slot.index() & 3, "{table:?}");
            compared += 1;
        }
    }
    assert!(enough(compared > 400), "{compared}");
}

#[test]
fn a_table_rounded_in_text_is_made_exact() {
    let mut table = ShoulderArm::panda().mdh();
    for row in &mut table.rows {
        row.alpha += 5e-10;
        (row.a, row.d) = (row.a + 4e-10, row.d - 4e-10);
    }
    let robot = Robot::from_mdh(table).unwrap();
    let rows = &robot.mdh().rows;
    assert_eq!([rows[1].a, rows[1].d, rows[2].a, rows[3].d, rows[5].a], [0.0; 5]);
    let q = [0.3, -0.4, 0.5, -1.2, 0.6, 1.5, 0.2];
    let pose = robot.fk(&q);
    let solutions = robot.ik(&pose, q[6]).unwrap();
    assert!(solutions.len() >= 4);
    for solution in &solutions {
        assert!(robot.residual(&solution.q, &pose).largest() < 1e-14);
    }
}

#[test]
fn the_condition_that_a_table_violates_is_named() {
    let mut table = ShoulderArm::panda().mdh();
    table.rows[2].alpha += 0.01_f64.to_radians();
    table.rows[3].d = 0.002;
    table.rows[5].a = 0.0005;
    assert_eq!(
        Robot::from_mdh(table).unwrap().missing_form().unwrap().to_string(),
        "for a spherical shoulder and an offset elbow, axes 2 and 3 must be at right angles, \
         they are 0.010000 deg \
         off; axes 5 and 6 must meet, they pass 0.500000 mm apart; axes 3 and 5 must lie in one \
         plane, they pass 2.000000 mm apart"
    );
}

#[test]
fn links_without_length_are_refused() {
    let refusal = |change: fn(&mut Mdh<7>)| {
        let mut table = ShoulderArm::panda().mdh();
        change(&mut table);
        Robot::from_mdh(table).unwrap().unknown_structure().unwrap().to_string()
    };
    let upper = refusal(|table| (table.rows[2].d, table.rows[3].a) = (0.0, 0.0));
    assert!(upper.contains("upper arm (distance of axis 4 from the shoulder)"), "{upper}");
    let forearm = refusal(|table| (table.rows[4].d, table.rows[4].a) = (0.0, 0.0));
    assert!(forearm.contains("forearm (distance of axis 6 from axis 4)"), "{forearm}");
}
