//! Statements as they are written, each read once, and parts of a text that are not read.

use alloc::sync::Arc;

use thiserror::Error;

use super::expression::{Arguments, Expression, Form, Operator, Relation};
use super::instructions::Effect;
use super::lookup::written_argument;
use super::settings::MotionSettings;
use super::unread::Reason;
use crate::prelude::*;

/// A statement, or a part of the text that is not read.
#[derive(Clone, Debug, PartialEq)]
pub struct Statement {
    /// Line, from 1.
    pub line: usize,
    /// Column, from 1, in characters.
    pub column: usize,
    /// The routine that contains it; `None` for the module.
    pub routine: Option<Arc<str>>,
    pub(crate) kind: StatementKind,
    /// The text, which is written back as it is; empty for a move.
    pub text: String,
    /// The byte of the module's text at which it begins.
    pub(crate) start: usize,
}

impl Statement {
    /// What is not read and, for a datum, why.
    #[must_use]
    pub fn what(&self) -> String {
        self.kind.to_string()
    }
}

/// The kind of a statement with its expressions, whose bytes count from its beginning; or of a part
/// that is not read.
#[derive(Clone, Debug, PartialEq, Error)]
pub(crate) enum StatementKind {
    /// A move, by its index in the module.
    #[error("it moves the robot")]
    Move(usize),
    /// An instruction that sets how the moves after it are made.
    #[error("{} sets how moves are made", .0.word)]
    Setting(Box<Instruction>),
    /// A line that begins, divides or ends a branch, a loop or a handler, by its word in capitals.
    #[error("{word} is not executed")]
    Flow { word: String, flow: Flow },
    #[error("label {name} is not read")]
    Label { name: String },
    #[error("{} is assigned a value, which is not followed", .0.name)]
    Assignment(Box<Assignment>),
    /// An instruction, or a call of a routine.
    #[error("{0}")]
    Instruction(Box<Instruction>),
    /// A statement, by its first word, with a placeholder in it.
    #[error("{statement} is not finished")]
    Unfinished { statement: String },
    /// A statement, by its first word, that is invalid: of a module that is read in spite of its
    /// faults.
    #[error("{statement} is invalid: {fault}")]
    Invalid { statement: String, fault: String },
    /// A datum of a type that is read, whose value is unknown.
    #[error("{name}: {reason}")]
    Datum { name: String, reason: Box<Reason> },
    #[error("{name}: type {type_name} is not read")]
    DatumOfType { name: String, type_name: String },
    #[error("RECORD {name} is not read")]
    Record { name: String },
    #[error("ALIAS {name} is not read")]
    Alias { name: String },
}

impl StatementKind {
    /// The word of a branch, a loop or a handler, or the name of an instruction, as it is written.
    pub(crate) fn word(&self) -> &str {
        match self {
            Self::Flow { word, .. } => word,
            Self::Instruction(instruction) => &instruction.word,
            _ => "",
        }
    }
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Assignment {
    /// The name of the datum, as it is written.
    pub(crate) name: String,
    pub(crate) target: Expression<'static>,
    pub(crate) value: Expression<'static>,
    /// The name of the datum in lower case, and its component, joined by dots.
    pub(crate) to: (String, String),
}

#[derive(Clone, Debug, PartialEq, Error)]
#[error("{word} {}", if *.is_motion { MOTION } else { "is not an instruction that is read" })]
pub(crate) struct Instruction {
    /// Its first word, as it is written.
    pub(crate) word: String,
    /// Whether it moves the robot and is not read.
    pub(crate) is_motion: bool,
    pub(crate) effect: Effect,
    /// The name in lower case of the routine that it calls, if there is one; `None` if the name is
    /// calculated.
    pub(crate) name: Option<String>,
    pub(crate) arguments: Arguments<'static>,
    /// The datum in lower case that it writes to, and its component, joined by dots.
    pub(crate) written: Option<(String, String)>,
}

const MOTION: &str = "moves the robot, but is not read";

impl Instruction {
    /// By its first word and its name, which is the text of a call by name.
    pub(crate) fn new(first: &str, name: Option<&str>, arguments: Arguments<'static>) -> Self {
        let effect = name.map_or(Effect::Nothing, Effect::of);
        let is_motion = effect == Effect::Moves;
        let place = name.and_then(written_argument).and_then(|place| place.checked_sub(1));
        let written = place.and_then(|place| arguments.required.get(place));
        let written = written.and_then(Expression::referred);
        // It may name the module, too: "Part:rGo".
        let called = name.map(|name| name.rsplit(':').next().unwrap_or(name).trim());
        Self {
            word: name.filter(|_| is_motion).unwrap_or(first).to_string(),
            is_motion,
            effect,
            name: called.map(str::to_lowercase),
            arguments,
            written,
        }
    }

    /// What it assigns, if it counts.
    pub(crate) fn as_assignment(&self) -> Option<Assignment> {
        let mut arguments = self.arguments.required.iter();
        let target = arguments.next()?.clone();
        let one = Expression { form: Form::Number(1.0), ..target };
        let (operator, operand) = match self.name.as_deref()? {
            "incr" => (Operator::Plus, one),
            "decr" => (Operator::Minus, one),
            "add" => (Operator::Plus, arguments.next()?.clone()),
            _ => return None,
        };
        let form = Form::Chain(Box::new(target.clone()), Vec::from([(operator, operand)]));
        let value = Expression { form, ..target };
        let to = self.written.clone()?;
        Some(Assignment { name: to.0.clone(), target, value, to })
    }

    /// Set how moves are made, if it sets that. Returns whether it does.
    pub(crate) fn set(&self, settings: &mut MotionSettings) -> bool {
        let Arguments { required, optional } = &self.arguments;
        match (required.as_slice(), optional.as_slice()) {
            ([], []) => settings.set(&self.word, None),
            ([], [it]) if it.value.is_none() => settings.set(&self.word, Some(&it.name)),
            _ => false,
        }
    }
}

/// A line of a branch, a loop or a handler.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Flow {
    /// Without THEN it is of one instruction, which follows.
    If {
        condition: Condition,
        is_single: bool,
    },
    /// ELSEIF, ELSE, CASE, DEFAULT.
    Part(Condition),
    /// With what is tested, if that is read.
    Test(Option<Expression<'static>>),
    /// FOR or WHILE.
    Loop {
        condition: Condition,
        counter: Option<Box<Counter>>,
    },
    End,
    Handler,
}

/// The variable of a FOR and its bounds.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Counter {
    /// Its name in lower case.
    pub(crate) variable: String,
    /// From and to.
    pub(crate) bounds: [Expression<'static>; 2],
    pub(crate) step: Option<Expression<'static>>,
}

/// A condition of a part of a branch, or of a loop, as far as it is evaluated.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Condition {
    /// `TRUE`, ELSE, DEFAULT.
    Always,
    /// `FALSE`.
    Never,
    /// Whether an optional parameter, in lower case, must be there: `Present(x)`, `NOT Present(x)`.
    Present(String, bool),
    Compared(Box<[Expression<'static>; 2]>, Relation),
    /// Whether what is tested is one of some numbers.
    Case(Vec<Expression<'static>>),
    /// Not evaluated; the expression, if it is read.
    Other(Option<Box<Expression<'static>>>),
}

impl Condition {
    pub(crate) fn of(expression: Expression<'static>) -> Self {
        let present = |form: &Form<'_>| match form {
            Form::Call(call) if call.name.eq_ignore_ascii_case("Present") => {
                let (name, ..) = call.arguments.required.first()?.reference()?;
                Some(name.to_lowercase())
            }
            _ => None,
        };
        let presence = match &expression.form {
            Form::Not(of) => present(&of.form).map(|it| Self::Present(it, false)),
            form => present(form).map(|it| Self::Present(it, true)),
        };
        match expression.form {
            Form::Bool(true) => Self::Always,
            Form::Bool(false) => Self::Never,
            Form::Compared(numbers, relation) => Self::Compared(numbers, relation),
            _ => presence.unwrap_or_else(|| Self::Other(Some(Box::new(expression)))),
        }
    }
}
