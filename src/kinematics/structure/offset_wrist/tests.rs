//! The resultant and the branches against forward kinematics, without a root finder.
#![allow(clippy::cast_precision_loss, clippy::unreadable_literal, clippy::too_many_lines)]

use core::f64::consts::{PI, TAU};

mod arms;
mod attempts;
mod company;
mod merged;
mod reach;
mod self_motions;
mod steps;
mod turns;

use arms::{arm, arms};

use super::Structure as _;
use super::branch::{Branch, Plane, SIDES};
use super::geometry::{Constants, OffsetWrist};
use super::hand::Hand;
use super::resultant::resultant;
use super::step::Stepped;
use crate::kinematics::answer::solutions::{Solution, Solutions};
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::pose::angles::wrap;
use crate::kinematics::robot::Robot;
use crate::kinematics::structure::closure::{Accepted, Configuration};
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::free_choice::FreeChoice;
use crate::kinematics::structure::inverse::Inverse as _;
use crate::kinematics::structure::known::solver_of;
use crate::kinematics::structure::trigonometric::SAMPLES;

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
fn harmonics(values: &[f64; SAMPLES]) -> [[f64; 2]; 12] {
    core::array::from_fn(|k| {
        let mut sum = [0.0; 2];
        for (number, value) in values.iter().enumerate() {
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
            let hand = Hand::of(&arm.constants.lengths, &frame);
            let values: [f64; SAMPLES] = core::array::from_fn(|number| {
                let (sin, cos) = (number as f64 * PI / 12.0).sin_cos();
                let (point, axis_5) = hand.at([sin, cos]);
                resultant(&arm.constants.lengths, point, axis_5)
            });
            let size = values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
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

/// The largest difference of a joint [rad].
fn apart(a: &[f64; 6], b: &[f64; 6]) -> f64 {
    a.iter().zip(b).map(|(a, b)| wrap(a - b).abs()).fold(0.0, f64::max)
}

fn angles([sin, cos]: &[[f64; 6]; 2]) -> [f64; 6] {
    core::array::from_fn(|joint| sin[joint].atan2(cos[joint]))
}

#[test]
fn one_branch_at_joint_6_of_the_arm_is_the_arm() {
    for (name, arm) in arms() {
        for q in joints(2).take(500) {
            let frame = Frame::of(&arm.chain.fk(&q));
            let hand = Hand::of(&arm.constants.lengths, &frame);
            let (sin, cos) = q[5].sin_cos();
            let best = SIDES
                .iter()
                .map(|[shoulder, elbow]| {
                    let plane = Plane::of(&arm.constants.lengths, hand.at([sin, cos]), *shoulder);
                    plane.with_elbow(&arm.constants.lengths, *elbow, 1e-12)
                })
                .filter(|branch| branch.off < f64::INFINITY)
                .map(|branch| {
                    let joints = branch.joints(
                        &arm.constants.lengths,
                        &frame,
                        [sin, cos],
                        &arm.constants.twists,
                    );
                    (apart(&angles(&joints), &q), branch.off)
                })
                .min_by(|a, b| a.0.total_cmp(&b.0));
            let (off, residual) = best.unwrap();
            assert!(off < 1e-6 && residual.abs() < 1e-9, "{name}: {off} {residual} {q:?}");
        }
    }
}

/// A set of joint vectors by its name: how one is made of any; none where that fails.
type Set = (&'static str, fn(&OffsetWrist, [f64; 6]) -> Option<[f64; 6]>);

const SETS: [Set; 16] = [
    ("random", |_, q| Some(q)),
    ("q4 = 0", |_, q| with(q, [(3, 0.0)])),
    ("q4 = 1e-9", |_, q| with(q, [(3, 1e-9)])),
    ("q4 = 1e-6", |_, q| with(q, [(3, 1e-6)])),
    ("q4 = 1e-4", |_, q| with(q, [(3, 1e-4)])),
    ("q5 = 0", |_, q| with(q, [(4, 0.0)])),
    ("q5 = 1e-6", |_, q| with(q, [(4, 1e-6)])),
    ("q4 = q5 = 0", |_, q| with(q, [(3, 0.0), (4, 0.0)])),
    ("q4 = 1e-6, q5 = 1e-4", |_, q| with(q, [(3, 1e-6), (4, 1e-4)])),
    ("multiples of 45 deg", |_, q| Some(q.map(|angle| (angle / (PI / 4.0)).round() * (PI / 4.0)))),
    ("multiples of 90 deg", |_, q| Some(q.map(|angle| (angle / (PI / 2.0)).round() * (PI / 2.0)))),
    ("q3 = 90 deg", |_, q| with(q, [(2, PI / 2.0)])),
    ("det J = 0", |arm, q| singular(arm, q, 0.0)),
    ("1e-9 off det J = 0", |arm, q| singular(arm, q, 1e-9)),
    ("1e-6 off det J = 0", |arm, q| singular(arm, q, 1e-6)),
    ("1e-4 off det J = 0", |arm, q| singular(arm, q, 1e-4)),
];

#[expect(clippy::unnecessary_wraps, reason = "a set may leave a joint vector out")]
fn with<const K: usize>(mut q: [f64; 6], angles: [(usize, f64); K]) -> Option<[f64; 6]> {
    for (joint, angle) in angles {
        q[joint] = angle;
    }
    Some(q)
}

/// The singular joint vector on the way of joint 5 by up to half a turn, and so far ahead.
fn singular(arm: &OffsetWrist, q: [f64; 6], ahead: f64) -> Option<[f64; 6]> {
    at_zero(|q| arm.determinant(q), q, 4, ahead)
}

/// Where a value is zero on the way of a joint by up to half a turn, and so far ahead.
fn at_zero(
    value: impl Fn(&[f64; 6]) -> f64,
    q: [f64; 6],
    joint: usize,
    ahead: f64,
) -> Option<[f64; 6]> {
    let at = |turn: f64| {
        let mut q = q;
        q[joint] += turn;
        q
    };
    let is_positive = |turn: f64| value(&at(turn)) > 0.0;
    let start = is_positive(0.0);
    let (mut low, mut high) = (0..60)
        .map(|step| f64::from(step) * PI / 60.0)
        .map(|turn| (turn, turn + PI / 60.0))
        .find(|(_, turn)| is_positive(*turn) != start)?;
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        *(if is_positive(middle) == start { &mut low } else { &mut high }) = middle;
    }
    Some(at(low + ahead))
}

/// The findings of a set.
#[derive(Debug, Default)]
struct Tally {
    count: usize,
    missed: usize,
    missed_though_certified: usize,
    uncertified: usize,
    free: usize,
    solutions: usize,
}

fn tally(
    arm: &OffsetWrist,
    change: fn(&OffsetWrist, [f64; 6]) -> Option<[f64; 6]>,
    count: usize,
) -> Tally {
    let mut tally = Tally::default();
    for q in joints(3).take(count).filter_map(|q| change(arm, q)) {
        let q = arm.joint_map().theta(&arm.joint_map().joints(q));
        tally.count += 1;
        let mut found = Accepted::new();
        let is_certified =
            arm.solutions(&Frame::of(&arm.chain.fk(&q)), &FreeChoice::rest([0.0; 6]), &mut found);
        let all = found.as_slice();
        // A regular solution is where it was. Of two that nearly merge, rounding moves each by the
        // root of itself over the curvature of the closure, which is 5e-10 at least: what is
        // flatter counts as free.
        let is_same =
            |one: &Configuration| one.distance(&q) < if one.least > 1e-4 { 1e-8 } else { 3e-3 };
        let is_found = all.iter().any(is_same);
        let is_free = found.has_self_motion();
        tally.missed += usize::from(!is_found && !is_free);
        tally.missed_though_certified += usize::from(!is_found && is_certified);
        tally.uncertified += usize::from(!is_certified);
        tally.free += usize::from(is_free);
        tally.solutions += all.len();
        for (index, one) in all.iter().enumerate() {
            assert!(one.residual < 1e-13);
            // Two that are one would be counted twice.
            assert!(all[..index].iter().all(|other| one.distance(&other.theta) > 1e-8));
        }
    }
    tally
}

#[test]
fn each_arm_is_found_or_the_answer_is_not_certified() {
    let (mut totals, mut missed) = ([[0; 2]; SETS.len()], 0);
    for (name, arm) in arms() {
        for (set, change) in SETS {
            let tally = tally(&arm, change, asked());
            std::println!("{name}, {set}: {tally:?}");
            assert_eq!(tally.missed_though_certified, 0, "{name}, {set}: {tally:?}");
            let total = &mut totals[SETS.iter().position(|(other, _)| *other == set).unwrap()];
            *total = [total[0] + tally.count, total[1] + tally.uncertified];
            assert!(set != "random" || tally.missed == 0, "{name}: {tally:?}");
            missed += tally.missed;
        }
    }
    let poses: usize = totals.iter().map(|[count, _]| count).sum();
    std::println!("{missed} of {poses} missed; count and uncertified of each set: {totals:?}");
    assert!(missed * 1000 <= poses, "{missed} of {poses}");
    let [random, uncertified] = totals[0];
    assert!(uncertified * 100 <= random, "{uncertified} of {random}");
}

/// Number of joint vectors of a set: `make offset-wrists` asks for more.
fn asked() -> usize {
    std::env::var("JOINT_VECTORS").ok().and_then(|count| count.parse().ok()).unwrap_or(60)
}

#[test]
fn an_arm_with_a_spherical_wrist_has_the_solutions_of_its_closed_form() {
    let robot: Robot<6> = Robot::named("IRB 2600-12/1.65").unwrap();
    let (chain, solver) = solver_of::<OffsetWrist, 6, 16>(robot.mdh()).unwrap();
    let [mut compared, mut certified] = [0; 2];
    for q in joints(5).take(500) {
        let pose = chain.fk(&q);
        let mut solutions = Solutions::none(16, pose, JointLimits::UNLIMITED);
        solver.solve(&mut solutions, f64::NAN, &FreeChoice::rest([0.0; 6]));
        let closed = robot.ik(&pose).unwrap();
        assert!(solutions.len() == closed.len(), "{q:?}");
        certified += usize::from(solutions.is_certified);
        for solution in &solutions {
            let off = |other: &Solution<6>| apart(&other.q, &solution.q);
            assert!(closed.iter().map(off).fold(f64::INFINITY, f64::min) < 1e-9, "{q:?}");
            compared += 1;
        }
    }
    assert!(compared > 3000);
    // Next to a straight wrist the resultant tells nothing for certain.
    assert!(certified > 475, "{certified}");
}
