//! The engine of a page in a browser, [`irbkin::page`], compiled to WebAssembly.
#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, clippy::panic))]
#![cfg_attr(test, allow(clippy::indexing_slicing, clippy::float_cmp))]

pub mod memory;
#[cfg(all(test, feature = "rapid", feature = "urdf"))]
mod tests;
