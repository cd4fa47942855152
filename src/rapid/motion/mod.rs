//! A routine as one motion: its moves in order, followed, timed and checked (docs/motion.md).

mod corner;
mod drive;
pub(super) mod finding;
mod goal;
mod joints;
pub(super) mod options;
mod pace;
pub(super) mod routine;
mod samples;
mod sequence;
mod write;
