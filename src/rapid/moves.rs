//! Move instructions.

use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::assigned::without_line;
use super::expression::{Expression, ExpressionReader};
use super::tokens::Tokens;
use super::values::{JointTarget, RobTarget, ToolData, WobjData};
use crate::error::{RapidFault, RapidFaultKind};

/// How the robot gets to the target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MoveKind {
    /// `MoveJ`: joints, to a pose.
    MoveJ,
    /// `MoveL`: a straight line.
    MoveL,
    /// `MoveC`: a circle through a point.
    MoveC,
    /// `MoveAbsJ`: joints, to joint angles.
    MoveAbsJ,
}

impl MoveKind {
    /// Every kind.
    pub const ALL: [Self; 4] = [Self::MoveJ, Self::MoveL, Self::MoveC, Self::MoveAbsJ];

    /// The instruction's name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::MoveJ => "MoveJ",
            Self::MoveL => "MoveL",
            Self::MoveC => "MoveC",
            Self::MoveAbsJ => "MoveAbsJ",
        }
    }

    /// The kind of an instruction in any case.
    pub(super) fn named(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name().eq_ignore_ascii_case(word))
    }

    /// How many arguments it must have.
    fn arguments(self) -> usize {
        if self == Self::MoveC { 5 } else { 4 }
    }
}

/// An argument as it is written, without its name, and what it is by the declarations.
#[derive(Clone, Debug, PartialEq)]
pub struct Argument<T> {
    /// Source text.
    pub text: String,
    /// The value, or in words why it is not known.
    pub value: Result<T, String>,
}

/// Where a move goes.
#[derive(Clone, Debug, PartialEq)]
pub enum Target {
    /// A pose.
    RobTarget(RobTarget),
    /// Joint angles, for `MoveAbsJ`.
    JointTarget(JointTarget),
}

/// An optional argument other than `\WObj`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MoveOption {
    /// How many of the required arguments stand before it.
    pub after: usize,
    /// Name, as it is written.
    pub name: String,
    /// Source text of its value; none of a switch. It begins with `?` where a routine passes its own optional argument on.
    pub text: Option<String>,
}

/// A move instruction.
///
/// Values are those of the declarations; data that the module assigns have none here.
#[derive(Clone, Debug, PartialEq)]
pub struct Move {
    /// How it moves.
    pub kind: MoveKind,
    /// The routine that it stands in; none outside routines.
    pub routine: Option<String>,
    /// Line, from 1; 0 where it stands in no text.
    pub line: usize,
    /// Column, from 1, in characters; 0 where it stands in no text.
    pub column: usize,
    /// The point on the circle of a `MoveC`.
    pub via: Option<Argument<RobTarget>>,
    /// Where it goes.
    pub target: Argument<Target>,
    /// Source text of the speed.
    pub speed: String,
    /// Source text of the zone.
    pub zone: String,
    /// The tool.
    pub tool: Argument<ToolData>,
    /// The work object of `\WObj:=`; `wobj0` is meant without one.
    pub wobj: Option<Argument<WobjData>>,
    /// The other optional arguments, in order.
    pub options: Vec<MoveOption>,
    /// Line of the `PDispOn` or `PDispSet` that stands before it in its routine and that no `PDispOff` between them ends: the robot goes
    /// elsewhere than `via` and `target` say. Joint angles are not displaced.
    pub displaced: Option<usize>,
}

impl Move {
    /// Makes it one that stands in no text.
    pub(super) fn clear_lines(&mut self) {
        (self.line, self.column, self.displaced) = (0, 0, self.displaced.map(|_| 0));
        let reasons = [
            self.via.as_mut().and_then(|via| via.value.as_mut().err()),
            self.target.value.as_mut().err(),
            self.tool.value.as_mut().err(),
            self.wobj.as_mut().and_then(|wobj| wobj.value.as_mut().err()),
        ];
        reasons.into_iter().flatten().for_each(without_line);
    }
}

/// A move before its names are looked up.
pub(super) struct WrittenMove<'a> {
    pub(super) kind: MoveKind,
    /// Index of the routine, from 1; 0 for the module.
    pub(super) routine: usize,
    /// The innermost loop around it.
    pub(super) inside_loop: Option<usize>,
    pub(super) line: usize,
    pub(super) column: usize,
    /// Line of the instruction that displaces it.
    pub(super) displaced: Option<usize>,
    pub(super) required: Vec<Expression<'a>>,
    pub(super) wobj: Option<Expression<'a>>,
    pub(super) options: Vec<MoveOption>,
}

/// Reads the arguments of a move up to its semicolon; the instruction's name was taken at byte `start`. None for one that is not finished.
pub(super) fn read_move<'a>(
    tokens: &mut Tokens<'a>,
    kind: MoveKind,
    start: usize,
) -> Result<Option<WrittenMove<'a>>, RapidFault> {
    let (line, column) = tokens.line_and_column(start);
    let (mut required, mut options, mut wobj): (Vec<Expression<'a>>, Vec<MoveOption>, _) =
        (Vec::new(), Vec::new(), None);
    loop {
        // A comma may stand before an optional argument too.
        let is_first = required.is_empty() && options.is_empty() && wobj.is_none();
        let after_comma = !is_first && tokens.take_if(b',')?;
        if tokens.take_if(b'\\')? {
            let (name, value) = ExpressionReader::new(tokens).optional()?;
            match value {
                Some(value) if wobj.is_none() && name.eq_ignore_ascii_case("WObj") => {
                    wobj = Some(value)
                }
                value => {
                    let text = value.map(|value| tokens.text[value.start..value.end].to_string());
                    options.push(MoveOption {
                        after: required.len(),
                        name: name.to_string(),
                        text,
                    });
                }
            }
        } else if !after_comma && tokens.peek().is(b';') {
            break;
        } else if !after_comma && !required.is_empty() {
            return Err(tokens.unexpected("a comma or a semicolon"));
        } else {
            required.push(ExpressionReader::new(tokens).argument()?);
        }
    }
    tokens.take()?;
    if tokens.unfinished_since(start) {
        return Ok(None);
    }
    if required.len() != kind.arguments() {
        let kind = RapidFaultKind::ArgumentCount {
            instruction: kind.name(),
            found: required.len(),
            wanted: kind.arguments(),
        };
        return Err(tokens.fault(start, kind));
    }
    Ok(Some(WrittenMove {
        kind,
        routine: 0,
        inside_loop: None,
        line,
        column,
        displaced: None,
        required,
        wobj,
        options,
    }))
}
