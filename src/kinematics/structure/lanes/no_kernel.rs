//! The kernel of a structure without one: every pose is solved by the scalar solver.

use core::convert::Infallible;
use core::fmt::Debug;
use core::marker::PhantomData;

use super::{AnswerRow, Block, BlockSlots, Columns, LaneKernel, Poses, RegularPose, StatusRow};
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::redundancy::Redundancy;
use crate::lanes::{Column, Flags, LANES};

/// No kernel, for a structure with redundancy parameters `R`: this type has no values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct NoKernel<R = ()> {
    never: Infallible,
    redundancy: PhantomData<R>,
}

impl<R, const N: usize, const S: usize> LaneKernel<N, S> for NoKernel<R>
where
    R: Redundancy + Debug + PartialEq,
{
    const DIFFERENCES: &'static [usize] = &[];

    type Redundancy = R;
    type Regular = Self;
    type Block = NoBlock;

    fn solve_one<const FUSED: bool>(&self, _: &Columns<N>, _: &Frame, _: R) -> Option<Self> {
        match self.never {}
    }
}

impl<R, const N: usize> RegularPose<N> for NoKernel<R> {
    fn slot(&self, _: usize) -> Option<([f64; N], u8)> {
        match self.never {}
    }
}

/// A block that is never solved.
pub(crate) struct NoBlock;

impl<R, const N: usize, const S: usize> Block<NoKernel<R>, N, S> for NoBlock
where
    R: Redundancy + Debug + PartialEq,
{
    type Slots = Self;

    const NEW: Self = Self;

    fn solve<const FUSED: bool>(
        &mut self,
        kernel: &NoKernel<R>,
        _: &Columns<N>,
        _: &mut Poses,
        _: R::Lanes,
    ) -> Flags {
        match kernel.never {}
    }

    fn slots(&self) -> &Self {
        self
    }
}

impl<const N: usize, const S: usize> BlockSlots<N, S> for NoBlock {
    fn write(&self, _: &mut [AnswerRow<N, S>; LANES], _: &mut [StatusRow<S>; LANES]) {}

    fn angles(&self, _: usize, _: usize) -> Column {
        [0.0; LANES]
    }

    fn status(&self, _: usize) -> Flags {
        [0; LANES]
    }
}
