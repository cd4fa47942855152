//! A cell: obstacles in the frame of the world.

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::format;
use alloc::string::{String, ToString as _};
use alloc::vec::Vec;

use crate::arm::Arm;
use crate::body::fault::BodyFault;
use crate::body::{Shape, check_length};
use crate::error::Error;
use irbkin::internal::check_seed;

/// The last link of the longest arm.
const LAST_LINK: usize = 8;

/// Obstacles in the frame of the world, and a margin around them.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Cell {
    obstacles: Vec<(String, Shape)>,
    margin: f64,
    /// The links that an obstacle is not compared with, as bits, by its place.
    may_touch: Vec<u16>,
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
        let mut names = BTreeSet::new();
        if let Some(index) = obstacles.iter().position(|(name, _)| !names.insert(name)) {
            return Err(BodyFault::TwoNames { index }.into());
        }
        Ok(Self { obstacles, margin, may_touch: Vec::new() })
    }

    /// The cell with so much more margin [m].
    pub(super) fn widened(self, more: f64) -> Result<Self, Error> {
        check_length("margin", more, 0.0)?;
        Ok(Self { margin: self.margin + more, ..self })
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

    /// The cell in which pairs of an obstacle, by its name, and a link are not compared, besides
    /// those that already are not.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidBody`] for a name that no obstacle has, and a link other than 1 to 8: link 0,
    /// on which an arm stands, is never compared.
    pub fn with_may_touch<S: AsRef<str>>(mut self, pairs: &[(S, usize)]) -> Result<Self, Error> {
        if pairs.is_empty() {
            return Ok(self);
        }
        let names = self.obstacles.iter().map(|(name, _)| &**name).zip(0..);
        let places: BTreeMap<&str, usize> = names.collect();
        self.may_touch.resize(self.obstacles.len(), 0);
        for (name, link) in pairs {
            let name = name.as_ref();
            let Some(&obstacle) = places.get(name) else {
                let existing = self.obstacles.iter().map(|(own, _)| format!("{own:?}")).collect();
                return Err(BodyFault::NoObstacle { name: name.to_string(), existing }.into());
            };
            if !(1..=LAST_LINK).contains(link) {
                return Err(BodyFault::NoMovingLink { name: name.to_string(), link: *link }.into());
            }
            self.may_touch[obstacle] |= 1 << link;
        }
        Ok(self)
    }

    /// The obstacles, by their names, and the links that are not compared with them.
    pub fn may_touch(&self) -> impl Iterator<Item = (&str, usize)> {
        let named = self.obstacles.iter().zip(&self.may_touch);
        named.flat_map(|((name, _), links)| {
            let links = (1..=LAST_LINK).filter(move |link| links >> link & 1 == 1);
            links.map(move |link| (&**name, link))
        })
    }

    /// The cell with another arm in it, which stands still at joints `q` [rad]. Each of its links is
    /// an obstacle: link 3 of an arm `left` has the name `left, link 3`.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidBody`] if the arm has no body, or an obstacle has the name of one of its
    /// links; [`irbkin::Error::InvalidJoints`] for joints that are not finite.
    pub fn with_robot<const N: usize>(
        self,
        name: &str,
        arm: &Arm<N>,
        q: &[f64; N],
    ) -> Result<Self, Error> {
        check_seed("q", q)?;
        let checker = self.checker(arm)?;
        let at = checker.at(q);
        let mut links = Vec::new();
        for link in 0..=N + 1 {
            let groups = checker.outline.groups.iter().enumerate();
            let groups = groups.filter(|(_, group)| group.number == link);
            let own = groups.flat_map(|(place, _)| at.capsules_of(place));
            let shapes: Vec<_> = own.copied().map(Shape::Capsule).collect();
            if !shapes.is_empty() {
                links.push((format!("{name}, link {link}"), Shape::union(shapes)?));
            }
        }
        let obstacles = [self.obstacles, links].concat();
        Ok(Self { may_touch: self.may_touch, ..Self::new(obstacles, self.margin)? })
    }

    /// Whether a link is compared with an obstacle, by its place: not the one on which the arm
    /// stands.
    pub(super) fn compares(&self, obstacle: usize, link: usize) -> bool {
        link > 0 && self.may_touch.get(obstacle).is_none_or(|links| links >> link & 1 == 0)
    }
}
