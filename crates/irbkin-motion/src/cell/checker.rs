//! An arm in a cell, with the memory of its postures.

use nalgebra::Vector3;

use super::block::{Block, Query};
use super::obstacles::Cell;
use super::single_posture::is_obstructed;
use crate::arm::Arm;
use crate::body::{Capsule, Centered, Group, Outline};
use crate::error::Error;
use crate::prelude::*;
use irbkin::internal::lanes::LANES;
use irbkin::{Interrupt, Pose};

/// An arm in a cell: whether it touches itself or what is there.
///
/// It owns the memory of the postures that it looks at, which takes longer to allocate than a posture
/// to look at: keep one for many.
///
/// ```
/// use irbkin_motion::Arm;
/// use irbkin_motion::body::Shape;
/// use irbkin_motion::cell::Cell;
///
/// let arm: Arm<6> = Arm::named("UR5e")?;
/// let floor = Shape::half_space([0.0, 0.0, 1.0], [0.0; 3])?;
/// let cell = Cell::new(vec![("floor".into(), floor)], 0.01)?;
/// let mut checker = cell.checker(&arm)?;
/// assert!(!checker.collides(&[0.0, -1.5, 1.2, 0.0, 0.5, 0.0])?);
/// assert!(checker.collides(&[0.0, 0.5, 0.5, 0.0, 0.5, 0.0])?);
/// # Ok::<(), irbkin_motion::Error>(())
/// ```
pub struct Checker<'a, const N: usize> {
    pub(super) cell: &'a Cell,
    pub(super) arm: &'a Arm<N>,
    pub(super) outline: &'a Outline,
    block: Box<Block>,
    /// How far any axis of a capsule or point of a hull is from an axis of a joint at most [m].
    reach: f64,
    pub(super) interrupt: Interrupt<'a>,
}

/// The memory of a [`Checker`] between two of them.
#[doc(hidden)]
pub struct Memory(Box<Block>);

impl Cell {
    /// An arm in the cell.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidBody`] if the arm has no body.
    pub fn checker<'a, const N: usize>(&'a self, arm: &'a Arm<N>) -> Result<Checker<'a, N>, Error> {
        Checker::with_memory(self, arm, None)
    }
}

impl<'a, const N: usize> Checker<'a, N> {
    /// An arm in a cell, with the memory of another checker.
    ///
    /// # Errors
    ///
    /// As [`Cell::checker`].
    #[doc(hidden)]
    pub fn with_memory(
        cell: &'a Cell,
        arm: &'a Arm<N>,
        memory: Option<Memory>,
    ) -> Result<Self, Error> {
        let outline = &arm.shaped()?.outline;
        let block = match memory {
            Some(Memory(mut block)) => {
                block.fit(arm, outline);
                block
            }
            None => Box::new(Block::new(arm, outline)),
        };
        let (reach, interrupt) = (reach(arm, outline), Interrupt::none());
        Ok(Self { cell, arm, outline, block, reach, interrupt })
    }

    /// Its memory, for another checker.
    #[doc(hidden)]
    pub fn into_memory(self) -> Memory {
        Memory(self.block)
    }

    /// For work that ends when it is interrupted.
    #[doc(hidden)]
    pub fn until(mut self, interrupt: Interrupt<'a>) -> Self {
        self.interrupt = interrupt;
        self
    }

    /// Which of up to eight joint vectors touch something, as bits: [`Block::touching`].
    pub(super) fn touching(&mut self, q: &[[f64; N]], looked: Query<'_, N>) -> u64 {
        debug_assert!(q.len() <= LANES);
        self.block.touching(self.arm, self.outline, self.cell, q, looked)
    }

    pub(crate) fn touches(&mut self, q: &[f64; N]) -> bool {
        let (alone, one) = (Cell::default(), core::slice::from_ref(q));
        self.block.touching(self.arm, self.outline, &alone, one, Query::All) != 0
            || is_obstructed(&self.block, self.outline, self.cell)
    }

    /// How far any axis of a capsule or point of a hull moves at most while the joints turn by spans [rad] [m].
    pub(super) fn most_motion(&self, spans: [f64; N]) -> f64 {
        most_motion(self.arm, self.reach, spans)
    }

    pub(super) fn at(&self, q: &[f64; N]) -> Standing<'_, N> {
        let frames = self.arm.link_frames(q).0;
        let Outline { capsules: all, groups, .. } = self.outline;
        let (capsules, balls) = (Vec::with_capacity(all.len()), Vec::with_capacity(groups.len()));
        let mut standing = Standing { checker: self, frames, capsules, balls };
        for group in groups {
            let frame = standing.pose(group);
            let at = |own: &Centered| frame.rotation * own.center + frame.translation.vector;
            standing.balls.push((at(&group.around), group.around.ball));
            let capsule = |own: &Centered| own.at(at(own), frame.rotation * own.half);
            standing
                .capsules
                .extend(all[group.capsules.start..group.cores.end].iter().map(capsule));
        }
        standing
    }
}

/// An arm at a joint vector.
pub(super) struct Standing<'a, const N: usize> {
    pub(super) checker: &'a Checker<'a, N>,
    frames: [Pose; N],
    /// The capsules, in the order of the outline.
    capsules: Vec<Capsule>,
    /// The middle and the radius of the ball around each group [m].
    pub(super) balls: Vec<(Vector3<f64>, f64)>,
}

impl<const N: usize> Standing<'_, N> {
    pub(super) fn pose(&self, group: &Group) -> Pose {
        match group.link.checked_sub(1) {
            Some(joint) => self.frames[joint],
            None => *self.checker.arm.base(),
        }
    }

    pub(super) fn capsules_of(&self, group: usize) -> &[Capsule] {
        &self.capsules[self.checker.outline.groups[group].capsules.clone()]
    }
}

/// How far any axis of a capsule or point of a hull of an arm is from an axis of a joint at most [m].
pub(super) fn reach<const N: usize>(arm: &Arm<N>, outline: &Outline) -> f64 {
    let table = arm.mdh().rows.iter().map(|row| row.a.abs() + row.d.abs()).sum::<f64>();
    table + outline.reach
}

/// How far any of these moves at most while the joints turn by spans [rad] [m].
pub(super) fn most_motion<const N: usize>(arm: &Arm<N>, reach: f64, spans: [f64; N]) -> f64 {
    arm.table_spans(spans).iter().sum::<f64>() * reach
}
