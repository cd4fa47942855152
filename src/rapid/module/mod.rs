//! Whole modules: read, made, written, and rewritten in place.

pub(super) mod read;
pub(super) mod write;
