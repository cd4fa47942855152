//! The names of a program: which routine and which datum a name refers to in each module.

use alloc::collections::BTreeMap;

use super::cases::{Known, saved_value};
use super::tree::{Body, bodies};
use crate::prelude::*;
use crate::rapid::data::module::{Datum, Module, Parameter, Routine, RoutineKind, Scope, Storage};
use crate::rapid::data::statement::StatementKind;
use crate::rapid::data::unread::Unresolved;
use crate::rapid::data::value::DataType;

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(in crate::rapid) struct DatumId {
    pub(in crate::rapid) module: usize,
    pub(super) datum: usize,
}

/// The names of modules that know each other.
pub(in crate::rapid) struct Index<'m> {
    pub(in crate::rapid) modules: Vec<&'m Module>,
    /// The routines of each module by their names in lower case.
    routines: Vec<BTreeMap<String, &'m Routine>>,
    /// The modules that have a global routine, by its name in lower case: the first one counts.
    global_routines: BTreeMap<String, Vec<usize>>,
    /// The modules that have a global datum, by its name in lower case: the first one counts.
    global_data: BTreeMap<String, Vec<usize>>,
    /// The data of the routines of each module by the names of routines and data in lower case.
    locals: Vec<BTreeMap<String, BTreeMap<String, usize>>>,
    /// Names in lower case of the data of each module that are not read.
    unread: Vec<BTreeMap<String, Unresolved>>,
    /// The statements of the routines of each module by their names in lower case.
    pub(super) bodies: Vec<BTreeMap<String, Body<'m>>>,
}

impl<'m> Index<'m> {
    pub(in crate::rapid) fn new(modules: &[&'m Module]) -> Self {
        let mut names = Self {
            modules: modules.to_vec(),
            routines: Vec::with_capacity(modules.len()),
            global_routines: BTreeMap::new(),
            global_data: BTreeMap::new(),
            locals: modules.iter().map(|module| locals(module)).collect(),
            unread: modules.iter().map(|module| unread(module)).collect(),
            bodies: modules.iter().map(|module| bodies(module)).collect(),
        };
        for (index, module) in modules.iter().enumerate() {
            let mut own = BTreeMap::new();
            for routine in &module.routines {
                let name = routine.name.to_lowercase();
                if !routine.is_local() {
                    names.global_routines.entry(name.clone()).or_default().push(index);
                }
                own.entry(name).or_insert(routine);
            }
            names.routines.push(own);
            for (name, datum) in &module.index {
                if module.data.get(*datum).is_some_and(|it| it.scope != Scope::Local) {
                    names.global_data.entry(name.clone()).or_default().push(index);
                }
            }
        }
        names
    }

    fn routine(&self, module: usize, lower: &str) -> Option<&'m Routine> {
        self.routines.get(module)?.get(lower).copied()
    }

    /// The routine that a name in lower case refers to in a module, and its module.
    pub(in crate::rapid) fn callee(
        &self,
        module: usize,
        lower: &str,
    ) -> Option<(usize, &'m Routine)> {
        let at = |home: usize| Some((home, self.routine(home, lower)?));
        at(module).or_else(|| at(*self.global_routines.get(lower)?.first()?))
    }

    /// Whether several other modules declare what a name in lower case refers to in a module.
    pub(in crate::rapid) fn is_ambiguous(&self, module: usize, lower: &str) -> bool {
        let globals = [&self.global_routines, &self.global_data];
        let are_others = |it: &Vec<usize>| it.len() > 1 && !it.contains(&module);
        globals.iter().any(|it| it.get(lower).is_some_and(are_others))
    }

    /// The module of the procedure that a name in lower case refers to in a module.
    pub(super) fn procedure(&self, module: usize, lower: &str) -> Option<usize> {
        let (home, routine) = self.callee(module, lower)?;
        (routine.kind == RoutineKind::Proc).then_some(home)
    }

    /// The module of the function that a name in lower case refers to in a module, and the type of
    /// what it returns; `None` if several modules declare it.
    pub(in crate::rapid) fn function(
        &self,
        module: usize,
        lower: &str,
    ) -> Option<(usize, DataType)> {
        let (home, routine) = self.callee(module, lower)?;
        Some((home, routine.data_type?)).filter(|_| !self.is_ambiguous(module, lower))
    }

    /// Whether a routine is a trap, by its name in lower case.
    pub(super) fn is_trap(&self, module: usize, lower: &str) -> bool {
        self.routine(module, lower).is_some_and(|it| it.kind == RoutineKind::Trap)
    }

    /// The datum of a module that a name in lower case refers to in a module.
    pub(in crate::rapid) fn datum(
        &self,
        module: usize,
        lower: &str,
    ) -> Option<(DatumId, &'m Datum)> {
        let at = |home: usize| {
            let of = *self.modules.get(home)?;
            let datum = *of.index.get(lower)?;
            Some((DatumId { module: home, datum }, of.data.get(datum)?))
        };
        at(module).or_else(|| at(*self.global_data.get(lower)?.first()?))
    }

    fn declared(&self, DatumId { module, datum }: DatumId) -> Option<&'m Datum> {
        self.modules.get(module)?.data.get(datum)
    }

    pub(super) fn name(&self, datum: DatumId) -> &'m str {
        self.declared(datum).map_or("", |it| &it.name)
    }

    /// The saved value of a datum, if it is a PERS.
    pub(super) fn saved(&self, datum: DatumId) -> Option<Known> {
        let own = self.declared(datum).filter(|it| it.storage == Storage::Pers)?;
        let words = saved_value(&own.name);
        Some(Known::resting_on(Some(words), own.content.clone(), ""))
    }

    pub(in crate::rapid) fn locals(
        &self,
        module: usize,
        lower: &str,
    ) -> impl Iterator<Item = &'m Datum> {
        let of = self.modules.get(module).map_or(&[][..], |it| &it.data);
        let own = self.locals.get(module).and_then(|it| it.get(lower));
        own.into_iter().flat_map(BTreeMap::values).filter_map(|datum| of.get(*datum))
    }

    /// The datum of a routine, by both names in lower case.
    pub(in crate::rapid) fn local(
        &self,
        module: usize,
        routine: &str,
        lower: &str,
    ) -> Option<&'m Datum> {
        let datum = *self.locals.get(module)?.get(routine)?.get(lower)?;
        self.modules.get(module)?.data.get(datum)
    }

    /// Why a name in lower case has no value, if it refers to a datum that is not read.
    pub(in crate::rapid) fn unread(&self, module: usize, lower: &str) -> Option<&Unresolved> {
        let own = self.unread.get(module).and_then(|names| names.get(lower));
        own.or_else(|| self.unread.iter().find_map(|names| names.get(lower)))
    }

    /// A component of a datum of a record that the program defines, by its whole name in lower case;
    /// `None` if the program assigns it.
    pub(super) fn part(&self, module: usize, lower: &str) -> Option<&'m Datum> {
        let whole = lower.split('.').next().unwrap_or(lower);
        let is_assigned =
            |it: &&'m Module| it.assigned.contains(lower) || it.assigned.contains(whole);
        let own = self.modules.get(module).and_then(|it| it.parts.get(lower));
        let global = || {
            let mut all = self.modules.iter().filter_map(|it| it.parts.get(lower));
            all.find(|datum| datum.scope != Scope::Local)
        };
        own.or_else(global).filter(|_| !self.modules.iter().any(is_assigned))
    }

    pub(in crate::rapid) fn body(&self, module: usize, lower: &str) -> Option<&Body<'m>> {
        self.bodies.get(module)?.get(lower)
    }

    pub(in crate::rapid) fn parameters(&self, module: usize, lower: &str) -> &'m [Parameter] {
        self.routine(module, lower).map_or(&[], |it| &it.parameters)
    }

    /// The routines of all modules in the order of the text, by module and name in lower case; ""
    /// for statements outside routines.
    pub(super) fn routines(&self) -> Vec<(usize, String)> {
        let mut all = Vec::new();
        for (index, module) in self.modules.iter().enumerate() {
            all.push((index, String::new()));
            all.extend(module.routines.iter().map(|it| (index, it.name.to_lowercase())));
        }
        all
    }
}

/// The data of each routine, by its name in lower case.
fn locals(module: &Module) -> BTreeMap<String, BTreeMap<String, usize>> {
    let mut found: BTreeMap<String, BTreeMap<String, usize>> = BTreeMap::new();
    for (index, datum) in module.data.iter().enumerate() {
        if let Some(routine) = &datum.routine {
            found
                .entry(routine.to_lowercase())
                .or_default()
                .insert(datum.name.to_lowercase(), index);
        }
    }
    found
}

/// The names in lower case of data that are not read, with the reasons.
fn unread(module: &Module) -> BTreeMap<String, Unresolved> {
    let names = module.statements.iter().filter_map(|statement| match &statement.kind {
        StatementKind::Datum { name, .. } => Some((name.to_lowercase(), Unresolved::ValueNotKnown)),
        StatementKind::DatumOfType { name, type_name } => {
            let type_name = type_name.clone();
            Some((name.to_lowercase(), Unresolved::OtherType { type_name }))
        }
        _ => None,
    });
    names.collect()
}
