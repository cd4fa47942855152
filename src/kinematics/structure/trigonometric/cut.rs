//! Clusters that are known beforehand, cut out of the arcs: it would take many divisions to isolate
//! what noise does not separate.

use super::part::{Part, middle};
use super::roots::Root;
use super::tables::HALF_ARC;
use crate::kinematics::pose::angles::wrap;

impl Root {
    /// Whether a cluster has something of an arc.
    pub(super) fn reaches(&self, arc: usize) -> bool {
        wrap(self.angle() - middle(arc)).abs() < self.radius() + HALF_ARC
    }
}

impl Part {
    /// What is left of a whole arc without a cluster that touches it: before it and behind it.
    pub(super) fn without(&self, cluster: &Root) -> [Option<Self>; 2] {
        let [low, high] = [cluster.low, cluster.high].map(|angle| place(self.arc, angle));
        let before = Self { cut: low, keeps: [true, false], ..*self };
        let behind = Self { cut: high, keeps: [false, true], ..*self };
        [(low > 0.0).then_some(before), (high < 1.0).then_some(behind)]
    }
}

/// The place of an angle on an arc: outside of 0 ..= 1 beyond it.
fn place(arc: usize, angle: f64) -> f64 {
    0.5 + wrap(angle - middle(arc)) / (2.0 * HALF_ARC)
}
