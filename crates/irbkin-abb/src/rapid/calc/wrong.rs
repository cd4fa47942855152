//! Findings on targets and on the paths between them, in words.

use crate::Error;
use crate::prelude::*;
use crate::rapid::calc::confdata::Over;
use crate::rapid::calc::units::EXTERNAL_AXES;
use crate::rapid::data::finding::{Code, Finding};
use crate::rapid::data::records::NOT_THERE;
use crate::rapid::data::value::Value;
use irbkin::follow::BreakReason;
use irbkin::thresholds::CONFIGURATION_EDGE;
use irbkin::{Error as RobotError, Explanation, Robot, SingularityKind};
use irbkin_motion::Error as MotionError;
use irbkin_motion::internal::MotionFault;

pub(in crate::rapid) type OrFinding<T> = Result<T, Box<Finding>>;

/// RAPID's name of an error of [`calc_joint_t`](crate::rapid::calc_joint_t): `ERR_OUTSIDE_REACH` if
/// the arm is too short or too long, `ERR_ROBLIMIT` if solutions exist, but none inside the limits
/// with the requested configuration. `None` for errors that no controller reports.
#[must_use]
pub fn error_name(error: &Error) -> Option<&'static str> {
    match error {
        Error::Robot(RobotError::Unreachable(
            Explanation::OutOfReach(_) | Explanation::NoRoots { .. },
        )) => Some("ERR_OUTSIDE_REACH"),
        Error::Robot(RobotError::Unreachable(_) | RobotError::NoConfiguration(_)) => {
            Some("ERR_ROBLIMIT")
        }
        _ => None,
    }
}

/// An error with its name in RAPID, if it has one.
fn named(error: &Error) -> String {
    let name = error_name(error).map(|name| format!("{name}: ")).unwrap_or_default();
    format!("{name}{error}")
}

pub(in crate::rapid) fn not_solved(error: &Error) -> Finding {
    let code = match error {
        Error::Robot(RobotError::Unreachable(
            Explanation::OutOfReach(_) | Explanation::NoRoots { .. },
        )) => Code::OutOfReach,
        Error::Robot(RobotError::Unreachable(_)) => Code::OutsideLimits,
        Error::Robot(RobotError::NoConfiguration(_) | RobotError::InvalidJoints(_)) => {
            Code::WrongConfdata
        }
        _ => Code::InvalidFrame,
    };
    let finding = Finding::new(code, named(error));
    match error {
        Error::Robot(RobotError::Unreachable(explanation)) => finding.explained(explanation),
        _ => finding,
    }
}

/// A target whose configuration no solution has, where the joint angles nearest to it are taken.
pub(in crate::rapid) fn beside_taken(missed: &Error, over: &Over) -> Finding {
    let words = format!(
        "{}; the nearest to it is taken, with axis {} {:.2} deg over its quarter",
        named(missed),
        over.axis,
        over.by.to_degrees(),
    );
    Finding::new(Code::WrongConfdata, words)
}

/// A target whose configuration no solution has, nor its branch, where the nearest joint angles are
/// taken.
pub(in crate::rapid) fn nearest_taken(missed: &Error) -> Finding {
    let words = format!("{}; the nearest to the joints before is taken", named(missed));
    Finding::new(Code::WrongConfdata, words)
}

/// A target whose configuration more than one solution has.
pub(in crate::rapid) fn ambiguous(count: usize) -> Finding {
    let words =
        format!("{count} solutions have its confdata; the nearest to the joints before is taken");
    Finding::new(Code::AmbiguousConfdata, words)
}

/// A move that the instruction on a line displaces.
pub(in crate::rapid) fn displaced(line: usize) -> Finding {
    let words = format!("line {line} displaces it, which is not followed");
    Finding::new(Code::NotFollowed, words)
}

/// A target with the position of an external axis, from 0, that belongs to no unit that is known.
pub(in crate::rapid) fn unknown_axis(external: usize, position: f64) -> Finding {
    let name = EXTERNAL_AXES.get(external).copied().unwrap_or_default();
    let words = format!(
        "{name} is at {position}: the unit that it drives is not known, and it may carry the robot"
    );
    Finding::new(Code::UnknownUnit, words).caused_by(name.to_string())
}

/// A jointtarget with the angle [deg] of an axis, from 1, that does not exist.
pub(in crate::rapid) fn absent(axis: usize, degrees: f64) -> Finding {
    let written = if degrees.to_bits() == NOT_THERE.to_bits() {
        "9E9".to_string()
    } else {
        Value::Num(degrees).to_string()
    };
    Finding::new(Code::AbsentAxis, format!("axis {axis} is {written}: it is not there"))
}

/// Joint angles outside the limits: the joint that exceeds them most, or the linkage.
pub(in crate::rapid) fn outside<const N: usize>(robot: &Robot<N>, q: &[f64; N]) -> Option<Finding> {
    let limits = robot.limits();
    if limits.widened(CONFIGURATION_EDGE).contains(q) {
        return None;
    }
    let farthest =
        (0..N).max_by(|a, b| limits.excess(*a, q[*a]).total_cmp(&limits.excess(*b, q[*b])))?;
    let excess = limits.excess(farthest, q[farthest]);
    let is_joint = excess > 0.0;
    let (what, excess) = if is_joint {
        (format!("J{}", farthest + 1), excess)
    } else {
        ("the linkage (q3 - q2)".to_string(), limits.linkage_excess(q))
    };
    let words =
        format!("ERR_ROBLIMIT: {what} is outside its limits by {:.1} deg", excess.to_degrees());
    let finding = Finding::new(Code::OutsideLimits, words).with_value(excess, 0.0);
    Some(if is_joint { finding.of_joint(farthest + 1) } else { finding })
}

pub(in crate::rapid) fn no_path(error: &MotionError) -> Box<Finding> {
    let words = match error {
        MotionError::InvalidMotion(MotionFault::HalfTurn { angle, .. }) => format!(
            "the tool turns by {:.1} deg, there are two ways: program a target between",
            angle.to_degrees()
        ),
        error => format!("{error}"),
    };
    Finding::new(Code::NoPath, words).into()
}

/// A path that the joints cannot follow from a part of it on, 0 to 1.
pub(in crate::rapid) fn broken(part: f64, reason: BreakReason) -> Box<Finding> {
    let words = format!("at {:.0} % of the way, {reason}", part * 1e2);
    let finding = match reason {
        BreakReason::Jump { joint, by, .. } => {
            Finding::new(Code::Flip, words).of_joint(joint).with_value(by, 0.0)
        }
        BreakReason::Unreachable(explanation) => {
            Finding::new(Code::PathBlocked, words).explained(&explanation)
        }
        _ => Finding::new(Code::PathBlocked, words),
    };
    finding.into()
}

/// A path that passes a singularity at a distance [rad; m of the shoulder], 0 if it crosses it.
pub(in crate::rapid) fn passes(kind: SingularityKind, part: f64, distance: f64) -> Finding {
    let (code, name, size, unit) = match kind {
        SingularityKind::ELBOW => (Code::ElbowSingularity, "elbow", distance.to_degrees(), "deg"),
        SingularityKind::SHOULDER => (Code::ShoulderSingularity, "shoulder", distance * 1e3, "mm"),
        _ => (Code::WristSingularity, "wrist", distance.to_degrees(), "deg"),
    };
    let how = if distance > 0.0 {
        format!("passes the {name} singularity at {size:.3} {unit}")
    } else {
        format!("crosses the {name} singularity")
    };
    Finding::new(code, format!("{how}, at {:.0} % of the way", part * 1e2))
}
