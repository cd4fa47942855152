//! The state of the reader of statements: results, names and position.

use alloc::collections::BTreeMap;
use alloc::collections::btree_map::Entry;
use alloc::sync::Arc;

use super::blocks::Blocks;
use super::declarations::Declared;
use super::faults::Faults;
use super::moves::WrittenMove;
use super::types::Types;
use crate::prelude::*;
use crate::rapid::data::expression::Name;
use crate::rapid::data::module::{Module, Routine};
use crate::rapid::data::settings::MotionSettings;
use crate::rapid::data::statement::{Statement, StatementKind};
use crate::rapid::data::unread::Unresolved;
use crate::rapid::expression::content::Placed;
use crate::rapid::expression::names::At;
use crate::rapid::text::fault::{RapidFault, RapidFaultKind};
use crate::rapid::text::tokens::{Token, Tokens};

/// A module as it is written, before names are looked up.
#[derive(Default)]
pub(crate) struct Written<'a> {
    pub(crate) text: &'a str,
    /// What is read without looking up a name.
    pub(crate) module: Module,
    pub(crate) declared: Vec<Declared<'a>>,
    /// The content of each declaration, if it is known without looking up a name.
    pub(crate) contents: Vec<Option<Placed>>,
    /// The names in lower case of the declarations that are components of data of records.
    pub(crate) parts: BTreeMap<usize, String>,
    pub(crate) moves: Vec<WrittenMove<'a>>,
    pub(crate) faults: Faults<'a>,
    pub(crate) assignments: Vec<Assignment<'a>>,
    pub(crate) scopes: Scopes,
    pub(crate) blocks: Blocks<'a>,
}

/// A statement that gives a datum another value.
pub(crate) struct Assignment<'a> {
    pub(crate) at: At,
    pub(crate) name: Name<'a>,
    /// The component that gets the value; none for the whole datum.
    pub(crate) components: Vec<Name<'a>>,
    pub(crate) line: usize,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Stage {
    Beginning,
    /// In a text without MODULE.
    Bare,
    Module,
    Ended,
}

pub(crate) struct StatementReader<'a> {
    pub(super) tokens: Tokens<'a>,
    pub(super) types: Types<'a>,
    pub(super) written: Written<'a>,
    pub(super) stage: Stage,
    /// Index of the routine, from 1; 0 outside routines.
    pub(super) routine: usize,
    /// Line of the instruction that displaces the poses of the following moves in the routine.
    pub(super) displaced_by: Option<usize>,
    pub(super) settings: MotionSettings,
}

impl StatementReader<'_> {
    pub(super) fn at(&self) -> At {
        At { routine: self.routine, inside_loop: self.written.blocks.innermost_loop() }
    }

    pub(super) fn current_routine(&self) -> Option<&Routine> {
        self.written.module.routines.get(self.routine.checked_sub(1)?)
    }

    pub(super) fn declare(
        &mut self,
        at: Token,
        name: &str,
        named: Named,
    ) -> Result<(), RapidFault> {
        if self.written.scopes.declare(self.routine, name, named) {
            return Ok(());
        }
        let routine = self.current_routine().map(|routine| routine.name.clone());
        let kind = RapidFaultKind::SameName { name: name.to_string(), routine };
        Err(self.tokens.fault(at.start, kind))
    }

    /// List the text from a token to here as a statement, or as unfinished if it contains a
    /// placeholder. Returns its line.
    pub(super) fn add(&mut self, from: Token, kind: StatementKind) -> usize {
        if self.tokens.unfinished_since(from.start) {
            return self.add_unfinished(from);
        }
        let text = self.written.text[from.start..self.tokens.last_end].to_string();
        self.add_at(from.start, kind, text)
    }

    /// List a statement at a byte. Returns its line.
    pub(super) fn add_at(&mut self, start: usize, kind: StatementKind, text: String) -> usize {
        let (line, column) = self.tokens.line_and_column(start);
        let name = self.current_routine().map(|routine| routine.name.as_str());
        let last = self.written.module.statements.last().and_then(|it| it.routine.clone());
        let routine = last.filter(|last| Some(&**last) == name).or_else(|| name.map(Arc::from));
        self.written.module.statements.push(Statement { line, column, routine, kind, text, start });
        line
    }

    /// List the text from a token to here as unfinished. Returns its line.
    pub(super) fn add_unfinished(&mut self, from: Token) -> usize {
        let statement = self.tokens.text_of(from).to_string();
        let text = self.written.text[from.start..self.tokens.last_end].to_string();
        self.add_at(from.start, StatementKind::Unfinished { statement }, text)
    }
}

/// Whether a name is a placeholder: for something that the program does not name yet.
pub(crate) fn is_placeholder(name: &str) -> bool {
    name.starts_with('<')
}

/// The meaning of a name.
#[derive(Clone)]
pub(crate) enum Named {
    /// Data, by their index.
    Datum(usize),
    /// Something that has no value here, with the reason.
    Other(Unresolved),
}

/// The names of the module and of each routine.
pub(crate) struct Scopes {
    /// By the index of the routine, from 1; 0 for the module. Names are in lower case.
    names: Vec<BTreeMap<String, Named>>,
}

impl Default for Scopes {
    fn default() -> Self {
        Self { names: Vec::from([BTreeMap::new()]) }
    }
}

impl Scopes {
    pub(crate) fn add_routine(&mut self) {
        self.names.push(BTreeMap::new());
    }

    /// Declare a name; false if it exists already. A placeholder declares nothing.
    pub(crate) fn declare(&mut self, routine: usize, name: &str, named: Named) -> bool {
        let Some(scope) = self.names.get_mut(routine).filter(|_| !is_placeholder(name)) else {
            return true;
        };
        let place = scope.entry(name.to_lowercase());
        let is_new = matches!(place, Entry::Vacant(_));
        place.or_insert(named);
        is_new
    }

    /// Find a name in lower case, in a routine or else in the module.
    pub(crate) fn find(&self, routine: usize, lower: &str) -> Option<&Named> {
        let local = self.names.get(routine).and_then(|scope| scope.get(lower));
        local.or_else(|| self.names.first()?.get(lower))
    }

    /// The components of data of records that a name in lower case and components refer to, with
    /// the components in them.
    pub(crate) fn parts<'s, 'a>(
        &'s self,
        routine: usize,
        lower: &str,
        components: &'s [Name<'a>],
    ) -> Vec<(usize, &'s [Name<'a>])> {
        let is_local = self.names.get(routine).is_some_and(|scope| scope.contains_key(lower));
        let scope = self.names.get(if is_local { routine } else { 0 });
        let prefix = format!("{lower}.");
        let all = scope.into_iter().flat_map(|scope| scope.range(prefix.clone()..));
        let all = all.take_while(|(name, _)| name.starts_with(&prefix));
        all.filter_map(|(name, named)| {
            let Named::Datum(index) = named else { return None };
            let path = name[prefix.len()..].split('.');
            let depth = path.clone().count();
            let mut pairs = path.zip(components);
            let meets = pairs.all(|(own, component)| own.eq_ignore_ascii_case(component));
            meets.then_some((*index, components.get(depth..).unwrap_or_default()))
        })
        .collect()
    }

    /// Data of the module by their names in lower case.
    pub(crate) fn module_data(self) -> impl Iterator<Item = (String, usize)> {
        let module = self.names.into_iter().next().unwrap_or_default();
        module.into_iter().filter_map(|(name, named)| match named {
            Named::Datum(index) => Some((name, index)),
            Named::Other(_) => None,
        })
    }
}
