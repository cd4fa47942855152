//! The words of errors: a row for each message with a computed part.

use std::string::ToString;
use std::{vec, vec::Vec};

use super::*;
use crate::catalog::LeftOut;
use crate::report::{Approach, Configuration, FreeJoint, Reach};

fn unreachable(explanation: Explanation) -> Error {
    Error::Unreachable(explanation)
}

#[test]
fn messages_of_poses_joints_and_answers() {
    let far = |shortfall| unreachable(Explanation::OutOfReach(Reach::TooFar { shortfall }));
    let none = |certified, approach| unreachable(Explanation::NoRoots { certified, approach });
    let approach = Some(Approach { position: 0.012, rotation: 0.02 });
    let existing =
        vec![Configuration { cf1: 0, cf4: -1, cf6: 0, cfx: 1 }, Configuration::default()];
    let wanted = Configuration { cf1: 2, ..Configuration::default() };
    check(&[
        (
            PoseFault::TooFar { field: "pose", index: 0, value: 2e6, bound: 1e6 }.into(),
            "pose[0, 3] is 2e6 m, its size must be at most 1e6 m",
        ),
        (
            PoseFault::TooFar { field: "xyz", index: 2, value: 2e6, bound: 1e6 }.into(),
            "xyz[2] is 2e6 m, its size must be at most 1e6 m",
        ),
        (
            PoseFault::LastRow { row: [0.5, 0.0, 2e-9, 1.0], transposed: true }.into(),
            "pose row 3 must be [0, 0, 0, 1], got [0.5, 0, 0.000000002, 1], and column 3 is \
             [0, 0, 0, 1] (is it transposed?)",
        ),
        (
            JointFault::Configuration { field: "cfx", value: 3, bounds: [0, 0] }.into(),
            "configuration: cfx is 3, it must be 0 for a robot with coupled axes 2 and 3",
        ),
        (
            JointFault::Configuration { field: "cfx", value: 9, bounds: [0, 7] }.into(),
            "configuration: cfx is 9, it must be 0 to 7",
        ),
        (far(0.012), "wrist center 12.0 mm beyond reach"),
        (far(2e-6), "wrist center 2.0e-3 mm beyond reach"),
        (
            far(1423.4115),
            "wrist center 1423411.5 mm beyond reach (is the pose in millimeters? meters are \
             wanted)",
        ),
        (
            unreachable(Explanation::OutOfReach(Reach::TooNear { shortfall: 0.012 })),
            "wrist center 12.0 mm too near to be reached",
        ),
        (
            unreachable(Explanation::OutOfReach(Reach::NoRoots)),
            "out of reach: no closed form; 0 real roots",
        ),
        (
            none(true, approach),
            "out of reach: no closed form; 0 real roots; nearest approach 12.0 mm and 1.1 deg",
        ),
        (none(false, None), "no solution found, which is not certain: no closed form"),
        (unreachable(Explanation::Found { solutions: 1, inside: 1 }), "1 solution, inside limits"),
        (
            unreachable(Explanation::Found { solutions: 8, inside: 4 }),
            "8 solutions, 4 inside limits",
        ),
        (
            NoConfiguration { wanted, existing, more: true, free: Some(FreeJoint::WristSum) }
                .into(),
            "no solution inside the limits has the configuration [2, 0, 0, 0]; there are \
             [0, -1, 0, 1], [0, 0, 0, 0] and more, and others with other angles of J4, which is \
             free at this pose",
        ),
    ]);
}

#[test]
fn messages_of_models() {
    let infinite = |value| ModelFault::NoLimit {
        field: "upper limit of joint",
        index: 5,
        value,
        none: f64::INFINITY,
    };
    let unknown = |close: &[&'static str], left_out| UnknownRobot {
        name: "IRB".into(),
        close: close.to_vec(),
        left_out,
    };
    check(&[
        (
            ModelFault::NotFinite { field: "a1", index: 0, value: f64::NAN }.into(),
            "a1 is NaN, it must be finite",
        ),
        (
            ModelFault::TooLarge { field: "a of row", index: 2, value: 1e100, bound: 1e6 }.into(),
            "a of row 2 is 1e100, its size must be at most 1e6",
        ),
        (
            ModelFault::Degrees { field: "alpha of row", index: 2, value: 180.0 }.into(),
            "alpha of row 2 is 180 rad, a multiple of 15 must be at most 12.57 rad (did you pass \
             degrees? 180 deg is 3.141592653589793 rad)",
        ),
        (
            infinite(f64::NAN).into(),
            "upper limit of joint 5 is NaN, it must not be NaN (inf is allowed: no limit)",
        ),
        (
            infinite(f64::NEG_INFINITY).into(),
            "upper limit of joint 5 is -inf, it must be finite (inf is allowed: no limit)",
        ),
        (
            ModelFault::NoConfiguration { structure: "general", snap: None }.into(),
            "this robot has no ABB configuration: its structure is \"general\", not a six-axis arm \
             with a spherical wrist, nor a GoFa or YuMi of the catalog (the slot of a solution \
             names its branch)",
        ),
        (
            ModelFault::NearlyParallel {
                axes: (2, 3),
                off: 4.6e-8,
                distance: 1.5e7,
                bound: 1e6,
                snap: None,
            }
            .into(),
            "axes 2 and 3 are 4.6e-8 rad off parallel, their common normal is 1.5e7 m away, it \
             must be at most 1e6 m (are the angles written with all their digits?)",
        ),
        (
            ModelFault::FarFromNominal { position: 0.7, rotation: 0.3, bound: [0.1, 0.05] }.into(),
            "the tool is up to 0.700 m and 0.300 rad from the tool of the nominal robot, it must \
             be at most 0.100 m and 0.05 rad (is it the same arm, with the same zero pose?)",
        ),
        (
            unknown(&["IRB 140", "IRB 120"], None).into(),
            "unknown robot \"IRB\"; close names: \"IRB 140\", \"IRB 120\"",
        ),
        (
            unknown(&[], Some(LeftOut { name: "IRB 460", reason: "four axes" })).into(),
            "unknown robot \"IRB\"; left out of the catalog: IRB 460: four axes",
        ),
    ]);
}

fn check(rows: &[(Error, &str)]) {
    let wrong: Vec<_> = rows.iter().filter(|(error, words)| error.to_string() != *words).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}
