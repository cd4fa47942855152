//! All moves of a module checked, as a linter does (docs/guide/check.md).

pub(super) mod checker;
mod fixes;
mod inherited;
mod runs;
