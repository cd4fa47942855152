//! A robot of either number of joints behind one Python class.

use std::sync::Arc;

use pyo3::prelude::*;

use super::arrays::Rows;
use super::errors::Fault;
use crate::error::{Error, ModelFault};
use crate::kinematics::{AnyRobot, JointLimits, Robot, check_joints, check_most_near, check_near};

/// A value of a robot of six joints, or of one of seven.
#[derive(Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub(super) enum ByJoints<S, V> {
    Six(S),
    Seven(V),
}

/// Evaluate one expression on either.
macro_rules! on {
    ($either:expr, $inner:ident => $body:expr) => {
        match $either {
            $crate::python::arm::ByJoints::Six($inner) => $body,
            $crate::python::arm::ByJoints::Seven($inner) => $body,
        }
    };
}
pub(super) use on;

/// A robot of six or seven joints.
pub(super) type Arm = ByJoints<Arc<Robot<6>>, Arc<Robot<7>>>;

impl From<AnyRobot> for Arm {
    fn from(robot: AnyRobot) -> Self {
        match robot {
            AnyRobot::Six(robot) => robot.into(),
            AnyRobot::Seven(robot) => robot.into(),
        }
    }
}

impl From<Robot<6>> for Arm {
    fn from(robot: Robot<6>) -> Self {
        Self::Six(Arc::new(robot))
    }
}

impl From<Robot<7>> for Arm {
    fn from(robot: Robot<7>) -> Self {
        Self::Seven(Arc::new(robot))
    }
}

impl Arm {
    pub(super) fn named(name: &str) -> Result<Self, Error> {
        AnyRobot::named(name).map(Self::from)
    }

    pub(super) fn dof(&self) -> usize {
        match self {
            Self::Six(_) => 6,
            Self::Seven(_) => 7,
        }
    }

    /// The robot of a call for a YuMi.
    pub(super) fn seven_joints(&self) -> PyResult<&Arc<Robot<7>>> {
        match self {
            Self::Six(_) => Err(Error::from(ModelFault::NoArmAngle).into()),
            Self::Seven(robot) => Ok(robot),
        }
    }

    /// An arm that has configurations.
    pub(super) fn check_rule(&self) -> PyResult<()> {
        Ok(on!(self, robot => robot.configuration_rule().map(drop))?)
    }

    /// Joint vectors as an argument: a single one must be finite and near the limits, of many most
    /// must be near them.
    pub(super) fn joints<'py>(&self, q: &Bound<'py, PyAny>) -> PyResult<Rows<'py>> {
        let rows = Rows::read(q, &[self.dof()], "q", Fault::Joints)?;
        on!(self, robot => check_rows(&rows, robot.limits())?);
        Ok(rows)
    }
}

fn check_rows<const N: usize>(rows: &Rows<'_>, limits: &JointLimits<N>) -> PyResult<()> {
    match rows.single::<N>()? {
        Some(q) => {
            check_joints("q", q)?;
            check_near("q", q, limits, &[1.0; N])?;
        }
        None => check_most_near("q", rows.chunks()?, limits, &[1.0; N])?,
    }
    Ok(())
}
