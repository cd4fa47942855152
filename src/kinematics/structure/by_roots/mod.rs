//! Arms whose solutions are at the roots of a trigonometric polynomial, in three levels.
//!
//! 1. `regular`: several poses share the lanes. A pose is regular if every root is simple and a
//!    candidate at it closes away from every singularity, next to the root. No two of the solutions
//!    being the same, there are as many as roots, which are all that there can be: the answer is
//!    certified.
//! 2. `search`: all roots and clusters of one polynomial after another. The answer is certified if
//!    one has simple roots alone, with a regular solution at each and no other.
//! 3. `search`, too: starts all over the joints. The answer is not certified.
//!
//! Docs: offset_wrist.md, section 6, and general.md, section 7.

mod attempt;
mod block;
mod method;
mod regular;
mod search;
mod solved;
#[cfg(test)]
pub(crate) mod tests;

pub(crate) use attempt::{AT_ROOT, certifies};
pub(crate) use block::RootKernel;
pub(crate) use method::{ByRoots, SLOTS};
pub(crate) use regular::{NOISE_OF_SIZE, regular_of, size_of};
pub(crate) use search::{Search, quasi_random};
