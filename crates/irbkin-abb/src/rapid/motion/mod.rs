//! A routine as one motion: its moves in order, followed, timed and checked (docs/guide/motion.md).

pub(super) mod drive;
pub(super) mod goal;
pub(super) mod joints;
pub(super) mod routine;
pub(super) mod thresholds;
mod write;
