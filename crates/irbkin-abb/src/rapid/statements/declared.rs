//! A declaration before its names are looked up.

use alloc::boxed::Box;
use alloc::vec::Vec;

use crate::rapid::data::expression::Name;
use crate::rapid::data::module::{Scope, Storage};
use crate::rapid::data::value::DataType;
use crate::rapid::expression::content::{Placed, WrittenContent};
use crate::rapid::expression::evaluate::{Evaluator, Stop};
use crate::rapid::expression::names::{At, Names, NoNames};
use crate::rapid::text::fault::RapidFault;
use crate::rapid::text::place::Place;

/// A declaration of a type that is read, before its names are looked up.
pub(crate) struct Declared<'a> {
    pub(crate) name: &'a str,
    pub(crate) data_type: DataType,
    pub(crate) scope: Scope,
    pub(crate) storage: Storage,
    /// Index of the routine, from 1; 0 for the module.
    pub(crate) routine: usize,
    /// Names that its sizes and its value refer to.
    pub(crate) names: Vec<Name<'a>>,
    /// How many of the names, the first, belong to the sizes.
    pub(crate) size_names: usize,
    /// Bytes of the statement with its semicolon.
    pub(crate) start: usize,
    pub(crate) end: usize,
    pub(crate) line: usize,
    pub(crate) column: usize,
    /// Its sizes and its value, unless its content is known without looking up a name: they are
    /// most of the memory that a large text takes.
    pub(crate) written: Option<Box<WrittenContent<'a>>>,
}

impl<'a> Declared<'a> {
    /// The evaluator of its sizes and its value.
    pub(crate) fn evaluator<'r>(&self, text: &'a str, names: &'r dyn Names) -> Evaluator<'r, 'a> {
        Evaluator {
            text,
            names,
            at: At { routine: self.routine, inside_loop: None },
            thing: (self.data_type.name(), self.name),
            constant: false,
            at_move: false,
            near: Place { byte: self.start, line: self.line, column: self.column },
        }
    }
}

/// A declaration with its content, if it has no names.
pub(super) fn known_at_once<'a>(
    text: &'a str,
    mut declared: Declared<'a>,
    written: WrittenContent<'a>,
    is_tolerant: bool,
) -> Result<(Declared<'a>, Option<Placed>), RapidFault> {
    if declared.names.is_empty() {
        match written.evaluate(&declared.evaluator(text, &NoNames)) {
            Ok(placed) => return Ok((declared, Some(placed))),
            Err(Stop::Fault(fault)) if !is_tolerant => return Err(fault),
            // The reason is determined when all names are known.
            Err(Stop::Fault(_) | Stop::Unknown(_)) => {}
        }
    }
    declared.written = Some(Box::new(written));
    Ok((declared, None))
}
