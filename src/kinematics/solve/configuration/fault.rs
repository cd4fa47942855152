//! A configuration that is refused.

use core::fmt;

use alloc::vec::Vec;

use thiserror::Error;

use crate::report::{Configuration, FreeJoint, Listed};

/// A configuration that no solution inside the limits has.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error(
    "no solution inside the limits has the configuration {wanted}; there are {}{}{}",
    Listed(.existing, ", "), if *.more { " and more" } else { "" }, OtherAngles(*.free)
)]
pub struct NoConfiguration {
    /// The one that was asked for.
    pub wanted: Configuration,
    /// The configurations that exist, at every turn inside the limits: the first
    /// [`NoConfiguration::MOST`].
    pub existing: Vec<Configuration>,
    /// Whether there are more.
    pub more: bool,
    /// The joint that a singular pose leaves free: other angles of it have other configurations.
    pub free: Option<FreeJoint>,
}

impl NoConfiguration {
    /// How many configurations are listed at most.
    pub const MOST: usize = 64;
}

/// The end of a message: configurations at other angles of a free joint.
struct OtherAngles(Option<FreeJoint>);

impl fmt::Display for OtherAngles {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.map_or(Ok(()), |free| {
            let joint = free.joint();
            write!(f, ", and others with other angles of J{joint}, which is free at this pose")
        })
    }
}
