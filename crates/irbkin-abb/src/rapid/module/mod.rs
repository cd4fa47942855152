//! Whole modules: read, compared, made, written, and rewritten in place.

pub(super) mod differences;
pub(super) mod read;
pub(super) mod write;
