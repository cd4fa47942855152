//! ABB's RAPID and EGM for [`irbkin`]: modules read, solved, checked, timed and rewritten, and the
//! messages of Externally Guided Motion.
#![no_std]
#![cfg_attr(
    test,
    allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::float_cmp)
)]
// If another crate of the build links std, its float methods shadow those imported for no_std.
#![cfg_attr(not(feature = "std"), allow(unused_imports))]

#[macro_use]
extern crate alloc;
#[cfg(any(test, feature = "std"))]
extern crate std;

pub mod egm;
mod error;
pub mod rapid;
#[cfg(test)]
#[path = "../../../tests/common/rng.rs"]
#[allow(dead_code, unreachable_pub)]
mod rng;

pub use error::Error;
use irbkin_motion::internal::prelude;
