//! Many poses or joint vectors at once, over flat row-major slices.
//!
//! A row that is not finite gives a row of NaN, and where the answer has a status,
//! [`Status::INVALID`](crate::Status::INVALID). A row's answer does not depend on its neighbors.

mod forward;
mod inverse;
mod margins;
mod pace;
#[cfg(feature = "std")]
mod poses;
pub(crate) mod rows;
#[cfg(feature = "std")]
mod threads;

pub use inverse::{Configured, NO_CONFIGURATION};
pub use margins::Margins;
pub use pace::Batch;
