//! Errors of input. A message names the field, the value, the bound and, where one is likely, the
//! slip.
//!
//! A caller matches [`Error`] and prints the fault inside it: most types of faults have no public
//! names. Those that one room raises are in that room; here are those that several raise.

pub(crate) mod input;
mod model;
#[cfg(test)]
mod tests;

pub use self::input::{JointFault, PoseFault};
pub use self::model::ModelFault;
use crate::catalog::fault::UnknownRobot;
use crate::interrupt::Interrupted;
use crate::kinematics::NoConfiguration;
use crate::report::Explanation;

/// Why a call was refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The pose is not a rigid transform.
    #[error(transparent)]
    InvalidPose(#[from] PoseFault),
    /// The joint vector does not fit this arm.
    #[error(transparent)]
    InvalidJoints(#[from] JointFault),
    /// The arm cannot be built, or cannot do what was asked.
    #[error(transparent)]
    InvalidModel(#[from] ModelFault),
    /// The catalog has no arm of that name.
    #[error(transparent)]
    UnknownRobot(#[from] UnknownRobot),
    /// No solution is inside the limits.
    #[error("{0}")]
    Unreachable(Explanation),
    /// Solutions are inside the limits, none with the configuration that was asked for.
    #[error(transparent)]
    NoConfiguration(#[from] NoConfiguration),
    /// The caller ended the work ([`Interrupt`](crate::Interrupt)).
    #[error(transparent)]
    Interrupted(#[from] Interrupted),
    /// The processor lacks these instructions.
    #[error("the instruction set \"{name}\" is not supported by this CPU")]
    NoInstructionSet {
        /// Name of the set.
        name: &'static str,
    },
    /// A slice of a batch has another number of elements.
    #[error("{field} has {found} elements, it must have {wanted}")]
    WrongLength {
        /// Name of the argument.
        field: &'static str,
        /// Its length.
        found: usize,
        /// The length that it must have.
        wanted: usize,
    },
}
