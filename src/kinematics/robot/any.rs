//! The numbers of joints that arms have: what depends on each, and a robot whose number is known at
//! run time only.

use alloc::sync::Arc;

use super::Robot;
use super::joints::{Count, Joints};
use crate::error::Error;
use crate::kinematics::answer::check::check_seed;
use crate::kinematics::pose::Pose;
use crate::kinematics::structure::known::{FIVE_JOINTS, SEVEN_JOINTS, SIX_JOINTS, of_opw};
use crate::kinematics::structure::refined::Refined;

/// A static, not a constant: what it names is compiled here, not in each crate that uses it.
static SIX: Count<Robot<6>, 6> = Count {
    known: SIX_JOINTS,
    of_opw: Some(of_opw),
    refined: Some(|nominal, [nominal_chain, chain], limits| {
        Arc::new(Refined::new(nominal, nominal_chain.clone(), chain, limits))
    }),
    configured: Some(|robot| robot),
    ..Count::CHAIN
};

impl Joints<6> for Robot<6> {
    const COUNT: &'static Count<Self, 6> = &SIX;
}

static FIVE: Count<Robot<5>, 5> = Count { known: FIVE_JOINTS, ..Count::CHAIN };

impl Joints<5> for Robot<5> {
    const COUNT: &'static Count<Self, 5> = &FIVE;
}

static SEVEN: Count<Robot<7>, 7> = Count {
    known: SEVEN_JOINTS,
    configured: Some(|robot| robot),
    redundancy: Some(|robot| robot),
    ..Count::CHAIN
};

impl Joints<7> for Robot<7> {
    const COUNT: &'static Count<Self, 7> = &SEVEN;
}

macro_rules! chains {
    ($($n:literal)+) => {
        $(impl Joints<$n> for Robot<$n> {
            const COUNT: &'static Count<Self, $n> = &Count::CHAIN;
        })+
    };
}
chains!(1 2 3 4 8 9 10 11 12);

/// A robot of five, six or seven joints, where a name or a file says which.
///
/// Their answers have different sizes: match it to solve. A seven-axis arm takes its
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
///     AnyRobot::Five(robot) => robot.ik(&pose)?.len(),
/// };
/// assert!(found > 0);
/// # Ok::<(), irbkin::Error>(())
/// ```
pub type AnyRobot = ByJoints<Robot<6>, Robot<7>, Robot<5>>;

/// A value of an arm of five, six or seven joints.
#[doc(hidden)]
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum ByJoints<S, V, F> {
    /// Six joints.
    Six(S),
    /// Seven joints.
    Seven(V),
    /// Five joints.
    Five(F),
}

/// Evaluate one expression on the value of a [`ByJoints`](crate::ByJoints).
#[doc(hidden)]
#[macro_export]
macro_rules! on {
    ($either:expr, $inner:ident => $body:expr) => {
        match $either {
            $crate::ByJoints::Six($inner) => $body,
            $crate::ByJoints::Seven($inner) => $body,
            $crate::ByJoints::Five($inner) => $body,
        }
    };
}

/// Evaluate one expression on the value of an arm that may have configurations, of six or seven
/// joints, and another one on an arm of five.
#[doc(hidden)]
#[macro_export]
macro_rules! on_configured {
    ($either:expr, $inner:ident => $body:expr, $five:ident => $other:expr) => {
        match $either {
            $crate::ByJoints::Six($inner) => $body,
            $crate::ByJoints::Seven($inner) => $body,
            $crate::ByJoints::Five($five) => $other,
        }
    };
}

impl<S: From<Robot<6>>, V, F> From<Robot<6>> for ByJoints<S, V, F> {
    fn from(robot: Robot<6>) -> Self {
        Self::Six(robot.into())
    }
}

impl<S, V: From<Robot<7>>, F> From<Robot<7>> for ByJoints<S, V, F> {
    fn from(robot: Robot<7>) -> Self {
        Self::Seven(robot.into())
    }
}

impl<S, V, F: From<Robot<5>>> From<Robot<5>> for ByJoints<S, V, F> {
    fn from(robot: Robot<5>) -> Self {
        Self::Five(robot.into())
    }
}

impl<S, V, F> ByJoints<S, V, F> {
    /// Number of joints.
    #[must_use]
    pub fn dof(&self) -> usize {
        match self {
            Self::Six(_) => 6,
            Self::Seven(_) => 7,
            Self::Five(_) => 5,
        }
    }
}

impl AnyRobot {
    /// Catalog name, or the name given by the caller.
    #[must_use]
    pub fn name(&self) -> &str {
        on!(self, robot => robot.name())
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
        on!(self, robot => Ok(robot.fk(q.try_into().map_err(|_| wrong_length())?)))
    }
}
