//! Parts of a text that are not read.

use core::fmt;

use alloc::string::String;

use super::reason::Reason;

/// A part of the text that is not read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Skipped {
    /// Line, from 1.
    pub line: usize,
    /// Column, from 1, in characters.
    pub column: usize,
    /// The routine that it is in; none for the module.
    pub routine: Option<String>,
    /// Its kind and, for a datum, why it is not read.
    pub what: NotRead,
    /// The text, which is written back as it is.
    pub text: String,
}

/// The kind of a part of the text that is not read. Names and words are as written. `Display` gives
/// the words.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum NotRead {
    /// A statement with a placeholder in it.
    Unfinished {
        /// Its first word.
        statement: String,
    },
    /// A datum of a type that is read, whose value is unknown.
    Datum {
        /// Its name.
        name: String,
        /// Why its value is unknown.
        reason: Reason,
    },
    /// A datum of a type that is not read.
    DatumOfType {
        /// Its name.
        name: String,
        /// Its type.
        type_name: String,
    },
    /// The declaration of a record.
    Record {
        /// Its name.
        name: String,
    },
    /// The declaration of an alias of a type.
    Alias {
        /// The alias.
        name: String,
    },
    /// A line that begins, divides or ends a branch, a loop or a handler.
    Flow {
        /// Its word, in capitals.
        word: String,
    },
    /// A label.
    Label {
        /// Its name.
        name: String,
    },
    /// An assignment.
    Assignment {
        /// The name that is assigned.
        name: String,
    },
    /// An instruction that moves the robot.
    Motion {
        /// Its name.
        name: String,
    },
    /// Another instruction, or a call of a routine.
    Instruction {
        /// Its name.
        name: String,
    },
}

impl fmt::Display for NotRead {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unfinished { statement } => write!(f, "{statement} is not finished"),
            Self::Datum { name, reason } => write!(f, "{name}: {reason}"),
            Self::DatumOfType { name, type_name } => {
                write!(f, "{name}: type {type_name} is not read")
            }
            Self::Record { name } => write!(f, "RECORD {name} is not read"),
            Self::Alias { name } => write!(f, "ALIAS {name} is not read"),
            Self::Flow { word } => write!(f, "{word} is not executed"),
            Self::Label { name } => write!(f, "label {name} is not read"),
            Self::Assignment { name } => {
                write!(f, "{name} is assigned a value, which is not followed")
            }
            Self::Motion { name } => write!(f, "{name} moves the robot, but is not read"),
            Self::Instruction { name } => write!(f, "{name} is not an instruction that is read"),
        }
    }
}
