//! The laws, on the public interface.
//!
//! A new file of tests is a module here, see `CONTRIBUTING.md`. `lanes` forces instruction sets in
//! the whole process: its tests are ignored, and run by themselves.
#![allow(unreachable_pub)]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::float_cmp)]

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
mod five_axes;
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
mod reach_and_paths;
mod recall;
mod redundancy;
mod refined;
mod serde;
mod seven_paths;
mod snap;
mod states;
mod stream;
mod structures;
mod urdf;
mod urdf_time;
mod urdf_write;

use common::rng;
