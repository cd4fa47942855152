//! The laws of RAPID and EGM, on the public interface.
#![allow(unreachable_pub, dead_code)]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::float_cmp)]

mod common;
mod rapid;
mod rapid_calc;
mod rapid_fuzz;
mod rapid_motion;
mod stream_egm;
