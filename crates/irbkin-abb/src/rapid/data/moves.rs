//! Move instructions.

use alloc::sync::Arc;
use core::ops::Range;

use super::records::{JointTarget, RobTarget, SpeedData, ToolData, WobjData, ZoneData};
use super::settings::MotionSettings;
use super::unread::Reason;
use crate::prelude::*;
use crate::rapid::text::words::words;

words! {
    /// How the robot gets to the target: the name of the plain instruction.
    pub enum MoveKind {
        /// Joints, to a pose.
        MoveJ = "MoveJ",
        /// A straight line.
        MoveL = "MoveL",
        /// A circle through a point.
        MoveC = "MoveC",
        /// Joints, to joint angles.
        MoveAbsJ = "MoveAbsJ",
        /// External axes only, to the external axes of a joint target: the robot stays.
        MoveExtJ = "MoveExtJ",
    }
}

/// An argument as it is written, without its name, and its value by the declarations.
#[derive(Clone, Debug, PartialEq)]
pub struct Argument<T> {
    /// Source text.
    pub text: Arc<str>,
    /// The value, or the reason why it is unknown.
    pub value: Result<T, Reason>,
}

/// The destination of a move.
#[derive(Clone, Debug, PartialEq)]
pub enum Target {
    /// A pose.
    RobTarget(RobTarget),
    /// Joint angles, for `MoveAbsJ` and `MoveExtJ`.
    JointTarget(JointTarget),
}

/// An optional argument other than `\WObj`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MoveOption {
    /// Number of required arguments before it.
    pub after: usize,
    /// Name, as it is written.
    pub name: String,
    /// Source text of its value; `None` for a switch. It begins with `?` if a routine passes on its
    /// own optional argument.
    pub text: Option<String>,
}

/// A required argument of a process: a signal, trigger data, a seam.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExtraArgument {
    /// Number of required arguments before it.
    pub place: usize,
    /// Source text.
    pub text: String,
}

/// A move instruction.
///
/// Values are taken from the declarations; data that the module assigns have none here. What many
/// moves have is shared among them.
#[derive(Clone, Debug, PartialEq)]
pub struct Move {
    /// How it moves: a line for `MoveL`, and for `MoveLDO`, `SearchL` and `ArcL` too.
    pub kind: MoveKind,
    /// Name of the instruction, as it is written.
    pub instruction: Arc<str>,
    /// The routine that contains it; `None` outside routines.
    pub routine: Option<Arc<str>>,
    /// Line, from 1; 0 if it was not read from a text.
    pub line: usize,
    /// Column, from 1, in characters; 0 if it was not read from a text.
    pub column: usize,
    /// The point on the circle of a `MoveC`.
    pub via: Option<Box<Argument<RobTarget>>>,
    /// The destination.
    pub target: Argument<Target>,
    /// Bytes of the destination in the text of the module; empty if it was not read from a text.
    pub target_span: Range<usize>,
    /// The speed, with that of the tool center point that `\V` gives.
    pub speed: Arc<Argument<SpeedData>>,
    /// The zone, with the radius that `\Z` gives; without a text for an instruction without one,
    /// which meets its target.
    pub zone: Arc<Argument<ZoneData>>,
    /// The tool; `tool0` without a text for an instruction of external axes.
    pub tool: Arc<Argument<ToolData>>,
    /// The work object of `\WObj:=`; without one, `wobj0`.
    pub wobj: Option<Arc<Argument<WobjData>>>,
    /// The other optional arguments, in order.
    pub options: Vec<MoveOption>,
    /// The other required arguments, in order.
    pub extra: Vec<ExtraArgument>,
    /// Line of the `PDispOn` or `PDispSet` that precedes it in its routine without a `PDispOff` in
    /// between: the robot does not move to `via` and `target` as written. Joint angles are not
    /// displaced.
    pub displaced: Option<usize>,
    /// The duration that `\T` gives instead of the speed [s], or the reason why it is unknown.
    pub time: Option<Box<Result<f64, Reason>>>,
    /// The settings of ConfL, ConfJ, SingArea and CirPathMode before it in its routine.
    pub settings: MotionSettings,
}

impl Move {
    /// Clear its line and column, as for a move that was not read from a text.
    pub(crate) fn clear_lines(&mut self) {
        (self.line, self.column, self.displaced) = (0, 0, self.displaced.map(|_| 0));
        self.target_span = 0..0;
        let reasons = [
            self.via.as_mut().and_then(|via| via.value.as_mut().err()),
            self.target.value.as_mut().err(),
            unknown(&mut self.tool),
            self.wobj.as_mut().and_then(unknown),
            unknown(&mut self.speed),
            unknown(&mut self.zone),
            self.time.as_mut().and_then(|time| time.as_mut().as_mut().err()),
        ];
        reasons.into_iter().flatten().for_each(Reason::clear_line);
    }
}

/// Why a shared argument is unknown, to be changed for one move.
fn unknown<T: Clone>(argument: &mut Arc<Argument<T>>) -> Option<&mut Reason> {
    if argument.value.is_ok() { None } else { Arc::make_mut(argument).value.as_mut().err() }
}
