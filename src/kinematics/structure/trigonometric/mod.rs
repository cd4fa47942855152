//! Trigonometric polynomials of degree 8, from samples: their noise, and all of their real roots.
//!
//! The condition for a six-joint chain to close, as a function of one joint angle, is such a
//! polynomial. Its roots are the values of that joint in all solutions (docs/theory/general.md, eq.
//! 91 to 96).

mod arcs;
mod brackets;
mod clusters;
mod isolation;
mod pair;
mod part;
mod polynomial;
mod refinement;
mod roots;
mod search;
mod tables;
#[cfg(test)]
mod tests;

pub(crate) use clusters::{NARROW, WIDE};
pub(crate) use polynomial::TrigonometricPolynomial;
pub(crate) use roots::{Root, Roots};
pub(crate) use search::{RootBlock, SimpleRoots};
pub(crate) use tables::{SAMPLE_COS, SAMPLE_SIN, SAMPLES};
