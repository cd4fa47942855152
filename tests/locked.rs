//! Laws of robots of seven joints with one of them locked.

use std::f64::consts::TAU;

use crate::common::Rng;
use irbkin::batch::Batch;
use irbkin::{Error, Robot, Status, pose};

const WEIGHTS: [f64; 7] = [1.0; 7];

fn arms() -> [Robot<7>; 2] {
    let tool = pose::from_euler_zyx([0.02, -0.03, 0.11], [0.2, -0.4, 0.9]).unwrap();
    let base = pose::from_euler_zyx([0.4, 0.1, -0.2], [-0.7, 0.3, 0.5]).unwrap();
    ["Panda", "IRB 14050"].map(|name| {
        let robot = Robot::<7>::named(name).unwrap();
        robot.with_tool(&tool).unwrap().with_base(&base).unwrap()
    })
}

fn inside(robot: &Robot<7>, rng: &mut Rng) -> [f64; 7] {
    robot.limits().to_array().map(|[low, high]| rng.between(low, high))
}

fn apart(q: &[f64; 7], other: &[f64; 7]) -> f64 {
    let turns: [f64; 7] = std::array::from_fn(|joint| (q[joint] - other[joint]) / TAU);
    let off = turns.map(|part| TAU * (part - part.round()).abs());
    if off.iter().any(|off| off.is_nan()) { TAU } else { off.into_iter().fold(0.0, f64::max) }
}

#[test]
fn the_joints_that_made_a_pose_are_found_with_any_of_them_locked() {
    let mut rng = Rng::new(5);
    for robot in arms() {
        for joint in 1..=7 {
            let q = inside(&robot, &mut rng);
            let (pose, angle) = (robot.fk(&q), q[joint - 1]);
            let locked = robot.locked(joint, angle).unwrap();
            assert_eq!(locked.locked_joint(), Some((joint, angle)));
            let solutions = locked.ik(&pose, None).unwrap();
            assert!(solutions.iter().all(|found| found.q[joint - 1].to_bits() == angle.to_bits()));
            let off = solutions.iter().map(|found| apart(&found.q, &q)).fold(9.0, f64::min);
            assert!(off < 1e-6, "{} joint {joint}: {off:e}", robot.name());
            let nearest = locked.ik_nearest(&pose, &q, &WEIGHTS).unwrap();
            assert!(apart(&nearest.q, &q) < 1e-6, "{nearest:?}");
            // A row of a batch has the bits of a single answer.
            let slots = locked.slot_count();
            let (mut rows, mut status) = (vec![0.0; slots * 7], vec![0; slots]);
            let pose = pose::to_rows(&pose);
            Batch::new(None).ik_with(&locked, &pose, &[], &mut rows, &mut status).unwrap();
            for (slot, row) in rows.as_chunks::<7>().0.iter().enumerate() {
                let alone = solutions.slot(slot).map_or([f64::NAN; 7], |found| found.q);
                let bits = |angle: f64| (!angle.is_nan()).then_some(angle.to_bits());
                assert_eq!(row.map(bits), alone.map(bits));
                assert_eq!(status[slot], solutions.status()[slot].bits());
            }
        }
    }
}

#[test]
fn a_joint_at_an_end_takes_an_angle_for_each_pose() {
    let mut rng = Rng::new(6);
    for robot in arms() {
        for joint in [1, 7] {
            let q: [_; 5] = std::array::from_fn(|_| inside(&robot, &mut rng));
            let poses: Vec<f64> = q.iter().flat_map(|q| pose::to_rows(&robot.fk(q))).collect();
            let mut angles = q.map(|q| q[joint - 1]);
            angles[3] = f64::NAN;
            let locked = robot.locked(joint, 0.0).unwrap();
            let slots = locked.slot_count();
            let (mut rows, mut status) = (vec![0.0; 5 * slots * 7], vec![0; 5 * slots]);
            Batch::new(None).ik_with(&locked, &poses, &angles, &mut rows, &mut status).unwrap();
            for (row, answer) in rows.as_chunks::<7>().0.chunks(slots).enumerate() {
                let is_made = |found: &[f64; 7]| apart(found, &q[row]) < 1e-6;
                assert_eq!(answer.iter().any(is_made), row != 3, "{} {row}", robot.name());
            }
            assert!(status[3 * slots..4 * slots].iter().all(|it| *it == Status::INVALID.bits()));
        }
        let middle = robot.locked(3, 0.1).unwrap();
        let (mut row, mut status) = ([0.0; 16 * 7], [0; 16]);
        let pose = pose::to_rows(&robot.fk(&[0.1; 7]));
        let refused = Batch::new(None).ik_with(&middle, &pose, &[0.2], &mut row, &mut status);
        assert!(matches!(refused, Err(Error::WrongLength { .. })));
    }
}

#[test]
fn a_lock_is_kept_by_every_change_and_released_whole() {
    let [robot, _] = arms();
    let pose = robot.fk(&[0.1, -0.7, 0.2, -2.2, 0.1, 1.7, 0.6]);
    for joint in 1..=7 {
        let locked = robot.locked(joint, 0.3).unwrap();
        assert_eq!(robot.locked(joint, 1.1).unwrap().locked(joint, 0.3).unwrap(), locked);
        assert_eq!(robot.locked(1 + joint % 7, 0.2).unwrap().locked(joint, 0.3).unwrap(), locked);
        assert_eq!(locked.clone().unlocked(), robot);
        let bare = pose::from_euler_zyx([0.0; 3], [0.0; 3]).unwrap();
        let moved = locked.clone().with_base(&bare).unwrap();
        assert_eq!(moved, robot.clone().with_base(&bare).unwrap().locked(joint, 0.3).unwrap());
        let seen = robot.base().inverse() * pose;
        let (here, there) = (locked.ik(&pose, None).unwrap(), moved.ik(&seen, None).unwrap());
        assert_eq!(here.len(), there.len());
        for (here, there) in here.iter().zip(&there) {
            assert!(apart(&here.q, &there.q) < 1e-6, "{here:?}, {there:?}");
        }
        let q7 = [locked.ik(&pose, 0.6), robot.ik(&pose, 0.6)].map(|found| found.unwrap().len());
        assert_eq!(q7[0], q7[1]);
        let six = locked.six_joints().unwrap().unwrap();
        assert_eq!(six.ik(&pose).unwrap().len(), here.len());
    }
    assert!(robot.ik(&pose, None).unwrap_err().to_string().starts_with("q7: joint 7 is NaN"));
    assert!(robot.locked(8, 0.1).is_err());
    assert!(robot.locked(3, f64::NAN).is_err());
    let ur: Robot<6> = Robot::named("UR3").unwrap();
    assert!(ur.ik_with(&pose, 0.3).is_err());
}
