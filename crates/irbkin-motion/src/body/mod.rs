//! The body of an arm: shapes that its links are inside of, and which links are to be kept apart.

mod arms;
mod cover;
pub(crate) mod fault;
mod links;
mod outline;
mod shape;
#[cfg(feature = "serde")]
mod stored;

pub(crate) use arms::body_of;
pub use links::{Body, LinkCapsule, LinkHull};
pub(crate) use outline::{Centered, Group, Outline};
pub(crate) use shape::{
    Bounds, DistanceQuery, SeparatingDirection, Separation, Tree, check_length,
};
pub use shape::{Capsule, Cloud, Hull, Mesh, RoundedHull, Shape};
