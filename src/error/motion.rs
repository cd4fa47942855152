//! Arguments of trajectories, paths and plans that are refused.

use core::fmt;

use thiserror::Error;

use super::{JointFault, PoseFault};

/// Why an argument of a trajectory or a path is refused. Lengths in meters, angles in radians,
/// times in seconds; rows, poses and elements count from 0, joints from 1.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum MotionFault {
    #[error("{field}[{index}] is {value}: every element must be finite")]
    NotFinite { field: &'static str, index: usize, value: f64 },
    /// `index`: of one among several.
    #[error(
        "{field}{} is {value:?}, it must be positive{}",
        At(*.index),
        if .index.is_none() { " and finite" } else { "" }
    )]
    NotPositive { field: &'static str, index: Option<usize>, value: f64 },
    #[error("{field} has {found} rows, it must have at least {least}")]
    TooFew { field: &'static str, found: usize, least: usize },
    #[error("{field} has no joints, it must have at least 1")]
    NoJoints { field: &'static str },
    #[error("row {row} of {fault}")]
    Row { row: usize, fault: JointFault },
    #[error("steps must be {} to {}, got {found}", .bounds[0], .bounds[1])]
    Steps { found: usize, bounds: [usize; 2] },
    #[error(
        "the motion takes {value:e} s, it must take {:e} to {:e} s: are the limits and the \
         duration in rad and s?",
        .bounds[0], .bounds[1]
    )]
    Duration { value: f64, bounds: [f64; 2] },
    #[error(
        "the motion is not finite: its velocities or accelerations are too large, or its times too \
         close"
    )]
    Overflow,
    #[error("joint {joint} moves and has no limit: give a duration, or limits that bind it")]
    NoDuration { joint: usize },
    /// `what`: "velocity", "acceleration" or "jerk".
    #[error(
        "joint {joint} reaches a {what} of {value:?}, its limit is {limit:?} (excess {:.2e}): give a \
         longer duration, or limits without a duration",
        .value - .limit
    )]
    AboveLimit { joint: usize, what: &'static str, value: f64, limit: f64 },
    /// `value` and `limit`: angles; `time`: since the start of the motion.
    #[error(
        "joint {joint} is at {value:.9} rad at {time:.6} s, its limit is {limit:.9} rad (excess \
         {:.2e} rad): keep the ends and the waypoints farther from the limit, or give more waypoints \
         where the curve swings out between them",
        (.value - .limit).abs()
    )]
    Outside { joint: usize, time: f64, value: f64, limit: f64 },
    #[error("limits of joint {joint} are {lower:?} and {upper:?}, lower must not exceed upper")]
    EmptyLimit { joint: usize, lower: f64, upper: f64 },
    /// `along`: its velocity at the same pace along the path.
    #[error(
        "{field}: joint {joint} has {value:?} rad/s, in the direction of the path it would have \
         {along:?} rad/s: the path cannot be left, give a multiple of its direction"
    )]
    OffPath { field: &'static str, joint: usize, value: f64, along: f64 },
    /// `part`: how much of the velocity the limits allow.
    #[error(
        "{field} is too fast for the path and its limits, {part:.6} of it is possible: lower it, \
         raise a limit, or give a longer path"
    )]
    EndTooFast { field: &'static str, part: f64 },
    #[error("{field} must be zero with max_jerk: such a motion goes from rest to rest")]
    JerkAtEnd { field: &'static str },
    #[error("the motion was stopped")]
    Stopped,
    #[error(
        "a {profile} profile takes no {field}: use \"quintic\" for velocities and accelerations at \
         the ends, \"cubic\" for velocities"
    )]
    Profile { profile: &'static str, field: &'static str },
    #[error(
        "joint {joint} would jump by {gap:.3e} rad, trajectories are joined within {bound:.0e} rad"
    )]
    Apart { joint: usize, gap: f64, bound: f64 },
    #[error("a slice from {start} s to {end} s must be inside 0 s to {bound} s and not empty")]
    Slice { start: f64, end: f64, bound: f64 },
    #[error("t[{index}] is {value} s, it must be later than {before} s")]
    Order { index: usize, value: f64, before: f64 },
    #[error("q[{index}] repeats the waypoint before it: give t, or leave it out")]
    Repeats { index: usize },
    #[error(
        "the tool turns by {:.6} deg to pose {index}, there are two ways: give axis, or a pose \
         between them",
        .angle.to_degrees()
    )]
    HalfTurn { index: usize, angle: f64 },
    #[error(
        "axis has a part of {along:.1e} along the axis of the half turn, it must have at least 1e-6"
    )]
    Axis { along: f64 },
    #[error(
        "the path has {found:.1e} poses, at most {most:.0e} are given: is step in m, or speed in \
         m/s and dt in s?"
    )]
    TooMany { found: f64, most: f64 },
    /// The tool moves by `way` to the row.
    #[error(
        "the tool moves by {way:.1e} m to row {row} of q, where its joints move, it must move by \
         at least {bound:.0e} m for its speed to time them: give joint limits or a duration to a \
         part in which the tool only turns"
    )]
    ToolStill { row: usize, way: f64, bound: f64 },
    /// The row is the last one before the place.
    #[error(
        "joint {joint} allows {most:?} m/s at row {row} of q, {asked:?} m/s is asked: give a \
         lower speed, or retime with max_tool_speed, which is slower there"
    )]
    ToolSpeed { joint: usize, row: usize, most: f64, asked: f64 },
    #[error(
        "a part of the path is {length} m long and turns by {:.6} deg: give {}, or steps",
        .angle.to_degrees(), if *.length > 0.0 { "step" } else { "turn" }
    )]
    NoStep { length: f64, angle: f64 },
    #[error("the robot has no joint velocities: give max_velocity, in rad/s")]
    NoMaxVelocity,
    #[error("zones[{index}] is {value:?}, it must be finite and not negative")]
    Zone { index: usize, value: f64 },
    /// `off`: distance of the second point from the line through the others.
    #[error(
        "the three points of an arc must not lie on a line: the second is {off:.1e} m off it, at \
         least {bound:.0e} m is wanted"
    )]
    Collinear { off: f64, bound: f64 },
}

/// Why an argument of a plan is refused. Lengths in meters, angles in radians, times in seconds;
/// poses and axes count from 0, joints from 1; `bounds` are the least and the largest value.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum PlanFault {
    #[error("the path has 0 poses, it must have at least 1")]
    NoPoses,
    #[error("pose {index} of the path: {fault}")]
    Pose { index: usize, fault: PoseFault },
    #[error("times[{index}] is {value} s, it must be finite and later than {before} s")]
    Time { index: usize, value: f64, before: f64 },
    #[error(
        "steps of the tool rotation must be {} to {}, got {found}: one step is one angle, lower == \
         upper",
        .bounds[0], .bounds[1]
    )]
    RotationSteps { found: usize, bounds: [usize; 2] },
    #[error(
        "the tool rotation from {lower} to {upper} rad must not be empty, and not more than a full \
         turn: did you pass degrees?"
    )]
    RotationRange { lower: f64, upper: f64 },
    /// `rotation`: from the orientation, or out of the free rotation.
    #[error(
        "{field} brings the tool {:.3} mm and {:.4} deg off the pose there, {bound:.0e} m and rad \
         are allowed: take a joint vector of that pose",
        1e3 * .position, .rotation.to_degrees()
    )]
    EndOff { field: &'static str, position: f64, rotation: f64, bound: f64 },
    #[error(
        "{field} turns the tool by {:.3} deg, the tool rotation allows {:.3} to {:.3} deg",
        .angle.to_degrees(), .bounds[0].to_degrees(), .bounds[1].to_degrees()
    )]
    EndAngle { field: &'static str, angle: f64, bounds: [f64; 2] },
    /// In rad^2/s^2.
    #[error("{field} must be finite and not negative, got {value}")]
    Cost { field: &'static str, value: f64 },
    #[error(
        "{field}: the range from {lower} to {upper} (m or rad) must not be empty, its ends must be \
         at most {most}"
    )]
    AxisRange { field: &'static str, lower: f64, upper: f64, most: f64 },
    #[error(
        "{field}: steps must be {} to {}, got {found}{}",
        .bounds[0], .bounds[1], if *.field == "tool cone" { ", and odd" } else { "" }
    )]
    AxisSteps { field: &'static str, found: usize, bounds: [usize; 2] },
    #[error(
        "{field}: element {index} is {value}, a direction must have a length and all elements must \
         be finite"
    )]
    AxisVector { field: &'static str, index: usize, value: f64 },
    #[error(
        "max_velocity of an external axis must be positive and finite, got {value} (m/s or rad/s)"
    )]
    AxisVelocity { value: f64 },
    #[error("weight of an external axis must be finite and not negative, got {value}")]
    AxisWeight { value: f64 },
    #[error(
        "the angle of the tool cone must be above 0 and at most {most:.4} rad, got {angle}: did \
         you pass degrees?"
    )]
    ConeAngle { angle: f64, most: f64 },
    #[error("there may be at most {most} external axes, got {found}")]
    External { found: usize, most: usize },
    #[error(
        "{field} must have 6 joint angles and a value for each of {wanted} external axes, got \
         {found} such values"
    )]
    EndExternal { field: &'static str, found: usize, wanted: usize },
    /// Axes are the external ones, then tilts, then the offset.
    #[error(
        "{field}: free axis {index} (external axes, tilts, offset) is at {value:.6}, its range is \
         {:.6} to {:.6} (m or rad)",
        .bounds[0], .bounds[1]
    )]
    EndValue { field: &'static str, index: usize, value: f64, bounds: [f64; 2] },
    #[error(
        "poses, tool angles and values of axes make {found} nodes, there may be {most}: take fewer \
         steps, or parts of the path"
    )]
    Nodes { found: usize, most: usize },
    #[error(
        "{field}: joint {joint} is {value:.6} rad, its limits are {:.6} to {:.6} rad",
        .bounds[0], .bounds[1]
    )]
    EndOutside { field: &'static str, joint: usize, value: f64, bounds: [f64; 2] },
    #[error(
        "closed: the last pose is {:.3} mm and {:.4} deg from the first, {bound:.0e} m and rad are \
         allowed: append the first pose, or leave closed out",
        1e3 * .position, .rotation.to_degrees()
    )]
    Open { position: f64, rotation: f64, bound: f64 },
    #[error("closed: a closed path ends at its start: give start only, or leave closed out")]
    ClosedEnd,
    #[error("cell and external axes do not go together: an axis moves the base; use accept")]
    CellMoves,
    #[error("times give the pace of the path: leave them out, or max_acceleration")]
    TimedTwice,
    #[error(
        "the joint limits allow {found:.0} combinations of turns, {most} are searched: narrow them \
         with with_limits"
    )]
    Turns { found: f64, most: usize },
}

/// The index of one among several, in brackets.
struct At(Option<usize>);

impl fmt::Display for At {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.map_or(Ok(()), |index| write!(f, "[{index}]"))
    }
}
