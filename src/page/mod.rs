//! Requests and answers as JSON text (feature `page`): the engine of a page in a browser.
//!
//! [`Page::answer`] answers a request, and keeps the robot, the cell and the program that earlier
//! ones set. Angles are in radians, lengths in meters; a pose
//! is 12 numbers, the first three rows of its matrix. A number that does not exist is `null`.
//!
//! ```
//! use irbkin::page::Page;
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
//! | `urdf` | | the text of a URDF |
//! | `cell` | `obstacles`, `margin` | [`cell::Obstacles`] |
//! | `fk` | `q`, `collide` | [`forward::Posture`] |
//! | `ik` | `T`, `seed`, `q7`, `collide` | [`inverse::Found`] |
//! | `follow` | `T`, `q`, `collide` | [`follow::Step`] |
//! | `ik_target` | `robtarget`, `wobj` | [`target::Meant`] |
//! | `check` | `modules`, `collide` | [`check::Checked`] |
//! | `motion` | `modules`, `module`, `routine` | [`motion::Motion`] |
//!
//! `ik_target`, `check` and `motion` have the feature `rapid`; `urdf` and a `robot` of a URDF the
//! feature `urdf`.

pub mod catalog;
pub mod cell;
#[cfg(feature = "rapid")]
pub mod check;
mod engine;
pub mod follow;
pub mod forward;
pub mod inverse;
#[cfg(feature = "rapid")]
pub mod motion;
mod posture;
#[cfg(feature = "rapid")]
mod program;
mod request;
pub mod robot;
#[cfg(feature = "rapid")]
pub mod target;

pub use engine::{Page, refused};
