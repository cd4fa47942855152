//! Reasons why values are unknown. Names and words are as they are written.

use crate::prelude::*;
use core::fmt;

use thiserror::Error;

/// The reason why an expression has no value here.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum Reason {
    #[error("* is taught on the controller, its value is not in the text")]
    Taught,
    /// It contains a placeholder.
    #[error("it is not finished")]
    Unfinished,
    #[error("it depends on whether an optional argument is there")]
    OptionalArgument,
    /// Such as `DIV`.
    #[error("this operator is not evaluated")]
    Operator,
    #[error("NOT is not evaluated")]
    Negation,
    #[error("arithmetic of {type_name} is not evaluated")]
    Arithmetic { type_name: &'static str },
    #[error("{name} is not evaluated")]
    Function { name: String },
    #[error("{name} is declared in this module, it is not evaluated")]
    OwnFunction { name: String },
    #[error("{name} with {argument} is not evaluated")]
    FunctionArgument { name: String, argument: String },
    #[error("{name}: {words}")]
    Robot { name: String, code: super::finding::Code, words: String },
    /// An array is declared as a copy of another one.
    #[error("refers to {name}, and arrays are not copied")]
    CopiedArray { name: String },
    #[error("the value of the array is not an aggregate")]
    NoAggregate,
    #[error("refers to {name}, {why}")]
    Reference { name: String, why: Unresolved },
    /// An index that the program calculates.
    #[error("{fault}")]
    NoSuchElement { fault: String },
    /// Of a module that is read in spite of its faults.
    #[error("{fault}")]
    Invalid { fault: String },
}

/// The reason why a name has no value here.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum Unresolved {
    /// Neither the module nor its context declares it.
    #[error("which is not in this module")]
    NotDeclared,
    #[error("the variable of a loop")]
    LoopVariable,
    #[error("of type {type_name}, which is not read")]
    OtherType { type_name: String },
    #[error("whose declaration is not finished")]
    Unfinished,
    #[error("a type")]
    Type,
    #[error("a routine")]
    Routine,
    #[error("a parameter of {routine}")]
    Parameter { routine: String },
    #[error("whose value is not known")]
    ValueNotKnown,
    #[error("whose declaration has no value")]
    NoValue,
    /// A size or an index must be constant.
    #[error("which can change")]
    CanChange,
    #[error("which is a whole array")]
    WholeArray,
    #[error("which has no such element")]
    NoSuchElement,
    #[error("{by}")]
    Assigned { by: AssignedBy },
    /// A program assigns another datum, to which its declaration refers.
    #[error("which depends on {name}, {by}")]
    AssignedThrough { name: String, by: AssignedBy },
}

/// The place of an assignment.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum AssignedBy {
    /// The statement on a line, from 1; 0 if it was not read from a text.
    Line(usize),
    /// Another module, with its name, and the line there, from 1, if that is known.
    Module(Option<String>, Option<usize>),
}

impl fmt::Display for AssignedBy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(line) => write!(f, "which line {line} assigns"),
            Self::Module(Some(module), Some(line)) => {
                write!(f, "which line {line} of module {module} assigns")
            }
            Self::Module(Some(module), None) => write!(f, "which module {module} assigns"),
            Self::Module(None, _) => f.write_str("which another module assigns"),
        }
    }
}

impl Reason {
    /// Clear the line, as for something that was not read from a text.
    pub(crate) fn clear_line(&mut self) {
        if let Self::Reference { why, .. } = self
            && let Unresolved::Assigned { by } | Unresolved::AssignedThrough { by, .. } = why
            && let AssignedBy::Line(line) = by
        {
            *line = 0;
        }
    }
}
