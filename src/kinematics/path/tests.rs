//! A path is the same whether its regular poses are solved in lanes or by the scalar solver.

use core::f64::consts::TAU;
use std::{format, println, string::String, vec::Vec};

use super::follow::{Break, BreakReason};
use super::singularity_mode::FollowOptions;
use crate::kinematics::pose::Pose;
use crate::kinematics::robot::Robot;
use crate::kinematics::thresholds::WRIST_MERGE_SIN;
use crate::rng::Rng;
use crate::sets::on_each_set;

/// Paths of each robot and kind, and poses of each path.
const PATHS: usize = 40;
const POSES: u32 = 60;

/// A smooth path of joints whose middle is near a wrist singularity, a stretched elbow, both or
/// none; or a line from one pose to another, as it comes.
fn path(robot: &Robot<6>, kind: usize, random: &mut Rng) -> Vec<Pose> {
    let limits = robot.limits().to_array().map(|[low, high]| [low.max(-3.0), high.min(3.0)]);
    let mut inside = || limits.map(|[low, high]| random.between(low, high));
    let (mut middle, end) = (inside(), inside());
    let near = [0.0, 1e-9, 1e-6, 1e-4, 1e-2][kind % 5];
    if kind % 2 == 1 {
        middle[4] = near;
    }
    if kind % 3 == 1 {
        middle[2] = 0.02 * near;
    }
    let parts = (0..POSES).map(|pose| 2.0 * f64::from(pose) / f64::from(POSES - 1) - 1.0);
    let rates: [f64; 6] = core::array::from_fn(|_| random.between(-0.4, 0.4));
    if kind % 4 == 3 {
        let (from, to) = (robot.fk(&middle), robot.fk(&end));
        return parts.map(|part| from.lerp_slerp(&to, 0.5 + 0.5 * part)).collect();
    }
    parts.map(|part| robot.fk(&core::array::from_fn(|i| middle[i] + rates[i] * part))).collect()
}

/// Where a path breaks and why, without the digits that rounding changes.
fn reasons(breaks: &[Break]) -> Vec<(usize, String)> {
    let reason = |reason: &BreakReason| match reason {
        BreakReason::Jump { joint, kinds, .. } => format!("jump of {joint} at {kinds:?}"),
        other => format!("{other:.6?}"),
    };
    breaks.iter().map(|broken| (broken.pose_index, reason(&broken.reason))).collect()
}

#[test]
#[ignore = "run by itself: cargo test --lib -- --ignored"]
fn a_path_in_lanes_is_that_of_the_scalar_solver() {
    let names = ["IRB 2600-12/1.65", "IRB 120-3/0.58", "IRB 2400-10/1.55", "UR3", "UR10e"];
    let options = FollowOptions::default();
    on_each_set(|set| {
        let mut random = Rng::new(17);
        let (mut poses, mut broken, mut most) = (0, 0, 0.0_f64);
        for name in names {
            let robot = Robot::<6>::named(name).unwrap();
            let scalar = robot.clone().without_lanes();
            for kind in 0..PATHS {
                let path = path(&robot, kind, &mut random);
                let seed = [0.1; 6];
                let in_lanes = robot.follow(&path, &seed, &options).unwrap();
                let alone = scalar.follow(&path, &seed, &options).unwrap();
                let what = format!("{name}, {kind}, {}", set.name());
                assert_eq!(reasons(&in_lanes.breaks), reasons(&alone.breaks), "{what}");
                broken += alone.breaks.len();
                let unbroken = alone.breaks.first().map_or(path.len(), |first| first.pose_index);
                for (index, (q, alone)) in in_lanes.q.iter().zip(&alone.q).enumerate() {
                    assert_eq!(q.is_some(), alone.is_some(), "{what}");
                    let Some((q, alone)) = q.zip(*alone) else { continue };
                    // A jump to the flipped wrist is one by half a turn exactly, and rounding
                    // decides in which direction.
                    let turn = if index < unbroken { f64::INFINITY } else { TAU };
                    let apart = q.iter().zip(alone).map(|(a, b)| (a - b).abs());
                    let apart = apart.map(|apart| apart.min((apart - turn).abs()));
                    let apart = apart.fold(0.0, f64::max);
                    // No encoder resolves a nanoradian.
                    assert!(apart <= WRIST_MERGE_SIN, "{what}: {apart:e} rad");
                    (poses, most) = (poses + 1, most.max(apart));
                }
            }
        }
        println!("{}: {poses} poses, {broken} breaks, at most {most:.1e} rad apart", set.name());
        assert!(poses > 5000 && broken > 100, "{poses} poses, {broken} breaks");
    });
}
