//! The codes of what a check finds.

use crate::error::Error;
use crate::kinematics::{BreakReason, SingularityKind};
use crate::rapid::calc::problem::Problem;
use crate::rapid::data::data_type::DataType;
use crate::rapid::data::reason::{Reason, Unresolved};
use crate::rapid::motion::finding::FindingKind;
use crate::report::Explanation;

/// What a check finds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Code {
    /// The arm is too short or too long for a target.
    OutOfReach,
    /// A target is outside the limits of the joints.
    OutsideLimits,
    /// A pose between two targets is out of reach or outside the limits.
    PathBlocked,
    /// A joint would have to jump between two targets.
    Flip,
    /// There is no line or arc between the targets.
    NoPath,
    /// A jointtarget has the angle of an axis that does not exist.
    AbsentAxis,
    /// No solution has the confdata of a target.
    WrongConfdata,
    /// A line or an arc arrives with another configuration than its target has.
    OtherConfiguration,
    /// Many joint vectors have the confdata of a singular target.
    AmbiguousConfdata,
    /// A line or an arc passes the wrist singularity.
    WristSingularity,
    /// A line or an arc passes the elbow singularity.
    ElbowSingularity,
    /// A line or an arc passes the shoulder singularity.
    ShoulderSingularity,
    /// A joint is too fast at the programmed speed.
    JointTooFast,
    /// A zone is over half of the distance to a target next to it.
    ZoneTooLarge,
    /// A target is not declared.
    UnknownTarget,
    /// A tool is not declared.
    UnknownTool,
    /// A work object is not declared.
    UnknownWorkObject,
    /// A speed or a duration is not declared.
    UnknownSpeed,
    /// A zone is not declared.
    UnknownZone,
    /// A target, a tool or a work object is no frame, or tool and work object do not go together.
    InvalidFrame,
    /// A speed or a zone has a number that no move can have.
    InvalidNumber,
    /// A value is not in the text.
    UnknownValue,
    /// An instruction that moves the robot is not followed.
    NotFollowed,
    /// An axis is on the edge of its quarter.
    ConfdataEdge,
}

impl Code {
    /// Every code.
    pub const ALL: [Self; 24] = [
        Self::OutOfReach,
        Self::OutsideLimits,
        Self::PathBlocked,
        Self::Flip,
        Self::NoPath,
        Self::AbsentAxis,
        Self::WrongConfdata,
        Self::OtherConfiguration,
        Self::AmbiguousConfdata,
        Self::WristSingularity,
        Self::ElbowSingularity,
        Self::ShoulderSingularity,
        Self::JointTooFast,
        Self::ZoneTooLarge,
        Self::UnknownTarget,
        Self::UnknownTool,
        Self::UnknownWorkObject,
        Self::UnknownSpeed,
        Self::UnknownZone,
        Self::InvalidFrame,
        Self::InvalidNumber,
        Self::UnknownValue,
        Self::NotFollowed,
        Self::ConfdataEdge,
    ];

    /// The code: a letter for its group and three digits.
    #[must_use]
    pub fn id(self) -> &'static str {
        self.words().0
    }

    /// Its name in words with dashes.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.words().1
    }

    /// Whether it is shown unless codes are selected: not where nothing is wrong, but something is
    /// unknown or undecided (group U).
    #[must_use]
    pub fn is_default(self) -> bool {
        !matches!(self, Self::UnknownValue | Self::NotFollowed | Self::ConfdataEdge)
    }

    /// The type of the data that an unknown name of this code should have.
    #[must_use]
    pub(crate) fn data_type(self) -> Option<DataType> {
        match self {
            Self::UnknownTool => Some(DataType::ToolData),
            Self::UnknownWorkObject => Some(DataType::WobjData),
            Self::UnknownSpeed => Some(DataType::SpeedData),
            Self::UnknownZone => Some(DataType::ZoneData),
            _ => None,
        }
    }

    fn words(self) -> (&'static str, &'static str) {
        match self {
            Self::OutOfReach => ("R101", "out-of-reach"),
            Self::OutsideLimits => ("R102", "outside-limits"),
            Self::PathBlocked => ("R103", "path-blocked"),
            Self::Flip => ("R104", "flip"),
            Self::NoPath => ("R105", "no-path"),
            Self::AbsentAxis => ("R106", "absent-axis"),
            Self::WrongConfdata => ("C201", "wrong-confdata"),
            Self::OtherConfiguration => ("C202", "other-configuration"),
            Self::AmbiguousConfdata => ("C203", "ambiguous-confdata"),
            Self::WristSingularity => ("S301", "wrist-singularity"),
            Self::ElbowSingularity => ("S302", "elbow-singularity"),
            Self::ShoulderSingularity => ("S303", "shoulder-singularity"),
            Self::JointTooFast => ("V401", "joint-too-fast"),
            Self::ZoneTooLarge => ("Z501", "zone-too-large"),
            Self::UnknownTarget => ("N601", "unknown-target"),
            Self::UnknownTool => ("N602", "unknown-tool"),
            Self::UnknownWorkObject => ("N603", "unknown-work-object"),
            Self::UnknownSpeed => ("N604", "unknown-speed"),
            Self::UnknownZone => ("N605", "unknown-zone"),
            Self::InvalidFrame => ("D701", "invalid-frame"),
            Self::InvalidNumber => ("D702", "invalid-number"),
            Self::UnknownValue => ("U801", "unknown-value"),
            Self::NotFollowed => ("U802", "not-followed"),
            Self::ConfdataEdge => ("U803", "confdata-edge"),
        }
    }

    /// The code of a finding of a motion.
    pub(super) fn of(kind: &FindingKind) -> Self {
        match kind {
            FindingKind::Target(problem) => of_target(problem),
            FindingKind::Speed { reason, .. } | FindingKind::Time(reason) => {
                undeclared(reason, Self::UnknownSpeed)
            }
            FindingKind::Zone { reason, .. } => undeclared(reason, Self::UnknownZone),
            FindingKind::Number { .. } => Self::InvalidNumber,
            FindingKind::WristMode(_) | FindingKind::NotRead(_) | FindingKind::Call { .. } => {
                Self::NotFollowed
            }
            FindingKind::Path(_) => Self::NoPath,
            FindingKind::Break { reason: BreakReason::Jump { .. }, .. } => Self::Flip,
            FindingKind::Break { .. } => Self::PathBlocked,
            FindingKind::Singularity { kind, .. } => match *kind {
                SingularityKind::ELBOW => Self::ElbowSingularity,
                SingularityKind::SHOULDER => Self::ShoulderSingularity,
                _ => Self::WristSingularity,
            },
            FindingKind::Configuration { .. } => Self::OtherConfiguration,
            FindingKind::JointSpeed { .. } | FindingKind::Duration { .. } => Self::JointTooFast,
        }
    }
}

fn of_target(problem: &Problem) -> Code {
    match problem {
        Problem::Target(reason) => undeclared(reason, Code::UnknownTarget),
        Problem::Tool { reason, .. } => undeclared(reason, Code::UnknownTool),
        Problem::WorkObject { reason, .. } => undeclared(reason, Code::UnknownWorkObject),
        Problem::Displaced { .. } => Code::NotFollowed,
        Problem::AbsentAxis { .. } => Code::AbsentAxis,
        Problem::NotSolved(Error::Unreachable(
            Explanation::OutOfReach(_) | Explanation::NoRoots { .. },
        )) => Code::OutOfReach,
        Problem::OutsideLimits { .. }
        | Problem::OutsideLinkageLimits { .. }
        | Problem::NotSolved(Error::Unreachable(_)) => Code::OutsideLimits,
        Problem::NotSolved(Error::NoConfiguration(_) | Error::InvalidJoints(_))
        | Problem::Nearest(_) => Code::WrongConfdata,
        Problem::NotSolved(_) => Code::InvalidFrame,
    }
}

/// A name that nothing declares, or a value that is not in the text.
fn undeclared(reason: &Reason, code: Code) -> Code {
    match reason {
        Reason::Reference { why: Unresolved::NotDeclared, .. } => code,
        _ => Code::UnknownValue,
    }
}
