//! The body of an arm: shapes that its links are inside of, and which links are to be kept apart.

mod arms;
mod links;
mod shape;
#[cfg(feature = "serde")]
mod stored;

pub(crate) use arms::body_of;
pub use links::{Body, LinkCapsule};
pub(crate) use shape::check_length;
pub use shape::{Capsule, Shape};
