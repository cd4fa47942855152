//! All moves of a program checked, as a linter does (docs/guide/check.md).

pub(super) mod checker;
mod corners;
mod findings;
mod fixes;
mod loading;
pub(super) mod port;
pub(super) mod tasks;
pub(super) mod undeclared;
mod world_zones;
