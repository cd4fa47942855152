//! A robot of either number of joints behind one Python class.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use pyo3::prelude::*;

use super::arrays::Rows;
use super::errors::{Fault, exception};
use irbkin::catalog::find;
use irbkin::internal::{ModelFault, check_joints, check_near};
pub(super) use irbkin::{ByJoints, on};
use irbkin::{JointLimits, Robot};
use irbkin_motion::internal::check_most_near;
use irbkin_motion::{Arm, Error};

/// A robot of five, six or seven joints.
pub(super) type SharedArm = ByJoints<Arc<Arm<6>>, Arc<Arm<7>>, Arc<Arm<5>>>;

/// Evaluate one expression, which has as many joints, on either value of a [`ByJoints`].
macro_rules! each {
    ($either:expr, $inner:ident => $body:expr) => {
        match $either {
            $crate::arm::ByJoints::Six($inner) => $crate::arm::ByJoints::Six($body),
            $crate::arm::ByJoints::Seven($inner) => $crate::arm::ByJoints::Seven($body),
            $crate::arm::ByJoints::Five($inner) => $crate::arm::ByJoints::Five($body),
        }
    };
}
pub(super) use each;

/// Evaluate one expression on an arm that may have configurations; return the error of another.
macro_rules! configured {
    ($arm:expr, $inner:ident => $body:expr) => {
        irbkin::on_configured!($arm, $inner => $body, arm => {
            return Err($crate::errors::exception(arm.lacks_configurations()));
        })
    };
}
pub(super) use configured;

/// The arm of the catalog with a name: each is made once, for a robot is frozen.
pub(super) fn named(name: &str) -> Result<SharedArm, Error> {
    static MADE: Mutex<BTreeMap<&str, SharedArm>> = Mutex::new(BTreeMap::new());
    let made = || MADE.lock().unwrap_or_else(PoisonError::into_inner);
    let known = |name: &str| made().get(name).cloned();
    if let Some(arm) = known(name) {
        return Ok(arm);
    }
    let entry = find(name)?;
    let arm = known(entry.name)
        .map_or_else(|| irbkin_motion::AnyArm::from_catalog(&entry).map(SharedArm::from), Ok)?;
    Ok(made().entry(entry.name).or_insert(arm).clone())
}

/// An arm with a robot that `change` makes of its own.
pub(super) fn changed<const N: usize>(
    arm: &Arm<N>,
    change: impl FnOnce(Robot<N>) -> Result<Robot<N>, irbkin::Error>,
) -> PyResult<SharedArm>
where
    SharedArm: From<Arm<N>>,
{
    Ok(arm.clone().map(change).map_err(exception)?.into())
}

/// The robot of a call for a YuMi.
pub(super) fn seven_joints(arm: &SharedArm) -> PyResult<&Arc<Arm<7>>> {
    match arm {
        SharedArm::Seven(robot) => Ok(robot),
        SharedArm::Five(_) | SharedArm::Six(_) => {
            Err(exception(Error::from(ModelFault::NoArmAngle)))
        }
    }
}

/// Joint vectors as an argument: a single one must be finite and near the limits, of many most must
/// be near them.
pub(super) fn joints<'py>(arm: &SharedArm, q: &Bound<'py, PyAny>) -> PyResult<Rows<'py>> {
    let rows = Rows::read(q, &[arm.dof()], "q", Fault::Joints)?;
    on!(arm, robot => check_rows(&rows, robot.limits())?);
    Ok(rows)
}

fn check_rows<const N: usize>(rows: &Rows<'_>, limits: &JointLimits<N>) -> PyResult<()> {
    match rows.single::<N>()? {
        Some(q) => {
            check_joints("q", q).map_err(exception)?;
            check_near("q", q, limits, &[1.0; N]).map_err(exception)?;
        }
        None => check_most_near("q", rows.chunks()?, limits, &[1.0; N]).map_err(exception)?,
    }
    Ok(())
}
