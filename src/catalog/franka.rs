//! Franka arms.
//!
//! Denavit-Hartenberg rows as published by Franka (control parameters documentation), with the
//! flange in the last row; validated against a pose recorded on a machine
//! (petercorke/robotics-toolbox-matlab#107). Limits and velocities come from the maker's
//! description (`frankaemika/franka_description` @ b299b39d96, `robots/fer` and `robots/fr3`),
//! accelerations from the maker's library (`frankarobotics/libfranka`,
//! `include/franka/rate_limiting.h` @ f3b8d775a9, release 0.9.2, for the Panda and @ 6474466b74
//! for the FR3).

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
    max_acceleration: Some(&[15.0, 7.5, 10.0, 12.5, 15.0, 20.0, 20.0]),
    sources: 2,
    provenance: "Franka control parameters, petercorke/robotics-toolbox-matlab#107 (a recorded pose); \
        limits and speeds of frankaemika/franka_description; accelerations of libfranka 0.9.2",
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
    max_velocity: Some(&[2.62, 2.62, 2.62, 2.62, 5.26, 4.18, 5.26]),
    max_acceleration: Some(&[10.0; 7]),
    sources: 2,
    provenance: "Franka control parameters, petercorke/robotics-toolbox-matlab#107 (of the Panda: its \
        geometry); limits and speeds of frankaemika/franka_description; accelerations of libfranka; \
        near the ends of a joint the controller allows less speed, which is not modeled",
};
