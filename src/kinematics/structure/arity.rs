//! The numbers of joints that an arm may have.

use super::any::{AnyStructure, SevenJoints, SixJoints};
use super::arm::Arm;
use super::redundancy::Redundancy;
use super::solver::Solver;
use super::spherical_wrist::{OpwParameters, SphericalWrist};
use crate::kinematics::answer::solutions::Solutions;
use crate::kinematics::chain::Chain;
use crate::kinematics::chain::dh::Mdh;
use crate::kinematics::chain::limits::JointLimits;
use crate::report::UnknownStructure;

/// A number of joints, as a type: `Joints<6>` implements what is specific to six.
#[derive(Clone, Copy, Debug)]
pub struct Joints<const N: usize>;

/// Properties that depend on the number of joints. Implemented for [`Joints`] of 1 to 12; sealed.
pub trait Arity<const N: usize>: sealed::Sealed {
    /// The redundancy parameter that a caller gives with a pose: none for six joints, the angle of
    /// joint 7 [rad] for seven.
    type Redundancy: Redundancy;

    /// The structures that an arm may have.
    #[doc(hidden)]
    #[expect(private_bounds, reason = "sealed: no one outside implements it")]
    type Structure: AnyStructure<N, Redundancy = Self::Redundancy>;

    /// The structure of an ortho-parallel arm with a spherical wrist; `None` if it has another
    /// number of joints.
    #[doc(hidden)]
    #[must_use]
    fn of_opw(_opw: &OpwParameters, _chain: &Chain<N>) -> Option<Self::Structure> {
        None
    }
}

/// The structure of an arm of `N` joints.
pub(crate) type StructureOf<const N: usize> = <Joints<N> as Arity<N>>::Structure;

/// The redundancy parameter that a caller gives with a pose of an arm of `N` joints.
pub type RedundancyOf<const N: usize> = <Joints<N> as Arity<N>>::Redundancy;

mod sealed {
    pub trait Sealed {}

    impl<const N: usize> Sealed for super::Joints<N> {}
}

impl Arity<6> for Joints<6> {
    type Redundancy = ();
    type Structure = SixJoints;

    fn of_opw(opw: &OpwParameters, chain: &Chain<6>) -> Option<SixJoints> {
        let structure = SphericalWrist::from_opw(opw);
        let solver = Solver::new(structure, chain, &JointLimits::UNLIMITED);
        Some(SixJoints::SphericalWrist(solver))
    }
}

impl Arity<7> for Joints<7> {
    type Redundancy = f64;
    type Structure = SevenJoints;
}

macro_rules! without_structures {
    ($($joints:literal)+) => {
        $(impl Arity<$joints> for Joints<$joints> {
            type Redundancy = ();
            type Structure = NoStructure;
        })+
    };
}
without_structures!(1 2 3 4 5 8 9 10 11 12);

/// The structure of an arm with a number of joints for which no structure is known.
#[derive(Clone, Debug, PartialEq)]
pub struct NoStructure(UnknownStructure);

impl<const N: usize> AnyStructure<N> for NoStructure {
    type Redundancy = ();

    fn recognize(mdh: &Mdh<N>) -> (Chain<N>, Self) {
        (Chain::new(mdh.clone()), Self(UnknownStructure::joint_count(N)))
    }

    fn closed_form(_: &Mdh<N>) -> Result<&'static str, UnknownStructure> {
        Err(UnknownStructure::joint_count(N))
    }

    fn between(self, _: &Chain<N>, _: &JointLimits<N>) -> Self {
        self
    }

    fn hinting(self, _: impl FnOnce(UnknownStructure) -> UnknownStructure) -> Self {
        self
    }

    fn slot_count(&self) -> usize {
        0
    }

    fn arm(&self) -> &dyn Arm<N, ()> {
        &self.0
    }

    fn solve_in_lanes(&self, _: &mut Solutions<N>, (): ()) -> bool {
        false
    }
}
