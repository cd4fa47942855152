//! Right angles written with few digits are made exact on request, which is proposed exactly where
//! it helps.

use crate::common;

use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt::{Debug, Display};

use crate::common::{Rng, reach_of};
use irbkin::batch::Batch;
use irbkin::{DhRow, JointLimits, Joints, Mdh, Pose, Robot, Sdh, Solutions, pose};
use irbkin_motion::{Arm, Error};

const XARM7: &str = include_str!("data/few_digits/xarm7.urdf");
const PUMA560: &str = include_str!("data/few_digits/puma560.urdf");

/// The error of an arm with either number of joints.
fn refusal<T: Debug, E: Debug + Display>(built: Result<T, E>) -> String {
    built.unwrap_err().to_string()
}

/// What keeps an arm from a closed form.
fn noted<E: Debug>(built: Result<Robot<6>, E>) -> String {
    built.unwrap().missing_form().unwrap().to_string()
}

fn check_solutions<const N: usize>(robot: &Robot<N>, pose: &Pose, solutions: &Solutions<N>) {
    assert_eq!(solutions.len(), 8, "{}", robot.name());
    let bound = 1e-14 * (1.0 + reach_of(robot));
    for solution in solutions {
        assert!(robot.residual(&solution.q, pose).largest() <= bound, "{}", robot.name());
    }
}

/// The largest difference of many poses of two arms, for joints inside the limits of both.
fn farthest<const N: usize>(one: &Robot<N>, other: &Robot<N>) -> f64 {
    let mut rng = Rng::new(71);
    let q = (0..1000).map(|_| [0.0; N].map(|_| rng.between(-PI, PI)));
    q.map(|q| one.residual(&q, &other.fk(&q)).largest()).fold(0.0, f64::max)
}

/// Each of `angles` moves by at most `snap`, and rotates what follows it by that.
fn moved<const N: usize>(robot: &Robot<N>, angles: usize, snap: f64) -> f64 {
    f64::from(u32::try_from(angles).unwrap()) * snap * (1.0 + reach_of(robot))
}

#[test]
fn the_published_xarm7_is_accepted_with_the_proposed_snap() {
    let text = Arm::<7>::from_urdf_snapped(XARM7, None, None, 0.0).unwrap();
    let reason = text.missing_form().unwrap();
    assert_eq!(reason.snap(), Some(1e-5));
    assert!(reason.to_string().contains("they are 0.000210 deg off"), "{reason}");
    assert!(reason.to_string().ends_with("; snap=1e-5 would take it"), "{reason}");
    let robot = Arm::<7>::from_urdf_snapped(XARM7, None, None, 1e-5).unwrap();
    assert_eq!(robot.structure(), "spherical shoulder");
    // Its four decimals allow that, too.
    assert_eq!(Arm::<7>::from_urdf(XARM7, None, None).unwrap().mdh(), robot.mdh());
    // Six right angles are 3.7e-6 rad off.
    let off = farthest(&robot, &text);
    assert!(off > 1e-6 && off <= moved(&robot, 6, 1e-5), "{off:e}");
    let mut full = 0;
    for q in poses_of(&robot) {
        let pose = robot.fk(&q);
        let solutions = robot.ik(&pose, q[6]).unwrap();
        assert!(solutions.iter().any(|solution| common::apart(&solution.q, &q) < 1e-9));
        if solutions.len() == 8 {
            check_solutions(&robot, &pose, &solutions);
            full += 1;
        }
    }
    assert!(full > 300, "{full}");
}

#[test]
fn the_published_puma560_is_accepted_with_the_proposed_snap() {
    let kept = Arm::from_urdf_snapped(PUMA560, None, None, 0.0).unwrap();
    let words = noted(Ok::<_, Error>(kept.robot().clone()));
    assert!(words.ends_with("; snap=1e-8 would take it"), "{words}");
    assert!(!words.contains("0.000000"), "{words}");
    let read = Arm::<6>::from_urdf(PUMA560, None, None).unwrap();
    assert_eq!(read.structure(), "spherical wrist");
    for snap in [1e-8, 1e-5, 1e-3] {
        let robot = Arm::<6>::from_urdf_snapped(PUMA560, None, None, snap).unwrap();
        assert_eq!(robot.mdh(), read.mdh());
        assert!(farthest(&robot, &kept) <= moved(&robot, 6, 1e-8));
        let robot = robot.robot().clone().with_limits(JointLimits::UNLIMITED);
        let mut full = 0;
        for q in poses_of(&robot) {
            let pose = robot.fk(&q);
            let solutions = robot.ik(&pose).unwrap();
            assert!(solutions.iter().any(|solution| common::apart(&solution.q, &q) < 1e-9));
            if solutions.len() == 8 {
                check_solutions(&robot, &pose, &solutions);
                full += 1;
            }
        }
        assert!(full > 300, "{full}");
    }
}

fn poses_of<const N: usize>(robot: &Robot<N>) -> Vec<[f64; N]> {
    let mut rng = Rng::new(72);
    (0..1000).map(|_| rng.inside(robot.limits())).collect()
}

/// The published table of an arm with its right angles rounded to some decimals.
fn rounded<const N: usize>(mdh: &Mdh<N>, decimals: i32) -> Mdh<N> {
    let step = 10.0_f64.powi(decimals);
    let round = |angle: f64| (angle * step).round() / step;
    let rows =
        mdh.rows.map(|row| DhRow { alpha: round(row.alpha), theta: round(row.theta), ..row });
    Mdh { rows, ..mdh.clone() }
}

/// A right angle written with so many decimals is off by a known amount: the least power of ten
/// above it is accepted.
#[test]
fn tables_of_every_structure_are_accepted_with_the_proposed_snap() {
    fn check<const N: usize>(exact: &Robot<N>)
    where
        Robot<N>: Joints<N>,
    {
        for decimals in 3..=9 {
            let table = rounded(exact.mdh(), decimals);
            let off = table.rows.iter().zip(&exact.mdh().rows);
            let off = off.map(|(one, other)| (one.alpha - other.alpha).abs()).fold(0.0, f64::max);
            let proposed = Robot::serial_chain(table.clone()).unwrap().missing_form();
            if off <= 1e-9 {
                assert_eq!(proposed, None, "{} {decimals}", exact.name());
                continue;
            }
            let reason = proposed.unwrap();
            let snap = reason.snap().unwrap();
            assert!(off <= snap && (snap < 10.0 * off || snap <= 1e-8), "{snap:e} for {off:e}");
            assert!(!reason.to_string().contains("0.000000"), "{reason}");
            let robot = Robot::from_mdh(table.clone().snapped(snap).unwrap()).unwrap();
            assert_eq!(robot.structure(), exact.structure(), "{decimals}");
            let text = Robot::serial_chain(table.clone()).unwrap();
            assert!(farthest(&robot, &text) <= moved(&robot, 2 * N, off.max(1e-15)));
            // The same as a standard table, whose first twist and length are in the base.
            let sdh = Sdh::from(table).snapped(snap).unwrap();
            assert_eq!(Robot::from_sdh(sdh).unwrap().structure(), exact.structure(), "{decimals}");
        }
    }
    for name in ["IRB 2600-12/1.65", "IRB 140-6/0.81", "UR5e", "UR10"] {
        check::<6>(&Robot::named(name).unwrap());
    }
    for name in ["Panda", "FR3"] {
        check::<7>(&Robot::named(name).unwrap());
    }
}

/// What no snap would make exact is refused without a proposal: a length, or an intended angle.
#[test]
fn no_snap_is_proposed_if_none_helps() {
    let exact = Robot::<6>::named("IRB 2600-12/1.65").unwrap().mdh().clone();
    let with = |change: &dyn Fn(&mut Mdh<6>)| {
        let mut table = rounded(&exact, 5);
        change(&mut table);
        Robot::from_mdh(table)
    };
    assert!(noted(with(&|_| {})).contains("snap=1e-5 would take it"));
    for change in [
        (&|table: &mut Mdh<6>| table.rows[4].a = 1e-6) as &dyn Fn(&mut Mdh<6>),
        &|table| table.rows[2].alpha = 2e-3,
        &|table| table.rows[4].alpha += 0.5,
        &|table| table.rows[2].a = 1e-7,
    ] {
        let words = noted(with(change));
        assert!(!words.contains("snap"), "{words}");
        for snap in [1e-8, 1e-6, 1e-4, 1e-3] {
            let mut table = rounded(&exact, 5);
            change(&mut table);
            assert!(!noted(Robot::from_mdh(table.snapped(snap).unwrap())).is_empty());
        }
    }
    // An arm that deviates by more than the given snap accepts.
    let words = noted(Robot::from_mdh(rounded(&exact, 4).snapped(1e-6).unwrap()));
    assert!(words.ends_with("; snap=1e-5 would take it"), "{words}");
}

/// Text can deviate so far that there is no table: axes 2 and 3 of an arm on a rounded quarter turn
/// intersect far away.
#[test]
fn nearly_parallel_axes_are_accepted_with_the_proposed_snap() {
    let text = include_str!("data/irb2600.urdf");
    let joint = r#"<origin xyz="0 0 0.7""#;
    assert!(text.contains(joint), "the joint that is tilted");
    let tilted = text.replace(joint, r#"<origin rpy="0.00000002 0 0" xyz="0 0 0.7""#);
    let error = Arm::<6>::from_urdf(&tilted, None, None).unwrap_err();
    assert!(error.to_string().ends_with("; snap=1e-7 would take it"), "{error}");
    assert!(Arm::<6>::from_urdf_snapped(&tilted, None, None, 1e-7).is_ok());
}

/// Axes are snapped too, to a coordinate axis that is near, and to nothing else.
#[test]
fn an_axis_near_a_coordinate_axis_is_snapped_to_it() {
    let tilted = |axis: &str| {
        PUMA560.replace("1.570796325", &FRAC_PI_2.to_string()).replacen(
            "<axis xyz=\"0 0 1\"/>",
            &format!("<axis xyz=\"{axis}\"/>"),
            1,
        )
    };
    let has_form = |built: Result<Arm<6>, Error>| built.unwrap().missing_form().is_none();
    assert!(has_form(Arm::from_urdf(&tilted("0 0 1"), None, None)));
    let snapped = |axis: &str| Arm::from_urdf_snapped(&tilted(axis), None, None, 1e-5);
    for axis in ["3.6732E-06 0 1", "0 -3.6732E-06 -1", "3e-6 -2e-6 0.5"] {
        assert!(!has_form(Arm::from_urdf(&tilted(axis), None, None)), "{axis}");
        assert!(has_form(snapped(axis)), "{axis}");
    }
    for axis in ["1.1e-5 0 1", "0.001 0 1", "0 0.3 1"] {
        assert!(!has_form(snapped(axis)), "{axis}");
    }
}

#[test]
fn without_snap_every_bit_is_kept() {
    let mut rng = Rng::new(73);
    for _ in 0..1000 {
        let row = || DhRow::new(0.0, 0.0, 0.0, 0.0);
        let rows = [(); 6].map(|()| DhRow {
            alpha: FRAC_PI_2 + rng.between(-1e-6, 1e-6),
            theta: rng.between(-1e-6, 1e-6),
            ..row()
        });
        let mdh = Mdh { base: Pose::identity(), rows, flange: Pose::identity() };
        assert_eq!(mdh.clone().snapped(0.0).unwrap(), mdh);
    }
}

#[test]
fn a_snap_has_bounds() {
    let mdh = Robot::<6>::named("IRB 2600-12/1.65").unwrap().mdh().clone();
    for (snap, word) in
        [(-1e-9, "-0.000000001"), (1.1e-3, "0.0011"), (f64::NAN, "NaN"), (90.0, "90")]
    {
        let words = format!("snap is {word} rad, it must be 0 to 1e-3 rad");
        assert_eq!(refusal(mdh.clone().snapped(snap)), words);
        assert_eq!(refusal(Sdh::from(mdh.clone()).snapped(snap)), words);
        assert_eq!(refusal(Arm::<6>::from_urdf_snapped(PUMA560, None, None, snap)), words);
    }
    assert!(mdh.snapped(1e-3).is_ok());
}

/// A batch of a snapped arm is solved as any other.
#[test]
fn a_snapped_arm_solves_batches() {
    let robot = Arm::<6>::from_urdf_snapped(PUMA560, None, None, 1e-8).unwrap();
    let poses: Vec<f64> =
        poses_of(&robot).iter().flat_map(|q| pose::to_rows(&robot.fk(q))).collect();
    let rows = poses.len() / 16;
    let (mut q, mut status) = (vec![0.0; rows * 48], vec![0; rows * 8]);
    Batch::new(None).ik(&robot, &poses, &mut q, &mut status).unwrap();
    for (row, pose) in poses.as_chunks::<16>().0.iter().enumerate() {
        let pose = irbkin::pose::from_rows(pose).unwrap();
        let single = robot.ik(&pose).unwrap();
        for slot in 0..8 {
            let found = &q[48 * row + 6 * slot..][..6];
            match single.slot(slot) {
                Some(solution) => assert_eq!(found, solution.q),
                None => assert!(found.iter().all(|angle| angle.is_nan())),
            }
        }
    }
}
