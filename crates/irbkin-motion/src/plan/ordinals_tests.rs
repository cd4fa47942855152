//! Plans of arms whose slots are ordinals.

use std::vec::Vec;

use super::tests::random_path;
use super::{PlanError, PlanOptions, ToolRotation};
use crate::arm::Arm;
use crate::paths::{Spacing, line};
use crate::rng::Rng;
use irbkin::internal::{largest, nearest_turn, steps};
use irbkin::{Pose, PoseDifference};

/// Where joint angles at the first pose of a path lead to, each interval in so many parts and no
/// step larger than `most`: no gap between two folds is stepped over.
fn followed(
    robot: &Arm<6>,
    path: &[Pose],
    start: [f64; 6],
    parts: usize,
    most: f64,
) -> Option<[f64; 6]> {
    let mut q = start;
    for two in path.windows(2) {
        for pose in line(&two[0], &two[1], Spacing::count(parts).unwrap(), None).unwrap() {
            let next = robot.ik_nearest(&pose, &q, &[1.0; 6]).ok()?.q;
            if largest(&steps(&q, &next)) > most {
                return None;
            }
            q = next;
        }
    }
    Some(q)
}

/// Whether any solution of the first pose can be followed to the end.
fn is_followed(robot: &Arm<6>, path: &[Pose], parts: usize, most: f64) -> bool {
    let solutions = robot.ik(&path[0]).unwrap();
    solutions.turns().any(|start| followed(robot, path, start.q, parts, most).is_some())
}

#[test]
fn a_path_that_can_be_followed_has_a_plan_that_goes_on_without_jumps() {
    let mut rng = Rng::new(17);
    for name in ["CRB 15000-5/0.95", "CRX-10iA/L"] {
        let robot: Arm<6> = Arm::named(name).unwrap();
        let mut count = 0;
        for case in 0..24 {
            let path = random_path(&robot, &mut rng, 25, 0.04);
            let wanted = is_followed(&robot, &path, 61, 0.2);
            count += usize::from(wanted);
            match robot.plan(&path, &PlanOptions::default()) {
                Ok(plan) => {
                    assert!(plan.certified && plan.breaks.is_empty());
                    let q: Vec<_> = plan.q.iter().map(|q| q.unwrap()).collect();
                    for (index, (q, pose)) in q.iter().zip(&path).enumerate() {
                        let apart = PoseDifference::between(&robot.fk(q), pose);
                        assert!(apart.largest() < 1e-9, "{name}, case {case}: {apart:?}");
                        // The slot belongs to the solution.
                        let own = robot.ik(pose).unwrap();
                        let slot = own.slot(plan.slot[index].unwrap()).unwrap();
                        let off = |joint: usize| nearest_turn(slot.q[joint] - q[joint], 0.0);
                        assert!(largest::<6>(&core::array::from_fn(off)) < 1e-6, "{name}, {case}");
                    }
                    for (two, poses) in q.windows(2).zip(path.windows(2)) {
                        // Coarse parts may step over a gap between two folds.
                        let arrives = |parts: &usize| {
                            let end = followed(&robot, poses, two[0], *parts, 0.1);
                            end.is_some_and(|end| largest(&steps(&end, &two[1])) < 1e-6)
                        };
                        assert!([401, 40_001].iter().any(arrives), "{name}, case {case}");
                    }
                }
                Err(PlanError::NoPlan(gap)) => {
                    let is_missed = wanted && is_followed(&robot, &path, 3_001, 0.01);
                    assert!(!is_missed, "{name}, case {case}: {gap}");
                    assert!(!gap.ends.is_empty());
                }
                Err(error) => panic!("{error}"),
            }
        }
        assert!(count >= 12, "{name}: {count} followed");
    }
}

#[test]
fn a_free_rotation_lowers_the_bottleneck_of_ordinals_too() {
    let robot: Arm<6> = Arm::named("CRB 15000-5/0.95").unwrap();
    let mut rng = Rng::new(3);
    let mut planned = 0;
    for _ in 0..8 {
        let path = random_path(&robot, &mut rng, 20, 0.03);
        let Ok(fixed) = robot.plan(&path, &PlanOptions::default()) else { continue };
        let rotation = Some(ToolRotation::full(24).unwrap());
        let options = PlanOptions { rotation, ..PlanOptions::default() };
        let free = robot.plan(&path, &options).unwrap();
        assert!(free.bottleneck <= fixed.bottleneck * (1.0 + 1e-9));
        planned += 1;
        let start = free.q[0];
        let held = robot.plan(&path, &PlanOptions { start, ..options }).unwrap();
        assert!(held.certified && held.breaks.is_empty());
        assert_eq!(held.q[0], start);
    }
    assert!(planned >= 4, "{planned}");
}
