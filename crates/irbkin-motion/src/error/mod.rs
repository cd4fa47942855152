//! Errors of input, as those of [`irbkin::Error`].

use irbkin::Interrupted;
use irbkin::internal::{JointFault, ModelFault, PoseFault};

mod motion;
#[cfg(test)]
mod tests;

pub use self::motion::{MotionFault, check_most_near};
use crate::body::fault::BodyFault;
use crate::go::fault::GoFault;
use crate::plan::fault::PlanFault;
use crate::prelude::*;
#[cfg(feature = "urdf")]
use crate::urdf::fault::UrdfFault;

/// Why a call was refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The robot refuses: a pose, a joint vector, a model; it does not reach a pose.
    #[error(transparent)]
    Robot(#[from] irbkin::Error),
    /// An argument of a trajectory or a path is invalid.
    #[error(transparent)]
    InvalidMotion(#[from] MotionFault),
    /// An argument of a plan is invalid.
    #[error(transparent)]
    InvalidPlan(#[from] PlanFault),
    /// A shape, a body or a cell is invalid, or the arm has no body.
    #[error(transparent)]
    InvalidBody(#[from] BodyFault),
    /// A URDF is broken, or its chain is no arm.
    #[cfg(feature = "urdf")]
    #[error("URDF: {0}")]
    InvalidUrdf(#[from] UrdfFault),
    /// Every solution inside the limits collides; of the nearest one, the link, what it is in, and
    /// how deep [m].
    #[error(
        "every solution inside the limits collides, the nearest one link {link} with {other}, \
         {:.1} mm deep", 1e3 * depth
    )]
    Collides {
        /// The link.
        link: usize,
        /// The obstacle or link.
        other: String,
        /// How deep, the margin included [m].
        depth: f64,
    },
    /// A free motion cannot be, or was not found.
    #[error(transparent)]
    NoMotion(#[from] GoFault),
}

/// Faults of the robot that are raised here.
macro_rules! faults_of_robots {
    ($($Fault:ty)*) => {$(
        impl From<$Fault> for Error {
            fn from(fault: $Fault) -> Self {
                irbkin::Error::from(fault).into()
            }
        }
    )*};
}
faults_of_robots! { PoseFault JointFault ModelFault Interrupted }
