//! The answer of a solve: flags, reach, solutions in their slots, and the choice among them.

pub(crate) mod check;
mod display;
pub(crate) mod request;
pub(crate) mod select;
pub(crate) mod singularity;
pub(crate) mod slot;
pub(crate) mod solutions;
pub(crate) mod status;
