//! Arguments of trajectories and paths that are refused.

use crate::prelude::*;
use thiserror::Error;

use irbkin::JointLimits;
use irbkin::internal::{JointFault, check_near};

/// Rows of a batch, evenly spaced, that are looked at for degrees.
const SAMPLED_ROWS: usize = 64;

/// Why an argument of a trajectory or a path is refused. Lengths in meters, angles in radians,
/// times in seconds; rows, poses and elements count from 0, joints from 1.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum MotionFault {
    #[error("{field}[{index}] is {value}: every element must be finite")]
    NotFinite { field: &'static str, index: usize, value: f64 },
    /// `index`: of one among several.
    #[error(
        "{field}{} is {value:?}, it must be positive{}",
        .index.map_or_else(String::new, |index| format!("[{index}]")),
        if .index.is_none() { " and finite" } else { "" }
    )]
    NotPositive { field: &'static str, index: Option<usize>, value: f64 },
    #[error("cycle is {value:?} s, it must be at most {bound} s (did you pass milliseconds?)")]
    Cycle { value: f64, bound: f64 },
    #[error("hold is {value:?} s, it must be from 0 to {bound} s (did you pass milliseconds?)")]
    Hold { value: f64, bound: f64 },
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
    #[error(
        "joint {joint} steps by {step:.3} rad to row {row} of q, more than {bound} rad: between such \
         rows the tool leaves T, and max_tool_speed would not hold; give poses nearer to each \
         other (is the step a jump? follow's breaks name it)"
    )]
    ToolStep { joint: usize, row: usize, step: f64, bound: f64 },
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

/// Check that most rows of a batch are near the limits, as [`check_near`] does: one row that is not
/// may be what the caller wants to see, most are in degrees.
#[doc(hidden)]
pub fn check_most_near<const N: usize>(
    field: &'static str,
    rows: &[[f64; N]],
    limits: &JointLimits<N>,
    weights: &[f64; N],
) -> Result<(), MotionFault> {
    let step = rows.len().div_ceil(SAMPLED_ROWS).max(1);
    let (mut first, mut far, mut near) = (None, 0, 0);
    for (row, q) in rows.iter().enumerate().step_by(step) {
        if let Err(irbkin::Error::InvalidJoints(fault)) = check_near(field, q, limits, weights) {
            first.get_or_insert(MotionFault::Row { row, fault });
            far += 1;
        } else {
            near += 1;
        }
    }
    first.filter(|_| far > near).map_or(Ok(()), Err)
}
