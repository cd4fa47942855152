//! Confdata of targets that are met: ambiguous, on the edge of a quarter, or others than the nearest.

use alloc::format;
use alloc::string::ToString;
#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use crate::rapid::calc::confdata::AXES;
use crate::rapid::data::finding::{Code, Finding};
use crate::rapid::motion::goal::{Goal, Place};
use irbkin::report::ConfigurationRule;
use irbkin::thresholds::CONFIGURATION_EDGE;
use irbkin::{Error as RobotError, Robot};

/// A finding on confdata that no solution has, with the configuration of the nearest joints.
pub(super) fn with_nearest<const N: usize>(
    flange: &Robot<N>,
    finding: Finding,
    goal: &Goal<'_, N>,
    q: &[f64; N],
) -> Finding {
    let (Code::WrongConfdata, Some(Place::Tool(pose, wanted)), Ok(nearest)) =
        (finding.code, goal.place, flange.configuration(q))
    else {
        return finding;
    };
    let words = match flange.ik_configured(&goal.frames.flange(&pose), wanted) {
        Err(error @ RobotError::InvalidJoints(_)) => error.to_string(),
        _ => format!("no solution has its confdata {}", wanted.configuration),
    };
    let words = format!("{words}; that of the nearest is {nearest}");
    Finding::new(finding.code, words).at(goal.step, finding.move_index)
}

/// A target that is so near the wrist singularity that its confdata names many joints, of which a
/// joint move brings `q`. A line or an arc arrives with the joints that it comes with.
pub(super) fn in_wrist_singularity<const N: usize>(
    robot: &Robot<N>,
    q: &[f64; N],
) -> Option<Finding> {
    let wrist = robot.singular_distances(q).map_or(1.0, |at| at.wrist);
    let is_counted = robot.configuration_rule() == Ok(ConfigurationRule::SphericalWrist);
    (is_counted && wrist < CONFIGURATION_EDGE).then(|| {
        let words = format!(
            "the target is {:.4} deg from the wrist singularity: axes 4 and 6 coincide, many joint \
             angles have its confdata; use MoveAbsJ",
            wrist.to_degrees()
        );
        Finding::new(Code::AmbiguousConfdata, words)
    })
}

/// The axes of joints that are on the edge of a quarter, in sentences.
pub(super) fn on_edges<const N: usize>(
    robot: &Robot<N>,
    q: &[f64; N],
) -> Result<impl Iterator<Item = Finding>, RobotError> {
    let (joints, zero) = robot.counted_joints()?;
    Ok(AXES.into_iter().zip(joints).filter_map(move |(axis, joint)| {
        let degrees = q[joint].to_degrees();
        let from_zero = degrees - zero.to_degrees();
        let edge = (from_zero / 90.0).round();
        let is_near = (from_zero - 90.0 * edge).abs() < CONFIGURATION_EDGE.to_degrees();
        is_near.then(|| {
            let words = format!(
                "axis {} is {:.4} deg, on the edge of a quarter: cf{axis} {} and {edge:.0} both \
                 name it",
                axis,
                degrees + 0.0,
                edge - 1.0,
            );
            Finding::new(Code::ConfdataEdge, words)
        })
    }))
}
