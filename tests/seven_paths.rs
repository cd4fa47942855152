//! Laws of `follow` and `plan` of arms of seven joints: their joint vectors meet the poses inside the
//! limits, `follow` does not jump, and a plan costs no more than what `follow` finds.

use crate::common::{Rng, iiwa};

use irbkin::Pose;
use irbkin::follow::{BreakReason, Followed};
use irbkin_motion::Arm;
use irbkin_motion::plan::{PlanError, PlanOptions, PlanOrder};
use nalgebra::Vector3;

const ONES: [f64; 7] = [1.0; 7];

fn arms() -> [(&'static str, Arm<7>); 3] {
    [
        ("Panda", Arm::named("Panda").unwrap()),
        ("FR3", Arm::named("FR3").unwrap()),
        ("iiwa", iiwa().into()),
    ]
}

/// A straight joint path inside the limits, and its poses.
fn path(robot: &Arm<7>, rng: &mut Rng, count: u32) -> (Vec<[f64; 7]>, Vec<Pose>) {
    let limits = robot.limits().to_array().map(|[low, high]| [low + 0.3, high - 0.3]);
    let from = limits.map(|[low, high]| rng.between(low, high));
    let to: [f64; 7] = core::array::from_fn(|joint| {
        (from[joint] + rng.between(-0.4, 0.4)).clamp(limits[joint][0], limits[joint][1])
    });
    let parts = (0..count).map(|pose| f64::from(pose) / f64::from(count - 1));
    let q: Vec<[f64; 7]> = parts
        .map(|part| core::array::from_fn(|joint| from[joint] + part * (to[joint] - from[joint])))
        .collect();
    let poses = q.iter().map(|q| robot.fk(q)).collect();
    (q, poses)
}

/// A joint path with twice as many steps.
fn between(q: &[[f64; 7]]) -> impl Iterator<Item = [f64; 7]> {
    (0..2 * q.len() - 1).map(|half| {
        let (from, to) = (q[half / 2], q[half.div_ceil(2)]);
        core::array::from_fn(|joint| 0.5 * (from[joint] + to[joint]))
    })
}

fn steps(q: &[[f64; 7]]) -> impl Iterator<Item = f64> {
    q.windows(2).flat_map(|pair| (0..7).map(move |joint| pair[1][joint] - pair[0][joint]))
}

fn largest(q: &[[f64; 7]]) -> f64 {
    steps(q).fold(0.0, |most, step| most.max(step.abs()))
}

fn squares(q: &[[f64; 7]]) -> f64 {
    steps(q).map(|step| step * step).sum()
}

/// All joint vectors, each of which meets its pose inside the limits.
fn met(robot: &Arm<7>, q: &[Option<[f64; 7]>], poses: &[Pose]) -> Vec<[f64; 7]> {
    let q: Vec<[f64; 7]> = q.iter().map(|q| q.unwrap()).collect();
    for (q, pose) in q.iter().zip(poses) {
        assert!(robot.residual(q, pose).largest() < 1e-11, "{q:?}");
        assert!(robot.limits().contains(q), "{q:?}");
    }
    q
}

#[test]
fn follow_meets_each_pose_without_a_jump() {
    let mut rng = Rng::new(41);
    for (name, robot) in arms() {
        for _ in 0..40 {
            let (made, poses) = path(&robot, &mut rng, 121);
            let Followed { q, orientation_error, breaks } =
                robot.follow(&poses, &made[0], &ONES).unwrap();
            assert!(breaks.is_empty(), "{name}: {}", breaks[0]);
            assert!(orientation_error.iter().all(|error| error.unwrap() < 1e-11), "{name}");
            let coarse = largest(&met(&robot, &q, &poses));
            // A jump would not shrink with the steps of the path.
            let finer: Vec<Pose> = between(&made).map(|q| robot.fk(&q)).collect();
            let followed = robot.follow(&finer, &made[0], &ONES).unwrap();
            let fine = largest(&met(&robot, &followed.q, &finer));
            assert!(fine < 0.9 * coarse, "{name}: {fine} of {coarse}");
        }
    }
}

#[test]
fn each_step_of_follow_is_the_smallest_to_its_pose() {
    let (mut rng, mut compared) = (Rng::new(42), 0);
    for (name, robot) in arms() {
        for _ in 0..10 {
            let (made, poses) = path(&robot, &mut rng, 31);
            let weights = core::array::from_fn(|_| rng.between(0.2, 3.0));
            let followed = robot.follow(&poses, &made[0], &weights).unwrap();
            let q = met(&robot, &followed.q, &poses);
            for (pair, pose) in q.windows(2).zip(&poses[1..]) {
                let nearest = robot.ik_nearest(pose, &pair[0], &weights).unwrap();
                let cost = |q: &[f64; 7]| -> f64 {
                    (0..7).map(|i| weights[i] * (q[i] - pair[0][i]).powi(2)).sum()
                };
                // The elbow may be nearer on its other side, which does not continue the path.
                if pair[1][3].signum() == nearest.q[3].signum() {
                    let (own, least) = (cost(&pair[1]), cost(&nearest.q));
                    assert!(own <= least * (1.0 + 1e-6) + 1e-12, "{name}: {own} of {least}");
                    compared += 1;
                }
            }
        }
    }
    assert!(compared > 850, "{compared} of 900");
}

#[test]
fn follow_names_a_pose_out_of_reach_and_goes_on() {
    let (_, robot) = &arms()[0];
    let (made, mut poses) = path(robot, &mut Rng::new(43), 21);
    poses[10].translation.vector += Vector3::new(3.0, 0.0, 0.0);
    let followed = robot.follow(&poses, &made[0], &ONES).unwrap();
    assert_eq!(followed.q.iter().filter(|q| q.is_none()).count(), 1);
    assert_eq!(followed.breaks[0].pose_index, 10);
    assert!(matches!(followed.breaks[0].reason, BreakReason::Unreachable(_)));
}

#[test]
fn a_plan_costs_no_more_than_what_follow_finds() {
    let (mut rng, mut sums) = (Rng::new(44), [0.0; 2]);
    for (name, robot) in arms() {
        for _ in 0..4 {
            let (made, poses) = path(&robot, &mut rng, 25);
            let followed = robot.follow(&poses, &made[0], &ONES).unwrap();
            let followed = squares(&met(&robot, &followed.q, &poses));
            let options = PlanOptions {
                start: Some(made[0]),
                order: PlanOrder::Sum,
                ..PlanOptions::default()
            };
            let plan = robot.plan(&poses, &options).unwrap();
            let q = met(&robot, &plan.q, &poses);
            assert!(plan.certified && plan.breaks.is_empty(), "{name}");
            assert!((0..7).all(|joint| (q[0][joint] - made[0][joint]).abs() < 1e-9), "{name}");
            assert!((squares(&q) - plan.cost).abs() <= 1e-9 * plan.cost + 1e-15, "{name}");
            assert!(plan.cost <= 1.1 * followed, "{name}: {} of {followed}", plan.cost);
            sums[0] += plan.cost;
            sums[1] += followed;
            assert!(plan.external.iter().all(Vec::is_empty), "{name}");
            for (q, slot) in q.iter().zip(&plan.slot) {
                assert_eq!(robot.slot_of(q).map(irbkin::Slot::index), *slot, "{name}");
            }
        }
    }
    assert!(sums[0] <= sums[1], "{sums:?}");
}

#[test]
fn a_plan_with_a_locked_joint_is_the_plan_of_the_other_six() {
    let (_, robot) = &arms()[2];
    let (made, _) = path(robot, &mut Rng::new(45), 2);
    let locked = robot.clone().map(|robot| robot.locked(3, made[0][2])).unwrap();
    let six = Arm::from(locked.six_joints().unwrap().unwrap());
    let mut to = made[0];
    to[0] += 0.3;
    let poses: Vec<Pose> = (0..15_u32)
        .map(|pose| {
            let part = f64::from(pose) / 14.0;
            robot.fk(&core::array::from_fn(|i| made[0][i] + part * (to[i] - made[0][i])))
        })
        .collect();
    let plan = locked.plan(&poses, &PlanOptions::default()).unwrap();
    let of_six = six.plan(&poses, &PlanOptions::default()).unwrap();
    for (seven, six) in plan.q.iter().zip(&of_six.q) {
        let (seven, six) = (seven.unwrap(), six.unwrap());
        let all = [six[0], six[1], made[0][2], six[2], six[3], six[4], six[5]];
        assert_eq!(seven.map(f64::to_bits), all.map(f64::to_bits));
    }
}

#[test]
fn accept_is_asked_for_seven_joints() {
    let (_, robot) = &arms()[2];
    let (made, poses) = path(robot, &mut Rng::new(46), 9);
    let options = PlanOptions { start: Some(made[0]), ..PlanOptions::default() };
    let free = robot.plan(&poses, &options).unwrap();
    let ends = [0, 8].map(|pose: usize| free.q[pose].unwrap()[6]);
    // Keep joint 7 on one side.
    let side = 0.5 * (ends[0] + ends[1]);
    let is_below = ends[0] < side;
    let mut asked = 0;
    let mut accept = |q: &[[f64; 7]]| {
        asked += q.len();
        Some(q.iter().map(|q| (q[6] < side) == is_below).collect())
    };
    let plan = robot.plan_accepted(&poses, &options, &mut accept).unwrap();
    assert!(asked > 9);
    let q = met(robot, &plan.q, &poses);
    assert!(q.iter().all(|q| (q[6] < side) == is_below));
    assert!(plan.bottleneck >= free.bottleneck * (1.0 - 1e-9));
}

#[test]
fn a_start_and_options_that_do_not_fit_are_named() {
    let (_, robot) = &arms()[0];
    let (made, poses) = path(robot, &mut Rng::new(47), 5);
    let refused = |options: PlanOptions<7>| robot.plan(&poses, &options).unwrap_err().to_string();
    let default = PlanOptions::<7>::default();
    let mut start = made[0];
    start[6] = 3.0;
    let message = refused(PlanOptions { start: Some(start), ..default.clone() });
    assert!(message.contains("joint 7") && message.contains("start"), "{message}");
    let message = refused(PlanOptions { redundancy: 1, ..default.clone() });
    assert!(message.contains("redundancy"), "{message}");
    let max_acceleration = Some(vec![1.0; 6]);
    let message = refused(PlanOptions { max_acceleration, ..default });
    assert!(message.contains("max_acceleration") && message.contains('7'), "{message}");
    let far = vec![Pose::from_parts(Vector3::new(9.0, 0.0, 0.0).into(), poses[0].rotation); 3];
    let gap = robot.plan(&far, &PlanOptions::default()).unwrap_err();
    assert!(matches!(gap, PlanError::NoPlan(gap) if gap.pose_index == 0 && !gap.ends.is_empty()));
}
