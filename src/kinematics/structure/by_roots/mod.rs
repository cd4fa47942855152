//! Regular poses of arms whose solutions are at the roots of a trigonometric polynomial: several
//! poses share the lanes.
//!
//! A pose is regular if every root is simple and a candidate at it closes away from every
//! singularity, next to the root. No two of the solutions being the same, there are as many as
//! roots, which are all that there can be.
//!
//! Docs: offset_wrist.md, section 6, and general.md, section 7.

mod block;
mod counts;
mod in_cluster;
mod method;
mod regular;
mod solved;
#[cfg(test)]
pub(crate) mod tests;

pub(crate) use block::RootKernel;
pub(crate) use counts::BESIDE;
pub(crate) use in_cluster::InCluster;
pub(crate) use method::{ByRoots, SLOTS};
pub(crate) use regular::regular_of;
