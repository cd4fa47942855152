//! One arm by several tables: read backwards, with frames and zeros of joints elsewhere, in other
//! units. Its solutions are the same.
//!
//! Backwards, an arm with a closed form has none: there the closed form shows what the general
//! solver finds, with equations that have nothing in common.

use std::f64::consts::PI;

use irbkin::{DhRow, Mdh, Pose, Robot, Sdh, Solution};
use nalgebra::{IsometryMatrix3, Rotation3, Translation3, Vector3};

use super::with_x_flipped;
use crate::common::{Rng, apart, enough};
use crate::structures::by_table::with_zeros_at;
use crate::structures::{Subject, general, offset_wrist, spherical_wrist, three_parallel};

/// Poses of each arm.
const POSES: usize = 150;

/// Subjects of every structure of six joints, without limits.
fn subjects() -> impl Iterator<Item = Subject<6>> {
    let structures = [spherical_wrist::structure(), three_parallel::structure()];
    let ordinals = [offset_wrist::structure(), general::structure()];
    let all = structures.into_iter().chain(ordinals).flat_map(|structure| structure.subjects);
    all.map(|subject| subject.clone().with_robot(|_| subject.arm.robot()))
}

type JointMap = Box<dyn Fn(&[f64; 6]) -> [f64; 6]>;

/// The same arm by another table.
struct Variant {
    robot: Robot<6>,
    pose: Box<dyn Fn(&Pose) -> Pose>,
    /// From the joints of this table to those of the arm.
    joints: JointMap,
    /// What the other table adds to the rounding of the angles [rad].
    rounding: f64,
}

/// Whether a variant has the solutions of the arm, at poses where all of them are regular.
fn assert_same(subject: &Subject<6>, variant: &Variant) {
    let mut rng = Rng::new(0x7ab1e);
    let (mut compared, mut worst) = (0, 0.0_f64);
    for _ in 0..POSES {
        let q = rng.angles();
        let pose = subject.robot.fk(&q);
        let ours = subject.robot.ik(&pose).unwrap();
        let theirs = variant.robot.ik(&(variant.pose)(&pose)).unwrap();
        let theirs_as_ours: Vec<_> = theirs.iter().map(|s| (variant.joints)(&s.q)).collect();
        let are_certified = ours.is_certified() && theirs.is_certified();
        let mut all = ours.iter().map(|s| &s.q).chain(&theirs_as_ours);
        if are_certified && all.all(|q| subject.is_regular(q)) {
            compared += 1;
            let counts = (ours.len(), theirs.len());
            assert_eq!(counts.0, counts.1, "{}, {q:?}", subject.name);
            assert_eq!(counts.0 % 2, 0, "{}, {q:?}: {} solutions", subject.name, counts.0);
        }
        let is_regular = |s: &&Solution<6>| subject.is_regular(&s.q);
        for one in ours.iter().filter(is_regular) {
            let off = theirs_as_ours.iter().map(|q| apart(q, &one.q)).fold(f64::INFINITY, f64::min);
            // Without a certificate, the second table may miss what the first one found.
            if off > 1e-3 && !theirs.is_certified() {
                continue;
            }
            let bound = 4.0 * subject.joint_bound(&one.q) + variant.rounding;
            assert!(off <= bound, "{}, {q:?}: off by {off:e}, bound {bound:e}", subject.name);
            worst = worst.max(off);
        }
    }
    println!("{}: {compared} of {POSES} compared, {worst:.1e} rad", subject.name);
    assert!(enough(compared > POSES / 5), "{}: {compared} compared", subject.name);
}

#[test]
fn an_arm_read_backwards_has_the_same_solutions() {
    let mut without_closed_form = 0;
    for subject in subjects() {
        let robot = Robot::from_mdh(backwards(subject.robot.mdh())).unwrap();
        without_closed_form += usize::from(robot.structure() == "general");
        let joints = |q: &[f64; 6]| std::array::from_fn(|i| -q[5 - i]);
        let pose = Box::new(Pose::inverse);
        let variant = Variant { robot, pose, joints: Box::new(joints), rounding: 0.0 };
        assert_same(&subject, &variant);
    }
    assert!(without_closed_form > 15, "{without_closed_form}");
}

/// The inverse of every link, in the opposite order.
fn backwards(mdh: &Mdh<6>) -> Mdh<6> {
    let first = mdh.rows[0];
    let rows = std::array::from_fn(|i| {
        let turn = mdh.rows[5 - i];
        // What is before the first turn is part of the base.
        let link = if i > 0 { mdh.rows[6 - i] } else { DhRow::default() };
        DhRow::new(-link.alpha, -link.a, -turn.d, -turn.theta)
    });
    let about_x = Rotation3::from_axis_angle(&Vector3::x_axis(), -first.alpha);
    let along_x = Translation3::new(-first.a, 0.0, 0.0);
    let inverse = IsometryMatrix3::from_parts(along_x, about_x);
    Mdh { base: mdh.flange.inverse(), rows, flange: inverse * mdh.base.inverse() }
}

#[test]
fn frames_may_be_anywhere() {
    for (index, subject) in (0_u32..).zip(subjects()) {
        let mdh = with_x_flipped(subject.robot.mdh().clone(), 0x2b + 5 * index);
        assert_same_slots(&subject, &Robot::from_mdh(mdh.clone()).unwrap(), 0.0);
        let robot = Robot::from_sdh(Sdh::from(mdh)).unwrap();
        let pose = Box::new(|pose: &Pose| *pose);
        let variant = Variant { robot, pose, joints: Box::new(|q| *q), rounding: 0.0 };
        assert_same(&subject, &variant);
    }
}

/// Slots of a closed form do not depend on how axes x are directed. If the arm is offset from axis
/// 1, they do not depend on where joint 1 is zero [rad] either.
fn assert_same_slots(subject: &Subject<6>, other: &Robot<6>, zero: f64) {
    if subject.has_ordinals() || subject.robot.structure() != other.structure() {
        return;
    }
    let mut rng = Rng::new(0x5107);
    for _ in 0..POSES {
        let pose = subject.robot.fk(&rng.angles());
        let (ours, theirs) = (subject.robot.ik(&pose).unwrap(), other.ik(&pose).unwrap());
        for one in ours.iter().filter(|one| subject.is_regular(&one.q)) {
            let other = theirs.slot(one.slot.into());
            let mut q = one.q;
            q[0] += zero;
            let is_same = other.is_some_and(|other| apart(&other.q, &q) < 1e-6);
            assert!(is_same, "{}, slot {}: {other:?}", subject.name, one.slot);
        }
    }
}

#[test]
fn joints_may_be_zero_anywhere() {
    for subject in subjects() {
        let mut rng = Rng::new(0x2e20);
        let zeros: [f64; 6] = rng.angles();
        let mdh = subject.robot.mdh();
        if mdh.rows[1].a.abs() > 1e-6 {
            let opposite = with_zeros_at(mdh.clone(), [PI, 0.0, 0.0, 0.0, 0.0, 0.0]);
            assert_same_slots(&subject, &Robot::from_mdh(opposite).unwrap(), PI);
        }
        let robot = Robot::from_mdh(with_zeros_at(subject.robot.mdh().clone(), zeros)).unwrap();
        let joints = move |q: &[f64; 6]| std::array::from_fn(|i| q[i] - zeros[i]);
        // Angles of up to a turn are rounded where zeros are added, and where they are removed.
        let rounding = 4.0 * PI * f64::EPSILON;
        let pose = Box::new(|pose: &Pose| *pose);
        let variant = Variant { robot, pose, joints: Box::new(joints), rounding };
        assert_same(&subject, &variant);
    }
}

#[test]
fn an_arm_of_a_millimeter_or_of_a_hundred_meters_has_the_same_solutions() {
    for subject in subjects() {
        // The sum of all lengths; a robot may be as long as 100 m.
        for length in [1e-3, 99.0] {
            assert_same(&subject, &scaled(&subject, length / subject.reach()));
        }
    }
}

fn scaled(subject: &Subject<6>, by: f64) -> Variant {
    let scaled =
        move |pose: &Pose| Pose::from_parts((by * pose.translation.vector).into(), pose.rotation);
    let mut mdh = subject.robot.mdh().clone();
    for row in &mut mdh.rows {
        (row.a, row.d) = (by * row.a, by * row.d);
    }
    (mdh.base, mdh.flange) = (scaled(&mdh.base), scaled(&mdh.flange));
    let robot = Robot::from_mdh(mdh).unwrap();
    assert_eq!(robot.structure(), subject.robot.structure(), "{}", subject.name);
    // Positions are rounded twice more.
    let rounding = 4.0 * f64::EPSILON;
    Variant { robot, pose: Box::new(scaled), joints: Box::new(|q| *q), rounding }
}
