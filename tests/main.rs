//! The suite: one binary, because linking and optimizing one per file took most of the time.
//!
//! A new file of tests is a module here, see `CONTRIBUTING.md`. Tests that force an instruction set
//! in the whole process are in `lanes.rs`, which is a separate binary.
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
mod joint_axes;
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
mod serde;
mod seven_paths;
#[cfg(feature = "urdf")]
mod snap;
mod structures;
#[cfg(feature = "urdf")]
mod urdf;
#[cfg(feature = "urdf")]
mod urdf_time;
#[cfg(feature = "urdf")]
mod urdf_write;

use common::rng;
