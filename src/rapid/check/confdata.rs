//! Confdata of targets that are met: ambiguous, on the edge of a quarter, or others than the nearest.

use alloc::format;
use alloc::string::ToString;
#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use crate::error::Error;
use crate::kinematics::thresholds::CONFIGURATION_EDGE;
use crate::kinematics::{Pose, Robot};
use crate::rapid::calc::confdata::AXES;
use crate::rapid::data::finding::{Code, Finding};
use crate::rapid::motion::goal::{Goal, Place};
use crate::report::{Configuration, ConfigurationRule};

/// A finding on confdata that no solution has, with the configuration of the nearest joints.
pub(super) fn with_nearest(
    flange: &Robot<6>,
    finding: Finding,
    goal: &Goal<'_>,
    q: &[f64; 6],
) -> Finding {
    let (Code::WrongConfdata, Some(Place::Tool(pose, wanted)), Ok(nearest)) =
        (finding.code, goal.place, flange.configuration(q))
    else {
        return finding;
    };
    let words = match flange.ik_configured(&goal.frames.flange(&pose), wanted) {
        Err(error @ Error::InvalidJoints(_)) => error.to_string(),
        _ => format!("no solution has its confdata {wanted}"),
    };
    let words = format!("{words}; that of the nearest is {nearest}");
    Finding::new(finding.code, words).at(goal.step, finding.move_index)
}

/// An ambiguous target, to which a joint move brings the joints `q`. A line or an arc arrives with
/// the joints that it comes with.
pub(super) fn ambiguous(
    robot: &Robot<6>,
    flange: &Pose,
    confdata: Configuration,
    q: &[f64; 6],
) -> Option<Finding> {
    let words = if robot.configuration_rule().ok()? == ConfigurationRule::SphericalWrist {
        let wrist = robot.singular_distances(q).map_or(1.0, |at| at.wrist);
        (wrist < CONFIGURATION_EDGE).then(|| {
            format!(
                "the target is {:.4} deg from the wrist singularity: axes 4 and 6 coincide, many \
                 joint angles have its confdata; use MoveAbsJ",
                wrist.to_degrees()
            )
        })
    } else {
        let named = robot.ik_configured_all(flange, confdata).map_or(0, |all| all.len());
        (named > 1).then(|| {
            format!("{named} joint vectors have the confdata {confdata} there; use MoveAbsJ")
        })
    };
    words.map(|words| Finding::new(Code::AmbiguousConfdata, words))
}

/// The axes of joints that are on the edge of a quarter, in sentences.
pub(super) fn on_edges(q: &[f64; 6]) -> impl Iterator<Item = Finding> {
    AXES.into_iter().filter_map(|(axis, name)| {
        let degrees = q[axis].to_degrees();
        let edge = (degrees / 90.0).round();
        let is_near = (degrees - 90.0 * edge).abs() < CONFIGURATION_EDGE.to_degrees();
        is_near.then(|| {
            let words = format!(
                "axis {} is {:.4} deg, on the edge of a quarter: {name} {} and {edge:.0} both \
                 name it",
                axis + 1,
                degrees + 0.0,
                edge - 1.0,
            );
            Finding::new(Code::ConfdataEdge, words)
        })
    })
}
