//! The resultant and the branches against forward kinematics, without a root finder.

use core::f64::consts::{PI, TAU};
use std::vec::Vec;

use super::branch::{SIDES, SinCos, branch_at};
use super::geometry::OffsetWrist;
use super::measure::{PATTERN, measure};
use super::resultant::{Hand, samples};
use super::seeds::{Seeds, seeds};
use crate::kinematics::chain::dh::{DhRow, Mdh};
use crate::kinematics::pose::Pose;
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::trigonometric::SAMPLES;
use crate::lanes::{Column, LANES};

/// Rows of alpha [deg], a [m], d [m], theta [deg].
fn arm(rows: [[f64; 4]; 6]) -> OffsetWrist {
    let rows =
        rows.map(|[alpha, a, d, theta]| DhRow::new(alpha.to_radians(), a, d, theta.to_radians()));
    let mdh = Mdh { base: Pose::identity(), rows, flange: Pose::identity() };
    measure(&PATTERN.square_up(&mdh).unwrap()).unwrap()
}

fn arms() -> Vec<(&'static str, OffsetWrist)> {
    [
        (
            "GoFa 5",
            [
                [0.0, 0.0, 0.265, 0.0],
                [-90.0, 0.0, 0.0, -90.0],
                [0.0, 0.444, 0.0, 0.0],
                [-90.0, 0.11, 0.47, 0.0],
                [90.0, 0.0, 0.0, 0.0],
                [-90.0, 0.08, 0.101, 180.0],
            ],
        ),
        (
            "GoFa 10",
            [
                [0.0, 0.0, 0.4, 0.0],
                [-90.0, 0.15, 0.0, -90.0],
                [0.0, 0.707, 0.0, 0.0],
                [-90.0, 0.11, 0.637, 0.0],
                [90.0, 0.0, 0.0, 0.0],
                [-90.0, 0.08, 0.101, 180.0],
            ],
        ),
        (
            "CRX-10iA/L",
            [
                [0.0, 0.0, 0.245, 0.0],
                [-90.0, 0.0, 0.0, -90.0],
                [0.0, 0.71, 0.0, 0.0],
                [-90.0, 0.0, 0.54, 0.0],
                [90.0, 0.0, 0.15, 0.0],
                [-90.0, 0.0, 0.16, 180.0],
            ],
        ),
        (
            "JACO2",
            [
                [0.0, 0.0, 0.2755, 0.0],
                [90.0, 0.0, 0.0, 0.0],
                [180.0, 0.41, 0.0, 0.0],
                [90.0, 0.0, -0.2073, 0.0],
                [60.0, 0.0, -0.0741, 0.0],
                [60.0, 0.0, -0.16, 0.0],
            ],
        ),
        (
            "JACO2 b",
            [
                [0.0, 0.0, 0.2755, 0.0],
                [90.0, 0.0, 0.0, 0.0],
                [180.0, 0.41, 0.0, 0.0],
                [90.0, 0.0, -0.2073, 0.0],
                [60.0, 0.0, -0.0741, 0.0],
                [60.0, 0.0, -0.16, 0.0],
            ]
            .map(|row: [f64; 4]| if row[1] == 0.41 { [180.0, 0.41, 0.0098, 0.0] } else { row }),
        ),
        (
            "xArm6",
            [
                [0.0, 0.0, 0.267, 0.0],
                [-90.0, 0.0, 0.0, -79.34995],
                [0.0, 0.28948866, 0.0, 79.34995],
                [-90.0, 0.0775, 0.3425, 0.0],
                [90.0, 0.0, 0.0, 0.0],
                [-90.0, 0.076, 0.097, 0.0],
            ],
        ),
        (
            "CRX-10iA",
            [
                [0.0, 0.0, 0.245, 0.0],
                [-90.0, 0.0, 0.0, -90.0],
                [0.0, 0.54, 0.0, 0.0],
                [-90.0, 0.0, 0.54, 0.0],
                [90.0, 0.0, 0.15, 0.0],
                [-90.0, 0.0, 0.16, 180.0],
            ],
        ),
        (
            "lateral",
            [
                [0.0, 0.0, 0.2755, 0.0],
                [90.0, 0.0, 0.12, 10.0],
                [180.0, 0.41, -0.03, 20.0],
                [90.0, 0.0, -0.2073, 30.0],
                [60.0, 0.0, -0.0741, 0.0],
                [60.0, 0.0, -0.16, 0.0],
            ],
        ),
        (
            "skew",
            [
                [0.0, 0.0, 0.2755, 0.0],
                [90.0, 0.1, 0.02, 10.0],
                [0.0, -0.41, -0.07, 20.0],
                [70.0, 0.05, -0.3, 30.0],
                [50.0, 0.0, -0.0741, 0.0],
                [40.0, 0.07, -0.16, 0.0],
            ],
        ),
        (
            "IRB 2600",
            [
                [0.0, 0.0, 0.445, 0.0],
                [-90.0, 0.15, 0.0, -90.0],
                [0.0, 0.7, 0.0, 0.0],
                [-90.0, 0.115, 0.795, 0.0],
                [90.0, 0.0, 0.0, 0.0],
                [-90.0, 0.0, 0.085, 180.0],
            ],
        ),
    ]
    .map(|(name, rows)| (name, arm(rows)))
    .into_iter()
    .collect()
}

/// Joint angles between -pi and pi, the same each time.
fn joints(seed: u64) -> impl Iterator<Item = [f64; 6]> {
    let mut state = 2 * seed + 1;
    core::iter::repeat_with(move || {
        core::array::from_fn(|_| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            let unit = (state >> 11) as f64 / (1_u64 << 53) as f64;
            (unit - 0.5) * TAU
        })
    })
}

/// Cosine and sine parts of harmonics 0 to 11 of samples at multiples of 15 deg.
fn harmonics(values: &[Column; SAMPLES / LANES]) -> [[f64; 2]; 12] {
    core::array::from_fn(|k| {
        let mut sum = [0.0; 2];
        for (number, value) in values.as_flattened().iter().enumerate() {
            let (sin, cos) = (k as f64 * number as f64 * PI / 12.0).sin_cos();
            sum = [sum[0] + value * cos, sum[1] + value * sin];
        }
        sum.map(|part| part / if k == 0 { 24.0 } else { 12.0 })
    })
}

#[test]
fn the_resultant_has_degree_8_and_vanishes_at_joint_6_of_the_arm() {
    for (name, arm) in arms() {
        let mut worst = [0.0_f64; 2];
        for q in joints(1).take(500) {
            let frame = Frame::of(&arm.chain.fk(&q));
            let hand = Hand::of::<false>(&arm.lengths, &frame);
            let (values, _) = samples::<false>(&arm.lengths, &hand);
            let size =
                values.as_flattened().iter().fold(0.0_f64, |most, value| most.max(value.abs()));
            let parts = harmonics(&values);
            for [cos, sin] in &parts[9..] {
                worst[0] = worst[0].max(cos.hypot(*sin) / size);
            }
            let at: f64 = parts
                .iter()
                .enumerate()
                .map(|(k, [cos, sin])| {
                    let angle = k as f64 * q[5];
                    cos * angle.cos() + sin * angle.sin()
                })
                .sum();
            worst[1] = worst[1].max(at.abs() / size);
        }
        std::println!("{name}: {worst:?}");
        assert!(worst[0] < 1e-12 && worst[1] < 1e-12, "{name}: {worst:?}");
    }
}

pub(super) fn angles(joints: &SinCos) -> [f64; 6] {
    joints.map(|[sin, cos]| sin.atan2(cos))
}

#[test]
fn one_branch_at_joint_6_of_the_arm_is_the_arm() {
    for (name, arm) in arms() {
        for q in joints(2).take(500) {
            let frame = Frame::of(&arm.chain.fk(&q));
            let hand = Hand::of::<false>(&arm.lengths, &frame);
            let (sin, cos) = q[5].sin_cos();
            let off = |found: &[f64; 6]| {
                found
                    .iter()
                    .zip(&q)
                    .map(|(a, b)| ((a - b) / TAU - ((a - b) / TAU).round()).abs() * TAU)
                    .fold(0.0, f64::max)
            };
            let best = SIDES
                .iter()
                .filter_map(|sides| branch_at(&arm.lengths, &hand, *sides, [sin, cos], 1e-12))
                .map(|branch| {
                    let joints =
                        branch.joints::<false>(&arm.lengths, &frame, [sin, cos], &arm.twists);
                    (off(&angles(&joints)), branch.off)
                })
                .min_by(|a, b| a.0.total_cmp(&b.0));
            let (apart, residual) = best.unwrap();
            assert!(apart < 1e-6 && residual.abs() < 1e-9, "{name}: {apart} {residual} {q:?}");
        }
    }
}

/// How far a joint vector is from the nearest of the seeds, on the circle.
fn nearest(seeds: &Seeds, q: &[f64; 6]) -> f64 {
    let apart = |a: f64, b: f64| ((a - b) / TAU - ((a - b) / TAU).round()).abs() * TAU;
    seeds
        .as_slice()
        .iter()
        .map(|seed| seed.iter().zip(q).map(|(a, b)| apart(*a, *b)).fold(0.0, f64::max))
        .fold(f64::INFINITY, f64::min)
}

#[test]
fn the_arm_is_among_the_seeds() {
    let quarter = |q: [f64; 6], step: f64| q.map(|angle| (angle / step).round() * step);
    let with = |joint: usize, angle: f64| {
        move |q: [f64; 6]| {
            let mut q = q;
            q[joint] = angle;
            q
        }
    };
    let sets: [(&str, std::boxed::Box<dyn Fn([f64; 6]) -> [f64; 6]>); 8] = [
        ("random", std::boxed::Box::new(|q| q)),
        ("q4 = 0", std::boxed::Box::new(with(3, 0.0))),
        ("q4 = 1e-6", std::boxed::Box::new(with(3, 1e-6))),
        ("q4 = 1e-4", std::boxed::Box::new(with(3, 1e-4))),
        ("q5 = 0", std::boxed::Box::new(with(4, 0.0))),
        ("q4 = q5 = 0", std::boxed::Box::new(move |q| with(3, 0.0)(with(4, 0.0)(q)))),
        ("45 deg", std::boxed::Box::new(move |q| quarter(q, PI / 4.0))),
        ("90 deg", std::boxed::Box::new(move |q| quarter(q, PI / 2.0))),
    ];
    for (name, arm) in arms() {
        for (set, change) in &sets {
            let count = 2000;
            let (mut far, mut number, mut worst, mut odd, mut free, mut lost) =
                (0, 0, 0.0_f64, 0, 0, 0);
            for q in joints(3).take(count).map(change) {
                let q = arm.joint_map.theta(&arm.joint_map.joints(q));
                let frame = Frame::of(&arm.chain.fk(&q));
                let seeds = seeds::<false>(&arm, &frame);
                let off = nearest(&seeds, &q);
                worst = worst.max(if off > 1e-3 { 0.0 } else { off });
                far += usize::from(off > 1e-3);
                let found = arm.find::<false>(&frame);
                number += found.accepted.as_slice().len();
                let off = found
                    .accepted
                    .as_slice()
                    .iter()
                    .map(|one| one.distance(&q))
                    .fold(f64::INFINITY, f64::min);
                odd += usize::from(!found.is_certified);
                free += usize::from(found.accepted.has_self_motion());
                lost += usize::from(off > 1e-6 && !found.accepted.has_self_motion());
                if off > 1e-6 && found.is_certified {
                    std::println!("LOST {q:?} {off}");
                }
            }
            std::println!(
                "{name} {set}: far {far} lost {lost} uncertified {odd} free {free} of {count}, worst {worst:e}, solutions {}",
                number as f64 / count as f64
            );
        }
    }
}

#[test]
#[ignore]
fn diagnose() {
    let arms = arms();
    let gofa = &arms[0].1;
    let mut shown = 0;
    for (set, change) in [("random", 9.0), ("q4=0", 0.0), ("q4=1e-4", 1e-4)] {
        shown = 0;
        for q in joints(3).take(2000) {
            let mut q = q;
            if change < 0.0 {
                q[3] = change;
            }
            let frame = Frame::of(&gofa.chain.fk(&q));
            let found = gofa.find::<false>(&frame);
            if !found.is_certified && shown < 6 {
                shown += 1;
                let seeds = seeds::<false>(gofa, &frame);
                std::println!("{set} {seeds:?} certain {}", found.accepted.is_certain);
                for one in found.accepted.as_slice() {
                    std::println!(
                        "   {:.9?} {:e} {:e} {:?}",
                        one.theta,
                        one.residual,
                        one.least,
                        one.kind
                    );
                }
            }
        }
    }
    let r = |q: [f64; 6]| q.map(f64::to_radians);
    for (arm, q) in [
        (4, r([-135.0, 90.0, 90.0, 180.0, -90.0, 45.0])),
        (4, r([45.0, 90.0, -90.0, 45.0, 0.0, 135.0])),
        (4, r([-90.0, 90.0, 90.0, -90.0, 180.0, -90.0])),
    ] {
        let (name, arm) = &arms[arm];
        let frame = Frame::of(&arm.chain.fk(&q));
        let found = arm.find::<false>(&frame);
        let seeds = seeds::<false>(arm, &frame);
        let target = arm.closure.target(&frame);
        let settled = arm.closure.settle(&target, &q);
        std::println!("{name} settle {:?} {}", settled.all, settled.is_certain);
        std::println!(
            "{name} {q:?} {seeds:?} certain {} {}",
            found.accepted.is_certain,
            found.is_certified
        );
        for one in found.accepted.as_slice() {
            std::println!(
                "CRX   {:.9?} {:e} {:e} {:?}",
                one.theta,
                one.residual,
                one.least,
                one.kind
            );
        }
    }
}
