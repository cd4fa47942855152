//! Laws of `Robot::<7>::ik_nearest`, next to the stretched arm above all: there the angles of joint 7 that reach a pose
//! are an interval narrower than any grid.
//!
//! `IRBKIN_POSES` is the number of poses for each arm and distance; `make hardsets` prints one row an arm with more.
#![allow(clippy::unwrap_used, missing_docs)]

mod common;

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use common::Rng;
use irbkin::{DhRow, JointLimits, Mdh, Pose, Robot};
use nalgebra::Isometry3;

/// Distances of joint 4 from where the arm is stretched [rad].
const OFF: [f64; 9] = [0.0, 1e-9, 1e-7, 1e-5, 1e-4, 1e-3, 3e-3, 1e-2, 0.035];

/// Below this elbow angle the straight arm meets the pose as well [rad]: what answers differ by there.
const STRAIGHT: f64 = 5e-7;

/// What distances in joint space are compared to elsewhere [rad].
const ROUNDING: f64 = 1e-8;

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

    /// Joint angles inside the limits with joint 4 at `off` [rad] from the stretched arm, to either side.
    fn next_to_stretched(&self, off: f64, rng: &mut Rng) -> [f64; 7] {
        loop {
            let mut q = self.anywhere(rng);
            q[3] = self.stretched + if rng.unit() < 0.5 { off } else { -off };
            // Where axis 6 is square to the plane of the arm, joint 7 alone does not move the wrist towards the shoulder.
            if rng.unit() < 0.5 {
                q[4] = 0.0;
            }
            if self.robot.limits().contain(&q) {
                return q;
            }
        }
    }

    /// The joints themselves, joints near them, and any.
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

/// Joint 4 where the place in which axes 5 and 6 meet is farthest from the shoulder: its square is a + b cos(q4 - phase).
fn stretched(robot: &Robot<7>) -> f64 {
    let reach2 = |q4: f64| {
        let (frames, _) = robot.link_frames(&[0.0, 0.0, 0.0, q4, 0.0, 0.0, 0.0]);
        (frames[4].translation.vector - frames[1].translation.vector).norm_squared()
    };
    let [front, side, back] = [0.0, FRAC_PI_2, PI].map(reach2);
    (side - 0.5 * (front + back)).atan2(0.5 * (front - back))
}

fn iiwa_rows() -> [[f64; 4]; 7] {
    [
        [0.0, 0.0, 0.36, 0.0],
        [-90.0, 0.0, 0.0, 0.0],
        [90.0, 0.0, 0.42, 0.0],
        [90.0, 0.0, 0.0, 0.0],
        [-90.0, 0.0, 0.4, 0.0],
        [-90.0, 0.0, 0.0, 0.0],
        [90.0, 0.0, 0.126, 0.0],
    ]
}

fn arms() -> Vec<Arm> {
    let limits = [170.0, 120.0, 170.0, 120.0, 170.0, 120.0, 175.0_f64]
        .map(|limit| [-limit.to_radians(), limit.to_radians()]);
    let free = Arm::of("iiwa without limits", iiwa_rows(), 0.0);
    let limited = free.robot.clone().with_limits(JointLimits::new(limits).unwrap());
    vec![
        Arm::new("iiwa", limited),
        free,
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

/// What became of the poses of an arm.
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
        assert!(arm.robot.limits().contain(&nearest.q));
        self.off = self.off.max(arm.robot.residual(&nearest.q, &pose).largest());
        let farther = distance(&nearest.q, seed) - distance(q, seed);
        self.worst = self.worst.max(farther);
        if farther > slack {
            self.farther += 1;
            self.example = Some((*q, *seed));
        }
    }

    /// Prints the row; returns it where something is amiss.
    fn row(&self, name: &str) -> String {
        let row = format!(
            "{name:40} {:7} asked  refused {}  farther {} (by {:.1e} rad)  residual {:.1e}",
            self.asked, self.refused, self.farther, self.worst, self.off
        );
        println!("{row}");
        // Rounding of a sum of lengths below 2 m, twice.
        let amiss = self.refused + self.farther > 0 || self.off > 2e-14;
        if amiss { format!("{row} {:?}\n", self.example) } else { String::new() }
    }
}

#[test]
fn nearest_is_never_farther_than_the_maker() {
    let mut rng = Rng::new(1);
    let mut amiss = String::new();
    for arm in arms() {
        for off in OFF {
            let mut tally = Tally::default();
            for _ in 0..poses() {
                let q = arm.next_to_stretched(off, &mut rng);
                let slack = if off < 1e-6 { STRAIGHT } else { ROUNDING };
                for seed in arm.seeds(&q, &mut rng) {
                    tally.take(&arm, &q, &seed, slack);
                }
            }
            assert_eq!(tally.asked, 4 * poses());
            amiss += &tally.row(&format!("{} at {off:e}", arm.name));
        }
    }
    assert!(amiss.is_empty(), "\n{amiss}");
}
