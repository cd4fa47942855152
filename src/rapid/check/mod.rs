//! All moves of a module checked, as a linter does (docs/check.md).

pub(super) mod checker;
pub(super) mod code;
mod confdata;
pub(super) mod diagnostic;
mod fixes;
mod inherited;
mod runs;
mod zones;
