//! What can be wrong with an input, each fault with the field, the value and the bound.

#[cfg(feature = "rapid")]
mod frame;
mod names;
#[cfg(feature = "rapid")]
mod rapid;
mod urdf;

use core::fmt;

use alloc::string::String;
use alloc::vec::Vec;

#[cfg(feature = "rapid")]
pub use self::frame::FrameFault;
#[cfg(feature = "rapid")]
pub use self::rapid::{Missing, RapidFault, RapidFaultKind};
pub use self::urdf::{Names, UrdfFault};
use crate::report::{Configuration, Explanation, FreeJoint, UnknownStructure};

/// Why a call was refused.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// The pose is no rigid transform.
    InvalidPose(PoseFault),
    /// The joint vector is no joint vector of this arm.
    InvalidJoints(JointFault),
    /// The arm cannot be built, or cannot do what is asked of it.
    InvalidModel(ModelFault),
    /// The catalogue has no arm of that name.
    UnknownRobot(UnknownRobot),
    /// The RAPID text is broken.
    #[cfg(feature = "rapid")]
    Rapid(RapidFault),
    /// A tool and a work object do not go together, or are no poses.
    #[cfg(feature = "rapid")]
    Frame(FrameFault),
    /// No solution inside the limits.
    Unreachable(Explanation),
    /// Solutions inside the limits, none with the configuration that was asked for.
    NoConfiguration(NoConfiguration),
    /// The processor does not have these instructions.
    NoInstructionSet {
        /// Name of the set.
        name: &'static str,
    },
    /// A slice of a batch does not hold the rows that it should.
    WrongLength {
        /// Name of the argument.
        field: &'static str,
        /// Its length.
        found: usize,
        /// The length that it should have.
        wanted: usize,
    },
}

/// A configuration that no solution inside the limits has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NoConfiguration {
    /// The one that was asked for.
    pub wanted: Configuration,
    /// Those that exist, of every full turn inside the limits; the first [`NoConfiguration::MOST`] of them.
    pub existing: Vec<Configuration>,
    /// Whether there are more.
    pub more: bool,
    /// The joint that the pose leaves free, at a singularity: with another angle of it there are other configurations.
    pub free: Option<FreeJoint>,
}

impl NoConfiguration {
    /// How many configurations are listed at most.
    pub const MOST: usize = 64;
}

/// What is wrong with a pose.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum PoseFault {
    /// An element is NaN or infinite.
    NotFinite {
        /// Row of the matrix, from 0.
        row: usize,
        /// Column of the matrix, from 0.
        column: usize,
        /// The element.
        value: f64,
    },
    /// A position is too far away to calculate with.
    TooFar {
        /// Name of the argument.
        field: &'static str,
        /// Index of the coordinate, from 0.
        index: usize,
        /// The coordinate [m].
        value: f64,
        /// The largest size of a coordinate [m].
        bound: f64,
    },
    /// The last row is not 0 0 0 1.
    LastRow {
        /// The row that came.
        row: [f64; 4],
    },
    /// The columns of the rotation are not orthonormal: the largest element of `R^T R - I` exceeds the bound.
    NotOrthonormal {
        /// The largest element of `R^T R - I`.
        deviation: f64,
        /// The largest that is repaired.
        bound: f64,
    },
    /// The rotation mirrors: its determinant is negative.
    Mirrored {
        /// The determinant.
        determinant: f64,
    },
    /// A quaternion's norm is too far from one.
    QuaternionNorm {
        /// The norm.
        norm: f64,
        /// The largest distance from one that is normalised.
        bound: f64,
    },
    /// A translation, quaternion or Euler angle is NaN or infinite.
    FieldNotFinite {
        /// Name of the argument.
        field: &'static str,
        /// Index into it.
        index: usize,
        /// The element.
        value: f64,
    },
}

/// What is wrong with a joint vector.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum JointFault {
    /// An angle is NaN or infinite.
    NotFinite {
        /// Name of the argument.
        field: &'static str,
        /// The joint, from 1.
        joint: usize,
        /// The angle.
        value: f64,
    },
    /// An angle is too large to be given: its whole turns leave too few digits for the rest.
    TooLarge {
        /// Name of the argument.
        field: &'static str,
        /// The joint, from 1.
        joint: usize,
        /// The angle [rad].
        value: f64,
        /// The largest size of an angle [rad].
        bound: f64,
    },
    /// A solution was passed with a pose that it does not meet.
    NotOfPose {
        /// How far its tool is from the pose, the larger of metres and radians.
        off: f64,
    },
    /// The zone of a crossing policy is negative, NaN or infinite.
    Zone {
        /// The zone.
        value: f64,
    },
    /// A number of a configuration that no configuration of the arm has.
    Configuration {
        /// Its name.
        field: &'static str,
        /// The number.
        value: i32,
        /// The least and the largest that it may be.
        bounds: [i32; 2],
    },
    /// A weight is negative, NaN or infinite.
    Weight {
        /// The joint, from 1.
        joint: usize,
        /// The weight.
        value: f64,
    },
}

/// What is wrong with the description of an arm.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum ModelFault {
    /// A parameter is NaN or infinite.
    NotFinite {
        /// Name of the parameter.
        field: &'static str,
        /// Index into it, from 1 (joint or row).
        index: usize,
        /// The value.
        value: f64,
    },
    /// A length is too short for the arm to be one.
    TooShort {
        /// Name and meaning of the length.
        field: &'static str,
        /// The length [m].
        value: f64,
        /// The least length [m].
        bound: f64,
    },
    /// A length or an angle is too large to calculate with.
    TooLarge {
        /// Name of the parameter.
        field: &'static str,
        /// Index into it, from 1 (joint or row); 0 for a parameter by itself.
        index: usize,
        /// The value.
        value: f64,
        /// The largest size.
        bound: f64,
    },
    /// `snap` is negative, NaN or too large.
    Snap {
        /// What was given [rad].
        value: f64,
        /// The largest [rad].
        bound: f64,
    },
    /// A joint sign is neither 1 nor -1.
    Sign {
        /// The joint, from 1.
        joint: usize,
        /// The sign.
        value: f64,
    },
    /// A joint's lower limit is above its upper limit.
    EmptyLimit {
        /// The joint, from 1.
        joint: usize,
        /// Lower limit [rad].
        lower: f64,
        /// Upper limit [rad].
        upper: f64,
    },
    /// The lower limit of the rod of coupled axes is above its upper limit.
    EmptyRodLimit {
        /// Lower limit of q3 - q2 [rad].
        lower: f64,
        /// Upper limit of q3 - q2 [rad].
        upper: f64,
    },
    /// Limits of a rod were given for an arm whose axes 2 and 3 are not coupled.
    NoRod,
    /// Axes 2 and 3 of the arm cannot be coupled.
    NotCoupled {
        /// Why not.
        reason: &'static str,
    },
    /// A velocity limit is not positive.
    Velocity {
        /// The joint, from 1.
        joint: usize,
        /// The velocity [rad/s].
        value: f64,
    },
    /// The arm has another number of joints.
    JointCount {
        /// Joints of the arm.
        found: usize,
        /// Joints that were asked for.
        wanted: usize,
    },
    /// The geometry has no closed-form inverse here.
    UnknownStructure(UnknownStructure),
    /// ABB's confdata means nothing, or something else, for arms of this form.
    NoConfiguration {
        /// Name of the form.
        family: &'static str,
    },
    /// A crossing policy holds a wrist that the arm does not have.
    NoSphericalWrist,
    /// The direction of an axis has no length.
    AxisDirection {
        /// The axis, from 1.
        axis: usize,
    },
    /// Two axes are so nearly parallel that a table cannot hold their common normal.
    NearlyParallel {
        /// The axes, from 1.
        axes: (usize, usize),
        /// How far they are off parallel [rad].
        off: f64,
        /// How far away their common normal stands [m].
        distance: f64,
        /// The farthest that a table holds [m].
        bound: f64,
        /// The least power of ten [rad] that, given as `snap`, makes an arm of a known form of it; none where none does.
        snap: Option<f64>,
    },
    /// The URDF describes no arm that can be taken.
    Urdf(UrdfFault),
}

/// A name that the catalogue does not have.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownRobot {
    /// The name that was asked for.
    pub name: String,
    /// Names that are close to it, the closest first.
    pub close: Vec<&'static str>,
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::InvalidPose(fault) => fault.fmt(f),
            Self::InvalidJoints(fault) => fault.fmt(f),
            Self::InvalidModel(fault) => fault.fmt(f),
            Self::UnknownRobot(fault) => fault.fmt(f),
            #[cfg(feature = "rapid")]
            Self::Rapid(fault) => fault.fmt(f),
            #[cfg(feature = "rapid")]
            Self::Frame(fault) => fault.fmt(f),
            Self::Unreachable(explanation) => explanation.fmt(f),
            Self::NoConfiguration(fault) => fault.fmt(f),
            Self::NoInstructionSet { name } => {
                write!(f, "this processor does not have the instruction set \"{name}\"")
            }
            Self::WrongLength { field, found, wanted } => {
                write!(f, "{field} has {found} elements, it must have {wanted}")
            }
        }
    }
}

impl core::error::Error for Error {}

impl fmt::Display for PoseFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite { row, column, value } => {
                write!(f, "pose[{row}, {column}] is {value}: every element must be finite")
            }
            Self::TooFar { field: "pose", index, value, bound } => {
                write!(f, "pose[{index}, 3] is {value:e} m, its size must be at most {bound:e} m")
            }
            Self::TooFar { field, index, value, bound } => {
                write!(f, "{field}[{index}] is {value:e} m, its size must be at most {bound:e} m")
            }
            Self::LastRow { row: [a, b, c, d] } => {
                write!(f, "pose row 3 must be [0, 0, 0, 1], got [{a}, {b}, {c}, {d}]")
            }
            Self::NotOrthonormal { deviation, bound } => {
                write!(
                    f,
                    "pose rotation is off orthonormal by {deviation:.3e}, more than the {bound:.0e} that is repaired"
                )
            }
            Self::Mirrored { determinant } => {
                write!(
                    f,
                    "pose rotation mirrors: its determinant is {determinant:.6}, it must be 1 (is an axis negated?)"
                )
            }
            Self::QuaternionNorm { norm, bound } => {
                write!(
                    f,
                    "quaternion norm is {norm:.6}, it must be 1 within {bound:.0e} (order is w, x, y, z)"
                )
            }
            Self::FieldNotFinite { field, index, value } => {
                write!(f, "{field}[{index}] is {value}: every element must be finite")
            }
        }
    }
}

impl fmt::Display for JointFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite { field, joint, value } => {
                write!(f, "{field}: joint {joint} is {value}, every angle must be finite [rad]")
            }
            Self::TooLarge { field, joint, value, bound } => {
                write!(
                    f,
                    "{field}: joint {joint} is {value:e} rad, its size must be at most {bound:e} \
                     rad (remove whole turns)"
                )
            }
            Self::NotOfPose { off } => {
                write!(f, "solution: its tool is {off:.1e} (m, rad) off the pose, it is none of it")
            }
            Self::Zone { value } => {
                write!(f, "zone is {value}, it must be finite and not negative")
            }
            Self::Configuration { field, value, bounds: [0, 0] } => {
                write!(
                    f,
                    "configuration: {field} is {value}, it is 0 for an arm with coupled axes 2 and 3"
                )
            }
            Self::Configuration { field, value, bounds: [least, most] } => {
                write!(f, "configuration: {field} is {value}, it must be {least} to {most}")
            }
            Self::Weight { joint, value } => write!(
                f,
                "weights: joint {joint} is {value}, a weight must be finite and not negative"
            ),
        }
    }
}

impl fmt::Display for ModelFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite { field, index: 0, value } => {
                write!(f, "{field} is {value}, it must be finite")
            }
            Self::NotFinite { field, index, value } => {
                write!(f, "{field} {index} is {value}, it must be finite")
            }
            Self::TooLarge { field, index: 0, value, bound } => {
                write!(f, "{field} is {value:e}, its size must be at most {bound:e}")
            }
            Self::TooLarge { field, index, value, bound } => {
                write!(f, "{field} {index} is {value:e}, its size must be at most {bound:e}")
            }
            Self::TooShort { field, value, bound } => {
                write!(f, "{field} is {value} m, it must be at least {bound:e} m")
            }
            Self::Snap { value, bound } => {
                write!(f, "snap is {value} rad, it must be 0 to {bound:e} rad")
            }
            Self::Sign { joint, value } => {
                write!(f, "joint {joint} sign is {value}, it must be 1 or -1")
            }
            Self::EmptyLimit { joint, lower, upper } => {
                write!(f, "joint {joint} limit is empty: lower {lower} rad > upper {upper} rad")
            }
            Self::EmptyRodLimit { lower, upper } => {
                write!(f, "rod limit is empty: lower {lower} rad > upper {upper} rad")
            }
            Self::NoRod => write!(
                f,
                "rod limits are those of q3 - q2 of an arm with coupled axes 2 and 3: this arm's are not coupled"
            ),
            Self::NotCoupled { reason } => write!(f, "axes 2 and 3 cannot be coupled: {reason}"),
            Self::Velocity { joint, value } => {
                write!(f, "joint {joint} velocity is {value} rad/s, it must be positive")
            }
            Self::JointCount { found, wanted } => {
                write!(f, "the arm has {found} joints, {wanted} were asked for")
            }
            Self::NoConfiguration { family } => {
                write!(
                    f,
                    "configurations are those of ABB's six-axis arms with a spherical wrist: this arm's form is \"{family}\""
                )
            }
            Self::NoSphericalWrist => write!(
                f,
                "this policy holds a spherical wrist, and the arm has none: take \"through\" or \"error\""
            ),
            Self::UnknownStructure(reason) => {
                write!(f, "no closed-form inverse kinematics for this arm: {reason}")
            }
            Self::AxisDirection { axis } => write!(f, "direction of axis {axis} has no length"),
            Self::NearlyParallel { axes: (i, j), off, distance, bound, snap } => {
                write!(
                    f,
                    "axes {i} and {j} are {off:.1e} rad off parallel, their common normal stands {distance:.1e} m away, it must be at most \
                     {bound:.0e} m"
                )?;
                match snap {
                    Some(snap) => write!(f, "; snap={snap:e} would take it"),
                    None => write!(f, " (are the angles written with all their digits?)"),
                }
            }
            Self::Urdf(fault) => write!(f, "URDF: {fault}"),
        }
    }
}

impl fmt::Display for UnknownRobot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "unknown robot \"{}\"", self.name)?;
        if self.close.is_empty() {
            return write!(f, "; no name of the catalogue is close to it");
        }
        for (i, name) in self.close.iter().enumerate() {
            write!(f, "{}\"{name}\"", if i == 0 { "; close names: " } else { ", " })?;
        }
        Ok(())
    }
}

impl fmt::Display for NoConfiguration {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "no solution inside the limits has the configuration {}; there are ",
            self.wanted
        )?;
        for (i, existing) in self.existing.iter().enumerate() {
            write!(f, "{}{existing}", if i == 0 { "" } else { ", " })?;
        }
        if self.more {
            write!(f, " and more")?;
        }
        self.free
            .map_or(Ok(()), |free| write!(f, ", and others, for J{} is free there", free.joint()))
    }
}

impl ModelFault {
    /// Checks that a number of a model is finite and not too large to calculate with.
    pub(crate) fn check(
        field: &'static str,
        index: usize,
        value: f64,
        bound: f64,
    ) -> Result<(), Error> {
        if !value.is_finite() {
            return Err(Self::NotFinite { field, index, value }.into());
        }
        if value.abs() > bound {
            return Err(Self::TooLarge { field, index, value, bound }.into());
        }
        Ok(())
    }
}

impl From<PoseFault> for Error {
    fn from(fault: PoseFault) -> Self {
        Self::InvalidPose(fault)
    }
}

impl From<JointFault> for Error {
    fn from(fault: JointFault) -> Self {
        Self::InvalidJoints(fault)
    }
}

impl From<UrdfFault> for Error {
    fn from(fault: UrdfFault) -> Self {
        Self::InvalidModel(ModelFault::Urdf(fault))
    }
}

#[cfg(feature = "rapid")]
impl From<RapidFault> for Error {
    fn from(fault: RapidFault) -> Self {
        Self::Rapid(fault)
    }
}

#[cfg(feature = "rapid")]
impl From<FrameFault> for Error {
    fn from(fault: FrameFault) -> Self {
        Self::Frame(fault)
    }
}

impl From<ModelFault> for Error {
    fn from(fault: ModelFault) -> Self {
        Self::InvalidModel(fault)
    }
}
