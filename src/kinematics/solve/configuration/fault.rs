//! A configuration that is refused.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use thiserror::Error;

use crate::report::{Configuration, FreeJoint, Listed};

/// A configuration that no solution inside the limits has.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error(
    "no solution inside the limits has the configuration {wanted}; there are {}{}{}",
    Listed(.existing, ", "), if *.more { " and more" } else { "" },
    .free.map_or_else(String::new, |free| format!(
        ", and others with other angles of J{}, which is free at this pose", free.joint()
    ))
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
