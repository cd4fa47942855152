//! `repr(robot)`: code where it is an arm of the catalog as it stands there, else what it differs
//! in, in angle brackets.

use super::arm::{Arm, on};
use crate::catalog;
use crate::error::Error;
use crate::kinematics::{JointLimits, Pose, Robot, pose_to_wxyz};

/// The text of an arm.
pub(super) fn repr(arm: &Arm) -> String {
    on!(arm, robot => of_robot(robot))
}

fn of_robot<const N: usize>(robot: &Robot<N>) -> String {
    if let Some((joint, angle)) = robot.locked_joint() {
        return format!("{}.locked({{{joint}: {angle:?}}})", of_robot(&robot.clone().unlocked()));
    }
    let name = robot.name();
    if let Some((plain, twin)) = of_catalog(robot) {
        if plain == *robot {
            return format!("Robot(\"{name}\"){twin}");
        }
        if with_frames_and_limits_of(&plain, robot).is_ok_and(|same| same == *robot) {
            return format!("<Robot {name:?}{twin}: {}>", differences(robot, &plain).join("; "));
        }
    }
    let mut parts = vec![format!("{N} joints, {}", robot.structure())];
    if let Ok(plain) = without_frames_and_limits(robot) {
        parts.extend(differences(robot, &plain));
    }
    let name = if name.is_empty() { String::new() } else { format!(" {name:?}") };
    format!("<Robot{name}: {}>", parts.join("; "))
}

/// The catalog's arm of that name, coupled or not as `robot` is, and how that is written.
fn of_catalog<const N: usize>(robot: &Robot<N>) -> Option<(Robot<N>, &'static str)> {
    let arm = catalog::find(robot.name()).ok().filter(|arm| arm.name == robot.name())?;
    let plain = Robot::<N>::from_catalog(arm).ok()?;
    match (plain.is_coupled(), robot.is_coupled()) {
        (true, false) => Some((plain.uncoupled(), ".uncoupled()")),
        (false, true) => Some((plain.coupled().ok()?, ".coupled()")),
        _ => Some((plain, "")),
    }
}

fn without_frames_and_limits<const N: usize>(robot: &Robot<N>) -> Result<Robot<N>, Error> {
    let unlimited = JointLimits::new([[f64::NEG_INFINITY, f64::INFINITY]; N])?;
    let identity = Pose::identity();
    let plain = robot.clone().with_limits(unlimited).with_base(&identity)?.with_tool(&identity)?;
    if robot.is_coupled() { plain.with_linkage_limits(None) } else { Ok(plain) }
}

fn with_frames_and_limits_of<const N: usize>(
    plain: &Robot<N>,
    robot: &Robot<N>,
) -> Result<Robot<N>, Error> {
    let framed = plain.clone().with_base(robot.base())?.with_tool(robot.tool())?;
    let limited = framed.with_limits(*robot.limits());
    if robot.is_coupled() {
        limited.with_linkage_limits(robot.limits().linkage())
    } else {
        Ok(limited)
    }
}

/// What a robot has that another one does not have, in words.
fn differences<const N: usize>(robot: &Robot<N>, plain: &Robot<N>) -> Vec<String> {
    let (limits, linkage) = (robot.limits().to_array(), robot.limits().linkage());
    let mut parts = Vec::new();
    if robot.tool() != plain.tool() {
        parts.push(format!("tool at {}", place(robot.tool())));
    }
    if robot.base() != plain.base() {
        parts.push(format!("base at {}", place(robot.base())));
    }
    if limits != plain.limits().to_array() {
        parts.push(format!("limits {} deg", limits.map(range).join(", ")));
    }
    if linkage != plain.limits().linkage() {
        let words =
            linkage.map_or_else(|| "none".to_owned(), |limit| format!("{} deg", range(limit)));
        parts.push(format!("linkage limits {words}"));
    }
    parts
}

/// Position [m] and quaternion of a frame.
fn place(pose: &Pose) -> String {
    let (xyz, wxyz) = pose_to_wxyz(pose);
    let position = xyz.map(|length| decimals(length, 9)).join(", ");
    let rotation = wxyz.map(|part| decimals(part, 9)).join(", ");
    format!("[{position}] m, wxyz [{rotation}]")
}

/// A limit [rad], in degrees.
fn range([lower, upper]: [f64; 2]) -> String {
    format!("{}..{}", decimals(lower.to_degrees(), 6), decimals(upper.to_degrees(), 6))
}

/// A number with at most so many decimals.
fn decimals(number: f64, most: usize) -> String {
    let text = format!("{number:.most$}");
    let short =
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if short == "-0" { "0".to_owned() } else { short.to_owned() }
}
