//! Whole modules: read, made, written, and rewritten in place.

mod build;
pub(super) mod parse;
pub(super) mod record;
pub(super) mod rewrite;
mod write;
