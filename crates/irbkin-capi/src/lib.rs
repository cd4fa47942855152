//! The C interface: handles, plain numbers, codes and messages. `include/irbkin.h` is made of it.
//!
//! Each function turns the pointers of its caller into references (`arguments`), calls irbkin and
//! writes what it answers. `fault::guarded` makes codes and messages of errors and of panics. What
//! `unsafe` relies on are the rules at the top of the header.
#![cfg_attr(test, allow(clippy::unwrap_used, clippy::panic, clippy::indexing_slicing))]
#![allow(clippy::missing_safety_doc, reason = "the rules are at the top of the header")]
#![allow(clippy::too_many_arguments, reason = "a C function has no other way")]

use core::ffi::c_char;

mod arguments;
pub mod fault;
pub mod handle;

// The functions, in the order of the header.
pub mod robot;

pub mod solve;

pub mod rows;

pub mod path;

pub mod cell;

#[cfg(test)]
mod tests;

use irbkin::Status;

/// Most joints of a robot.
pub const IRBKIN_MOST_JOINTS: usize = 7;
/// Most slots of an answer.
pub const IRBKIN_MOST_SLOTS: usize = 16;

/// The slot holds a solution.
pub const IRBKIN_STATUS_FOUND: u8 = 1;
/// The solution is inside the joint limits.
pub const IRBKIN_STATUS_WITHIN_LIMITS: u8 = 2;
/// The solution is at the wrist singularity.
pub const IRBKIN_STATUS_WRIST: u8 = 4;
/// The arm is stretched or folded.
pub const IRBKIN_STATUS_ELBOW: u8 = 8;
/// The solution is at the shoulder singularity.
pub const IRBKIN_STATUS_SHOULDER: u8 = 16;
/// The slot is empty: its solution coincides with another slot's at a singularity.
pub const IRBKIN_STATUS_MERGED: u8 = 32;
/// The input of this row was invalid.
pub const IRBKIN_STATUS_INVALID: u8 = 64;
/// It is not certain that the slots hold every solution of the pose.
pub const IRBKIN_STATUS_UNCERTIFIED: u8 = 128;

const _: () = assert!(
    IRBKIN_STATUS_FOUND == Status::FOUND.bits()
        && IRBKIN_STATUS_WITHIN_LIMITS == Status::WITHIN_LIMITS.bits()
        && IRBKIN_STATUS_WRIST == Status::WRIST.bits()
        && IRBKIN_STATUS_ELBOW == Status::ELBOW.bits()
        && IRBKIN_STATUS_SHOULDER == Status::SHOULDER.bits()
        && IRBKIN_STATUS_MERGED == Status::MERGED.bits()
        && IRBKIN_STATUS_INVALID == Status::INVALID.bits()
        && IRBKIN_STATUS_UNCERTIFIED == Status::UNCERTIFIED.bits()
);

/// The version of the library, as "0.1.0".
#[unsafe(no_mangle)]
pub extern "C" fn irbkin_version() -> *const c_char {
    concat!(env!("CARGO_PKG_VERSION"), "\0").as_ptr().cast()
}

/// The message of the last call of this thread that failed, which names the argument, its value and
/// the bound; empty if none failed. It is valid until the next call of this thread that fails.
#[unsafe(no_mangle)]
pub extern "C" fn irbkin_last_error() -> *const c_char {
    fault::last()
}
