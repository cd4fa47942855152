//! Expressions: read as trees, and evaluated to values once names are looked up.

pub(crate) mod content;
pub(crate) mod direct;
mod displaced;
pub(crate) mod evaluate;
mod functions;
pub(crate) mod names;
pub(crate) mod predefined;
pub(crate) mod reader;
mod reference;
pub(crate) mod tree;
