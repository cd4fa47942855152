//! Expressions: read as trees, and evaluated to values once names are looked up.

pub(crate) mod content;
mod displaced;
pub(crate) mod evaluate;
mod functions;
pub(crate) mod names;
pub(crate) mod plain;
pub(crate) mod reader;
mod reference;
pub(crate) mod tree;
