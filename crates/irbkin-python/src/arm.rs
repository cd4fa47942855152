//! A robot of either number of joints behind one Python class.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use pyo3::prelude::*;

use super::arrays::Rows;
use super::errors::{Fault, exception};
use irbkin::catalog::find;
use irbkin::internal::{ModelFault, check_joints, check_most_near, check_near};
use irbkin::{AnyRobot, Error, JointLimits, Robot};
pub(super) use irbkin::{ByJoints, on};

/// A robot of six or seven joints.
pub(super) type Arm = ByJoints<Arc<Robot<6>>, Arc<Robot<7>>>;

/// The arm of the catalog with a name: each is made once, for a robot is frozen.
pub(super) fn named(name: &str) -> Result<Arm, Error> {
    static MADE: Mutex<BTreeMap<&str, Arm>> = Mutex::new(BTreeMap::new());
    let made = || MADE.lock().unwrap_or_else(PoisonError::into_inner);
    let known = |name: &str| made().get(name).cloned();
    if let Some(arm) = known(name) {
        return Ok(arm);
    }
    let entry = find(name)?;
    let arm =
        known(entry.name).map_or_else(|| AnyRobot::from_catalog(&entry).map(Arm::from), Ok)?;
    Ok(made().entry(entry.name).or_insert(arm).clone())
}

/// The robot of a call for a YuMi.
pub(super) fn seven_joints(arm: &Arm) -> PyResult<&Arc<Robot<7>>> {
    match arm {
        Arm::Six(_) => Err(exception(Error::from(ModelFault::NoArmAngle))),
        Arm::Seven(robot) => Ok(robot),
    }
}

/// Joint vectors as an argument: a single one must be finite and near the limits, of many most must
/// be near them.
pub(super) fn joints<'py>(arm: &Arm, q: &Bound<'py, PyAny>) -> PyResult<Rows<'py>> {
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
