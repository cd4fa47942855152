//! Arithmetic that runs on several numbers at once: several poses, joints or branches, one a lane.
//!
//! A kernel is plain arithmetic on `f64` in a loop over arrays of a fixed, small length. The
//! compiler makes vector instructions of such a loop, as wide as the set allows that the function
//! around it is compiled for ([`run`]), on three conditions: everything in the loop is
//! `#[inline(always)]`, nothing in it branches or loops, and what it reads and writes lies in
//! columns, lane beside lane. Each lane is calculated by itself, so an answer does not depend on
//! the other lanes.

mod dispatch;
mod functions;

pub use dispatch::InstructionSet;
#[cfg(test)]
pub(crate) use dispatch::on_each_set;
pub(crate) use dispatch::{Kernel, run};
pub(crate) use functions::{
    MOST_SIN_COS, atan2, mul_add, nearest_whole, sin_cos, whole_above, whole_below,
};

/// Lanes of a block: the widest vector of any instruction set, in `f64`.
pub(crate) const LANES: usize = 8;

/// A number for each lane.
pub(crate) type Column = [f64; LANES];

/// Flags for each lane: as wide as the numbers, so that both move through vectors side by side.
pub(crate) type Flags = [u64; LANES];
