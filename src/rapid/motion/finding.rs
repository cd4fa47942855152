//! What is wrong with a move of a routine.

use core::fmt;

use alloc::string::String;

use crate::error::{Error, RapidFault};
use crate::kinematics::{BreakReason, SingularityKind};
use crate::rapid::calc::problem::Problem;
use crate::rapid::data::reason::Reason;
use crate::rapid::data::settings::CirPathMode;
use crate::rapid::data::skipped::NotRead;
use crate::report::{Configuration, Explanation};

/// What is wrong with a move. `Display` gives the line and the words.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// Index of the move in the motion; for something that is not read, that of the next move.
    pub move_index: usize,
    /// Line of the instruction.
    pub line: usize,
    /// Column of the instruction.
    pub column: usize,
    /// The words of the move, such as `MoveL p10`.
    pub what: String,
    /// What is wrong.
    pub kind: FindingKind,
}

/// The kinds of findings. `Display` gives the words.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum FindingKind {
    /// The target is unknown, has no joint angles or others than it requests.
    Target(Problem),
    /// The speed is unknown: the joints' limits alone say how long the move takes.
    Speed {
        /// As it is written.
        text: String,
        /// Why it is unknown.
        reason: Reason,
    },
    /// The zone is unknown: the target is met.
    Zone {
        /// As it is written.
        text: String,
        /// Why it is unknown.
        reason: Reason,
    },
    /// The duration of `\T` is unknown: the speed counts.
    Time(Reason),
    /// A number of the speed or the zone that no move can have: it is left out.
    Number {
        /// Its name in RAPID.
        field: &'static str,
        /// Its value, in RAPID's unit.
        value: f64,
    },
    /// `CirPathMode` with a wrist mode, which is not followed: \PathFrame is taken.
    WristMode(CirPathMode),
    /// An instruction that may move the robot is not read.
    NotRead(NotRead),
    /// A routine of the module is called, whose moves are not followed.
    Call {
        /// Its name.
        name: String,
    },
    /// The path between the targets is none: a half turn of the tool, an arc through points of a
    /// line.
    Path(Error),
    /// The joints cannot follow the path.
    Break {
        /// How far along the path of the move, 0 to 1.
        part: f64,
        /// The cause.
        reason: BreakReason,
    },
    /// The path passes a singularity.
    Singularity {
        /// The singularity.
        kind: SingularityKind,
        /// How far along the path of the move, 0 to 1.
        part: f64,
        /// The least distance from it [rad; m of the shoulder]; 0 where it is crossed.
        distance: f64,
        /// The distance from which it counts [rad; m of the shoulder].
        bound: f64,
    },
    /// The move arrives with another configuration than its target has.
    Configuration {
        /// That of the joints.
        found: Configuration,
        /// That of the target.
        wanted: Configuration,
    },
    /// A joint is too fast at the programmed speed: the move is slowed down.
    JointSpeed {
        /// The joint, from 1.
        joint: usize,
        /// Its speed at the programmed one [rad/s].
        value: f64,
        /// Its limit [rad/s].
        bound: f64,
        /// The speed of the tool that the move has where this joint is at its limit, as a part of
        /// the programmed one [1].
        slowed: f64,
        /// The programmed speed of the tool [m/s].
        speed: f64,
    },
    /// The move takes longer than `\T` says.
    Duration {
        /// What it takes [s].
        value: f64,
        /// What `\T` says [s].
        bound: f64,
    },
}

impl FindingKind {
    /// Its name: "unknown", "not_read", "unreachable", "limit", "flip", "singularity",
    /// "configuration", "path", "setting", "joint_speed" or "duration".
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Target(problem) => match problem {
                Problem::OutsideLimits { .. } | Problem::OutsideLinkageLimits { .. } => "limit",
                Problem::NotSolved(Error::Unreachable(explanation)) => kept_out(explanation),
                Problem::NotSolved(Error::NoConfiguration(_)) | Problem::Nearest(_) => {
                    "configuration"
                }
                Problem::NotSolved(_) => "unreachable",
                _ => "unknown",
            },
            Self::Speed { .. } | Self::Zone { .. } | Self::Time(_) => "unknown",
            Self::Number { .. } | Self::WristMode(_) => "setting",
            Self::NotRead(_) | Self::Call { .. } => "not_read",
            Self::Path(_) => "path",
            Self::Break { reason: BreakReason::Unreachable(explanation), .. } => {
                kept_out(explanation)
            }
            Self::Break { reason: BreakReason::Jump { .. }, .. } => "flip",
            Self::Break { reason: BreakReason::Locked, .. } => "unreachable",
            Self::Break { .. } | Self::Singularity { .. } => "singularity",
            Self::Configuration { .. } => "configuration",
            Self::JointSpeed { .. } => "joint_speed",
            Self::Duration { .. } => "duration",
        }
    }

    /// The joint that it is about, from 1.
    #[must_use]
    pub fn joint(&self) -> Option<usize> {
        let explained = |explanation: &Explanation| match explanation {
            Explanation::OutsideLimits { joint, .. } => Some(*joint),
            _ => None,
        };
        match self {
            Self::Target(Problem::OutsideLimits { joint, .. })
            | Self::Break { reason: BreakReason::Jump { joint, .. }, .. }
            | Self::JointSpeed { joint, .. } => Some(*joint),
            Self::Target(Problem::NotSolved(Error::Unreachable(explanation)))
            | Self::Break { reason: BreakReason::Unreachable(explanation), .. } => {
                explained(explanation)
            }
            _ => None,
        }
    }

    /// What was found, and what it must not exceed or must be, in SI units: the speed of a joint,
    /// the step of a flip (0 is wanted), how far outside limits or reach (0 is wanted), the
    /// distance from a singularity, a duration.
    #[must_use]
    pub fn value_and_bound(&self) -> Option<[f64; 2]> {
        let explained = |explanation: &Explanation| match explanation {
            Explanation::OutsideLimits { excess, .. }
            | Explanation::OutsideLinkage { excess, .. } => Some([*excess, 0.0]),
            Explanation::OutOfReach(reach) => Some([reach.shortfall(), 0.0]),
            _ => None,
        };
        match self {
            Self::Target(
                Problem::OutsideLimits { excess, .. } | Problem::OutsideLinkageLimits { excess },
            ) => Some([*excess, 0.0]),
            Self::Target(Problem::NotSolved(Error::Unreachable(explanation)))
            | Self::Break { reason: BreakReason::Unreachable(explanation), .. } => {
                explained(explanation)
            }
            Self::Break { reason: BreakReason::Jump { by, .. }, .. } => Some([*by, 0.0]),
            Self::Singularity { distance, bound, .. } => Some([*distance, *bound]),
            Self::JointSpeed { value, bound, .. } | Self::Duration { value, bound } => {
                Some([*value, *bound])
            }
            _ => None,
        }
    }
}

/// The name of a reason why a pose has no solution.
fn kept_out(explanation: &Explanation) -> &'static str {
    match explanation {
        Explanation::OutsideLimits { .. } | Explanation::OutsideLinkage { .. } => "limit",
        _ => "unreachable",
    }
}

/// A part of the way in percent.
struct Percent(f64);

impl fmt::Display for Percent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:.0} % of the way", self.0 * 1e2)
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.line > 0 {
            write!(f, "line {}: ", self.line)?;
        }
        write!(f, "{}: {}", self.what, self.kind)
    }
}

impl fmt::Display for FindingKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Target(problem) => problem.fmt(f),
            Self::Speed { text, reason } => {
                write!(f, "speed {text}: {reason}; the limits of the joints alone count")
            }
            Self::Zone { text, reason } => {
                write!(f, "zone {text}: {reason}; the target is met")
            }
            Self::Time(reason) => write!(f, "\\T: {reason}; the speed counts"),
            Self::Number { field, value } => {
                write!(f, "{field} is {value}, it must be finite and ")?;
                let zone = field.contains("zone");
                f.write_str(if zone { "not negative" } else { "positive" })?;
                f.write_str("; it is left out")
            }
            Self::WristMode(mode) => {
                write!(f, "CirPathMode \\{} is not followed, \\PathFrame is taken", mode.name())
            }
            Self::NotRead(what) => what.fmt(f),
            Self::Call { name } => {
                write!(f, "{name} is a routine of the module, its moves are not followed")
            }
            Self::Path(Error::Rapid(RapidFault { kind, .. })) => kind.fmt(f),
            Self::Path(error) => error.fmt(f),
            Self::Break { part, reason } => {
                write!(f, "at {}, {reason}", Percent(*part))
            }
            Self::Singularity { kind, part, distance, .. } => {
                let (name, size) = match *kind {
                    SingularityKind::ELBOW => ("elbow", distance.to_degrees()),
                    SingularityKind::SHOULDER => ("shoulder", distance * 1e3),
                    _ => ("wrist", distance.to_degrees()),
                };
                let unit = if *kind == SingularityKind::SHOULDER { "mm" } else { "deg" };
                if *distance > 0.0 {
                    write!(f, "passes the {name} singularity at {size:.3} {unit}, ")?;
                } else {
                    write!(f, "crosses the {name} singularity, ")?;
                }
                write!(f, "at {}", Percent(*part))
            }
            Self::Configuration { found, wanted } => write!(
                f,
                "arrives with the configuration {found}, its target has {wanted}: correct its \
                 confdata, or program ConfL\\Off"
            ),
            Self::JointSpeed { joint, value, bound, slowed, speed } => {
                write!(
                    f,
                    "J{joint} must turn at {:.1} deg/s at the programmed speed, its limit is {:.1} \
                     deg/s: slowed down to {:.0} % of ",
                    value.to_degrees(),
                    bound.to_degrees(),
                    slowed * 1e2
                )?;
                if *speed > 0.0 { write!(f, "{:.0} mm/s", speed * 1e3) } else { f.write_str("it") }
            }
            Self::Duration { value, bound } => {
                write!(f, "takes {value:.3} s, \\T asks for {bound:.3} s")
            }
        }
    }
}
