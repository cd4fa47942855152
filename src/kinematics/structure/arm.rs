//! The interface of every structure.

use super::free_choice::FreeChoice;
use super::lanes::{Choice, PoseRow};
use super::singular_wrist::SingularWrist;
use super::{NO_LINKAGE, TakeStep};
use crate::kinematics::answer::singularity::SingularDistances;
use crate::kinematics::answer::slot::Slot;
use crate::kinematics::answer::solutions::Solutions;
use crate::kinematics::answer::status::SingularityKind;
use crate::kinematics::pose::Pose;
use crate::report::{FreeJoint, UnknownStructure};

/// The interface of every structure of `N` joints: implemented by
/// [`Solver`](super::solver::Solver), and by the reason why there is none.
pub(crate) trait Arm<const N: usize, R> {
    /// The reason why the arm has none of the known structures; `None` if it has one.
    fn unknown(&self) -> Option<UnknownStructure> {
        None
    }

    /// Name of the structure.
    fn name(&self) -> &'static str;

    /// The name of each slot, if branches have names.
    fn slot_names(&self) -> Option<&'static [&'static str]> {
        None
    }

    /// Solve the pose of the answer, regular or not, one branch after the other.
    ///
    /// # Errors
    ///
    /// The reason why the structure is unknown.
    fn solve(
        &self,
        solutions: &mut Solutions<N>,
        redundancy: R,
        free: &FreeChoice<N>,
    ) -> Result<(), UnknownStructure>;

    /// Solve the answer's pose in lanes if it leaves a path nothing to choose; return whether it
    /// does.
    fn solve_on_path(&self, _solutions: &mut Solutions<N>, _redundancy: R) -> bool {
        false
    }

    /// Solve rows of poses into rows of slots; `by_itself` solves one row, by index, that is not
    /// regular.
    fn solve_rows(&self, rows: Rows<'_, R>, by_itself: &mut RowSolve<'_, N>);

    /// Writes the solution nearest to each seed, of a structure whose poses leave nothing to give;
    /// `by_itself` does so for one row, by its number, that is not regular.
    fn nearest_rows(
        &self,
        poses: &[PoseRow],
        seeds: &[[f64; N]],
        choice: Choice<N>,
        q: &mut [[f64; N]],
        by_itself: &mut RowSolve<'_, N>,
    );

    /// How far a joint vector is from each singularity, and at which of them it stands.
    fn singular(&self, _q: &[f64; N]) -> Option<(Option<SingularDistances>, SingularityKind)> {
        None
    }

    /// [`Structure::singular_distances`]
    fn singular_distances(&self, _q: &[f64; N]) -> Option<SingularDistances> {
        None
    }

    /// [`Structure::nearest`]
    fn nearest(&self) -> Option<UnknownStructure> {
        None
    }

    /// [`Structure::jacobian_determinant`]
    fn jacobian_determinant(&self, _q: &[f64; N]) -> Option<f64> {
        None
    }

    /// [`Structure::slot`]
    fn slot(&self, _q: &[f64; N]) -> Option<Slot> {
        None
    }

    /// [`Structure::sin_5`]
    fn sin_5(&self, _q: &[f64; N]) -> Option<f64> {
        None
    }

    /// [`Structure::corners`]
    fn corners(&self, _q: &[f64; N], _free: FreeJoint) -> Option<[f64; 6]> {
        None
    }

    /// [`Structure::member`], for a pose of the tool.
    fn member(&self, _pose: &Pose, _q: &[f64; N], _joint: usize, _value: f64) -> Option<[f64; N]> {
        None
    }

    /// [`Structure::walk`], for a pose of the tool.
    fn walk(&self, _pose: &Pose, _q: &[f64; N], _pass: &mut TakeStep<'_, N>) {}

    /// [`Structure::singular_wrist`]
    fn singular_wrist(&self) -> Option<&dyn SingularWrist<N>> {
        None
    }

    /// The last frame of the structure in its first frame, for a pose of the tool (eq. 1).
    fn last_frame(&self, pose: &Pose) -> Pose {
        *pose
    }

    /// [`Structure::may_be_coupled`]
    ///
    /// # Errors
    ///
    /// The reason why it may not.
    fn may_be_coupled(&self) -> Result<(), &'static str> {
        Err(NO_LINKAGE)
    }
}

/// Rows to be solved: poses, the redundancy parameter of each, and room for the slots and their
/// status.
pub(crate) struct Rows<'a, R> {
    pub(crate) poses: &'a [PoseRow],
    pub(crate) redundancy: &'a [R],
    pub(crate) q: &'a mut [f64],
    pub(crate) status: &'a mut [u8],
}

/// Solve the row with an index into its slots and their status.
pub(crate) type RowSolve<'a, const N: usize> = dyn FnMut(usize, &mut [[f64; N]], &mut [u8]) + 'a;

impl<const N: usize, R> Arm<N, R> for UnknownStructure {
    fn unknown(&self) -> Option<UnknownStructure> {
        Some(*self)
    }

    fn name(&self) -> &'static str {
        "unknown"
    }

    fn solve(&self, _: &mut Solutions<N>, _: R, _: &FreeChoice<N>) -> Result<(), UnknownStructure> {
        Err(*self)
    }

    fn solve_rows(&self, _: Rows<'_, R>, _: &mut RowSolve<'_, N>) {}

    fn nearest_rows(
        &self,
        _: &[PoseRow],
        _: &[[f64; N]],
        _: Choice<N>,
        _: &mut [[f64; N]],
        _: &mut RowSolve<'_, N>,
    ) {
    }
}
