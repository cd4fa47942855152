//! Boxes of joint angles that are proven free, without a heap: for control loops.

use super::block::{Block, Looked};
use super::obstacles::Cell;
use super::pairs::Other;
use super::placed::Placed;
use super::range::Range;
use crate::arm::Arm;
use crate::body::fault::BodyFault;
use crate::cell::Nearest;
use crate::error::Error;
use crate::lanes::LANES;

/// A cell and the places of an arm in it.
#[derive(Clone)]
pub(crate) struct Boxes<const N: usize> {
    cell: Cell,
    block: Block<N>,
    /// How far anything is from an axis of a joint at most [m].
    reach: f64,
}

impl<const N: usize> Boxes<N> {
    /// Of an arm in a cell, with so much more margin around the obstacles [m].
    pub(crate) fn new(arm: &Arm<N>, cell: &Cell, margin: f64) -> Result<Self, Error> {
        let outline = arm.outline()?;
        let mut block = Block::new(arm);
        block.fit(arm, outline);
        let cell = cell.clone().widened(margin)?;
        block.reserve(outline.pairs.len() + outline.groups.len() * cell.obstacles().len());
        Ok(Self { cell, block, reach: Placed::of(arm)?.reach })
    }

    pub(crate) fn cell(&self) -> &Cell {
        &self.cell
    }

    /// How far anything moves at most while the joints turn by spans [rad] [m].
    pub(crate) fn most_motion(&self, arm: &Arm<N>, spans: [f64; N]) -> f64 {
        arm.table_spans(spans).iter().sum::<f64>() * self.reach
    }

    /// The two that touch at a joint vector, and how deep [m].
    pub(crate) fn collision(
        &self,
        arm: &Arm<N>,
        q: &[f64; N],
    ) -> Result<Option<(Nearest, f64)>, Error> {
        let mut placed = Placed::of(arm)?;
        if !self.cell.collides_at(&mut placed, q) {
            return Ok(None);
        }
        let found = self.cell.collision(&placed, q);
        Ok(Some(found.ok_or(Error::from(BodyFault::NoBody))?))
    }

    /// Which of up to eight boxes, each by its middle and how far it goes to either side [rad], are
    /// not proven free, as bits.
    pub(crate) fn open(&mut self, arm: &Arm<N>, q: &[[f64; N]], spans: &[[f64; N]]) -> u64 {
        let Ok(outline) = arm.outline() else { return u64::MAX };
        let rest = Range { middle: [0.0; N], turns: [0.0; N], beside: [0.0; N] };
        let mut ranges = [rest; LANES];
        for ((range, middle), beside) in ranges.iter_mut().zip(q).zip(spans) {
            (range.middle, range.beside) = (*middle, *beside);
        }
        let swept = Looked::Swept(&ranges[..q.len()]);
        self.block.touching(arm, outline, &self.cell, q, swept)
    }

    /// A link, and the link or obstacle for which a box is not proven free.
    pub(crate) fn blocked(
        &mut self,
        arm: &Arm<N>,
        q: &[f64; N],
        spans: &[f64; N],
    ) -> Option<(usize, Other)> {
        let one = core::slice::from_ref;
        if self.open(arm, one(q), one(spans)) == 0 {
            return None;
        }
        let outline = arm.outline().ok()?;
        let (place, pairs, groups) = (self.block.last, &outline.pairs, &outline.groups);
        if let Some(pair) = pairs.get(place) {
            let [link, other] = pair.map(|group| groups[group].number);
            return Some((link, Other::Link(other)));
        }
        let place = place - pairs.len();
        let obstacle = Other::Obstacle(place / groups.len());
        Some((groups[place % groups.len()].number, obstacle))
    }
}
