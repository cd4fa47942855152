//! Arms with an offset wrist: ABB's GoFa, FANUC's CRX and UFACTORY's xArm6.
//!
//! GoFa: sources as of the other ABB arms; validated against a pair of joints and pose that a
//! controller reported (eliasbitsch/MetaMove). CRX: the maker's URDF
//! (`FANUC-CORPORATION/fanuc_description` @ 785ff6792f) and Abbes and Poisson, Geometric approach
//! for inverse kinematics of the FANUC CRX collaborative robot, Robotics 13, 2024, table 2;
//! validated against the joint vectors that the article has for its three poses. xArm6: the maker's
//! table (`xArm-Developer/ufactory_docs`), its URDF (`xArm-Developer/xarm_ros2`) and Viam's model
//! (`viamrobotics/rdk`), with two poses of whose tests it is validated.

use super::{CatalogArm, CatalogGeometry, NOTHING_KNOWN};

pub(super) const ARMS: &[CatalogArm] = &[GOFA_5, GOFA_10, GOFA_12, CRX_10IA, CRX_10IAL, XARM_6];

const GOFA_5: CatalogArm = CatalogArm {
    name: "CRB 15000-5/0.95",
    maker: "ABB",
    payload: Some(5.0),
    reach: Some(0.95),
    geometry: CatalogGeometry::Mdh(&[
        [0.0, 0.0, 265.0, 0.0],
        [-90.0, 0.0, 0.0, -90.0],
        [0.0, 444.0, 0.0, 0.0],
        [-90.0, 110.0, 470.0, 0.0],
        [90.0, 0.0, 0.0, 0.0],
        [-90.0, 80.0, 101.0, 180.0],
    ]),
    limits: &[
        [-180.0, 180.0],
        [-180.0, 180.0],
        [-225.0, 85.0],
        [-180.0, 180.0],
        [-180.0, 180.0],
        [-270.0, 270.0],
    ],
    max_velocity: Some(&[125.0, 125.0, 140.0, 200.0, 200.0, 200.0]),
    sources: 6,
    provenance: "RobotComponents, visose/Robots, ros-industrial/abb_experimental, \
        robotkinematicscatalogue, work-r-labs/robots, RobotStudio (axes); axis 6 is +-180 deg in \
        ros-industrial/abb_experimental and robotkinematicscatalogue, +-270 deg in three \
        controllers; axis 3 is to 55 deg in work-r-labs/robots",
    ..NOTHING_KNOWN
};

const GOFA_10: CatalogArm = CatalogArm {
    name: "CRB 15000-10/1.52",
    maker: "ABB",
    payload: Some(10.0),
    reach: Some(1.52),
    geometry: CatalogGeometry::Mdh(&[
        [0.0, 0.0, 400.0, 0.0],
        [-90.0, 150.0, 0.0, -90.0],
        [0.0, 707.0, 0.0, 0.0],
        [-90.0, 110.0, 637.0, 0.0],
        [90.0, 0.0, 0.0, 0.0],
        [-90.0, 80.0, 101.0, 180.0],
    ]),
    limits: GOFA_LARGE_LIMITS,
    max_velocity: Some(GOFA_LARGE_SPEEDS),
    sources: 4,
    provenance: "RobotComponents, visose/Robots, robotkinematicscatalogue, work-r-labs/robots; \
        visose/Robots has 399, 636 and 100.5 mm for d1, d4 and d6, and +-180 deg for axes 1 and 6; \
        speeds of work-r-labs/robots alone: other sources have the GoFa 5's",
    ..NOTHING_KNOWN
};

const GOFA_LARGE_SPEEDS: &[f64] = &[120.0, 120.0, 125.0, 200.0, 200.0, 200.0];

const GOFA_LARGE_LIMITS: &[[f64; 2]] = &[
    [-270.0, 270.0],
    [-180.0, 180.0],
    [-225.0, 85.0],
    [-180.0, 180.0],
    [-180.0, 180.0],
    [-270.0, 270.0],
];

const GOFA_12: CatalogArm = CatalogArm {
    name: "CRB 15000-12/1.27",
    maker: "ABB",
    payload: Some(12.0),
    reach: Some(1.27),
    geometry: CatalogGeometry::Mdh(&[
        [0.0, 0.0, 338.0, 0.0],
        [-90.0, 0.0, 0.0, -90.0],
        [0.0, 707.0, 0.0, 0.0],
        [-90.0, 110.0, 534.0, 0.0],
        [90.0, 0.0, 0.0, 0.0],
        [-90.0, 80.0, 101.0, 180.0],
    ]),
    limits: GOFA_LARGE_LIMITS,
    max_velocity: Some(GOFA_LARGE_SPEEDS),
    sources: 3,
    provenance: "RobotComponents, robotkinematicscatalogue, work-r-labs/robots; speeds of \
        work-r-labs/robots alone",
    ..NOTHING_KNOWN
};

const CRX_SPEEDS: &[f64] = &[120.0, 120.0, 180.0, 180.0, 180.0, 180.0];

const CRX_10IA: CatalogArm = CatalogArm {
    name: "CRX-10iA",
    maker: "FANUC",
    payload: Some(10.0),
    reach: Some(1.249),
    geometry: CatalogGeometry::Crx { d1: 245.0, a2: 540.0, d4: 540.0, d5: 150.0, d6: 160.0 },
    limits: &[
        [-190.0, 190.0],
        [-179.9, 179.9],
        [-71.0, 251.0],
        [-190.0, 190.0],
        [-179.9, 179.9],
        [-225.0, 225.0],
    ],
    max_velocity: Some(CRX_SPEEDS),
    sources: 2,
    provenance: "FANUC-CORPORATION/fanuc_description, Abbes and Poisson; joint 3 is measured from \
        the upper arm, as in the maker's URDF: the controller's J3 plus its J2",
    ..NOTHING_KNOWN
};

const CRX_10IAL: CatalogArm = CatalogArm {
    name: "CRX-10iA/L",
    maker: "FANUC",
    payload: Some(10.0),
    reach: Some(1.418),
    geometry: CatalogGeometry::Crx { d1: 245.0, a2: 710.0, d4: 540.0, d5: 150.0, d6: 160.0 },
    limits: &[
        [-179.9, 179.9],
        [-179.9, 179.9],
        [-270.0, 270.0],
        [-190.0, 190.0],
        [-179.9, 179.9],
        [-225.0, 225.0],
    ],
    max_velocity: Some(CRX_SPEEDS),
    sources: 2,
    provenance: "FANUC-CORPORATION/fanuc_description, Abbes and Poisson; joint 3 as of the \
        CRX-10iA",
    ..NOTHING_KNOWN
};

const XARM_6: CatalogArm = CatalogArm {
    name: "xArm6",
    maker: "UFACTORY",
    payload: Some(5.0),
    reach: Some(0.7),
    geometry: CatalogGeometry::Mdh(&[
        [0.0, 0.0, 267.0, 0.0],
        // The upper arm is 53.5 mm forward and 284.5 mm up.
        [-90.0, 0.0, 0.0, -79.349_949_087_697_35],
        [0.0, 289.486_614_543_747_07, 0.0, 79.349_949_087_697_35],
        [-90.0, 77.5, 342.5, 0.0],
        [90.0, 0.0, 0.0, 0.0],
        [-90.0, 76.0, 97.0, 0.0],
    ]),
    limits: &[
        [-360.0, 360.0],
        [-118.0, 120.0],
        [-225.0, 11.0],
        [-360.0, 360.0],
        [-97.0, 180.0],
        [-360.0, 360.0],
    ],
    max_velocity: Some(&[180.0; 6]),
    sources: 2,
    provenance: "UFACTORY (table and URDF), Viam; the a of 289.48866 mm in the maker's table is \
        hypot(284.5, 53.5) mistyped; payload and reach are general knowledge of the \
        data sheet",
    ..NOTHING_KNOWN
};
