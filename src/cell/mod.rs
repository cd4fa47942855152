//! A cell: obstacles around an arm, and whether the arm touches them or itself.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use core::cell::RefCell;

use crate::body::{Body, LinkCapsule, Shape, check_length};
use crate::error::{BodyFault, Error};
use crate::kinematics::{Pose, Robot, Solution, check_seed};

/// How near shapes may be and count as touching, for the rounding of poses and distances [m].
const ROUNDING: f64 = 1e-9;

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
        placed.move_to(q);
        placed.touches_itself() || placed.is_near_obstacle(self)
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
        let mut placed = Placed::of(robot)?;
        placed.move_to(q);
        let itself = placed
            .pairs()
            .map(|(one, other)| (one.link, Ok(other.link), one.capsule.separation(&other.capsule)));
        let around = placed.moving().flat_map(|own| {
            let apart = |shape: &Shape| shape.separation(&own.capsule);
            let obstacles = self.obstacles.iter().enumerate();
            obstacles.map(move |(at, (_, shape))| (own.link, Err(at), apart(shape)))
        });
        let least = itself.chain(around).min_by(|a, b| a.2.distance.total_cmp(&b.2.distance));
        Ok(least.map(|(link, near, apart)| Nearest {
            distance: apart.distance,
            link,
            near: match near {
                Ok(other) => Near::Link(other),
                Err(at) => Near::Obstacle(self.obstacles[at].0.clone()),
            },
            points: apart.points.map(Into::into),
        }))
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
            Err(Error::Unreachable(_)) => Err(self.collision(robot, &nearest.q)?),
            found => found,
        }
    }

    /// The error of joints that collide.
    fn collision<const N: usize>(&self, robot: &Robot<N>, q: &[f64; N]) -> Result<Error, Error> {
        let alone = Self::default().nearest(robot, q)?.filter(|itself| itself.distance <= ROUNDING);
        let Some(found) =
            alone.map_or_else(|| self.nearest(robot, q), |itself| Ok(Some(itself)))?
        else {
            return Ok(BodyFault::NoBody.into());
        };
        let (other, margin) = match found.near {
            Near::Link(other) => (format!("link {other}"), 0.0),
            Near::Obstacle(name) => (name, self.margin),
        };
        Ok(Error::Collides { link: found.link, other, depth: margin - found.distance })
    }
}

/// The capsules of an arm at its joint angles, in the world.
pub(crate) struct Placed<'a, const N: usize> {
    robot: &'a Robot<N>,
    body: &'a Body,
    /// Of the links, in the order of the body.
    links: Vec<LinkCapsule>,
    parts: Vec<LinkCapsule>,
}

impl<'a, const N: usize> Placed<'a, N> {
    pub(crate) fn of(robot: &'a Robot<N>) -> Result<Self, Error> {
        let body = robot.body().ok_or(BodyFault::NoBody)?;
        let (links, parts) = (body.capsules().to_vec(), body.parts().to_vec());
        Ok(Self { robot, body, links, parts })
    }

    fn move_to(&mut self, q: &[f64; N]) {
        let (frames, _) = self.robot.link_frames(q);
        let own = self.body.capsules().iter().chain(self.body.parts());
        for (placed, own) in self.links.iter_mut().chain(&mut self.parts).zip(own) {
            let frame = match own.link.checked_sub(1) {
                Some(joint) => &frames[joint],
                None => self.robot.base(),
            };
            placed.capsule = own.capsule.moved(frame);
        }
    }

    fn of_link(&self, link: usize) -> impl Iterator<Item = &LinkCapsule> {
        self.links.iter().filter(move |own| own.link == link)
    }

    /// The capsules that are kept apart from each other.
    fn pairs(&self) -> impl Iterator<Item = (&LinkCapsule, &LinkCapsule)> {
        self.body.pairs().iter().flat_map(move |[link, other]| {
            let ones = self.of_link(*link);
            ones.flat_map(move |one| self.of_link(*other).map(move |two| (one, two)))
        })
    }

    /// The capsules that are kept apart from obstacles.
    fn moving(&self) -> impl Iterator<Item = &LinkCapsule> {
        self.links.iter().chain(&self.parts).filter(|own| own.link > 0)
    }

    fn touches_itself(&self) -> bool {
        self.pairs().any(|(one, other)| {
            let (one, other) = (&one.capsule, &other.capsule);
            !one.is_far(other) && one.separation(other).distance <= ROUNDING
        })
    }

    fn is_near_obstacle(&self, cell: &Cell) -> bool {
        let most = cell.margin + ROUNDING;
        self.moving().any(|own| {
            let mut shapes = cell.obstacles.iter().map(|(_, shape)| shape);
            shapes.any(|shape| {
                let own = &own.capsule;
                !shape.is_far(own, most) && shape.separation(own).distance <= most
            })
        })
    }
}
