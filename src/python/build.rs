//! Building robots from Python's arguments.

use pyo3::prelude::*;

use super::arm::Arm;
use super::arrays::Rows;
use super::edits::Edit;
use super::errors::{Fault, to_py};
use super::wording::shape;
use crate::error::{Error, ModelFault};
use crate::kinematics::{DhRow, Mdh, OpwParameters, Pose, Robot, Sdh};
use crate::report::Convention;

/// How a Denavit-Hartenberg table is to be read.
#[derive(Clone, Copy)]
pub(super) struct Table {
    pub(super) convention: Convention,
    /// How far an angle may be from a multiple of 90 deg and still be made one [rad].
    pub(super) snap: f64,
}

/// A robot from a Denavit-Hartenberg table of 6 or 7 rows.
pub(super) fn from_table(
    rows: &Bound<'_, PyAny>,
    limits: Option<&Bound<'_, PyAny>>,
    name: &str,
    table: Table,
) -> PyResult<Arm> {
    let py = rows.py();
    let wanted = "(6, 4) or (7, 4)";
    let rows = Rows::read_wanting(rows, &[4], "rows", Fault::Model, || wanted.to_owned())?;
    let numbers = rows.data()?.as_chunks::<4>().0;
    let arm = match rows.lead[..] {
        [6] => robot_of_table::<6>(numbers, table).map(Arm::from),
        [7] => robot_of_table::<7>(numbers, table).map(Arm::from),
        _ => {
            return Err(Fault::Model.error(
                py,
                format!("rows must have shape {wanted}, got {}", shape(&rows.shape_with(&[4]))),
            ));
        }
    };
    named_and_limited(py, &arm.map_err(|error| to_py(py, &error))?, limits, name)
}

fn robot_of_table<const N: usize>(
    numbers: &[[f64; 4]],
    Table { convention, snap }: Table,
) -> Result<Robot<N>, Error> {
    let found = numbers.len();
    let numbers: &[[f64; 4]; N] =
        numbers.try_into().map_err(|_| ModelFault::JointCount { found, wanted: N })?;
    let rows = numbers.map(|[alpha, a, d, theta]| DhRow::new(alpha, a, d, theta));
    let (base, flange) = (Pose::identity(), Pose::identity());
    match convention {
        Convention::Modified => Robot::from_mdh(Mdh { base, rows, flange }.snapped(snap)?),
        Convention::Standard => Robot::from_sdh(Sdh { base, rows, flange }.snapped(snap)?),
    }
}

/// A robot from the parameters of an ortho-parallel arm; `signs` as floats, as they come out of an
/// array.
pub(super) fn from_opw(
    py: Python<'_>,
    mut opw: OpwParameters,
    signs: [f64; 6],
    limits: Option<&Bound<'_, PyAny>>,
    name: &str,
) -> PyResult<Arm> {
    for (i, value) in signs.into_iter().enumerate() {
        opw.signs[i] = match value {
            1.0 => 1,
            -1.0 => -1,
            _ => return Err(to_py(py, &ModelFault::Sign { joint: i + 1, value }.into())),
        };
    }
    let robot = Robot::from_opw(opw).map_err(|error| to_py(py, &error))?;
    named_and_limited(py, &robot.into(), limits, name)
}

/// The arm under a name, with limits where they were given.
fn named_and_limited(
    py: Python<'_>,
    arm: &Arm,
    limits: Option<&Bound<'_, PyAny>>,
    name: &str,
) -> PyResult<Arm> {
    let arm = arm.changed(py, &Edit::Name(name))?;
    match limits {
        Some(limits) => with_limits(&arm, limits),
        None => Ok(arm),
    }
}

/// The arm with limits of shape (n, 2).
pub(super) fn with_limits(arm: &Arm, limits: &Bound<'_, PyAny>) -> PyResult<Arm> {
    let tail = [arm.dof(), 2];
    let rows = Rows::read_wanting(limits, &tail, "limits", Fault::Model, || shape(&tail))?;
    if !rows.is_single() {
        let (wanted, got) = (shape(&tail), shape(&rows.shape_with(&tail)));
        let message = format!("limits must have shape {wanted}, got {got}");
        return Err(Fault::Model.error(limits.py(), message));
    }
    arm.changed(limits.py(), &Edit::Limits(rows.data()?.as_chunks::<2>().0))
}
