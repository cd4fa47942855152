//! A calibrated arm by way of its nominal one. `IRBKIN_POSES` sets the number of poses of the rates
//! in docs/guide/calibrate.md, which `--nocapture` prints.

use irbkin::batch::Batch;
use irbkin::follow::Follower;
use irbkin::{Corrections, JointLimits, Mdh, Robot, SingularityKind, Solution, Status};

use crate::common::{Rng, apart, poses_or};

const ARMS: [&str; 2] = ["IRB 2600-12/1.65", "UR5"];

fn nominal(name: &str) -> Robot<6> {
    Robot::named(name).unwrap()
}

/// The arm with every parameter of its table off, rad and m.
fn calibrated(nominal: &Robot<6>, skew: f64, rng: &mut Rng) -> Robot<6> {
    let mut corrections = Corrections::NONE;
    for value in corrections.rows.as_flattened_mut() {
        *value = rng.between(-skew, skew);
    }
    nominal.with_corrections(&corrections).unwrap()
}

/// How far a solution may be off: in each of three coordinates 20 roundings of 2e-15 of all lengths
/// of the nominal table; offsets to a far common normal are none of them [m, rad].
fn rounding(robot: &Robot<6>, nominal: &Robot<6>) -> f64 {
    let rows = &nominal.mdh().rows;
    let lengths: f64 = rows.iter().map(|row| row.a.abs() + row.d.abs()).sum();
    let ends = [robot.base(), robot.tool()].map(|pose| pose.translation.vector.norm());
    3f64.sqrt() * 20.0 * 2e-15 * (lengths + ends[0] + ends[1])
}

#[test]
fn every_solution_closes_and_few_branches_are_missing() {
    for name in ARMS {
        let nominal = nominal(name);
        for skew in [0.0, 1e-6, 1e-5, 1e-4, 1e-3] {
            let mut rng = Rng::new(21);
            let arm = calibrated(&nominal, skew, &mut rng);
            let refined = arm.with_nominal(&nominal).unwrap();
            let poses = poses_or(2000);
            let (bound, mut missed, mut failed) = (rounding(&arm, &nominal), 0, 0);
            for _ in 0..poses {
                let q: [f64; 6] = rng.angles();
                let pose = arm.fk(&q);
                let solutions = refined.ik(&pose).unwrap();
                for solution in &solutions {
                    let off = refined.residual(&solution.q, &pose).largest();
                    assert!(off < bound, "{name} {skew:e}: {off:e} > {bound:e}");
                    let twins =
                        solutions.iter().filter(|other| apart(&other.q, &solution.q) < 1e-6);
                    assert_eq!(twins.count(), 1, "{name} {skew:e}");
                }
                missed += usize::from(!solutions.iter().any(|found| apart(&found.q, &q) < 1e-6));
                failed += solutions.status().iter().filter(|s| s.contains(Status::MERGED)).count();
            }
            // Branches are born and die next to folds, in a strip as wide as the root of the skew.
            #[expect(clippy::cast_precision_loss, reason = "small whole numbers")]
            let rates = [missed, failed].map(|count| count as f64 / poses as f64);
            println!("{name} {skew:e}: {missed} missed, {failed} flagged of {poses}");
            for rate in rates {
                assert!(rate <= 3.0 * skew.sqrt(), "{name} {skew:e}: {rates:?}");
            }
        }
    }
}

#[test]
fn the_general_solver_finds_every_branch_of_a_calibrated_arm() {
    for name in ARMS {
        let nominal = nominal(name);
        for skew in [1e-5, 1e-3] {
            let mut rng = Rng::new(28);
            let arm = calibrated(&nominal, skew, &mut rng);
            let refined = arm.with_nominal(&nominal).unwrap();
            assert_eq!(arm.structure(), "general");
            let (mut more, mut uncertified) = (0, 0);
            for _ in 0..300 {
                let q: [f64; 6] = rng.angles();
                let pose = arm.fk(&q);
                let (all, some) = (arm.ik(&pose).unwrap(), refined.ik(&pose).unwrap());
                assert!(!some.is_certified());
                if !all.is_certified() {
                    uncertified += 1;
                    continue;
                }
                let has = |q: &[f64; 6]| all.iter().any(|found| apart(&found.q, q) < 1e-6);
                assert!(has(&q), "{name} {skew:e}: {q:?}");
                assert!(some.iter().all(|solution| has(&solution.q)), "{name} {skew:e}: {q:?}");
                more += all.len() - some.len();
            }
            assert!(uncertified <= 3, "{name} {skew:e}: {uncertified}");
            assert!(skew < 1e-4 || more > 0, "{name} {skew:e}");
        }
    }
}

#[test]
fn without_corrections_the_branches_are_those_of_the_nominal_arm() {
    let mut rng = Rng::new(22);
    for name in ARMS {
        let nominal = nominal(name);
        let refined = nominal.with_nominal(&nominal).unwrap();
        assert_eq!(refined.structure(), format!("refined {}", nominal.structure()));
        assert_eq!(refined.slot_names(), nominal.slot_names());
        for _ in 0..200 {
            let pose = nominal.fk(&rng.angles());
            let (ours, theirs) = (refined.ik(&pose).unwrap(), nominal.ik(&pose).unwrap());
            assert_eq!(ours.len(), theirs.len());
            for (a, b) in ours.iter().zip(&theirs) {
                assert_eq!((a.slot, a.is_within_limits()), (b.slot, b.is_within_limits()));
                assert!(apart(&a.q, &b.q) < 1e-9);
            }
        }
    }
}

#[test]
fn base_tool_and_limits_are_those_of_the_calibrated_arm() {
    let mut rng = Rng::new(23);
    let nominal = nominal(ARMS[0]);
    let arm = calibrated(&nominal, 1e-3, &mut rng);
    let (mut base, mut tool) = (*arm.base(), *arm.tool());
    (base.translation.vector.x, tool.translation.vector.z) = (1.0, 0.3);
    let before = arm.with_nominal(&nominal).unwrap();
    let before = before.with_base(&base).unwrap().with_tool(&tool).unwrap();
    let after = arm.clone().with_base(&base).unwrap().with_tool(&tool).unwrap();
    assert_eq!(before, after.with_nominal(&nominal).unwrap());
    for _ in 0..100 {
        let q: [f64; 6] = rng.inside(arm.limits());
        let pose = after.fk(&q);
        for solution in &before.ik(&pose).unwrap() {
            assert!(after.residual(&solution.q, &pose).largest() < rounding(&arm, &nominal));
            assert_eq!(solution.is_within_limits(), arm.limits().contains(&solution.q));
        }
    }
}

#[test]
fn the_nearest_solution_is_one_of_all_and_a_batch_is_as_single_poses() {
    let mut rng = Rng::new(24);
    for name in ARMS {
        let nominal = nominal(name);
        let arm = calibrated(&nominal, 1e-4, &mut rng);
        let refined = arm.with_nominal(&nominal).unwrap();
        let mut found = 0;
        for _ in 0..200 {
            let q: [f64; 6] = rng.inside(&nominal.limits().clone());
            let pose = arm.fk(&q);
            let Ok(nearest) = refined.ik_nearest(&pose, &q, &[1.0; 6]) else { continue };
            assert!(refined.residual(&nearest.q, &pose).largest() < rounding(&arm, &nominal));
            found += usize::from(apart(&nearest.q, &q) < 1e-6);
            let solutions = refined.ik(&pose).unwrap();
            let rows = irbkin::pose::to_rows(&pose);
            let (mut joints, mut status) = ([0.0; 48], [0; 8]);
            Batch::new(None).ik(&refined, &rows, &mut joints, &mut status).unwrap();
            for slot in 0..8 {
                let single = solutions.slot(slot).map(|solution: &Solution<6>| solution.q);
                let row: [f64; 6] = joints[6 * slot..6 * slot + 6].try_into().unwrap();
                assert_eq!(single, row[0].is_finite().then_some(row));
            }
        }
        assert!(found >= 190, "{name}: {found} of 200");
    }
}

#[test]
fn a_path_is_followed_on_one_branch_through_the_wrist_singularity() {
    let mut rng = Rng::new(25);
    for name in ARMS {
        let nominal = nominal(name);
        let arm = calibrated(&nominal, 1e-4, &mut rng);
        let refined = arm.with_nominal(&nominal).unwrap();
        // q5 from 0.4 to -0.4: both arms pass their wrist singularities.
        let joints = |step: i32| {
            let part = f64::from(step) / 400.0;
            [0.3 + 0.1 * part, -0.9, 0.8, 0.5 + 0.2 * part, 0.4 - 0.8 * part, 0.7]
        };
        let mut follower = Follower::new(&refined, &joints(0), &[1.0; 6]).unwrap();
        let mut followed = 0;
        for step in 0..=400 {
            let pose = arm.fk(&joints(step));
            let (found, jump) = follower.step(&pose).unwrap();
            let Some(found) = found else { continue };
            assert!(jump.is_none(), "{name} at {step}: {jump:?}");
            assert!(arm.residual(&found.q, &pose).largest() < 1e-9);
            followed += usize::from(apart(&found.q, &joints(step)) < 1e-6);
        }
        assert!(followed >= 395, "{name}: {followed} of 401");
    }
}

#[test]
fn singularities_are_those_of_the_nominal_arm() {
    let nominal = nominal(ARMS[0]);
    let refined = calibrated(&nominal, 1e-4, &mut Rng::new(26)).with_nominal(&nominal).unwrap();
    let q = [0.3, 0.2, 0.1, 0.4, 0.0, 0.5];
    assert_eq!(refined.singularity(&q).kinds, SingularityKind::WRIST);
    assert_eq!(refined.singular_distances(&q), nominal.singular_distances(&q));
    assert_eq!(refined.jacobian_determinant(&q), None);
}

#[test]
fn a_coupled_arm_has_the_solutions_of_its_twin() {
    let nominal = nominal("IRB 2400-10/1.55");
    let mut rng = Rng::new(29);
    let arm = calibrated(&nominal, 1e-3, &mut rng).with_limits(JointLimits::UNLIMITED);
    assert!(arm.is_coupled());
    let refined = arm.with_nominal(&nominal.clone().uncoupled()).unwrap();
    let twin = arm.clone().uncoupled().with_nominal(&nominal).unwrap();
    assert_eq!(refined.clone().uncoupled(), twin);
    let mut found = 0;
    for _ in 0..500 {
        let pose = arm.fk(&rng.angles());
        let (solutions, serials) = (refined.ik(&pose).unwrap(), twin.ik(&pose).unwrap());
        assert_eq!(solutions.status(), serials.status());
        for (solution, other) in solutions.iter().zip(&serials) {
            let mut q = solution.q;
            q[2] -= q[1];
            assert!(apart(&q, &other.q) < 1e-9);
            found += 1;
        }
    }
    assert!(found > 1000, "{found}");
}

#[test]
fn an_arm_that_is_not_the_nominal_one_is_refused() {
    let [irb, ur] = ARMS.map(nominal);
    let far = irb.with_nominal(&ur).unwrap_err().to_string();
    assert!(far.contains("is it the same arm, with the same zero pose?"), "{far}");
    let table = Mdh { ..calibrated(&irb, 1e-3, &mut Rng::new(27)).mdh().clone() };
    let general = Robot::serial_chain(table).unwrap();
    let refined = general.with_nominal(&irb).unwrap();
    let twice = refined.with_nominal(&refined).unwrap_err().to_string();
    assert!(twice.contains("\"refined spherical wrist\", it must have a closed form"), "{twice}");
    let panda: Robot<7> = Robot::named("Panda").unwrap();
    let seven = panda.with_nominal(&panda).unwrap_err().to_string();
    assert!(seven.contains("\"spherical shoulder\", it must have a closed form"), "{seven}");
}
