//! Arms of five axes: pan, three parallel axes, roll.

use std::f64::consts::{FRAC_PI_2, PI};

use irbkin::{DhRow, Error, Mdh, Pose, Reach, Robot, Solution, Solutions, Status, pose};
use nalgebra::{Rotation3, Vector3};

use crate::rng::Rng;

/// The TheRobotStudio's SO-101, as its URDF describes it; the tool is 7.9 mm beside axis 5.
fn so101() -> Robot<5> {
    Robot::named("SO-101").unwrap()
}

/// An arm of the class with random lengths, directions of its axes, zeros and ends.
fn random_arm(rng: &mut Rng) -> Robot<5> {
    let mut row =
        |alpha: f64, a: f64| DhRow::new(alpha, a, rng.between(-0.3, 0.3), rng.between(-PI, PI));
    let mut rows = [row(0.0, 0.0), row(0.0, 0.0), row(0.0, 0.0), row(0.0, 0.0), row(0.0, 0.0)];
    rows[1].alpha = rng.sign() * FRAC_PI_2;
    rows[1].a = rng.between(-0.2, 0.2);
    for link in [2, 3] {
        rows[link].alpha = rng.half_turn();
        rows[link].a = rng.sign() * rng.between(0.1, 0.6);
    }
    rows[4].alpha = rng.sign() * FRAC_PI_2;
    rows[4].a = rng.between(-0.1, 0.1);
    let [base, flange, tool] = [0, 1, 2].map(|_| {
        let mut numbers = || [0, 1, 2].map(|_| rng.between(-0.3, 0.3));
        pose::from_euler_zyx(numbers(), numbers()).unwrap()
    });
    Robot::from_mdh(Mdh { base, rows, flange }).unwrap().with_tool(&tool).unwrap()
}

fn random_joints(rng: &mut Rng) -> [f64; 5] {
    [0; 5].map(|_| rng.between(-PI, PI))
}

/// A pose turned in place about axis 1, upwards.
fn turned(robot: &Robot<5>, pose: &Pose, angle: f64) -> Pose {
    let up = robot.base().rotation * robot.mdh().base.rotation * Vector3::z_axis();
    let rotation = Rotation3::from_axis_angle(&up, angle) * pose.rotation;
    Pose::from_parts(pose.translation, rotation)
}

/// How far joint vectors differ, turns not counted [rad].
fn difference(a: &[f64; 5], b: &[f64; 5]) -> f64 {
    let off = |i: usize| (a[i] - b[i]).sin().hypot(1.0 - (a[i] - b[i]).cos());
    (0..5).map(off).fold(0.0, f64::max)
}

fn nearest(solutions: &Solutions<5>, q: &[f64; 5]) -> f64 {
    solutions.iter().map(|found| difference(&found.q, q)).fold(f64::INFINITY, f64::min)
}

/// Every solution brings the tool to the pose turned by its heading error, which is within the
/// tolerance; it is in its own slot, and none is there twice.
fn check(robot: &Robot<5>, target: &Pose, solutions: &Solutions<5>) {
    for found in solutions {
        let error = robot.heading_error(&found.q, target);
        assert!(error.abs() <= robot.heading_tolerance() + 1e-12, "{error} of {found:?}");
        let off = robot.residual(&found.q, &turned(robot, target, error));
        assert!(off.largest() <= 1e-13, "{off:?} of {found:?}");
    }
    let all: Vec<&Solution<5>> = solutions.iter().collect();
    for (i, one) in all.iter().enumerate() {
        for other in &all[..i] {
            assert!(difference(&one.q, &other.q) > 1e-9, "{one:?} is {other:?}");
        }
    }
}

fn poses() -> u32 {
    let divisor = std::env::var("IRBKIN_DIVISOR").ok().and_then(|it| it.parse().ok());
    100_000 / divisor.unwrap_or(1)
}

#[test]
fn a_turned_pose_has_the_joints_that_made_it() {
    let mut rng = Rng::new(50);
    let mut arms: Vec<_> = (0..50).map(|_| random_arm(&mut rng)).collect();
    arms.push(so101());
    let mut slots = [0_u32; 8];
    for number in 0..poses() {
        let arm = &arms[number as usize % arms.len()];
        let robot = arm.clone().with_heading_tolerance(PI).unwrap();
        let q = random_joints(&mut rng);
        if robot.singular_distances(&q).unwrap().wrist < 1e-3 {
            continue;
        }
        let heading = rng.between(-PI, PI);
        let target = turned(&robot, &robot.fk(&q), heading);
        let solutions = robot.ik(&target).unwrap();
        assert!(nearest(&solutions, &q) <= 1e-6, "{q:?} of {:?} {solutions:?}", robot.mdh());
        check(&robot, &target, &solutions);
        for found in &solutions {
            slots[found.slot.index()] += 1;
            if robot.singularity(&found.q).near(1e-5, 1e-5).is_empty() {
                assert_eq!(robot.slot_of(&found.q), Some(found.slot), "{found:?}");
            }
        }
    }
    assert!(slots.iter().all(|count| *count > 0), "{slots:?}");
}

#[test]
fn an_exact_pose_is_reached_without_a_heading_error() {
    let mut rng = Rng::new(51);
    for _ in 0..poses() / 10 {
        let robot = random_arm(&mut rng);
        let q = random_joints(&mut rng);
        let target = robot.fk(&q);
        let solutions = robot.ik(&target).unwrap();
        assert!(nearest(&solutions, &q) <= 1e-6, "{q:?} {solutions:?}");
        check(&robot, &target, &solutions);
        assert!(solutions.len() >= 2, "{solutions:?}");
    }
}

/// The joints with joint 4 moved so that axis 5 is off parallel to axis 1 by so much.
fn upright(robot: &Robot<5>, mut q: [f64; 5], off: f64) -> [f64; 5] {
    // The elevation is the sum of three angles, each with its sign: Newton's method on it.
    for _ in 0..40 {
        let axis = |q: &[f64; 5]| {
            let up = robot.base().rotation * robot.mdh().base.rotation * Vector3::z();
            let approach = robot.link_frames(q).0[4].rotation * Vector3::z();
            let side = robot.link_frames(q).0[1].rotation * Vector3::z();
            side.cross(&up).dot(&approach).atan2(up.dot(&approach))
        };
        let mut moved = q;
        moved[3] += 1e-3;
        let slope = ((axis(&moved) - axis(&q)).sin() / 1e-3).signum();
        q[3] -= slope * (axis(&q) - off);
    }
    q
}

#[test]
fn next_to_upright_nothing_is_lost() {
    let mut rng = Rng::new(52);
    for off in [1e-2, 1e-4, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14, 0.0] {
        for _ in 0..poses() / 200 {
            let robot = random_arm(&mut rng);
            let q = random_joints(&mut rng);
            // Where the wrist is near axis 1, two planes are one to rounding.
            let wrist = robot.singular_distances(&upright(&robot, q, 0.0)).unwrap().shoulder;
            if wrist < 0.05 {
                continue;
            }
            let q = upright(&robot, q, off);
            let target = robot.fk(&q);
            let solutions = robot.ik(&target).unwrap();
            check(&robot, &target, &solutions);
            let far = nearest(&solutions, &q);
            assert!(far <= 1e-6, "{off}: {far} {q:?} {solutions:?}");
        }
    }
}

#[test]
fn a_straight_elbow_is_one_solution() {
    let mut rng = Rng::new(53);
    let mut together = 0;
    let mut straight = 0;
    for off in [1e-4, 1e-6, 1e-9, 0.0] {
        for _ in 0..poses() / 200 {
            let robot = random_arm(&mut rng);
            let mut q = random_joints(&mut rng);
            let [theta, upper, forearm] =
                [robot.mdh().rows[2].theta, robot.mdh().rows[2].a, robot.mdh().rows[3].a];
            // A folded arm that ends near axis 2 turns far about it for a rounding of its end.
            if (upper.abs() - forearm.abs()).abs() < 0.05 {
                continue;
            }
            q[2] = rng.half_turn() + off - theta;
            let target = robot.fk(&q);
            let solutions = robot.ik(&target).unwrap();
            check(&robot, &target, &solutions);
            assert!(nearest(&solutions, &q) <= 1e-6, "{off} {q:?} {solutions:?}");
            if off == 0.0 {
                let merged = solutions.status().iter().any(|it| it.contains(Status::MERGED));
                together += u32::from(merged);
                straight += 1;
                let apart = |one: &Solution<5>| {
                    solutions.iter().all(|other| {
                        difference(&one.q, &other.q) < 2e-6 || {
                            one.slot.index() / 2 != other.slot.index() / 2
                        }
                    })
                };
                assert!(merged || solutions.iter().all(apart), "{solutions:?}");
            }
        }
    }
    // Of two elbows that are one, a few are computed by the root of rounding apart.
    assert!(together * 1000 > straight * 995, "{together} of {straight}");
}

#[test]
fn a_tool_on_axis_1_takes_its_plane_from_the_rotation() {
    let mut rng = Rng::new(54);
    for off in [1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 0.0] {
        for _ in 0..poses() / 200 {
            let robot = random_arm(&mut rng);
            let q = random_joints(&mut rng);
            let frames = robot.link_frames(&q).0;
            let up = robot.base().rotation * robot.mdh().base.rotation * Vector3::z();
            // A tool whose point is on axis 1, or beside it.
            let foot = robot.base() * robot.mdh().base * nalgebra::Point3::origin();
            let wanted =
                foot + up * rng.between(-1.0, 1.0) + frames[1].rotation * Vector3::y() * off;
            let flange = robot.fk(&q) * robot.tool().inverse();
            let tool = flange.inverse()
                * pose::from_euler_zyx(wanted.coords.into(), [0.1, 0.2, 0.3]).unwrap();
            let Ok(robot) = robot.with_tool(&tool) else { continue };
            let target = robot.fk(&q);
            let solutions = robot.ik(&target).unwrap();
            check(&robot, &target, &solutions);
            assert!(nearest(&solutions, &q) <= 1e-6, "{off} {q:?} {solutions:?}");
        }
    }
}

#[test]
fn the_tolerance_is_a_bound_and_an_empty_answer_names_the_least_error() {
    let mut rng = Rng::new(55);
    for _ in 0..poses() / 100 {
        let robot = random_arm(&mut rng);
        let q = random_joints(&mut rng);
        if robot.singular_distances(&q).unwrap().wrist < 1e-2 {
            continue;
        }
        let target = turned(&robot, &robot.fk(&q), 1e-3);
        let admitting = robot.clone().with_heading_tolerance(1.001e-3).unwrap();
        assert!(nearest(&admitting.ik(&target).unwrap(), &q) < 1e-6);
        let refusing = robot.clone().with_heading_tolerance(0.999e-3).unwrap();
        let solutions = refusing.ik(&target).unwrap();
        assert!(nearest(&solutions, &q) > 1e-9, "{solutions:?}");
        if solutions.is_empty() {
            let Reach::Turned { error } = solutions.reach() else { panic!("{solutions:?}") };
            assert!(error <= 1e-3 + 1e-9 && error > 0.999e-3, "{error}");
            let words = solutions.explain().to_string();
            assert!(words.contains("turned about axis 1 by 0.057 deg"), "{words}");
        }
    }
}

#[test]
fn a_tolerance_outside_its_bounds_is_refused() {
    for tolerance in [-1e-9, f64::NAN, 3.2, f64::INFINITY] {
        let Err(Error::InvalidModel(fault)) = so101().with_heading_tolerance(tolerance) else {
            panic!("{tolerance}");
        };
        assert!(fault.to_string().starts_with("heading_tolerance is "), "{fault}");
    }
}

#[test]
fn a_position_keeps_roll_and_elevation_of_the_seed_as_far_as_it_can() {
    let mut rng = Rng::new(56);
    let robot = so101();
    let mut level = 0;
    for _ in 0..poses() / 100 {
        let [seed, q] = [0; 2].map(|_| {
            let limits = robot.limits().to_array();
            limits.map(|[low, high]| rng.between(low, high))
        });
        let target = robot.fk(&q);
        let Ok(found) = robot.ik_nearest_position(&target, &seed, &[1.0; 5]) else { continue };
        let there = robot.fk(&found.q);
        // The arm may be stretched to a pose that is a nanometer beyond reach.
        assert!((there.translation.vector - target.translation.vector).norm() < 1.1e-9);
        assert!(robot.limits().contains(&found.q));
        let elevation = |pose: &Pose| (pose.rotation * Vector3::z()).z;
        if (elevation(&there) - elevation(&robot.fk(&seed))).abs() < 1e-12 {
            level += 1;
        }
        // From the answer nothing moves.
        let again = robot.ik_nearest_position(&target, &found.q, &[1.0; 5]).unwrap();
        assert!(difference(&again.q, &found.q) < 1e-6, "{found:?} {again:?}");
    }
    assert!(level > 50, "{level}");
}
