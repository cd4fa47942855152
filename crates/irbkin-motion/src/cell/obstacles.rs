//! A cell: obstacles in the frame of the world.

use alloc::collections::{BTreeMap, BTreeSet};
use core::ops::Range;

use crate::arm::Arm;
use crate::body::fault::BodyFault;
use crate::body::{Shape, Tree, check_length};
use crate::error::Error;
use crate::prelude::*;
use irbkin::Interrupt;
use irbkin::internal::check_seed;

/// The last link of the longest arm.
const LAST_LINK: usize = 8;

/// Obstacles in the frame of the world, and a margin around them.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Cell {
    obstacles: Obstacles,
    margin: f64,
    /// The links that an obstacle is not compared with, as bits, by its place.
    may_touch: Vec<u16>,
}

/// Obstacles, and the parts that they consist of.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(from = "Vec<(String, Shape)>", into = "Vec<(String, Shape)>")
)]
struct Obstacles {
    all: Vec<(String, Shape)>,
    /// The place of each part's obstacle, and its place there; parts with an end first.
    parts: Vec<[usize; 2]>,
    /// The places among the parts of those without an end: half spaces.
    endless: Range<usize>,
    /// The others.
    tree: Tree,
}

impl From<Vec<(String, Shape)>> for Obstacles {
    fn from(all: Vec<(String, Shape)>) -> Self {
        let mut parts = Vec::new();
        let mut boxes = Vec::new();
        let mut endless = Vec::new();
        for (obstacle, (_, shape)) in all.iter().enumerate() {
            for (part, shape) in shape.parts().iter().enumerate() {
                match shape.bounds() {
                    Some(bounds) => {
                        parts.push([obstacle, part]);
                        boxes.push(bounds);
                    }
                    None => endless.push([obstacle, part]),
                }
            }
        }
        let places = parts.len()..parts.len() + endless.len();
        parts.append(&mut endless);
        // Nothing interrupts it.
        let tree = Tree::new(&boxes, Interrupt::none()).unwrap_or_default();
        Self { all, parts, endless: places, tree }
    }
}

impl From<Obstacles> for Vec<(String, Shape)> {
    fn from(obstacles: Obstacles) -> Self {
        obstacles.all
    }
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
        Ok(Self { obstacles: obstacles.into(), margin, may_touch: Vec::new() })
    }

    /// The cell with so much more margin [m].
    pub(super) fn widened(self, more: f64) -> Result<Self, Error> {
        check_length("margin", more, 0.0)?;
        Ok(Self { margin: self.margin + more, ..self })
    }

    /// The obstacles, with their names.
    #[must_use]
    pub fn obstacles(&self) -> &[(String, Shape)] {
        &self.obstacles.all
    }

    pub(super) fn part_count(&self) -> usize {
        self.obstacles.parts.len()
    }

    pub(super) fn part(&self, place: usize) -> &Shape {
        let [obstacle, part] = self.obstacles.parts[place];
        &self.obstacles.all[obstacle].1.parts()[part]
    }

    pub(super) fn obstacle_of(&self, part: usize) -> usize {
        self.obstacles.parts[part][0]
    }

    /// The parts without an end, by their places.
    pub(super) fn endless(&self) -> Range<usize> {
        self.obstacles.endless.clone()
    }

    /// The tree of the other parts, by their places.
    pub(super) fn tree(&self) -> &Tree {
        &self.obstacles.tree
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
        let names = self.obstacles.all.iter().map(|(name, _)| &**name).zip(0..);
        let places: BTreeMap<&str, usize> = names.collect();
        self.may_touch.resize(self.obstacles.all.len(), 0);
        for (name, link) in pairs {
            let name = name.as_ref();
            let Some(&obstacle) = places.get(name) else {
                let existing =
                    self.obstacles.all.iter().map(|(own, _)| format!("{own:?}")).collect();
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
        let named = self.obstacles.all.iter().zip(&self.may_touch);
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
        let obstacles = [self.obstacles.all, links].concat();
        Ok(Self { may_touch: self.may_touch, ..Self::new(obstacles, self.margin)? })
    }

    /// Whether a link is compared with a part of an obstacle: not the one on which the arm stands.
    pub(super) fn compares(&self, part: usize, link: usize) -> bool {
        let links = self.may_touch.get(self.obstacle_of(part));
        link > 0 && links.is_none_or(|links| links >> link & 1 == 0)
    }
}
