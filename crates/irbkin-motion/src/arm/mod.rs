//! An arm: a robot with its body, which is moved through cells.

mod any;
mod shapes;
#[cfg(feature = "serde")]
mod stored;

pub use any::AnyArm;

use alloc::sync::Arc;
use core::fmt;
use core::ops::Deref;

use crate::body::{Body, Outline, body_of};
use crate::error::Error;
use crate::plan::rail::Rail;
use irbkin::catalog::{CatalogArm, find};
use irbkin::{Corrections, Joints, Pose, Robot};

/// A robot with its body: the shapes of its links, if they are known.
///
/// It is used as its [`Robot`], and has what needs a body: [`Arm::go`], [`Arm::plan`], and a place in
/// a [`Cell`](crate::cell::Cell). [`Arm::map`] changes the robot.
///
/// ```
/// use irbkin_motion::Arm;
/// use irbkin::Pose;
///
/// let arm: Arm<6> = Arm::named("UR5e")?;
/// let arm = arm.map(|robot| robot.with_tool(&Pose::translation(0.0, 0.0, 0.1)))?;
/// let (body, pose) = (arm.body(), arm.fk(&[0.3, -1.2, 1.4, -0.5, 0.6, 0.7]));
/// assert!(body.is_some() && arm.ik(&pose)?.len() == 8);
/// # Ok::<(), irbkin_motion::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Arm<const N: usize> {
    robot: Robot<N>,
    body: Option<Arc<ArmBody>>,
    /// Why the shapes of its links make no body, if they do not; no part of its value.
    no_body: Option<Arc<str>>,
    /// What its base slides on, if it does.
    pub(crate) rail: Option<Rail>,
}

/// A body with its outline on an arm.
#[derive(Debug)]
pub(crate) struct ArmBody {
    body: Body,
    pub(crate) outline: Outline,
}

impl ArmBody {
    fn new(body: Body, last: usize, t_last_flange: &Pose) -> Self {
        let outline = Outline::of(&body, last, t_last_flange);
        Self { body, outline }
    }
}

impl<const N: usize> Deref for Arm<N> {
    type Target = Robot<N>;

    #[inline]
    fn deref(&self) -> &Robot<N> {
        &self.robot
    }
}

impl<const N: usize> From<Robot<N>> for Arm<N> {
    /// The robot without a body, on no rail.
    fn from(robot: Robot<N>) -> Self {
        Self { robot, body: None, no_body: None, rail: None }
    }
}

impl<const N: usize> PartialEq for Arm<N> {
    fn eq(&self, other: &Self) -> bool {
        self.robot == other.robot && self.body() == other.body() && self.rail == other.rail
    }
}

impl<const N: usize> fmt::Display for Arm<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.robot.fmt(f)
    }
}

impl<const N: usize> Arm<N>
where
    Robot<N>: Joints<N>,
{
    /// The catalog arm with this name, with its body; [`find`] defines which spellings match.
    ///
    /// # Errors
    ///
    /// As [`Robot::named`].
    pub fn named(name: &str) -> Result<Self, Error> {
        Self::from_catalog(&find(name)?)
    }

    /// A catalog arm, with its body.
    ///
    /// # Errors
    ///
    /// As [`Robot::from_catalog`].
    pub fn from_catalog(arm: &CatalogArm) -> Result<Self, Error> {
        let bare = Self::from(Robot::from_catalog(arm)?);
        let body = body_of(arm.name).map_or_else(|| bare.approximate_body(), Ok)?;
        bare.with_body(Some(body))
    }
}

impl<const N: usize> Arm<N> {
    /// The robot, without the body.
    #[must_use]
    pub fn robot(&self) -> &Robot<N> {
        &self.robot
    }

    /// Return the arm with a robot that `change` makes of its own, and the same body: with another
    /// tool, base or limits, or with a locked joint. A rail moves and turns with the base.
    ///
    /// # Errors
    ///
    /// As `change`.
    pub fn map(
        self,
        change: impl FnOnce(Robot<N>) -> Result<Robot<N>, irbkin::Error>,
    ) -> Result<Self, irbkin::Error> {
        let flange = self.mdh().flange;
        let robot = change(self.robot)?;
        let body = match self.body {
            Some(own) if robot.mdh().flange != flange => {
                Some(Arc::new(ArmBody::new(own.body.clone(), N, &robot.mdh().flange)))
            }
            body => body,
        };
        Ok(Self { robot, body, ..self })
    }

    /// Return the arm with corrected parameters, as [`Robot::with_corrections`]; the shapes of its
    /// links stay where they are at zero joint angles.
    ///
    /// # Errors
    ///
    /// As [`Robot::with_corrections`].
    pub fn with_corrections(&self, corrections: &Corrections<N>) -> Result<Self, Error> {
        let corrected = self.clone().map(|robot| robot.with_corrections(corrections))?;
        if !corrections.are_of_rows() {
            return Ok(corrected);
        }
        let link = |link| corrections.link(self.mdh(), link);
        corrected.with_body(self.body().map(|body| body.clone().in_frames(link)))
    }
}
