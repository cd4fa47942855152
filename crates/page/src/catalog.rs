//! `catalog`: all arms.

use irbkin::catalog::CatalogArm;
use irbkin::{AnyRobot, catalog};
use serde::Serialize;

use crate::request::Refusal;

/// All arms of the catalog: ABB's by type number, then other makers' arms.
#[derive(Debug, Serialize)]
pub struct Catalog {
    /// The arms.
    pub arms: Vec<Entry>,
}

/// An arm of the catalog.
#[derive(Debug, Serialize)]
pub struct Entry {
    /// The maker's type name, by which `robot` finds it.
    pub name: &'static str,
    /// The maker.
    pub maker: &'static str,
    /// The word for its kinematic structure.
    pub structure: &'static str,
    /// Number of joints.
    pub dof: usize,
    /// Reach [m].
    pub reach: Option<f64>,
    /// Payload [kg].
    pub payload: Option<f64>,
}

impl Catalog {
    pub(crate) fn all() -> Result<Self, Refusal> {
        Ok(Self { arms: catalog().map(Entry::of).collect::<Result<_, _>>()? })
    }
}

impl Entry {
    fn of(arm: &'static CatalogArm) -> Result<Self, Refusal> {
        Ok(Self {
            name: arm.name,
            maker: arm.maker,
            structure: match AnyRobot::from_catalog(arm)? {
                AnyRobot::Six(robot) => robot.structure(),
                AnyRobot::Seven(robot) => robot.structure(),
            },
            dof: arm.dof(),
            reach: arm.reach,
            payload: arm.payload,
        })
    }
}
