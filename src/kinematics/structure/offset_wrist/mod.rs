//! Arms with an offset wrist: axes 2 and 3 parallel, axis 4 meets axis 5, axis 6 does not meet
//! them. Such are ABB's GoFa, FANUC's CRX, UFACTORY's xArm6 and Kinova's JACO2.
//!
//! `docs/offset_wrist.md` has the derivation, with the equation numbers (from 50 on) cited in the
//! code.
#![allow(dead_code)]

mod branch;
mod determinant;
mod geometry;
mod measure;
mod resultant;
mod seeds;
mod solve;
#[cfg(test)]
mod tests;

pub(crate) use geometry::OffsetWrist;
