//! The nearest solution, chosen in lanes, is the one that is chosen alone.

use std::f64::consts::{PI, TAU};
use std::num::NonZeroUsize;

use irbkin::batch::Batch;
use irbkin::{JointLimits, Robot, pose};

use super::same_bits;
use super::subjects::{PoseRow, rows, subjects};
use crate::common::Rng;
use crate::common::coupled_arm::{limited, odd, opposed, with_linkage};
use crate::common::sets::on_each_set;
use crate::structures::Structure;
use crate::structures::on_every_structure;

alone!(on_every_structure: the_nearest_of_rows_is_the_nearest_alone,);

/// No multiple of any lane count; every kind of row in every lane.
const ROWS: usize = 24 * 9 + 5;

/// A search along a redundancy takes as long as a hundred poses.
const ROWS_OF_SEVEN: usize = 29;

fn the_nearest_of_rows_is_the_nearest_alone<const N: usize>(structure: &Structure<N>) {
    let count = if N == 7 { ROWS_OF_SEVEN } else { ROWS };
    on_each_set(|set| {
        let (mut found, mut missing) = (0, 0);
        for subject in &subjects(structure) {
            let (poses, joints): (Vec<_>, Vec<_>) = rows(subject, count).into_iter().unzip();
            let what = format!("{}, {}", subject.name, set.name());
            let counts = nearest_agrees(&subject.robot, &poses, &joints, &what);
            (found, missing) = (found + counts[0], missing + counts[1]);
        }
        assert!(found > count && missing > count, "{}: {found}, {missing}", set.name());
    });
}

/// Compares every row in a batch with the row alone; returns how many have a solution and have
/// none.
fn nearest_agrees<const N: usize>(
    robot: &Robot<N>,
    poses: &[PoseRow],
    joints: &[[f64; N]],
    what: &str,
) -> [usize; 2] {
    let mut rng = Rng::new(0x5eed);
    let seeds: Vec<[f64; N]> =
        joints.iter().enumerate().map(|(row, q)| seed(row, q, &mut rng)).collect();
    let mut counts = [0, 0];
    let few = std::array::from_fn(|joint| if joint % 3 == 1 { 0.0 } else { 0.3 });
    for weights in [[1.0; N], few] {
        let solve = |threads| {
            let mut q = vec![[7.0; N]; poses.len()];
            let (poses, seeds, out) =
                (poses.as_flattened(), seeds.as_flattened(), q.as_flattened_mut());
            Batch::new(NonZeroUsize::new(threads))
                .ik_nearest(robot, poses, seeds, &weights, out)
                .unwrap();
            q
        };
        let together = solve(1);
        for (row, ((pose, seed), nearest)) in poses.iter().zip(&seeds).zip(&together).enumerate() {
            let alone = pose::from_rows(pose)
                .and_then(|pose| robot.ik_nearest(&pose, seed, &weights))
                .map_or([f64::NAN; N], |solution| solution.q);
            assert!(
                same_bits(nearest, &alone),
                "{what}, row {row}, seed {seed:?}:\n{nearest:?}\n{alone:?}"
            );
            counts[usize::from(alone[0].is_nan())] += 1;
        }
    }
    counts
}

/// Next to joints, at them, turns away from them, half a turn to rounding, anywhere, or no seed.
fn seed<const N: usize>(row: usize, q: &[f64; N], rng: &mut Rng) -> [f64; N] {
    let turns = [-2.0 * TAU, -TAU, 0.0, TAU, 2.0 * TAU];
    let mut seed = q.map(|angle| if angle.is_finite() { angle } else { 0.1 });
    for (joint, angle) in seed.iter_mut().enumerate() {
        *angle += match row % 11 {
            0..4 => 0.05 * rng.between(-1.0, 1.0),
            4 => turns[(row + joint) % 5],
            5 => PI,
            6 => -PI * (1.0 + f64::EPSILON),
            7 => PI + 1e-10 * rng.between(-1.0, 1.0),
            8 => 3.0 * PI + 1e-10 * rng.between(-1.0, 1.0),
            // A solution: the same arm with its wrist flipped is half a turn away.
            9 => 0.0,
            _ => 20.0 * rng.between(-1.0, 1.0),
        };
    }
    match row % 37 {
        3 => seed[row % N] = f64::NAN,
        9 => seed[row % N] = 2e5,
        _ => {}
    }
    seed
}

#[test]
#[ignore = "run by itself: cargo test --lib -- --ignored"]
fn the_nearest_of_a_coupled_arm_is_the_nearest_alone() {
    let mut rng = Rng::new(8);
    let narrow = |robot: Robot<6>| {
        let limits = robot.limits().to_array().map(|[low, high]| [0.6 * low, 0.6 * high]);
        JointLimits::new(limits).map(|limits| robot.with_limits(limits)).unwrap()
    };
    on_each_set(|set| {
        let fanuc = opposed().with_linkage_limits(Some([-1.0, 2.0])).unwrap();
        for robot in [limited(), with_linkage(), odd(), narrow(with_linkage()), fanuc] {
            let joints: Vec<_> = (0..403).map(|_| rng.inside(limited().limits())).collect();
            let poses: Vec<_> =
                joints.iter().map(|q| irbkin::pose::to_rows(&robot.fk(q))).collect();
            let [found, _] = nearest_agrees(&robot, &poses, &joints, set.name());
            assert!(found > 50, "{found}");
        }
    });
}
