//! Collisions of an arm in a cell at single postures.

use core::array;
use core::cell::RefCell;
use core::fmt;

use super::block::Query;
use super::checker::Checker;
use super::obstacles::Cell;
use super::pairs::{Other, Pair};
use crate::arm::Arm;
use crate::body::Separation;
use crate::error::Error;
use crate::prelude::*;
use irbkin::internal::check_seed;
use irbkin::internal::lanes::LANES;
use irbkin::{Pose, Robot, Solution};
use nalgebra::Vector3;

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
    /// into each other. Of links with hulls ([`crate::body::Body::hulls`]), as far as these are.
    pub distance: f64,
    /// The link.
    pub link: usize,
    /// The other link or the obstacle.
    pub near: Near,
    /// The nearest points of the link and of the other [m].
    pub points: [[f64; 3]; 2],
}

impl Nearest {
    /// How the distance changes with each joint [m/rad], at the joint angles that it was found at:
    /// the speed at which the two points come apart along the line between them. NaN where they are
    /// one point, and of an axis inside a solid, whose nearest point on the surface is not known.
    #[must_use]
    pub fn gradient<const N: usize>(&self, robot: &Robot<N>, q: &[f64; N]) -> [f64; N] {
        let [own, other] = self.points.map(Vector3::from);
        let direction = (other - own) / (self.distance.signum() * (other - own).norm());
        let frames = robot.link_frames(q).0;
        // A link turns with the joints up to its own; what the flange carries with all.
        let turned = |link: usize, point: &Vector3<f64>| -> [f64; N] {
            array::from_fn(|joint| {
                if joint >= link {
                    return 0.0;
                }
                let frame = &frames[joint];
                let axis = frame.rotation * Vector3::z();
                direction.dot(&axis.cross(&(point - frame.translation.vector)))
            })
        };
        let away = turned(self.link, &own);
        let after = match self.near {
            Near::Link(link) => turned(link, &other),
            Near::Obstacle(_) => [0.0; N],
        };
        robot.by_controller(array::from_fn(|joint| after[joint] - away[joint]))
    }
}

impl Cell {
    /// [`Checker::collides`] of an arm.
    ///
    /// # Errors
    ///
    /// As [`Checker::collides`]; [`Error::InvalidBody`] if the arm has no body.
    pub fn collides<const N: usize>(&self, arm: &Arm<N>, q: &[f64; N]) -> Result<bool, Error> {
        self.checker(arm)?.collides(q)
    }

    /// [`Checker::nearest`] of an arm.
    ///
    /// # Errors
    ///
    /// As [`Self::collides`].
    pub fn nearest<const N: usize>(
        &self,
        arm: &Arm<N>,
        q: &[f64; N],
    ) -> Result<Option<Nearest>, Error> {
        self.checker(arm)?.nearest(q)
    }

    /// [`Checker::ik_nearest`] of an arm.
    ///
    /// # Errors
    ///
    /// As [`Checker::ik_nearest`]; [`Error::InvalidBody`] if the arm has no body.
    pub fn ik_nearest<const N: usize>(
        &self,
        arm: &Arm<N>,
        pose: &Pose,
        seed: &[f64; N],
        weights: &[f64; N],
    ) -> Result<Solution<N>, Error> {
        self.checker(arm)?.ik_nearest(pose, seed, weights)
    }
}

impl<const N: usize> Checker<'_, N> {
    /// Whether the arm touches itself, or comes nearer to an obstacle than the margin. Link 0, on
    /// which the arm stands, is not compared with obstacles.
    ///
    /// # Errors
    ///
    /// [`irbkin::Error::InvalidJoints`] for joints that are not finite.
    pub fn collides(&mut self, q: &[f64; N]) -> Result<bool, Error> {
        check_seed("q", q)?;
        Ok(self.touches(q))
    }

    /// Whether each joint vector is free.
    #[doc(hidden)]
    pub fn free_postures(&mut self, q: &[[f64; N]]) -> Vec<bool> {
        let mut free = Vec::with_capacity(q.len());
        for q in q.chunks(LANES) {
            let colliding = self.colliding(q);
            free.extend((0..q.len()).map(|lane| colliding >> lane & 1 == 0));
        }
        free
    }

    /// Whether joint vectors in between are free: the first `blocks` of eight, spread over the way,
    /// its end in the first one.
    #[expect(clippy::cast_precision_loss, reason = "there are fewer than 2^52")]
    pub(crate) fn are_free(&mut self, blocks: usize, at: impl Fn(f64) -> [f64; N]) -> bool {
        (0..blocks).all(|block| {
            let place = |lane| ((lane + 1) * blocks - block) as f64 / (blocks * LANES) as f64;
            let q: [_; LANES] = array::from_fn(|lane| at(place(lane)));
            self.touching(&q, Query::Any) == 0
        })
    }

    /// Which of up to eight joint vectors collide, as bits.
    pub(crate) fn colliding(&mut self, q: &[[f64; N]]) -> u64 {
        self.touching(q, Query::All)
    }

    /// The link and the other link or obstacle that are nearest; `None` if there is nothing to
    /// compare. Obstacles are as far away as they are: the margin does not count.
    ///
    /// # Errors
    ///
    /// As [`Self::collides`].
    pub fn nearest(&self, q: &[f64; N]) -> Result<Option<Nearest>, Error> {
        check_seed("q", q)?;
        let least = self.nearest_pair(q, 0.0);
        Ok(least.map(|(pair, apart)| self.named(pair, &apart)))
    }

    pub(super) fn named(&self, pair: Pair, apart: &Separation) -> Nearest {
        Nearest {
            distance: apart.distance,
            link: pair.link,
            near: match pair.other {
                Other::Link(link) => Near::Link(link),
                Other::Obstacle(at) => Near::Obstacle(self.cell.obstacles()[at].0.clone()),
            },
            points: apart.points.map(Into::into),
        }
    }

    /// The solution inside the limits that is nearest to `seed` [rad] and does not collide, as
    /// [`Robot::ik_nearest`]; of seven joints none of which is locked, of those that its search
    /// along the redundancy passes.
    ///
    /// # Errors
    ///
    /// As [`Robot::ik_nearest`]; [`Error::Collides`] if every solution inside
    /// the limits collides.
    pub fn ik_nearest(
        &mut self,
        pose: &Pose,
        seed: &[f64; N],
        weights: &[f64; N],
    ) -> Result<Solution<N>, Error> {
        let arm = self.arm;
        let nearest = arm.ik_nearest(pose, seed, weights)?;
        if !self.touches(&nearest.q) {
            return Ok(nearest);
        }
        let checker = RefCell::new(&mut *self);
        let is_free = |q: &[f64; N]| !checker.borrow_mut().touches(q);
        match arm.nearest_accepted(pose, seed, weights, &is_free) {
            Err(error @ irbkin::Error::Unreachable(_)) => Err(match self.collision(&nearest.q) {
                Some((Nearest { link, near, .. }, depth)) => {
                    Error::Collides { link, other: near.to_string(), depth }
                }
                None => error.into(),
            }),
            found => Ok(found?),
        }
    }

    /// The two that are deepest in each other or in the margin, and how deep [m].
    #[doc(hidden)]
    pub fn collision(&self, q: &[f64; N]) -> Option<(Nearest, f64)> {
        let (pair, apart) = self.deepest(q)?;
        Some((self.named(pair, &apart), self.depth(pair.other, &apart)))
    }
}
