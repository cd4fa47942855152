//! Laws of `Robot::<7>::ik_nearest`, especially near the stretched arm: there the angles of joint 7
//! that reach a pose are an interval narrower than any grid.
//!
//! `IRBKIN_POSES` is the number of poses for each arm and distance; `make evidence
//! SUITE=hardsets` prints one row per arm with more.

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::fmt::Write as _;

use crate::common::{self, Rng};
use irbkin::{DhRow, JointLimits, Mdh, Pose, Robot, thresholds};
use nalgebra::Isometry3;

/// Distances of joint 4 from where the arm is stretched [rad].
const OFF: [f64; 9] = [0.0, 1e-9, 1e-7, 1e-5, 1e-4, 1e-3, 3e-3, 1e-2, 0.035];

/// Below this elbow angle the straight arm reaches the pose as well [rad]: answers may differ by
/// that.
const STRAIGHT: f64 = 5e-7;

/// Tolerance of distances in joint space elsewhere [rad].
const ROUNDING: f64 = 1e-8;

/// How far an answer may be off its pose [m, rad]: the precision to which a seed keeps an
/// undetermined joint.
const MEETS: f64 = thresholds::SEEDED_FREE;

const WEIGHTS: [f64; 7] = [1.0; 7];

fn poses() -> usize {
    std::env::var("IRBKIN_POSES").ok().map_or(6, |count| count.parse().unwrap())
}

struct Arm {
    name: &'static str,
    robot: Robot<7>,
    /// Joint 4 of the stretched arm [rad].
    stretched: f64,
}

impl Arm {
    fn new(name: &'static str, robot: Robot<7>) -> Self {
        let stretched = stretched(&robot);
        Self { name, robot, stretched }
    }

    fn of(name: &'static str, rows: [[f64; 4]; 7], flange: f64) -> Self {
        let rows = rows.map(|[alpha, a, d, theta]| DhRow::new(alpha.to_radians(), a, d, theta));
        let mdh = Mdh {
            base: Pose::identity(),
            rows,
            flange: Isometry3::translation(0.0, 0.0, flange).to_matrix_pose(),
        };
        Self::new(name, Robot::from_mdh(mdh).unwrap())
    }

    /// Joint angles inside the limits, or anywhere in a turn.
    fn anywhere(&self, rng: &mut Rng) -> [f64; 7] {
        self.robot.limits().to_array().map(|[low, high]| rng.between(low.max(-PI), high.min(PI)))
    }

    /// Joint angles inside the limits with joint 4 at `off` [rad] from the stretched arm, on either
    /// side.
    fn next_to_stretched(&self, off: f64, rng: &mut Rng) -> [f64; 7] {
        loop {
            let mut q = self.anywhere(rng);
            q[3] = self.stretched + if rng.unit() < 0.5 { off } else { -off };
            // If axis 6 is perpendicular to the plane of the arm, joint 7 alone does not move the
            // wrist towards the shoulder.
            if rng.unit() < 0.5 {
                q[4] = 0.0;
            }
            if self.robot.limits().contains(&q) {
                return q;
            }
        }
    }

    /// The joints themselves, joints near them, and arbitrary ones.
    fn seeds(&self, q: &[f64; 7], rng: &mut Rng) -> [[f64; 7]; 4] {
        let mut near = |noise: f64| q.map(|angle| angle + rng.between(-noise, noise));
        [*q, near(0.1), near(1.0), self.anywhere(rng)]
    }
}

trait ToMatrixPose {
    fn to_matrix_pose(self) -> Pose;
}

impl ToMatrixPose for Isometry3<f64> {
    fn to_matrix_pose(self) -> Pose {
        Pose::from_parts(self.translation, self.rotation.to_rotation_matrix())
    }
}

/// Joint 4 where the intersection of axes 5 and 6 is farthest from the shoulder: the square of that
/// distance is a + b cos(q4 - phase).
fn stretched(robot: &Robot<7>) -> f64 {
    let reach2 = |q4: f64| {
        let (frames, _) = robot.link_frames(&[0.0, 0.0, 0.0, q4, 0.0, 0.0, 0.0]);
        (frames[4].translation.vector - frames[1].translation.vector).norm_squared()
    };
    let [front, side, back] = [0.0, FRAC_PI_2, PI].map(reach2);
    (side - 0.5 * (front + back)).atan2(0.5 * (front - back))
}

fn arms() -> Vec<Arm> {
    vec![
        Arm::new("iiwa", common::iiwa()),
        Arm::of("iiwa without limits", common::IIWA_ROWS, 0.0),
        Arm::new("Panda", Robot::named("Panda").unwrap()),
        Arm::new("FR3", Robot::named("FR3").unwrap()),
        Arm::of(
            "oblique",
            [
                [0.0, 0.0, 0.3, 0.2],
                [90.0, 0.0, 0.0, 0.3],
                [-90.0, 0.0, -0.45, -0.4],
                [90.0, -0.06, 0.0, 0.5],
                [90.0, 0.04, 0.35, -0.1],
                [-90.0, 0.0, 0.05, 0.7],
                [70.0, 0.03, 0.12, 0.6],
            ],
            0.1,
        ),
        Arm::of(
            "equal links",
            [
                [0.0, 0.0, 0.3, 0.0],
                [-90.0, 0.0, 0.0, 0.0],
                [90.0, 0.0, 0.4, 0.0],
                [90.0, 0.05, 0.0, 0.0],
                [-90.0, -0.05, 0.4, 0.0],
                [90.0, 0.0, 0.0, 0.0],
                [90.0, 0.08, 0.0, 0.0],
            ],
            0.1,
        ),
    ]
}

fn distance(a: &[f64; 7], b: &[f64; 7]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

/// The results for the poses of an arm.
#[derive(Default)]
struct Tally {
    asked: usize,
    refused: usize,
    farther: usize,
    worst: f64,
    off: f64,
    example: Option<([f64; 7], [f64; 7])>,
}

impl Tally {
    /// Counts the answer for joints `q` and a seed.
    fn take(&mut self, arm: &Arm, q: &[f64; 7], seed: &[f64; 7], slack: f64) {
        let pose = arm.robot.fk(q);
        self.asked += 1;
        let Ok(nearest) = arm.robot.ik_nearest(&pose, seed, &WEIGHTS) else {
            self.refused += 1;
            self.example = Some((*q, *seed));
            return;
        };
        assert!(arm.robot.limits().contains(&nearest.q));
        self.off = self.off.max(arm.robot.residual(&nearest.q, &pose).largest());
        let farther = distance(&nearest.q, seed) - distance(q, seed);
        self.worst = self.worst.max(farther);
        if farther > slack {
            self.farther += 1;
            self.example = Some((*q, *seed));
        }
    }

    /// Prints the row; returns it if a result is incorrect.
    fn row(&self, name: &str) -> String {
        let row = format!(
            "{name:40} {:7} asked  refused {}  farther {} (by {:.1e} rad)  residual {:.1e}",
            self.asked, self.refused, self.farther, self.worst, self.off
        );
        println!("{row}");
        let amiss = self.refused + self.farther > 0 || self.off > MEETS;
        if amiss { format!("{row} {:?}\n", self.example) } else { String::new() }
    }
}

/// Runs each distance of `off` and each arm: `place` puts joints that far from a singularity.
fn sweep(arms: &[Arm], off: &[f64], seed: u64, place: impl Fn(&Arm, f64, &mut Rng) -> [f64; 7]) {
    let (mut rng, mut amiss) = (Rng::new(seed), String::new());
    for arm in arms {
        for &off in off {
            let mut tally = Tally::default();
            for _ in 0..poses() {
                let q = place(arm, off, &mut rng);
                let slack = if off < 1e-6 { STRAIGHT } else { ROUNDING };
                for seed in arm.seeds(&q, &mut rng) {
                    tally.take(arm, &q, &seed, slack);
                }
            }
            assert_eq!(tally.asked, 4 * poses());
            amiss += &tally.row(&format!("{} at {off:e}", arm.name));
        }
    }
    assert!(amiss.is_empty(), "\n{amiss}");
}

#[test]
fn near_the_stretched_arm_nearest_is_never_farther_than_the_known_joints() {
    sweep(&arms(), &OFF, 1, Arm::next_to_stretched);
}

#[test]
fn at_random_poses_nearest_is_never_farther_than_the_known_joints() {
    sweep(&arms(), &[1.0; 5], 2, |arm, _, rng| arm.anywhere(rng));
}

/// Joints, from 1, that bring an iiwa to a singularity of all seven, and their angles there [rad].
const PLACES: [(&str, &[(usize, f64)]); 8] = [
    ("stretched, axis 7 along", &[(4, 0.0), (6, 0.0)]),
    ("stretched, axis 1 along", &[(4, 0.0), (2, 0.0)]),
    ("candle", &[(2, 0.0), (4, 0.0), (6, 0.0)]),
    ("shoulder", &[(2, 0.0), (3, FRAC_PI_2)]),
    ("wrist", &[(5, FRAC_PI_2), (6, 0.0)]),
    ("wrist, the other way", &[(5, -FRAC_PI_2), (6, 0.0)]),
    ("shoulder and wrist", &[(2, 0.0), (6, 0.0)]),
    ("shoulder and wrist, twice", &[(2, 0.0), (3, -FRAC_PI_2), (5, FRAC_PI_2), (6, 0.0)]),
];

/// Near a second singularity the uncertainty of the stretched arm exceeds the length of the curve,
/// from 1e-9 to 1e-5 rad off.
const OFF_STRETCHED_PAIRS: [f64; 6] = [0.0, 1e-4, 1e-3, 3e-3, 1e-2, 0.035];

#[test]
fn at_pairs_of_singularities_nearest_is_never_farther_than_the_known_joints() {
    let arms = arms();
    for (name, place) in PLACES {
        println!("{name}");
        let stretched = place.iter().any(|(joint, _)| *joint == 4);
        let off: &[f64] = if stretched { &OFF_STRETCHED_PAIRS } else { &OFF };
        sweep(&arms[1..2], off, 3, |arm, off, rng| {
            let mut q = arm.anywhere(rng);
            for (joint, angle) in place {
                q[joint - 1] = angle + rng.between(-off, off);
            }
            q
        });
    }
}

/// Joint 2 where axis 3 is in line with axis 1: their cosine is that of q2 - phase.
fn in_line(robot: &Robot<7>) -> f64 {
    let cosine = |q2: f64| {
        let (frames, _) = robot.link_frames(&[0.0, q2, 0.0, 0.0, 0.0, 0.0, 0.0]);
        frames[0].rotation.matrix().column(2).dot(&frames[2].rotation.matrix().column(2))
    };
    cosine(FRAC_PI_2).atan2(cosine(0.0))
}

/// A circle of solutions has one angle of joint 7 there, which no sample meets; next to it the
/// circle is a part of the curve, as narrow as that.
#[test]
fn with_axes_1_and_3_in_line_nearest_is_never_farther_than_the_known_joints() {
    let off = [0.0, 1e-12, 1e-9, 1e-7, 1e-5, 1e-4, 1e-3];
    sweep(&arms(), &off, 9, |arm, off, rng| {
        let mut q = arm.anywhere(rng);
        q[1] = in_line(&arm.robot) + rng.between(-off, off);
        q
    });
}

/// Joints [deg] of a YuMi that bring axes 1, 3 and 5 into one line or nearly so: with any joint 7
/// the other six move by themselves, and what reaches the pose is a surface.
const ON_A_SURFACE: [[f64; 7]; 9] = [
    [0.0, 0.0, 0.0, -90.0, 0.0, 0.0, 0.0],
    [0.0, 0.0, 0.0, -90.0, 20.0, 0.0, 0.0],
    [0.0, 0.0, 0.0, -90.0, -90.0, 0.0, 0.0],
    [0.0, 0.0, 90.0, -90.0, 0.0, 0.0, 90.0],
    [0.0, 0.0, 168.5, -90.0, -90.0, 0.0, -171.887],
    [0.0, 0.0, 20.0, -90.0, 30.0, 0.0, 40.0],
    [30.0, 0.0, 20.0, -90.0, 30.0, 0.0, 40.0],
    [0.0, 0.0, 0.0, -89.9999, 0.0, 0.0, 0.0],
    [0.0, 0.0, 0.0, -89.9, 0.0, 0.0, 0.0],
];

/// The search ends, too: refined without a bound, it would take minutes for each pose.
#[test]
fn on_a_surface_of_solutions_nearest_is_never_farther_than_the_known_joints() {
    let arm = Arm::new("YuMi", Robot::named("IRB 14050").unwrap());
    let (mut rng, mut tally) = (Rng::new(8), Tally::default());
    for degrees in ON_A_SURFACE {
        let q = degrees.map(f64::to_radians);
        tally.take(&arm, &q, &q.map(|angle| angle + 0.02), ROUNDING);
    }
    // Joint 6 off the line leaves the surface at one angle of joint 7 alone.
    for pose in 0..4 * poses() {
        let mut eighth = |most: f64| FRAC_PI_2 / 2.0 * (rng.between(-most, most)).round();
        let (q1, q3, q5, q6, q7) =
            (eighth(3.4), eighth(3.4), eighth(5.4), eighth(2.4), eighth(4.4));
        let q6 = if pose % 2 == 0 { 0.0 } else { q6 };
        let q = [q1, 0.0, q3, -FRAC_PI_2, q5, q6, q7];
        let seed = q.map(|angle| angle + rng.between(-0.1, 0.1));
        tally.take(&arm, &q, &seed, ROUNDING);
    }
    assert_eq!(tally.asked, ON_A_SURFACE.len() + 4 * poses());
    let row = tally.row("YuMi on a surface");
    assert!(row.is_empty(), "\n{row}");
}

/// Limits that no member of the surface is inside: the search ends without an answer.
#[test]
fn a_surface_of_solutions_outside_the_limits_ends_the_search() {
    let yumi = Robot::<7>::named("IRB 14050").unwrap();
    let q = [0.0, 0.0, 0.0, -FRAC_PI_2, 0.0, 0.0, 0.0];
    let mut limits = yumi.limits().to_array();
    limits[1] = [0.35, 0.5];
    let narrow = yumi.with_limits(JointLimits::new(limits).unwrap());
    let error = narrow.ik_nearest(&narrow.fk(&q), &q, &WEIGHTS).unwrap_err();
    assert!(matches!(error, irbkin::Error::Unreachable(_)), "{error}");
}

/// Where the curve of self-motion nearly crosses itself, each of its branches has a nearest point.
/// The second one is past a bend that a step of the descent skips.
#[test]
fn both_branches_of_a_near_crossing_are_searched() {
    let arm = &arms()[1];
    let cases = [
        (
            [
                -1.701_057_3,
                0.534_328_5,
                0.659_828_6,
                -2.673_960_7,
                1.570_802_4,
                8.536_1e-5,
                -1.845_314_4,
            ],
            [
                -1.767_254_9,
                0.455_184_3,
                0.653_047_7,
                -2.646_383_1,
                1.477_471_3,
                0.057_571_1,
                -1.937_957_1,
            ],
        ),
        (
            [
                0.708_145_3,
                -2.471_711_7,
                1.609_012_3,
                -2.036_978_4,
                1.544_926_7,
                -0.004_272_8,
                -0.195_416,
            ],
            [
                0.662_627_1,
                -2.443_563_1,
                1.576_481_7,
                -2.065_326_5,
                1.477_237_8,
                0.059_216_3,
                -0.293_227_2,
            ],
        ),
    ];
    for (q, seed) in cases {
        let pose = arm.robot.fk(&q);
        let nearest = arm.robot.ik_nearest(&pose, &seed, &WEIGHTS).unwrap();
        assert!(arm.robot.residual(&nearest.q, &pose).largest() <= MEETS);
        let farther = distance(&nearest.q, &seed) - distance(&q, &seed);
        assert!(farther <= 0.0, "{farther:e} {nearest:?}");
    }
}

/// The pose of joints summed in another way than the robot does: both are a rounding off.
fn other_rounding(robot: &Robot<7>, q: &[f64; 7]) -> Pose {
    let turned = Pose::rotation(nalgebra::Vector3::new(0.3, -0.2, 0.5));
    let moved = robot.clone().with_base(&turned).unwrap();
    turned.inverse() * moved.fk(q)
}

#[test]
fn the_seed_of_a_pose_is_returned() {
    let (mut rng, mut asked) = (Rng::new(4), 0);
    for arm in arms() {
        for off in OFF {
            for _ in 0..poses() {
                let mut q = arm.next_to_stretched(off, &mut rng);
                if arm.name.starts_with("iiwa") && rng.unit() < 0.3 {
                    (q[1], q[5]) = (0.0, 0.0);
                }
                for pose in [arm.robot.fk(&q), other_rounding(&arm.robot, &q)] {
                    let nearest = arm.robot.ik_nearest(&pose, &q, &WEIGHTS).unwrap();
                    let moved = distance(&nearest.q, &q);
                    assert!(moved <= 1e-9, "{} at {off:e}: {moved:e} {q:?}", arm.name);
                    asked += 1;
                }
            }
        }
    }
    assert_eq!(asked, 6 * OFF.len() * poses() * 2);
}

#[test]
fn nearest_is_never_farther_than_a_solution_with_any_joint_7() {
    let (mut rng, mut compared) = (Rng::new(6), 0);
    for arm in arms() {
        for off in OFF.into_iter().chain([1.0]) {
            for _ in 0..poses() {
                let q = arm.next_to_stretched(off.min(0.2), &mut rng);
                let (pose, seed) = (arm.robot.fk(&q), arm.anywhere(&mut rng));
                let nearest = arm.robot.ik_nearest(&pose, &seed, &WEIGHTS).unwrap();
                let slack = if off < 1e-6 { STRAIGHT } else { ROUNDING };
                for spread in [off, off, 0.1, 1.0, 3.0, 3.0] {
                    let solutions =
                        arm.robot.ik(&pose, q[6] + rng.between(-spread, spread)).unwrap();
                    let exact = solutions.filter(|other| {
                        other.is_within_limits()
                            && arm.robot.residual(&other.q, &pose).largest() < 1e-14
                    });
                    let Ok(other) = exact.nearest(&seed, &WEIGHTS) else { continue };
                    compared += 1;
                    let farther = distance(&nearest.q, &seed) - distance(&other.q, &seed);
                    assert!(farther <= slack, "{} {off:e}: {farther:e} {q:?} {seed:?}", arm.name);
                }
            }
        }
    }
    assert!(compared > 60 * poses(), "{compared}");
}

#[test]
fn smooth_paths_through_the_stretched_arm_have_no_break() {
    let (mut rng, mut steps, mut worst) = (Rng::new(7), 0, 0.0_f64);
    for arm in arms() {
        for path in 0..2 * poses() {
            let mut middle = arm.next_to_stretched(0.0, &mut rng);
            // Room inside the limits for the arm's own motion.
            for (angle, [low, high]) in middle.iter_mut().zip(arm.robot.limits().to_array()) {
                *angle = angle.clamp(low.max(-9.0) + 0.35, high.min(9.0) - 0.35);
            }
            middle[3] = arm.stretched;
            let mut speed = [0.0; 7].map(|_: f64| rng.between(-0.01, 0.01));
            speed[3] = 0.01;
            // Exactly through, or past it by less than a step.
            let past = if path % 2 == 0 { 0.0 } else { rng.unit() };
            let joints = |step: i32| -> [f64; 7] {
                std::array::from_fn(|i| middle[i] + speed[i] * (f64::from(step) + past))
            };
            let (mut before, mut made_before) = (joints(-30), joints(-30));
            for step in -29..=30 {
                let made = joints(step);
                let pose = arm.robot.fk(&made);
                let next = arm.robot.ik_nearest(&pose, &before, &WEIGHTS);
                let next = next.unwrap_or_else(|e| panic!("{} {step}: {e} {made:?}", arm.name)).q;
                let farther = distance(&next, &before) - distance(&made, &before);
                assert!(farther <= STRAIGHT, "{} {step}: {farther:e} {made:?}", arm.name);
                // Where the curve shrinks to a point, the drift along it returns; at a limit it may
                // jump.
                let regular = middle[1].sin().abs() > 0.4 && middle[5].sin().abs() > 0.4;
                if arm.name == "iiwa without limits" && regular {
                    worst = worst.max(distance(&next, &before) / distance(&made, &made_before));
                }
                (before, made_before) = (next, made);
                steps += 1;
            }
        }
    }
    println!("{steps} steps, the largest {worst:.3} times that of the joints");
    assert!(worst < 5.0, "{worst}");
    assert_eq!(steps, 6 * 2 * poses() * 60);
}

/// Folded links of equal length, with offsets: the shoulder reaches the intersection of axes 5 and
/// 6.
fn folding() -> Arm {
    Arm::of(
        "folding",
        [
            [0.0, 0.0, 0.333, 0.0],
            [-90.0, 0.0, 0.0, 0.0],
            [90.0, 0.0, 0.3, 0.0],
            [90.0, 0.08, 0.0, 0.0],
            [-90.0, -0.08, 0.3, 0.0],
            [90.0, 0.0, 0.0, 0.0],
            [90.0, 0.088, 0.0, 0.0],
        ],
        0.107,
    )
}

/// Largest difference of two joint vectors, modulo 2 pi [rad].
fn apart(a: &[f64; 7], b: &[f64; 7]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b - TAU * ((a - b) / TAU).round()).abs()).fold(0.0, f64::max)
}

#[test]
fn the_folded_arm_has_no_duplicates() {
    let arm = folding();
    let folded: f64 = 2.620_387_870_095_105_8;
    let (mut rng, mut pairs) = (Rng::new(5), 0);
    let ulp = folded.next_up() - folded;
    let mut amiss = String::new();
    for off in [0.0, ulp, 2.0 * ulp, 4.0 * ulp, 1e-14, 1e-13, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7]
    {
        let mut twice = 0;
        for pose in 0..50 * poses() {
            let mut q = arm.anywhere(&mut rng);
            q[3] = if pose % 2 == 0 { folded + off } else { folded - off };
            let solutions = arm.robot.ik(&arm.robot.fk(&q), q[6]).unwrap();
            let found: Vec<_> = solutions.iter().collect();
            assert!(!found.is_empty(), "{q:?}");
            let pose = arm.robot.fk(&q);
            for solution in &found {
                assert!(arm.robot.residual(&solution.q, &pose).largest() <= 2e-14, "{q:?}");
            }
            for (i, a) in found.iter().enumerate() {
                for b in &found[..i] {
                    pairs += 1;
                    let same = apart(&a.q, &b.q) < 1e-10;
                    if same && twice == 0 {
                        println!("{off:e} {a:?} {b:?}");
                    }
                    twice += usize::from(same);
                }
            }
        }
        println!("folded {off:e}: {twice} twice");
        if twice > 0 {
            writeln!(amiss, "{twice} twice at {off:e}").unwrap();
        }
    }
    assert!(amiss.is_empty(), "{amiss}");
    assert!(pairs > 1000, "{pairs}");
}
