//! Universal Robots' arms.
//!
//! Standard Denavit-Hartenberg parameters as published by Universal Robots (article "DH parameters
//! for calculations of kinematics and dynamics"), validated against ur-analytic-ik 0.1.0. Base and
//! flange are frames 0 and 6 of that table. A machine's own calibration moves its tool by 1 to 2 mm
//! from them. Payload and reach are general knowledge of the data sheets. Joint speeds are
//! those of the user manuals, as Universal Robots' ROS description repeats them; it has UR20's for
//! the UR30, and no source with a second one has those of the UR8 Long, UR15 and UR18. Planners
//! usually limit joint 3 to +-180 deg; the machine does not.

use super::{CatalogArm, CatalogGeometry, NOTHING_KNOWN};

/// The fields that all rows share.
const UR: CatalogArm =
    CatalogArm { maker: "Universal Robots", limits: &[[-360.0, 360.0]; 6], ..NOTHING_KNOWN };

pub(super) const ARMS: &[CatalogArm] = &[
    CatalogArm {
        name: "UR3",
        payload: Some(3.0),
        reach: Some(0.5),
        geometry: CatalogGeometry::ThreeParallel {
            d1: 151.9,
            a2: -243.65,
            a3: -213.25,
            d4: 112.35,
            d5: 85.35,
            d6: 81.9,
        },
        max_velocity: Some(&[180.0, 180.0, 180.0, 360.0, 360.0, 360.0]),
        sources: 2,
        provenance: "Universal Robots, ur-analytic-ik; joint 6 of the machine turns without end",
        ..UR
    },
    CatalogArm {
        name: "UR3e",
        payload: Some(3.0),
        reach: Some(0.5),
        geometry: CatalogGeometry::ThreeParallel {
            d1: 151.85,
            a2: -243.55,
            a3: -213.2,
            d4: 131.05,
            d5: 85.35,
            d6: 92.1,
        },
        max_velocity: Some(&[180.0, 180.0, 180.0, 360.0, 360.0, 360.0]),
        sources: 2,
        provenance: "Universal Robots, ur-analytic-ik; joint 6 of the machine turns without end",
        ..UR
    },
    CatalogArm {
        name: "UR5",
        payload: Some(5.0),
        reach: Some(0.85),
        geometry: CatalogGeometry::ThreeParallel {
            d1: 89.159,
            a2: -425.0,
            a3: -392.25,
            d4: 109.15,
            d5: 94.65,
            d6: 82.3,
        },
        max_velocity: Some(&[180.0, 180.0, 180.0, 180.0, 180.0, 180.0]),
        sources: 2,
        provenance: "Universal Robots, ur-analytic-ik",
        ..UR
    },
    CatalogArm {
        name: "UR5e",
        payload: Some(5.0),
        reach: Some(0.85),
        geometry: CatalogGeometry::ThreeParallel {
            d1: 162.5,
            a2: -425.0,
            a3: -392.2,
            d4: 133.3,
            d5: 99.7,
            d6: 99.6,
        },
        max_velocity: Some(&[180.0, 180.0, 180.0, 180.0, 180.0, 180.0]),
        sources: 2,
        provenance: "Universal Robots, ur-analytic-ik",
        ..UR
    },
    CatalogArm {
        name: "UR7e",
        payload: Some(7.5),
        reach: Some(0.85),
        geometry: CatalogGeometry::ThreeParallel {
            d1: 162.5,
            a2: -425.0,
            a3: -392.2,
            d4: 133.3,
            d5: 99.7,
            d6: 99.6,
        },
        max_velocity: Some(&[180.0, 180.0, 180.0, 180.0, 180.0, 180.0]),
        sources: 2,
        provenance: "Universal Robots, ur-analytic-ik; the UR5e under a new name",
        ..UR
    },
    CatalogArm {
        name: "UR8 Long",
        payload: Some(8.0),
        reach: Some(1.75),
        geometry: CatalogGeometry::ThreeParallel {
            d1: 218.6,
            a2: -898.9,
            a3: -714.9,
            d4: 182.4,
            d5: 136.1,
            d6: 143.4,
        },
        max_velocity: None,
        sources: 2,
        provenance: "Universal Robots, ur-analytic-ik",
        ..UR
    },
    CatalogArm {
        name: "UR10",
        payload: Some(10.0),
        reach: Some(1.3),
        geometry: CatalogGeometry::ThreeParallel {
            d1: 127.3,
            a2: -612.0,
            a3: -572.3,
            d4: 163.941,
            d5: 115.7,
            d6: 92.2,
        },
        max_velocity: Some(&[120.0, 120.0, 180.0, 180.0, 180.0, 180.0]),
        sources: 2,
        provenance: "Universal Robots, ur-analytic-ik",
        ..UR
    },
    CatalogArm {
        name: "UR10e",
        payload: Some(10.0),
        reach: Some(1.3),
        geometry: CatalogGeometry::ThreeParallel {
            d1: 180.7,
            a2: -612.7,
            a3: -571.55,
            d4: 174.15,
            d5: 119.85,
            d6: 116.55,
        },
        max_velocity: Some(&[120.0, 120.0, 180.0, 180.0, 180.0, 180.0]),
        sources: 2,
        provenance: "Universal Robots, ur-analytic-ik",
        ..UR
    },
    CatalogArm {
        name: "UR12e",
        payload: Some(12.5),
        reach: Some(1.3),
        geometry: CatalogGeometry::ThreeParallel {
            d1: 180.7,
            a2: -612.7,
            a3: -571.55,
            d4: 174.15,
            d5: 119.85,
            d6: 116.55,
        },
        max_velocity: Some(&[120.0, 120.0, 180.0, 180.0, 180.0, 180.0]),
        sources: 2,
        provenance: "Universal Robots, ur-analytic-ik; the UR10e under a new name",
        ..UR
    },
    CatalogArm {
        name: "UR15",
        payload: Some(15.0),
        reach: Some(1.3),
        geometry: CatalogGeometry::ThreeParallel {
            d1: 218.6,
            a2: -647.5,
            a3: -516.4,
            d4: 182.4,
            d5: 136.1,
            d6: 143.4,
        },
        max_velocity: None,
        sources: 2,
        provenance: "Universal Robots, ur-analytic-ik",
        ..UR
    },
    CatalogArm {
        name: "UR16e",
        payload: Some(16.0),
        reach: Some(0.9),
        geometry: CatalogGeometry::ThreeParallel {
            d1: 180.7,
            a2: -478.4,
            a3: -360.0,
            d4: 174.15,
            d5: 119.85,
            d6: 116.55,
        },
        max_velocity: Some(&[120.0, 120.0, 180.0, 180.0, 180.0, 180.0]),
        sources: 2,
        provenance: "Universal Robots, ur-analytic-ik",
        ..UR
    },
    CatalogArm {
        name: "UR18",
        payload: Some(18.0),
        reach: Some(0.95),
        geometry: CatalogGeometry::ThreeParallel {
            d1: 218.6,
            a2: -475.0,
            a3: -338.9,
            d4: 182.4,
            d5: 136.1,
            d6: 143.4,
        },
        max_velocity: None,
        sources: 2,
        provenance: "Universal Robots, ur-analytic-ik",
        ..UR
    },
    CatalogArm {
        name: "UR20",
        payload: Some(20.0),
        reach: Some(1.75),
        geometry: CatalogGeometry::ThreeParallel {
            d1: 236.3,
            a2: -862.0,
            a3: -728.7,
            d4: 201.0,
            d5: 159.3,
            d6: 154.3,
        },
        max_velocity: Some(&[120.0, 120.0, 150.0, 210.0, 210.0, 210.0]),
        sources: 2,
        provenance: "Universal Robots, ur-analytic-ik",
        ..UR
    },
    CatalogArm {
        name: "UR30",
        payload: Some(30.0),
        reach: Some(1.3),
        geometry: CatalogGeometry::ThreeParallel {
            d1: 236.3,
            a2: -637.0,
            a3: -503.7,
            d4: 201.0,
            d5: 159.3,
            d6: 154.3,
        },
        max_velocity: Some(&[120.0, 120.0, 150.0, 210.0, 210.0, 210.0]),
        sources: 2,
        provenance: "Universal Robots, ur-analytic-ik",
        ..UR
    },
];
