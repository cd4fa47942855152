//! Many poses or joint vectors at once, over flat row-major slices.
//!
//! The seam to arrays: a row that is not finite gives a row of NaN, and where the answer has a
//! status, [`Status::INVALID`](crate::Status::INVALID). A row's answer does not depend on its
//! neighbors.

mod forward;
mod inverse;
mod margins;
mod pace;
mod parameters;
#[cfg(feature = "python")]
mod paths;
#[cfg(feature = "python")]
mod plans;
#[cfg(feature = "python")]
mod poses;
mod rows;
#[cfg(feature = "std")]
mod threads;

pub use forward::{configuration, fk, jacobian, link_frames, singularity};
#[cfg(feature = "python")]
pub(crate) use inverse::Configured;
pub use inverse::{NO_CONFIGURATION, ik, ik_configured, ik_nearest, ik_with};
pub use margins::{Margins, ik_margin, margin};
#[cfg(feature = "python")]
pub(crate) use pace::Pace;
pub use parameters::{corrected_fk, parameter_jacobian};
#[cfg(feature = "python")]
pub(crate) use plans::PlanJob;
