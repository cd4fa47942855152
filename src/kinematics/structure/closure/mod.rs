//! The closure of a chain of six joints between two frames: Newton's method on its six conditions,
//! and the configurations that it accepts.
//!
//! Lengths are in units of the chain's own, so that positions and rotations weigh the same. Angles
//! are those of the table, theta = q + offset (docs/general.md, eq. 97 to 104).

mod accepted;
mod chain;
mod configuration;
mod crossing;
mod curve;
mod flat;
mod fold;
mod freedom;
mod member;
mod members;
mod merged;
mod newton;
mod order;
mod placed;
mod powers;
mod reflections;
mod self_motion;
mod surface;
mod surfaces;
#[cfg(test)]
mod tests;
mod walked;

pub(crate) use accepted::Accepted;
pub(crate) use chain::{Closure, Target};
pub(crate) use configuration::{Configuration, Kind, Missed};
pub(crate) use newton::{Candidates, Six};
pub(crate) use order::in_order;
pub(crate) use placed::Placed;
pub(crate) use reflections::reflect;
