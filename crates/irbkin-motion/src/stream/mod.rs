//! Set points for a control loop, within bounds and with a proven way to stop
//! (docs/theory/stream.md). This is no safety function.
//!
//! A [`Guard`] gets a reference in each cycle, or none, and answers with a set point. After every
//! cycle a braking motion exists that keeps the bounds and is proven free; what does not fit is
//! refused with the [`Reason`], and the guard brakes. It has no clock and no socket, and a step
//! does not allocate.
//!
//! ```
//! use irbkin_motion::Arm;
//! use irbkin_motion::cell::Cell;
//! use irbkin_motion::stream::{Guard, GuardOptions, State};
//!
//! let arm: Arm<6> = Arm::named("IRB 2600-12/1.65")?;
//! let options = GuardOptions { max_jerk: Some([60.0; 6]), ..GuardOptions::new(0.004, [8.0; 6]) };
//! let start = [0.0, 0.0, 0.0, 0.0, 0.5, 0.0];
//! let mut guard = Guard::new(&arm, &start, Some(&Cell::default()), &options)?;
//!
//! let mut reference = start;
//! reference[0] += 1e-6;
//! assert!(guard.step(&reference).accepted);
//! reference[0] += 1.0;
//! let step = guard.step(&reference);
//! assert_eq!(step.state, State::Braking);
//! assert!(guard.words(&step.reason.unwrap()).starts_with("joint 1 would need"));
//! # Ok::<(), irbkin_motion::Error>(())
//! ```

/// The Rust blocks of the guide, run as documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../../../../docs/guide/stream.md")]
pub struct GuideBlocks;

mod ahead;
mod brake;
mod guard;
mod limit;
mod options;
mod reason;
mod tool;
mod track;

pub use guard::Guard;
pub use options::{GuardOptions, OnViolation, State, Step};
pub use reason::{Bound, Reason};
