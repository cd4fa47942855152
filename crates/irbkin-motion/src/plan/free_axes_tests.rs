//! External axes and tolerances against what they promise.

use core::f64::consts::{PI, TAU};
use std::vec::Vec;

use nalgebra::{IsometryMatrix3, Rotation3, Translation3, Unit, Vector3};

use super::ToolRotation;
use super::robot::freedoms;
use super::tests::random_path;
use super::{ExternalAxis, Plan, PlanError, PlanOptions, ToolCone};
use crate::arm::Arm;
use crate::error::Error;
use crate::paths::{Spacing, line};
use crate::plan::fault::PlanFault;
use crate::rng::Rng;
use irbkin::internal::{largest, steps};
use irbkin::pose::from_euler_zyx as pose_from_euler_zyx;
use irbkin::{Pose, PoseDifference};

fn arm() -> Arm<6> {
    Arm::named("IRB 2600-12/1.65").unwrap()
}

/// A straight seam along y that the arm does not reach the ends of.
fn long_seam(count: usize) -> Vec<Pose> {
    let at = |y| pose_from_euler_zyx([1.1, y, 0.6], [0.0, 2.7, 0.0]).unwrap();
    line(&at(-1.8), &at(1.8), Spacing::count(count).unwrap(), None).unwrap()
}

/// Every pose of a plan is met by the base and the object where its external axes are, with the
/// tool where its angle and its tolerances say, all inside their ranges.
fn assert_meets(robot: &Arm<6>, path: &[Pose], options: &PlanOptions, plan: &Plan) {
    let z = Vector3::z_axis();
    for (index, pose) in path.iter().enumerate() {
        let mut seen = *pose;
        for (axis, value) in options.external.iter().zip(&plan.external[index]).rev() {
            let [lower, upper] = axis.range();
            assert!((lower - 1e-9..=upper + 1e-9).contains(value), "{value}");
            if let Some((point, direction)) =
                TURNING.iter().find(|(point, _)| axis == &turning(*point))
            {
                let turn =
                    Rotation3::from_axis_angle(&Unit::new_normalize((*direction).into()), *value);
                let point = Vector3::from(*point);
                let about =
                    IsometryMatrix3::from_parts(Translation3::from(point - turn * point), turn);
                seen = about * seen;
            }
        }
        let mut base = *robot.base();
        for (axis, value) in options.external.iter().zip(&plan.external[index]) {
            if !TURNING.iter().any(|(point, _)| axis == &turning(*point)) {
                base.translation.vector.y += value;
            }
        }
        let mut tolerance = plan.tolerance[index].iter();
        let mut tilt = Vector3::zeros();
        if options.cone.is_some() {
            (tilt.x, tilt.y) = (*tolerance.next().unwrap(), *tolerance.next().unwrap());
        }
        assert!(tilt.norm() <= options.cone.map_or(0.0, |cone| cone.angle()) + 1e-9);
        let spin = Rotation3::from_axis_angle(&z, plan.tool_angle[index]);
        let tool = seen * (Rotation3::new(tilt) * spin);
        let met = robot.robot().clone().with_base(&base).unwrap().fk(&plan.q[index].unwrap());
        assert!(PoseDifference::between(&met, &tool).largest() < 1e-9, "pose {index}");
    }
}

const TURNING: [([f64; 3], [f64; 3]); 2] =
    [([1.2, 0.0, 0.4], [0.0, 0.0, 1.0]), ([1.2, 0.1, 0.5], [1.0, 0.0, 0.0])];

fn turning(point: [f64; 3]) -> ExternalAxis {
    let (point, direction) = TURNING.into_iter().find(|(own, _)| *own == point).unwrap();
    ExternalAxis::positioner(point, direction, -PI, PI, 25).unwrap()
}

fn track(steps: usize) -> ExternalAxis {
    ExternalAxis::track([0.0, 2.0, 0.0], -1.5, 1.5, steps).unwrap()
}

#[test]
fn a_track_brings_a_seam_into_reach() {
    let (robot, path) = (arm(), long_seam(61));
    assert!(matches!(
        robot.plan(&path, &PlanOptions::default()),
        Err(PlanError::NoPlan(gap)) if gap.pose_index == 0
    ));
    let options = PlanOptions { external: [track(13)].to_vec(), ..PlanOptions::default() };
    let plan = robot.plan(&path, &options).unwrap();
    assert_meets(&robot, &path, &options, &plan);
    let [first, last] = [&plan.external[0], &plan.external[60]].map(|values| values[0]);
    assert!(first < -0.3 && last > 0.3, "{first} {last}");
    // Finer than the grid of 0.25 m: at most a few refined steps from pose to pose.
    let steps = plan.external.windows(2).map(|pair| (pair[1][0] - pair[0][0]).abs());
    assert!(steps.fold(0.0, f64::max) < 0.25);
}

#[test]
fn a_positioner_turns_a_ring_under_the_tool() {
    // A ring whose tool points outward all around: no arm of this kind gets behind it.
    let (robot, mut path) = (arm(), Vec::new());
    for index in 0..41 {
        let angle = TAU * f64::from(index) / 40.0;
        let center = Vector3::from(TURNING[0].0);
        let position = center + 0.3 * Vector3::new(angle.cos(), angle.sin(), 0.6);
        path.push(pose_from_euler_zyx(position.into(), [angle, 0.75 * PI, 0.0]).unwrap());
    }
    let external = [turning(TURNING[0].0)].to_vec();
    let options = PlanOptions { external, ..PlanOptions::default() };
    let plan = robot.plan(&path, &options).unwrap();
    assert_meets(&robot, &path, &options, &plan);
    let fixed = robot.plan(&path, &PlanOptions::default());
    let bottleneck = fixed.map_or(f64::INFINITY, |fixed| fixed.bottleneck);
    assert!(plan.bottleneck < bottleneck, "{} {bottleneck}", plan.bottleneck);
    // Two axes and a track, one carrying the other, meet the poses too.
    let external = [track(3), turning(TURNING[0].0), turning(TURNING[1].0)].to_vec();
    let options = PlanOptions { external, ..PlanOptions::default() };
    let plan = robot.plan(&path[..8], &options).unwrap();
    assert_meets(&robot, &path[..8], &options, &plan);
}

#[test]
fn a_tolerance_never_raises_the_bottleneck_and_is_kept() {
    let (robot, mut rng) = (arm(), Rng::new(5));
    let cone = Some(ToolCone::new(0.3, 5).unwrap());
    let rotation = Some(ToolRotation::full(12).unwrap());
    let (mut better, mut gained) = (0, 0);
    for case in 0..24 {
        let path = random_path(&robot, &mut rng, 8, 0.05);
        let wide = if case % 2 == 0 {
            PlanOptions { cone, ..PlanOptions::default() }
        } else {
            PlanOptions { rotation, cone, ..PlanOptions::default() }
        };
        let narrow = PlanOptions { rotation: wide.rotation, ..PlanOptions::default() };
        let [narrow, plan] = [&narrow, &wide].map(|options| robot.plan(&path, options).ok());
        if let Some(plan) = &plan {
            assert_meets(&robot, &path, &wide, plan);
        }
        match (narrow, plan) {
            (Some(_), None) => panic!("case {case}: a plan is lost"),
            (Some(narrow), Some(plan)) => {
                // A rotation is refined around another path.
                let slack = if wide.rotation.is_some() { 1.3 } else { 1.0 + 1e-9 };
                assert!(plan.bottleneck <= narrow.bottleneck * slack, "case {case}");
                better += usize::from(plan.bottleneck < 0.9 * narrow.bottleneck);
            }
            (None, Some(_)) => gained += 1,
            (None, None) => {}
        }
    }
    assert!(better >= 8, "{better} better, {gained} gained");
}

#[test]
fn a_given_start_fixes_external_axes_and_the_tilt() {
    let (robot, path) = (arm(), long_seam(31));
    let external = [track(13)].to_vec();
    let cone = Some(ToolCone::new(0.2, 5).unwrap());
    let free = PlanOptions { external, cone, ..PlanOptions::default() };
    let [freedom, _] = freedoms(&free);
    let tool = freedom.tool(&path[0], &[-1.234, 0.05, -0.02, 0.0, 0.0, 0.0]);
    let start = robot.ik_nearest(&tool, &[0.0; 6], &[1.0; 6]).unwrap().q;
    let options =
        PlanOptions { start: Some(start), start_external: [-1.234].to_vec(), ..free.clone() };
    let plan = robot.plan(&path, &options).unwrap();
    assert_meets(&robot, &path, &options, &plan);
    assert!((plan.external[0][0] + 1.234).abs() < 1e-12);
    let [first, second] = plan.tolerance[0][..] else { panic!("{:?}", plan.tolerance[0]) };
    assert!((first - 0.05).abs() < 1e-9 && (second + 0.02).abs() < 1e-9);
    let off = largest(&steps(&plan.q[0].unwrap(), &start));
    assert!(off < 1e-15, "{off:e}");
    let without = PlanOptions { start: Some(start), ..free.clone() };
    let refused = |options: &PlanOptions| match robot.plan(&path, options) {
        Err(PlanError::Invalid(Error::InvalidPlan(fault))) => fault,
        other => panic!("{other:?}"),
    };
    assert!(matches!(refused(&without), PlanFault::EndExternal { found: 0, wanted: 1, .. }));
    let outside = PlanOptions { start: Some(start), start_external: [-1.7].to_vec(), ..free };
    assert!(matches!(
        refused(&outside),
        PlanFault::EndValue { index: 0, .. } | PlanFault::EndOff { .. }
    ));
}

#[test]
fn axes_that_make_no_sense_are_refused() {
    let fault = |made: Result<ExternalAxis, Error>| match made {
        Err(Error::InvalidPlan(fault)) => fault,
        other => panic!("{other:?}"),
    };
    let track =
        |direction, lower, upper, steps| ExternalAxis::track(direction, lower, upper, steps);
    let y = [0.0, 1.0, 0.0];
    assert!(matches!(fault(track([0.0; 3], 0.0, 1.0, 5)), PlanFault::AxisVector { index: 0, .. }));
    assert!(matches!(
        fault(track([0.0, f64::NAN, 0.0], 0.0, 1.0, 5)),
        PlanFault::AxisVector { index: 1, .. }
    ));
    assert!(matches!(fault(track(y, 1.0, 1.0, 5)), PlanFault::AxisRange { .. }));
    assert!(matches!(fault(track(y, 0.0, f64::INFINITY, 5)), PlanFault::AxisRange { .. }));
    assert!(matches!(fault(track(y, 0.0, 1.0, 1)), PlanFault::AxisSteps { found: 1, .. }));
    let axis = track(y, 0.0, 1.0, 5).unwrap();
    assert!(matches!(fault(axis.with_max_velocity(0.0)), PlanFault::AxisVelocity { .. }));
    assert!(matches!(fault(axis.with_weight(f64::NAN)), PlanFault::AxisWeight { .. }));
    let point = [f64::INFINITY, 0.0, 0.0];
    let positioner = ExternalAxis::positioner(point, y, 0.0, 1.0, 5);
    assert!(matches!(fault(positioner), PlanFault::AxisVector { field: "positioner point", .. }));
    assert!(ToolCone::new(15.0, 5).is_err() && ToolCone::new(0.2, 4).is_err());
    let many = PlanOptions { external: [axis; 4].to_vec(), ..PlanOptions::default() };
    assert!(arm().plan(&long_seam(3), &many).is_err());
}
