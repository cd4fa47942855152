//! All moves of a program checked, as a linter does (docs/guide/check.md).

pub(super) mod carried;
pub(super) mod checker;
mod confdata;
mod corners;
mod findings;
mod fixes;
pub(super) mod undeclared;
pub(super) mod unused;
