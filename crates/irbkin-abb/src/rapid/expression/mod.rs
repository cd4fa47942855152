//! Expressions: read as trees, and evaluated to values once names are looked up.

pub(crate) mod content;
pub(crate) mod direct;
pub(crate) mod evaluate;
pub(crate) mod functions;
mod geometry;
pub(crate) mod names;
pub(crate) mod reader;
