//! A robot: a chain, its limits and, where its structure is known, its inverse.

pub(super) mod any;
pub(super) mod build;
mod corrected;
mod display;
pub(super) mod joints;
mod linkage;
mod locked;
mod margin;
mod reading;
#[cfg(feature = "serde")]
mod stored;

pub use joints::Joints;
pub use margin::Margin;

use alloc::borrow::Cow;
use alloc::boxed::Box;
use alloc::sync::Arc;

use joints::{Configured, Count, Redundancy};
#[cfg(not(feature = "std"))]
use nalgebra::RealField as _;
use nalgebra::{SMatrix, Vector3};

use crate::error::{Error, ModelFault};
use crate::kinematics::answer::singularity::{SingularDistances, Singularity};
use crate::kinematics::answer::slot::Slot;
use crate::kinematics::answer::status::SingularityKind;
use crate::kinematics::chain::Chain;
use crate::kinematics::chain::axes::Axes;
use crate::kinematics::chain::dh::Mdh;
use crate::kinematics::chain::forward::{Frames, Poses, is_finite};
use crate::kinematics::chain::jacobian::{JacobianFrame, Jacobians};
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::chain::singular_values::SingularValues;
use crate::kinematics::pose::{Pose, PoseDifference};
use crate::kinematics::structure::end_frames::EndFrames;
use crate::kinematics::structure::inverse::Inverse;
use crate::kinematics::structure::locked::LockedJoint;
use crate::kinematics::structure::self_motions::{SelfMotions, SingularWrist};
use crate::kinematics::structure::spherical_wrist::OpwParameters;
use crate::lanes::{LANES, run};
use crate::report::{ConfigurationRule, UnknownStructure};

/// A robot arm of `N` revolute joints.
///
/// Build one from the catalog ([`Robot::named`]), from parameters ([`Robot::from_opw`]) or from a
/// Denavit-Hartenberg table ([`Robot::from_mdh`], [`Robot::from_sdh`]). A robot is immutable: each
/// `with_` method returns a new one. No solve allocates.
#[derive(Clone, Debug)]
pub struct Robot<const N: usize> {
    name: Cow<'static, str>,
    definition: Definition<N>,
    count: &'static Count<Self, N>,
    chain: Chain<N>,
    /// `None` if the structure is unknown.
    inverse: Option<Arc<dyn Inverse<N>>>,
    /// The closed form that is nearest, and how far the arm is from it; `None` if it has one.
    missing_form: Option<UnknownStructure>,
    limits: JointLimits<N>,
    max_velocity: Option<[f64; N]>,
    /// How its controller counts configurations, if in a way of its own.
    rule: Option<ConfigurationRule>,
    lock: Option<Lock<N>>,
    /// No part of its value.
    labels: Option<Arc<display::Labels>>,
}

/// A locked joint, with the robot of the six others.
#[derive(Clone, Debug)]
pub(in crate::kinematics) struct Lock<const N: usize> {
    pub(in crate::kinematics) joint: LockedJoint,
    /// Its angle [rad].
    pub(in crate::kinematics) angle: f64,
    /// The other six joints. Another angle of the first or of the last joint only moves the pose
    /// that they must reach.
    pub(in crate::kinematics) six: Arc<Robot<6>>,
    /// Of a joint between them, the chain with it at an angle by which others are prepared.
    like: Option<Arc<Robot<6>>>,
    released: Released<N>,
}

/// The inverse of the arm without the lock, for any base, tool and limits.
#[derive(Clone, Debug)]
struct Released<const N: usize> {
    inverse: Option<Arc<dyn Inverse<N>>>,
    missing_form: Option<UnknownStructure>,
}

/// The definition that a robot was built from.
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

impl<const N: usize> PartialEq for Robot<N> {
    /// The inverse follows from the rest, if there is one.
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
            && self.definition == other.definition
            && self.chain == other.chain
            && self.inverse.is_some() == other.inverse.is_some()
            && self.limits == other.limits
            && self.max_velocity == other.max_velocity
            && self.rule == other.rule
            && self.locked_joint() == other.locked_joint()
    }
}

impl<const N: usize> Robot<N> {
    /// Rebuild the inverse for the base, tool, coupling and limits.
    fn joined(mut self) -> Self {
        self.inverse = self.inverse.map(|inverse| inverse.between(&self.chain, &self.limits));
        self.lock = self.lock.map(|lock| lock.between(&self.chain, &self.limits));
        self
    }

    /// The inverse; `None` if the structure is unknown.
    #[inline]
    pub(in crate::kinematics) fn inverse(&self) -> Option<&dyn Inverse<N>> {
        self.inverse.as_deref()
    }

    /// The arm as one with configurations.
    pub(in crate::kinematics) fn with_configurations(&self) -> Result<&dyn Configured<N>, Error> {
        Ok(self.count.configured.ok_or_else(|| self.lacks_configurations())?(self))
    }

    /// The error of an arm without configurations.
    #[doc(hidden)]
    pub fn lacks_configurations(&self) -> Error {
        ModelFault::NoConfiguration { structure: self.structure(), snap: None }.into()
    }

    /// The arm as one that has one joint more than a pose needs; it may be locked.
    pub(in crate::kinematics) fn with_redundancy(&self) -> Option<&dyn Redundancy<N>> {
        self.count.redundancy.map(|of| of(self))
    }

    /// [`Self::with_redundancy`] without a locked joint.
    pub(crate) fn redundancy(&self) -> Option<&dyn Redundancy<N>> {
        self.with_redundancy().filter(|_| self.lock.is_none())
    }

    /// Whether it has seven joints, none of them locked.
    #[doc(hidden)]
    pub fn is_redundant(&self) -> bool {
        self.redundancy().is_some()
    }

    /// Whether the arm has a structure with a closed form.
    pub(in crate::kinematics) fn is_closed_form(&self) -> bool {
        self.missing_form.is_none() && !matches!(self.definition, Definition::Refined { .. })
    }

    /// The arm as one with a spherical wrist, if it has one.
    pub(in crate::kinematics) fn singular_wrist(&self) -> Option<&dyn SingularWrist<N>> {
        self.inverse()?.self_motions()?.singular_wrist()
    }

    pub(in crate::kinematics) fn sin_5(&self, q: &[f64; N]) -> Option<f64> {
        self.inverse()?.self_motions()?.sin_5(q)
    }

    /// The known self-motions, and the pose in the frames of their structure.
    pub(in crate::kinematics) fn self_motions(
        &self,
        pose: &Pose,
    ) -> Option<(&dyn SelfMotions<N>, Pose)> {
        let inverse = self.inverse()?;
        Some((inverse.self_motions()?, inverse.wrist_pose(pose)))
    }

    #[cfg(test)]
    pub(in crate::kinematics) fn without_lanes(self) -> Self {
        let inverse = self.inverse().map(Inverse::without_lanes);
        Self { inverse, ..self }
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
        self.inverse().map_or("unknown", Inverse::name)
    }

    /// The reason why the structure of the arm is unknown; `None` if it is known.
    #[must_use]
    pub fn unknown_structure(&self) -> Option<UnknownStructure> {
        self.missing_form.filter(|_| self.inverse.is_none())
    }

    /// The conditions that keep the arm from a closed form, and a `snap` or another reading of
    /// its table that would give it one; `None` if it has one. Such an arm is solved without.
    #[must_use]
    pub fn missing_form(&self) -> Option<UnknownStructure> {
        self.missing_form
    }

    /// Number of slots of an answer: zero if the structure is unknown.
    #[must_use]
    pub fn slot_count(&self) -> usize {
        self.inverse().map_or(0, Inverse::slot_count)
    }

    /// The name of each slot; `None` if slots are ordinals or the structure is unknown.
    #[must_use]
    pub fn slot_names(&self) -> Option<&'static [&'static str]> {
        self.inverse()?.slot_names()
    }

    /// The slot of the branch that `q` [rad] is on; the one in front if two meet at a singularity.
    /// `None` if slots are ordinals.
    #[must_use]
    pub fn slot_of(&self, q: &[f64; N]) -> Option<Slot> {
        self.inverse()?.slot(q)
    }

    /// The definition that the robot was built from.
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

    /// The frames of [`Self::link_frames`] for up to eight joint vectors, one in a lane.
    #[doc(hidden)]
    pub fn frames(&self, q: &[[f64; N]], frames: &mut [Axes<LANES>]) {
        run(Frames { chain: &self.chain, q, out: frames });
    }

    /// Derivatives in the controller's joint angles, by derivatives in the angles of the table.
    #[doc(hidden)]
    pub fn by_controller(&self, mut derivatives: [f64; N]) -> [f64; N] {
        if let [_, second, third, ..] = &mut derivatives[..] {
            *second -= self.chain.coupling() * *third;
        }
        derivatives
    }

    /// How far the joints of the table turn at most, by how far the controller's do [rad].
    #[doc(hidden)]
    pub fn table_spans(&self, mut spans: [f64; N]) -> [f64; N] {
        if let [_, second, third, ..] = &mut spans[..] {
            *third += self.chain.coupling().abs() * *second;
        }
        spans
    }

    /// How far the joints of the table turn, by how far the controller's do [rad].
    #[doc(hidden)]
    pub fn table_turns(&self, turns: &[f64; N]) -> [f64; N] {
        self.chain.uncoupled(turns)
    }

    /// Geometric Jacobian of the tool: three linear rows [m/rad], three angular [1]; column `i`
    /// belongs to joint `i + 1`.
    #[must_use]
    pub fn jacobian(&self, q: &[f64; N], frame: JacobianFrame) -> SMatrix<f64, 6, N> {
        self.chain.jacobian(q, frame)
    }

    /// The rows of [`Self::jacobian`].
    #[doc(hidden)]
    pub fn jacobian_rows(&self, q: &[f64; N], frame: JacobianFrame) -> [[f64; N]; 6] {
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
        let (distances, kinds) = self.near_singularities(q);
        Singularity {
            distances,
            min_singular_value: values.least,
            manipulability: values.product,
            kinds,
        }
    }

    /// [`Self::singularity`] without the singular values.
    #[doc(hidden)]
    pub fn near_singularities(&self, q: &[f64; N]) -> (Option<SingularDistances>, SingularityKind) {
        self.inverse().map_or((None, SingularityKind::empty()), |inverse| inverse.singular(q))
    }

    /// Distances of `q` [rad] from the singularities of the structure; `None` if that is unknown.
    #[must_use]
    pub fn singular_distances(&self, q: &[f64; N]) -> Option<SingularDistances> {
        self.inverse()?.singular(q).0
    }

    /// The difference between the tool pose at `q` [rad] and `pose`.
    #[must_use]
    pub fn residual(&self, q: &[f64; N], pose: &Pose) -> PoseDifference {
        PoseDifference::between(&self.fk(q), pose)
    }

    /// The determinant of the geometric Jacobian of joints 1 to 6 [m^3]. It is zero at
    /// singularities only. In a closed form it has the factors of the structure. `None` if the
    /// structure is unknown.
    #[must_use]
    pub fn jacobian_determinant(&self, q: &[f64; N]) -> Option<f64> {
        self.inverse()?.jacobian_determinant(q)
    }
}

impl Robot<5> {
    /// How far a pose may be turned about axis 1 for the arm to reach it [rad].
    #[must_use]
    pub fn heading_tolerance(&self) -> f64 {
        self.chain.heading_tolerance()
    }

    /// The turn of the tool at `q` from `pose` about axis 1, in its upward direction, in (-pi, pi]
    /// [rad]: the nearest to their difference, and all of it for a solution.
    #[must_use]
    pub fn heading_error(&self, q: &[f64; 5], pose: &Pose) -> f64 {
        let between = self.fk(q).rotation * pose.rotation.inverse();
        let end_frames = self.inverse().and_then(Inverse::end_frames);
        let axis = end_frames.map_or(Vector3::z(), EndFrames::up);
        let turn = between.matrix();
        let sine = Vector3::new(
            turn[(2, 1)] - turn[(1, 2)],
            turn[(0, 2)] - turn[(2, 0)],
            turn[(1, 0)] - turn[(0, 1)],
        );
        sine.dot(&axis).atan2(turn.trace() - (axis.transpose() * turn * axis)[0])
    }
}
