//! A smooth joint path is followed without a jump; where there is no way, the break reports where
//! and why.
//!
//! `make evidence SUITE=hardsets` prints the table.
#![allow(clippy::cast_precision_loss)]

use std::f64::consts::{FRAC_PI_2, PI};

use crate::common::{Rng, asked_set};

use nalgebra::Vector3;

use irbkin::follow::{BreakReason, FollowOptions, Followed, SingularityMode};
use irbkin::{JointLimits, OpwParameters, Pose, Robot, SingularityKind, thresholds};

const SAMPLES: usize = 201;

/// The robot of every path, solved on the requested instruction set.
fn robot() -> Robot<6> {
    asked_set();
    Robot::named("IRB 2600-12/1.65").unwrap()
}

/// A joint path over t in -1 ..= 1, of which the middle sample is t = 0 exactly.
fn joint_path(path: impl Fn(f64) -> [f64; 6]) -> Vec<[f64; 6]> {
    (0..SAMPLES).map(|i| path(2.0 * i as f64 / (SAMPLES - 1) as f64 - 1.0)).collect()
}

fn largest_step(path: &[[f64; 6]]) -> f64 {
    path.windows(2)
        .flat_map(|pair| (0..6).map(move |i| (pair[1][i] - pair[0][i]).abs()))
        .fold(0.0, f64::max)
}

fn follow(robot: &Robot<6>, made: &[[f64; 6]]) -> (Vec<Pose>, Followed) {
    let poses: Vec<Pose> = made.iter().map(|q| robot.fk(q)).collect();
    let followed = robot.follow(&poses, &made[0], &FollowOptions::default()).unwrap();
    (poses, followed)
}

/// Follows a smooth path: every pose reached, no break, no step more than one and a half times the
/// path's own.
fn check_smooth(name: &str, robot: &Robot<6>, made: &[[f64; 6]]) {
    let (poses, followed) = follow(robot, made);
    let q: Vec<[f64; 6]> = followed.q.iter().map(|q| q.unwrap()).collect();
    let ratio = largest_step(&q) / largest_step(made);
    let worst =
        q.iter().zip(&poses).map(|(q, pose)| robot.residual(q, pose).largest()).fold(0.0, f64::max);
    println!(
        "{name:52} largest step {ratio:5.2} x the path's  worst residual {worst:.1e}  breaks {}",
        followed.breaks.len()
    );
    assert!(followed.breaks.is_empty(), "{name}: {}", followed.breaks[0]);
    assert!(ratio <= 1.5, "{name}: {ratio}");
    // A pose within 1e-12 of a wrist singularity keeps the path's own joint 4.
    assert!(worst <= 2e-12, "{name}: {worst:e}");
    assert!(q.iter().all(|q| robot.limits().contains(q)), "{name}");
}

/// q2 that puts the wrist center of an IRB 2600 on axis 1 for q3, leaning back.
fn over_the_base(q3: f64) -> f64 {
    let (along, across) =
        (0.7 - 0.795 * q3.sin() + 0.115 * q3.cos(), 0.795 * q3.cos() + 0.115 * q3.sin());
    (-0.15 / along.hypot(across)).asin() - across.atan2(along)
}

/// q3 of a stretched IRB 2600.
fn stretched() -> f64 {
    (0.115_f64).atan2(0.795) - FRAC_PI_2
}

#[test]
fn the_wrist_is_passed_without_a_jump() {
    let robot = robot();
    check_smooth(
        "J5 through 0, J4 still",
        &robot,
        &joint_path(|t| [0.3 + 0.1 * t, 0.2, 0.1 + 0.2 * t, 0.7, 0.5 * t, -0.4]),
    );
    check_smooth(
        "J5 through 0, J4 moving",
        &robot,
        &joint_path(|t| [0.3 * t, 0.2, 0.1, 0.7 + 0.4 * t, 0.5 * t, -0.4]),
    );
    check_smooth(
        "J5 through 0, J4 and J6 moving",
        &robot,
        &joint_path(|t| [0.3, 0.2 * t, 0.1, 0.5 * t, 0.3 * t, 0.5 * t]),
    );
    check_smooth(
        "J5 through 0, J4 against J6",
        &robot,
        &joint_path(|t| [0.3, 0.2 * t, 0.1, 0.5 * t, 0.3 * t, -0.5 * t]),
    );
    check_smooth(
        "J5 = 0 all along, J4 moving",
        &robot,
        &joint_path(|t| [0.3 + 0.2 * t, 0.2, 0.1 * t, 0.8 * t, 0.0, 0.2]),
    );
    check_smooth(
        "J5 = 0 all along, J4 and J6 moving",
        &robot,
        &joint_path(|t| [0.3, 0.2, 0.1, 0.8 * t, 0.0, 0.8 * t]),
    );
    for near in [1e-12, 1e-9, 1e-7, 1e-6, 1e-4] {
        check_smooth(
            &format!("J5 through {near:e} at the middle"),
            &robot,
            &joint_path(|t| [0.1 * t, 0.2, 0.1, 0.4 * t, near + 0.5 * t, 0.3]),
        );
        check_smooth(
            &format!("J5 = {near:e} all along"),
            &robot,
            &joint_path(|t| [0.3 * t, 0.2, 0.1, 0.4 * t, near, 0.3]),
        );
    }
}

#[test]
fn the_shoulder_is_passed_without_a_jump() {
    let robot = robot();
    let q3 = -0.6;
    let q2 = over_the_base(q3);
    for near in [0.0, 1e-12, 1e-9, 1e-7, 1e-6, 1e-4] {
        let name = format!("wrist center over axis 1, {near:e} rad off at the middle");
        check_smooth(
            &name,
            &robot,
            &joint_path(|t| [0.4 * t, q2 + near + 0.3 * t, q3, 0.3, 0.8 + 0.1 * t, 0.2 * t]),
        );
    }
    check_smooth(
        "along axis 1",
        &robot,
        &joint_path(|t| [0.4 * t, over_the_base(q3 + 0.1 * t), q3 + 0.1 * t, 0.3, 0.8, 0.2]),
    );
}

#[test]
fn the_elbow_is_stretched_and_bent_again() {
    let robot = robot();
    let q3 = stretched();
    check_smooth(
        "stretched and back",
        &robot,
        &joint_path(|t| [0.3 * t, 0.4, q3 + 0.4 * t * t, 0.3, 0.8, 0.2]),
    );
    check_smooth(
        "through stretched",
        &robot,
        &joint_path(|t| [0.3 * t, 0.4 + 0.3 * t, q3 + 0.4 * t, 0.3, 0.8, 0.2]),
    );
    check_smooth(
        "stretched all along",
        &robot,
        &joint_path(|t| [0.3 * t, 0.4 + 0.3 * t, q3, 0.3, 0.8 + 0.2 * t, 0.2]),
    );
    check_smooth(
        "stretched with J5 through 0",
        &robot,
        &joint_path(|t| [0.3 * t, 0.4, q3 + 0.4 * t * t, 0.3, 0.5 * t, 0.2]),
    );
}

#[test]
fn the_joints_turn_on_up_to_the_limits() {
    let robot = robot();
    let turns = 390.0_f64.to_radians();
    check_smooth(
        "J4 and J6 from -390 to 390 deg",
        &robot,
        &joint_path(|t| [0.3, 0.2, 0.1, turns * t, 0.8, -turns * t]),
    );
    check_smooth(
        "J1 from -179 to 179 deg",
        &robot,
        &joint_path(|t| [179.0_f64.to_radians() * t, 0.2, 0.1, 0.2, 0.8, 0.3]),
    );
    let free = robot.with_limits(JointLimits::UNLIMITED);
    check_smooth(
        "J1 from -720 to 720 deg without limits",
        &free,
        &joint_path(|t| [4.0 * PI * t, 0.2, 0.1, 0.2, 0.8, 0.3]),
    );
}

#[test]
fn arms_of_other_makers_pass_the_wrist_without_a_jump() {
    let kuka = crate::structures::spherical_wrist::kuka_kr6().unwrap();
    check_smooth(
        "KUKA, J5 through 0",
        &kuka,
        &joint_path(|t| [0.3, -1.4, 1.3 + 0.1 * t, 0.5 * t, 0.4 * t, 0.3]),
    );
    let lateral = Robot::from_opw(OpwParameters {
        b: 0.05,
        ..OpwParameters::abb(0.15, -0.11, 0.45, 0.6, 0.64, 0.1)
    })
    .unwrap();
    check_smooth(
        "lateral offset, J5 through 0",
        &lateral,
        &joint_path(|t| [0.3, 0.2, 0.1 * t, 0.5 * t, 0.4 * t, 0.3]),
    );
}

/// Where the break is and by how much the joint turns.
fn jump(followed: &Followed) -> (usize, usize, f64, SingularityKind) {
    assert_eq!(followed.breaks.len(), 1, "{:?}", followed.breaks);
    let broken = followed.breaks[0];
    println!("{broken}");
    let BreakReason::Jump { joint, by, kinds } = broken.reason else { unreachable!("{broken}") };
    (broken.pose_index, joint, by, kinds)
}

#[test]
fn a_corner_in_the_wrist_singularity_is_a_break() {
    // In along one direction, out along another: J4 must turn by 60 deg at J5 = 0.
    let robot = robot();
    let turned = |t: f64| if t < 0.0 { 0.0 } else { PI / 3.0 };
    let made = joint_path(|t| [0.3, 0.2, 0.1, 0.2 + turned(t), 0.5 * t, 0.1 - turned(t)]);
    let (index, joint, by, kinds) = jump(&follow(&robot, &made).1);
    assert_eq!((index, joint, kinds), (SAMPLES / 2 + 1, 4, SingularityKind::WRIST));
    assert!((by.abs() - PI / 3.0).abs() < 0.02, "{by}");
}

#[test]
fn joint_4_turns_by_pi_if_joint_5_keeps_its_sign() {
    let robot = robot();
    let mut limits = robot.limits().to_array();
    limits[4][0] = 0.0;
    let robot = robot.with_limits(JointLimits::new(limits).unwrap());
    let made = joint_path(|t| {
        [
            0.3,
            0.2,
            0.1,
            if t < 0.0 { 0.2 + PI } else { 0.2 },
            0.5 * t.abs(),
            if t < 0.0 { 0.1 - PI } else { 0.1 },
        ]
    });
    let (index, joint, by, kinds) = jump(&follow(&robot, &made).1);
    assert!(
        index.abs_diff(SAMPLES / 2) <= 1
            && [4, 6].contains(&joint)
            && kinds == SingularityKind::WRIST
    );
    assert!((by.abs() - PI).abs() < 0.02, "{by}");
}

#[test]
fn a_pose_out_of_reach_is_a_break_and_the_path_continues() {
    let robot = robot();
    let made = joint_path(|t| [0.3 * t, 0.2, 0.1, 0.4, 0.5, 0.1]);
    let mut poses: Vec<Pose> = made.iter().map(|q| robot.fk(q)).collect();
    poses[50].translation.vector.x += 5.0;
    let followed = robot.follow(&poses, &made[0], &FollowOptions::default()).unwrap();
    assert_eq!((followed.breaks.len(), followed.breaks[0].pose_index), (1, 50));
    assert!(followed.breaks[0].to_string().starts_with("pose 50: wrist center "));
    assert!(followed.q[50].is_none() && followed.q[51].is_some());
}

/// A straight line of the tool through the wrist singularity or `off` [rad] past it.
fn line_through_wrist(robot: &Robot<6>, off: f64, along: [f64; 3]) -> Vec<Pose> {
    let middle = robot.fk(&[0.3, 0.2, 0.1, if off == 0.0 { 0.0 } else { FRAC_PI_2 }, off, 0.2]);
    joint_path(|t| [t; 6])
        .iter()
        .map(|t| {
            let mut pose = middle;
            pose.translation.vector += Vector3::from(along) * t[0];
            pose
        })
        .collect()
}

struct Crossed {
    step: f64,
    position: f64,
    orientation: f64,
    followed: Followed,
}

fn cross(robot: &Robot<6>, path: &[Pose], singularity_mode: SingularityMode) -> Crossed {
    let seed = robot.ik_nearest(&path[0], &[0.3, 0.2, 0.1, 0.0, 0.3, 0.2], &[1.0; 6]).unwrap().q;
    let followed = robot
        .follow(path, &seed, &FollowOptions { singularity_mode, ..FollowOptions::default() })
        .unwrap();
    let q: Vec<[f64; 6]> = followed.q.iter().map_while(|q| *q).collect();
    let error = |(q, pose)| robot.residual(q, pose).position;
    let position = q.iter().zip(path).map(error).fold(0.0, f64::max);
    let orientation = followed.orientation_error.iter().flatten().copied().fold(0.0, f64::max);
    Crossed { step: largest_step(&q), position, orientation, followed }
}

#[test]
fn singularity_modes_keep_their_guarantees() {
    let robot = robot();
    for off in [0.0, 1e-4, 2e-3] {
        for along in [[0.0, 0.15, 0.02], [0.1, 0.0, 0.1], [0.0, 0.2, 0.0]] {
            let path = line_through_wrist(&robot, off, along);
            let tell = |name: &str, crossed: &Crossed| {
                println!(
                    "line past J5 = 0 by {off:5e} rad, {along:?} m: {name:10} largest step {:6.3} \
                     deg  orientation {:8.1e} deg  position {:.0e} m",
                    crossed.step.to_degrees(),
                    crossed.orientation.to_degrees(),
                    crossed.position
                );
            };
            let through = cross(&robot, &path, SingularityMode::Through);
            tell("through", &through);
            assert!(
                through.position < 1e-14
                    && through.orientation < 1e-14
                    && through.followed.breaks.is_empty()
            );

            let stopped = cross(&robot, &path, SingularityMode::Error);
            tell("error", &stopped);
            let index = stopped.followed.breaks[0].pose_index;
            assert!(matches!(stopped.followed.breaks[0].reason, BreakReason::Stopped { .. }));
            assert!(
                stopped.followed.q[..index].iter().all(Option::is_some)
                    && stopped.followed.q[index..].iter().all(Option::is_none)
            );

            let wrist = cross(&robot, &path, SingularityMode::Wrist);
            tell("wrist", &wrist);
            // Three wrist angles that move straight between two ends of the zone stay within it on
            // both sides.
            assert!(
                wrist.position < 1e-14
                    && wrist.orientation < 2.0 * thresholds::WRIST_ZONE
                    && wrist.followed.breaks.is_empty()
            );
            assert!(wrist.step < 0.02, "{}", wrist.step);

            let locked = cross(&robot, &path, SingularityMode::LockAxis4);
            tell("lock_axis4", &locked);
            assert!(
                locked.position < 1e-14 && locked.followed.breaks.is_empty() && locked.step < 0.02
            );
            assert!(locked.followed.q.iter().flatten().all(|q| (q[3] / PI).fract() == 0.0));
        }
    }
}

#[test]
fn axis_4_locked_at_zero_keeps_the_orientation_in_the_plane_of_the_arm() {
    let robot = robot();
    let made = joint_path(|t| [0.3, 0.2 + 0.1 * t, 0.1, 0.0, 0.5 * t, 0.2]);
    let path: Vec<Pose> = made.iter().map(|q| robot.fk(q)).collect();
    let locked = cross(&robot, &path, SingularityMode::LockAxis4);
    assert!(locked.position < 1e-14 && locked.orientation < 1e-14, "{:e}", locked.orientation);
    assert!(locked.step <= 1.01 * largest_step(&made));
}

/// A random smooth path whose middle is at or near none, one, two or all three singularities;
/// `None` if it leaves the limits.
fn random_path(robot: &Robot<6>, rng: &mut Rng) -> Option<Vec<[f64; 6]>> {
    const NEAR: [f64; 6] = [0.0, 1e-12, 1e-9, 1e-7, 1e-6, 1e-4];
    let sign = |rng: &mut Rng| if rng.unit() < 0.5 { -1.0 } else { 1.0 };
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "an index")]
    let near = NEAR[(rng.unit() * 6.0) as usize] * sign(rng);
    let mut middle =
        robot.limits().to_array().map(|[low, high]| rng.between(0.5 * low, 0.5 * high));
    if rng.unit() < 0.5 {
        middle[4] = near;
    }
    if rng.unit() < 0.5 {
        middle[2] = stretched() + near;
    }
    if rng.unit() < 0.5 {
        middle[1] = over_the_base(middle[2]) + near;
    }
    let rates: [f64; 6] =
        std::array::from_fn(|_| if rng.unit() < 0.5 { rng.between(-0.4, 0.4) } else { 0.0 });
    let bends: [f64; 6] = std::array::from_fn(|_| rng.between(-0.1, 0.1));
    let path = joint_path(|t| std::array::from_fn(|i| middle[i] + rates[i] * t + bends[i] * t * t));
    (path.iter().all(|q| robot.limits().contains(q)) && largest_step(&path) > 1e-3).then_some(path)
}

#[test]
fn random_paths_through_several_singularities_are_followed() {
    let robot = robot();
    let mut rng = Rng::new(3);
    let paths = 10
        * std::env::var("IRBKIN_POSES").ok().map_or(100, |count| count.parse::<usize>().unwrap());
    let (mut followed_smoothly, mut behind_an_elbow, mut orientation) = (0, 0, 0.0_f64);
    for made in std::iter::repeat_with(|| random_path(&robot, &mut rng)).flatten().take(paths) {
        let (poses, followed) = follow(&robot, &made);
        let q: Vec<[f64; 6]> = followed.q.iter().map(|q| q.unwrap()).collect();
        let worst = q.iter().zip(&poses).map(|(q, pose)| robot.residual(q, pose));
        for error in worst {
            // The wrist center is exact; the flange, 85 mm in front of it, turns about it.
            assert!(error.position < 3e-12 + 0.085 * error.rotation, "{error:?}");
            orientation = orientation.max(error.rotation);
        }
        let smooth = followed.breaks.is_empty() && largest_step(&q) <= 1.5 * largest_step(&made);
        followed_smoothly += usize::from(smooth);
        // The arm may return from stretched on its other elbow, and there meet a singularity that
        // the path does not contain.
        let elbow = |q: &[f64; 6]| q[2] - stretched();
        let passes =
            made.iter().map(elbow).fold(f64::INFINITY, |least, e| least.min(e.abs())) < 0.02;
        behind_an_elbow += usize::from(!smooth && passes);
        assert!(smooth || passes, "{:?} {:?}", followed.breaks, made[SAMPLES / 2]);
    }
    println!(
        "{paths} random paths: {followed_smoothly} followed smoothly, {behind_an_elbow} not, \
         behind a stretched elbow; worst orientation {orientation:.1e} rad"
    );
    // A straight elbow leaves the forearm undetermined by 2e-7 rad on either side
    // (docs/evidence/accuracy.md, section 9).
    assert!(orientation < 4e-7);
    assert!(followed_smoothly * 100 >= paths * 99);
}

#[test]
fn wrist_mode_with_few_uneven_poses_stays_within_two_zones() {
    let robot = robot();
    let made: Vec<[f64; 6]> =
        [0.5, 0.016, 0.01, -0.001, -0.015, -0.1].map(|q5| [0.3, 0.2, 0.1, 0.5, q5, 0.4]).to_vec();
    let path: Vec<Pose> = made.iter().map(|q| robot.fk(q)).collect();
    let wrist = cross(&robot, &path, SingularityMode::Wrist);
    assert!(
        wrist.orientation < 2.0 * thresholds::WRIST_ZONE && wrist.position < 1e-14,
        "{:e}",
        wrist.orientation
    );
    assert!(wrist.followed.breaks.is_empty());
}

#[test]
fn axis_4_locked_at_half_a_turn_keeps_it_over_the_base() {
    let robot = robot();
    let path: Vec<Pose> = (0..20)
        .map(|i| robot.fk(&[0.3, over_the_base(-0.6) + 1e-3 * f64::from(i), -0.6, PI, 0.8, 0.2]))
        .collect();
    let seed = [0.3, over_the_base(-0.6), -0.6, PI, 0.8, 0.2];
    let followed = robot
        .follow(
            &path,
            &seed,
            &FollowOptions {
                singularity_mode: SingularityMode::LockAxis4,
                ..FollowOptions::default()
            },
        )
        .unwrap();
    assert!(followed.breaks.is_empty(), "{}", followed.breaks[0]);
    assert!(
        followed.orientation_error.iter().flatten().all(|error| *error < 1e-12),
        "{:?}",
        followed.orientation_error
    );
}
