//! Poses at and next to every singularity: each branch is found, nothing is wrong, nothing comes twice.
//!
//! `make hardsets` prints one row a set with more poses; `make test` runs fewer.
#![allow(clippy::unwrap_used, missing_docs)]

use crate::common;

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use crate::common::tally::Tally;
use crate::common::{Rng, asked_set, reach_of};
use nalgebra::Vector3;

use irbkin::{FreeJoint, OpwParameters, Pose, Robot, Solution, Status, thresholds};

const NEAR: [f64; 6] = [0.0, 1e-12, 1e-9, 1e-7, 1e-6, 1e-4];
const BEYOND: [f64; 4] = [1e-12, 9e-10, 1e-6, 1e-3];
/// The elbow angle of a stretched arm below which it is straight to rounding: sqrt(2 rounding of the position / lever), 9e-8 for an IRB 2600.
const STRAIGHT: f64 = 1e-7;
/// How near the joints that a pose determines must be to those that made it [rad].
const FOUND: f64 = 1e-6;

fn poses() -> usize {
    std::env::var("IRBKIN_POSES").ok().map_or(60, |count| count.parse().unwrap())
}

/// An arm with what the sets need to place it.
struct Arm {
    name: &'static str,
    opw: OpwParameters,
    robot: Robot<6>,
}

impl Arm {
    fn new(name: &'static str, opw: OpwParameters) -> Self {
        Self { name, opw, robot: Robot::from_opw(opw).unwrap() }
    }

    fn k(&self) -> f64 {
        self.opw.a2.hypot(self.opw.c3)
    }

    /// Joint angles of OPW angles.
    fn q(&self, theta: [f64; 6]) -> [f64; 6] {
        std::array::from_fn(|i| f64::from(self.opw.signs[i]) * (theta[i] + self.opw.offsets[i]))
    }

    fn theta(&self, q: &[f64; 6]) -> [f64; 6] {
        std::array::from_fn(|i| f64::from(self.opw.signs[i]) * q[i] - self.opw.offsets[i])
    }

    /// theta_3 of an elbow angle.
    fn theta_3(&self, elbow: f64) -> f64 {
        elbow - self.opw.a2.atan2(self.opw.c3)
    }

    /// A theta_2 that puts the wrist centre `x` before axis 1, for an elbow angle; none where it cannot get there.
    fn theta_2(&self, elbow: f64, x: f64, rng: &mut Rng) -> Option<f64> {
        let (along, across) = (self.opw.c2 + self.k() * elbow.cos(), self.k() * elbow.sin());
        let sine = (x - self.opw.a1) / along.hypot(across);
        let phase = across.atan2(along);
        let forward = if rng.unit() < 0.5 { sine.asin() } else { PI - sine.asin() };
        (sine.abs() < 0.99).then_some(forward - phase)
    }
}

/// How a set's poses are made: sines of what is near zero, `None` for anything.
#[derive(Clone, Copy, Default)]
struct Place {
    wrist: Option<f64>,
    shoulder: Option<f64>,
    elbow: Option<f64>,
}

/// A joint vector of the set, in OPW angles.
fn place(arm: &Arm, place: Place, rng: &mut Rng) -> [f64; 6] {
    loop {
        let mut theta: [f64; 6] = std::array::from_fn(|_| rng.between(-PI, PI));
        let half_turn = |rng: &mut Rng| if rng.unit() < 0.5 { 0.0 } else { PI };
        let sign = |rng: &mut Rng| if rng.unit() < 0.5 { -1.0 } else { 1.0 };
        theta[4] = match place.wrist {
            Some(off) => half_turn(rng) + sign(rng) * off,
            None => sign(rng) * rng.between(0.2, 2.9),
        };
        let elbow = match place.elbow {
            Some(off) => half_turn(rng) + sign(rng) * off,
            None => sign(rng) * rng.between(0.2, 2.9),
        };
        theta[2] = arm.theta_3(elbow);
        if let Some(off) = place.shoulder {
            match arm.theta_2(elbow, sign(rng) * off, rng) {
                Some(theta_2) => theta[1] = theta_2,
                None => continue,
            }
        } else if arm.robot.singularity(&arm.q(theta)).distances.unwrap().shoulder < 0.05 {
            continue;
        }
        return theta;
    }
}

fn wrapped(angle: f64) -> f64 {
    (angle - TAU * (angle / TAU).round()).abs()
}

/// How far apart two joint vectors are in what a pose of these singularities determines [rad].
struct Apart {
    /// theta_2 and theta_3; theta_1 unless it is free.
    arm: f64,
    /// theta_5 up to its sign, and theta_4 + theta_6 at theta_5 = 0, theta_4 - theta_6 at 180 deg.
    wrist: f64,
    /// theta_4 and theta_6 each.
    split: f64,
}

impl Apart {
    fn of(arm: &Arm, a: &[f64; 6], b: &[f64; 6], kinds: Status) -> Self {
        let (a, b) = (arm.theta(a), arm.theta(b));
        let off = |i: usize| wrapped(a[i] - b[i]);
        let free_1 = kinds.contains(Status::SHOULDER) && arm.opw.b == 0.0;
        let with_5 = |t: [f64; 6]| if t[4].cos() > 0.0 { t[3] + t[5] } else { t[3] - t[5] };
        let up_to_sign = |t: f64| wrapped(t);
        let wrist = (up_to_sign(a[4]) - up_to_sign(b[4])).abs().max(wrapped(with_5(a) - with_5(b)));
        let silent = free_1 || kinds.contains(Status::WRIST);
        Self {
            arm: off(1).max(off(2)).max(if free_1 { 0.0 } else { off(0) }),
            wrist: if free_1 { 0.0 } else { wrist },
            split: if silent { 0.0 } else { off(3).max(off(4)).max(off(5)) },
        }
    }
}

/// How far the joints of the branch that made a pose may be from those found [rad]: (arm and wrist, for the split of theta_4 and
/// theta_6).
///
/// Next to an elbow limit, and with b != 0 next to the shoulder's tangent plane, twins differ by the square root of rounding, and below the
/// merge threshold one stands for both (docs/accuracy.md, section 4). What turns the forearm turns the split of theta_4 and theta_6 by
/// that over sin theta_5.
fn found_bound(arm: &Arm, place: Place) -> (f64, f64) {
    let reach = reach_of(&arm.robot);
    let (c2, k) = (arm.opw.c2, arm.k());
    let mut position = 8.0 * f64::EPSILON * (1.0 + reach);
    let mut turned = position;
    if let Some(off) = place.shoulder {
        let b = arm.opw.b.abs();
        if b > 0.0 {
            // x^2 = rho^2 - b^2.
            let x = (2.0 * b * position).sqrt().min(2.0 * b * position / off.max(1e-300));
            let merged = (b * thresholds::LATERAL_MERGE).sqrt();
            position += x + if off <= 2.0 * merged { 2.0 * (off + merged) } else { 0.0 };
            turned += position / b;
        } else if off > thresholds::SHOULDER_MERGE {
            turned += position / off;
        } else {
            position += 2.0 * off;
        }
    }
    if let Some(off) = place.elbow {
        let lever = c2 * k / (c2 + k);
        let root = (2.0 * position / lever).sqrt().min(position / (lever * off.max(1e-300)));
        let merged = if off <= 2.0 * STRAIGHT { off + STRAIGHT } else { 0.0 };
        // Folded, the links turn by more than the elbow, by the longest over the shortest distance of the wrist centre.
        let gear = ((c2 + k) / (c2 - k).abs().max(off)).max(2.0);
        turned += (root + merged) * gear;
    }
    let sin_5 = place.wrist.unwrap_or(1.0).max(1e-300);
    (FOUND + turned, FOUND + turned / sin_5)
}

/// Holds the answers for one pose against the joint vector that made it.
fn judge(arm: &Arm, q: &[f64; 6], pose: &Pose, place: Place, allowed: f64, tally: &mut Tally) {
    let reach = reach_of(&arm.robot);
    let solutions: Vec<Solution<6>> = arm.robot.ik(pose).unwrap().iter().copied().collect();
    let (bound, split_bound) = found_bound(arm, place);
    tally.poses += 1;
    tally.solutions += solutions.len();
    tally.found += usize::from(solutions.iter().any(|solution| {
        let apart = Apart::of(arm, &solution.q, q, solution.kinds());
        apart.arm <= bound && apart.wrist <= bound && apart.split <= split_bound
    }));
    for (i, solution) in solutions.iter().enumerate() {
        let residual = arm.robot.residual(&solution.q, pose);
        tally.position = tally.position.max(residual.position);
        tally.rotation = tally.rotation.max(residual.rotation);
        tally.wrong +=
            usize::from(residual.position > allowed + 3e-15 * reach || residual.rotation > 1e-14);
        // The tool stays where the free joint goes, to rounding or the distance from the singularity.
        if let Some(free) = solution.free {
            let moved = arm.robot.with_free(pose, solution, 0.7).unwrap().unwrap();
            let residual = arm.robot.residual(&moved.q, pose);
            let distances = arm.robot.singularity(&solution.q).distances.unwrap();
            let [w2, w4] = {
                let (frames, _) = arm.robot.link_frames(&solution.q);
                [frames[1].translation.vector, frames[3].translation.vector]
            };
            let distance = match free {
                FreeJoint::Base => distances.shoulder,
                // From axis 2 to the wrist centre, in the plane of the arm.
                FreeJoint::Upper => (w4 - w2).norm(),
                FreeJoint::WristSum | FreeJoint::WristDifference => distances.wrist,
                other => unreachable!("{other:?} is no joint that a spherical wrist leaves free"),
            };
            let distance = 2.0 * distance + 1e-14 * (1.0 + reach);
            tally.wrong += usize::from(residual.largest() > allowed + distance);
        }
        let again = |other: &&Solution<6>| {
            // Of the family that q1 is free in, two with the same q1 are two.
            let apart = Apart::of(
                arm,
                &other.q,
                &solution.q,
                (other.kinds() | solution.kinds()) - Status::SHOULDER,
            );
            apart.arm.max(apart.wrist).max(apart.split) < 1e-9
        };
        tally.twice += solutions.iter().skip(i + 1).filter(again).count();
    }
    // The flags of the branch that made the pose. Where q1 is not determined, neither is the singularity of the wrist, and the shoulders
    // that are merged differ in reach by twice their distance from axis 1.
    let alone =
        place.shoulder.is_none_or(|off| arm.opw.b == 0.0 && off > thresholds::SHOULDER_MERGE);
    let flagged = |kind: Status, off: Option<f64>, threshold: f64| {
        off.is_none_or(|off| {
            solutions.iter().any(|s| s.kinds().contains(kind)) || off > 0.5 * threshold
        })
    };
    let wrist_and_elbow = flagged(Status::WRIST, place.wrist, thresholds::WRIST_MERGE_SIN)
        && flagged(Status::ELBOW, place.elbow, 1e-8);
    let flagged = (!alone || wrist_and_elbow)
        && flagged(Status::SHOULDER, place.shoulder, thresholds::SHOULDER_MERGE);
    tally.flags += usize::from(!flagged);
}

fn sets() -> Vec<(String, Place)> {
    let mut sets = Vec::new();
    for off in NEAR {
        let [wrist, shoulder, elbow] = [Some(off); 3];
        sets.push((format!("wrist {off:e}"), Place { wrist, ..Place::default() }));
        sets.push((format!("shoulder {off:e}"), Place { shoulder, ..Place::default() }));
        sets.push((format!("elbow {off:e}"), Place { elbow, ..Place::default() }));
    }
    for first in NEAR {
        for second in NEAR {
            let (a, b) = (Some(first), Some(second));
            sets.push((
                format!("wrist {first:e}, shoulder {second:e}"),
                Place { wrist: a, shoulder: b, elbow: None },
            ));
            sets.push((
                format!("wrist {first:e}, elbow {second:e}"),
                Place { wrist: a, shoulder: None, elbow: b },
            ));
            sets.push((
                format!("shoulder {first:e}, elbow {second:e}"),
                Place { wrist: None, shoulder: a, elbow: b },
            ));
        }
        let all = Some(first);
        sets.push((
            format!("all three {first:e}"),
            Place { wrist: all, shoulder: all, elbow: all },
        ));
    }
    sets
}

/// Stretched arms with the wrist centre moved outwards along the line to it: up to a nanometre beyond reach they get the stretched arm,
/// off by no more than that, and farther out nothing and the right shortfall.
fn run_beyond(arm: &Arm, rng: &mut Rng) -> String {
    let mut report = String::new();
    for beyond in BEYOND {
        let mut tally = Tally::default();
        for _ in 0..poses() {
            // In front of axis 1, where the arm behind has still farther to go.
            let mut theta = place(arm, Place { elbow: Some(0.0), ..Place::default() }, rng);
            theta[2] = arm.theta_3(0.0);
            theta[1] = rng.between(0.1, 1.4);
            let q = arm.q(theta);
            let t1 = theta[0];
            let outward =
                Vector3::new(theta[1].sin() * t1.cos(), theta[1].sin() * t1.sin(), theta[1].cos())
                    * beyond;
            let mut pose = arm.robot.fk(&q);
            pose.translation.vector += outward;
            if beyond <= thresholds::REACH_TOLERANCE {
                judge(
                    arm,
                    &q,
                    &pose,
                    Place { elbow: Some(0.0), ..Place::default() },
                    beyond,
                    &mut tally,
                );
                continue;
            }
            tally.take_missed(&arm.robot.ik(&pose).unwrap(), beyond);
        }
        report += &tally.tell(arm.name, &format!("beyond reach by {beyond:e} m"));
    }
    report
}

fn run(arm: &Arm) -> String {
    let mut rng = Rng::new(7);
    let mut report = run_beyond(arm, &mut rng);
    let mut home = Tally::default();
    for _ in 0..poses() {
        let q = [rng.between(-PI, PI), 0.0, 0.0, rng.between(-PI, PI), 0.0, rng.between(-PI, PI)];
        judge(
            arm,
            &q,
            &arm.robot.fk(&q),
            Place { wrist: Some(0.0), ..Place::default() },
            0.0,
            &mut home,
        );
    }
    report += &home.tell(arm.name, "J2 = J3 = J5 = 0");
    for (name, set) in sets() {
        let mut tally = Tally::default();
        for _ in 0..poses() {
            let q = arm.q(place(arm, set, &mut rng));
            judge(arm, &q, &arm.robot.fk(&q), set, 0.0, &mut tally);
        }
        report += &tally.tell(arm.name, &name);
    }
    report
}

fn check(name: &'static str, opw: OpwParameters) {
    asked_set();
    let report = run(&Arm::new(name, opw));
    assert!(report.is_empty(), "\n{report}");
}

#[test]
fn irb_2600() {
    check("IRB 2600-12/1.65", OpwParameters::abb(0.150, -0.115, 0.445, 0.700, 0.795, 0.085));
}

#[test]
fn irb_120_without_shoulder_offset() {
    check("IRB 120-3/0.58", OpwParameters::abb(0.0, -0.070, 0.290, 0.270, 0.302, 0.072));
}

#[test]
fn kuka_with_signs_and_offsets() {
    let mut offsets = [0.0; 6];
    offsets[1] = -FRAC_PI_2;
    let signs = [-1, 1, 1, -1, 1, -1];
    check(
        "KUKA KR 6 R700",
        OpwParameters {
            a1: 0.025,
            a2: -0.035,
            b: 0.0,
            c1: 0.4,
            c2: 0.315,
            c3: 0.365,
            c4: 0.08,
            offsets,
            signs,
        },
    );
}

#[test]
fn an_arm_with_lateral_offset() {
    let opw = OpwParameters { b: 0.05, ..OpwParameters::abb(0.15, -0.11, 0.45, 0.6, 0.64, 0.1) };
    check("lateral offset 50 mm", opw);
}

#[test]
fn equal_links_that_fold_onto_axis_2() {
    check("equal links", OpwParameters::abb(0.0, 0.0, 0.19, 0.185, 0.185, 0.045));
}
