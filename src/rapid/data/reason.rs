//! Reasons why a value is unknown.

use core::fmt;

use alloc::string::String;

/// The reason why an expression has no value here. `Display` gives the words.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Reason {
    /// It is the teach pendant's `*`: its value is on the controller.
    Taught,
    /// It contains a placeholder.
    Unfinished,
    /// It depends on whether the caller gives an optional argument.
    OptionalArgument,
    /// It contains an operator that is not evaluated, such as `DIV`.
    Operator,
    /// It begins with `NOT`.
    Negation,
    /// It is arithmetic of something other than numbers.
    Arithmetic {
        /// The type of the result.
        type_name: &'static str,
    },
    /// It is the result of a function that is not evaluated.
    Function {
        /// Name of the function, as it is written.
        name: String,
    },
    /// It is the result of a function of the module itself.
    OwnFunction {
        /// Name of the function, as it is written.
        name: String,
    },
    /// It is the result of a function with an optional argument that is not evaluated.
    FunctionArgument {
        /// Name of the function, as it is written.
        name: String,
        /// Name of the argument, as it is written.
        argument: String,
    },
    /// An array is declared as a copy of another one.
    CopiedArray {
        /// Name of the other one, as it is written.
        name: String,
    },
    /// An array is declared with something other than an aggregate.
    NoAggregate,
    /// It refers to something whose value is unknown.
    Reference {
        /// The name, as it is written.
        name: String,
        /// Why that is unknown.
        why: Unresolved,
    },
}

/// The reason why a name has no value here. `Display` gives the words.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Unresolved {
    /// Neither the module nor its context declares it.
    NotDeclared,
    /// It is the variable of a loop.
    LoopVariable,
    /// It has a data type that is not read.
    OtherType {
        /// Name of the type, as it is written.
        type_name: String,
    },
    /// Its declaration has a placeholder in it.
    Unfinished,
    /// It is a type.
    Type,
    /// It is a routine.
    Routine,
    /// It is a parameter of a routine.
    Parameter {
        /// Name of the routine, as it is written.
        routine: String,
    },
    /// The value of its declaration is unknown.
    ValueNotKnown,
    /// Its declaration has no value.
    NoValue,
    /// It can change, but a size or an index must be constant.
    CanChange,
    /// It is an array, and no element of it is named.
    WholeArray,
    /// It is an array that has no such element.
    NoSuchElement,
    /// A program assigns it, or something that its declaration refers to.
    Assigned {
        /// What is assigned, if that is something that its declaration refers to.
        through: Option<String>,
        /// What assigns it.
        by: AssignedBy,
    },
}

/// What assigns a datum.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum AssignedBy {
    /// The statement on a line, from 1; 0 if it was not read from a text.
    Line(usize),
    /// Another module, with its name.
    Module(Option<String>),
}

impl Reason {
    /// Clear the line, as for something that was not read from a text.
    pub(crate) fn clear_line(&mut self) {
        if let Self::Reference { why: Unresolved::Assigned { by, .. }, .. } = self
            && let AssignedBy::Line(line) = by
        {
            *line = 0;
        }
    }
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Taught => {
                f.write_str("* is taught on the controller, its value is not in the text")
            }
            Self::Unfinished => f.write_str("it is not finished"),
            Self::OptionalArgument => {
                f.write_str("it depends on whether an optional argument is there")
            }
            Self::Operator => f.write_str("this operator is not evaluated"),
            Self::Negation => f.write_str("NOT is not evaluated"),
            Self::Arithmetic { type_name } => {
                write!(f, "arithmetic of {type_name} is not evaluated")
            }
            Self::Function { name } => write!(f, "{name} is not evaluated"),
            Self::OwnFunction { name } => {
                write!(f, "{name} is declared in this module, it is not evaluated")
            }
            Self::FunctionArgument { name, argument } => {
                write!(f, "{name} with {argument} is not evaluated")
            }
            Self::CopiedArray { name } => write!(f, "refers to {name}, and arrays are not copied"),
            Self::NoAggregate => f.write_str("the value of the array is not an aggregate"),
            Self::Reference { name, why } => write!(f, "refers to {name}, {why}"),
        }
    }
}

impl fmt::Display for Unresolved {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotDeclared => f.write_str("which is not in this module"),
            Self::LoopVariable => f.write_str("the variable of a loop"),
            Self::OtherType { type_name } => write!(f, "of type {type_name}, which is not read"),
            Self::Unfinished => f.write_str("whose declaration is not finished"),
            Self::Type => f.write_str("a type"),
            Self::Routine => f.write_str("a routine"),
            Self::Parameter { routine } => write!(f, "a parameter of {routine}"),
            Self::ValueNotKnown => f.write_str("whose value is not known"),
            Self::NoValue => f.write_str("whose declaration has no value"),
            Self::CanChange => f.write_str("which can change"),
            Self::WholeArray => f.write_str("which is a whole array"),
            Self::NoSuchElement => f.write_str("which has no such element"),
            Self::Assigned { through, by } => {
                if let Some(name) = through {
                    write!(f, "which depends on {name}, ")?;
                }
                by.fmt(f)
            }
        }
    }
}

impl fmt::Display for AssignedBy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(line) => write!(f, "which line {line} assigns"),
            Self::Module(Some(module)) => write!(f, "which module {module} assigns"),
            Self::Module(None) => f.write_str("which another module assigns"),
        }
    }
}
