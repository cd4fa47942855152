//! A cell: obstacles in the frame of the world.

use alloc::string::String;
use alloc::vec::Vec;

use crate::body::{Shape, check_length};
use crate::error::{BodyFault, Error};

/// Obstacles in the frame of the world, and a margin around them.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Cell {
    obstacles: Vec<(String, Shape)>,
    margin: f64,
}

impl Cell {
    /// A cell with named obstacles, from which the arm is to stay at least `margin` [m].
    ///
    /// # Errors
    ///
    /// [`Error::InvalidBody`] for two obstacles of one name, and a margin that is negative or not
    /// finite.
    pub fn new(obstacles: Vec<(String, Shape)>, margin: f64) -> Result<Self, Error> {
        check_length("margin", margin, 0.0)?;
        for (index, (name, _)) in obstacles.iter().enumerate() {
            if obstacles[..index].iter().any(|(other, _)| other == name) {
                return Err(BodyFault::TwoNames { index }.into());
            }
        }
        Ok(Self { obstacles, margin })
    }

    /// The obstacles, with their names.
    #[must_use]
    pub fn obstacles(&self) -> &[(String, Shape)] {
        &self.obstacles
    }

    /// How far the arm is to stay from the obstacles [m].
    #[must_use]
    pub fn margin(&self) -> f64 {
        self.margin
    }

    /// Whether a link is compared with an obstacle, by its place: not the one on which the arm
    /// stands.
    pub(super) fn compares(&self, _obstacle: usize, link: usize) -> bool {
        link > 0
    }
}
