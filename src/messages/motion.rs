//! Messages of trajectories and paths of the tool.

use super::{Row, Table, rows};
use crate::error::{JointFault, MotionFault};

pub(super) fn tables() -> [Table; 1] {
    [Table { name: "motion", rows: faults() }]
}

fn faults() -> std::vec::Vec<Row> {
    rows! { MotionFault;
        MotionFault::NotFinite { .. } =>
            MotionFault::NotFinite { field: "t", index: 3, value: f64::NAN },
            "an angle, a time or a velocity", "leave it out, or repair it";
        MotionFault::NotPositive { index: Some(_), .. } =>
            MotionFault::NotPositive { field: "max_velocity", index: Some(2), value: -1.0 },
            "a limit; infinity is none", "give its size";
        MotionFault::NotPositive { index: None, .. } =>
            MotionFault::NotPositive { field: "duration", index: None, value: 0.0 },
            "a duration, a factor, a step", "give a positive one; for no motion, one pose";
        MotionFault::TooFew { .. } => MotionFault::TooFew { field: "q", found: 1, least: 2 },
            "waypoints, poses or `steps`", "give more";
        MotionFault::NoJoints { .. } => MotionFault::NoJoints { field: "q0" },
            "empty joint vectors", "give at least one joint";
        MotionFault::Row { .. } => MotionFault::Row {
            row: 3, fault: JointFault::NotFinite { field: "q", joint: 2, value: f64::NAN },
        }, "`spline`, `retime`; in Python an `InvalidJointsError`", "leave the row out, or repair it";
        MotionFault::Steps { .. } => MotionFault::Steps { found: 1, bounds: [2, 10_000_000] },
            "`steps`; a polyline needs one for each of its parts",
            "give a count between; `sample` a trajectory where you need more";
        MotionFault::Duration { .. } =>
            MotionFault::Duration { value: 1e12, bounds: [1e-9, 1e9] },
            "a duration or limits in another unit", "give rad, s and their derivatives";
        MotionFault::Overflow => MotionFault::Overflow,
            "velocities of 1e300, times 1e-300 s apart", "give rad and s";
        MotionFault::NoDuration { .. } => MotionFault::NoDuration { joint: 1 },
            "limits that are all infinite", "give a finite one, or `duration`";
        MotionFault::AboveLimit { .. } => MotionFault::AboveLimit {
            joint: 2, what: "velocity", value: 3.75, limit: 3.0,
        }, "a duration together with limits", "give one of both, or a longer duration";
        MotionFault::Profile { .. } =>
            MotionFault::Profile { profile: "trapezoid", field: "velocity at an end" },
            "`start_velocity` and the like", "take another profile";
        MotionFault::Apart { .. } =>
            MotionFault::Apart { joint: 4, gap: 0.1, bound: 1e-9 },
            "the sum of two trajectories", "begin the second where the first ends";
        MotionFault::Slice { .. } => MotionFault::Slice { start: 1.5, end: 1.0, bound: 2.0 },
            "`slice`", "give start < end, both inside";
        MotionFault::Order { .. } => MotionFault::Order { index: 2, value: 0.5, before: 0.5 },
            "`t` of a spline", "give times that increase";
        MotionFault::Repeats { .. } => MotionFault::Repeats { index: 3 },
            "a spline without `t`", "give `t`, or leave the waypoint out";
        MotionFault::HalfTurn { .. } =>
            MotionFault::HalfTurn { index: 1, angle: core::f64::consts::PI },
            "`line`, `arc`, `polyline`, `spline`", "give `axis` to `line`, or a pose between the two";
        MotionFault::Axis { .. } => MotionFault::Axis { along: 0.0 },
            "`axis` of `line`", "give one that points more along that of the turn";
        MotionFault::TooMany { .. } => MotionFault::TooMany { found: 2e9, most: 1e7 },
            "a step that is too small", "give a longer one, in m and rad";
        MotionFault::ToolStill { .. } =>
            MotionFault::ToolStill { row: 7, way: 0.0, bound: 1e-9 },
            "`at_tool_speed`, `tool_speed_limits`, `retime` with `max_tool_speed`",
            "split the path where the tool only turns";
        MotionFault::ToolSpeed { .. } =>
            MotionFault::ToolSpeed { joint: 4, row: 512, most: 0.213, asked: 0.25 },
            "`at_tool_speed`", "give `tool_speed_limits(...).fastest`, or less";
        MotionFault::NoStep { .. } => MotionFault::NoStep { length: 0.0, angle: 0.5 },
            "`step` where the tool only turns", "give `turn` too, or `steps`";
        MotionFault::NoMaxVelocity => MotionFault::NoMaxVelocity,
            "`rapid.motion` with a robot that is not of the catalog", "give `max_velocity`";
        MotionFault::Zone { .. } => MotionFault::Zone { index: 1, value: -0.05 },
            "`zones` of `polyline`", "give radii in m, or ABB's names";
        MotionFault::Collinear { .. } => MotionFault::Collinear { off: 0.0, bound: 4e-7 },
            "`arc`", "take a line, or a point off it";
    }
}
