//! Pairs of which capsules touch, decided by hulls (docs/theory/cell.md, hulls of links).

use super::obstacles::Cell;
use crate::body::{Asked, Outline};
use crate::kinematics::Pose;

/// Two whose capsules touch.
#[derive(Clone, Copy)]
pub(super) enum Doubt {
    /// Two groups.
    Links([usize; 2]),
    /// A group and an obstacle.
    Obstacle(usize, usize),
}

impl Doubt {
    /// Whether hulls are as near as a limit [m], with the poses of links.
    pub(super) fn touches(
        self,
        outline: &Outline,
        cell: &Cell,
        pose: impl Fn(usize) -> Pose,
        limit: f64,
    ) -> bool {
        let asked = Asked::whether_above(limit);
        let apart = match self {
            Self::Links(pair) => {
                let [one, other] = pair.map(|group| &outline.groups[group]);
                one.separation(&pose(one.link), (other, &pose(other.link)), asked)
            }
            Self::Obstacle(group, obstacle) => {
                let (own, shape) = (&outline.groups[group], &cell.obstacles()[obstacle].1);
                own.separation_of(&pose(own.link), shape, asked)
            }
        };
        apart.distance <= limit
    }
}
