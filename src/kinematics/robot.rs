//! A robot: a chain, its limits and, where its geometry is known, its inverse.

use alloc::borrow::Cow;

use nalgebra::SMatrix;

use crate::error::{Error, ModelFault};
use crate::kinematics::answer::singularity::{Singularity, singular_values};
use crate::kinematics::answer::status::Status;
use crate::kinematics::chain::Chain;
use crate::kinematics::chain::dh::{DhRow, Mdh, Sdh};
use crate::kinematics::chain::forward::Poses;
use crate::kinematics::chain::jacobian::{JacobianFrame, Jacobians};
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::pose::{Pose, PoseError, checked_pose};
use crate::kinematics::structure::any::Geometry;
use crate::kinematics::structure::recognition::NotRecognised;
use crate::kinematics::structure::spherical_shoulder::SphericalShoulder;
use crate::kinematics::structure::spherical_wrist::{OpwParameters, SphericalWrist, WristSolver};
use crate::kinematics::structure::three_parallel::ThreeParallel;
use crate::kinematics::thresholds::{MOST_ANGLE, MOST_LENGTH, MOST_SNAP};
use crate::lanes::run;

/// What is proposed as a `snap` to an arm that it would help [rad]: the least of these.
pub(crate) const SNAPS: [f64; 6] = [1e-8, 1e-7, 1e-6, 1e-5, 1e-4, MOST_SNAP];

/// A robot arm of `N` revolute joints.
///
/// Build one from the catalogue ([`Robot::named`]), from parameters ([`Robot::from_opw`]) or from a Denavit-Hartenberg table
/// ([`Robot::from_mdh`], [`Robot::from_sdh`]). A robot does not change: `with_` gives a new one. No solve allocates.
#[derive(Clone, Debug, PartialEq)]
pub struct Robot<const N: usize> {
    name: Cow<'static, str>,
    definition: Definition<N>,
    chain: Chain<N>,
    geometry: Geometry,
    limits: JointLimits<N>,
    max_velocity: Option<[f64; N]>,
}

/// What a robot was built from.
#[derive(Clone, Debug, PartialEq)]
pub enum Definition<const N: usize> {
    /// Parameters of an ortho-parallel arm with a spherical wrist.
    Opw(OpwParameters),
    /// A modified Denavit-Hartenberg table with its end transforms.
    Mdh(Mdh<N>),
}

impl Robot<6> {
    /// A robot from the parameters of an ortho-parallel arm with a spherical wrist.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidModel`] when a parameter is not finite, a sign is not 1 or -1, or a link has no length.
    pub fn from_opw(opw: OpwParameters) -> Result<Self, Error> {
        Self::of_opw(opw)
    }

    pub(in crate::kinematics) fn wrist_solver(&self) -> Option<&WristSolver> {
        match &self.geometry {
            Geometry::SphericalWrist(solver) => Some(solver),
            _ => None,
        }
    }

    /// The spherical-wrist geometry, for an arm that has one.
    #[must_use]
    pub fn spherical_wrist(&self) -> Option<&SphericalWrist> {
        self.wrist_solver().map(|solver| &solver.arm)
    }

    /// The geometry of an arm with three parallel axes, for one that has them.
    #[must_use]
    pub fn three_parallel(&self) -> Option<&ThreeParallel> {
        match &self.geometry {
            Geometry::ThreeParallel(solver) => Some(&solver.arm),
            _ => None,
        }
    }
}

impl Robot<7> {
    /// The geometry of an arm with a spherical shoulder, for one that has it.
    #[must_use]
    pub fn spherical_shoulder(&self) -> Option<&SphericalShoulder> {
        match &self.geometry {
            Geometry::SphericalShoulder(solver) => Some(&solver.arm),
            _ => None,
        }
    }
}

impl<const N: usize> Robot<N> {
    /// A robot from a modified (Craig) Denavit-Hartenberg table, with the closed form of its geometry.
    ///
    /// A six-axis table may have its frames and its zero pose anywhere; what is within 1e-9 rad or m of the form is made exactly so.
    /// A seven-axis arm of no known form has forward kinematics and the Jacobian. For angles written with few digits, see [`Mdh::snapped`].
    ///
    /// # Errors
    ///
    /// [`Error::InvalidModel`] when a number is not finite, a link has no length, or a six-axis arm has no known form: the message
    /// names the axes and how far they are off. [`Robot::serial_chain`] takes such an arm without its inverse.
    pub fn from_mdh(mdh: Mdh<N>) -> Result<Self, Error> {
        let robot = Self::serial_chain(mdh)?;
        match robot.geometry {
            Geometry::Serial(reason) if N == 6 => Err(ModelFault::NoClosedForm(reason).into()),
            _ => Ok(robot),
        }
    }

    /// A robot from a standard Denavit-Hartenberg table; otherwise as [`Robot::from_mdh`].
    ///
    /// # Errors
    ///
    /// As [`Robot::from_mdh`].
    pub fn from_sdh(sdh: Sdh<N>) -> Result<Self, Error> {
        Self::from_mdh(sdh.into())
    }

    /// A robot from any modified Denavit-Hartenberg table: with the closed form where its geometry has one, without where not.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidModel`] when a number is not finite or a recognised arm's link has no length.
    pub fn serial_chain(mut mdh: Mdh<N>) -> Result<Self, Error> {
        check_rows(&mdh.rows)?;
        (mdh.base, mdh.flange) = (checked_pose(&mdh.base)?, checked_pose(&mdh.flange)?);
        let (chain, mut geometry) = Geometry::of(&mdh);
        if let Geometry::Serial(reason) = &mut geometry {
            let is_taken = |snap| {
                let snapped = mdh.clone().snapped(snap);
                snapped.is_ok_and(|mdh| !matches!(Geometry::of(&mdh).1, Geometry::Serial(_)))
            };
            *reason = reason.proposing(SNAPS.into_iter().find(|snap| is_taken(*snap)));
        }
        Ok(Self::new(Definition::Mdh(mdh), chain, geometry))
    }

    /// The same robot with another proposal of a `snap`, where it has no closed form.
    #[cfg(feature = "urdf")]
    pub(crate) fn proposing(mut self, snap: Option<f64>) -> Self {
        if let Geometry::Serial(reason) = &mut self.geometry {
            *reason = reason.proposing(snap);
        }
        self
    }

    /// [`Robot::from_opw`] for a caller that is generic over the number of joints.
    pub(crate) fn of_opw(opw: OpwParameters) -> Result<Self, Error> {
        let opw = opw.squared_up()?;
        let Mdh { base, rows, flange } = opw.mdh();
        let rows = <[DhRow; N]>::try_from(&rows[..])
            .map_err(|_| ModelFault::JointCount { found: 6, wanted: N })?;
        let chain = Chain::new(Mdh { base, rows, flange });
        let geometry = Geometry::of_opw(&opw, &chain);
        Ok(Self::new(Definition::Opw(opw), chain, geometry))
    }

    fn new(definition: Definition<N>, chain: Chain<N>, geometry: Geometry) -> Self {
        Self {
            name: Cow::Borrowed(""),
            definition,
            chain,
            geometry,
            limits: JointLimits::UNLIMITED,
            max_velocity: None,
        }
    }

    /// The same robot under another name.
    #[must_use]
    pub fn with_name(mut self, name: impl Into<Cow<'static, str>>) -> Self {
        self.name = name.into();
        self
    }

    /// The same robot with other joint limits; those of its rod stay.
    #[must_use]
    pub fn with_limits(mut self, limits: JointLimits<N>) -> Self {
        self.limits = limits.with_rod_of(&self.limits);
        self.joined()
    }

    /// The same robot with limits of the rod that couples axes 2 and 3: (lower, upper) of q3 - q2 [rad], at whatever turn; `None` for none.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidModel`] when a limit is NaN, the lower one is above the upper one, or axes 2 and 3 are not coupled.
    pub fn with_rod_limits(mut self, rod: Option<[f64; 2]>) -> Result<Self, Error> {
        if rod.is_some() && !self.is_coupled() {
            return Err(ModelFault::NoRod.into());
        }
        self.limits = self.limits.with_rod(rod)?;
        Ok(self.joined())
    }

    /// The same robot with velocity limits [rad/s].
    ///
    /// # Errors
    ///
    /// [`Error::InvalidModel`] when a velocity is not positive.
    pub fn with_max_velocity(mut self, max_velocity: Option<[f64; N]>) -> Result<Self, Error> {
        for (i, value) in max_velocity.iter().flatten().copied().enumerate() {
            if value.is_nan() || value <= 0.0 {
                return Err(ModelFault::Velocity { joint: i + 1, value }.into());
            }
        }
        self.max_velocity = max_velocity;
        Ok(self)
    }

    /// The same robot standing at `t_world_base`: poses and Jacobians are then in the world frame. A base that it had is replaced.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidPose`] when the base is no rigid transform.
    pub fn with_base(mut self, t_world_base: &Pose) -> Result<Self, Error> {
        self.chain = self.chain.with_base(checked_pose(t_world_base)?);
        Ok(self.joined())
    }

    /// The same robot with its tool centre point at `t_flange_tool`. A tool that it had is replaced.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidPose`] when the tool is no rigid transform.
    pub fn with_tool(mut self, t_flange_tool: &Pose) -> Result<Self, Error> {
        self.chain = self.chain.with_tool(checked_pose(t_flange_tool)?);
        Ok(self.joined())
    }

    fn joined(mut self) -> Self {
        self.geometry = self.geometry.between(&self.chain, &self.limits);
        self
    }

    /// The twin of this arm whose axes 2 and 3 a parallelogram couples: its joint 3 is this one's plus joint 2, as its controller tells it.
    ///
    /// What was the limit of joint 3 is that of the rod; joint 3 may stand wherever axes 2 and the rod let it, and turns as fast as both
    /// together: there and back again widens both.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidModel`] for an arm without a spherical wrist, or whose axes 2 and 3 turn in opposite senses.
    pub fn coupled(mut self) -> Result<Self, Error> {
        if self.is_coupled() {
            return Ok(self);
        }
        match &self.geometry {
            Geometry::SphericalWrist(solver) if solver.arm.may_be_coupled() => {}
            Geometry::SphericalWrist(_) => {
                return Err(
                    ModelFault::NotCoupled { reason: "they turn in opposite senses" }.into()
                );
            }
            _ => {
                return Err(
                    ModelFault::NotCoupled { reason: "the arm has no spherical wrist" }.into()
                );
            }
        }
        self.chain = self.chain.with_coupling(true);
        self.limits = self.limits.coupled();
        Ok(self.with_twins_velocity().joined())
    }

    /// The twin of this arm without the coupling of axes 2 and 3: its joint 3 is this one's minus joint 2. The arm itself where it has none.
    ///
    /// Its joint 3 is limited as the rod is or, where that is unknown, may stand wherever axes 2 and 3 let it, and turns as fast as both
    /// together: there and back again widens both.
    #[must_use]
    pub fn serial(mut self) -> Self {
        if !self.is_coupled() {
            return self;
        }
        self.chain = self.chain.with_coupling(false);
        self.limits = self.limits.serial();
        self.with_twins_velocity().joined()
    }

    /// Joint 3 of a twin turns as fast as joints 2 and 3 of the arm together.
    fn with_twins_velocity(mut self) -> Self {
        if let Some([_, second, third, ..]) =
            self.max_velocity.as_mut().map(|velocity| &mut velocity[..])
        {
            *third += *second;
        }
        self
    }

    /// Whether a parallelogram couples axes 2 and 3: then joint 3 is told from the base, not from the upper arm.
    #[must_use]
    pub fn is_coupled(&self) -> bool {
        self.chain.is_coupled()
    }

    /// The same arm, coupled or not, with the limits as they are: those of its controller.
    pub(crate) fn with_coupling(mut self, coupled: bool) -> Self {
        self.chain = self.chain.with_coupling(coupled);
        self.joined()
    }

    /// Catalogue name, or the name that was given.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Name of the closed form: "spherical wrist", "three parallel axes", "spherical shoulder", or "serial" where there is none.
    #[must_use]
    pub fn family(&self) -> &'static str {
        self.geometry.name()
    }

    /// Why the arm has no closed form, where it has none.
    #[must_use]
    pub fn no_closed_form(&self) -> Option<NotRecognised> {
        match self.geometry {
            Geometry::Serial(reason) => Some(reason),
            _ => None,
        }
    }

    pub(in crate::kinematics) fn geometry(&self) -> &Geometry {
        &self.geometry
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

    /// The tool centre point in the flange frame.
    #[must_use]
    pub fn tool(&self) -> &Pose {
        self.chain.tool()
    }

    /// Joint limits.
    #[must_use]
    pub fn limits(&self) -> &JointLimits<N> {
        &self.limits
    }

    /// Velocity limits [rad/s], where they are known.
    #[must_use]
    pub fn max_velocity(&self) -> Option<&[f64; N]> {
        self.max_velocity.as_ref()
    }

    /// Pose of the tool for the joint angles `q` [rad].
    #[must_use]
    pub fn fk(&self, q: &[f64; N]) -> Pose {
        self.chain.fk(q)
    }

    /// Every frame of the modified table after its joint, and the pose of the tool.
    #[must_use]
    pub fn link_frames(&self, q: &[f64; N]) -> ([Pose; N], Pose) {
        self.chain.link_frames(q)
    }

    /// Geometric Jacobian of the tool: three linear rows [m/rad], three angular [1]; column `i` belongs to joint `i + 1`.
    #[must_use]
    pub fn jacobian(&self, q: &[f64; N], frame: JacobianFrame) -> SMatrix<f64, 6, N> {
        self.chain.jacobian(q, frame)
    }

    /// The rows of [`Self::jacobian`].
    #[cfg(feature = "python")]
    pub(crate) fn jacobian_rows(&self, q: &[f64; N], frame: JacobianFrame) -> [[f64; N]; 6] {
        self.chain.jacobian_rows(q, frame)
    }

    /// [`Self::fk`] of many, in lanes: rows of joint angles in, rows of pose elements out.
    pub(crate) fn fk_rows(&self, q: &[[f64; N]], poses: &mut [[f64; 16]]) {
        run(Poses { chain: &self.chain, q, out: poses });
    }

    /// [`Self::jacobian`] of many, in lanes.
    pub(crate) fn jacobians(
        &self,
        q: &[[f64; N]],
        frame: JacobianFrame,
        jacobians: &mut [[[f64; N]; 6]],
    ) {
        run(Jacobians { chain: &self.chain, frame, q, out: jacobians });
    }

    /// How far `q` [rad] is from the singularities.
    #[must_use]
    pub fn singularity(&self, q: &[f64; N]) -> Singularity {
        let values = singular_values(&self.jacobian(q, JacobianFrame::Base));
        let arm = self.geometry.singular(q);
        Singularity {
            distances: arm.map(|(distances, _)| distances),
            min_singular_value: values[5],
            manipulability: values.iter().product(),
            kinds: arm.map_or(Status::empty(), |(_, kinds)| kinds),
        }
    }

    /// How far the tool at `q` [rad] is from `pose`.
    #[must_use]
    pub fn residual(&self, q: &[f64; N], pose: &Pose) -> PoseError {
        PoseError::between(&self.fk(q), pose)
    }
}

fn check_rows(rows: &[DhRow]) -> Result<(), Error> {
    for (i, row) in rows.iter().enumerate() {
        ModelFault::check("alpha of row", i + 1, row.alpha, MOST_ANGLE)?;
        ModelFault::check("a of row", i + 1, row.a, MOST_LENGTH)?;
        ModelFault::check("d of row", i + 1, row.d, MOST_LENGTH)?;
        ModelFault::check("theta of row", i + 1, row.theta, MOST_ANGLE)?;
    }
    Ok(())
}
