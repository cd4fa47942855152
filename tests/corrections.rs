//! Corrections of the parameters of an arm: poses, Jacobian, and the table they make.

use irbkin::nalgebra::{Point3, Rotation3, Vector3};
use irbkin::{Corrections, JacobianFrame, Mdh, Pose, Robot};
use irbkin_motion::Arm;

use crate::common::Rng;

const ARMS: [&str; 4] = ["IRB 2600-12/1.65", "UR5", "IRB 2400-10/1.55", "CRB 15000-5/0.95"];

/// Arms of every kind: a spherical wrist, three parallel axes, coupled axes, none of a catalog.
fn robots() -> Vec<Arm<6>> {
    let mut robots: Vec<_> = ARMS.iter().filter_map(|name| Arm::named(name).ok()).collect();
    assert!(robots.len() >= 3);
    let mut rng = Rng::new(11);
    let rows = std::array::from_fn(|_| {
        irbkin::DhRow::new(
            rng.between(-3.0, 3.0),
            rng.between(-0.5, 0.5),
            rng.between(-0.5, 0.5),
            rng.between(-3.0, 3.0),
        )
    });
    let (base, flange) = (place(&mut rng), place(&mut rng));
    robots.push(Robot::serial_chain(Mdh { base, rows, flange }).unwrap().into());
    robots
        .into_iter()
        .map(|robot| {
            let [base, tool] = [place(&mut rng), place(&mut rng)];
            robot.map(|robot| robot.with_base(&base)?.with_tool(&tool)).unwrap()
        })
        .collect()
}

fn place(rng: &mut Rng) -> Pose {
    let mut vector = || Vector3::from_fn(|_, _| rng.between(-0.5, 0.5));
    let mut pose = Pose::translation(0.0, 0.0, 0.0);
    (pose.translation.vector, pose.rotation) = (vector(), Rotation3::new(3.0 * vector()));
    pose
}

fn drawn(rng: &mut Rng, size: f64) -> Corrections<6> {
    let numbers: Vec<f64> =
        (0..Corrections::<6>::COUNT).map(|_| rng.between(-size, size)).collect();
    Corrections::from_slice(&numbers).unwrap()
}

fn angles(rng: &mut Rng) -> [f64; 6] {
    std::array::from_fn(|_| rng.between(-3.0, 3.0))
}

fn apart(a: &Pose, b: &Pose) -> f64 {
    (a.to_homogeneous() - b.to_homogeneous()).amax()
}

#[test]
fn no_corrections_leave_every_pose() {
    let mut rng = Rng::new(1);
    for robot in robots() {
        assert_eq!(robot.with_corrections(&Corrections::NONE).unwrap(), robot);
        for _ in 0..50 {
            let q = angles(&mut rng);
            // Two products of ten transforms of three meters in all.
            assert!(apart(&robot.corrected_fk(&Corrections::NONE, &q), &robot.fk(&q)) < 1e-14);
        }
    }
}

#[test]
fn the_parameter_jacobian_matches_central_differences() {
    let mut rng = Rng::new(2);
    for robot in robots() {
        for size in [0.0, 1e-3, 0.3] {
            let (corrections, q) = (drawn(&mut rng, size), angles(&mut rng));
            let mut jacobian = vec![0.0; 6 * Corrections::<6>::COUNT];
            robot.parameter_jacobian(&corrections, &q, &mut jacobian).unwrap();
            let flat = flat(&corrections);
            for parameter in 0..flat.len() {
                let at = |step: f64| {
                    let mut moved = flat.clone();
                    moved[parameter] += step;
                    robot.corrected_fk(&Corrections::from_slice(&moved).unwrap(), &q)
                };
                let step = 1e-5;
                let (ahead, behind) = (at(step), at(-step));
                let linear = (ahead.translation.vector - behind.translation.vector) / (2.0 * step);
                // Of a small angle, not by its cosine.
                let turn = (ahead.rotation * behind.rotation.inverse()).into_inner();
                let angular = Vector3::new(
                    turn[(2, 1)] - turn[(1, 2)],
                    turn[(0, 2)] - turn[(2, 0)],
                    turn[(1, 0)] - turn[(0, 1)],
                ) / (4.0 * step);
                for row in 0..6 {
                    let wanted = if row < 3 { linear[row] } else { angular[row - 3] };
                    let found = jacobian[row * flat.len() + parameter];
                    // Third derivatives times step^2 / 6, and rounding of poses over 2 step.
                    assert!((found - wanted).abs() < 1e-9, "{parameter} {row}: {found} {wanted}");
                }
            }
        }
    }
}

fn flat(corrections: &Corrections<6>) -> Vec<f64> {
    let rows = corrections.rows.as_flattened();
    corrections.base.iter().chain(rows).chain(&corrections.tool).copied().collect()
}

#[test]
fn the_column_of_theta_is_that_of_the_joint() {
    let mut rng = Rng::new(3);
    for robot in robots().into_iter().filter(|robot| !robot.is_coupled()) {
        let q = angles(&mut rng);
        let mut parameters = vec![0.0; 6 * Corrections::<6>::COUNT];
        robot.parameter_jacobian(&Corrections::NONE, &q, &mut parameters).unwrap();
        let joints = robot.jacobian(&q, JacobianFrame::Base);
        for joint in 0..6 {
            for row in 0..6 {
                let found = parameters[row * Corrections::<6>::COUNT + 6 + 5 * joint + 3];
                assert!((found - joints[(row, joint)]).abs() < 1e-14);
            }
        }
    }
}

#[test]
fn a_corrected_robot_has_the_corrected_poses() {
    let mut rng = Rng::new(4);
    for robot in robots() {
        for size in [1e-4, 1e-2, 0.3] {
            let mut corrections = drawn(&mut rng, size);
            // Coupled axes must stay nearly parallel.
            let is_refused = robot.is_coupled() && size > 0.1;
            if is_refused {
                let refusal = robot.with_corrections(&corrections).unwrap_err().to_string();
                assert!(refusal.contains("deg off parallel, at most 2.9 deg"), "{refusal}");
                corrections = drawn(&mut rng, 1e-2);
            }
            let corrected = robot.with_corrections(&corrections).unwrap();
            assert_eq!(corrected.is_coupled(), robot.is_coupled());
            assert_eq!(corrected.limits(), robot.limits());
            // A common normal at a distance L costs L / 2^53 a row, times the operations.
            let farthest =
                corrected.mdh().rows.iter().fold(3.0, |most: f64, row| most.max(row.d.abs()));
            for _ in 0..20 {
                let q = angles(&mut rng);
                let off = apart(&corrected.fk(&q), &robot.corrected_fk(&corrections, &q));
                assert!(off < 40.0 * farthest * f64::EPSILON, "{off:e} {farthest}");
            }
        }
    }
}

#[test]
fn an_axis_is_tilted_against_a_parallel_one_at_every_size() {
    let robot = Arm::<6>::named("IRB 2600-12/1.65").unwrap();
    let mut rng = Rng::new(5);
    let mut parallel = 0;
    for exponent in -12..=0 {
        for alpha in [0.0, 1e-4] {
            let mut corrections = Corrections::NONE;
            let beta = 1.1 * 10f64.powi(exponent);
            (corrections.rows[2][0], corrections.rows[2][4]) = (alpha, beta);
            let corrected = robot.with_corrections(&corrections).unwrap();
            let farthest = corrected.mdh().rows[2].d.abs();
            let is_parallel = farthest == 0.0;
            parallel += usize::from(is_parallel);
            // Axes nearer to parallel than a common normal at 5e5 m count as parallel; the flange
            // is 1.2 m from axis 3 at most.
            let bound = if is_parallel {
                assert!(alpha == 0.0 && beta < 1.4e-6);
                1.3 * beta
            } else {
                40.0 * (3.0 + farthest) * f64::EPSILON
            };
            for _ in 0..20 {
                let q = angles(&mut rng);
                let off = apart(&corrected.fk(&q), &robot.corrected_fk(&corrections, &q));
                assert!(off <= bound, "beta {beta:e}: {off:e} > {bound:e}");
            }
        }
    }
    assert_eq!(parallel, 7);
}

#[test]
fn corrections_that_are_none_are_refused() {
    let robot = Arm::<6>::named("IRB 2600-12/1.65").unwrap();
    let mut corrections = Corrections::NONE;
    corrections.rows[1][2] = f64::NAN;
    let refusal = robot.with_corrections(&corrections).unwrap_err().to_string();
    assert_eq!(refusal, "correction 14 is NaN, it must be finite");
    let refusal = Corrections::<6>::from_slice(&[0.0; 30]).unwrap_err().to_string();
    assert!(refusal.contains("corrections") && refusal.contains("42"), "{refusal}");
    let short = robot.parameter_jacobian(&Corrections::NONE, &[0.0; 6], &mut [0.0; 36]);
    assert!(short.unwrap_err().to_string().contains("252"));
}

#[test]
fn the_body_stays_at_the_arm() {
    let mut rng = Rng::new(8);
    let size = 3e-4;
    let robots = robots();
    let with_bodies: Vec<_> = robots.iter().filter_map(|it| Some((it, it.body()?))).collect();
    assert!(with_bodies.len() >= 3);
    for (robot, body) in with_bodies {
        for _ in 0..50 {
            let corrected = robot.with_corrections(&drawn(&mut rng, size)).unwrap();
            let of_corrected = corrected.body().unwrap();
            let q = angles(&mut rng);
            let ([there, here], flange) = ([robot, &corrected].map(|it| it.link_frames(&q).0), 7);
            for (one, other) in body.capsules().iter().zip(of_corrected.capsules()) {
                if one.link == 0 || one.link == flange {
                    continue;
                }
                let ends = one.capsule.ends().into_iter().zip(other.capsule.ends());
                for (end, moved) in ends {
                    let at = there[one.link - 1] * Point3::from(end);
                    let off = (here[one.link - 1] * Point3::from(moved) - at).norm();
                    // Each of 42 corrections moves a point by itself or itself times its distance.
                    let bound = 42.0 * size * (1.0 + 3.0);
                    assert!(off < bound, "{} link {}: {off:e}", robot.name(), one.link);
                }
            }
        }
    }
}
