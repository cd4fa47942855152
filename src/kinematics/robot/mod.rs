//! A robot: a chain, its limits and, where its structure is known, its inverse.

pub(super) mod any;
mod build;
mod corrected;
mod display;
mod linkage;
mod margin;
mod nominal;
mod reading;
#[cfg(feature = "serde")]
mod stored;

#[cfg(feature = "urdf")]
pub(crate) use build::SNAPS;

pub use margin::Margin;

use alloc::borrow::Cow;
use alloc::boxed::Box;

use nalgebra::SMatrix;

use crate::kinematics::answer::singularity::{SingularDistances, Singularity};
use crate::kinematics::answer::slot::Slot;
use crate::kinematics::answer::status::SingularityKind;
use crate::kinematics::chain::Chain;
use crate::kinematics::chain::dh::Mdh;
use crate::kinematics::chain::forward::{Poses, is_finite};
use crate::kinematics::chain::jacobian::{JacobianFrame, Jacobians};
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::chain::singular_values::SingularValues;
use crate::kinematics::pose::{Pose, PoseDifference};
use crate::kinematics::structure::any::{AnyStructure, SixJoints};
use crate::kinematics::structure::arity::{Arity, Joints, StructureOf};
use crate::kinematics::structure::solver::Solver;
use crate::kinematics::structure::spherical_wrist::{OpwParameters, SphericalWrist};
use crate::lanes::{LANES, run};
use crate::report::{ConfigurationRule, UnknownStructure};

/// A robot arm of `N` revolute joints.
///
/// Build one from the catalog ([`Robot::named`]), from parameters ([`Robot::from_opw`]) or from a
/// Denavit-Hartenberg table ([`Robot::from_mdh`], [`Robot::from_sdh`]). A robot is immutable: each
/// `with_` method returns a new one. No solve allocates.
#[derive(Clone, Debug, PartialEq)]
pub struct Robot<const N: usize>
where
    Joints<N>: Arity<N>,
{
    name: Cow<'static, str>,
    definition: Definition<N>,
    chain: Chain<N>,
    structure: StructureOf<N>,
    limits: JointLimits<N>,
    max_velocity: Option<[f64; N]>,
    /// How its controller counts configurations, if in a way of its own.
    rule: Option<ConfigurationRule>,
}

/// What a robot was built from.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Definition<const N: usize> {
    /// Parameters of an ortho-parallel arm with a spherical wrist.
    Opw(OpwParameters),
    /// A modified Denavit-Hartenberg table with its end transforms.
    Mdh(Mdh<N>),
    /// A calibrated table that is solved by way of its nominal arm.
    Refined {
        /// The calibrated table.
        mdh: Mdh<N>,
        /// The nominal arm.
        nominal: Box<Definition<N>>,
    },
}

impl Robot<6> {
    /// The solver of an arm with a spherical wrist.
    pub(in crate::kinematics) fn wrist_solver(&self) -> Option<&Solver<SphericalWrist, 6, 8>> {
        match &self.structure {
            SixJoints::SphericalWrist(solver) => Some(solver),
            _ => None,
        }
    }

    /// The same arm without lanes.
    #[cfg(test)]
    pub(in crate::kinematics) fn without_lanes(mut self) -> Self {
        self.structure = match self.structure {
            SixJoints::SphericalWrist(solver) => SixJoints::SphericalWrist(solver.without_lanes()),
            SixJoints::ThreeParallel(solver) => SixJoints::ThreeParallel(solver.without_lanes()),
            other @ (SixJoints::OffsetWrist(_)
            | SixJoints::General(_)
            | SixJoints::Refined(_)
            | SixJoints::Unknown(_)) => other,
        };
        self
    }

    /// The geometry of an arm with a spherical wrist.
    pub(in crate::kinematics) fn spherical_wrist(&self) -> Option<&SphericalWrist> {
        self.wrist_solver().map(|solver| &solver.structure)
    }
}

impl<const N: usize> Robot<N>
where
    Joints<N>: Arity<N>,
{
    /// The same arm with its solver rebuilt for its base, tool, coupling and limits.
    fn joined(mut self) -> Self {
        self.structure = self.structure.between(&self.chain, &self.limits);
        self
    }

    pub(in crate::kinematics) fn solver(&self) -> &StructureOf<N> {
        &self.structure
    }

    /// The catalog name, or the name that was given.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Name of the kinematic structure: "spherical wrist", "three parallel axes", "spherical
    /// shoulder", "offset wrist", or "general" for any other; "refined spherical wrist" or "refined
    /// three parallel axes" after [`Robot::with_nominal`]; "unknown" if the first six joints are
    /// not independent, and of a [`Robot::serial_chain`] without a closed form.
    #[must_use]
    pub fn structure(&self) -> &'static str {
        self.structure.arm().name()
    }

    /// The reason why the structure of the arm is unknown; `None` if it is known.
    #[must_use]
    pub fn unknown_structure(&self) -> Option<UnknownStructure> {
        self.structure.arm().unknown()
    }

    /// What keeps the arm from a structure with a closed form, and a `snap` or another reading of
    /// its table that would give it one; `None` if it has one. Such an arm is solved without.
    #[must_use]
    pub fn missing_form(&self) -> Option<UnknownStructure> {
        let arm = self.structure.arm();
        arm.unknown().or_else(|| arm.nearest())
    }

    /// Number of slots of an answer: zero if the structure is unknown.
    #[must_use]
    pub fn slot_count(&self) -> usize {
        self.structure.slot_count()
    }

    /// The name of each slot; `None` if slots are ordinals or the structure is unknown.
    #[must_use]
    pub fn slot_names(&self) -> Option<&'static [&'static str]> {
        self.structure.arm().slot_names()
    }

    /// The slot of the branch that `q` [rad] is on; the one in front if two meet at a singularity.
    /// `None` if slots are ordinals.
    #[must_use]
    pub fn slot_of(&self, q: &[f64; N]) -> Option<Slot> {
        self.structure.arm().slot(q)
    }

    /// What the robot was built from.
    #[must_use]
    pub fn definition(&self) -> &Definition<N> {
        &self.definition
    }

    /// The modified Denavit-Hartenberg table with its fixed end transforms.
    #[must_use]
    pub fn mdh(&self) -> &Mdh<N> {
        self.chain.mdh()
    }

    /// The base in the world.
    #[must_use]
    pub fn base(&self) -> &Pose {
        self.chain.base()
    }

    /// The tool center point in the flange frame.
    #[must_use]
    pub fn tool(&self) -> &Pose {
        self.chain.tool()
    }

    /// Joint limits.
    #[must_use]
    pub fn limits(&self) -> &JointLimits<N> {
        &self.limits
    }

    /// Velocity limits [rad/s]; `None` if unknown.
    #[must_use]
    pub fn max_velocity(&self) -> Option<&[f64; N]> {
        self.max_velocity.as_ref()
    }

    /// How the controller of the arm counts configurations, if in a way of its own.
    pub(crate) fn own_rule(&self) -> Option<ConfigurationRule> {
        self.rule
    }

    /// The pose of the tool for the joint angles `q` [rad].
    #[must_use]
    pub fn fk(&self, q: &[f64; N]) -> Pose {
        self.chain.fk(q)
    }

    /// The pose of every link frame of the modified table, and the pose of the tool.
    #[must_use]
    pub fn link_frames(&self, q: &[f64; N]) -> ([Pose; N], Pose) {
        self.chain.link_frames(q)
    }

    /// Geometric Jacobian of the tool: three linear rows [m/rad], three angular [1]; column `i`
    /// belongs to joint `i + 1`.
    #[must_use]
    pub fn jacobian(&self, q: &[f64; N], frame: JacobianFrame) -> SMatrix<f64, 6, N> {
        self.chain.jacobian(q, frame)
    }

    /// The rows of [`Self::jacobian`].
    #[cfg(feature = "python")]
    pub(crate) fn jacobian_rows(&self, q: &[f64; N], frame: JacobianFrame) -> [[f64; N]; 6] {
        self.chain.jacobian_rows(q, frame)
    }

    /// [`Self::fk`] for many joint vectors, in lanes: rows of joint angles in, rows of pose
    /// elements out.
    pub(crate) fn fk_rows(&self, q: &[[f64; N]], poses: &mut [[f64; 16]]) {
        run(Poses { chain: &self.chain, q, out: poses });
    }

    /// [`Self::jacobian`] for many joint vectors, in lanes.
    pub(crate) fn jacobians(
        &self,
        q: &[[f64; N]],
        frame: JacobianFrame,
        jacobians: &mut [[[f64; N]; 6]],
    ) {
        run(Jacobians { chain: &self.chain, frame, q, out: jacobians });
    }

    /// How near `q` [rad] is to the singularities.
    #[must_use]
    pub fn singularity(&self, q: &[f64; N]) -> Singularity {
        self.singularity_of(q, self.chain.singular_values(q))
    }

    /// [`Self::singularity`] of many, in lanes; none of a row that is not finite.
    pub(crate) fn singularities<'a>(
        &'a self,
        q: &'a [[f64; N]],
    ) -> impl Iterator<Item = Option<Singularity>> + 'a {
        q.chunks(LANES).flat_map(move |q| {
            let values = self.chain.singular_values_of_rows(q);
            q.iter()
                .zip(values)
                .map(|(q, values)| is_finite(q).then(|| self.singularity_of(q, values)))
        })
    }

    fn singularity_of(&self, q: &[f64; N], values: SingularValues) -> Singularity {
        let arm = self.structure.arm().singular(q);
        Singularity {
            distances: arm.and_then(|(distances, _)| distances),
            min_singular_value: values.least,
            manipulability: values.product,
            kinds: arm.map_or(SingularityKind::empty(), |(_, singularities)| singularities),
        }
    }

    /// Distances of `q` [rad] from the singularities of the structure; `None` if that is unknown.
    #[must_use]
    pub fn singular_distances(&self, q: &[f64; N]) -> Option<SingularDistances> {
        self.structure.arm().singular_distances(q)
    }

    /// The difference between the tool pose at `q` [rad] and `pose`.
    #[must_use]
    pub fn residual(&self, q: &[f64; N], pose: &Pose) -> PoseDifference {
        PoseDifference::between(&self.fk(q), pose)
    }

    /// The determinant of the geometric Jacobian of joints 1 to 6 [m^3]. It is zero at
    /// singularities only. In a closed form its factors are those of the structure. `None` if the
    /// structure is unknown.
    #[must_use]
    pub fn jacobian_determinant(&self, q: &[f64; N]) -> Option<f64> {
        self.structure.arm().jacobian_determinant(q)
    }
}
