//! Shapes and how far a capsule is from them.

mod capsule;
mod checks;
mod cloud;
mod convex;
mod gjk;
mod hull;
mod mesh;
mod of_hull;
mod rounded;
mod segment;
mod solid;
mod surface;
#[cfg(test)]
mod tests;
mod tree;
mod triangle;
mod weld;

pub use self::capsule::Capsule;
pub(crate) use self::capsule::Separation;
pub(crate) use self::checks::check_length;
pub use self::cloud::Cloud;
pub(crate) use self::gjk::{DistanceQuery, SeparatingDirection};
pub use self::hull::Hull;
pub use self::mesh::Mesh;
pub use self::rounded::RoundedHull;
pub use self::solid::Shape;
pub(crate) use self::tree::{Bounds, Tree};
