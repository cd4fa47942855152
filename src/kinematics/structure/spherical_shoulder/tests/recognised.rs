//! Tables with their frames and their zero pose anywhere.

use std::string::ToString;

use super::*;
use crate::kinematics::chain::dh::{Sdh, screw_x};

/// The same arm by another table. Frames are turned over about x (joint signs), about z by half a turn (the sides of x), and joints read zero
/// elsewhere. `signs` and `shifts` get what they did to the joint angles: `q_old = sign q_new + shift`.
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
                None => flange = screw_x(-PI, 0.0) * flange,
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
fn same_arm(
    original: &Chain<7>,
    table: &Mdh<7>,
    [signs, shifts]: [&[f64; 7]; 2],
    rng: &mut Rng,
) -> PoseError {
    let arm = Arm::new("rewritten", table);
    let mut worst = PoseError::default();
    for _ in 0..10 {
        let q = rng.anywhere();
        let pose = arm.chain.fk(&q);
        let q_original = core::array::from_fn(|i| signs[i] * q[i] + shifts[i]);
        let error = PoseError::between(&original.fk(&q_original), &pose);
        assert!(error.position < 1e-14 && error.rotation < 1e-14, "{error:?}\n{table:?}");
        let branches = arm.ik(&q);
        let slot = arm.slot_of(&q);
        assert!(
            apart(&branches.q[slot].unwrap(), &q) < arm.recall(&q),
            "{q:?}\n{table:?}\n{branches:?}"
        );
        let error = arm.residual(&branches, &pose);
        worst = PoseError {
            position: worst.position.max(error.position),
            rotation: worst.rotation.max(error.rotation),
        };
    }
    worst
}

#[test]
fn any_frames_and_any_zero_pose_are_the_arm() {
    let mut rng = Rng::new(20);
    let mut worst = PoseError::default();
    for arm in arms() {
        for _ in 0..poses(20_000) / 100 {
            let (mut table, signs, shifts) = rewritten(&mut rng, arm.chain.mdh());
            let (before, behind) = (rng.pose(), rng.pose());
            let original = arm.chain.clone().with_base(before).with_tool(behind);
            (table.base, table.flange) = (before * table.base, table.flange * behind);
            let error = same_arm(&original, &table, [&signs, &shifts], &mut rng);
            worst = PoseError {
                position: worst.position.max(error.position),
                rotation: worst.rotation.max(error.rotation),
            };
        }
    }
    std::println!("rewritten tables: {worst:?}");
    assert!(worst.position < 1e-14 && worst.rotation < 1e-14);
}

#[test]
fn a_standard_table_is_the_arm() {
    let mut rng = Rng::new(21);
    for arm in arms() {
        for _ in 0..50 {
            let (table, signs, shifts) = rewritten(&mut rng, arm.chain.mdh());
            let table = Mdh::from(Sdh::from(table));
            same_arm(&arm.chain, &table, [&signs, &shifts], &mut rng);
        }
    }
}

#[test]
fn slots_do_not_depend_on_the_frames_of_a_table() {
    let mut rng = Rng::new(22);
    let arm = panda();
    for _ in 0..200 {
        let (mut table, signs, shifts) = rewritten(&mut rng, arm.chain.mdh());
        // The joints read zero where they did. The bit of the shoulder is the sign of joint 2, which may count the other way.
        for i in 0..7 {
            table.rows[i].theta -= signs[i] * shifts[i];
        }
        let other = Arm::new("turned over", &table);
        let q = rng.anywhere();
        let turned = core::array::from_fn(|i| signs[i] * q[i]);
        assert_eq!(other.slot_of(&turned) & 3, arm.slot_of(&q) & 3, "{table:?}");
    }
}

#[test]
fn a_table_that_is_off_by_text_is_squared_up() {
    let mut table = panda_table();
    for row in &mut table.rows {
        row.alpha += 5e-10;
        (row.a, row.d) = (row.a + 4e-10, row.d - 4e-10);
    }
    let arm = Arm::new("off", &table);
    let rows = &arm.chain.mdh().rows;
    assert_eq!([rows[1].a, rows[1].d, rows[2].a, rows[3].d, rows[5].a], [0.0; 5]);
    let q = [0.3, -0.4, 0.5, -1.2, 0.6, 1.5, 0.2];
    let branches = arm.ik(&q);
    assert!(
        branches.q.iter().flatten().count() >= 4
            && arm.residual(&branches, &arm.chain.fk(&q)).largest() < 1e-14
    );
}

#[test]
fn what_keeps_a_table_from_the_form_is_named() {
    let mut table = panda_table();
    table.rows[2].alpha += 0.01_f64.to_radians();
    table.rows[3].d = 0.002;
    table.rows[5].a = 0.0005;
    assert_eq!(
        recognized::<SphericalShoulder, 7, 8>(&table).unwrap_err().to_string(),
        "for a spherical shoulder and an offset elbow, axes 2 and 3 must be at right angles, they are 0.010000 deg \
         off; axes 5 and 6 must meet, they pass 0.500000 mm apart; axes 3 and 5 must lie in one plane, they pass 2.000000 mm apart"
    );
}

#[test]
fn links_without_length_are_refused() {
    let refusal = |change: fn(&mut Mdh<7>)| {
        let mut table = panda_table();
        change(&mut table);
        recognized::<SphericalShoulder, 7, 8>(&table).unwrap_err().to_string()
    };
    let upper = refusal(|table| (table.rows[2].d, table.rows[3].a) = (0.0, 0.0));
    assert!(upper.contains("upper arm (distance of axis 4 from the shoulder)"), "{upper}");
    let forearm = refusal(|table| (table.rows[4].d, table.rows[4].a) = (0.0, 0.0));
    assert!(forearm.contains("forearm (distance of axis 6 from axis 4)"), "{forearm}");
}
