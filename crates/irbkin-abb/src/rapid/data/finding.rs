//! Findings on moves: a code, a place and words.

use core::fmt;
use core::ops::Range;

use super::moves::Move;
use super::statement::Statement;
use super::unread::{Reason, Unresolved};
use super::value::DataType;
use crate::prelude::*;
use crate::rapid::text::place::excerpt;
use irbkin::Explanation;

macro_rules! codes {
    ($($(#[doc = $doc:literal])* $Code:ident $id:literal $name:literal;)*) => {
        /// The kind of a finding.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        #[non_exhaustive]
        pub enum Code {
            $($(#[doc = $doc])* $Code,)*
        }

        impl Code {
            /// Every code.
            pub const ALL: [Self; 45] = [$(Self::$Code),*];

            /// The code: a letter for its group and three digits.
            #[must_use]
            pub fn id(self) -> &'static str {
                match self {
                    $(Self::$Code => $id,)*
                }
            }

            /// Its name in words with dashes.
            #[must_use]
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$Code => $name,)*
                }
            }
        }
    };
}

codes! {
    /// The arm is too short or too long for a target.
    OutOfReach "R101" "out-of-reach";
    /// A target is outside the limits of the joints.
    OutsideLimits "R102" "outside-limits";
    /// A pose between two targets is out of reach or outside the limits.
    PathBlocked "R103" "path-blocked";
    /// A joint would have to jump between two targets.
    Flip "R104" "flip";
    /// The targets have no line or arc between them: a half turn of the tool, or an arc through
    /// points of a line.
    NoPath "R105" "no-path";
    /// A jointtarget has the angle of an axis that does not exist.
    AbsentAxis "R106" "absent-axis";
    /// The points of a circle hardly determine it, or it is too long.
    UncertainCircle "R107" "uncertain-circle";
    /// A move enters a world zone that stops the robot.
    WorldZone "R108" "world-zone";
    /// No solution has the confdata of a target.
    WrongConfdata "C201" "wrong-confdata";
    /// A line or an arc arrives with another configuration than its target has.
    OtherConfiguration "C202" "other-configuration";
    /// More than one joint vector has the confdata of a target.
    AmbiguousConfdata "C203" "ambiguous-confdata";
    /// A target is a few degrees over the edge of a quarter of its confdata.
    NearConfdata "C204" "near-confdata";
    /// The cfx of a YuMi's target has an old form, which controllers with the new one refuse.
    OldConfdata "C205" "old-confdata";
    /// A line or an arc passes the wrist singularity.
    WristSingularity "S301" "wrist-singularity";
    /// A line or an arc passes the elbow singularity.
    ElbowSingularity "S302" "elbow-singularity";
    /// A line or an arc passes the shoulder singularity.
    ShoulderSingularity "S303" "shoulder-singularity";
    /// A joint is too fast at the programmed speed, or for the duration of `\T`: the move is slowed
    /// down.
    JointTooFast "V401" "joint-too-fast";
    /// A zone is over half of the distance to a target next to it.
    ZoneTooLarge "Z501" "zone-too-large";
    /// A zone is followed by something at which the program waits or ends.
    CornerPath "Z502" "corner-path";
    /// A move touches something: the arm itself or an obstacle of a cell.
    Collision "K901" "collision";
    /// A target is not declared.
    UnknownTarget "N601" "unknown-target";
    /// A tool is not declared.
    UnknownTool "N602" "unknown-tool";
    /// A work object is not declared.
    UnknownWorkObject "N603" "unknown-work-object";
    /// A speed or a duration is not declared: the limits of the joints alone count, or the speed.
    UnknownSpeed "N604" "unknown-speed";
    /// A zone is not declared: the target is met.
    UnknownZone "N605" "unknown-zone";
    /// A procedure or a function that nothing declares and RAPID does not have is called.
    UnknownRoutine "N606" "unknown-routine";
    /// A call has other arguments than what it calls.
    WrongArguments "N607" "wrong-arguments";
    /// A statement names data or a signal that nothing declares.
    UnknownName "N608" "unknown-name";
    /// Two modules declare one global name.
    NameTwice "N609" "name-twice";
    /// A function returns no value.
    NoReturn "N610" "no-return";
    /// A task waits for others that never come.
    SyncDeadlock "M101" "sync-deadlock";
    /// A target, a tool or a work object is not a frame, or tool and work object do not go
    /// together.
    InvalidFrame "D701" "invalid-frame";
    /// A speed or a zone has a number that no move can have: it is left out.
    InvalidNumber "D702" "invalid-number";
    /// An external axis is in one of two targets that follow one another.
    ExternalAxes "D703" "external-axes";
    /// The index of an array is none of its elements.
    NoSuchElement "D704" "no-such-element";
    /// A value of another type is assigned or passed.
    WrongType "D705" "wrong-type";
    /// A constant or the counter of a FOR is assigned.
    ReadOnly "D706" "read-only";
    /// A value is not in the text.
    UnknownValue "U801" "unknown-value";
    /// An instruction that moves the robot is not followed.
    NotFollowed "U802" "not-followed";
    /// An axis is on the edge of its quarter.
    ConfdataEdge "U803" "confdata-edge";
    /// A mechanical unit that carries the robot or moves a work object is not known.
    UnknownUnit "U804" "unknown-unit";
    /// Names that nothing declares are taken for signals, which are not known.
    UnknownSignal "U805" "unknown-signal";
    /// Statements that are never executed.
    NeverRun "U806" "never-run";
    /// Nothing in a program names a target, a tool, a work object or a routine of it.
    Unused "U807" "unused";
    /// Routines that nothing declares are called, and modules are missing.
    MissingRoutines "U808" "missing-routines";
}

/// How much a finding matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// A controller stops, refuses the program or moves elsewhere.
    Error,
    /// The program runs, but not as programmed, or close to a place where axes must be fast.
    Warning,
    /// Nothing is wrong, but something is not checked or undecided.
    Note,
}

impl Severity {
    /// Its name, in lower case.
    #[must_use]
    pub fn id(self) -> &'static str {
        match self {
            Self::Error => "error",
            Self::Warning => "warning",
            Self::Note => "note",
        }
    }
}

impl Code {
    /// The severity, which the letter of its group determines, with exceptions for what a controller
    /// may take.
    #[must_use]
    pub fn severity(self) -> Severity {
        match (self, self.id().as_bytes()[0]) {
            (Self::NearConfdata, _) | (_, b'U') => Severity::Note,
            (Self::AmbiguousConfdata | Self::ExternalAxes, _) | (_, b'S' | b'V' | b'Z') => {
                Severity::Warning
            }
            _ => Severity::Error,
        }
    }

    /// Whether it is shown unless codes are selected: not where something is unknown or undecided, of
    /// which the number of moves that are not checked tells, nor of zones that controllers reduce by
    /// themselves: of 1,293 in public programs none did harm.
    #[must_use]
    pub fn is_default(self) -> bool {
        !matches!(
            self,
            Self::UnknownValue
                | Self::NotFollowed
                | Self::ZoneTooLarge
                | Self::ConfdataEdge
                | Self::Unused
        )
    }

    /// The type of the data that an unknown name of this code should have.
    pub(crate) fn data_type(self) -> Option<DataType> {
        match self {
            Self::UnknownTool => Some(DataType::ToolData),
            Self::UnknownWorkObject => Some(DataType::WobjData),
            Self::UnknownSpeed => Some(DataType::SpeedData),
            Self::UnknownZone => Some(DataType::ZoneData),
            _ => None,
        }
    }
}

/// A module among those that are checked, from 0, a line and a column, from 1.
pub(crate) type Place = (usize, usize, usize);

/// A part of a text, replaced.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edit {
    /// The module among those that are checked, from 0.
    pub module: usize,
    /// Bytes of its text.
    pub span: Range<usize>,
    /// The text that takes their place.
    pub text: String,
}

/// Something wrong with a move of a module; `irbkin rule` has the codes. `Display` gives the
/// line and the message.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// The kind.
    pub code: Code,
    /// The module among those that are checked, from 0.
    pub module: usize,
    /// Line of the instruction, from 1; 0 if it was not read from a text.
    pub line: usize,
    /// Column of the instruction, from 1, in characters.
    pub column: usize,
    /// The routine that contains it.
    pub routine: Option<String>,
    /// Index of the move in the motion, or of the row in the table; for an instruction that is not
    /// read, of the next move.
    pub move_index: usize,
    /// The beginning of the instruction that it is about, or the kind and the name of data or of a
    /// routine; empty if it was not read from a text.
    pub subject: String,
    /// The subject and what is wrong with it: the value, the bound and what to do.
    pub message: String,
    /// The joint that it is about, from 1.
    pub joint: Option<usize>,
    /// The value that was found, in SI units: the speed of a joint, its step in a flip, how far
    /// outside limits or reach, the distance from a singularity, a duration.
    pub value: Option<f64>,
    /// The bound that the value must not exceed or, of a singularity, must not be below.
    pub bound: Option<f64>,
    /// The name that nothing declares.
    pub unknown: Option<String>,
    /// What it rests on that the program does not determine, as its message says: it is a note.
    pub assumed: Option<String>,
    /// Findings of one code and one cause are one; empty if it stands alone.
    pub(crate) cause: String,
    /// The pass of a loop, or which of the values that data may have, in words; empty of the only
    /// one.
    pub(crate) case: String,
    /// The module and the index of the instruction that the case is of.
    pub(crate) instruction: (usize, usize),
    /// The calls that lead to it with arguments, each the first of a chain, if the move depends on
    /// these.
    pub(crate) calls: Vec<Place>,
    /// Where else its cause shows, and the calls that lead to it: modules, lines and columns.
    pub related: Vec<Place>,
    /// The corrections, in the order of the text; empty where nothing corrects it.
    pub edits: Vec<Edit>,
}

impl Finding {
    /// A finding that is not placed yet, with the words for what is wrong.
    pub(crate) fn new(code: Code, words: impl Into<String>) -> Self {
        Self {
            code,
            module: 0,
            line: 0,
            column: 0,
            routine: None,
            move_index: 0,
            subject: String::new(),
            message: words.into(),
            joint: None,
            value: None,
            bound: None,
            unknown: None,
            assumed: None,
            cause: String::new(),
            case: String::new(),
            instruction: (0, 0),
            calls: Vec::new(),
            related: Vec::new(),
            edits: Vec::new(),
        }
    }

    /// An unknown value, with a code for a name that nothing declares.
    pub(crate) fn unknown(code: Code, reason: &Reason, words: String) -> Self {
        match reason {
            Reason::Reference { name, why: Unresolved::NotDeclared } => {
                Self { unknown: Some(name.clone()), ..Self::new(code, words) }
                    .caused_by(name.to_lowercase())
            }
            Reason::NoSuchElement { .. } => Self::new(Code::NoSuchElement, words),
            Reason::Robot { code: code @ (Code::OutOfReach | Code::OutsideLimits), .. } => {
                Self::new(*code, words)
            }
            _ => Self::new(Code::UnknownValue, words),
        }
    }

    /// How much it matters.
    #[must_use]
    pub fn severity(&self) -> Severity {
        match (&self.assumed, self.code) {
            (None, code) => code.severity(),
            // Files that are given together may be alternatives.
            (Some(_), Code::NameTwice | Code::SyncDeadlock) => Severity::Warning,
            _ => Severity::Note,
        }
    }

    pub(crate) fn place(&self) -> Place {
        (self.module, self.line, self.column)
    }

    pub(crate) fn caused_by(self, cause: String) -> Self {
        Self { cause, ..self }
    }

    /// With the joint that it is about, from 1.
    pub(crate) fn of_joint(self, joint: usize) -> Self {
        Self { joint: Some(joint), ..self }
    }

    /// With the value that was found and its bound, in SI units.
    pub(crate) fn with_value(self, value: f64, bound: f64) -> Self {
        Self { value: Some(value), bound: Some(bound), ..self }
    }

    /// With the joint and the excess of a pose without solutions.
    pub(crate) fn explained(self, explanation: &Explanation) -> Self {
        match explanation {
            Explanation::OutsideLimits { joint, excess, .. } => {
                self.of_joint(*joint).with_value(*excess, 0.0)
            }
            Explanation::OutsideLinkage { excess, .. } => self.with_value(*excess, 0.0),
            Explanation::OutOfReach(reach) => self.with_value(reach.shortfall(), 0.0),
            _ => self,
        }
    }

    pub(crate) fn in_module(self, module: usize) -> Self {
        Self { module, ..self }
    }

    pub(crate) fn at(self, step: &Move, move_index: usize) -> Self {
        let what = format!("{} {}", step.instruction, step.target.text);
        let routine = step.routine.as_deref().map(Into::into);
        self.placed((step.line, step.column), routine, move_index, &what)
    }

    /// At a statement before a move.
    pub(crate) fn at_statement(self, statement: &Statement, move_index: usize) -> Self {
        let Statement { line, column, routine, text, .. } = statement;
        let what = text.trim_end_matches(';');
        self.placed((*line, *column), routine.as_deref().map(String::from), move_index, what)
    }

    /// At a place of the text, with the instruction before the words.
    pub(crate) fn placed(
        self,
        (line, column): (usize, usize),
        routine: Option<String>,
        move_index: usize,
        what: &str,
    ) -> Self {
        let subject = excerpt(what);
        let message = format!("{subject}: {}", self.message);
        Self { line, column, routine, move_index, subject, message, ..self }
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.line > 0 {
            write!(f, "line {}: ", self.line)?;
        }
        f.write_str(&self.message)
    }
}
