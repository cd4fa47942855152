//! The capsules and hulls of an arm at its joint angles.

use alloc::boxed::Box;
use alloc::vec::Vec;
#[cfg(feature = "std")]
use core::any::Any;
#[cfg(feature = "std")]
use std::thread_local;

use super::apart::ALL;
use super::block::{Block, Looked};
use super::obstacles::Cell;
use super::one::is_obstructed;
use nalgebra::Vector3;

use crate::arm::Arm;
use crate::body::{Capsule, Centered, Group, Outline};
use crate::error::Error;
use crate::interrupt::Interrupt;
use crate::kinematics::Pose;
use crate::lanes::LANES;

#[cfg(feature = "std")]
thread_local! {
    /// Memory of the arm before, a [`Block`]: to allocate it takes longer than a posture.
    static KEPT: core::cell::Cell<Option<Box<dyn Any>>> = const { core::cell::Cell::new(None) };
}

/// An arm with the outline of its body.
#[doc(hidden)]
pub struct Placed<'a, const N: usize> {
    arm: &'a Arm<N>,
    pub(super) outline: &'a Outline,
    /// Taken when this is dropped.
    block: Option<Box<Block<N>>>,
    /// How far any axis of a capsule or point of a hull is from an axis of a joint at most [m].
    pub(super) reach: f64,
    pub(super) interrupt: Interrupt<'a>,
}

impl<'a, const N: usize> Placed<'a, N> {
    #[doc(hidden)]
    pub fn of(arm: &'a Arm<N>) -> Result<Self, Error> {
        let outline = arm.outline()?;
        #[cfg(feature = "std")]
        let kept = KEPT.try_with(core::cell::Cell::take).ok().flatten();
        #[cfg(not(feature = "std"))]
        let kept = None::<Box<dyn core::any::Any>>;
        let kept = kept.and_then(|kept| kept.downcast().ok());
        let mut block = kept.unwrap_or_else(|| Box::new(Block::new(arm)));
        block.fit(arm, outline);
        let table = arm.mdh().rows.iter().map(|row| row.a.abs() + row.d.abs()).sum::<f64>();
        let (block, reach) = (Some(block), table + outline.reach);
        Ok(Self { arm, outline, block, reach, interrupt: Interrupt::none() })
    }

    /// For work that ends when it is interrupted.
    #[doc(hidden)]
    pub fn until(mut self, interrupt: Interrupt<'a>) -> Self {
        self.interrupt = interrupt;
        self
    }

    /// Which of up to eight joint vectors touch something, as bits: [`Block::touching`].
    pub(super) fn touching(&mut self, cell: &Cell, q: &[[f64; N]], looked: Looked<'_, N>) -> u64 {
        debug_assert!(q.len() <= LANES);
        let block = self.block.as_mut();
        block.map_or(ALL, |block| block.touching(self.arm, self.outline, cell, q, looked))
    }

    /// Whether one joint vector touches something.
    pub(super) fn touches(&mut self, cell: &Cell, q: &[f64; N]) -> bool {
        let alone = Cell::default();
        self.touching(&alone, core::slice::from_ref(q), Looked::All) != 0
            || self.block.as_ref().is_none_or(|block| is_obstructed(block, self.outline, cell))
    }

    /// Whether eight joint vectors are free.
    pub(super) fn are_free(&mut self, cell: &Cell, q: &[[f64; N]; LANES]) -> bool {
        self.touching(cell, q, Looked::Any) == 0
    }

    /// How far any axis of a capsule or point of a hull moves at most while the joints turn by spans [rad] [m].
    pub(super) fn most_motion(&self, spans: [f64; N]) -> f64 {
        self.arm.table_spans(spans).iter().sum::<f64>() * self.reach
    }

    /// The arm at a joint vector.
    pub(super) fn at(&self, q: &[f64; N]) -> Standing<'_, N> {
        let frames = self.arm.link_frames(q).0;
        let Outline { capsules: all, groups, .. } = self.outline;
        let (capsules, balls) = (Vec::with_capacity(all.len()), Vec::with_capacity(groups.len()));
        let mut standing = Standing { placed: self, frames, capsules, balls };
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

#[cfg(feature = "std")]
impl<const N: usize> Drop for Placed<'_, N> {
    fn drop(&mut self) {
        // A thread that ends keeps nothing.
        let block = self.block.take().map(|block| block as Box<dyn Any>);
        let _ = KEPT.try_with(|kept| kept.set(block));
    }
}

/// An arm at a joint vector.
pub(super) struct Standing<'a, const N: usize> {
    pub(super) placed: &'a Placed<'a, N>,
    frames: [Pose; N],
    /// The capsules, in the order of the outline.
    capsules: Vec<Capsule>,
    /// The middle and the radius of the ball around each group [m].
    pub(super) balls: Vec<(Vector3<f64>, f64)>,
}

impl<const N: usize> Standing<'_, N> {
    /// The pose of the link with which a group moves.
    pub(super) fn pose(&self, group: &Group) -> Pose {
        match group.link.checked_sub(1) {
            Some(joint) => self.frames[joint],
            None => *self.placed.arm.base(),
        }
    }

    /// The capsules of a group.
    pub(super) fn capsules_of(&self, group: usize) -> &[Capsule] {
        &self.capsules[self.placed.outline.groups[group].capsules.clone()]
    }
}
