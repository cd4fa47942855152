//! Building robots from Python's arguments, and their state for pickle, hash and comparison.

use pyo3::prelude::*;
use pyo3::types::PyTuple;

use super::arm::{Arm, on};
use super::arrays::Rows;
use super::edits::Edit;
use super::errors::{Fault, to_py};
use super::wording::shape;
use crate::error::{Error, ModelFault};
use crate::kinematics::{
    Arity, Definition, DhRow, Joints, Mdh, OpwParameters, Pose, Robot, Sdh, pose_from_rows,
    pose_to_rows,
};
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
) -> Result<Robot<N>, Error>
where
    Joints<N>: Arity<N>,
{
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

/// Everything that a robot was built from: (name, definition, numbers of it, limits, base, tool,
/// velocities, linkage). The last is of coupled arms alone: limits of the linkage, or no numbers.
pub(super) type State =
    (String, String, Vec<f64>, Vec<f64>, Vec<f64>, Vec<f64>, Option<Vec<f64>>, Option<Vec<f64>>);

/// The state of an arm. Equal robots have equal states.
pub(super) fn state(arm: &Arm) -> State {
    on!(arm, robot => {
        let (definition, numbers) = match robot.definition() {
            Definition::Opw(opw) => ("opw", opw_numbers(opw)),
            Definition::Mdh(mdh) => ("mdh", mdh_numbers(mdh)),
        };
        (
            robot.name().to_owned(),
            definition.to_owned(),
            numbers,
            robot.limits().to_array().concat(),
            pose_to_rows(robot.base()).to_vec(),
            pose_to_rows(robot.tool()).to_vec(),
            robot.max_velocity().map(|velocity| velocity.to_vec()),
            robot.is_coupled().then(|| robot.limits().linkage().map_or_else(Vec::new, Vec::from)),
        )
    })
}

fn opw_numbers(opw: &OpwParameters) -> Vec<f64> {
    let lengths = [opw.a1, opw.a2, opw.b, opw.c1, opw.c2, opw.c3, opw.c4];
    lengths.into_iter().chain(opw.offsets).chain(opw.signs.map(f64::from)).collect()
}

fn mdh_numbers<const N: usize>(mdh: &Mdh<N>) -> Vec<f64> {
    let rows = mdh.rows.iter().flat_map(|row| row.to_array());
    rows.chain(pose_to_rows(&mdh.base)).chain(pose_to_rows(&mdh.flange)).collect()
}

/// Hash of a robot's value.
pub(super) fn hash(py: Python<'_>, arm: &Arm) -> PyResult<isize> {
    let (name, definition, numbers, limits, base, tool, velocity, linkage) = state(arm);
    let coupled = linkage.is_some();
    let numbers =
        [numbers, limits, base, tool, velocity.unwrap_or_default(), linkage.unwrap_or_default()]
            .concat();
    // Python's own hash of floats holds 0.0 and -0.0 for one, as the comparison does.
    (name, definition, coupled, PyTuple::new(py, numbers)?).into_pyobject(py)?.hash()
}

/// The arm of a state, for pickle.
pub(super) fn restored(py: Python<'_>, state: &State) -> PyResult<Arm> {
    let (name, definition, numbers, limits, base, tool, velocity, linkage) = state;
    let (limit_rows, rest) = limits.as_chunks::<2>();
    let broken = || Fault::Model.error(py, "the pickled robot is damaged".to_owned());
    if !rest.is_empty() {
        return Err(broken());
    }
    let built = match (definition.as_str(), numbers.len()) {
        ("opw", 19) => opw_of(numbers).ok_or_else(broken)?.map(Arm::from),
        ("mdh", 56) => mdh_of::<6>(numbers).ok_or_else(broken)?.map(Arm::from),
        ("mdh", 60) => mdh_of::<7>(numbers).ok_or_else(broken)?.map(Arm::from),
        _ => return Err(broken()),
    };
    let pose = |rows: &[f64]| -> PyResult<Pose> {
        let rows = <&[f64; 16]>::try_from(rows).map_err(|_| broken())?;
        pose_from_rows(rows).map_err(|error| to_py(py, &error))
    };
    built
        .map_err(|error| to_py(py, &error))?
        .changed(py, &Edit::Name(name))?
        .changed(py, &Edit::Coupling(linkage.as_deref()))?
        .changed(py, &Edit::StoredLimits(limit_rows))?
        .changed(py, &Edit::Base(pose(base)?))?
        .changed(py, &Edit::Tool(pose(tool)?))?
        .changed(py, &Edit::MaxVelocity(velocity.as_deref()))
}

fn opw_of(numbers: &[f64]) -> Option<Result<Robot<6>, Error>> {
    let &[a1, a2, b, c1, c2, c3, c4, ref rest @ ..] = numbers else { return None };
    let (offsets, signs) = rest.split_first_chunk::<6>()?;
    let signs = <[f64; 6]>::try_from(signs).ok()?;
    if signs.iter().any(|sign| sign.abs().total_cmp(&1.0).is_ne()) {
        return None;
    }
    let signs = signs.map(|sign| if sign < 0.0 { -1 } else { 1 });
    Some(Robot::from_opw(OpwParameters { a1, a2, b, c1, c2, c3, c4, offsets: *offsets, signs }))
}

fn mdh_of<const N: usize>(numbers: &[f64]) -> Option<Result<Robot<N>, Error>>
where
    Joints<N>: Arity<N>,
{
    let (rows, poses) = numbers.split_at_checked(4 * N)?;
    let (base, flange) = poses.split_first_chunk::<16>()?;
    let rows = <[[f64; 4]; N]>::try_from(rows.as_chunks::<4>().0).ok()?;
    let rows = rows.map(|[alpha, a, d, theta]| DhRow::new(alpha, a, d, theta));
    let built = pose_from_rows(base)
        .and_then(|base| {
            Ok(Mdh {
                base,
                rows,
                flange: pose_from_rows(flange.try_into().unwrap_or(&[f64::NAN; 16]))?,
            })
        })
        .and_then(Robot::serial_chain);
    Some(built)
}
