//! Arms of every kind that the kernels distinguish, and poses of every kind that a batch may
//! contain.

use std::f64::consts::PI;

use irbkin::{JointLimits, pose};

use crate::common::{Rng, random_pose};
use crate::structures::place::{At, Place};
use crate::structures::{Structure, Subject};

pub type PoseRow = [f64; 16];

/// A row with a joint vector, whose joint 7 is given to an arm of seven joints.
pub type Row<const N: usize> = (PoseRow, [f64; N]);

/// The arms of a structure, two of them again with tools and bases, with and without rotation, and
/// with limits that exclude nothing or much, require a 2 pi equivalent, or are so far from zero
/// that more than one turn is needed.
pub fn subjects<const N: usize>(structure: &Structure<N>) -> Vec<Subject<N>> {
    let tool = pose::from_euler_zyx([0.03, -0.02, 0.2], [0.3, -0.7, 1.1]).unwrap();
    let base = pose::from_euler_zyx([0.8, -0.5, 0.3], [-1.9, 0.4, 0.2]).unwrap();
    let straight = pose::from_euler_zyx([0.01, -0.02, 0.3], [0.0; 3]).unwrap();
    let infinite = f64::INFINITY;
    // Seven of each kind; an arm of six joints takes the first ones.
    let limits = [
        ("no limits", [[-infinite, infinite]; 7]),
        ("narrow limits", [[-0.4, 0.9]; 7]),
        (
            "limits beyond half a turn",
            [
                [-7.0, 1.0],
                [-1.0, 4.5],
                [-4.7, -0.2],
                [-9.0, 9.0],
                [-PI, 0.3],
                [-0.3, PI],
                [-4.0, 5.0],
            ],
        ),
        (
            "limits more than a turn away",
            [[4.0, 7.0], [-PI, PI], [-PI, PI], [-7.0, -4.0], [-PI, PI], [9.0, 16.0], [-PI, PI]],
        ),
        (
            "limits on one side",
            [
                [-infinite, 1.0],
                [-1.0, infinite],
                [-PI, PI],
                [-3.5, 3.5],
                [-2.0, 2.0],
                [-9.0, 1.0],
                [-infinite, 2.0],
            ],
        ),
    ];
    let mut subjects = structure.subjects.clone();
    subjects.push(structure.many_turns.clone());
    let (first, last) = (&structure.subjects[0], structure.subjects.last().unwrap());
    let named = |arm: &Subject<N>, what: &str| arm.clone().named(&format!("{}, {what}", arm.name));
    let straight =
        named(first, "straight tool").with_robot(|robot| robot.with_tool(&straight).unwrap());
    subjects.push(straight);
    for arm in [first, last] {
        subjects.push(
            named(arm, "tool and base")
                .with_robot(|robot| robot.with_tool(&tool).unwrap().with_base(&base).unwrap()),
        );
    }
    for (i, (what, limits)) in limits.into_iter().enumerate() {
        let limits = JointLimits::new(std::array::from_fn(|i| limits[i])).unwrap();
        let arm = if i % 2 == 0 { last } else { first };
        subjects.push(named(arm, what).with_robot(|robot| robot.with_limits(limits)));
    }
    subjects
}

/// Rows of all kinds, each in a block with the others.
pub fn rows<const N: usize>(subject: &Subject<N>, count: usize) -> Vec<Row<N>> {
    let mut rng = Rng::new(0x1a9e5);
    (0..count).map(|i| row(subject, i, &mut rng)).collect()
}

/// A row of one of 24 kinds, every other one regular.
fn row<const N: usize>(subject: &Subject<N>, kind: usize, rng: &mut Rng) -> Row<N> {
    let theta = rng.angles();
    let round = kind / 24;
    let near = [0.0, 1e-12, 1e-9, 9e-7, 1.1e-6, 1e-4][round % 6];
    let made = |theta| {
        let q = subject.arm.q(theta);
        (pose::to_rows(&subject.robot.fk(&q)), q)
    };
    let mut at = |at: At| {
        let place = Place::of(at, near);
        (0..1000).find_map(|_| subject.arm.at(&place, rng)).map_or_else(|| made(theta), made)
    };
    let (mut row, q) = match kind % 24 {
        1 => at(At::Wrist),
        3 => at(At::Elbow),
        5 => at(At::Shoulder),
        7 => {
            let bent = [0.0, 0.4, 0.0, 0.0, 0.5, 0.0, 0.0];
            made(std::array::from_fn(|i| rng.sign() * bent[i]))
        }
        9 => {
            let far = 1.3 * subject.reach();
            (pose::to_rows(&random_pose(rng, far)), subject.arm.q(theta))
        }
        _ => made(theta),
    };
    match kind % 24 {
        11 => row[3 + 4 * (round % 3)] = [1e6, -1e7, 1e300][kind / 72 % 3],
        13 => row[round % 12] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY][round % 3],
        15 => [row[2], row[6], row[10]] = [-row[2], -row[6], -row[10]],
        17 => row[round % 3] += [1e-3, -2e-3][round % 2],
        // Repaired: by rounding in single precision, and just within and beyond what is accepted
        // unchanged.
        19 => row[round % 3] += [1e-7, 1e-14, 3e-15, 1e-6][round % 4],
        // The last row, accepted and not.
        21 => row[12 + round % 4] += [1e-12, 9e-10, 1e-6][round % 3],
        // Zeros of both signs.
        23 => {
            row = [
                0.0, 0.0, 1.0, 0.6, -0.0, 1.0, -0.0, -0.0, -1.0, 0.0, 0.0, 0.7, 0.0, -0.0, 0.0, 1.0,
            ];
        }
        _ => {}
    }
    (row, q)
}

/// Joint vectors with angles of many turns; some rows are not finite.
pub fn joint_rows<const N: usize>(count: usize) -> Vec<[f64; N]> {
    let mut rng = Rng::new(0x10b);
    let row = |i: usize| {
        let most = [PI, 400.0, 1e5, 1.1e5, 1e9, 1e15, 0.0][i % 7];
        let mut q: [f64; N] = std::array::from_fn(|_| rng.between(-most, most));
        match i % 11 {
            5 => q[i % N] = [f64::NAN, f64::INFINITY][i % 2],
            7 => q[i % N] = 1e9,
            8 => q[i % N] = -0.0,
            _ => {}
        }
        q
    };
    (0..count).map(row).collect()
}
