//! A routine as one motion: its moves in order, followed, timed and checked (docs/guide/motion.md).

mod arrival;
pub(super) mod drive;
pub(super) mod goal;
pub(super) mod joints;
mod pace;
mod passing;
pub(super) mod routine;
pub(super) mod sequence;
mod thresholds;
mod write;
