//! Arithmetic on several numbers at once: several poses, joints or branches, one per lane.
//!
//! A kernel is plain arithmetic on `f64` in a loop over arrays of a fixed, small length. The
//! compiler turns such a loop into vector instructions, as wide as the instruction set permits for
//! which the surrounding function is compiled ([`run`]), on three conditions: everything in the
//! loop is `#[inline(always)]`, nothing in it branches or loops, and its input and output are
//! columns, lane beside lane. Each lane is computed independently, so an answer does not depend on
//! the other lanes.

mod dispatch;
mod functions;
mod number;
mod vector;

pub use dispatch::{InstructionSet, Kernel, run};
pub(crate) use functions::{
    MOST_SIN_COS, atan2, atan2_of, mul_add, sin_cos, sin_cos_of, whole_above,
};
pub use functions::{nearest_whole, whole_below};
pub use number::{Number, cross, dot};
#[cfg(test)]
pub(crate) use vector::run_on;
pub use vector::{Vector, VectorKernel, run_vectors};
pub(crate) use vector::{same, transposed};

/// Lanes of a block: the widest vector of any instruction set, in `f64`.
pub const LANES: usize = 8;

/// A number for each lane.
pub type Column = [f64; LANES];

/// Flags for each lane: as wide as the numbers, so that both move through vectors together.
pub(crate) type Flags = [u64; LANES];
