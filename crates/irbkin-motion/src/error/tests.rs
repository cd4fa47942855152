//! The words of errors: a row for each message with a computed part.

use std::f64::consts::PI;
use std::string::ToString;
use std::{vec, vec::Vec};

use super::*;

#[cfg(feature = "urdf")]
#[test]
fn messages_of_urdf() {
    check(&[
        (
            UrdfFault::NoTip {
                base: "b".into(),
                wanted: vec![6, 7],
                ends: ["\"e\" (5)"].into_iter().collect(),
                most: 5,
                grips: false,
            }
            .into(),
            "URDF: 6 or 7 revolute joints lead from \"b\" to no end of a chain: \"e\" (5); 5 are not \
             enough, since a pose has six coordinates",
        ),
        (
            UrdfFault::Loop { links: (0..14).collect() }.into(),
            "URDF: the links 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11 and 2 more form a loop, they \
             must form a tree",
        ),
    ]);
}

#[test]
fn messages_of_motions_and_plans() {
    check(&[
        (
            MotionFault::NotPositive { field: "dt", index: None, value: 0.0 }.into(),
            "dt is 0.0, it must be positive and finite",
        ),
        (
            MotionFault::NotPositive { field: "max_velocity", index: Some(2), value: -1.0 }.into(),
            "max_velocity[2] is -1.0, it must be positive",
        ),
        (
            MotionFault::Row { row: 3, fault: JointFault::Weight { joint: 2, value: -1.0 } }.into(),
            "row 3 of weights: joint 2 is -1, a weight must be finite and not negative",
        ),
        (
            MotionFault::HalfTurn { index: 1, angle: PI }.into(),
            "the tool turns by 180.000000 deg to pose 1, there are two ways: give axis, or a pose \
             between them",
        ),
        (
            MotionFault::NoStep { length: 0.0, angle: 0.5 }.into(),
            "a part of the path is 0 m long and turns by 28.647890 deg: give turn, or steps",
        ),
        (
            PlanFault::EndOff { field: "start", position: 0.02, rotation: 0.1, bound: 1e-6 }.into(),
            "start brings the tool 20.000 mm and 5.7296 deg off the pose there, 1e-6 m and rad are \
             allowed: take a joint vector of that pose",
        ),
        (
            PlanFault::AxisSteps { field: "tool cone", found: 2, bounds: [3, 41] }.into(),
            "tool cone: steps must be 3 to 41, got 2, and odd",
        ),
    ]);
}

fn check(rows: &[(Error, &str)]) {
    let wrong: Vec<_> = rows.iter().filter(|(error, words)| error.to_string() != *words).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}
