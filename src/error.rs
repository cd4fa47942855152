//! What can be wrong with an input, each fault with the field, the value and the bound.

mod calibrated;
#[cfg(feature = "rapid")]
mod frame;
mod joints;
mod model;
mod motion;
mod names;
mod plan;
mod pose;
#[cfg(feature = "rapid")]
mod rapid;
mod robot_name;
#[cfg(feature = "rapid")]
mod routine;
mod urdf;

use core::fmt;

use alloc::vec::Vec;

pub use self::calibrated::CalibratedFault;
#[cfg(feature = "rapid")]
pub use self::frame::FrameFault;
pub use self::joints::JointFault;
pub use self::model::ModelFault;
pub use self::motion::MotionFault;
pub use self::plan::PlanFault;
pub use self::pose::PoseFault;
#[cfg(feature = "rapid")]
pub use self::rapid::{Missing, RapidFault, RapidFaultKind};
pub use self::robot_name::{LeftOut, UnknownRobot};
#[cfg(feature = "rapid")]
pub use self::routine::RoutineFault;
pub use self::urdf::{Names, UrdfFault};
use crate::report::{Configuration, Explanation, FreeJoint};

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
    /// A trajectory or a path is not what it must be.
    InvalidMotion(MotionFault),
    /// What a plan is asked for does not fit.
    InvalidPlan(PlanFault),
    /// The catalog has no arm of that name.
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
    /// Those that exist, of every full turn inside the limits; the first [`NoConfiguration::MOST`]
    /// of them.
    pub existing: Vec<Configuration>,
    /// Whether there are more.
    pub more: bool,
    /// The joint that the pose leaves free, at a singularity: with another angle of it there are
    /// other configurations.
    pub free: Option<FreeJoint>,
}

impl NoConfiguration {
    /// How many configurations are listed at most.
    pub const MOST: usize = 64;
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::InvalidPose(fault) => fault.fmt(f),
            Self::InvalidJoints(fault) => fault.fmt(f),
            Self::InvalidModel(fault) => fault.fmt(f),
            Self::InvalidMotion(fault) => fault.fmt(f),
            Self::InvalidPlan(fault) => fault.fmt(f),
            Self::UnknownRobot(fault) => fault.fmt(f),
            #[cfg(feature = "rapid")]
            Self::Rapid(fault) => fault.fmt(f),
            #[cfg(feature = "rapid")]
            Self::Frame(fault) => fault.fmt(f),
            Self::Unreachable(explanation) => explanation.fmt(f),
            Self::NoConfiguration(fault) => fault.fmt(f),
            Self::NoInstructionSet { name } => {
                write!(f, "the instruction set \"{name}\" is not supported by this CPU")
            }
            Self::WrongLength { field, found, wanted } => {
                write!(f, "{field} has {found} elements, it must have {wanted}")
            }
        }
    }
}

impl core::error::Error for Error {}

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
        self.free.map_or(Ok(()), |free| {
            write!(
                f,
                ", and others with other angles of J{}, which is free at this pose",
                free.joint()
            )
        })
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

impl From<MotionFault> for Error {
    fn from(fault: MotionFault) -> Self {
        Self::InvalidMotion(fault)
    }
}

impl From<PlanFault> for Error {
    fn from(fault: PlanFault) -> Self {
        Self::InvalidPlan(fault)
    }
}

impl From<CalibratedFault> for Error {
    fn from(fault: CalibratedFault) -> Self {
        Self::InvalidModel(ModelFault::Calibrated(fault))
    }
}

impl From<ModelFault> for Error {
    fn from(fault: ModelFault) -> Self {
        Self::InvalidModel(fault)
    }
}
