//! A robot whose number of joints is known at run time only.

use super::Robot;
use crate::error::Error;
use crate::kinematics::answer::check::check_seed;
use crate::kinematics::pose::Pose;

/// A robot of six or of seven joints, where a name or a file says which.
///
/// The answers of the two have different sizes: match it to solve. A seven-axis arm takes its
/// redundancy parameter with it.
///
/// ```
/// use irbkin::AnyRobot;
///
/// let robot = AnyRobot::named("Panda")?;
/// let pose = robot.fk(&[0.1, -0.7, 0.2, -2.2, 0.1, 1.7, 0.6])?;
/// let found = match &robot {
///     AnyRobot::Six(robot) => robot.ik(&pose)?.len(),
///     AnyRobot::Seven(robot) => robot.ik_with(&pose, 0.6)?.len(),
/// };
/// assert!(found > 0);
/// # Ok::<(), irbkin::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[allow(clippy::large_enum_variant, reason = "a robot has 3 kB, and there are few")]
pub enum AnyRobot {
    /// Six joints.
    Six(Robot<6>),
    /// Seven joints.
    Seven(Robot<7>),
}

impl From<Robot<6>> for AnyRobot {
    fn from(robot: Robot<6>) -> Self {
        Self::Six(robot)
    }
}

impl From<Robot<7>> for AnyRobot {
    fn from(robot: Robot<7>) -> Self {
        Self::Seven(robot)
    }
}

impl AnyRobot {
    /// Number of joints.
    #[must_use]
    pub fn dof(&self) -> usize {
        match self {
            Self::Six(_) => 6,
            Self::Seven(_) => 7,
        }
    }

    /// Catalog name, or the name given by the caller.
    #[must_use]
    pub fn name(&self) -> &str {
        match self {
            Self::Six(robot) => robot.name(),
            Self::Seven(robot) => robot.name(),
        }
    }

    /// Pose of the tool for joint angles [rad].
    ///
    /// # Errors
    ///
    /// [`Error::WrongLength`] for another number of angles than of joints; [`Error::InvalidJoints`]
    /// for an angle that is not finite or larger than
    /// [`MOST_ANGLE`](crate::thresholds::MOST_ANGLE).
    pub fn fk(&self, q: &[f64]) -> Result<Pose, Error> {
        check_seed("q", q)?;
        let wrong_length = || Error::WrongLength { field: "q", found: q.len(), wanted: self.dof() };
        match self {
            Self::Six(robot) => Ok(robot.fk(q.try_into().map_err(|_| wrong_length())?)),
            Self::Seven(robot) => Ok(robot.fk(q.try_into().map_err(|_| wrong_length())?)),
        }
    }
}
