//! Robots as numbers and words, for pickle, hash and comparison: what they were built from.

use pyo3::prelude::*;
use pyo3::types::PyTuple;

use super::arm::{Arm, on};
use super::edits::Edit;
use super::errors::{Fault, to_py};
use crate::error::Error;
use crate::kinematics::{
    Definition, DhRow, Mdh, OpwParameters, Pose, Robot, pose_from_rows, pose_to_rows,
};
use crate::report::ConfigurationRule;

/// Everything that a robot was built from: (name, definition, numbers of it, limits, base, tool,
/// velocities, linkage, rule, the locked joint with its angle). The linkage is of coupled arms alone: its limits, or no numbers. The
/// rule is of arms whose controllers count configurations in a way of their own.
pub(super) type State = (
    String,
    String,
    Vec<f64>,
    Vec<f64>,
    Vec<f64>,
    Vec<f64>,
    Option<Vec<f64>>,
    Option<Vec<f64>>,
    Option<RuleState>,
    Option<(usize, f64)>,
);

/// The name of a rule and its numbers.
type RuleState = (String, Vec<f64>);

/// Numbers of an ortho-parallel arm: seven lengths, six offsets, six signs.
const OPW_NUMBERS: usize = 7 + 6 + 6;

/// Numbers of a table: its rows, base and flange.
const fn mdh_count(joints: usize) -> usize {
    4 * joints + 2 * 16
}

/// The state of an arm. Equal robots have equal states.
pub(super) fn state(arm: &Arm) -> State {
    on!(arm, robot => {
        let (definition, numbers) = match robot.definition() {
            Definition::Opw(opw) => ("opw", opw_numbers(opw)),
            Definition::Mdh(mdh) => ("mdh", mdh_numbers(mdh)),
            Definition::Refined { mdh, nominal } => {
                let nominal = match &**nominal {
                    Definition::Opw(opw) => opw_numbers(opw),
                    Definition::Mdh(nominal) | Definition::Refined { mdh: nominal, .. } => {
                        mdh_numbers(nominal)
                    }
                };
                ("refined", [mdh_numbers(mdh), nominal].concat())
            }
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
            robot.own_rule().map(rule_state),
            robot.locked_joint(),
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
    let (name, definition, numbers, limits, base, tool, velocity, linkage, rule, locked) =
        state(arm);
    let is_coupled = linkage.is_some();
    let (rule, reference) = rule.unwrap_or_default();
    let others = [velocity, linkage].map(Option::unwrap_or_default).concat();
    let numbers = [numbers, limits, base, tool, others, reference].concat();
    // Python's own hash of floats holds 0.0 and -0.0 for one, as the comparison does.
    (name, definition, is_coupled, rule, locked, PyTuple::new(py, numbers)?)
        .into_pyobject(py)?
        .hash()
}

/// The arm of a state, for pickle.
pub(super) fn restored(py: Python<'_>, state: &State) -> PyResult<Arm> {
    let (name, definition, numbers, limits, base, tool, velocity, linkage, rule, locked) = state;
    let (limit_rows, rest) = limits.as_chunks::<2>();
    let broken = || Fault::Model.error(py, "the pickled robot is damaged".to_owned());
    if !rest.is_empty() {
        return Err(broken());
    }
    let built = match definition.as_str() {
        "opw" => opw_of(numbers).ok_or_else(broken)?.map(Arm::from),
        "mdh" if numbers.len() == mdh_count(7) => {
            mdh_of::<7>(numbers).ok_or_else(broken)?.map(Arm::from)
        }
        "mdh" => mdh_of::<6>(numbers).ok_or_else(broken)?.map(Arm::from),
        "refined" => refined_of(numbers).ok_or_else(broken)?.map(Arm::from),
        _ => return Err(broken()),
    };
    let rule = rule.as_ref().map(|rule| rule_of(rule).ok_or_else(broken)).transpose()?;
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
        .changed(py, &Edit::MaxVelocity(velocity.as_deref()))?
        .changed(py, &Edit::Rule(rule))?
        .changed(py, &Edit::Lock(*locked))
}

fn rule_state(rule: ConfigurationRule) -> RuleState {
    let (name, numbers) = match rule {
        ConfigurationRule::SphericalWrist => ("spherical wrist", Vec::new()),
        ConfigurationRule::OffsetWrist => ("offset wrist", Vec::new()),
        ConfigurationRule::ArmAngle { reference } => ("arm angle", Vec::from(reference)),
    };
    (name.to_owned(), numbers)
}

fn rule_of((name, numbers): &RuleState) -> Option<ConfigurationRule> {
    match (name.as_str(), &numbers[..]) {
        ("spherical wrist", []) => Some(ConfigurationRule::SphericalWrist),
        ("offset wrist", []) => Some(ConfigurationRule::OffsetWrist),
        ("arm angle", &[x, y, z]) => Some(ConfigurationRule::ArmAngle { reference: [x, y, z] }),
        _ => None,
    }
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

fn refined_of(numbers: &[f64]) -> Option<Result<Robot<6>, Error>> {
    let (calibrated, nominal) = numbers.split_at_checked(mdh_count(6))?;
    let calibrated = mdh_of::<6>(calibrated)?;
    let is_opw = nominal.len() == OPW_NUMBERS;
    let nominal = if is_opw { opw_of(nominal)? } else { mdh_of::<6>(nominal)? };
    Some(calibrated.and_then(|robot| robot.with_nominal(&nominal?)))
}

fn mdh_of<const N: usize>(numbers: &[f64]) -> Option<Result<Robot<N>, Error>> {
    let (rows, poses) = numbers.split_at_checked(4 * N)?;
    let (base, flange) = poses.split_first_chunk::<16>()?;
    let flange = flange.try_into().ok()?;
    let rows = <[[f64; 4]; N]>::try_from(rows.as_chunks::<4>().0).ok()?;
    let rows = rows.map(|[alpha, a, d, theta]| DhRow::new(alpha, a, d, theta));
    let built = pose_from_rows(base)
        .and_then(|base| Ok(Mdh { base, rows, flange: pose_from_rows(flange)? }))
        .and_then(Robot::of_table);
    Some(built)
}
