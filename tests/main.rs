//! The suite: the laws, on the public interface. `src/lib.rs` includes it, so that the crate is
//! compiled once for them and for its unit tests.
//!
//! A new file of tests is a module here, see `CONTRIBUTING.md`. `lanes` forces instruction sets in
//! the whole process: its tests are ignored, and run by themselves.
#![allow(unreachable_pub)]

mod allocation;
mod any_robot;
mod bodies;
mod bounds;
mod catalog;
mod catalog_page;
mod cell;
mod cell_paths;
mod certificates;
mod common;
mod configuration;
mod corrections;
mod coupled;
mod display;
mod follow;
mod general;
mod go;
mod hard_sets;
mod hulls;
mod joint_axes;
mod lanes;
mod laws;
mod locked;
mod nearest;
mod offset_wrist;
#[cfg(feature = "rapid")]
mod rapid;
#[cfg(feature = "rapid")]
mod rapid_calc;
#[cfg(feature = "rapid")]
mod rapid_fuzz;
#[cfg(feature = "rapid")]
mod rapid_motion;
mod reach_and_paths;
mod recall;
mod redundancy;
mod refined;
#[cfg(feature = "serde")]
mod serde;
mod seven_paths;
#[cfg(feature = "urdf")]
mod snap;
mod states;
mod stream;
mod stream_egm;
pub(crate) mod structures;
#[cfg(feature = "urdf")]
mod urdf;
#[cfg(feature = "urdf")]
mod urdf_time;
#[cfg(feature = "urdf")]
mod urdf_write;

pub(crate) use common::rng;
