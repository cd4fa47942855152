//! A RAPID module as data: declarations, moves, and what was skipped.

use alloc::collections::{BTreeMap, BTreeSet};
use core::ops::Range;

use super::moves::Move;
use super::own_types::OwnTypes;
use super::statement::{Statement, StatementKind};
use super::value::{DataType, Value};
use crate::prelude::*;
use crate::rapid::text::fault::RapidFault;
use crate::rapid::text::tokens::Called;
use crate::rapid::text::words::words;

words! {
    /// The scope of a datum.
    pub enum Scope {
        /// Visible in every module; inside a routine, in the routine.
        Global = "",
        /// Visible in its module.
        Local = "LOCAL",
        /// Visible in the modules of its task.
        Task = "TASK",
    }

    /// The storage class of a datum.
    pub enum Storage {
        /// Never changes.
        Const = "CONST",
        /// A program may change it, and the text with it.
        Pers = "PERS",
        /// A program may change it.
        Var = "VAR",
    }

    /// The kind of a routine.
    pub enum RoutineKind {
        /// Procedure.
        Proc = "PROC",
        /// Function.
        Func = "FUNC",
        /// Trap routine.
        Trap = "TRAP",
    }
}

/// The content of a datum by its declaration; a program may change it afterwards.
#[derive(Clone, Debug, PartialEq)]
pub enum Content {
    /// The declaration has no value.
    Uninitialized {
        /// Sizes of an array; empty for a single value.
        sizes: Vec<usize>,
    },
    /// One value.
    Single(Value),
    /// An array, with the last index running fastest.
    Array {
        /// One to three sizes.
        sizes: Vec<usize>,
        /// As many values as the product of the sizes.
        values: Vec<Value>,
    },
}

/// A data declaration.
#[derive(Clone, Debug, PartialEq)]
pub struct Datum {
    /// Name, as it is written.
    pub name: String,
    /// Data type of its values.
    pub data_type: DataType,
    /// Its scope.
    pub scope: Scope,
    /// Its storage class.
    pub storage: Storage,
    /// The routine that declares it; `None` for the module.
    pub routine: Option<String>,
    /// Its content.
    pub content: Content,
    /// Line of the declaration, from 1; 0 if it was not read from a text.
    pub line: usize,
    /// Column of the declaration, from 1, in characters; 0 if it was not read from a text.
    pub column: usize,
    /// Bytes of the value in the text; without a value, the empty range at its place.
    pub value_span: Range<usize>,
    /// Bytes of each element of an array, in the order of its values.
    pub element_spans: Vec<Range<usize>>,
}

impl Datum {
    /// A single value that is declared for the whole module, with global scope.
    #[must_use]
    pub fn single(name: String, storage: Storage, value: Value) -> Self {
        Self {
            name,
            data_type: value.data_type(),
            scope: Scope::Global,
            storage,
            routine: None,
            content: Content::Single(value),
            line: 0,
            column: 0,
            value_span: 0..0,
            element_spans: Vec::new(),
        }
    }
}

impl RoutineKind {
    pub(crate) fn end(self) -> &'static str {
        match self {
            Self::Proc => "ENDPROC",
            Self::Func => "ENDFUNC",
            Self::Trap => "ENDTRAP",
        }
    }
}

/// A routine.
#[derive(Clone, Debug, PartialEq)]
pub struct Routine {
    /// Its kind.
    pub kind: RoutineKind,
    /// Name, as it is written.
    pub name: String,
    /// Its first line, from `LOCAL` or `PROC` to the parameters.
    pub header: String,
    /// Line, from 1; 0 if it was not read from a text.
    pub line: usize,
    /// Column, from 1, in characters; 0 if it was not read from a text.
    pub column: usize,
    pub(crate) parameters: Vec<Parameter>,
    /// The type of what a function returns, if it is read.
    pub(crate) data_type: Option<DataType>,
}

#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Parameter {
    /// Name in lower case.
    pub(crate) name: String,
    /// Its type; `None` for a switch and for types that are not read.
    pub(crate) data_type: Option<DataType>,
    pub(crate) is_optional: bool,
    /// Whether what the routine assigns to it is assigned to its argument.
    pub(crate) is_reference: bool,
    /// Whether it is one of the alternatives of the parameter before it, as in `\A | \B`.
    pub(crate) is_alternative: bool,
}

impl Routine {
    /// Whether only its own module may call it.
    #[must_use]
    pub fn is_local(&self) -> bool {
        let word = Scope::Local.name();
        self.header.get(..word.len()).is_some_and(|it| it.eq_ignore_ascii_case(word))
    }
}

/// The name of a routine by its index, from 1; `None` for 0, the module itself.
pub(crate) fn routine_name(routines: &[Routine], index: usize) -> Option<String> {
    routines.get(index.checked_sub(1)?).map(|routine| routine.name.clone())
}

/// A module, or a text without one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Module {
    pub(crate) name: Option<String>,
    pub(crate) attributes: Vec<String>,
    pub(crate) routines: Vec<Routine>,
    pub(crate) data: Vec<Datum>,
    pub(crate) moves: Vec<Move>,
    /// In the order of the text, with the parts that are not read.
    pub(crate) statements: Vec<Statement>,
    pub(crate) faults: Vec<RapidFault>,
    /// Data of the module itself by their names in lower case.
    pub(crate) index: BTreeMap<String, usize>,
    /// Names in lower case that the module assigns: of its own data, with those that refer to them,
    /// and of data that it does not declare.
    pub(crate) assigned: BTreeSet<String>,
    /// Values that refer to assigned data, as they are written, by the index of the datum: as
    /// numbers they would no longer refer to them.
    pub(crate) expressions: BTreeMap<usize, String>,
    pub(crate) types: OwnTypes,
    /// The components of its own data of records that a program defines, by their names in lower
    /// case, such as `station.p`.
    pub(crate) parts: BTreeMap<String, Datum>,
    /// Calls of routines, and calls of RAPID's own with wrong arguments.
    pub(crate) calls: Vec<Called>,
    /// Bytes of the text that it was read from.
    pub(crate) text_length: usize,
}

impl Module {
    /// Its name, or the placeholder of an unfinished one; `None` for declarations without an
    /// enclosing module.
    #[must_use]
    pub fn name(&self) -> Option<&str> {
        self.name.as_deref()
    }

    /// Its attributes, such as `SYSMODULE`.
    #[must_use]
    pub fn attributes(&self) -> &[String] {
        &self.attributes
    }

    /// Its routines, in the order of the text.
    #[must_use]
    pub fn routines(&self) -> &[Routine] {
        &self.routines
    }

    /// Its data, in the order of the text, including the data of routines.
    #[must_use]
    pub fn data(&self) -> &[Datum] {
        &self.data
    }

    /// Its moves, in the order of the text, regardless of branches and loops.
    #[must_use]
    pub fn moves(&self) -> &[Move] {
        &self.moves
    }

    /// The parts that were not read, in the order of the text.
    #[must_use]
    pub fn skipped(&self) -> Vec<&Statement> {
        let is_read = |kind: &StatementKind| {
            matches!(kind, StatementKind::Move(_) | StatementKind::Setting(_))
        };
        self.statements.iter().filter(|it| !is_read(&it.kind)).collect()
    }

    /// The faults of the text, in its order: none, unless the module was read
    /// by [`read`](crate::rapid::read). At most 100 faults are kept.
    #[must_use]
    pub fn faults(&self) -> &[RapidFault] {
        &self.faults
    }

    /// The datum of the module with a name, in any case; data of routines are not searched.
    #[must_use]
    pub fn find(&self, name: &str) -> Option<&Datum> {
        self.position(name).and_then(|index| self.data.get(index))
    }

    /// The index in [`Self::data`] of the datum that [`Self::find`] returns.
    #[must_use]
    pub fn position(&self, name: &str) -> Option<usize> {
        self.index.get(&name.to_lowercase()).copied()
    }

    /// Whether a name in lower case is of its own data, or of a component of them.
    pub(crate) fn declares(&self, lower: &str) -> bool {
        self.index.contains_key(lower) || self.parts.contains_key(lower)
    }

    /// The module without lines, columns and spans: two that are equal so say the same.
    #[must_use]
    pub fn without_positions(mut self) -> Self {
        self.text_length = 0;
        self.calls.clear();
        for datum in self.data.iter_mut().chain(self.parts.values_mut()) {
            (datum.line, datum.column, datum.value_span) = (0, 0, 0..0);
            datum.element_spans.clear();
        }
        for step in &mut self.moves {
            step.clear_lines();
        }
        for routine in &mut self.routines {
            (routine.line, routine.column) = (0, 0);
        }
        for statement in &mut self.statements {
            (statement.line, statement.column, statement.start) = (0, 0, 0);
        }
        for fault in &mut self.faults {
            (fault.line, fault.column) = (0, 0);
        }
        self
    }
}
