//! Models of arms that are refused, and questions that an arm cannot answer.

use core::f64::consts::TAU;

use alloc::format;
use alloc::string::String;

use thiserror::Error;

use crate::report::UnknownStructure;

/// Why the model of an arm is refused, or a question to it. Lengths in meters, angles in radians;
/// joints, axes and rows count from 1, an `index` of 0 is a parameter by itself.
#[doc(hidden)]
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ModelFault {
    #[error("{field}{} is {value}, it must be finite", nth(*.index))]
    NotFinite { field: &'static str, index: usize, value: f64 },
    #[error("{field} is {value} m, it must be at least {bound:e} m")]
    TooShort { field: &'static str, value: f64, bound: f64 },
    #[error("{field}{} is {value:e}, its size must be at most {bound:e}", nth(*.index))]
    TooLarge { field: &'static str, index: usize, value: f64, bound: f64 },
    /// A multiple of 15 beyond two turns, taken as radians.
    #[error(
        "{field} {index} is {value} rad, a multiple of 15 must be at most 12.57 rad (did you pass \
         degrees? {value} deg is {} rad)",
        .value.to_radians()
    )]
    Degrees { field: &'static str, index: usize, value: f64 },
    #[error(
        "the flange is {distance:.1} m from axis {axis}, it must be at most {bound} m (are the \
         lengths in millimeters? meters are wanted)"
    )]
    TooFar { axis: usize, distance: f64, bound: f64 },
    /// The first of more than half of the joints.
    #[error(
        "joint {joint} limit is {lower} to {upper} rad, beyond {bound} rad as are the limits of \
         most joints (did you pass degrees? for no limit give inf)"
    )]
    LimitsInDegrees { joint: usize, lower: f64, upper: f64, bound: f64 },
    /// `none`: infinity or minus infinity.
    #[error(
        "{field}{} is {value}, it must {} ({none} is allowed: no limit)",
        nth(*.index), if .value.is_nan() { "not be NaN" } else { "be finite" }
    )]
    NoLimit { field: &'static str, index: usize, value: f64, none: f64 },
    #[error("snap is {value} rad, it must be 0 to {bound:e} rad")]
    Snap { value: f64, bound: f64 },
    #[error("heading_tolerance is {value} rad, it must be 0 to {bound} rad")]
    HeadingTolerance { value: f64, bound: f64 },
    #[error("joint {joint} sign is {value}, it must be 1 or -1")]
    Sign { joint: usize, value: f64 },
    #[error("joint {joint} limit is empty: lower {lower} rad > upper {upper} rad")]
    EmptyLimit { joint: usize, lower: f64, upper: f64 },
    #[error("linkage limit is empty: lower {lower} rad > upper {upper} rad")]
    EmptyLinkageLimit { lower: f64, upper: f64 },
    #[error(
        "this robot has no parallelogram linkage: linkage limits bound the serial joint 3 of a \
         robot with coupled axes 2 and 3 (see coupled)"
    )]
    NoLinkage,
    #[error("axes 2 and 3 cannot be coupled: {reason}")]
    NotCoupled { reason: String },
    #[error("the robot has no velocity limits: give max_velocity [rad/s]")]
    NoVelocity,
    #[error("joint {joint} velocity is {value} rad/s, it must be positive")]
    Velocity { joint: usize, value: f64 },
    #[error("the robot has {found} joints, it must have {wanted}")]
    JointCount { found: usize, wanted: usize },
    #[error("no inverse kinematics for this arm: {0}")]
    UnknownStructure(UnknownStructure),
    #[error(
        "this robot has no ABB configuration: its structure is \"{structure}\", not a six-axis arm \
         with a spherical wrist{} (the slot of a solution names its branch){}",
        if matches!(*.structure, "offset wrist" | "general") {
            ", nor a GoFa or YuMi of the catalog"
        } else {
            ""
        },
        .snap.map_or_else(String::new, |snap| format!(
            "; its angles are rounded, snap={snap:e} gives it a closed form"
        ))
    )]
    NoConfiguration {
        structure: &'static str,
        /// The `snap` [rad] that would give the arm a closed form.
        snap: Option<f64>,
    },
    #[error(
        "this robot has no arm angle: it is not a YuMi of the catalog (give the angle of a joint)"
    )]
    NoArmAngle,
    #[error(
        "this singularity mode needs a spherical wrist, and the robot has none: use \"through\" or \
         \"error\""
    )]
    NoSphericalWrist,
    #[error("direction of axis {axis} is zero, it must have a length")]
    AxisDirection { axis: usize },
    /// `snap`: the least power of ten with which the arm has a known structure.
    #[error(
        "axes {} and {} are {off:.1e} rad off parallel, their common normal is {distance:.1e} m \
         away, it must be at most {bound:.0e} m{}",
        .axes.0, .axes.1, digits(*.snap)
    )]
    NearlyParallel { axes: (usize, usize), off: f64, distance: f64, bound: f64, snap: Option<f64> },
    #[error(
        "joint {joint} at {angle} rad leaves axes {} and {} {off:.1e} rad off parallel, they must \
         be parallel or at least {bound:.1e} rad off",
        .axes.0, .axes.1
    )]
    LeftNearlyParallel { joint: usize, angle: f64, axes: (usize, usize), off: f64, bound: f64 },
    #[error(
        "the structure of the nominal robot is \"{structure}\", it must have a closed form (give \
         the arm of the data sheet)"
    )]
    NominalStructure { structure: &'static str },
    /// `bound`: of the position and of the rotation.
    #[error(
        "the tool is up to {position:.3} m and {rotation:.3} rad from the tool of the nominal \
         robot, it must be at most {:.3} m and {} rad (is it the same arm, with the same zero \
         pose?)",
        .bound[0], .bound[1]
    )]
    FarFromNominal { position: f64, rotation: f64, bound: [f64; 2] },
}

impl ModelFault {
    /// Refuses a multiple of 15 beyond two turns: it is an angle in degrees.
    pub(crate) fn check_radians(field: &'static str, index: usize, value: f64) -> Result<(), Self> {
        if value.abs() > 2.0 * TAU && value % 15.0 == 0.0 {
            return Err(Self::Degrees { field, index, value });
        }
        Ok(())
    }

    /// Checks that a number is finite and at most `bound` in size.
    pub(crate) fn check(
        field: &'static str,
        index: usize,
        value: f64,
        bound: f64,
    ) -> Result<(), Self> {
        if !value.is_finite() {
            return Err(Self::NotFinite { field, index, value });
        }
        if value.abs() > bound {
            return Err(Self::TooLarge { field, index, value, bound });
        }
        Ok(())
    }
}

/// The number of a joint or a row after the name of a field, nothing for 0.
fn nth(index: usize) -> String {
    if index == 0 { String::new() } else { format!(" {index}") }
}

/// The cure of angles with few digits.
fn digits(snap: Option<f64>) -> String {
    match snap {
        Some(snap) => {
            format!(" (write the angles with all their digits); snap={snap:e} would take it")
        }
        None => " (are the angles written with all their digits?)".into(),
    }
}
