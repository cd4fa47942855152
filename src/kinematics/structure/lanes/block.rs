//! A block of poses, solved in lanes.

use super::{AnswerRow, Columns, LaneKernel, Poses, StatusRow};
use crate::lanes::{Column, Flags, LANES};

/// A block of poses with its solutions.
pub(crate) trait Block<K: LaneKernel<N, S>, const N: usize, const S: usize> {
    type Slots: BlockSlots<N, S>;

    /// Room for a block.
    const NEW: Self;

    /// Solve for the last frames of the structure in its first frame; return which are regular.
    /// Must be `#[inline(always)]`.
    fn solve<const FUSED: bool>(
        &mut self,
        kernel: &K,
        columns: &Columns<N>,
        frames: &mut Poses,
        locked: Column,
    ) -> Flags;

    /// The solutions of the poses that were solved last. Must be `#[inline(always)]`.
    fn slots(&self) -> &Self::Slots;
}

/// The solutions of a block of poses.
pub(crate) trait BlockSlots<const N: usize, const S: usize> {
    fn write(&self, q: &mut [AnswerRow<N, S>; LANES], status: &mut [StatusRow<S>; LANES]);

    /// How many slots, the first ones, have solutions. Must be `#[inline(always)]`.
    fn used(&self) -> usize {
        S
    }

    /// The angles of a joint in a slot, both from 0. Must be `#[inline(always)]`.
    fn angles(&self, slot: usize, joint: usize) -> Column;

    /// The flags of a slot. Must be `#[inline(always)]`.
    fn status(&self, slot: usize) -> Flags;
}
