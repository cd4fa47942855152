//! Requests and answers as JSON text: the engine of a page in a browser, compiled to WebAssembly
//! (`memory` has the exports).
//!
//! [`Page::answer`] answers a request, and keeps the robot, the cell and the program that earlier
//! ones set. Angles are in radians, lengths in meters; a pose
//! is 12 numbers, the first three rows of its matrix. A number that does not exist is `null`.
//!
//! ```
//! use irbkin_page::Page;
//!
//! let mut page = Page::default();
//! page.answer(r#"{"do": "robot", "name": "IRB 2600-12/1.65"}"#);
//! let answer = page.answer(r#"{"do": "fk", "q": [0, 0, 0, 0, 0.5, 0]}"#);
//! assert!(answer.starts_with(r#"{"ok":{"tool":["#));
//! ```
//!
//! | `do` | fields | answer |
//! |---|---|---|
//! | `catalog` | | [`catalog::Catalog`] |
//! | `robot` | `name`, or `urdf` with `base` and `tip`; `tool`, `base_pose` | [`robot::Arm`] |
//! | `cell` | `obstacles`, `margin` | [`cell::Obstacles`] |
//! | `fk` | `q`, `collide` | [`forward::Posture`] |
//! | `ik` | `T`, `seed`, `q7`, `collide` | [`inverse::PoseSolutions`] |
//! | `ik_target` | `robtarget`, `wobj` | [`target::Meant`] |
//! | `check` | `modules`, `collide` | [`check::Checked`] |
//! | `motion` | `modules`, `module`, `routine` | [`motion::Motion`] |
#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, clippy::panic))]
#![cfg_attr(test, allow(clippy::indexing_slicing, clippy::float_cmp))]

extern crate alloc;

pub mod catalog;
pub mod cell;
pub mod check;
mod engine;
pub mod forward;
pub mod inverse;
#[cfg(any(target_family = "wasm", test))]
pub mod memory;
pub mod motion;
mod posture;
mod program;
mod request;
pub mod robot;
pub mod target;

pub use engine::{Page, refused};
#[cfg(test)]
mod tests;
