//! The structures that an arm with a given number of joints may have, behind one interface.

use core::fmt::Debug;

use super::Structure;
use super::arm::Arm;
use super::declare::structures;
use super::general::General;
use super::offset_wrist::OffsetWrist;
use super::redundancy::Redundancy;
use super::refined::{Nominal, Refined};
use super::solver::Solver;
use super::spherical_wrist::SphericalWrist;
use super::three_parallel::ThreeParallel;
use crate::kinematics::answer::solutions::Solutions;
use crate::kinematics::chain::Chain;
use crate::kinematics::chain::dh::Mdh;
use crate::kinematics::chain::limits::JointLimits;
use crate::report::UnknownStructure;

structures! {
    /// Structures with six joints.
    SixJoints, 6, (): SphericalWrist: 8, ThreeParallel: 8, OffsetWrist: 16, General: 16;
    /// The calibrated arm of one of them.
    Refined(Refined<SixJoints>)
}

impl SixJoints {
    /// [`AnyStructure::recognize`] of a table that differs by a link from that of another arm.
    pub(crate) fn recognize_like(mdh: &Mdh<6>, other: &Self) -> (Chain<6>, Self) {
        let Self::General(other) = other else { return Self::recognize(mdh) };
        // What is recognized before an arm in general.
        let is_offset_wrist = OffsetWrist::PATTERN.square_up(mdh).is_ok();
        let (Err(nearest), false) = (Self::closed_form(mdh), is_offset_wrist) else {
            return Self::recognize(mdh);
        };
        let Ok(general) = General::like(mdh, &other.structure) else { return Self::recognize(mdh) };
        let chain = Chain::new(mdh.clone());
        let solver = Solver::new(general.noting(Some(nearest)), &chain, &JointLimits::UNLIMITED);
        (chain, Self::General(solver))
    }
}

impl Nominal for SixJoints {
    fn arm(&self) -> &dyn Arm<6, ()> {
        AnyStructure::arm(self)
    }

    fn slot_count(&self) -> usize {
        AnyStructure::slot_count(self)
    }

    fn solve_in_lanes(&self, solutions: &mut Solutions<6>) -> bool {
        AnyStructure::solve_in_lanes(self, solutions, ())
    }

    fn between(self, chain: &Chain<6>, limits: &JointLimits<6>) -> Self {
        AnyStructure::between(self, chain, limits)
    }
}

/// The structure of an arm of `N` joints, whichever it is, between its base and its tool.
pub(crate) trait AnyStructure<const N: usize>:
    Clone + Debug + PartialEq + Send + Sync
{
    /// The redundancy parameter that a caller gives with a pose.
    type Redundancy: Redundancy;

    /// The structure of a table, and the table with deviations within rounding removed.
    fn recognize(mdh: &Mdh<N>) -> (Chain<N>, Self);

    /// No structure, for a reason.
    fn unknown(reason: UnknownStructure) -> Self;

    /// The name of the structure of a table if that has a closed form; otherwise what the nearest
    /// asks for.
    fn closed_form(mdh: &Mdh<N>) -> Result<&'static str, UnknownStructure>;

    /// The same structure between the base and the tool of `chain`, with its coupling and limits.
    #[must_use]
    fn between(self, chain: &Chain<N>, limits: &JointLimits<N>) -> Self;

    /// Whether the arm has a structure with a closed form.
    fn is_closed_form(&self) -> bool;

    /// The structure of the calibrated arm `chain`, of an arm with this structure; `None` if there
    /// is none to refine.
    fn refining(
        self,
        _nominal: &Chain<N>,
        _chain: &Chain<N>,
        _limits: &JointLimits<N>,
    ) -> Option<Self> {
        None
    }

    /// The same structure with what gives it a closed form; one that has it is returned unchanged.
    #[must_use]
    fn hinting(self, hint: impl FnOnce(UnknownStructure) -> UnknownStructure) -> Self;

    /// Number of slots; zero if the structure is unknown.
    fn slot_count(&self) -> usize;

    /// The structure as a trait object.
    fn arm(&self) -> &dyn Arm<N, Self::Redundancy>;

    /// [`Solver::solve_in_lanes`]; a separate method because most time is spent in it.
    fn solve_in_lanes(&self, solutions: &mut Solutions<N>, redundancy: Self::Redundancy) -> bool;
}

/// The chain and the solver of a table of structure `T`, with identity base and tool.
pub(crate) fn recognized<T: Structure<N, S>, const N: usize, const S: usize>(
    mdh: &Mdh<N>,
) -> Result<(Chain<N>, Solver<T, N, S>), UnknownStructure> {
    let mut squared = T::PATTERN.square_up(mdh)?;
    let structure = T::measure(&mut squared)?;
    let chain = Chain::new(squared);
    let solver = Solver::new(structure, &chain, &JointLimits::UNLIMITED);
    Ok((chain, solver))
}
