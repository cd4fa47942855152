//! Building a robot from parameters, from tables, and from another robot.

use alloc::borrow::Cow;
use core::array;
use core::f64::consts::PI;

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use super::joints::{Count, Joints};
use super::reading::other_reading;
use super::{Definition, Robot};
use crate::error::{Error, ModelFault, PoseFault};
use crate::kinematics::chain::Chain;
use crate::kinematics::chain::dh::{DhRow, Mdh, Sdh};
use crate::kinematics::chain::jacobian::JacobianFrame;
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::pose::{Pose, checked_pose};
use crate::kinematics::structure::known::{self, Known, Recognized};
use crate::kinematics::structure::spherical_wrist::OpwParameters;
use crate::kinematics::thresholds::{MOST_ANGLE, MOST_LENGTH, MOST_REACH, MOST_TOOL};
use crate::report::{ConfigurationRule, Convention, SNAPS};

/// Postures in which what always holds is looked for.
pub const POSTURES: u32 = 64;

impl Robot<6> {
    /// A robot from the parameters of an ortho-parallel arm with a spherical wrist.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidModel`] when a parameter is not finite, a sign is not 1 or -1, or a link has
    /// no length.
    pub fn from_opw(opw: OpwParameters) -> Result<Self, Error> {
        Self::of_opw(opw)
    }

    /// Build a robot from a table that differs by a link from the table of another robot.
    pub(crate) fn from_mdh_like(mdh: Mdh<6>, other: &Self) -> Result<Self, Error> {
        let recognize = |mdh: &Mdh<6>, known: &Known<6>| match other.inverse() {
            Some(inverse) => known::recognize_like(mdh, inverse),
            None => known::recognize(mdh, known),
        };
        Self::recognized(mdh, other.count, recognize)?.with_inverse()
    }
}

impl Robot<5> {
    /// Return the robot with another heading tolerance: how far a pose may be turned about axis 1 for
    /// the arm to reach it, 0 to pi [rad]. Every solve, path and plan of the robot uses it; it is
    /// 1e-5 rad unless it is set.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidModel`] when the tolerance is not 0 to pi.
    pub fn with_heading_tolerance(mut self, tolerance: f64) -> Result<Self, Error> {
        check_heading_tolerance(tolerance)?;
        self.chain = self.chain.with_heading_tolerance(tolerance);
        Ok(self.joined())
    }
}

impl<const N: usize> Robot<N>
where
    Self: Joints<N>,
{
    /// A robot from a modified (Craig) Denavit-Hartenberg table, with the solver of its kinematic
    /// structure.
    ///
    /// A six-axis table may have its frames and its zero pose anywhere. Deviations from a closed
    /// form of at most 1e-9 rad or m are removed; [`Robot::missing_form`] says what keeps an arm
    /// from one. Seven joints whose first six are not independent have forward kinematics and the
    /// Jacobian only. For angles with few digits, see [`Mdh::snapped`].
    ///
    /// # Errors
    ///
    /// [`Error::InvalidModel`] when a number is not finite, or six joints do not move the flange in
    /// six independent ways: the message names the axes. [`Robot::serial_chain`] accepts such an
    /// arm, without its inverse.
    pub fn from_mdh(mdh: Mdh<N>) -> Result<Self, Error> {
        let rows = mdh.rows;
        Self::of_table(mdh)?.hinting(&rows, Convention::Modified).with_inverse()
    }

    /// A robot from a standard Denavit-Hartenberg table; otherwise as [`Robot::from_mdh`].
    ///
    /// # Errors
    ///
    /// As [`Robot::from_mdh`].
    pub fn from_sdh(sdh: Sdh<N>) -> Result<Self, Error> {
        let rows = sdh.rows;
        Self::of_table(sdh.into())?.hinting(&rows, Convention::Standard).with_inverse()
    }

    /// A robot from any modified Denavit-Hartenberg table: with the closed form if its structure
    /// has one, otherwise without the inverse, which takes milliseconds to prepare. Its joints need
    /// not be independent.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidModel`] when a number is not finite.
    pub fn serial_chain(mdh: Mdh<N>) -> Result<Self, Error> {
        let recognize = |mdh: &Mdh<N>, known: &Known<N>| {
            known::recognize(mdh, &Known { others: &[], ..*known })
        };
        Self::recognized(mdh, Self::COUNT, recognize)
    }

    /// A robot from any table, with its inverse if its joints are independent.
    #[doc(hidden)]
    pub fn of_table(mdh: Mdh<N>) -> Result<Self, Error> {
        Self::recognized(mdh, Self::COUNT, known::recognize)
    }

    #[cfg(feature = "serde")]
    pub(super) fn of_definition(definition: Definition<N>) -> Result<Self, Error> {
        match definition {
            Definition::Opw(opw) => Self::of_opw(opw),
            Definition::Mdh(mdh) => Self::of_table(mdh),
            Definition::Refined { mdh, nominal } => {
                Self::serial_chain(mdh)?.with_nominal(&Self::of_definition(*nominal)?)
            }
        }
    }

    /// [`Robot::from_opw`] for a caller that is generic over the number of joints.
    pub(crate) fn of_opw(opw: OpwParameters) -> Result<Self, Error> {
        let opw = opw.squared_up()?;
        let of_opw = Self::COUNT.of_opw.ok_or(ModelFault::JointCount { found: 6, wanted: N })?;
        let recognized = Recognized::new(of_opw(&opw), None);
        let robot = Self::new(Self::COUNT, Definition::Opw(opw), recognized);
        robot.check_reach()?;
        Ok(robot)
    }

    /// The robot of a table with the structure of a closed form.
    #[doc(hidden)]
    pub fn in_closed_form(mdh: Mdh<N>) -> Option<Self> {
        Self::closed(mdh, Self::COUNT)
    }
}

pub(super) fn check_heading_tolerance(value: f64) -> Result<(), Error> {
    if (0.0..=PI).contains(&value) {
        Ok(())
    } else {
        Err(ModelFault::HeadingTolerance { value, bound: PI }.into())
    }
}

impl<const N: usize> Robot<N> {
    /// Refuse an arm of five or six joints whose structure is unknown.
    #[doc(hidden)]
    pub fn with_inverse(self) -> Result<Self, Error> {
        match self.unknown_structure() {
            Some(reason) if matches!(N, 5 | 6) => Err(ModelFault::UnknownStructure(reason).into()),
            _ => Ok(self),
        }
    }

    /// A robot of a count from a table, with what is recognized in it.
    pub(super) fn recognized(
        mut mdh: Mdh<N>,
        count: &'static Count<Self, N>,
        recognize: impl FnOnce(&Mdh<N>, &Known<N>) -> Recognized<N>,
    ) -> Result<Self, Error> {
        check_rows(&mdh.rows)?;
        (mdh.base, mdh.flange) = (checked_pose(&mdh.base)?, checked_pose(&mdh.flange)?);
        let recognized = recognize(&mdh, &count.known);
        let mut robot = Self::new(count, Definition::Mdh(mdh), recognized);
        robot.check_reach()?;
        if let Some(missing) = robot.missing_form {
            robot.missing_form = Some(missing.proposing(robot.helpful_snap()));
        }
        Ok(robot)
    }

    fn closed(mdh: Mdh<N>, count: &'static Count<Self, N>) -> Option<Self> {
        let solved = known::closed_form(&mdh, &count.known).ok()?;
        Some(Self::new(count, Definition::Mdh(mdh), Recognized::new(solved, None)))
    }

    /// Check that the tool is no farther from an axis than [`MOST_REACH`].
    fn check_reach(&self) -> Result<(), Error> {
        match distances_of_axes(&self.chain).find(|(_, distance)| *distance > MOST_REACH) {
            None => Ok(()),
            Some((axis, distance)) => {
                Err(ModelFault::TooFar { axis, distance, bound: MOST_REACH }.into())
            }
        }
    }

    /// The largest distance of the flange from an axis, in two poses [m].
    #[doc(hidden)]
    pub fn size(&self) -> f64 {
        let bare = self.chain.clone().with_tool(Pose::identity());
        distances_of_axes(&bare).map(|(_, distance)| distance).fold(0.0, f64::max)
    }

    /// Note another reading of the rows of the table, in which the arm has a closed form, where it
    /// has none as it is.
    #[must_use]
    pub(crate) fn hinting(mut self, rows: &[DhRow; N], convention: Convention) -> Self {
        if let Some(missing) = self.missing_form.filter(|missing| missing.snap().is_none()) {
            self.missing_form =
                Some(missing.reading_as(other_reading(rows, convention, &self.count.known)));
        }
        self
    }

    /// A posture of a Weyl sequence that fills the limits, or a turn where a joint has none.
    #[doc(hidden)]
    pub fn posture(&self, number: u32) -> [f64; N] {
        const PRIMES: [f64; 7] = [2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0];
        let limits = self.limits().to_array();
        array::from_fn(|joint| {
            let [lower, upper] = limits[joint].map(|limit| limit.clamp(-PI, PI));
            let part = (0.5 + f64::from(number) * PRIMES[joint % PRIMES.len()].sqrt()).fract();
            lower + (upper - lower) * part
        })
    }

    /// The least of the snaps that are proposed with which a table has a closed form, with what that
    /// is and how far it moves the tool.
    fn helpful_snap(&self) -> Option<(u8, &'static str, f32)> {
        let Definition::Mdh(mdh) = &self.definition else { return None };
        (0..).zip(SNAPS).find_map(|(index, snap)| {
            let snapped = mdh.clone().snapped(snap).ok()?;
            Self::closed(snapped, self.count).map(|other| self.by_snap((index, other)))
        })
    }

    /// One of [`SNAPS`], the structure of the robot that it makes, and how far the tools of both are
    /// apart in any of some postures [m].
    fn by_snap(&self, (snap, other): (u8, Self)) -> (u8, &'static str, f32) {
        let apart = |q: [f64; N]| {
            let [own, other] = [self, &other].map(|robot| robot.fk(&q).translation.vector);
            (own - other).norm()
        };
        let moves = (0..POSTURES).map(|number| apart(self.posture(number))).fold(0.0, f64::max);
        #[expect(clippy::cast_possible_truncation, reason = "it is shown with two digits")]
        let moves = moves as f32;
        (snap, other.structure(), moves)
    }

    /// Propose another one of [`SNAPS`], with the robot that it makes.
    #[doc(hidden)]
    pub fn proposing(mut self, snap: Option<(u8, Self)>) -> Self {
        let snap = snap.map(|snap| self.by_snap(snap));
        self.missing_form = self.missing_form.map(|missing| missing.proposing(snap));
        self
    }

    fn new(
        count: &'static Count<Self, N>,
        definition: Definition<N>,
        recognized: Recognized<N>,
    ) -> Self {
        let Recognized { chain, inverse, missing_form } = recognized;
        Self {
            name: Cow::Borrowed(""),
            definition,
            count,
            chain,
            inverse,
            missing_form,
            limits: JointLimits::UNLIMITED,
            max_velocity: None,
            rule: None,
            lock: None,
            labels: None,
        }
    }

    /// Set how the controller counts configurations, if in a way of its own.
    pub(crate) fn with_rule(mut self, rule: Option<ConfigurationRule>) -> Self {
        self.rule = rule;
        self
    }

    /// Return the robot under another name.
    #[must_use]
    pub fn with_name(mut self, name: impl Into<Cow<'static, str>>) -> Self {
        self.name = name.into();
        self
    }

    /// Return the robot with other joint limits; the linkage limits are kept.
    #[must_use]
    pub fn with_limits(mut self, limits: JointLimits<N>) -> Self {
        self.limits = limits.with_linkage_of(&self.limits);
        self.joined()
    }

    /// Return the robot with velocity limits [rad/s].
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

    /// Return the robot with its base at `t_world_base`, which replaces its current base. Poses and
    /// Jacobians are then in the world frame.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidPose`] when the base is not a rigid transform.
    pub fn with_base(mut self, t_world_base: &Pose) -> Result<Self, Error> {
        let base = checked_pose(t_world_base)?;
        // Every pose that the arm reaches from there is one.
        let (index, bound) = (base.translation.vector.iamax(), 0.5 * MOST_LENGTH);
        let value = base.translation.vector[index];
        if value.abs() > bound {
            return Err(PoseFault::TooFar { field: "base", index, value, bound }.into());
        }
        self.chain = self.chain.with_base(base);
        Ok(self.joined())
    }

    /// Return the robot with its tool center point at `t_flange_tool`, which replaces its current
    /// tool.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidPose`] when the tool is not a rigid transform, or longer than ten times the
    /// size of the arm.
    pub fn with_tool(mut self, t_flange_tool: &Pose) -> Result<Self, Error> {
        let tool = checked_pose(t_flange_tool)?;
        let length = tool.translation.vector.norm();
        if length > 0.0 {
            let bound = MOST_TOOL * self.size();
            if length > bound {
                return Err(PoseFault::ToolTooLong { length, bound }.into());
            }
        }
        self.chain = self.chain.with_tool(tool);
        Ok(self.joined())
    }
}

/// The axes (from 1) and their distances from the tool [m], in two poses. Lengths of a table by
/// themselves say nothing: next to parallel axes they are large and cancel.
fn distances_of_axes<const N: usize>(chain: &Chain<N>) -> impl Iterator<Item = (usize, f64)> {
    [[0.0; N], [1.0; N]].into_iter().flat_map(|q| {
        let jacobian = chain.jacobian(&q, JacobianFrame::Base);
        (0..N).map(move |i| (i + 1, jacobian.fixed_view::<3, 1>(0, i).norm()))
    })
}

fn check_rows(rows: &[DhRow]) -> Result<(), Error> {
    for (i, row) in rows.iter().enumerate() {
        ModelFault::check("alpha of row", i + 1, row.alpha, MOST_ANGLE)?;
        ModelFault::check("a of row", i + 1, row.a, MOST_LENGTH)?;
        ModelFault::check("d of row", i + 1, row.d, MOST_LENGTH)?;
        ModelFault::check("theta of row", i + 1, row.theta, MOST_ANGLE)?;
        ModelFault::check_radians("alpha of row", i + 1, row.alpha)?;
        ModelFault::check_radians("theta of row", i + 1, row.theta)?;
    }
    Ok(())
}
