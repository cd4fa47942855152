//! The capsules of an arm at its joint angles.

use alloc::string::String;
use alloc::vec::Vec;

use crate::body::{Body, LinkCapsule, Shape};
use crate::error::{BodyFault, Error};
use crate::kinematics::Robot;

/// How near shapes may be and count as touching, for the rounding of poses and distances [m].
pub(super) const ROUNDING: f64 = 1e-9;

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

    pub(super) fn move_to(&mut self, q: &[f64; N]) {
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

    pub(super) fn of_link(&self, link: usize) -> impl Iterator<Item = &LinkCapsule> {
        self.links.iter().filter(move |own| own.link == link)
    }

    /// The capsules that are kept apart from each other.
    pub(super) fn pairs(&self) -> impl Iterator<Item = (&LinkCapsule, &LinkCapsule)> {
        self.body.pairs().iter().flat_map(move |[link, other]| {
            let ones = self.of_link(*link);
            ones.flat_map(move |one| self.of_link(*other).map(move |two| (one, two)))
        })
    }

    /// The capsules that are kept apart from obstacles.
    pub(super) fn moving(&self) -> impl Iterator<Item = &LinkCapsule> {
        self.links.iter().chain(&self.parts).filter(|own| own.link > 0)
    }

    /// Whether links that are kept apart touch.
    pub(super) fn touches_itself(&self) -> bool {
        self.pairs().any(|(one, other)| {
            let (one, other) = (&one.capsule, &other.capsule);
            !one.is_far(other) && one.separation(other).distance <= ROUNDING
        })
    }

    /// Whether a moving link is as near to an obstacle as the margin [m].
    pub(super) fn is_near_obstacle(&self, obstacles: &[(String, Shape)], margin: f64) -> bool {
        let most = margin + ROUNDING;
        self.moving().any(|own| {
            let mut shapes = obstacles.iter().map(|(_, shape)| shape);
            shapes.any(|shape| {
                let own = &own.capsule;
                !shape.is_far(own, most) && shape.separation(own).distance <= most
            })
        })
    }
}
