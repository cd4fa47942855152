//! Boxes of joint angles that are proven free, without a heap: for control loops.

use alloc::sync::Arc;

use super::block::{Block, Query};
use super::checker::{Checker, most_motion, reach};
use super::obstacles::Cell;
use super::pairs::Other;
use super::path::Range;
use crate::arm::{Arm, ArmBody};
use crate::error::Error;
use irbkin::internal::lanes::LANES;

/// An arm in a cell of its own, and the memory of where it is.
#[derive(Clone)]
pub(crate) struct Boxes<const N: usize> {
    arm: Arm<N>,
    shaped: Arc<ArmBody>,
    cell: Cell,
    block: Block,
    /// How far anything is from an axis of a joint at most [m].
    reach: f64,
}

impl<const N: usize> Boxes<N> {
    /// Of an arm in a cell, with so much more margin around the obstacles [m].
    pub(crate) fn new(arm: &Arm<N>, cell: &Cell, margin: f64) -> Result<Self, Error> {
        let shaped = Arc::clone(arm.shaped()?);
        let outline = &shaped.outline;
        let mut block = Block::new(arm, outline);
        let cell = cell.clone().widened(margin)?;
        block.reserve(outline.pairs.len() + outline.groups.len() * cell.part_count());
        let reach = reach(arm, outline);
        Ok(Self { arm: arm.clone(), shaped, cell, block, reach })
    }

    pub(crate) fn cell(&self) -> &Cell {
        &self.cell
    }

    pub(crate) fn checker(&self) -> Result<Checker<'_, N>, Error> {
        self.cell.checker(&self.arm)
    }

    /// How far anything moves at most while the joints turn by spans [rad] [m].
    pub(crate) fn most_motion(&self, spans: [f64; N]) -> f64 {
        most_motion(&self.arm, self.reach, spans)
    }

    /// Which of up to eight boxes, each by its middle and how far it goes to either side [rad], are
    /// not proven free, as bits.
    pub(crate) fn open(&mut self, q: &[[f64; N]], spans: &[[f64; N]]) -> u64 {
        let rest = Range { middle: [0.0; N], turns: [0.0; N], beside: [0.0; N] };
        let mut ranges = [rest; LANES];
        for ((range, middle), beside) in ranges.iter_mut().zip(q).zip(spans) {
            (range.middle, range.beside) = (*middle, *beside);
        }
        let swept = Query::Swept(&ranges[..q.len()]);
        self.block.touching(&self.arm, &self.shaped.outline, &self.cell, q, swept)
    }

    /// A link, and the link or obstacle for which a box is not proven free.
    pub(crate) fn blocked(&mut self, q: &[f64; N], spans: &[f64; N]) -> Option<(usize, Other)> {
        let one = core::slice::from_ref;
        if self.open(one(q), one(spans)) == 0 {
            return None;
        }
        let outline = &self.shaped.outline;
        let (place, pairs, groups) = (self.block.last, &outline.pairs, &outline.groups);
        if let Some(pair) = pairs.get(place) {
            let [link, other] = pair.map(|group| groups[group].number);
            return Some((link, Other::Link(other)));
        }
        let place = place - pairs.len();
        let obstacle = Other::Obstacle(self.cell.obstacle_of(place / groups.len()));
        Some((groups[place % groups.len()].number, obstacle))
    }
}
