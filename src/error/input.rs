//! Poses and joint vectors that are refused.

use alloc::format;
use alloc::string::String;

use thiserror::Error;

/// Why a pose is refused. Lengths in meters, angles in radians, indices from 0.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum PoseFault {
    #[error("pose[{row}, {column}] is {value}: every element must be finite")]
    NotFinite { row: usize, column: usize, value: f64 },
    /// An element of a translation, a quaternion or Euler angles.
    #[error("{field}[{index}] is {value}: every element must be finite")]
    FieldNotFinite { field: &'static str, index: usize, value: f64 },
    #[error(
        "{field}[{index}{}] is {value:e} m, its size must be at most {bound:e} m",
        if *.field == "pose" { ", 3" } else { "" }
    )]
    TooFar { field: &'static str, index: usize, value: f64, bound: f64 },
    /// `transposed`: the last column is 0 0 0 1.
    #[error(
        "pose row 3 must be [0, 0, 0, 1], got [{}, {}, {}, {}]{}",
        .row[0], .row[1], .row[2], .row[3],
        if *.transposed { ", and column 3 is [0, 0, 0, 1] (is it transposed?)" } else { "" }
    )]
    LastRow { row: [f64; 4], transposed: bool },
    /// `deviation`: the largest element of `R^T R - I`.
    #[error(
        "pose rotation is off orthonormal by {deviation:.3e}, more than the {bound:.0e} that is \
         repaired (is it scaled, or written with too few digits? the nearest rotation is U V of its \
         singular value decomposition, or that of scipy's Rotation.from_matrix)"
    )]
    NotOrthonormal { deviation: f64, bound: f64 },
    #[error(
        "pose rotation mirrors: its determinant is {determinant:.6}, it must be 1 (is an axis \
         negated?)"
    )]
    Mirrored { determinant: f64 },
    #[error("quaternion norm is {norm:.6}, it must be 1 within {bound:.0e} (order is {order})")]
    QuaternionNorm { norm: f64, bound: f64, order: &'static str },
    #[error(
        "{field}[{index}] is {value} rad, its size must be at most {bound:.4} rad (did you pass \
         degrees?)"
    )]
    Angle { field: &'static str, index: usize, value: f64, bound: f64 },
    #[error(
        "the tool center point is {length:.1} m from the flange, it must be at most {bound:.1} m, \
         ten times the size of the arm (is the tool in millimeters? meters are wanted)"
    )]
    ToolTooLong { length: f64, bound: f64 },
}

/// Why joint angles [rad], or an argument beside them, are refused. Joints count from 1.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum JointFault {
    #[error("{field}: joint {joint} is {value}, every angle must be finite [rad]")]
    NotFinite { field: &'static str, joint: usize, value: f64 },
    /// Whole turns leave too few digits for the rest.
    #[error(
        "{field}: joint {joint} is {value:e} rad, its size must be at most {bound:e} rad (remove \
         whole turns)"
    )]
    TooLarge { field: &'static str, joint: usize, value: f64, bound: f64 },
    /// More than four turns outside the limits.
    #[error(
        "{field}: joint {joint} is {value:.2} rad, far outside its limits {:.2} to {:.2} rad (did \
         you pass degrees? otherwise remove whole turns)",
        .bounds[0], .bounds[1]
    )]
    FarOutside { field: &'static str, joint: usize, value: f64, bounds: [f64; 2] },
    /// The first of more than half of the joints.
    #[error(
        "{field}: joint {joint} is {value:.2} rad, beyond {bound:.2} rad as most joints are (did \
         you pass degrees?)"
    )]
    Degrees { field: &'static str, joint: usize, value: f64, bound: f64 },
    /// `off`: the larger of meters and radians.
    #[error(
        "solution does not reach this pose: residual {off:.1e} (m or rad), it must be at most \
         {bound:.0e} (is it a solution of another pose or robot?)"
    )]
    NotOfPose { off: f64, bound: f64 },
    #[error("zone is {value}, it must be 0 to 1: a bound of |sin q5|")]
    Zone { value: f64 },
    #[error("configuration: {field} is {value}, it must be {}", numbers(*.bounds))]
    Configuration { field: &'static str, value: i32, bounds: [i32; 2] },
    #[error("given: there is no joint {joint}, it must be 1 to {dof}")]
    NoJoint { joint: usize, dof: usize },
    #[error(
        "arm_angle is missing: the pose and the configuration of a YuMi leave its elbow \
         undetermined (in a robtarget it is eax_a)"
    )]
    MissingArmAngle,
    #[error("arm_angle is {value} rad, it must be finite and at most {bound:e} rad in size")]
    ArmAngle { value: f64, bound: f64 },
    #[error("weights: joint {joint} is {value}, a weight must be finite and not negative")]
    Weight { joint: usize, value: f64 },
}

/// The range of an element of a configuration.
fn numbers([least, most]: [i32; 2]) -> String {
    match [least, most] {
        [0, 0] => "0 for a robot with coupled axes 2 and 3".into(),
        _ => format!("{least} to {most}"),
    }
}
