//! RAPID texts, routines and frames that are refused.

use crate::prelude::*;
use core::fmt;

use thiserror::Error;

use irbkin::Interrupted;
use irbkin::internal::{Names, PoseFault};

/// Why a RAPID text is refused, and where.
#[derive(Clone, Debug, PartialEq, Error)]
pub struct RapidFault {
    /// Line, from 1; 0 for data that are not in a text.
    pub line: usize,
    /// Column, from 1, in characters; 0 for data that are not in a text.
    pub column: usize,
    /// The reason.
    pub kind: RapidFaultKind,
}

impl RapidFault {
    /// A fault of data that are not in a text.
    pub(crate) fn nowhere(kind: RapidFaultKind) -> Self {
        Self { line: 0, column: 0, kind }
    }
}

impl From<Interrupted> for RapidFault {
    fn from(ended: Interrupted) -> Self {
        Self::nowhere(RapidFaultKind::Interrupted(ended))
    }
}

impl fmt::Display for RapidFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.line > 0 {
            write!(f, "line {}, column {}: ", self.line, self.column)?;
        }
        self.kind.fmt(f)
    }
}

/// The faults of a RAPID text. `thing` is a type and a name, or an instruction and
/// its argument; `part` is a component of it, or empty; `text` is as it is written.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum RapidFaultKind {
    #[error("the string has no closing quote on its line")]
    UnterminatedString,
    #[error("{text} is not a number")]
    BadNumber { text: String },
    #[error("{text} is not finite, every number must be")]
    NotFinite { text: String },
    #[error("{character:?} has no place outside a string or a comment")]
    UnexpectedCharacter { character: char },
    /// At the place where it opens.
    #[error("{bracket} is not closed")]
    Unclosed { bracket: char },
    #[error("expected {wanted}, found {found}")]
    Unexpected { found: String, wanted: &'static str },
    #[error("the text ends inside {inside}: {missing} is missing")]
    UnexpectedEnd { inside: String, missing: &'static str },
    /// `missing`: the component that is missing, or empty.
    #[error(
        "{} has {}, it must have {wanted}{}",
        named(.thing, .part),
        counted(*.found, "component"),
        lacking(.missing)
    )]
    ComponentCount {
        thing: String,
        part: String,
        found: usize,
        wanted: usize,
        missing: &'static str,
    },
    #[error("{} is {found}, it must be {wanted}", named(.thing, .part))]
    ComponentType { thing: String, part: String, found: String, wanted: &'static str },
    #[error("{} is {value}, it must be a whole number", named(.thing, .part))]
    NotWhole { thing: String, part: String, value: f64 },
    /// `of`: a type.
    #[error("{text}: {of} has no component {component}")]
    NoSuchComponent { text: String, of: &'static str, component: String },
    #[error(
        "{thing}: dimension {dimension} has {}, it must have {wanted}", counted(*.found, "element")
    )]
    ArraySize { thing: String, dimension: usize, found: usize, wanted: usize },
    #[error(
        "{thing}: size of dimension {dimension} is {value}, it must be a positive whole number"
    )]
    ArrayDimension { thing: String, dimension: usize, value: f64 },
    #[error("{thing} has {}, it must have at most {bound}", counted(*.found, "dimension"))]
    Dimensions { thing: String, found: usize, bound: usize },
    #[error("{text}: index {value} must be a whole number from 1 to {size}")]
    Index { text: String, value: f64, size: usize },
    #[error(
        "{text} has {found} {}, {}",
        if *.found == 1 { "index" } else { "indices" }, indices(*.wanted)
    )]
    IndexCount { text: String, found: usize, wanted: usize },
    /// `routine`: `None` for the module.
    #[error("{name} is declared twice in {}", .routine.as_deref().unwrap_or("the module"))]
    SameName { name: String, routine: Option<String> },
    #[error("values refer to one another in a circle: {names}")]
    Circular { names: Names },
    /// In bytes. A longer one could not be named often in linear time.
    #[error("a {what} has {found} bytes, it must have at most {bound}")]
    TooLong { what: &'static str, found: usize, bound: usize },
    #[error("nested deeper than {bound}, the deepest that is read")]
    TooDeep { bound: usize },
    #[error("a second module begins, a text must hold one")]
    SecondModule,
    #[error("a git conflict is not resolved: the text has both sides")]
    ConflictMarker,
    #[error("an encoded module, which is not text, is not read")]
    Encoded,
    #[error("{instruction} has {}, it must have {wanted}", counted(*.found, "argument"))]
    ArgumentCount { instruction: &'static str, found: usize, wanted: usize },
    #[error("{name:?} is not a RAPID identifier (a letter, then letters, digits, _)")]
    NotAName { name: String },
    /// The beginning of the text.
    #[error("{text} is not a robtarget, jointtarget, tooldata, wobjdata, pose or loaddata")]
    NoRecord { text: String },
    #[error("this is not the text of the module: it has {found} bytes, it must have {wanted}")]
    OtherText { found: usize, wanted: usize },
    #[error("{thing} is given two values, it must get one")]
    TwoValues { thing: String },
    #[error("{0}")]
    Routine(RoutineFault),
    #[error(transparent)]
    Interrupted(Interrupted),
    #[error("there is no {missing}")]
    NoSuchValue { missing: Missing },
}

/// A part that a module does not have. Indices count from 0.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum Missing {
    #[error("datum {index}, the module has {count}")]
    Datum { index: usize, count: usize },
    #[error("element {element} of {thing}")]
    Element { thing: String, element: usize },
    #[error("single value in the array {thing}")]
    Single { thing: String },
    /// `what`: of the data and moves of which a text was to be made.
    #[error("module of these data: {what}")]
    Module { what: String },
}

/// Why a routine is not a single motion.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum RoutineFault {
    #[error("the module has no routine {name:?}; it has: {known}")]
    Unknown { name: String, known: Names },
    #[error("give routine, one that moves: {moving}")]
    Which { moving: Names },
    #[error("{routine} has no move that is read")]
    NoMoves { routine: String },
    #[error(
        "{word} decides which moves are made: give a routine without branches, loops and jumps \
         around its moves"
    )]
    Branch { word: String },
    /// The first finding.
    #[error("no move can be made: {finding}")]
    NoMotion { finding: String },
}

/// Why a robtarget cannot be seen in its tool and its work object.
#[doc(hidden)]
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum FrameFault {
    #[error(
        "the robot holds {}: robhold must be TRUE for one of them",
        if *.both { "the tool and the work object" } else { "neither the tool nor the work object" }
    )]
    Held { both: bool },
    /// `unit`: as `ufmec` has it.
    #[error(
        "the work object's user frame is moved (ufprog FALSE) by the mechanical unit \"{unit}\": \
         its position is not in the data"
    )]
    Moved { unit: String },
    #[error("where the mechanical unit \"{unit}\" carries the robot is not in the data")]
    Carried { unit: String },
    /// `axis`: the component of extax.
    #[error("{axis} is missing (9E9), it moves the mechanical unit \"{unit}\"")]
    AxisMissing { axis: &'static str, unit: String },
    #[error("{field}: {fault}")]
    Pose { field: &'static str, fault: PoseFault },
}

/// "robtarget p10", or "robtarget p10: robconf" for a part.
fn named(thing: &str, part: &str) -> String {
    if part.is_empty() { thing.to_string() } else { format!("{thing}: {part}") }
}

/// ": x is missing", or nothing.
fn lacking(missing: &str) -> String {
    if missing.is_empty() { String::new() } else { format!(": {missing} is missing") }
}

/// "1 component", "2 components".
fn counted(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}

/// The number of indices that an element must have; 0 without an array.
fn indices(wanted: usize) -> String {
    if wanted == 0 {
        "but it is not an array".to_string()
    } else {
        format!("it must have {wanted}")
    }
}
