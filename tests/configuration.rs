//! Laws of ABB's confdata. `IRBKIN_POSES` sets the number of poses of each arm;
//! `make evidence SUITE=configurations` runs a hundred thousand.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::common::{Rng, apart, asked_set};
use irbkin::catalog::CatalogGeometry;
use irbkin::thresholds::CONFIGURATION_EDGE;
use irbkin::{
    Configuration, ConfigurationRequest, Error, FreeJoint, JointLimits, OpwParameters, Robot,
    Solution, Status, catalog,
};

const SLOTS: usize = 8;

fn poses() -> usize {
    std::env::var("IRBKIN_POSES").ok().map_or(300, |count| count.parse().unwrap())
}

fn irb2600() -> Robot<6> {
    Robot::named("IRB 2600-12/1.65").unwrap()
}

fn configuration(cf1: i32, cf4: i32, cf6: i32, cfx: i32) -> Configuration {
    Configuration { cf1, cf4, cf6, cfx }
}

/// Whether a joint vector has a configuration; an angle near an edge has both.
fn has(robot: &Robot<6>, q: &[f64; 6], wanted: Configuration) -> bool {
    let near = |angle: f64, cf: i32| {
        let quarters = f64::from(cf) * FRAC_PI_2;
        angle >= quarters - CONFIGURATION_EDGE - 1e-9
            && angle <= quarters + FRAC_PI_2 + CONFIGURATION_EDGE + 1e-9
    };
    let found = robot.configuration(q).unwrap();
    near(q[0], wanted.cf1)
        && near(q[3], wanted.cf4)
        && near(q[5], wanted.cf6)
        && found.cfx == wanted.cfx
}

/// Eight solutions have eight slots. A joint vector is the only one of its pose with its
/// configuration, 2 pi equivalents included, and is found by it. The configuration of a coupled arm
/// does not determine the elbow: the one in front is meant, because the linkage does not permit the
/// other.
#[test]
fn every_joint_vector_is_found_by_its_configuration() {
    let mut arms = 0;
    for arm in catalog().filter(|arm| matches!(arm.geometry, CatalogGeometry::Abb { .. })) {
        let robot: Robot<6> = Robot::from_catalog(&arm).unwrap();
        let twin = robot.clone().uncoupled();
        let (mut rng, mut eights, mut behind) = (Rng::new(11), 0, 0);
        for _ in 0..poses() {
            let q = rng.inside(robot.limits());
            if !robot.limits().contains(&q) {
                // The linkage does not permit it.
                continue;
            }
            let (pose, wanted) = (robot.fk(&q), robot.configuration(&q).unwrap());
            let solutions = robot.ik(&pose).unwrap();
            eights += usize::from(solutions.len() == SLOTS);
            for solution in &solutions {
                assert_eq!(
                    slot(&twin, &robot, &solution.q),
                    i32::from(u8::from(solution.slot)),
                    "{}: {q:?}",
                    arm.name
                );
            }
            let found = robot.ik_configured(&pose, wanted).unwrap();
            assert!(
                found.is_within_limits() && has(&robot, &found.q, wanted),
                "{}: {q:?} {found:?}",
                arm.name
            );
            if robot.is_coupled() && slot(&twin, &robot, &q) & 2 != 0 {
                behind += 1;
                continue;
            }
            let same = |turn: &Solution<6>| {
                robot.configuration(&turn.q).unwrap() == wanted
                    && slot(&twin, &robot, &turn.q) & 2 == wanted.cfx & 2
            };
            assert_eq!(solutions.turns().filter(same).count(), 1, "{}: {q:?}", arm.name);
            // Near a singularity, rounding of the pose is visible in the joints.
            let bound = 1e-9_f64.max(4e-15 * 5.0 / robot.singularity(&q).min_singular_value);
            assert!(
                apart(&found.q, &q) < bound && (found.q[5] - q[5]).abs() < 1.0,
                "{}: {q:?} {found:?}",
                arm.name
            );
        }
        assert!(robot.is_coupled() || behind == 0);
        assert!(eights > 0, "{}", arm.name);
        arms += 1;
        println!(
            "{:32} {:8} {} poses, {eights} of eight solutions, {behind} behind the elbow",
            arm.name,
            asked_set().name(),
            poses()
        );
    }
    assert!(arms > 80);
}

/// The slot of a joint vector by the configuration of the uncoupled arm.
fn slot(twin: &Robot<6>, robot: &Robot<6>, q: &[f64; 6]) -> i32 {
    let mut serial = *q;
    if robot.is_coupled() {
        serial[2] -= serial[1];
    }
    twin.configuration(&serial).unwrap().cfx
}

#[test]
fn quarter_turns_are_counted_from_below() {
    let robot = irb2600();
    let degrees =
        |q1: f64, q4: f64, q5: f64, q6: f64| [q1, 10.0, 20.0, q4, q5, q6].map(f64::to_radians);
    for (q, wanted) in [
        (degrees(0.0, 0.0, 30.0, 0.0), configuration(0, 0, 0, 0)),
        (degrees(-10.0, 89.9, 30.0, 90.0), configuration(-1, 0, 1, 0)),
        (degrees(180.0, -90.0, -30.0, -180.0), configuration(2, -1, -2, 1)),
        (degrees(-180.0, 270.0, 30.0, 399.0), configuration(-2, 3, 4, 0)),
        (degrees(-0.001, -271.0, -30.0, -399.0), configuration(-1, -4, -5, 1)),
    ] {
        assert_eq!(robot.configuration(&q).unwrap(), wanted, "{q:?}");
    }
    // Behind the lower arm from -(90 - atan(115 / 795)) deg on: -81.8 deg.
    let bent =
        |q3: f64| robot.configuration(&[0.1, 0.2, q3.to_radians(), 0.3, 0.4, 0.5]).unwrap().cfx;
    assert_eq!((bent(-81.7), bent(-81.9)), (0, 2));
}

#[test]
fn an_angle_on_an_edge_matches_both_quarter_turns() {
    let robot = irb2600();
    let off = 0.009_f64.to_radians();
    for edge in [-2, -1, 0, 1] {
        let far = 0.02_f64.to_radians();
        for (shift, below, above) in [
            (-far, true, false),
            (-off, true, true),
            (0.0, true, true),
            (off, true, true),
            (far, false, true),
        ] {
            let q4 = f64::from(edge) * FRAC_PI_2 + shift;
            let q = [0.3, 0.2, 0.1, q4, 0.5, 0.7];
            let answer = robot.ik_configured(&robot.fk(&q), configuration(0, edge - 1, 0, 0));
            assert_eq!(answer.is_ok(), below, "{edge} {shift}");
            if let Ok(answer) = answer {
                assert!((answer.q[3] - q4).abs() < 1e-9);
            }
            assert_eq!(
                robot.ik_configured(&robot.fk(&q), configuration(0, edge, 0, 0)).is_ok(),
                above,
                "{edge} {shift}"
            );
        }
    }
}

#[test]
fn axis_5_near_zero_matches_both_slots() {
    let robot = irb2600();
    for (q5, found) in [(0.005_f64, true), (-0.005, true), (0.02, false)] {
        let q = [0.3, 0.2, 0.1, 0.4, q5.to_radians(), 0.7];
        let other = i32::from(q5 > 0.0);
        let answer = robot.ik_configured(&robot.fk(&q), configuration(0, 0, 0, other));
        assert_eq!(answer.is_ok(), found, "{q5}");
        if let Ok(answer) = answer {
            assert!(apart(&answer.q, &q) < 1e-9);
        }
    }
}

#[test]
fn turns_are_chosen_by_the_configuration() {
    let robot = irb2600();
    for q6 in [-370.0_f64, -300.0, -10.0, 60.0, 350.0] {
        let q = [0.3, 0.2, 0.1, 0.4, 0.5, q6.to_radians()];
        let found = robot.ik_configured(&robot.fk(&q), robot.configuration(&q).unwrap()).unwrap();
        assert!((found.q[5] - q[5]).abs() < 1e-9, "{q6}: {:?}", found.q);
    }
    // Also without limits.
    let free = robot.with_limits(JointLimits::UNLIMITED);
    let q = [0.3, 0.2, 0.1, 40.0, 0.5, -70.0];
    let found = free.ik_configured(&free.fk(&q), free.configuration(&q).unwrap()).unwrap();
    assert!((found.q[3] - 40.0).abs() < 1e-9 && (found.q[5] + 70.0).abs() < 1e-9, "{:?}", found.q);
}

#[test]
fn at_a_wrist_singularity_axes_4_and_6_take_the_named_quarter_turns() {
    let robot = irb2600();
    for (q4, q6) in [(0.4, 0.7), (2.0, -1.2), (-2.5, 3.3), (-0.2, -4.0)] {
        let q = [0.3, 0.2, 0.1, q4, 0.0, q6];
        let pose = robot.fk(&q);
        let wanted = robot.configuration(&q).unwrap();
        // At the singularity the slot with q5 < 0 is the same solution, with an axis 5 that is zero
        // from below.
        for cfx in [0, 1] {
            let wanted = Configuration { cfx, ..wanted };
            let found = robot.ik_configured(&pose, wanted).unwrap();
            assert!(has(&robot, &found.q, wanted), "{found:?}");
            assert!(found.status.contains(Status::WRIST));
            assert!(robot.residual(&found.q, &pose).largest() < 1e-14);
        }
    }
}

#[test]
fn at_a_shoulder_singularity_axis_1_takes_the_named_quarter_turn() {
    let arm = OpwParameters::abb(0.0, -0.07, 0.29, 0.27, 0.302, 0.072);
    let robot = Robot::from_opw(arm).unwrap();
    // The wrist center above axis 1.
    let pose = irbkin::pose::from_wxyz([0.0, 0.0, 0.7 + 0.072], [1.0, 0.0, 0.0, 0.0]).unwrap();
    for cf1 in [-2, -1, 0, 1] {
        let existing = robot.ik(&pose).unwrap();
        assert!(existing.iter().all(|solution| solution.status.contains(Status::SHOULDER)));
        let quarters = [-2, -1, 0, 1];
        let reached =
            quarters.iter().flat_map(|cf4| quarters.map(|cf6| configuration(cf1, *cf4, cf6, 0)));
        let found: Vec<_> = reached
            .filter_map(|wanted| {
                robot.ik_configured(&pose, wanted).ok().map(|found| (wanted, found))
            })
            .collect();
        assert!(!found.is_empty(), "{cf1}");
        for (wanted, found) in found {
            assert!(has(&robot, &found.q, wanted), "{wanted} {found:?}");
            assert!(robot.residual(&found.q, &pose).largest() < 1e-14);
        }
    }
}

#[test]
fn the_error_lists_the_configurations_that_exist() {
    let robot = irb2600();
    let q = [0.3, 0.2, 0.1, 0.4, 0.5, 0.7];
    let Err(Error::NoConfiguration(none)) =
        robot.ik_configured(&robot.fk(&q), configuration(3, 0, 0, 0))
    else {
        unreachable!()
    };
    assert!(none.existing.contains(&configuration(0, 0, 0, 0)) && !none.more);
    let turns = robot.ik(&robot.fk(&q)).unwrap().turns().count();
    assert_eq!(none.existing.len(), turns);
    assert!(Error::NoConfiguration(none).to_string().starts_with(
        "no solution inside the limits has the configuration [3, 0, 0, 0]; there are [0, -4, "
    ));
    let nearest = robot
        .ik_configured(
            &robot.fk(&q),
            ConfigurationRequest::from(configuration(3, 0, 0, 0)).or_nearest(q),
        )
        .unwrap();
    assert!(apart(&nearest.q, &q) < 1e-9);
    let far = irbkin::pose::from_wxyz([9.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]).unwrap();
    assert!(matches!(
        robot.ik_configured(&far, configuration(0, 0, 0, 0)),
        Err(Error::Unreachable(_))
    ));
    assert!(matches!(
        robot.ik_configured(
            &far,
            ConfigurationRequest::from(configuration(0, 0, 0, 0)).or_nearest(q)
        ),
        Err(Error::Unreachable(_))
    ));
}

#[test]
fn the_list_has_each_configuration_once_and_names_a_free_joint() {
    let wide = irb2600().with_limits(JointLimits::new([[-7.0, 7.0]; 6]).unwrap());
    let q = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6];
    let listed = |robot: &Robot<6>, q: &[f64; 6]| match robot
        .ik_configured(&robot.fk(q), configuration(9, 0, 0, 0))
    {
        Err(Error::NoConfiguration(none)) => none,
        other => unreachable!("{other:?}"),
    };
    let none = listed(&wide, &q);
    let once = |of: &[Configuration]| of.iter().enumerate().all(|(i, one)| !of[..i].contains(one));
    assert!(
        none.more
            && none.free.is_none()
            && none.existing.len() == irbkin::NoConfiguration::MOST
            && once(&none.existing)
    );
    let by_turns: Vec<_> = wide
        .ik(&wide.fk(&q))
        .unwrap()
        .turns()
        .map(|turn| wide.configuration(&turn.q).unwrap())
        .collect();
    assert!(none.existing.iter().all(|one| by_turns.contains(one)));
    let singular = listed(&irb2600(), &[0.1, 0.2, 0.3, 1.0, 0.0, 0.5]);
    assert_eq!(singular.free, Some(irbkin::FreeJoint::WristSum));
    assert!(
        Error::NoConfiguration(singular)
            .to_string()
            .ends_with(", and others with other angles of J4, which is free at this pose")
    );
}

/// Near the singularity, where only another member of the self-motion is inside the limits.
#[test]
fn a_self_motion_with_members_inside_the_limits_is_reachable() {
    let mut limits = irb2600().limits().to_array();
    (limits[3], limits[5]) = ([2.0, 2.1], [-0.6, -0.5]);
    let robot = irb2600().with_limits(JointLimits::new(limits).unwrap());
    for q5 in [0.0, 1e-11, 1e-9, -1e-9] {
        let pose = irb2600().fk(&[0.1, 0.2, 0.3, 1.0, q5, 0.5]);
        let seed = [0.1, 0.2, 0.3, 2.05, 0.0, -0.55];
        let Err(Error::NoConfiguration(none)) =
            robot.ik_configured(&pose, configuration(3, 0, 0, 0))
        else {
            unreachable!("{q5}")
        };
        assert_eq!((none.existing[0].cf4, none.existing[0].cf6), (1, -1));
        assert!(
            robot
                .ik_configured(
                    &pose,
                    ConfigurationRequest::from(configuration(3, 0, 0, 0)).or_nearest(seed)
                )
                .is_ok()
        );
    }
}

#[test]
fn large_multiples_of_a_quarter_turn_belong_to_the_quarter_turn_they_begin() {
    let robot = irb2600().with_limits(JointLimits::UNLIMITED);
    for quarters in -400..=400 {
        let q = [(f64::from(quarters) * 90.0).to_radians(), 0.0, 0.0, 0.0, 0.0, 0.0];
        assert_eq!(robot.configuration(&q).unwrap().cf1, quarters);
    }
    let far = robot
        .ik_configured(&robot.fk(&[0.1; 6]), configuration(0, 0, 2_000_000_000, 0))
        .unwrap_err();
    assert_eq!(far.to_string(), "configuration: cf6 is 2000000000, it must be -63661 to 63661");
}

#[test]
fn configurations_that_the_arm_cannot_have_are_refused() {
    let robot = irb2600();
    let message = |answer: Result<Configuration, Error>| answer.unwrap_err().to_string();
    let refused = |robot: &Robot<6>, cfx| {
        robot
            .ik_configured(&robot.fk(&[0.1; 6]), configuration(0, 0, 0, cfx))
            .unwrap_err()
            .to_string()
    };
    assert_eq!(refused(&robot, 11), "configuration: cfx is 11, it must be 0 to 7");
    assert_eq!(refused(&robot, -1), "configuration: cfx is -1, it must be 0 to 7");
    let coupled = Robot::from_opw(OpwParameters::abb(0.1, -0.135, 0.615, 0.705, 0.755, 0.085))
        .unwrap()
        .coupled()
        .unwrap();
    assert_eq!(
        refused(&coupled, 2),
        "configuration: cfx is 2, it must be 0 for a robot with coupled axes 2 and 3"
    );
    let ur3 = Robot::named("UR3").unwrap();
    assert_eq!(
        message(ur3.configuration(&[0.1; 6])),
        "this robot has no ABB configuration: its structure is \"three parallel axes\", not a \
         six-axis arm with a spherical wrist (the slot of a solution names its branch)"
    );
    assert_eq!(
        message(robot.configuration(&[f64::NAN; 6])),
        "q: joint 1 is NaN, every angle must be finite [rad]"
    );
}

#[test]
fn the_configuration_of_a_coupled_arm_has_no_slot() {
    let robot = Robot::from_opw(OpwParameters::abb(0.1, -0.135, 0.615, 0.705, 0.755, 0.085))
        .unwrap()
        .coupled()
        .unwrap();
    let robot = robot.with_limits(JointLimits::new([[-PI, PI]; 6]).unwrap());
    let q = [0.3, 0.4, 0.2, 0.5, -0.6, 0.7];
    assert_eq!(robot.configuration(&q).unwrap(), configuration(0, 0, 0, 0));
    assert!(
        apart(&robot.ik_configured(&robot.fk(&q), configuration(0, 0, 0, 0)).unwrap().q, &q)
            < 1e-12
    );
}

#[test]
fn two_axes_of_a_yumi_on_one_line_leave_a_joint_free() {
    let robot = Robot::<7>::named("IRB 14050").unwrap();
    for (degrees, free) in [
        ([20.0, -60.0, 40.0, 10.0, 30.0, 0.0, 50.0], FreeJoint::LastSum),
        ([20.0, 0.0, 40.0, 10.0, 30.0, 50.0, 70.0], FreeJoint::ShoulderSum),
    ] {
        let q = degrees.map(f64::to_radians);
        let (pose, arm_angle) = (robot.fk(&q), robot.arm_angle(&q).unwrap().unwrap());
        let request = ConfigurationRequest::from(robot.configuration(&q).unwrap());
        let found = robot.ik_configured(&pose, request.at_arm_angle(arm_angle).near(q)).unwrap();
        assert_eq!(found.free_joint, Some(free));
        assert!(found.q.iter().zip(q).all(|(found, q)| (found - q).abs() < 1e-6), "{found:?}");
        let moved = robot.with_free_joint(&pose, &found, 0.1).unwrap().unwrap();
        assert!((moved.q[free.joint() - 1] - 0.1).abs() < 1e-15);
        assert!(robot.residual(&moved.q, &pose).largest() < 1e-12);
        assert!((robot.arm_angle(&moved.q).unwrap().unwrap() - arm_angle).abs() < 1e-9);
    }
}
