//! `YuMi`: seven axes, in the order 1, 2, 7, 3, 4, 5, 6 from the base to the flange.
//!
//! `RobotStudio`'s own poses of the IRB 14050 (`rpiRobotics/yumi-ik` @ 2bd424d3ac,
//! `unit_tests/compare_to_robotstudio.m`) need axis 2 at 306 mm: 305 is in
//! robotkinematicscatalogue. The angles at which the arms of the IRB 14000 stand are
//! `gravity_alpha`, `gravity_beta` and `gravity_gamma` of a controller's MOC.cfg; their places are
//! fitted to its home targets, and the ones in `yumi_description` are within 0.2 mm.

use crate::catalog::{CatalogArm, CatalogGeometry, NOTHING_KNOWN};
use crate::report::ConfigurationRule;

pub(super) const ARMS: &[CatalogArm] = &[LEFT, RIGHT, SINGLE];

/// The rows of an arm whose axis 2 is at a height [mm].
const fn rows(height: f64) -> [[f64; 4]; 7] {
    [
        [0.0, 0.0, height, 0.0],
        [-90.0, -30.0, 0.0, 0.0],
        [90.0, 30.0, 251.5, 0.0],
        [-90.0, 40.5, 0.0, 90.0],
        [90.0, -40.5, 265.0, 0.0],
        [-90.0, 27.0, 0.0, 0.0],
        [90.0, -27.0, 36.0, 0.0],
    ]
}

const LIMITS: &[[f64; 2]] = &[
    [-168.5, 168.5],
    [-143.5, 43.5],
    [-168.5, 168.5],
    [-123.5, 80.0],
    [-290.0, 290.0],
    [-88.0, 138.0],
    [-229.0, 229.0],
];

const VELOCITY: &[f64] = &[180.0, 180.0, 180.0, 180.0, 400.0, 400.0, 400.0];

/// Where an arm of the IRB 14000 counts its arm angle from, in the frame of the body: its outer
/// side.
const fn outward(y: f64) -> ConfigurationRule {
    ConfigurationRule::ArmAngle { reference: [0.0, y, 0.0] }
}

pub(in crate::catalog) const RULES: [(&str, ConfigurationRule); 3] =
    [(LEFT.name, outward(-1.0)), (RIGHT.name, outward(1.0)), (SINGLE.name, outward(1.0))];

const SINGLE: CatalogArm = CatalogArm {
    name: "IRB 14050-0.5/0.5",
    maker: "ABB",
    payload: Some(0.5),
    reach: Some(0.5),
    geometry: CatalogGeometry::Mdh(&rows(306.0)),
    limits: LIMITS,
    max_velocity: Some(VELOCITY),
    sources: 3,
    provenance: "robotkinematicscatalogue, ARTE, RobotStudio (poses in rpiRobotics/yumi-ik); limits \
        and speeds of OrebroUniversity/yumi; axis 2 is at 305 mm in robotkinematicscatalogue, and \
        its axis 2 ends at 143.5 deg; axes in the order 1, 2, 7, 3, 4, 5, 6",
    ..NOTHING_KNOWN
};

const LEFT: CatalogArm = CatalogArm {
    name: "IRB 14000-0.5/0.5 (left)",
    geometry: CatalogGeometry::StandingMdh {
        xyz: [53.711, 72.573, 415.010],
        turns: [-0.629_233, 0.950_657, -0.184_266],
        rows: &rows(100.0),
    },
    provenance: BODY,
    ..SINGLE
};

const RIGHT: CatalogArm = CatalogArm {
    name: "IRB 14000-0.5/0.5 (right)",
    geometry: CatalogGeometry::StandingMdh {
        xyz: [53.711, -72.573, 415.010],
        turns: [0.629_233, 0.950_657, 0.184_266],
        rows: &rows(100.0),
    },
    provenance: BODY,
    ..SINGLE
};

const BODY: &str = "robotkinematicscatalogue, ARTE, RobotStudio (a program's home); as the IRB \
    14050, with axis 2 at 100 mm; its frame in the body is turned as a \
    controller's MOC.cfg says, and placed by its home targets (53.55, 72.50, 414.92 mm in \
    OrebroUniversity/yumi)";
