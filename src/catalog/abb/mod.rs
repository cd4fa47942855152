//! ABB IRB arms, by type number.
//!
//! Figures collected on 2026-11-21 from public repositories, by majority where they disagree:
//! `RobotComponents/RobotComponents` @ 8eaaf1a2cc, visose/Robots (branch libraries) @ 1573995b4d,
//! `ros-industrial/abb` @ 77db19bdb0, `ros-industrial/abb_experimental` @ 20b9cf86ad,
//! `PickNikRobotics/abb_ros2` @ 0705714217, `SaltworkerMLU/robotkinematicscatalogue` @ ea88ef98a3,
//! 4rtur1t0/ARTE @ a8df0b121e, `bourumir-wyngs/rs-opw-kinematics` @ fb51d85bd7,
//! `rpiRobotics/abb_motion_program_exec` @ 3891d1b78a, `compas-dev/compas_fab` @ 293d7aa033,
//! `work-r-labs/robots` @ 2197067 (made from CAD: its flanges differ), texts of ABB's data sheets in
//! `rox-architecture/RODEOS` @ 99acffd. "`RobotStudio`" are tables and axes in its own files, which
//! `Robot.from_robotstudio` reads: `compas-rrc/compas_rrc_start`, `JuanLopezP/RobotStudio`,
//! `M-KASSEM/RobotStudio-Tutorial`, `IFRA-Cranfield/ros2_SimRealRobotControl`,
//! Wlups/ABB-Robotstudio, `EkhiABB/DigitalTwin-RobotStudio-SmartComponent`, Maurilio97-P's palletizer.
//!
//! The first clause of a provenance names the sources of the lengths, as many as `sources` counts;
//! the clauses after it name sources of other figures, and figures that were not taken. "Alone" is one
//! source, "unsettled" a figure that none decides. What is left out, and why:
//! docs/evidence/catalog.md.

mod heavy;
mod large;
mod medium;
mod small;
mod yumi;

pub(super) use yumi::RULES as YUMI_RULES;

use super::{CatalogArm, CatalogGeometry, Linkage, NOTHING_KNOWN};

/// The fields that all rows share.
const ABB: CatalogArm = CatalogArm { maker: "ABB", ..NOTHING_KNOWN };

/// The geometry of an arm by a1, a2, c1, c2, c3, c4 [mm].
const fn lengths(mm: [f64; 6], linkage: Linkage) -> CatalogGeometry {
    let [a1, a2, c1, c2, c3, c4] = mm;
    CatalogGeometry::Abb { a1, a2, c1, c2, c3, c4, linkage }
}

pub(super) const SERIES: [&[CatalogArm]; 5] =
    [small::ARMS, medium::ARMS, large::ARMS, heavy::ARMS, yumi::ARMS];
