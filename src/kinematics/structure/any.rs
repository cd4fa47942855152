//! The closed forms that an arm may have, and one way through them.

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use crate::kinematics::answer::singularity::SingularDistances;
use crate::kinematics::answer::status::Status;
use crate::kinematics::chain::Chain;
use crate::kinematics::chain::dh::{DhRow, Mdh};
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::pose::Pose;
use crate::kinematics::pose::angles::resized;
use crate::kinematics::structure::branches::Branches;
use crate::kinematics::structure::free_choice::FreeChoice;
use crate::kinematics::structure::recognition::NotRecognised;
use crate::kinematics::structure::spherical_shoulder::{self, SevenSolver};
use crate::kinematics::structure::spherical_wrist::{
    self, OpwParameters, SphericalWrist, WristSolver,
};
use crate::kinematics::structure::three_parallel::{self, ParallelSolver};

/// The closed form of an arm.
#[derive(Clone, Debug, PartialEq)]
#[expect(
    clippy::large_enum_variant,
    reason = "a robot is built once and borrowed from then on; a box would need the heap"
)]
pub(crate) enum Geometry {
    SphericalWrist(WristSolver),
    ThreeParallel(ParallelSolver),
    SphericalShoulder(SevenSolver),
    Serial(NotRecognised),
}

impl Geometry {
    /// The closed form of a table, and the table with what is within rounding of that form made exactly so.
    pub(crate) fn of<const N: usize>(mdh: &Mdh<N>) -> (Chain<N>, Self) {
        let (base, flange) = (mdh.base, mdh.flange);
        let found = match (
            <&[DhRow; 6]>::try_from(&mdh.rows[..]),
            <&[DhRow; 7]>::try_from(&mdh.rows[..]),
        ) {
            (Ok(rows), _) => Self::of_six(&Mdh { base, rows: *rows, flange }),
            (_, Ok(rows)) => Self::of_seven(&Mdh { base, rows: *rows, flange }),
            _ => Err(NotRecognised::joint_count(N)),
        };
        found.unwrap_or_else(|reason| (Chain::new(mdh.clone()), Self::Serial(reason)))
    }

    fn of_six<const N: usize>(mdh: &Mdh<6>) -> Result<(Chain<N>, Self), NotRecognised> {
        // A third and a fourth axis that are nearer to parallel than to square belong to the one form, others to the other.
        if mdh.rows[3].alpha.sin().abs() < mdh.rows[3].alpha.cos().abs() {
            let (squared, arm) = three_parallel::recognise(mdh)?;
            let chain = resized_chain(&squared);
            let solver = ParallelSolver::new(arm, &chain, &JointLimits::UNLIMITED);
            return Ok((chain, Self::ThreeParallel(solver)));
        }
        let (squared, arm) = spherical_wrist::recognise(mdh)?;
        let chain = resized_chain(&squared);
        let solver = WristSolver::new(arm, &chain, &JointLimits::UNLIMITED);
        Ok((chain, Self::SphericalWrist(solver)))
    }

    fn of_seven<const N: usize>(mdh: &Mdh<7>) -> Result<(Chain<N>, Self), NotRecognised> {
        let (squared, arm) = spherical_shoulder::recognise(mdh)?;
        let chain = resized_chain(&squared);
        let solver = SevenSolver::new(arm, &chain, &JointLimits::UNLIMITED);
        Ok((chain, Self::SphericalShoulder(solver)))
    }

    /// That of an ortho-parallel arm with a spherical wrist.
    pub(crate) fn of_opw<const N: usize>(opw: &OpwParameters, chain: &Chain<N>) -> Self {
        Self::SphericalWrist(WristSolver::new(
            SphericalWrist::from_opw(opw),
            chain,
            &JointLimits::UNLIMITED,
        ))
    }

    /// The same form between the base and the tool of `chain`, with its coupling and limits.
    pub(crate) fn between<const N: usize>(self, chain: &Chain<N>, limits: &JointLimits<N>) -> Self {
        match self {
            Self::SphericalWrist(solver) => {
                Self::SphericalWrist(WristSolver::new(solver.arm, chain, limits))
            }
            Self::ThreeParallel(solver) => {
                Self::ThreeParallel(ParallelSolver::new(solver.arm, chain, limits))
            }
            Self::SphericalShoulder(solver) => {
                Self::SphericalShoulder(SevenSolver::new(solver.arm, chain, limits))
            }
            Self::Serial(reason) => Self::Serial(reason),
        }
    }

    /// Its name: "spherical wrist", "three parallel axes", "spherical shoulder", or "serial" where there is none.
    pub(crate) fn name(&self) -> &'static str {
        match self {
            Self::SphericalWrist(_) => "spherical wrist",
            Self::ThreeParallel(_) => "three parallel axes",
            Self::SphericalShoulder(_) => "spherical shoulder",
            Self::Serial(_) => "serial",
        }
    }

    /// Every branch of a pose, one after the other.
    pub(crate) fn branches<const N: usize>(
        &self,
        pose: &Pose,
        free: &FreeChoice<N>,
    ) -> Result<Branches<N>, NotRecognised> {
        match self {
            Self::SphericalWrist(solver) => Ok(solver
                .arm
                .solve(&solver.surroundings.wrist_pose(pose), &free.resized())
                .resized()),
            Self::ThreeParallel(solver) => Ok(solver
                .arm
                .solve(&solver.surroundings.wrist_pose(pose), &free.resized())
                .resized()),
            Self::SphericalShoulder(solver) => Ok(solver.solve(pose, &free.resized()).resized()),
            Self::Serial(reason) => Err(*reason),
        }
    }

    /// How far a joint vector is from each singularity, and at which of them it stands.
    pub(crate) fn singular<const N: usize>(
        &self,
        q: &[f64; N],
    ) -> Option<(SingularDistances, Status)> {
        let (six, seven) = (resized(q), resized(q));
        match self {
            Self::SphericalWrist(solver) => {
                Some((solver.arm.singular_distances(&six), solver.arm.kinds(&six)))
            }
            Self::ThreeParallel(solver) => {
                Some((solver.arm.singular_distances(&six), solver.arm.kinds(&six)))
            }
            Self::SphericalShoulder(solver) => {
                Some((solver.arm.singular_distances(&seven), solver.arm.kinds(&seven)))
            }
            Self::Serial(_) => None,
        }
    }

    /// sin q5, signed, of a six-axis arm: zero at its wrist singularity.
    pub(crate) fn sin_5(&self, q: &[f64; 6]) -> Option<f64> {
        match self {
            Self::SphericalWrist(solver) => Some(solver.arm.sin_5(q)),
            Self::ThreeParallel(solver) => Some(solver.arm.sin_5(q)),
            Self::SphericalShoulder(_) | Self::Serial(_) => None,
        }
    }
}

/// The chain of a table, of which there are as many rows as joints: the same array under its generic name.
fn resized_chain<const M: usize, const N: usize>(mdh: &Mdh<M>) -> Chain<N> {
    let rows = core::array::from_fn(|i| mdh.rows.get(i).copied().unwrap_or_default());
    Chain::new(Mdh { base: mdh.base, rows, flange: mdh.flange })
}
