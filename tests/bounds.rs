//! Numbers that are too large to compute with are refused with the bound, and up to the bound
//! answers keep their digits, for every structure.

use std::f64::consts::{PI, TAU};

use crate::common::{Rng, reach_of};
use irbkin::batch::{Batch, NO_CONFIGURATION};
use irbkin::follow::{FollowOptions, Follower};
use irbkin::thresholds::{MOST_ANGLE, MOST_LENGTH};
use irbkin::{
    Configuration, ConfigurationRequest, JacobianFrame, JointLimits, Pose, Robot, Status, pose,
};

const SIXES: [&str; 4] = ["IRB 2600-12/1.65", "IRB 140-6/0.81", "IRB 2400-10/1.55", "UR5e"];
const SEVENS: [&str; 2] = ["Panda", "FR3"];

/// Sizes beyond a bound of 1e6 or less: by one rounding, by a little, and by more than squares can
/// represent.
const BEYOND: [f64; 8] = [1.000_000_000_000_001e6, 1.1e6, 1e9, 1e15, 1e19, 1e155, 1e300, f64::MAX];

fn six(name: &str) -> Robot<6> {
    Robot::named(name).unwrap()
}

fn seven(name: &str) -> Robot<7> {
    Robot::named(name).unwrap()
}

/// A pose of the arm with one coordinate far away, unchecked.
fn far(pose: &Pose, index: usize, value: f64) -> Pose {
    let mut far = *pose;
    far.translation.vector[index] = value;
    far
}

fn far_poses(pose: &Pose) -> impl Iterator<Item = (Pose, String)> + '_ {
    let signed = BEYOND.iter().flat_map(|size| [*size, -size]);
    signed.flat_map(move |value| {
        (0..3).map(move |index| {
            let words = format!("pose[{index}, 3] is {value:e} m, its size must be at most 1e6 m");
            (far(pose, index, value), words)
        })
    })
}

#[test]
fn every_call_refuses_a_position_that_is_too_far_away() {
    let identity = Pose::identity();
    for (pose, words) in far_poses(&identity) {
        assert_eq!(pose::from_rows(&pose::to_rows(&pose)).unwrap_err().to_string(), words);
        let xyz: [f64; 3] = pose.translation.vector.into();
        let words = words.replace("pose[", "xyz[").replace(", 3]", "]");
        let refused = pose::from_wxyz(xyz, [1.0, 0.0, 0.0, 0.0]).unwrap_err();
        assert_eq!(refused.to_string(), words);
        assert_eq!(pose::from_euler_zyx(xyz, [0.1; 3]).unwrap_err().to_string(), words);
    }
    for name in SIXES {
        let (robot, q) = (six(name), [0.1, -0.2, 0.3, 0.4, 0.5, 0.6]);
        for (pose, words) in far_poses(&robot.fk(&q)) {
            let refused = |error: irbkin::Error| assert_eq!(error.to_string(), words, "{name}");
            refused(robot.ik(&pose).unwrap_err());
            refused(robot.ik_nearest(&pose, &q, &[1.0; 6]).unwrap_err());
            refused(robot.clone().with_tool(&pose).unwrap_err());
            refused(robot.clone().with_base(&pose).unwrap_err());
            refused(robot.follow(&[pose], &q, &FollowOptions::default()).unwrap_err());
            let mut follower = Follower::new(&robot, &q, &[1.0; 6]).unwrap();
            refused(follower.step(&pose).unwrap_err());
            if robot.structure() == "spherical wrist" {
                refused(robot.ik_configured(&pose, Configuration::default()).unwrap_err());
            }
        }
    }
    for name in SEVENS {
        let (robot, q) = (seven(name), [0.1, -0.2, 0.3, -1.4, 0.5, 1.6, 0.7]);
        for (pose, words) in far_poses(&robot.fk(&q)) {
            let refused = |error: irbkin::Error| assert_eq!(error.to_string(), words, "{name}");
            refused(robot.ik(&pose, 0.7).unwrap_err());
            refused(robot.ik_nearest(&pose, &q, &[1.0; 7]).unwrap_err());
            refused(robot.clone().with_tool(&pose).unwrap_err());
            refused(robot.clone().with_base(&pose).unwrap_err());
        }
    }
}

#[test]
fn a_batch_row_that_is_too_far_away_is_invalid_and_the_other_rows_are_solved() {
    let near = |rows: &[f64]| [rows, rows].concat();
    let check = |name: &str, q: &[f64], status: &[u8], alone: &[f64], row: usize| {
        let slots = alone.len();
        assert!(status[8..16].iter().all(|byte| *byte == Status::INVALID.bits()), "{name} {row}");
        assert!(q[slots..2 * slots].iter().all(|angle| angle.is_nan()), "{name} {row}");
        for rest in [&q[..slots], &q[2 * slots..]] {
            let same = rest.iter().zip(alone).all(|(a, b)| a.to_bits() == b.to_bits());
            assert!(same, "{name} {row}");
        }
    };
    for name in SIXES {
        let (robot, seed) = (six(name), [0.1, -0.2, 0.3, 0.4, 0.5, 0.6]);
        let good = robot.fk(&seed);
        let (mut alone, mut status) = ([0.0; 48], [0; 8]);
        Batch::new(None).ik(&robot, &pose::to_rows(&good), &mut alone, &mut status).unwrap();
        for (row, (pose, _)) in far_poses(&good).enumerate() {
            let mut poses = near(&pose::to_rows(&good));
            poses.splice(16..16, pose::to_rows(&pose));
            let (mut q, mut status) = ([0.0; 3 * 48], [0; 24]);
            Batch::new(None).ik(&robot, &poses, &mut q, &mut status).unwrap();
            check(name, &q, &status, &alone, row);
            let mut nearest = [0.0; 18];
            Batch::new(None)
                .ik_nearest(&robot, &poses, &seed.repeat(3), &[1.0; 6], &mut nearest)
                .unwrap();
            assert!(nearest[6..12].iter().all(|angle| angle.is_nan()), "{name} {row}");
            assert!(nearest[..6].iter().chain(&nearest[12..]).all(|angle| angle.is_finite()));
        }
    }
    for name in SEVENS {
        let (robot, seed) = (seven(name), [0.1, -0.2, 0.3, -1.4, 0.5, 1.6, 0.7]);
        let good = robot.fk(&seed);
        let (mut alone, mut status) = ([0.0; 56], [0; 8]);
        Batch::new(None)
            .ik_with(&robot, &pose::to_rows(&good), &[0.7], &mut alone, &mut status)
            .unwrap();
        for (row, (pose, _)) in far_poses(&good).enumerate() {
            let mut poses = near(&pose::to_rows(&good));
            poses.splice(16..16, pose::to_rows(&pose));
            let (mut q, mut status) = ([0.0; 3 * 56], [0; 24]);
            Batch::new(None).ik_with(&robot, &poses, &[0.7; 3], &mut q, &mut status).unwrap();
            check(name, &q, &status, &alone, row);
        }
        for q7 in BEYOND.into_iter().flat_map(|size| [size, -size]) {
            let poses = pose::to_rows(&good).repeat(3);
            let (mut q, mut status) = ([0.0; 3 * 56], [0; 24]);
            Batch::new(None).ik_with(&robot, &poses, &[0.7, q7, 0.7], &mut q, &mut status).unwrap();
            check(name, &q, &status, &alone, 0);
        }
    }
}

/// At the bound, and everywhere below it, a pose that is beyond reach has no solution and reports
/// by how much.
#[test]
fn poses_up_to_the_bound_are_reported_as_beyond_reach() {
    let mut rng = Rng::new(61);
    for size in [3.0, 1e2, 1e4, 9.99e5, MOST_LENGTH] {
        for _ in 0..50 {
            let xyz = [0; 3].map(|_| if rng.unit() < 0.5 { size } else { -size });
            let pose = pose::from_euler_zyx(xyz, [0; 3].map(|_| rng.between(-3.0, 3.0))).unwrap();
            for name in SIXES {
                let robot = six(name);
                let solutions = robot.ik(&pose).unwrap();
                assert!(solutions.is_empty(), "{name} at {xyz:?}");
                let shortfall = solutions.reach().shortfall();
                let distance = 3.0_f64.sqrt() * size;
                let off = (shortfall - distance).abs();
                assert!(off <= 2.0 * reach_of(&robot) + 1e-9 * size, "{name}: {shortfall}");
            }
            for name in SEVENS {
                assert!(seven(name).ik(&pose, 0.3).unwrap().is_empty(), "{name} at {xyz:?}");
            }
        }
    }
}

const ANGLES_BEYOND: [f64; 9] =
    [1.000_000_000_000_001e5, 1.1e5, 3.4e9, 1e10, 1e15, 1e19, 1e155, 1e300, f64::MAX];

fn too_large(field: &str, joint: usize, value: f64) -> String {
    format!(
        "{field}: joint {joint} is {value:e} rad, its size must be at most 1e5 rad (remove whole \
         turns)"
    )
}

#[test]
fn every_call_refuses_a_seed_that_is_too_large() {
    fn sweep<const N: usize>(q: [f64; N], mut work: impl FnMut([f64; N], usize, f64)) {
        for value in ANGLES_BEYOND.into_iter().flat_map(|size| [size, -size]) {
            for joint in 0..N {
                let mut seed = q;
                seed[joint] = value;
                work(seed, joint + 1, value);
            }
        }
    }
    for name in SIXES {
        let (robot, q) = (six(name), [0.1, -0.2, 0.3, 0.4, 0.5, 0.6]);
        let pose = robot.fk(&q);
        let solutions = robot.ik(&pose).unwrap();
        sweep(q, |seed, joint, value| {
            let words = too_large("seed", joint, value);
            let refused = |error: irbkin::Error| assert_eq!(error.to_string(), words, "{name}");
            refused(robot.ik_nearest(&pose, &seed, &[1.0; 6]).unwrap_err());
            refused(solutions.nearest(&seed, &[1.0; 6]).unwrap_err());
            refused(solutions.least_motion(&seed, &[1.0; 6]).unwrap_err());
            refused(robot.follow(&[pose], &seed, &FollowOptions::default()).unwrap_err());
            refused(Follower::new(&robot, &seed, &[1.0; 6]).unwrap_err());
            let mut nearest = [0.0; 12];
            let seeds = [seed, q].concat();
            let poses = pose::to_rows(&pose).repeat(2);
            Batch::new(None).ik_nearest(&robot, &poses, &seeds, &[1.0; 6], &mut nearest).unwrap();
            assert!(nearest[..6].iter().all(|angle| angle.is_nan()), "{name}");
            assert!(nearest[6..].iter().all(|angle| angle.is_finite()), "{name}");
            if robot.structure() == "spherical wrist" {
                let wanted = Configuration::default();
                refused(
                    robot
                        .ik_configured(&pose, ConfigurationRequest::from(wanted).or_nearest(seed))
                        .unwrap_err(),
                );
                let words = too_large("q", joint, value);
                assert_eq!(robot.configuration(&seed).unwrap_err().to_string(), words, "{name}");
                let rows = [seed, q].concat();
                let mut counted = [0; 8];
                Batch::new(None).configuration(&robot, &rows, &mut counted).unwrap();
                assert_eq!(counted[..4], [NO_CONFIGURATION; 4], "{name}");
                let Configuration { cf1, cf4, cf6, cfx } = robot.configuration(&q).unwrap();
                assert_eq!(counted[4..], [cf1, cf4, cf6, cfx], "{name}");
            }
        });
    }
    for name in SEVENS {
        let (robot, q) = (seven(name), [0.1, -0.2, 0.3, -1.4, 0.5, 1.6, 0.7]);
        let pose = robot.fk(&q);
        sweep(q, |seed, joint, value| {
            let refused = robot.ik_nearest(&pose, &seed, &[1.0; 7]).unwrap_err();
            assert_eq!(refused.to_string(), too_large("seed", joint, value), "{name}");
            let refused = robot.ik(&pose, value).unwrap_err();
            assert_eq!(refused.to_string(), too_large("q7", 7, value), "{name}");
        });
    }
}

/// Without limits a solution is wrapped near its seed. A seed of `turns` whole turns is rounded to
/// `eps` times its size.
#[test]
fn a_solution_near_a_large_seed_still_closes() {
    let mut rng = Rng::new(62);
    for size in [0.0, 1e2, 1e4, MOST_ANGLE - PI] {
        for name in SIXES {
            let robot = six(name).with_limits(JointLimits::UNLIMITED);
            let bound = 12.0 * f64::EPSILON * (1.0 + size) * (1.0 + reach_of(&robot));
            for _ in 0..100 {
                let seed = [0; 6].map(|_| rng.between(size - PI, size + PI));
                let pose = robot.fk(&[0; 6].map(|_| rng.between(-1.0, 1.0)));
                let q = robot.ik_nearest(&pose, &seed, &[1.0; 6]).unwrap().q;
                let residual = robot.residual(&q, &pose).largest();
                assert!(residual <= bound, "{name} at {size}: {residual:e} > {bound:e}");
                assert!(q.iter().zip(&seed).all(|(a, b)| (a - b).abs() <= TAU), "{name}");
            }
        }
    }
}

/// floor(angle / 90 deg) for every permitted angle, in integers of any size.
#[test]
fn a_configuration_never_saturates() {
    let mut rng = Rng::new(63);
    for name in SIXES.into_iter().filter(|name| six(name).structure() == "spherical wrist") {
        let robot = six(name);
        for _ in 0..5000 {
            let mut q = [0.1, -0.2, 0.3, 0.4, 0.5, 0.6];
            for joint in [0, 3, 5] {
                q[joint] = rng.between(-1.0, 1.0) * 10_f64.powf(rng.between(0.0, 5.0));
            }
            let found = robot.configuration(&q).unwrap();
            for (quarter, joint) in [(found.cf1, 0), (found.cf4, 3), (found.cf6, 5)] {
                let from = f64::from(quarter) * 90_f64.to_radians();
                let inside = (from - 1e-9..=from + 90_f64.to_radians() + 1e-9).contains(&q[joint]);
                assert!(inside, "{name}: {quarter} of {}", q[joint]);
            }
            // The configuration can also be requested from the arm.
            let pose = robot.fk(&q);
            let configured = robot.clone().with_limits(JointLimits::UNLIMITED);
            if let Err(error) = configured.ik_configured(&pose, found) {
                assert!(!error.to_string().contains("it must be"), "{name}: {error}");
            }
        }
        for value in [MOST_ANGLE, -MOST_ANGLE] {
            assert!(robot.configuration(&[value, 0.0, 0.0, value, 0.1, value]).is_ok());
        }
    }
}

/// Forward kinematics uses the exact value of an angle with any number of turns, also where a
/// linkage takes the difference of two.
#[test]
fn forward_kinematics_of_large_angles_equals_that_of_the_angle_modulo_2_pi() {
    let mut rng = Rng::new(64);
    for name in SIXES {
        let robot = six(name);
        for _ in 0..2000 {
            let size = 10_f64.powf(rng.between(0.0, 300.0));
            let q = [0; 6].map(|_| rng.between(-1.0, 1.0) * size);
            let rest = q.map(|angle| angle.sin().atan2(angle.cos()));
            let bound = 40.0 * f64::EPSILON * (1.0 + reach_of(&robot));
            let off = robot.residual(&rest, &robot.fk(&q)).largest();
            // Up to 1e5 rad the difference of a linkage is rounded relative to its size.
            let rounding = if robot.is_coupled() { f64::EPSILON * size.min(1e5) } else { 0.0 };
            assert!(
                off <= bound + 2.0 * rounding * reach_of(&robot),
                "{name} at {size:e}: {off:e}"
            );
            let [large, small] = [q, rest].map(|q| robot.jacobian(&q, JacobianFrame::Base));
            assert!((large - small).amax() <= bound + 2.0 * rounding * reach_of(&robot), "{name}");
            let (mut rows, mut one) = ([0.0; 16], [0.0; 16]);
            Batch::new(None).fk(&robot, &q, &mut rows).unwrap();
            one.copy_from_slice(&pose::to_rows(&robot.fk(&q)));
            let apart = rows.iter().zip(&one).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(apart <= bound, "{name} at {size:e}: {apart:e}");
        }
    }
}
