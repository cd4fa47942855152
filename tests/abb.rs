//! The laws of RAPID and EGM, on the public interface.
#![allow(unreachable_pub, dead_code)]

mod common;
mod rapid;
mod rapid_calc;
mod rapid_fuzz;
mod rapid_motion;
mod stream_egm;
