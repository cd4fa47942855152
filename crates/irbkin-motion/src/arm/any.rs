//! An arm whose number of joints is known at run time only.

use super::Arm;
use crate::error::Error;
use irbkin::ByJoints;
use irbkin::catalog::{CatalogArm, find};

/// An arm of five, six or seven joints, where a name or a file says which: match it to use it, as
/// [`AnyRobot`](irbkin::AnyRobot).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum AnyArm {
    /// Six joints.
    Six(Arm<6>),
    /// Seven joints.
    Seven(Arm<7>),
    /// Five joints.
    Five(Arm<5>),
}

impl AnyArm {
    /// The catalog arm with this name; [`find`] defines which spellings match.
    ///
    /// # Errors
    ///
    /// As [`Arm::named`].
    pub fn named(name: &str) -> Result<Self, Error> {
        Self::from_catalog(&find(name)?)
    }

    /// A catalog arm.
    ///
    /// # Errors
    ///
    /// None for the arms of [`catalog`](irbkin::catalog()).
    pub fn from_catalog(arm: &CatalogArm) -> Result<Self, Error> {
        match arm.dof() {
            5 => Arm::from_catalog(arm).map(Self::Five),
            7 => Arm::from_catalog(arm).map(Self::Seven),
            _ => Arm::from_catalog(arm).map(Self::Six),
        }
    }

    /// Number of joints.
    #[must_use]
    pub fn dof(&self) -> usize {
        match self {
            Self::Six(_) => 6,
            Self::Seven(_) => 7,
            Self::Five(_) => 5,
        }
    }
}

impl<S: From<Arm<6>>, V, F> From<Arm<6>> for ByJoints<S, V, F> {
    fn from(arm: Arm<6>) -> Self {
        Self::Six(arm.into())
    }
}

impl<S, V: From<Arm<7>>, F> From<Arm<7>> for ByJoints<S, V, F> {
    fn from(arm: Arm<7>) -> Self {
        Self::Seven(arm.into())
    }
}

impl<S, V, F: From<Arm<5>>> From<Arm<5>> for ByJoints<S, V, F> {
    fn from(arm: Arm<5>) -> Self {
        Self::Five(arm.into())
    }
}

impl<S: From<Arm<6>>, V: From<Arm<7>>, F: From<Arm<5>>> From<AnyArm> for ByJoints<S, V, F> {
    fn from(arm: AnyArm) -> Self {
        match arm {
            AnyArm::Six(arm) => arm.into(),
            AnyArm::Seven(arm) => arm.into(),
            AnyArm::Five(arm) => arm.into(),
        }
    }
}
