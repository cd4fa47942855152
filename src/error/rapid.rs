//! What can be wrong with a RAPID text.

use core::fmt;

use alloc::string::String;

use super::{Names, RoutineFault};

/// What is wrong with a RAPID text, and where.
#[derive(Clone, Debug, PartialEq)]
pub struct RapidFault {
    /// Line, from 1; 0 for data that stand in no text.
    pub line: usize,
    /// Column, from 1, in characters; 0 for data that stand in no text.
    pub column: usize,
    /// What is wrong.
    pub kind: RapidFaultKind,
}

/// The ways in which a RAPID text can be broken. `thing` is a type and a name, or an instruction
/// and its argument.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum RapidFaultKind {
    /// A string does not end on its line.
    UnterminatedString,
    /// What begins as a number is none.
    BadNumber {
        /// As it is written.
        text: String,
    },
    /// A number is too large, or an arithmetic has no finite result.
    NotFinite {
        /// As it is written.
        text: String,
    },
    /// RAPID has no such character outside strings and comments.
    UnexpectedCharacter {
        /// The character.
        character: char,
    },
    /// A bracket, parenthesis or brace is not closed; the place is where it opens.
    Unclosed {
        /// The opening character.
        bracket: char,
    },
    /// Something is at a place where something else is expected.
    Unexpected {
        /// What is there.
        found: String,
        /// What is expected.
        wanted: &'static str,
    },
    /// The text ends too early.
    UnexpectedEnd {
        /// What it ends inside of.
        inside: String,
        /// What is missing.
        missing: &'static str,
    },
    /// A record has another number of components.
    ComponentCount {
        /// The thing.
        thing: String,
        /// The component, empty for the thing as a whole.
        part: String,
        /// Components that it has.
        found: usize,
        /// Components that it must have.
        wanted: usize,
    },
    /// A value is of another type.
    ComponentType {
        /// The thing.
        thing: String,
        /// The component, empty for the thing as a whole.
        part: String,
        /// What it is.
        found: String,
        /// What it must be.
        wanted: &'static str,
    },
    /// A component of confdata is no whole number.
    NotWhole {
        /// The thing.
        thing: String,
        /// The component.
        part: String,
        /// Its value.
        value: f64,
    },
    /// A record has no such component.
    NoSuchComponent {
        /// As it is written.
        text: String,
        /// The type of what stands before the component.
        of: &'static str,
        /// The component.
        component: String,
    },
    /// A dimension of an array has another number of elements.
    ArraySize {
        /// The thing.
        thing: String,
        /// The dimension, from 1.
        dimension: usize,
        /// Elements of its value.
        found: usize,
        /// Its size.
        wanted: usize,
    },
    /// The size of an array is no positive whole number.
    ArrayDimension {
        /// The thing.
        thing: String,
        /// The dimension, from 1.
        dimension: usize,
        /// Its size.
        value: f64,
    },
    /// An array has too many dimensions.
    Dimensions {
        /// The thing.
        thing: String,
        /// Dimensions that it has.
        found: usize,
        /// Most that an array has.
        bound: usize,
    },
    /// An index lies outside its array.
    Index {
        /// As it is written.
        text: String,
        /// The index.
        value: f64,
        /// The size of the array.
        size: usize,
    },
    /// An element is asked for with another number of indices.
    IndexCount {
        /// As it is written.
        text: String,
        /// Indices that it has.
        found: usize,
        /// Dimensions of the array.
        wanted: usize,
    },
    /// Two things of one scope have the same name.
    SameName {
        /// The name.
        name: String,
        /// The routine, or none for the module.
        routine: Option<String>,
    },
    /// Values refer to one another in a circle.
    Circular {
        /// The circle.
        names: Names,
    },
    /// A name or a string is so long that what tells of it often would not be read in linear time;
    /// RAPID's own are far shorter.
    TooLong {
        /// What it is.
        what: &'static str,
        /// Its bytes.
        found: usize,
        /// Most bytes.
        bound: usize,
    },
    /// Brackets or blocks are nested too deep.
    TooDeep {
        /// The deepest that is read.
        bound: usize,
    },
    /// A second module begins in one text.
    SecondModule,
    /// An instruction has another number of arguments.
    ArgumentCount {
        /// The instruction.
        instruction: &'static str,
        /// Arguments that it has.
        found: usize,
        /// Arguments that it must have.
        wanted: usize,
    },
    /// A name is none that RAPID could read.
    NotAName {
        /// The name.
        name: String,
    },
    /// A text that should be a record is none.
    NoRecord {
        /// As it is written, its beginning.
        text: String,
    },
    /// A text to be written anew is not the one of which the module was read.
    OtherText {
        /// Its bytes.
        found: usize,
        /// Bytes of the one that was read.
        wanted: usize,
    },
    /// One place of a text is to get two values.
    TwoValues {
        /// Whose place.
        thing: String,
    },
    /// A routine is no single motion.
    Routine(RoutineFault),
    /// A value is to be put where there is none.
    NoSuchValue {
        /// What there is not.
        missing: Missing,
    },
}

/// What a module does not have. `thing` is a type and a name.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Missing {
    /// A datum of an index.
    Datum {
        /// The index.
        index: usize,
        /// Data that the module has.
        count: usize,
    },
    /// An element of a datum.
    Element {
        /// The datum.
        thing: String,
        /// The element, from 0.
        element: usize,
    },
    /// A single value in an array.
    Single {
        /// The array.
        thing: String,
    },
    /// A text that says the same as the data and moves that a module is made of.
    Module {
        /// What of them is not read.
        what: String,
    },
}

impl RapidFault {
    /// A fault of something that stands in no text.
    pub(crate) fn nowhere(kind: RapidFaultKind) -> Self {
        Self { line: 0, column: 0, kind }
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

/// "robtarget p10", or "robtarget p10: robconf" where a part is meant.
struct Part<'a>(&'a str, &'a str);

impl fmt::Display for Part<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0)?;
        if self.1.is_empty() { Ok(()) } else { write!(f, ": {}", self.1) }
    }
}

/// "1 component", "2 components".
struct Count(usize, &'static str);

impl fmt::Display for Count {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}{}", self.0, self.1, if self.0 == 1 { "" } else { "s" })
    }
}

impl fmt::Display for RapidFaultKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnterminatedString => write!(f, "the string has no closing quote on its line"),
            Self::BadNumber { text } => write!(f, "{text} is not a number"),
            Self::NotFinite { text } => write!(f, "{text} is not finite, every number must be"),
            Self::UnexpectedCharacter { character } => {
                write!(f, "{character:?} has no place outside a string or a comment")
            }
            Self::Unclosed { bracket } => write!(f, "{bracket} is not closed"),
            Self::Unexpected { found, wanted } => write!(f, "expected {wanted}, found {found}"),
            Self::UnexpectedEnd { inside, missing } => {
                write!(f, "the text ends inside {inside}: {missing} is missing")
            }
            Self::ComponentCount { thing, part, found, wanted } => {
                write!(
                    f,
                    "{} has {}, it must have {wanted}",
                    Part(thing, part),
                    Count(*found, "component")
                )
            }
            Self::ComponentType { thing, part, found, wanted } => {
                write!(f, "{} is {found}, it must be {wanted}", Part(thing, part))
            }
            Self::NotWhole { thing, part, value } => {
                write!(f, "{} is {value}, it must be a whole number", Part(thing, part))
            }
            Self::NoSuchComponent { text, of, component } => {
                write!(f, "{text}: {of} has no component {component}")
            }
            Self::ArraySize { thing, dimension, found, wanted } => {
                write!(
                    f,
                    "{thing}: dimension {dimension} has {}, it must have {wanted}",
                    Count(*found, "element")
                )
            }
            Self::ArrayDimension { thing, dimension, value } => {
                write!(
                    f,
                    "{thing}: size of dimension {dimension} is {value}, it must be a positive \
                     whole number"
                )
            }
            Self::Dimensions { thing, found, bound } => {
                write!(
                    f,
                    "{thing} has {}, it must have at most {bound}",
                    Count(*found, "dimension")
                )
            }
            Self::Index { text, value, size } => {
                write!(f, "{text}: index {value} must be a whole number from 1 to {size}")
            }
            Self::IndexCount { text, found, wanted } => {
                let indices = if *found == 1 { "index" } else { "indices" };
                write!(f, "{text} has {found} {indices}, ")?;
                if *wanted == 0 {
                    write!(f, "but it is not an array")
                } else {
                    write!(f, "it must have {wanted}")
                }
            }
            Self::SameName { name, routine: None } => {
                write!(f, "{name} is declared twice in the module")
            }
            Self::SameName { name, routine: Some(routine) } => {
                write!(f, "{name} is declared twice in {routine}")
            }
            Self::Circular { names } => {
                write!(f, "values refer to one another in a circle: {names}")
            }
            Self::TooLong { what, found, bound } => {
                write!(f, "a {what} has {found} bytes, it must have at most {bound}")
            }
            Self::TooDeep { bound } => {
                write!(f, "nested deeper than {bound}, the deepest that is read")
            }
            Self::SecondModule => write!(f, "a second module begins, a text must hold one"),
            Self::ArgumentCount { instruction, found, wanted } => {
                write!(f, "{instruction} has {}, it must have {wanted}", Count(*found, "argument"))
            }
            Self::NotAName { name } => {
                write!(f, "{name:?} is not a RAPID identifier (a letter, then letters, digits, _)")
            }
            Self::NoRecord { text } => write!(
                f,
                "{text} is not a robtarget, jointtarget, tooldata, wobjdata, pose or loaddata"
            ),
            Self::OtherText { found, wanted } => {
                write!(
                    f,
                    "this is not the text of the module: it has {found} bytes, it must have \
                     {wanted}"
                )
            }
            Self::TwoValues { thing } => write!(f, "{thing} is given two values, it must get one"),
            Self::Routine(fault) => fault.fmt(f),
            Self::NoSuchValue { missing } => write!(f, "there is no {missing}"),
        }
    }
}

impl fmt::Display for Missing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Datum { index, count } => write!(f, "datum {index}, the module has {count}"),
            Self::Element { thing, element } => write!(f, "element {element} of {thing}"),
            Self::Single { thing } => write!(f, "single value in the array {thing}"),
            Self::Module { what } => write!(f, "module of these data: {what}"),
        }
    }
}
