//! An arm between the frames in which poses are given, with its limits: the solve that is common to
//! all structures.

use alloc::sync::Arc;

use super::Structure;
use super::end_frames::{EndFrames, Frame, Seen};
use super::free_choice::FreeChoice;
use super::inverse::{Inverse, RowSolve, Rows, Solved};
use super::lanes::{Blocks, Choice, Columns, LaneKernel, PoseRow, RegularPose, Wanted};
use super::self_motions::SelfMotions;
use crate::kinematics::answer::singularity::SingularDistances;
use crate::kinematics::answer::slot::Slot;
use crate::kinematics::answer::solutions::{Place, Solution, Solutions};
use crate::kinematics::answer::status::{SingularityKind, Status};
use crate::kinematics::chain::Chain;
use crate::kinematics::chain::dh::Mdh;
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::pose::Pose;
use crate::lanes::{Kernel, run};

/// A structure with its end frames and joint limits.
#[derive(Clone, Debug)]
pub(crate) struct Solver<T: Structure<N, S>, const N: usize, const S: usize> {
    pub(crate) structure: T,
    pub(crate) end_frames: EndFrames,
    /// `None` if most poses are not regular, or the limits require more than the lanes can do.
    lanes: Option<(T::Kernel, Columns<N>)>,
}

impl<T: Structure<N, S>, const N: usize, const S: usize> Solver<T, N, S> {
    /// The structure between the base and the tool of `chain`, coupled as the chain is, with
    /// limits.
    pub(crate) fn new(structure: T, chain: &Chain<N>, limits: &JointLimits<N>) -> Self {
        let structure = structure.between(chain.base(), chain.tool(), chain.coupling());
        let map = structure.joint_map();
        let columns = Columns::of(map, T::Kernel::DIFFERENCES, limits);
        Self {
            end_frames: EndFrames::new(map, chain),
            lanes: structure.kernel().zip(columns),
            structure,
        }
    }

    #[inline]
    fn solve_with(
        &self,
        kernel: &T::Kernel,
        columns: &Columns<N>,
        solutions: &mut Solutions<N>,
        locked: f64,
    ) -> bool {
        let (seen, pose) = (&self.end_frames.seen, &solutions.pose);
        let Some(regular) = run(Single { kernel, columns, seen, pose, locked }) else {
            return false;
        };
        if let Some(reach) = regular.missed() {
            solutions.reach = reach;
        }
        for (index, place) in solutions.first_places::<S>().iter_mut().enumerate() {
            let Some((q, status)) = regular.slot(index) else { continue };
            let status = Status::from_bits_retain(status);
            *place = Place::Found(Solution { q, slot: Slot::new(index), status, free_joint: None });
        }
        true
    }
}

impl<T: Structure<N, S>, const N: usize, const S: usize> Inverse<N> for Solver<T, N, S> {
    fn name(&self) -> &'static str {
        T::PATTERN.name
    }

    fn slot_count(&self) -> usize {
        S
    }

    fn slot_names(&self) -> Option<&'static [&'static str]> {
        T::SLOT_NAMES.map(|names| &names[..])
    }

    fn between(&self, chain: &Chain<N>, limits: &JointLimits<N>) -> Arc<dyn Inverse<N>> {
        Arc::new(Self::new(self.structure.clone(), chain, limits))
    }

    fn solve_in_lanes(&self, solutions: &mut Solutions<N>, locked: f64) -> bool {
        let Some((kernel, columns)) = &self.lanes else { return false };
        self.solve_with(kernel, columns, solutions, locked)
    }

    fn solve_on_path(&self, solutions: &mut Solutions<N>, locked: f64) -> bool {
        let Some((kernel, columns)) = &self.lanes else { return false };
        kernel.for_path().is_some_and(|kernel| self.solve_with(&kernel, columns, solutions, locked))
    }

    fn solve(&self, solutions: &mut Solutions<N>, locked: f64, free: &FreeChoice<N>) {
        let t_first_last = self.end_frames.wrist_pose(&solutions.pose);
        let branches = self.structure.solve(&t_first_last, locked, free);
        let limits = solutions.limits;
        for (index, place) in solutions.first_places::<S>().iter_mut().enumerate() {
            *place = branches.place(index, &limits, locked);
        }
        solutions.reach = branches.reach;
        solutions.is_certified = branches.is_certified;
    }

    fn solve_rows(&self, rows: Rows<'_>, by_itself: &mut RowSolve<'_, N>) {
        let Rows { poses, locked, q, status } = rows;
        let q = q.as_chunks_mut::<N>().0.as_chunks_mut::<S>().0;
        let status = status.as_chunks_mut::<S>().0;
        match &self.lanes {
            Some((kernel, columns)) => {
                let seen = self.end_frames.seen;
                let wanted = Wanted::Slots { q, status };
                run(Blocks { kernel, columns, seen, poses, locked, wanted, by_itself });
            }
            None => {
                for (row, (q, status)) in q.iter_mut().zip(status).enumerate() {
                    by_itself(row, q, status);
                }
            }
        }
    }

    fn nearest_rows(
        &self,
        poses: &[PoseRow],
        seeds: &[[f64; N]],
        choice: Choice<N>,
        q: &mut [[f64; N]],
        by_itself: &mut RowSolve<'_, N>,
    ) {
        match &self.lanes {
            Some((kernel, columns)) => {
                let seen = self.end_frames.seen;
                let wanted = Wanted::Nearest { choice, seeds, q };
                run(Blocks { kernel, columns, seen, poses, locked: &[], wanted, by_itself });
            }
            None => {
                for (row, q) in q.iter_mut().enumerate() {
                    by_itself(row, core::slice::from_mut(q), &mut []);
                }
            }
        }
    }

    fn singular(&self, q: &[f64; N]) -> (Option<SingularDistances>, SingularityKind) {
        self.structure.singular(q)
    }

    fn jacobian_determinant(&self, q: &[f64; N]) -> Option<f64> {
        Some(self.structure.jacobian_determinant(q))
    }

    fn slot(&self, q: &[f64; N]) -> Option<Slot> {
        self.structure.slot(q)
    }

    #[cfg(test)]
    fn without_lanes(&self) -> Arc<dyn Inverse<N>> {
        Arc::new(Self { lanes: None, ..self.clone() })
    }

    fn like(&self, mdh: &Mdh<N>) -> Option<Solved<N>> {
        let (structure, chain) = (self.structure.like(mdh)?, Chain::new(mdh.clone()));
        let solver = Self::new(structure, &chain, &JointLimits::UNLIMITED);
        Some((chain, Arc::new(solver)))
    }

    fn end_frames(&self) -> Option<&EndFrames> {
        Some(&self.end_frames)
    }

    fn self_motions(&self) -> Option<&dyn SelfMotions<N>> {
        Some(&self.structure)
    }
}

/// One pose in lanes.
struct Single<'a, K: LaneKernel<N, S>, const N: usize, const S: usize> {
    kernel: &'a K,
    columns: &'a Columns<N>,
    seen: &'a Seen,
    pose: &'a Pose,
    locked: f64,
}

impl<K: LaneKernel<N, S>, const N: usize, const S: usize> Kernel for Single<'_, K, N, S> {
    /// `None` if a branch is not regular: the scalar solver then decides.
    type Answer = Option<K::Regular>;
    const WIDE: bool = K::WIDE;

    #[inline(always)]
    fn run<const FUSED: bool>(self) -> Self::Answer {
        let frame = self.seen.of::<FUSED>(&Frame::of(self.pose));
        self.kernel.solve_one::<FUSED>(self.columns, &frame, self.locked)
    }
}
