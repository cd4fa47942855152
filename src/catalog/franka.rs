//! Franka arms.
//!
//! Denavit-Hartenberg rows as published by Franka (control parameters documentation), with the
//! flange in the last row; validated against a pose recorded on a machine
//! (petercorke/robotics-toolbox-matlab#107). Limits and velocities come from Franka's data
//! sheet.

use super::{AngleUnit, CatalogArm, CatalogGeometry};

const GEOMETRY: CatalogGeometry = CatalogGeometry::Mdh(&[
    [0.0, 0.0, 333.0, 0.0],
    [-90.0, 0.0, 0.0, 0.0],
    [90.0, 0.0, 316.0, 0.0],
    [90.0, 82.5, 0.0, 0.0],
    [-90.0, -82.5, 384.0, 0.0],
    [90.0, 0.0, 0.0, 0.0],
    [90.0, 88.0, 107.0, 0.0],
]);

pub(super) const ARMS: &[CatalogArm] = &[PANDA, FR3];

const PANDA: CatalogArm = CatalogArm {
    name: "Panda",
    maker: "Franka",
    payload: Some(3.0),
    reach: Some(0.855),
    geometry: GEOMETRY,
    angles: AngleUnit::Radians,
    limits: &[
        [-2.8973, 2.8973],
        [-1.7628, 1.7628],
        [-2.8973, 2.8973],
        [-3.0718, -0.0698],
        [-2.8973, 2.8973],
        [-0.0175, 3.7525],
        [-2.8973, 2.8973],
    ],
    max_velocity: Some(&[2.175, 2.175, 2.175, 2.175, 2.61, 2.61, 2.61]),
    sources: 2,
    provenance: "Franka control parameters, petercorke/robotics-toolbox-matlab#107 (a recorded pose); \
        limits are general knowledge of the data sheet",
};

const FR3: CatalogArm = CatalogArm {
    name: "FR3",
    maker: "Franka",
    payload: Some(3.0),
    reach: Some(0.855),
    geometry: GEOMETRY,
    angles: AngleUnit::Radians,
    limits: &[
        [-2.7437, 2.7437],
        [-1.7837, 1.7837],
        [-2.9007, 2.9007],
        [-3.0421, -0.1518],
        [-2.8065, 2.8065],
        [0.5445, 4.5169],
        [-3.0159, 3.0159],
    ],
    max_velocity: None,
    sources: 2,
    provenance: "Franka control parameters, petercorke/robotics-toolbox-matlab#107 (of the Panda: its \
        geometry); limits are general knowledge of the data sheet",
};
