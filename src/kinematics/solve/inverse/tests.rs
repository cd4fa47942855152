//! The lanes and the scalar solver agree on every pose that the lanes accept, up to the margins
//! where they accept none.

use core::f64::consts::{FRAC_PI_2, PI};
use std::{format, println, string::String, vec::Vec};

mod arm;
mod on_path;

use super::*;
use crate::kinematics::pose::angles::wrap;
use crate::kinematics::pose::{pose_from_euler_zyx, translation_z};
use crate::kinematics::structure::spherical_wrist::OpwParameters;
use crate::kinematics::thresholds::{
    REACH_TOLERANCE, REGULAR_REACH, REGULAR_SHOULDER, REGULAR_WRIST_SIN, SHOULDER_MERGE,
};
use crate::kinematics::{DhRow, JacobianFrame, JointLimits, Mdh, PoseDifference};
use crate::rng::Rng;
use crate::sets::on_each_set;
use arm::Arm;

/// Poses in each set.
const POSES: usize = 300;

/// Distance of the poses of a set from a threshold, relative to the margin: regular from one on.
/// With a lateral offset b near the shoulder, x^2 = rho^2 - b^2 is rounded to 1e-5 of itself.
const BEYOND: [f64; 7] = [0.5, 0.99, 1.0 - 1e-4, 1.0 + 1e-4, 1.01, 10.0, 100.0];

/// The largest angle between joint vectors, whole turns not regarded [rad].
fn apart<const N: usize>(q: &[f64; N], other: &[f64; N]) -> f64 {
    q.iter().zip(other).map(|(a, b)| wrap(a - b).abs()).fold(0.0, f64::max)
}

/// The slots computed in lanes; `None` if the pose is not regular or has no solution.
fn by_lanes<const N: usize>(
    robot: &Robot<N>,
    pose: &Pose,
    locked: f64,
) -> Option<RegularAnswer<N>> {
    let mut solutions = robot.unsolved(*pose);
    let regular = robot.solve_in_lanes(&mut solutions, locked);
    regular.then(|| slots(&solutions))
}

fn slots<const N: usize>(solutions: &Solutions<N>) -> RegularAnswer<N> {
    core::array::from_fn(|slot| solutions.slot(slot).map(|found| (found.q, found.status)))
}

fn scalar<const N: usize>(robot: &Robot<N>, pose: Pose, locked: f64) -> Solutions<N> {
    let mut solutions = robot.unsolved(pose);
    robot.solve_scalar(&mut solutions, &FreeChoice::rest(robot.resting(locked))).unwrap();
    solutions
}

/// Joint angles and status of each slot that has a solution.
type RegularAnswer<const N: usize> = [Option<([f64; N], Status)>; 8];

#[derive(Default)]
struct Comparison {
    regular: usize,
    slots: usize,
    /// The largest difference, relative to its bound.
    apart: f64,
}

impl Comparison {
    /// Solve a pose both ways and compare.
    fn take(&mut self, arm: &Arm, pose: Pose, what: &str) {
        let pose = checked_pose(&pose).unwrap();
        let Some(regular) = arm.by_lanes(&pose) else { return };
        self.compare(arm, &pose, (regular, arm.scalar(pose)), what);
    }

    fn compare(
        &mut self,
        arm: &Arm,
        pose: &Pose,
        (regular, scalar): (RegularAnswer<6>, Solutions<6>),
        what: &str,
    ) {
        self.regular += 1;
        assert_eq!(
            regular.map(|slot| slot.map_or(Status::empty(), |(_, status)| status)),
            *scalar.status(),
            "{what}, {pose}"
        );
        for (slot, found) in regular.into_iter().enumerate() {
            let Some(((q, _), scalar)) = found.zip(scalar.slot(slot)) else { continue };
            assert_eq!(scalar.free_joint, None, "{what}");
            // A solution closes to 3e-15 of the arm's lengths and to 1e-14 rad, and to what the
            // digits of an offset round off theta. Two solutions differ by at most twice that in
            // the pose, and in the joints by that over the least singular value.
            let rounded_off =
                f64::EPSILON * arm.offsets.iter().map(|offset| offset.abs()).sum::<f64>();
            let closed = [(3e-15 + rounded_off) * arm.extent, 1e-14 + rounded_off];
            let PoseDifference { position, rotation } = arm.robot.residual(&q, pose);
            assert!(
                position <= closed[0] && rotation <= closed[1],
                "{what}: {position:e} m, {rotation:e} rad"
            );
            let bound =
                2.0 * closed[0].hypot(closed[1]) / arm.robot.singularity(&q).min_singular_value;
            let apart = apart(&q, &scalar.q);
            assert!(
                apart <= bound,
                "{what}: {apart:e} rad apart, bound {bound:e}: {q:?} and {:?}",
                scalar.q
            );
            self.slots += 1;
            self.apart = self.apart.max(apart / bound);
        }
    }
}

/// Arms with and without each offset; between a rotated base and tool; with limits that require a 2
/// pi equivalent.
fn arms() -> Vec<Arm> {
    let abb_2600 = || Robot::<6>::named("IRB 2600-12/1.65").unwrap();
    let opw = OpwParameters::abb(0.15, -0.11, 0.45, 0.6, 0.64, 0.1);
    let lateral = OpwParameters {
        b: 0.05,
        offsets: [0.3, -0.2, -FRAC_PI_2, 0.1, -0.4, 0.5],
        signs: [1, -1, 1, 1, -1, -1],
        ..opw
    };
    let many_turns = OpwParameters { offsets: [50.0, -49.2, 31.4, -3.2, 12.5, 7.0], ..lateral };
    let tool = pose_from_euler_zyx([0.03, -0.02, 0.2], [0.3, -0.7, 1.1]).unwrap();
    let base = pose_from_euler_zyx([2.8, -1.5, 0.3], [-1.9, 0.4, 0.2]).unwrap();
    let limits = [[-7.0, 1.0], [-1.0, 4.5], [-4.7, -0.2], [-9.0, 9.0], [-PI, 0.3], [-0.3, PI]];
    let equal = Robot::from_opw(OpwParameters::abb(0.0, 0.0, 0.19, 0.185, 0.185, 0.045)).unwrap();
    let behind = Robot::from_opw(OpwParameters { a1: -0.1, ..opw }).unwrap();
    let lateral = Robot::from_opw(lateral).unwrap();
    let ur3 = || Robot::<6>::named("UR3").unwrap().with_limits(JointLimits::UNLIMITED);
    let robots = std::vec![
        ("IRB 2600-12/1.65", abb_2600()),
        ("IRB 120-3/0.58", Robot::named("IRB 120-3/0.58").unwrap()),
        ("equal links", equal),
        ("axis 2 behind axis 1", behind),
        ("lateral offset", lateral.clone()),
        ("offsets of many turns", Robot::from_opw(many_turns).unwrap()),
        ("limits with turns", abb_2600().with_limits(JointLimits::new(limits).unwrap())),
        ("tool and base", abb_2600().with_base(&base).unwrap().with_tool(&tool).unwrap()),
        ("lateral, tool and base", lateral.with_base(&base).unwrap().with_tool(&tool).unwrap()),
        ("UR3", ur3()),
        ("UR3, tool and base", ur3().with_base(&base).unwrap().with_tool(&tool).unwrap()),
        ("UR10e", Robot::named("UR10e").unwrap()),
        ("parallel axes, axis 2 off axis 1", parallel_arm(0.1, [0.5, 0.43])),
        ("parallel axes, equal links", parallel_arm(0.0, [0.4, 0.4])),
    ];
    robots.into_iter().map(|(name, robot)| Arm::new(name, robot)).collect()
}

/// An arm with three parallel axes whose angles are zero when upright.
fn parallel_arm(a1: f64, [c2, c3]: [f64; 2]) -> Robot<6> {
    let rows = [
        (0.0, 0.0, 0.3, 0.0),
        (-1.0, a1, 0.0, -1.0),
        (0.0, c2, 0.0, 0.0),
        (0.0, c3, 0.11, 1.0),
        (1.0, 0.0, 0.08, 0.0),
        (-1.0, 0.0, 0.09, 0.0),
    ];
    let rows =
        rows.map(|(alpha, a, d, theta)| DhRow::new(alpha * FRAC_PI_2, a, d, theta * FRAC_PI_2));
    let flange = pose_from_euler_zyx([0.0; 3], [0.0, 0.0, FRAC_PI_2]).unwrap();
    Robot::from_mdh(Mdh { base: Pose::identity(), rows, flange }).unwrap()
}

type Place = fn(&Arm, f64, &mut Rng) -> Pose;

/// The margins by name, and the least fraction of their poses that must be regular: at the edge of
/// reach half of the arms reach with neither shoulder; near the wrist's margin, arms with three
/// parallel axes must be 1.5e-7 d5 / 1e-6, two centimeters, from the shoulder singularity.
const MARGINS: [(&str, Place, f64); 3] = [
    ("wrist", Arm::next_to_the_wrist_margin, 0.9),
    ("shoulder", Arm::next_to_the_shoulder_margin, 0.95),
    ("reach", Arm::next_to_the_edge_of_reach, 0.3),
];

#[test]
#[expect(clippy::cast_precision_loss, reason = "counts")]
#[ignore = "run by itself: cargo test --lib -- --ignored"]
fn lanes_and_scalar_solver_agree() {
    on_each_set(|set| {
        let mut random = Rng::new(5);
        for arm in &arms() {
            let mut all = Comparison::default();
            let mut run_set = |set_name: String, least: f64, make: &mut dyn FnMut() -> Pose| {
                let mut tally = Comparison::default();
                (0..POSES).for_each(|_| tally.take(arm, make(), &set_name));
                let regular = tally.regular as f64 / POSES as f64;
                assert!(
                    if least > 0.0 { regular >= least } else { regular == 0.0 },
                    "{set_name}: {regular} of the poses are regular"
                );
                all = Comparison {
                    regular: all.regular + tally.regular,
                    slots: all.slots + tally.slots,
                    apart: all.apart.max(tally.apart),
                };
            };
            run_set(format!("{}, anywhere", arm.name), 0.95, &mut || arm.anywhere(&mut random));
            for (margin, place, least) in MARGINS {
                for part in BEYOND {
                    let least = if part < 1.0 { 0.0 } else { least };
                    run_set(
                        format!("{}, {part} of the {margin}'s margin", arm.name),
                        least,
                        &mut || place(arm, part, &mut random),
                    );
                }
            }
            let Comparison { regular, slots, apart } = all;
            println!(
                "{:24} {:8} {regular:6} regular poses  {slots:6} slots  worst {apart:.3} of the \
                 bound",
                arm.name,
                set.name()
            );
        }
    });
}

#[test]
#[ignore = "run by itself: cargo test --lib -- --ignored"]
fn no_branch_is_regular_in_lanes_for_an_arm_minute_relative_to_its_end_frames() {
    let base = pose_from_euler_zyx([1e5, -2e5, 0.0], [0.3, 0.0, 0.0]).unwrap();
    let arm = Arm::new(
        "far base",
        Robot::<6>::named("IRB 2600-12/1.65").unwrap().with_base(&base).unwrap(),
    );
    let mut random = Rng::new(6);
    on_each_set(|_| {
        for _ in 0..POSES {
            let pose = arm.anywhere(&mut random);
            assert!(arm.by_lanes(&checked_pose(&pose).unwrap()).is_none());
        }
    });
}

/// Joint vectors over the whole range, some of them near where branches of a structure meet: each
/// joint is, at random, at a quarter turn plus `off`.
fn joints<const N: usize>(random: &mut Rng, off: f64) -> [f64; N] {
    core::array::from_fn(|_| {
        let angle = random.between(-PI, PI);
        if random.between(0.0, 1.0) < 0.2 {
            FRAC_PI_2 * (angle / FRAC_PI_2).round() + off
        } else {
            angle
        }
    })
}

/// The number of regular poses, after both solvers were compared for each.
fn agreeing<const N: usize>(robot: &Robot<N>, reach: f64, random: &mut Rng) -> usize {
    let mut regular_poses = 0;
    for off in [0.0, 1e-8, 9e-7, 1.1e-6, 1e-5, 3e-3, 1e-2, 1.1e-2] {
        for _ in 0..POSES {
            let q: [f64; N] = joints(random, off);
            let (pose, locked) = (robot.fk(&q), q[N - 1]);
            let Some(regular) = by_lanes(robot, &pose, locked) else { continue };
            let scalar = scalar(robot, pose, locked);
            regular_poses += 1;
            assert_eq!(
                regular.map(|slot| slot.map_or(Status::empty(), |(_, status)| status)),
                *scalar.status(),
                "{q:?}"
            );
            for (slot, found) in regular.into_iter().enumerate() {
                let Some(((q, _), scalar)) = found.zip(scalar.slot(slot)) else { continue };
                let PoseDifference { position, rotation } = robot.residual(&q, &pose);
                assert!(
                    position <= 3e-15 * reach && rotation <= 1e-14,
                    "{position:e} m, {rotation:e} rad at {q:?}"
                );
                // As above; for seven joints, the given one counts as fixed.
                let jacobian =
                    robot.jacobian(&q, JacobianFrame::Base).fixed_columns::<6>(0).into_owned();
                let bound = 2.0 * (3e-15 * reach).hypot(1e-14) / jacobian.singular_values()[5];
                let apart = apart(&q, &scalar.q);
                assert!(
                    apart <= bound,
                    "{apart:e} rad apart, bound {bound:e}: {q:?} and {:?}",
                    scalar.q
                );
            }
        }
    }
    regular_poses
}

#[test]
#[ignore = "run by itself: cargo test --lib -- --ignored"]
fn lanes_and_scalar_solver_agree_in_every_structure() {
    let tool = pose_from_euler_zyx([0.03, -0.02, 0.2], [0.3, -0.7, 1.1]).unwrap();
    let base = pose_from_euler_zyx([0.8, -0.5, 0.3], [-1.9, 0.4, 0.2]).unwrap();
    let limits = [[-7.0, 1.0], [-1.0, 4.5], [-4.7, -0.2], [-9.0, 9.0], [-PI, 0.3], [-0.3, PI]];
    on_each_set(|_| {
        let mut random = Rng::new(7);
        for name in ["UR3", "UR10e"] {
            let robot = Robot::<6>::named(name).unwrap();
            let rotated = robot.clone().with_base(&base).unwrap().with_tool(&tool).unwrap();
            for robot in
                [robot.clone(), rotated, robot.with_limits(JointLimits::new(limits).unwrap())]
            {
                let regular = agreeing(&robot, 3.0, &mut random);
                assert!(
                    regular > 2 * POSES,
                    "{name}: {regular} of {} poses are regular",
                    8 * POSES
                );
            }
        }
        for name in ["Panda", "FR3"] {
            let robot = Robot::<7>::named(name).unwrap();
            let rotated = robot.clone().with_base(&base).unwrap().with_tool(&tool).unwrap();
            for robot in [robot, rotated] {
                let regular = agreeing(&robot, 3.0, &mut random);
                assert!(
                    regular > 2 * POSES,
                    "{name}: {regular} of {} poses are regular",
                    8 * POSES
                );
            }
        }
    });
}
