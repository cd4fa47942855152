//! The lanes and the careful solve say the same of every pose that the lanes take, up to where they take none.

use core::f64::consts::{FRAC_PI_2, PI, TAU};
use std::{format, println, string::String, vec::Vec};

use super::*;
use crate::kinematics::pose::{pose_from_euler_zyx, translation_z};
use crate::kinematics::robot::Definition;
use crate::kinematics::spherical_wrist::{OpwParameters, Single};
use crate::kinematics::thresholds::{PLAIN_REACH, PLAIN_SHOULDER, PLAIN_WRIST_SIN, REACH_TOLERANCE, SHOULDER_MERGE};
use crate::kinematics::{JointLimits, PoseError};
use crate::lanes::on_each_set;

/// Poses of each set.
const POSES: usize = 300;

/// Where the poses of a set stand, as a part of a margin: plain from one on. With a lateral offset b next to the shoulder, x^2 = rho^2 - b^2
/// is rounded to 1e-5 of itself.
const BEYOND: [f64; 7] = [0.5, 0.99, 1.0 - 1e-4, 1.0 + 1e-4, 1.01, 10.0, 100.0];

/// Random numbers (splitmix64).
struct Random(u64);

impl Random {
    #[expect(clippy::cast_precision_loss, reason = "53 bits")]
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        low + (high - low) * ((mixed ^ (mixed >> 31)) >> 11) as f64 / 2.0_f64.powi(53)
    }

    fn sign(&mut self) -> f64 {
        if self.between(-1.0, 1.0) < 0.0 { -1.0 } else { 1.0 }
    }

    fn angle(&mut self) -> f64 {
        self.between(-PI, PI)
    }
}

/// An arm, with what the margins are made of.
struct Arm {
    name: &'static str,
    robot: Robot<6>,
    opw: OpwParameters,
    k: f64,
    extent: f64,
}

impl Arm {
    fn new(name: &'static str, robot: Robot<6>) -> Self {
        let Definition::Opw(opw) = *robot.definition() else { unreachable!("every arm here is built from its parameters") };
        let k = opw.a2.hypot(opw.c3);
        let ends = robot.base().translation.vector.norm() + robot.tool().translation.vector.norm();
        let extent = opw.a1.abs() + opw.b.abs() + opw.c1 + opw.c2 + k + opw.c4 + ends;
        Self { name, robot, opw, k, extent }
    }

    /// The pose of angles theta.
    fn at(&self, theta: [f64; 6]) -> Pose {
        self.robot.fk(&core::array::from_fn(|i| f64::from(self.opw.signs[i]) * (theta[i] + self.opw.offsets[i])))
    }

    /// A pose, turned at random, with its wrist centre `x` along the plane of the arm that faces it and `z` above the shoulder.
    fn with_wrist_centre(&self, x: f64, z: f64, random: &mut Random) -> Pose {
        let heading = pose_from_euler_zyx([0.0; 3], [random.angle(), 0.0, 0.0]).unwrap();
        let wrist = pose_from_euler_zyx([x, self.opw.b, self.opw.c1 + z], [random.angle(), random.angle(), random.angle()]).unwrap();
        self.robot.base() * heading * wrist * translation_z(self.opw.c4) * self.robot.tool()
    }

    fn anywhere(&self, random: &mut Random) -> Pose {
        self.at([(); 6].map(|()| random.angle()))
    }

    fn next_to_the_wrist_margin(&self, part: f64, random: &mut Random) -> Pose {
        let off = (part * PLAIN_WRIST_SIN).asin();
        let theta_5 = random.sign() * if random.sign() > 0.0 { off } else { PI - off };
        self.at([random.angle(), random.angle(), random.angle(), random.angle(), theta_5, random.angle()])
    }

    fn next_to_the_shoulder_margin(&self, part: f64, random: &mut Random) -> Pose {
        let x = part * (PLAIN_SHOULDER * self.extent).max(10.0 * SHOULDER_MERGE);
        // Somewhere between folded and stretched, for both shoulders.
        let [shortest, longest] = [(self.opw.c2 - self.k).abs() + 0.02, self.opw.c2 + self.k - 0.02];
        let across = self.opw.a1.abs() + x;
        let (least, most) = ((shortest * shortest - across * across).max(0.0).sqrt(), (longest * longest - across * across).sqrt());
        self.with_wrist_centre(x, random.sign() * random.between(least, most), random)
    }

    /// Inside or outside the edge of reach, stretched or folded, of either shoulder.
    fn next_to_the_edge_of_reach(&self, part: f64, random: &mut Random) -> Pose {
        let (c2, k) = (self.opw.c2, self.k);
        let m2 = random.sign() * part * 2.0 * (PLAIN_REACH * self.extent).max(10.0 * REACH_TOLERANCE) * self.extent * c2 * k;
        let (longest2, shortest2) = ((c2 + k).powi(2), (c2 - k).powi(2));
        let middle = c2 * c2 + k * k;
        // 4 m^2 = (longest^2 - r^2) (r^2 - shortest^2), a parabola over r^2 with its vertex at `middle`.
        let half = ((longest2 - middle) * (middle - shortest2) - 4.0 * m2).sqrt();
        let folded = middle - half;
        let r = if random.sign() > 0.0 || folded <= 0.0 { middle + half } else { folded }.sqrt();
        loop {
            let (sin, cos) = random.angle().sin_cos();
            let x = self.opw.a1 + r * sin;
            if x.abs() > 20.0 * PLAIN_SHOULDER * self.extent {
                return self.with_wrist_centre(x.abs(), r * cos, random);
            }
        }
    }

    /// The slots by the lanes; `None` where the pose is not plain or has no solution.
    fn by_lanes(&self, pose: &Pose) -> Option<PlainAnswer> {
        let plain = run(Single { solver: self.robot.wrist_solver().unwrap(), pose })?;
        Some(core::array::from_fn(|slot| plain.slot(slot).map(|(q, status)| (q, Status::from_bits_retain(status)))))
    }

    fn carefully(&self, pose: Pose) -> Solutions<6> {
        let mut solutions = self.robot.unsolved(pose);
        let free = FreeChoice::rest(self.robot.limits().rest());
        self.robot.solve_carefully(&mut solutions, &free).unwrap();
        solutions
    }
}

/// Joint angles and status of each slot that has a solution.
type PlainAnswer = [Option<([f64; 6], Status)>; SLOTS];

#[derive(Default)]
struct Tally {
    plain: usize,
    slots: usize,
    /// The largest difference, as a part of its bound.
    apart: f64,
}

impl Tally {
    /// Solves a pose both ways.
    fn take(&mut self, arm: &Arm, pose: Pose, what: &str) {
        let pose = checked_pose(&pose).unwrap();
        let Some(plain) = arm.by_lanes(&pose) else { return };
        let careful = arm.carefully(pose);
        self.plain += 1;
        assert_eq!(plain.map(|slot| slot.map_or(Status::empty(), |(_, status)| status)), careful.status(), "{what}, {pose}");
        for (slot, solution) in plain.into_iter().zip(&careful.slots) {
            let Some(((q, _), careful)) = slot.zip(solution.as_ref()) else { continue };
            assert_eq!(careful.free, None, "{what}");
            // A solution closes to 3e-15 of the arm's lengths and to 1e-14 rad, and to what an offset's digits round off theta; so two are
            // apart by twice that at most, in the pose, and in the joints by that over the least singular value.
            let rounded_off = f64::EPSILON * arm.opw.offsets.iter().map(|offset| offset.abs()).sum::<f64>();
            let closed = [(3e-15 + rounded_off) * arm.extent, 1e-14 + rounded_off];
            let PoseError { position, rotation } = arm.robot.residual(&q, &pose);
            assert!(position <= closed[0] && rotation <= closed[1], "{what}: {position:e} m, {rotation:e} rad");
            let bound = 2.0 * closed[0].hypot(closed[1]) / arm.robot.singularity(&q).min_singular_value;
            let apart = q.iter().zip(&careful.q).map(|(a, b)| (a - b - TAU * ((a - b) / TAU).round()).abs()).fold(0.0, f64::max);
            assert!(apart <= bound, "{what}: {apart:e} rad apart, bound {bound:e}: {q:?} and {:?}", careful.q);
            self.slots += 1;
            self.apart = self.apart.max(apart / bound);
        }
    }
}

/// Arms with and without each offset; between a turned base and tool; with limits that ask for a full turn.
fn arms() -> Vec<Arm> {
    let abb_2600 = || Robot::<6>::named("IRB 2600-12/1.65").unwrap();
    let opw = OpwParameters::abb(0.15, -0.11, 0.45, 0.6, 0.64, 0.1);
    let lateral = OpwParameters { b: 0.05, offsets: [0.3, -0.2, -FRAC_PI_2, 0.1, -0.4, 0.5], signs: [1, -1, 1, 1, -1, -1], ..opw };
    let many_turns = OpwParameters { offsets: [50.0, -49.2, 31.4, -3.2, 12.5, 7.0], ..lateral };
    let tool = pose_from_euler_zyx([0.03, -0.02, 0.2], [0.3, -0.7, 1.1]).unwrap();
    let base = pose_from_euler_zyx([2.8, -1.5, 0.3], [-1.9, 0.4, 0.2]).unwrap();
    let limits = [[-7.0, 1.0], [-1.0, 4.5], [-4.7, -0.2], [-9.0, 9.0], [-PI, 0.3], [-0.3, PI]];
    let equal = Robot::from_opw(OpwParameters::abb(0.0, 0.0, 0.19, 0.185, 0.185, 0.045)).unwrap();
    let behind = Robot::from_opw(OpwParameters { a1: -0.1, ..opw }).unwrap();
    let lateral = Robot::from_opw(lateral).unwrap();
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
    ];
    robots.into_iter().map(|(name, robot)| Arm::new(name, robot)).collect()
}

type Place = fn(&Arm, f64, &mut Random) -> Pose;

/// The margins by name, and the least part of their poses that must be plain: at the edge of reach, half of the arms reach with neither
/// shoulder.
const MARGINS: [(&str, Place, f64); 3] = [
    ("wrist", Arm::next_to_the_wrist_margin, 0.95),
    ("shoulder", Arm::next_to_the_shoulder_margin, 0.95),
    ("reach", Arm::next_to_the_edge_of_reach, 0.3),
];

#[test]
#[expect(clippy::cast_precision_loss, reason = "counts")]
fn plain_and_careful_agree() {
    on_each_set(|set| {
        let mut random = Random(5);
        for arm in &arms() {
            let mut all = Tally::default();
            let mut run_set = |set_name: String, least: f64, make: &mut dyn FnMut() -> Pose| {
                let mut tally = Tally::default();
                (0..POSES).for_each(|_| tally.take(arm, make(), &set_name));
                let plain = tally.plain as f64 / POSES as f64;
                assert!(if least > 0.0 { plain >= least } else { plain == 0.0 }, "{set_name}: {plain} of the poses are plain");
                all = Tally { plain: all.plain + tally.plain, slots: all.slots + tally.slots, apart: all.apart.max(tally.apart) };
            };
            run_set(format!("{}, anywhere", arm.name), 0.95, &mut || arm.anywhere(&mut random));
            for (margin, place, least) in MARGINS {
                for part in BEYOND {
                    let least = if part < 1.0 { 0.0 } else { least };
                    run_set(format!("{}, {part} of the {margin}'s margin", arm.name), least, &mut || place(arm, part, &mut random));
                }
            }
            let Tally { plain, slots, apart } = all;
            println!("{:24} {:8} {plain:6} plain poses  {slots:6} slots  worst {apart:.3} of the bound", arm.name, set.name());
        }
    });
}

#[test]
fn in_the_lanes_no_arm_is_plain_that_is_minute_in_its_surroundings() {
    let base = pose_from_euler_zyx([1e5, -2e5, 0.0], [0.3, 0.0, 0.0]).unwrap();
    let arm = Arm::new("far base", Robot::<6>::named("IRB 2600-12/1.65").unwrap().with_base(&base).unwrap());
    let mut random = Random(6);
    on_each_set(|_| {
        for _ in 0..POSES {
            let pose = arm.anywhere(&mut random);
            assert!(arm.by_lanes(&checked_pose(&pose).unwrap()).is_none());
        }
    });
}
