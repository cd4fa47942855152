//! Data that a module assigns: in moves, they may differ from their declarations.

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::string::String;

use crate::rapid::data::module::{Datum, Module, Scope, Storage};
use crate::rapid::expression::names::{By, Cause, lower};
use crate::rapid::statements::blocks::Blocks;
use crate::rapid::statements::declarations::Declared;
use crate::rapid::statements::reader::Assignment;
use crate::rapid::statements::scopes::{Named, Scopes};

/// The assigned data, with causes.
pub(crate) struct Causes<'a> {
    /// By the index of the datum.
    of_data: BTreeMap<usize, Cause<'a>>,
    /// Names in lower case that are not declared in the module.
    of_others: BTreeMap<String, Cause<'a>>,
}

impl<'a> Causes<'a> {
    pub(crate) fn none() -> Self {
        Self { of_data: BTreeMap::new(), of_others: BTreeMap::new() }
    }

    /// The causes from assignments: each applies to the datum that its name refers to at its place.
    /// A CONST cannot be assigned.
    pub(crate) fn new(
        assignments: &[Assignment<'a>],
        declared: &[Declared<'_>],
        scopes: &Scopes,
        blocks: &Blocks<'_>,
    ) -> Self {
        let mut causes = Self::none();
        for Assignment { at, name, line } in assignments {
            let lower = lower(name);
            if blocks.is_variable(at.inside_loop, &lower) {
                continue;
            }
            let cause = Cause { name, by: By::Line(*line) };
            match scopes.find(at.routine, &lower) {
                Some(Named::Datum(datum))
                    if declared.get(*datum).is_some_and(|it| it.storage != Storage::Const) =>
                {
                    causes.add(*datum, cause);
                }
                Some(_) => {}
                None => {
                    causes.of_others.entry(lower.into_owned()).or_insert(cause);
                }
            }
        }
        causes
    }

    pub(crate) fn add(&mut self, datum: usize, cause: Cause<'a>) {
        self.of_data.entry(datum).or_insert(cause);
    }

    pub(crate) fn of_datum(&self, datum: usize) -> Option<Cause<'a>> {
        self.of_data.get(&datum).copied()
    }

    /// The cause for a datum of another module, by its name in lower case: this module assigns it,
    /// its own does, or one that refers to it.
    pub(crate) fn of_other(
        &self,
        lower: &str,
        home: &'a Module,
        context: &[&'a Module],
    ) -> Option<Cause<'a>> {
        let assigns = |module: &&&Module| {
            module.assigned.contains(lower)
                && (core::ptr::eq(**module, home) || module.find(lower).is_none())
        };
        let of_context = || {
            let module = context.iter().find(assigns)?;
            let name = home.find(lower)?.name.as_str();
            Some(Cause { name, by: By::Module(module.name()) })
        };
        self.of_others.get(lower).copied().or_else(of_context)
    }

    /// The names in lower case of assigned data that are visible to other modules.
    pub(crate) fn names(self, declared: &[Declared<'_>]) -> BTreeSet<String> {
        let data = self
            .of_data
            .keys()
            .filter_map(|datum| declared.get(*datum))
            .filter(|datum| datum.routine == 0);
        data.map(|datum| datum.name.to_lowercase()).chain(self.of_others.into_keys()).collect()
    }
}

/// The datum of other modules that a name in lower case refers to, with its module.
pub(crate) fn found_elsewhere<'a>(
    lower: &str,
    context: &[&'a Module],
) -> Option<(&'a Datum, &'a Module)> {
    let mut found = context.iter().filter_map(|module| Some((module.find(lower)?, *module)));
    found.find(|(datum, _)| datum.scope != Scope::Local)
}
