//! The kernel of a structure without one: every pose is solved by the scalar solver.

use super::{AnswerRow, Block, Columns, LaneKernel, Poses, RegularPose, StatusRow};
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::redundancy::Redundancy;
use crate::lanes::{Column, Flags, LANES};

/// No kernel: this type has no values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum NoKernel {}

impl<const N: usize, const S: usize> LaneKernel<N, S> for NoKernel {
    const DIFFERENCES: &'static [usize] = &[];

    type Redundancy = ();
    type Regular = Self;
    type Block = NoBlock;

    fn solve_one<const FUSED: bool>(&self, _: &Columns<N>, _: &Frame, (): ()) -> Option<Self> {
        match *self {}
    }
}

impl<const N: usize> RegularPose<N> for NoKernel {
    fn slot(&self, _: usize) -> Option<([f64; N], u8)> {
        match *self {}
    }
}

/// A block that is never solved.
pub(crate) struct NoBlock;

impl<const N: usize, const S: usize> Block<NoKernel, N, S> for NoBlock {
    const NEW: Self = Self;

    fn solve<const FUSED: bool>(
        &mut self,
        kernel: &NoKernel,
        _: &Columns<N>,
        _: &mut Poses,
        (): <() as Redundancy>::Lanes,
    ) -> Flags {
        match *kernel {}
    }

    fn write(&self, _: &mut [AnswerRow<N, S>; LANES], _: &mut [StatusRow<S>; LANES]) {}

    fn angles(&self, _: usize, _: usize) -> &Column {
        &[0.0; LANES]
    }

    fn status(&self, _: usize) -> &Flags {
        &[0; LANES]
    }
}
