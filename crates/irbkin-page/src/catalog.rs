//! `catalog`: all arms.

use alloc::vec::Vec;

use irbkin::catalog;
use irbkin::catalog::CatalogArm;
use serde::Serialize;

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
    /// Number of joints.
    pub dof: usize,
    /// Reach [m].
    pub reach: Option<f64>,
    /// Payload [kg].
    pub payload: Option<f64>,
}

impl Catalog {
    pub(crate) fn all() -> Self {
        Self { arms: catalog().map(|arm| Entry::of(&arm)).collect() }
    }
}

impl Entry {
    fn of(arm: &CatalogArm) -> Self {
        Self {
            name: arm.name,
            maker: arm.maker,
            dof: arm.dof(),
            reach: arm.reach,
            payload: arm.payload,
        }
    }
}
