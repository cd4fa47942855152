//! The solution that represents a self-motion.

use core::f64::consts::PI;

use crate::Status;
use crate::error::Error;
use crate::kinematics::answer::solutions::Solution;
use crate::kinematics::chain::dh::{DhRow, Mdh};
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::pose::Pose;
use crate::kinematics::pose::angles::wrap;
use crate::kinematics::robot::Robot;
use crate::report::{Explanation, FreeJoint};
use crate::rng::Rng;

#[test]
fn a_self_motion_is_represented_with_its_first_joint_at_zero() {
    let zero = |q: f64| wrap(q).abs() < 1e-12;
    // Axes 1 and 6 of a GoFa in one line turn against one another, whatever the others are.
    let gofa = Robot::<6>::named("GoFa 5").unwrap().with_limits(JointLimits::UNLIMITED);
    for (height, turn) in [(0.9, 0.3), (0.8, -1.4), (0.7, 2.9)] {
        let turn = Pose::rotation(nalgebra::Vector3::z() * turn);
        let pose = Pose::translation(0.0, 0.0, height) * turn;
        let solutions = gofa.ik(&pose).unwrap();
        assert!(!solutions.is_empty() && !solutions.is_certified(), "{height}");
        for one in &solutions {
            assert!(one.status.contains(Status::WRIST) && zero(one.q[0]), "{one:?}");
            assert!(gofa.residual(&one.q, &pose).largest() < 1e-13);
        }
    }
    // A CRX with equal links moves where the wrist point is on axis 2: where joint 1 passes zero.
    let crx = Robot::<6>::named("CRX-10iA").unwrap().with_limits(JointLimits::UNLIMITED);
    let mut rng = Rng::new(8);
    let (mut at_zero, mut elsewhere) = (0, 0);
    for _ in 0..100 {
        let mut q: [f64; 6] = rng.angles();
        q[2] = -0.5 * PI;
        for one in &crx.ik(&crx.fk(&q)).unwrap() {
            if one.status.contains(Status::WRIST) {
                *(if zero(one.q[0]) { &mut at_zero } else { &mut elsewhere }) += 1;
            }
        }
    }
    std::println!("joint 1 at zero: {at_zero}, not: {elsewhere}");
    assert!(at_zero > elsewhere, "{at_zero} {elsewhere}");
}

/// A pose with axes 1 and 6 of a GoFa in one line, at this height and angle.
fn upright(height: f64, angle: f64) -> Pose {
    Pose::translation(0.0, 0.0, height) * Pose::rotation(nalgebra::Vector3::z() * angle)
}

#[test]
fn the_free_joint_is_named_and_moves_along_the_self_motion() {
    let gofa = Robot::<6>::named("GoFa 5").unwrap().with_limits(JointLimits::UNLIMITED);
    let pose = upright(0.8, 0.4);
    for one in &gofa.ik(&pose).unwrap() {
        let free = one.free_joint.unwrap();
        assert_eq!((free.joint(), free.fixed()), (1, "q2, q3, q4, q5".into()));
        for value in [-3.0, 0.0, 1.2, 4.0] {
            let moved = gofa.with_free_joint(&pose, one, value).unwrap().unwrap();
            assert_eq!(moved.q[0], value);
            assert!(gofa.residual(&moved.q, &pose).largest() < 1e-13, "{moved:?}");
            for joint in 1..5 {
                assert!(wrap(moved.q[joint] - one.q[joint]).abs() < 1e-12, "{moved:?} {one:?}");
            }
        }
    }
    // All joints but axis 6 may move where the wrist point of a CRX with equal links is on axis 2:
    // each of them by a full turn. Some of these self-motions have a sharp bend.
    let crx = Robot::<6>::named("CRX-10iA").unwrap().with_limits(JointLimits::UNLIMITED);
    let mut rng = Rng::new(9);
    let mut count = 0;
    for _ in 0..30 {
        let mut q: [f64; 6] = rng.angles();
        q[2] = -0.5 * PI;
        let [reached, asked] = angles_reached(&crx, &crx.fk(&q), rng.angles());
        assert_eq!(reached, asked, "{q:?}");
        count += asked;
    }
    assert!(count > 80, "{count}");
}

/// Turn the free joint of each solution to these angles; returns how often that succeeds, and is
/// tried.
fn angles_reached(robot: &Robot<6>, pose: &Pose, angles: [f64; 2]) -> [usize; 2] {
    let [mut reached, mut asked] = [0; 2];
    for one in &robot.ik(pose).unwrap() {
        let Some(free) = one.free_joint else { continue };
        for value in angles {
            asked += 1;
            if let Ok(Some(moved)) = robot.with_free_joint(pose, one, value) {
                assert_eq!(moved.q[free.joint() - 1], value);
                assert!(robot.residual(&moved.q, pose).largest() < 1e-13, "{moved:?}");
                reached += 1;
            }
        }
    }
    [reached, asked]
}

#[test]
fn the_free_joint_moves_where_self_motions_cross_as_a_rule() {
    let mut rng = Rng::new(10);
    for (name, least) in [("CRX-10iA", 20), ("CRX-10iA/L", 10)] {
        let robot = Robot::<6>::named(name).unwrap().with_limits(JointLimits::UNLIMITED);
        let [mut reached, mut asked] = [0; 2];
        for _ in 0..60 {
            let q = core::array::from_fn(|_| 0.5 * PI * rng.between(-2.0, 2.0).round());
            let [here, all] = angles_reached(&robot, &robot.fk(&q), [0.3, -2.0]);
            [reached, asked] = [reached + here, asked + all];
        }
        std::println!("{name}: {reached} of {asked} angles");
        assert!(asked > least && 2 * reached > asked, "{name}: {reached} of {asked}");
    }
}

#[test]
fn the_nearest_member_of_a_self_motion_is_found_inside_the_limits() {
    let gofa = Robot::<6>::named("GoFa 5").unwrap().with_limits(JointLimits::UNLIMITED);
    let (pose, weights) = (upright(0.8, 0.4), [1.0, 1.0, 1.0, 1.0, 1.0, 4.0]);
    // q1 + q6 is fixed: the one that costs less moves more.
    let one = gofa.ik(&pose).unwrap().iter().next().copied().unwrap();
    let mut seed = one.q;
    (seed[0], seed[5]) = (one.q[0] + 1.0, one.q[5] + 0.5);
    let nearest = gofa.ik_nearest(&pose, &seed, &weights).unwrap();
    // With x off joint 1 and 1.5 - x off joint 6: x^2 + 4 (1.5 - x)^2 is least at x = 1.2.
    assert!((nearest.q[0] - (seed[0] - 1.2)).abs() < 1e-6, "{nearest:?} {seed:?}");
    assert!((nearest.q[5] - (seed[5] - 0.3)).abs() < 1e-6, "{nearest:?} {seed:?}");
    assert!(gofa.residual(&nearest.q, &pose).largest() < 1e-13);
    // A member is inside limits that exclude the one with joint 1 at zero.
    let mut limits = [[-PI, PI]; 6];
    limits[0] = [0.5, 0.9];
    let narrow = gofa.with_limits(JointLimits::new(limits).unwrap());
    let solutions = narrow.ik(&pose).unwrap();
    assert!(solutions.iter().all(Solution::is_within_limits), "{solutions}");
    limits[0] = [-PI, PI];
    limits[5] = [one.q[5] + 0.3, one.q[5] + 0.4];
    let narrow = narrow.with_limits(JointLimits::new(limits).unwrap());
    let inside = narrow.ik_nearest(&pose, &[0.0; 6], &[1.0; 6]).unwrap();
    assert!(inside.is_within_limits() && narrow.residual(&inside.q, &pose).largest() < 1e-13);
    assert!(narrow.ik(&pose).unwrap().iter().any(Solution::is_within_limits));
}

#[test]
fn a_seed_on_a_self_motion_is_its_nearest_solution() {
    let gofa = Robot::<6>::named("GoFa 5").unwrap().with_limits(JointLimits::UNLIMITED);
    let pose = upright(0.8, 0.4);
    let one = gofa.ik(&pose).unwrap().iter().next().copied().unwrap();
    let on_it = gofa.with_free_joint(&pose, &one, 1.3).unwrap().unwrap();
    let crx = Robot::<6>::named("CRX-10iA").unwrap().with_limits(JointLimits::UNLIMITED);
    let folded = [0.3, 0.5, -0.5 * PI, 0.7, 0.9, 1.1];
    for (robot, seed) in [(gofa, on_it.q), (crx, folded)] {
        let pose = robot.fk(&seed);
        let nearest = robot.ik_nearest(&pose, &seed, &[1.0; 6]).unwrap();
        assert!(matches!(nearest.free_joint, Some(FreeJoint::Chain { .. })), "{nearest:?}");
        for (found, wanted) in nearest.q.iter().zip(seed) {
            assert!(wrap(found - wanted).abs() < 1e-9, "{nearest:?} {seed:?}");
        }
    }
}

#[test]
fn a_free_joint_that_cannot_turn_round_is_out_of_reach() {
    // Axis 1 meets the axes of an oblique wrist: joints 1, 4, 5, 6 are a spherical linkage, whose
    // sides let joint 1 turn by a part of a turn only.
    let rows = [
        DhRow::new(0.0, 0.0, 0.4, 0.0),
        DhRow::new(-PI / 2.0, 0.0, 0.0, 0.0),
        DhRow::new(0.0, 0.7, 0.0, 0.0),
        DhRow::new(-PI / 2.0, 0.0, 0.6, 0.0),
        DhRow::new(PI / 6.0, 0.0, 0.0, 0.0),
        DhRow::new(-PI / 6.0, 0.0, 0.0, 0.0),
    ];
    let table = Mdh { base: Pose::identity(), rows, flange: Pose::identity() };
    let robot = Robot::<6>::from_mdh(table).unwrap();
    // The wrist point at 0.7 cos q2 - 0.6 sin(q2 + q3) from axis 1.
    let q_2 = -0.9_f64;
    let q = [0.5, q_2, (0.7 * q_2.cos() / 0.6).asin() - q_2, 1.1, 0.8, -0.4];
    let pose = robot.fk(&q);
    let solutions = robot.ik(&pose).unwrap();
    let one = solutions.iter().find(|one| one.free_joint.is_some()).unwrap();
    let turn = |value: f64| robot.with_free_joint(&pose, one, value);
    let reached = (-31..=31).filter(|tenth| turn(0.1 * f64::from(*tenth)).is_ok()).count();
    assert!((10..50).contains(&reached), "{reached}");
    let moved = turn(one.q[0] + 0.1).unwrap().unwrap();
    assert!(robot.residual(&moved.q, &pose).largest() < 1e-13, "{moved:?}");
    let error = turn(one.q[0] + 3.0).unwrap_err();
    assert!(matches!(error, Error::Unreachable(Explanation::FreeOutOfReach { joint: 1, .. })));
}
