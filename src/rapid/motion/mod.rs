//! A routine as one motion: its moves in order, followed, timed and checked (docs/motion.md).

mod corner;
pub(super) mod drive;
pub(super) mod finding;
pub(super) mod goal;
pub(super) mod joints;
pub(super) mod options;
mod pace;
pub(super) mod routine;
pub(super) mod samples;
pub(super) mod sequence;
mod write;
