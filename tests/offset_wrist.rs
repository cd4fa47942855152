//! Arms with an offset wrist: complete solution sets that others computed, and laws.

use std::num::NonZeroUsize;

use irbkin::batch::Batch;
use irbkin::{DhRow, JacobianFrame, Mdh, Pose, Robot, Status, pose};

use crate::common::rng::drawn;
use crate::common::{apart, company};
use crate::structures::offset_wrist::{JACO2, ODD};

/// Name; alpha [deg], a [m], d [m], theta [deg] of each row.
type Table = (&'static str, [[f64; 4]; 6]);

const GOFA_5: Table = (
    "GoFa 5",
    [
        [0.0, 0.0, 0.265, 0.0],
        [-90.0, 0.0, 0.0, -90.0],
        [0.0, 0.444, 0.0, 0.0],
        [-90.0, 0.11, 0.47, 0.0],
        [90.0, 0.0, 0.0, 0.0],
        [-90.0, 0.08, 0.101, 180.0],
    ],
);
const GOFA_10: Table = (
    "GoFa 10",
    [
        [0.0, 0.0, 0.4, 0.0],
        [-90.0, 0.15, 0.0, -90.0],
        [0.0, 0.707, 0.0, 0.0],
        [-90.0, 0.11, 0.637, 0.0],
        [90.0, 0.0, 0.0, 0.0],
        [-90.0, 0.08, 0.101, 180.0],
    ],
);
const CRX_10IAL: Table = (
    "CRX-10iA/L",
    [
        [0.0, 0.0, 0.245, 0.0],
        [-90.0, 0.0, 0.0, -90.0],
        [0.0, 0.71, 0.0, 0.0],
        [-90.0, 0.0, 0.54, 0.0],
        [90.0, 0.0, 0.15, 0.0],
        [-90.0, 0.0, 0.16, 180.0],
    ],
);
const TABLES: [Table; 5] = [GOFA_5, GOFA_10, CRX_10IAL, ("JACO2", JACO2), ("odd", ODD)];

fn robot((_, rows): &Table) -> Robot<6> {
    of_rows(rows.map(|[alpha, a, d, theta]| [alpha.to_radians(), a, d, theta.to_radians()]))
}

fn of_rows(rows: [[f64; 4]; 6]) -> Robot<6> {
    let rows = rows.map(|[alpha, a, d, theta]| DhRow::new(alpha, a, d, theta));
    Robot::from_mdh(Mdh { base: Pose::identity(), rows, flange: Pose::identity() }).unwrap()
}

/// The rows of a case in tests/data/general_6r.json, in degrees.
fn numbers(value: &serde_json::Value) -> Vec<[f64; 6]> {
    let row = |row: &serde_json::Value| -> [f64; 6] {
        let row: Vec<f64> = serde_json::from_value(row.clone()).unwrap();
        row.try_into().unwrap()
    };
    value.as_array().unwrap().iter().map(row).collect()
}

#[test]
fn the_solutions_are_those_that_others_computed() {
    let text = include_str!("data/general_6r.json");
    let cases: serde_json::Value = serde_json::from_str(text).unwrap();
    let mut compared = 0;
    for name in ["gofa5", "crx10ial", "xarm6"] {
        let case = &cases[name];
        let rows: Vec<[f64; 4]> = serde_json::from_value(case["rows"].clone()).unwrap();
        let robot = of_rows(
            <[[f64; 4]; 6]>::try_from(rows)
                .unwrap()
                .map(|[alpha, a, d, theta]| [alpha.to_radians(), a, d, theta.to_radians()]),
        );
        assert_eq!(robot.structure(), "offset wrist", "{name}");
        let complete = numbers(&case["solutions_deg"]);
        for set in case["counts"].as_array().unwrap() {
            let made: Vec<f64> = serde_json::from_value(set["q_deg"].clone()).unwrap();
            let made = <[f64; 6]>::try_from(made).unwrap().map(f64::to_radians);
            let solutions = robot.ik(&robot.fk(&made)).unwrap();
            let count = usize::try_from(set["count"].as_u64().unwrap()).unwrap();
            assert_eq!(solutions.len(), count, "{name} {made:?}");
            assert!(solutions.iter().any(|solution| apart(&solution.q, &made) < 1e-10));
            if count == complete.len() {
                for q in &complete {
                    let q = q.map(f64::to_radians);
                    // Nine decimals of a degree.
                    let off = solutions.iter().map(|solution| apart(&solution.q, &q));
                    assert!(off.fold(f64::INFINITY, f64::min) < 2e-11, "{name} {q:?}");
                    compared += 1;
                }
            }
        }
    }
    assert_eq!(compared, 48);
}

#[test]
fn every_solution_closes_and_the_arm_is_among_them_once() {
    for table in &TABLES {
        let robot = robot(table);
        let reach: f64 = table.1.iter().map(|row| row[1].abs() + row[2].abs()).sum();
        let mut counts = [0; 17];
        for q in drawn(1, 2000) {
            let pose = robot.fk(&q);
            let solutions = robot.ik(&pose).unwrap();
            counts[solutions.len()] += 1;
            for solution in &solutions {
                let residual = robot.residual(&solution.q, &pose);
                // Twenty roundings of the closure: most steps end at one.
                assert!(residual.position <= 4e-14 * (1.0 + reach), "{} {residual:?}", table.0);
                assert!(residual.rotation <= 8e-14, "{} {residual:?}", table.0);
            }
            let own = solutions.iter().filter(|solution| apart(&solution.q, &q) < 1e-7).count();
            assert_eq!(own, 1, "{} {q:?}", table.0);
        }
        // Solutions come and go in pairs.
        let odd: usize = counts.iter().skip(1).step_by(2).sum();
        assert_eq!(odd, 0, "{} {counts:?}", table.0);
        assert!(counts[4] > 0 && counts[8] > 0, "{} {counts:?}", table.0);
    }
}

#[test]
fn the_determinant_is_that_of_the_jacobian() {
    for table in &TABLES {
        let tool = pose::from_euler_zyx([0.1, -0.2, 0.3], [0.5, 0.2, -0.7]).unwrap();
        let robot = robot(table).with_tool(&tool).unwrap();
        for q in drawn(2, 500) {
            let wanted = robot.jacobian(&q, JacobianFrame::Base).determinant();
            let found = robot.jacobian_determinant(&q).unwrap();
            assert!((found - wanted).abs() < 1e-14, "{} {found} {wanted}", table.0);
        }
    }
}

#[test]
fn base_tool_and_the_zeros_of_joints_do_not_change_the_solutions() {
    let base = pose::from_euler_zyx([0.3, 0.1, -0.2], [0.4, -0.3, 1.0]).unwrap();
    let tool = pose::from_euler_zyx([0.1, -0.2, 0.3], [0.5, 0.2, -0.7]).unwrap();
    for table in &TABLES {
        let plain = robot(table);
        let moved = robot(table).with_base(&base).unwrap().with_tool(&tool).unwrap();
        let mut shifted = table.1;
        for row in &mut shifted {
            row[3] += 33.0;
        }
        let shifted = robot(&(table.0, shifted));
        for q in drawn(3, 300) {
            let pose = plain.fk(&q);
            let solutions = plain.ik(&pose).unwrap();
            for (other, pose, shift) in
                [(&moved, base * pose * tool, 0.0), (&shifted, pose, 33.0_f64.to_radians())]
            {
                let others = other.ik(&pose).unwrap();
                assert_eq!(others.len(), solutions.len(), "{} {q:?}", table.0);
                for solution in &others {
                    let q = solution.q.map(|angle| angle + shift);
                    let off = solutions.iter().map(|one| apart(&one.q, &q));
                    assert!(off.fold(f64::INFINITY, f64::min) < 1e-8, "{} {q:?}", table.0);
                }
            }
        }
    }
}

/// On the set in use; `tests/lanes.rs` runs the like on every one.
#[test]
fn a_row_of_a_batch_has_the_bits_of_the_pose_alone() {
    for table in &TABLES {
        let robot = robot(table);
        let joints: Vec<[f64; 6]> = drawn(4, 50).collect();
        let rows: Vec<f64> = joints.iter().flat_map(|q| pose::to_rows(&robot.fk(q))).collect();
        let (mut q, mut status) = (vec![0.0; 50 * 16 * 6], vec![0; 50 * 16]);
        Batch::new(NonZeroUsize::new(2)).ik(&robot, &rows, &mut q, &mut status).unwrap();
        for (row, made) in joints.iter().enumerate() {
            let alone = robot.ik(&robot.fk(made)).unwrap();
            for slot in 0..16 {
                let place = 16 * row + slot;
                let found = Status::from_bits_retain(status[place]);
                assert_eq!(found, alone.status()[slot]);
                if let Some(solution) = alone.slot(slot) {
                    assert_eq!(q[6 * place..6 * place + 6], solution.q);
                } else {
                    assert!(q[6 * place..6 * place + 6].iter().all(|angle| angle.is_nan()));
                }
            }
        }
    }
}

#[test]
fn a_row_among_bad_and_repeated_ones_has_the_bits_that_it_has_alone() {
    for table in &TABLES {
        company::check_rows(&robot(table));
    }
}

#[test]
fn a_pose_out_of_reach_says_by_how_much() {
    for table in &TABLES {
        let robot = robot(table);
        let far = Pose::translation(30.0, 1.0, 2.0);
        let solutions = robot.ik(&far).unwrap();
        assert!(solutions.is_empty());
        let reach: f64 = table.1.iter().map(|row| row[1].abs() + row[2].abs()).sum();
        let shortfall = solutions.reach().shortfall();
        assert!(shortfall > 30.0 - reach && shortfall < 31.0, "{shortfall}");
    }
}

#[test]
fn the_crx_10ia_has_the_solutions_of_an_article() {
    let robot: Robot<6> = Robot::named("CRX-10iA").unwrap();
    let text = include_str!("data/crx_10ia_poses.csv");
    let rows: Vec<Vec<f64>> = text
        .lines()
        .skip(1)
        .map(|line| line.split(',').map(|number| number.parse().unwrap()).collect())
        .collect();
    let mut counts = Vec::new();
    for rows in rows.chunk_by(|a, b| a[..6] == b[..6]) {
        let [x, y, z, w, p, r] = rows[0][..6].try_into().unwrap();
        let xyz = [x / 1e3, y / 1e3, (z + 245.0) / 1e3];
        let angles = [r, p, w].map(|angle: f64| angle.to_radians());
        let pose = pose::from_euler_zyx(xyz, angles).unwrap();
        let solutions = robot.ik(&pose).unwrap();
        counts.push(solutions.len());
        assert_eq!(solutions.len(), rows.len(), "{:?}", &rows[0][..6]);
        for row in rows {
            let [j1, j2, j3, j4, j5, j6] = row[6..].try_into().unwrap();
            let q = [j1, j2, j2 + j3, j4, j5, j6].map(|angle: f64| angle.to_radians());
            let off = solutions.iter().map(|solution| apart(&solution.q, &q));
            let off = off.fold(f64::INFINITY, f64::min);
            // Three decimals of a degree, and what the poses' do to joints next to a singularity.
            assert!(off < 2e-4, "{q:?}: {off}");
        }
    }
    assert_eq!(counts, [8, 12, 16]);
}

/// Axis 5 is parallel to axes 2 and 3 at two angles of joint 6. Where one is out of reach, its roots
/// are complex (docs/theory/offset_wrist.md, eq. 145 to 149).
#[test]
fn an_answer_with_axis_4_at_zero_is_certified() {
    let robot: Robot<6> = Robot::named("GoFa 5").unwrap();
    let poses = drawn(41, 200).map(|mut q: [f64; 6]| {
        q[3] = 0.0;
        robot.fk(&q)
    });
    let count = poses.filter(|pose| robot.ik(pose).unwrap().is_certified()).count();
    assert!(count >= 195, "{count}");
}
