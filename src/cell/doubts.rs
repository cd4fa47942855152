//! What capsules leave in doubt, by hulls (docs/theory/cell.md, hulls of links).

use super::block::{ROUNDING, Touch, lanes_in};
use crate::body::Asked;

/// Two whose capsules touch.
#[derive(Clone, Copy)]
pub(super) enum Doubt {
    /// Two groups.
    Links([usize; 2]),
    /// A group and an obstacle.
    Obstacle(usize, usize),
}

impl<const N: usize> Touch<'_, N> {
    /// Decide by hulls what is in doubt.
    pub(super) fn decide(&mut self) {
        for at in 0..self.block.doubts.len() {
            let (doubt, lanes) = self.block.doubts[at];
            let touching = lanes_in(lanes & self.asked, |lane| match doubt {
                Doubt::Links(pair) => self.hulls_touch(pair, lane),
                Doubt::Obstacle(group, obstacle) => {
                    self.hulls_touch_obstacle(group, obstacle, lane)
                }
            });
            self.asked &= !touching;
        }
    }

    /// Whether hulls of two groups touch in a lane.
    fn hulls_touch(&self, pair: [usize; 2], lane: usize) -> bool {
        let [one, other] = pair.map(|group| &self.outline.groups[group]);
        let limit = ROUNDING + self.hulls_moved(pair[1], one.link, lane);
        let poses = [one, other].map(|group| self.block.frame(group.link).pose(lane));
        let asked = Asked::whether_above(limit);
        one.separation(&poses[0], (other, &poses[1]), asked).distance <= limit
    }

    /// Whether hulls of a group come nearer to an obstacle than the margin in a lane.
    fn hulls_touch_obstacle(&self, group: usize, obstacle: usize, lane: usize) -> bool {
        let (own, shape) = (&self.outline.groups[group], &self.cell.obstacles()[obstacle].1);
        let limit = ROUNDING + self.cell.margin() + self.hulls_moved(group, 0, lane);
        let pose = self.block.frame(own.link).pose(lane);
        own.separation_of(&pose, shape, Asked::whether_above(limit)).distance <= limit
    }

    /// How far points of hulls of a group move, seen from a link; zero for joint vectors (eq. 8).
    fn hulls_moved(&self, group: usize, from: usize, lane: usize) -> f64 {
        let own = &self.outline.groups[group];
        if !self.swept || own.link <= from {
            return 0.0;
        }
        let spans = self.block.spans[from..own.link].iter();
        let farther = spans.map(|span| 1.0 + span[lane]).product::<f64>() - 1.0;
        self.block.moves[group][from][lane] + own.beyond * farther
    }
}
