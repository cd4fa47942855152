//! The capsules of an arm at its joint angles.

use alloc::vec::Vec;

use super::block::Block;
use super::obstacles::Cell;
use crate::body::{Capsule, Outline};
use crate::error::Error;
use crate::interrupt::Interrupt;
use crate::kinematics::Robot;
use crate::lanes::LANES;

/// An arm with the outline of its body.
pub(crate) struct Placed<'a, const N: usize> {
    robot: &'a Robot<N>,
    pub(super) outline: &'a Outline,
    block: Block<N>,
    /// How far any axis of a capsule is from an axis of a joint at most [m].
    reach: f64,
    pub(super) interrupt: Interrupt<'a>,
}

impl<'a, const N: usize> Placed<'a, N> {
    pub(crate) fn of(robot: &'a Robot<N>) -> Result<Self, Error> {
        let outline = robot.outline().ok_or_else(|| robot.no_body())?;
        let block = Block::new(robot, outline);
        let table = robot.mdh().rows.iter().map(|row| row.a.abs() + row.d.abs()).sum::<f64>();
        let own = outline.groups.iter().map(|group| group.around.center.norm() + group.spread);
        let reach = table + own.fold(0.0, f64::max);
        Ok(Self { robot, outline, block, reach, interrupt: Interrupt::none() })
    }

    /// For work that ends when it is interrupted.
    pub(crate) fn until(self, interrupt: Interrupt<'a>) -> Self {
        Self { interrupt, ..self }
    }

    /// Which of up to eight joint vectors touch something, as bits: [`Block::touching`].
    pub(super) fn touching(
        &mut self,
        cell: &Cell,
        q: &[[f64; N]],
        spans: Option<&[[f64; N]]>,
    ) -> u64 {
        debug_assert!(q.len() <= LANES);
        self.block.touching(self.robot, self.outline, cell, q, spans)
    }

    /// How far any axis of a capsule moves at most while the joints turn by spans [rad] [m].
    pub(super) fn most_motion(&self, spans: [f64; N]) -> f64 {
        self.robot.table_spans(spans).iter().sum::<f64>() * self.reach
    }

    /// The capsules at a joint vector, in the order of the outline.
    pub(super) fn capsules(&self, q: &[f64; N]) -> Vec<Capsule> {
        let (frames, _) = self.robot.link_frames(q);
        let mut placed = Vec::with_capacity(self.outline.capsules.len());
        for group in &self.outline.groups {
            let frame = match group.link.checked_sub(1) {
                Some(joint) => &frames[joint],
                None => self.robot.base(),
            };
            let own = &self.outline.capsules[group.capsules.clone()];
            placed.extend(own.iter().map(|own| {
                let center = frame.rotation * own.center + frame.translation.vector;
                own.at(center, frame.rotation * own.half)
            }));
        }
        placed
    }
}
