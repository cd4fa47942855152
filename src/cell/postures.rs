//! A cell, and what an arm touches in it at single postures.

use alloc::string::{String, ToString as _};
use alloc::vec::Vec;
use core::cell::RefCell;
use core::fmt;

use super::pairs::{Other, Pair, pairs};
use super::placed::Placed;
use crate::body::{Shape, check_length};
use crate::error::{BodyFault, Error};
use crate::kinematics::{Pose, Robot, Solution, check_seed};

/// Obstacles in the frame of the world, and a margin around them.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Cell {
    obstacles: Vec<(String, Shape)>,
    margin: f64,
}

/// Something that a link is near to.
#[derive(Clone, Debug, PartialEq)]
pub enum Near {
    /// A link of the arm, by its number.
    Link(usize),
    /// An obstacle, by its name.
    Obstacle(String),
}

impl fmt::Display for Near {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Link(link) => write!(f, "link {link}"),
            Self::Obstacle(name) => f.write_str(name),
        }
    }
}

/// The nearest pair of a link and something else.
#[derive(Clone, Debug, PartialEq)]
pub struct Nearest {
    /// How far they are apart [m]; less than zero if they touch, by how much their capsules reach
    /// into each other.
    pub distance: f64,
    /// The link.
    pub link: usize,
    /// The other link or the obstacle.
    pub near: Near,
    /// The nearest points of the link and of the other [m].
    pub points: [[f64; 3]; 2],
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

    /// Whether the arm touches itself, or comes nearer to an obstacle than the margin. Link 0, on
    /// which the arm stands, is not compared with obstacles.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidBody`] if the robot has no body; [`Error::InvalidJoints`] for joints that are
    /// not finite.
    pub fn collides<const N: usize>(&self, robot: &Robot<N>, q: &[f64; N]) -> Result<bool, Error> {
        check_seed("q", q)?;
        Ok(self.collides_at(&mut Placed::of(robot)?, q))
    }

    /// [`Self::collides`] of joints that are checked.
    pub(crate) fn collides_at<const N: usize>(
        &self,
        placed: &mut Placed<'_, N>,
        q: &[f64; N],
    ) -> bool {
        self.colliding(placed, core::slice::from_ref(q)) != 0
    }

    /// Which of up to eight joint vectors collide, as bits.
    pub(crate) fn colliding<const N: usize>(
        &self,
        placed: &mut Placed<'_, N>,
        q: &[[f64; N]],
    ) -> u64 {
        placed.touching((&self.obstacles, self.margin), q, None)
    }

    /// The link and the other link or obstacle that are nearest; `None` if there is nothing to
    /// compare. Obstacles are as far away as they are: the margin does not count.
    ///
    /// # Errors
    ///
    /// As [`Self::collides`].
    pub fn nearest<const N: usize>(
        &self,
        robot: &Robot<N>,
        q: &[f64; N],
    ) -> Result<Option<Nearest>, Error> {
        check_seed("q", q)?;
        let placed = Placed::of(robot)?;
        let pairs = pairs(&placed, &self.obstacles, q);
        let least = pairs.min_by(|a, b| a.apart.distance.total_cmp(&b.apart.distance));
        Ok(least.map(|pair| self.named(&pair)))
    }

    /// The pair that is deepest in each other or in the margin; if nothing touches, the pair that is
    /// next to it.
    pub(super) fn deepest<const N: usize>(
        &self,
        placed: &Placed<'_, N>,
        q: &[f64; N],
    ) -> Option<Pair> {
        let pairs = pairs(placed, &self.obstacles, q);
        pairs.max_by(|a, b| self.depth(a).total_cmp(&self.depth(b)))
    }

    /// How deep a pair is in each other or in the margin [m].
    pub(super) fn depth(&self, pair: &Pair) -> f64 {
        match pair.other {
            Other::Link(_) => -pair.apart.distance,
            Other::Obstacle(_) => self.margin - pair.apart.distance,
        }
    }

    pub(super) fn named(&self, pair: &Pair) -> Nearest {
        Nearest {
            distance: pair.apart.distance,
            link: pair.link,
            near: match pair.other {
                Other::Link(link) => Near::Link(link),
                Other::Obstacle(at) => Near::Obstacle(self.obstacles[at].0.clone()),
            },
            points: pair.apart.points.map(Into::into),
        }
    }

    /// The solution inside the limits that is nearest to `seed` [rad] and does not collide, as
    /// [`Robot::ik_nearest`]; of seven joints none of which is locked, of those that its search
    /// along the redundancy passes.
    ///
    /// # Errors
    ///
    /// As [`Robot::ik_nearest`] and [`Self::collides`]; [`Error::Collides`] if every solution inside
    /// the limits collides.
    pub fn ik_nearest<const N: usize>(
        &self,
        robot: &Robot<N>,
        pose: &Pose,
        seed: &[f64; N],
        weights: &[f64; N],
    ) -> Result<Solution<N>, Error> {
        let placed = RefCell::new(Placed::of(robot)?);
        let nearest = robot.ik_nearest(pose, seed, weights)?;
        let is_free = |q: &[f64; N]| !self.collides_at(&mut placed.borrow_mut(), q);
        if is_free(&nearest.q) {
            return Ok(nearest);
        }
        match robot.nearest_accepted(pose, seed, weights, &is_free) {
            Err(Error::Unreachable(_)) => Err(self.collision(&placed.borrow(), &nearest.q)),
            found => found,
        }
    }

    /// The error of joints that collide.
    fn collision<const N: usize>(&self, placed: &Placed<'_, N>, q: &[f64; N]) -> Error {
        let Some(pair) = self.deepest(placed, q) else { return BodyFault::NoBody.into() };
        let Nearest { link, near, .. } = self.named(&pair);
        Error::Collides { link, other: near.to_string(), depth: self.depth(&pair) }
    }
}
