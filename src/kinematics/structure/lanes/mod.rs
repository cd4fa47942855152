//! Poses in lanes: regular poses solved in vectors, for any structure that has a kernel.

mod block;
mod columns;
mod directions;
mod nearest;
mod poses;
mod rows;
mod slots;

pub(crate) use block::{Block, BlockSlots};
pub(crate) use columns::{Columns, JointColumn, JointRow};
pub(crate) use directions::{Direction, Directions};
pub(crate) use nearest::Choice;
pub(crate) use poses::{PoseRow, Poses};
pub(crate) use rows::{Blocks, Wanted};
pub(crate) use slots::{RegularSlots, SlotColumns};

use core::fmt::Debug;

use super::end_frames::Frame;
use crate::kinematics::answer::status::Status;
use crate::report::Reach;

/// The joint angles and the status of the slots of a pose.
pub(crate) type AnswerRow<const N: usize, const S: usize> = [[f64; N]; S];
pub(crate) type StatusRow<const S: usize> = [u8; S];

/// Flags of a branch that reaches, before the limits are checked.
pub(crate) const FOUND_INSIDE: u64 = Status::FOUND.union(Status::WITHIN_LIMITS).bits() as u64;

/// The branches of a structure in branch-free arithmetic, which runs in lanes.
///
/// Where a branch does not reach, its flags are empty and its angles are NaN, like the root of a
/// negative number: rows of an answer contain that there. A kernel solves regular poses and reports
/// which poses are regular: those away from every singularity and from the edge of reach, on all
/// branches. It holds the precomputed constants of an arm.
pub(crate) trait LaneKernel<const N: usize, const S: usize>:
    Clone + Debug + PartialEq
{
    /// Joints, from 0, whose theta is a difference of two angles and may therefore be off by a
    /// turn.
    const DIFFERENCES: &'static [usize];

    /// [`Kernel::WIDE`](crate::lanes::Kernel::WIDE): not if most of it runs in explicit vectors.
    const WIDE: bool = true;

    /// The slots of one regular pose.
    type Regular: RegularPose<N>;

    /// The slots of a block of poses.
    type Block: Block<Self, N, S>;

    /// Return the kernel for the poses of a path: regular are poses whose every branch is
    /// determined so well that a path has nothing to choose. `None` if there is no such bound.
    fn for_path(&self) -> Option<Self> {
        None
    }

    /// Solve for the last frame of the structure in its first frame; `None` if it is not regular.
    /// Must be `#[inline(always)]`.
    fn solve_one<const FUSED: bool>(
        &self,
        columns: &Columns<N>,
        t_first_last: &Frame,
        locked: f64,
    ) -> Option<Self::Regular>;
}

pub(crate) trait RegularPose<const N: usize> {
    /// The joint angles and the flags of a slot; `None` if it has no solution.
    fn slot(&self, slot: usize) -> Option<([f64; N], u8)>;

    /// How far a pose without solutions is out of reach; `None` if the scalar solver decides.
    fn missed(&self) -> Option<Reach> {
        None
    }
}

/// The angle plus half a turn.
#[inline(always)]
pub(crate) fn half_turn(angle: f64) -> f64 {
    angle + if angle > 0.0 { -core::f64::consts::PI } else { core::f64::consts::PI }
}

/// An angle that branches share, for a branch with this status: NaN if it does not reach, like the
/// angles of its own.
#[inline(always)]
pub(crate) fn where_found(status: u64, angle: f64) -> f64 {
    if status == 0 { f64::NAN } else { angle }
}
