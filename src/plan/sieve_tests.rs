//! Laws of the bound along some poses of a path (docs/plan.md, eq. 9, 10).

use super::caller::{Caller, Watch};
use super::carrier::ExternalAxis;
use super::ends::Given;
use super::freedom::Freedom;
use super::nodes::Arm;
use super::options::{PlanOptions, ToolRotation};
use super::planner::Planner;
use super::robot::waypoints;
use super::sieve::may_be_passed;
use super::turns::PlannedJoints;
use crate::kinematics::Robot;
use crate::paths::{Spacing, line};
use crate::rng::Rng;

#[test]
fn no_way_is_better_than_its_bound() {
    let names = ["IRB 2600-12/1.65", "UR5e"];
    let (mut rng, mut ways, mut tight) = (Rng::new(21), 0, 0);
    for case in 0..120 {
        let robot: Robot<6> = Robot::named(names[case % 2]).unwrap();
        let q: [f64; 6] = core::array::from_fn(|_| rng.between(-2.0, 2.0));
        let end = q.map(|angle| angle + rng.between(-0.7, 0.7));
        let spacing = Spacing::count(64 + case).unwrap();
        let Ok(path) = line(&robot.fk(&q), &robot.fk(&end), spacing, None) else { continue };
        let mut options = PlanOptions::default();
        if case % 3 < 2 {
            options.rotation = Some(ToolRotation::full(12).unwrap());
        }
        if case % 3 > 0 {
            let track = ExternalAxis::track([0.0, 1.0, 0.0], -0.2, 0.2, 5);
            options.external.push(track.unwrap());
            options.start_external.push(0.0);
        }
        if case % 4 == 0 {
            options.start = Some(q);
        }
        let joints = PlannedJoints::of(&robot, [1.0; 6]);
        let freedom = Freedom::of(&options);
        let watch = Watch::default();
        let arm = Arm { robot: &robot, joints: &joints, freedom: &freedom, soft: None, watch };
        let points = waypoints(&path, &options);
        let Ok(given) = Given::both(&arm, &points, &options) else { continue };
        let mut planner = Planner::new(arm, &points, &options, &given).unwrap();
        let mut caller = Caller { accept: None, watch };
        let Some(way) = planner.whole_way(&mut caller).unwrap() else { continue };
        let is_passed =
            |part: f64| may_be_passed(arm, &points, &given, part * way.bottleneck).unwrap();
        assert!(is_passed(1.0) && is_passed(1.5), "case {case}: {}", way.bottleneck);
        ways += 1;
        tight += usize::from(!is_passed(0.8));
    }
    assert!(ways > 40 && tight > 10, "{tight} of {ways} bounds are within a fifth");
}
