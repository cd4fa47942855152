//! The structures that an arm of so many joints may have, and one way through them.

use core::fmt::Debug;

use super::declare::structures;
use super::free_choice::FreeChoice;
use super::lanes::PoseRow;
use super::open_wrist::OpenWrist;
use super::redundancy::Redundancy;
use super::solver::Solver;
use super::spherical_shoulder::SphericalShoulder;
use super::spherical_wrist::SphericalWrist;
use super::three_parallel::ThreeParallel;
use super::{NO_LINKAGE, Structure};
use crate::kinematics::answer::singularity::SingularDistances;
use crate::kinematics::answer::slot::Slot;
use crate::kinematics::answer::solutions::Solutions;
use crate::kinematics::answer::status::Status;
use crate::kinematics::chain::Chain;
use crate::kinematics::chain::dh::Mdh;
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::pose::Pose;
use crate::report::UnknownStructure;

structures! {
    /// Structures of six joints.
    SixJoints, 6, (): SphericalWrist: 8, ThreeParallel: 8
}

structures! {
    /// Structures of seven joints, of which the caller gives the last.
    SevenJoints, 7, f64: SphericalShoulder: 8
}

/// What any structure of `N` joints is asked: a [`Solver`] answers, or the reason why there is none.
pub(crate) trait Arm<const N: usize, R> {
    /// Why the arm has none of the known structures, if so.
    fn unknown(&self) -> Option<UnknownStructure> {
        None
    }

    /// Name of the structure.
    fn name(&self) -> &'static str;

    /// What each slot stands for, where branches have names.
    fn slot_names(&self) -> Option<&'static [&'static str]> {
        None
    }

    /// Solves the answer's pose, whatever it is, one branch after the other.
    ///
    /// # Errors
    ///
    /// Why the structure is unknown.
    fn solve(
        &self,
        solutions: &mut Solutions<N>,
        redundancy: R,
        free: &FreeChoice<N>,
    ) -> Result<(), UnknownStructure>;

    /// Solves rows of poses into rows of slots; `by_itself` solves one row, by its number, that is not regular.
    fn solve_rows(&self, rows: Rows<'_, R>, by_itself: &mut RowSolve<'_, N>);

    /// How far a joint vector is from each singularity, and at which of them it stands.
    fn singular(&self, _q: &[f64; N]) -> Option<(SingularDistances, Status)> {
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

    /// [`Structure::open_wrist`]
    fn spherical_wrist(&self) -> Option<&dyn OpenWrist<N>> {
        None
    }

    /// The last frame of the structure, seen from its first, of the tool's pose (eq. 1).
    fn last_frame(&self, pose: &Pose) -> Pose {
        *pose
    }

    /// [`Structure::may_be_coupled`]
    ///
    /// # Errors
    ///
    /// Why not.
    fn may_be_coupled(&self) -> Result<(), &'static str> {
        Err(NO_LINKAGE)
    }
}

/// Rows to be solved: poses, what a caller gives with each, and room for the slots and their status.
pub(crate) struct Rows<'a, R> {
    pub(crate) poses: &'a [PoseRow],
    pub(crate) redundancy: &'a [R],
    pub(crate) q: &'a mut [f64],
    pub(crate) status: &'a mut [u8],
}

/// Solves the row of a number into its slots and their status.
pub(crate) type RowSolve<'a, const N: usize> = dyn FnMut(usize, &mut [[f64; N]], &mut [u8]) + 'a;

impl<const N: usize, R> Arm<N, R> for UnknownStructure {
    fn unknown(&self) -> Option<UnknownStructure> {
        Some(*self)
    }

    fn name(&self) -> &'static str {
        "serial"
    }

    fn solve(&self, _: &mut Solutions<N>, _: R, _: &FreeChoice<N>) -> Result<(), UnknownStructure> {
        Err(*self)
    }

    fn solve_rows(&self, _: Rows<'_, R>, _: &mut RowSolve<'_, N>) {}
}

/// The structure of an arm of `N` joints, whichever it is, between its base and its tool.
pub(crate) trait AnyStructure<const N: usize>:
    Clone + Debug + PartialEq + Send + Sync
{
    /// What a caller gives with a pose.
    type Redundancy: Redundancy;

    /// The structure of a table, and the table with what is within rounding of it made exactly so.
    fn recognize(mdh: &Mdh<N>) -> (Chain<N>, Self);

    /// The same structure between the base and the tool of `chain`, with its coupling and limits.
    #[must_use]
    fn between(self, chain: &Chain<N>, limits: &JointLimits<N>) -> Self;

    /// Unknown as it is, with the `snap` that would help; the same where it is known.
    #[must_use]
    fn proposing(self, snap: Option<f64>) -> Self;

    /// Number of slots; none where the structure is unknown.
    fn slot_count(&self) -> usize;

    /// The structure that is asked.
    fn arm(&self) -> &dyn Arm<N, Self::Redundancy>;

    /// [`Solver::solve_in_lanes`]; by itself, for it is what most time goes into.
    fn solve_in_lanes(&self, solutions: &mut Solutions<N>, redundancy: Self::Redundancy) -> bool;
}

/// The solver of a structure that a table has, between no base and no tool, and its chain.
pub(crate) fn recognized<T: Structure<N, S>, const N: usize, const S: usize>(
    mdh: &Mdh<N>,
) -> Result<(Chain<N>, Solver<T, N, S>), UnknownStructure> {
    let mut squared = T::PATTERN.square_up(mdh)?;
    let structure = T::measure(&mut squared)?;
    let chain = Chain::new(squared);
    let solver = Solver::new(structure, &chain, &JointLimits::UNLIMITED);
    Ok((chain, solver))
}
