//! General arms through the public interface: cases with known answers, and what holds of every
//! answer.

use std::f64::consts::PI;

use irbkin::batch::Batch;
use irbkin::{DhRow, Explanation, Mdh, Pose, Robot, Sdh, Status, follow::FollowOptions, pose};
use serde_json::Value;

use crate::common::{Rng, apart, company};

const CASES: &str = include_str!("data/general_6r.json");

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

fn radians(value: &Value) -> [f64; 6] {
    let degrees: [f64; 6] = numbers(value).try_into().unwrap();
    degrees.map(f64::to_radians)
}

/// The robot of a case.
fn robot(case: &Value) -> Robot<6> {
    let is_standard = case["table"] == "sdh";
    let rows: Vec<DhRow> = case["rows"]
        .as_array()
        .unwrap()
        .iter()
        .map(|row| {
            let row = numbers(row);
            // Standard tables have a before alpha.
            let (alpha, a) = if is_standard { (row[1], row[0]) } else { (row[0], row[1]) };
            DhRow::new(alpha.to_radians(), a, row[2], row[3].to_radians())
        })
        .collect();
    let rows: [DhRow; 6] = rows.try_into().unwrap();
    let (base, flange) = (Pose::identity(), Pose::identity());
    if is_standard {
        Robot::from_sdh(Sdh { base, rows, flange }).unwrap()
    } else {
        Robot::from_mdh(Mdh { base, rows, flange }).unwrap()
    }
}

fn cases() -> Vec<(String, Value, Robot<6>)> {
    let all: serde_json::Map<String, Value> = serde_json::from_str(CASES).unwrap();
    all.into_iter()
        .map(|(name, case)| {
            let robot = robot(&case);
            (name, case, robot)
        })
        .collect()
}

#[test]
fn a_row_among_bad_and_repeated_ones_has_the_bits_that_it_has_alone() {
    for (_, _, robot) in cases() {
        company::check_rows(&robot);
    }
}

/// A robot by alpha [deg], a and d [m] of its rows, and joint angles from degrees.
fn nice(rows: [[f64; 3]; 6], q: [f64; 6]) -> (Robot<6>, [f64; 6]) {
    let rows = rows.map(|[alpha, a, d]| DhRow::new(alpha.to_radians(), a, d, 0.0));
    let mdh = Mdh { base: Pose::identity(), rows, flange: Pose::identity() };
    (Robot::from_mdh(mdh).unwrap(), q.map(f64::to_radians))
}

#[test]
fn what_no_attempt_has_understood_certifies_no_later_one() {
    // Two directions are free; a second split finds the same points, and as many as it has roots.
    for (rows, q) in [
        (
            [
                [0.0, 0.3, 0.5],
                [-90.0, 0.0, 0.3],
                [90.0, 0.0, 0.4],
                [90.0, 0.5, 0.0],
                [-90.0, 0.5, 0.25],
                [90.0, 0.1, 0.1],
            ],
            [-90.0, 180.0, -90.0, -180.0, 90.0, 90.0],
        ),
        (
            [
                [0.0, 0.3, 0.4],
                [0.0, 0.5, 0.3],
                [-90.0, 0.1, 0.0],
                [90.0, 0.0, 0.0],
                [-90.0, 0.0, 0.0],
                [90.0, 0.2, 0.1],
            ],
            [-180.0, 180.0, 0.0, 0.0, -90.0, 0.0],
        ),
    ] {
        let (robot, q) = nice(rows, q);
        assert!(!robot.ik(&robot.fk(&q)).unwrap().is_certified());
    }
}

#[test]
fn where_solutions_merge_in_several_directions_one_of_them_is_found() {
    // Newton's method of whole steps closes at none of these (general.md, eq. 104b).
    for (rows, q) in [
        (
            [
                [0.0, 0.5, 0.25],
                [0.0, 0.3, 0.0],
                [90.0, 0.0, 0.4],
                [90.0, 0.0, 0.4],
                [90.0, 0.1, 0.0],
                [90.0, 0.0, 0.1],
            ],
            [0.0, 90.0, 0.0, 90.0, 0.0, -90.0],
        ),
        (
            [
                [-90.0, 0.2, 0.3],
                [0.0, 0.4, 0.0],
                [0.0, 0.5, 0.25],
                [-90.0, 0.2, 0.4],
                [90.0, 0.0, 0.1],
                [90.0, 0.3, 0.0],
            ],
            [90.0, 90.0, 0.0, 90.0, 90.0, -180.0],
        ),
    ] {
        let (robot, q) = nice(rows, q);
        assert!(!robot.ik(&robot.fk(&q)).unwrap().is_empty(), "{q:?}");
    }
}

#[test]
fn with_axes_5_and_6_parallel_no_certified_answer_lacks_a_fold() {
    // By the polynomial of an offset wrist none of these folds had a solution, for certain.
    for (q_2, q_5) in [(0.0, -90.0), (30.0, -90.0), (90.0, 0.0), (-47.0, 180.0), (180.0, 90.0)] {
        let rows = [
            [0.0, 0.4, 0.4],
            [90.0, 0.25, 0.0],
            [0.0, 0.25, 0.0],
            [-90.0, 0.25, 0.25],
            [90.0, 0.0, 0.0],
            [0.0, 0.2, 0.0],
        ];
        let (robot, q) = nice(rows, [90.0, q_2, -90.0, 0.0, q_5, -61.0]);
        let solutions = robot.ik(&robot.fk(&q)).unwrap();
        let is_found = solutions.iter().any(|one| apart(&one.q, &q) < 1e-6);
        assert!(is_found || !solutions.is_certified(), "{q:?}");
    }
}

#[test]
fn every_solution_of_the_cases_is_found() {
    for (name, case, robot) in cases() {
        let rows: Vec<f64> = case["pose"].as_array().unwrap().iter().flat_map(numbers).collect();
        let pose = pose::from_rows(&rows.try_into().unwrap()).unwrap();
        let known: Vec<[f64; 6]> =
            case["solutions_deg"].as_array().unwrap().iter().map(radians).collect();
        let solutions = robot.ik(&pose).unwrap();
        assert_eq!(solutions.len(), known.len(), "{name}");
        assert!(solutions.is_certified(), "{name}");
        for q in &known {
            // Nine decimals of a degree, and the digits of the pose.
            let nearest = solutions.iter().map(|s| apart(&s.q, q)).fold(PI, f64::min);
            assert!(nearest < 1e-8, "{name}: {nearest:e}");
        }
        for count in case["counts"].as_array().unwrap() {
            let q = radians(&count["q_deg"]);
            let solutions = robot.ik(&robot.fk(&q)).unwrap();
            assert_eq!(solutions.len() as u64, count["count"].as_u64().unwrap(), "{name} {q:?}");
            assert!(solutions.iter().any(|s| apart(&s.q, &q) < 1e-9), "{name} {q:?}");
        }
    }
}

#[test]
fn a_general_arm_has_sixteen_slots_without_names() {
    for (name, _, robot) in cases().into_iter().filter(|(_, _, robot)| is_general(robot)) {
        assert_eq!((robot.slot_count(), robot.slot_names()), (16, None), "{name}");
        assert!(robot.unknown_structure().is_none() && robot.missing_form().is_some(), "{name}");
        let q = [0.3, -0.5, 0.9, 1.3, -0.7, 0.2];
        assert_eq!(robot.slot_of(&q), None);
        let singularity = robot.singularity(&q);
        assert!(singularity.distances.is_none() && singularity.kinds.is_empty(), "{name}");
        let determinant = robot.jacobian_determinant(&q).unwrap();
        let product = robot.singularity(&q).manipulability;
        assert!((determinant.abs() - product).abs() < 1e-12 * (1.0 + product), "{name}");
    }
}

fn is_general(robot: &Robot<6>) -> bool {
    robot.structure() == "general"
}

#[test]
fn answers_do_not_depend_on_base_and_tool() {
    let mut rng = Rng::new(1);
    for (name, _, robot) in cases() {
        let base = pose::from_euler_zyx([0.8, -0.5, 0.3], [-1.9, 0.4, 0.2]).unwrap();
        let tool = pose::from_euler_zyx([0.03, -0.02, 0.2], [0.3, -0.7, 1.1]).unwrap();
        let moved = robot.clone().with_base(&base).unwrap().with_tool(&tool).unwrap();
        let mut compared = 0;
        for _ in 0..50 {
            let q = rng.angles();
            let (here, there) = (robot.ik(&robot.fk(&q)), moved.ik(&moved.fk(&q)));
            let (here, there) = (here.unwrap(), there.unwrap());
            if !here.is_certified() || !there.is_certified() {
                continue;
            }
            compared += 1;
            assert_eq!(here.len(), there.len(), "{name} {q:?}");
            for one in &here {
                let nearest = there.iter().map(|s| apart(&s.q, &one.q)).fold(PI, f64::min);
                assert!(nearest < 1e-7, "{name} {q:?}: {nearest:e}");
            }
        }
        assert!(compared > 35, "{name}: {compared}");
    }
}

#[test]
fn a_batch_equals_single_answers_with_their_certainty() {
    let mut rng = Rng::new(2);
    for (name, _, robot) in cases().into_iter().filter(|(_, _, robot)| is_general(robot)) {
        // Random poses, and one of multiples of 90 deg.
        let mut joints: Vec<[f64; 6]> = (0..9).map(|_| rng.angles()).collect();
        joints.push([PI, PI / 2.0, PI / 2.0, 0.0, 0.0, PI]);
        let rows: Vec<f64> = joints.iter().flat_map(|q| pose::to_rows(&robot.fk(q))).collect();
        let slots = robot.slot_count();
        let (mut q, mut status) =
            (vec![0.0; 6 * slots * joints.len()], vec![0; slots * joints.len()]);
        Batch::new(None).ik(&robot, &rows, &mut q, &mut status).unwrap();
        for (row, made) in joints.iter().enumerate() {
            let single = robot.ik(&robot.fk(made)).unwrap();
            for slot in 0..slots {
                let flags = Status::from_bits_retain(status[row * slots + slot]);
                assert_eq!(flags, single.status()[slot], "{name}");
                assert_eq!(flags.contains(Status::UNCERTIFIED), !single.is_certified(), "{name}");
                let at = 6 * (row * slots + slot);
                let found = single.slot(slot).map_or([f64::NAN; 6], |solution| solution.q);
                let is_same = |(a, b): (&f64, &f64)| a.to_bits() == b.to_bits();
                let both = q[at..at + 6].iter().zip(&found);
                assert!(both.clone().all(is_same) || found[0].is_nan() && q[at].is_nan(), "{name}");
            }
        }
    }
}

#[test]
fn the_nearest_solution_and_a_path_keep_to_one_branch() {
    let mut rng = Rng::new(3);
    for (name, _, robot) in cases() {
        let mut followed = 0;
        for _ in 0..12 {
            let q: [f64; 6] = rng.angles();
            let step: [f64; 6] = std::array::from_fn(|_| rng.between(-1e-2, 1e-2));
            let path: Vec<[f64; 6]> =
                (0..30).map(|i| std::array::from_fn(|j| q[j] + f64::from(i) * step[j])).collect();
            // A path that passes no singularity has one continuous branch.
            let signs = |q: &[f64; 6]| robot.jacobian_determinant(q).unwrap();
            let least =
                path.iter().map(|q| robot.singularity(q).min_singular_value).fold(1.0, f64::min);
            if least < 0.02 || path.iter().any(|at| signs(at) * signs(&q) <= 0.0) {
                continue;
            }
            followed += 1;
            let poses: Vec<Pose> = path.iter().map(|q| robot.fk(q)).collect();
            let nearest = robot.ik_nearest(&poses[1], &q, &[1.0; 6]).unwrap();
            assert!(apart(&nearest.q, &path[1]) < 1e-9, "{name}");
            let answer = robot.follow(&poses, &q, &FollowOptions::default()).unwrap();
            assert!(answer.breaks.is_empty(), "{name} {:?}", answer.breaks);
            for (found, made) in answer.q.iter().zip(&path) {
                assert!(apart(&found.unwrap(), made) < 1e-9, "{name}");
            }
        }
        assert!(followed > 3, "{name}: {followed}");
    }
}

#[test]
fn out_of_reach_an_answer_says_so() {
    for (name, _, robot) in cases().into_iter().filter(|(_, _, robot)| is_general(robot)) {
        let pose = Pose::translation(90.0, 0.0, 0.0);
        let solutions = robot.ik(&pose).unwrap();
        assert!(solutions.is_empty() && solutions.is_certified(), "{name}");
        assert_eq!(
            solutions.explain(),
            Explanation::NoRoots { certified: true, approach: None },
            "{name}"
        );
        assert!(solutions.reach().shortfall().is_nan());
        let words = robot.ik_nearest(&pose, &[0.0; 6], &[1.0; 6]).unwrap_err().to_string();
        assert!(words.contains("0 real roots"), "{words}");
    }
}

#[test]
fn nothing_is_nearer_than_the_nearest_approach() {
    let mut rng = Rng::new(4);
    for (name, _, robot) in cases() {
        let lengths: f64 = robot.mdh().rows.iter().map(|row| row.a.abs() + row.d.abs()).sum();
        let reached = robot.nearest_approach(&robot.fk(&rng.angles())).unwrap();
        assert!(reached.position.max(reached.rotation) < 1e-9, "{name}: {reached:?}");
        for distance in [0.9, 1.2, 4.0] {
            let mut pose = robot.fk(&rng.angles());
            pose.translation.vector = pose.translation.vector.normalize() * (distance * lengths);
            let nearest = robot.nearest_approach(&pose).unwrap();
            let size = |position: f64, rotation: f64| position.hypot(lengths * rotation);
            let least = size(nearest.position, nearest.rotation);
            assert!(least >= (distance - 1.0) * lengths, "{name}: {nearest:?}");
            for _ in 0..3000 {
                let other = robot.residual(&rng.angles(), &pose);
                let other = size(other.position, other.rotation);
                assert!(other >= least, "{name} {distance}: {other} and {nearest:?}");
            }
        }
    }
}

#[test]
fn a_table_next_to_a_closed_form_tells_it() {
    let mut table = Robot::<6>::named("IRB 2600-12/1.65").unwrap().mdh().clone();
    table.rows[3].alpha += 1e-4;
    let robot = Robot::from_mdh(table).unwrap();
    assert_eq!(robot.structure(), "offset wrist");
    let missing = robot.missing_form().unwrap();
    assert_eq!(missing.snap(), Some(1e-4));
    assert!(missing.to_string().contains("axes 3 and 4 must be at right angles"), "{missing}");
    let q = [0.3, -0.5, 0.9, 1.3, -0.7, 0.2];
    let solutions = robot.ik(&robot.fk(&q)).unwrap();
    assert!(solutions.iter().any(|solution| apart(&solution.q, &q) < 1e-9));
}
