//! The closure of a chain of six joints between two frames: Newton's method on its six conditions,
//! and the configurations that it accepts.
//!
//! Lengths are in units of the chain's own, so that positions and rotations weigh the same. Angles
//! are the table's, theta = q + offset (docs/theory/general.md, eq. 97 to 104).
//!
//! `newton` brings a candidate to the pose; [`Accepted`] takes what closes, each solution once. What
//! is singular is tried for a `self_motion`, which is followed and stands as one member.

mod accepted;
mod chain;
mod configuration;
mod freedom;
mod newton;
mod order;
mod placed;
mod reflections;
mod remains;
mod self_motion;
#[cfg(test)]
mod tests;
mod truncated;

pub(crate) use accepted::Accepted;
pub(crate) use chain::{Closure, Target};
pub(crate) use configuration::Configuration;
pub(crate) use newton::{Candidates, Six};
pub(crate) use order::{BelowAndNear, Order, TIED, in_order, in_order_one_by_one};
pub(crate) use placed::Placed;
pub(crate) use reflections::reflect;
pub(crate) use self_motion::SelfMotion;
