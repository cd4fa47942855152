//! The inverse of an arm, whichever its structure: one object-safe trait.

use alloc::sync::Arc;
use core::fmt::Debug;

use super::end_frames::EndFrames;
use super::free_choice::FreeChoice;
use super::lanes::{Choice, PoseRow};
use super::self_motions::SelfMotions;
use crate::kinematics::answer::singularity::SingularDistances;
use crate::kinematics::answer::slot::Slot;
use crate::kinematics::answer::solutions::Solutions;
use crate::kinematics::answer::status::SingularityKind;
use crate::kinematics::chain::Chain;
use crate::kinematics::chain::dh::Mdh;
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::pose::Pose;

/// A chain with deviations from a structure within rounding removed, and its inverse.
pub(crate) type Solved<const N: usize> = (Chain<N>, Arc<dyn Inverse<N>>);

/// The inverse of an arm of `N` joints between its base and its tool, with its limits: the
/// [`Solver`](super::solver::Solver) of a structure, a [`Refined`](super::refined::Refined) nominal
/// arm, or seven joints with a [`Locked`](super::locked::Locked) one.
///
/// `locked` is the angle of the joint that a caller locks [rad], in an arm of seven joints; an arm
/// of six ignores it.
pub(crate) trait Inverse<const N: usize>: Debug + Send + Sync {
    fn name(&self) -> &'static str;

    fn slot_count(&self) -> usize;

    /// The name of each slot, if branches have names.
    fn slot_names(&self) -> Option<&'static [&'static str]>;

    /// Prepare the same structure for the base, tool and coupling of a chain, and for limits.
    fn between(&self, chain: &Chain<N>, limits: &JointLimits<N>) -> Arc<dyn Inverse<N>>;

    /// Solve the answer's pose in lanes if it is regular; return whether it is.
    fn solve_in_lanes(&self, solutions: &mut Solutions<N>, locked: f64) -> bool;

    /// Solve the answer's pose in lanes if it leaves a path nothing to choose; return whether it
    /// does.
    fn solve_on_path(&self, solutions: &mut Solutions<N>, locked: f64) -> bool;

    /// Solve the pose of the answer, regular or not, one branch after the other.
    fn solve(&self, solutions: &mut Solutions<N>, locked: f64, free: &FreeChoice<N>);

    /// Solve rows of poses into rows of slots; `by_itself` solves one row, by index, that is not
    /// regular.
    fn solve_rows(&self, rows: Rows<'_>, by_itself: &mut RowSolve<'_, N>) {
        let Rows { poses, q, status, .. } = rows;
        let (slots, q) = (self.slot_count(), q.as_chunks_mut::<N>().0);
        let rows = q.chunks_mut(slots).zip(status.chunks_mut(slots));
        for (row, (_, (q, status))) in poses.iter().zip(rows).enumerate() {
            by_itself(row, q, status);
        }
    }

    /// Write the solution nearest to each seed, of an arm whose poses leave no joint to lock;
    /// `by_itself` does so for one row, by index, that is not regular.
    fn nearest_rows(
        &self,
        _poses: &[PoseRow],
        _seeds: &[[f64; N]],
        _choice: Choice<N>,
        q: &mut [[f64; N]],
        by_itself: &mut RowSolve<'_, N>,
    ) {
        for (row, q) in q.iter_mut().enumerate() {
            by_itself(row, core::slice::from_mut(q), &mut []);
        }
    }

    /// Distances of `q` from the singularities, if they have names, and those that it is at.
    fn singular(&self, q: &[f64; N]) -> (Option<SingularDistances>, SingularityKind);

    /// The determinant of the geometric Jacobian of joints 1 to 6, if it is known in closed form.
    fn jacobian_determinant(&self, q: &[f64; N]) -> Option<f64>;

    /// The slot of the branch that `q` is on; `None` if slots are ordinals.
    fn slot(&self, q: &[f64; N]) -> Option<Slot>;

    #[cfg(test)]
    fn without_lanes(&self) -> Arc<dyn Inverse<N>>;

    /// The chain and the inverse of a table that differs by a link from this arm's, if they are
    /// prepared faster than by recognizing the table.
    fn like(&self, _mdh: &Mdh<N>) -> Option<Solved<N>> {
        None
    }

    /// The frames that are removed from a pose for [`Self::self_motions`].
    fn end_frames(&self) -> Option<&EndFrames> {
        None
    }

    /// The wrist frame of a pose, between whose joints the self-motions are.
    fn wrist_pose(&self, pose: &Pose) -> Pose {
        self.end_frames().map_or(*pose, |frames| frames.wrist_pose(pose))
    }

    /// The self-motions of a pose that [`Self::wrist_pose`] returns.
    fn self_motions(&self) -> Option<&dyn SelfMotions<N>> {
        None
    }
}

/// Rows to be solved: poses, the angle of the locked joint in each (empty for six joints), and room
/// for the slots and their status.
#[doc(hidden)]
pub struct Rows<'a> {
    pub poses: &'a [[f64; 16]],
    pub locked: &'a [f64],
    pub q: &'a mut [f64],
    pub status: &'a mut [u8],
}

/// Solve the row with an index into its slots and their status.
pub(crate) type RowSolve<'a, const N: usize> = dyn FnMut(usize, &mut [[f64; N]], &mut [u8]) + 'a;
