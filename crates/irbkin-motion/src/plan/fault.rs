//! Arguments of plans that are refused.

use thiserror::Error;

use irbkin::internal::{PoseFault, excess};

/// Why an argument of a plan is refused. Lengths in meters, angles in radians, times in seconds;
/// poses and axes count from 0, joints from 1; `bounds` are the least and the largest value.
#[doc(hidden)]
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
        "{field} turns the tool by {:.3} deg, the tool rotation allows {:.3} to {:.3} deg, exceeded \
         {} rad",
        .angle.to_degrees(), .bounds[0].to_degrees(), .bounds[1].to_degrees(),
        excess(*.angle, *.bounds)
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
    #[error(
        "position is {value} m, it must be {} to {} m, the limits of the robot's carrier: pass \
         meters between them",
        .bounds[0], .bounds[1]
    )]
    Position { value: f64, bounds: [f64; 2] },
    #[error("this robot has no carrier, no file gave it a rail or a lift: with_base(T) moves it")]
    NoCarrier,
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
    /// Axes are the external ones, then tilts.
    #[error(
        "{field}: free axis {index} (external axes, tilts) is at {value:.6}, its range is \
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
        "{field}: joint {joint} is {value:.6} rad, its limits are {:.6} to {:.6} rad, exceeded {} rad",
        .bounds[0], .bounds[1], excess(*.value, *.bounds)
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
    #[error(
        "{field} is for arms of six or seven joints: a plan of five axes follows its poses within \
         heading_tolerance, leave it out"
    )]
    FiveAxes { field: &'static str },
    #[error("times give the pace of the path: leave them out, or max_acceleration")]
    TimedTwice,
    #[error(
        "the joint limits allow {found:.0} combinations of turns, {most} are searched: narrow them \
         with with_limits"
    )]
    Turns { found: f64, most: usize },
}
