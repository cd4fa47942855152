//! Data resolved, each after those that it refers to. In moves, data that a module assigns may
//! differ from their declarations.

use alloc::collections::{BTreeMap, BTreeSet};
use core::cell::RefCell;
use core::ops::Range;

use crate::prelude::*;
use crate::rapid::data::expression::Name;
use crate::rapid::data::module::{Datum, Module, Scope, Storage};
use crate::rapid::data::types::{LOADDATA, TOOLDATA, Type};
use crate::rapid::data::unread::{Reason, Unresolved};
use crate::rapid::data::value::DataType;
use crate::rapid::expression::content::Placed;
use crate::rapid::expression::evaluate::Stop;
use crate::rapid::expression::names::{At, By, Cause, Lookup, Names, lower, predefined};
use crate::rapid::statements::blocks::Blocks;
use crate::rapid::statements::declarations::Declared;
use crate::rapid::statements::faults::Faults;
use crate::rapid::statements::reader::{Assignment, Named, Scopes};
use crate::rapid::text::fault::{RapidFault, RapidFaultKind};
use crate::rapid::text::place::{Place, fault_at};
use irbkin::internal::Names as NamesOf;

pub(super) struct Resolver<'a> {
    pub(super) text: &'a str,
    pub(super) declared: &'a [Declared<'a>],
    pub(super) scopes: &'a Scopes,
    pub(super) blocks: &'a Blocks<'a>,
    pub(super) context: &'a [&'a Module],
    /// The content of each datum, or the reason why it is unknown, or not resolved yet.
    pub(super) contents: Vec<Result<Placed, Reason>>,
    /// The names in lower case of the declarations that are components of data of records.
    pub(super) parts: &'a BTreeMap<usize, String>,
    /// Why data are unknown where the program moves.
    pub(super) causes: Causes<'a>,
    /// The data of other modules by names in lower case that were asked before.
    pub(super) elsewhere: RefCell<BTreeMap<String, Option<Elsewhere<'a>>>>,
    /// Whether another module has a routine of a name in lower case, if that was asked before.
    pub(super) routines_elsewhere: RefCell<BTreeMap<String, bool>>,
    pub(super) faults: Faults<'a>,
}

impl Names for Resolver<'_> {
    fn find(&self, at: At, name: &str) -> Lookup<'_> {
        let lower = lower(name);
        if self.blocks.is_variable(at.inside_loop, &lower) {
            return Lookup::Unknown(Unresolved::LoopVariable);
        }
        match self.scopes.find(at.routine, &lower) {
            Some(Named::Other(why)) => return Lookup::Unknown(why.clone()),
            Some(Named::Datum(index)) => return self.datum(*index),
            None => {}
        }
        match self.elsewhere(&lower) {
            Some((datum, cause)) => Lookup::Datum {
                content: &datum.content,
                can_change: datum.storage != Storage::Const,
                cause,
            },
            None => predefined(&lower).map_or(Lookup::NotHere, Lookup::Predefined),
        }
    }

    fn cause_of<'c>(
        &'c self,
        at: At,
        name: &str,
        atoms: Range<usize>,
        cause: Cause<'c>,
    ) -> Option<Cause<'c>> {
        match self.scopes.find(at.routine, &lower(name)) {
            Some(Named::Datum(index)) => self.causes.of_atoms(*index, &atoms),
            _ => Some(cause),
        }
    }
}

/// A datum of another module, and why its value may be another one where the program moves.
type Elsewhere<'a> = (&'a Datum, Option<Cause<'a>>);

impl<'a> Resolver<'a> {
    /// The datum of another module that a name in lower case refers to.
    fn elsewhere(&self, lower: &str) -> Option<Elsewhere<'a>> {
        if let Some(known) = self.elsewhere.borrow().get(lower) {
            return *known;
        }
        let find = |home: &'a Module| home.find(lower).or_else(|| home.parts.get(lower));
        let mut seen = self.context.iter().filter_map(|home| Some((find(home)?, *home)));
        let found = seen
            .find(|(datum, _)| datum.scope != Scope::Local)
            .map(|(datum, home)| (datum, self.causes.of_other(lower, home, self.context)));
        self.elsewhere.borrow_mut().insert(lower.to_string(), found);
        found
    }

    pub(super) fn is_routine(&self, name: &str) -> bool {
        let lower = lower(name);
        let own = self.scopes.find(0, &lower);
        if own.is_some() {
            return matches!(own, Some(Named::Other(Unresolved::Routine)));
        }
        let mut asked = self.routines_elsewhere.borrow_mut();
        *asked.entry(lower.into_owned()).or_insert_with(|| {
            let mut routines = self.context.iter().flat_map(|module| module.routines());
            routines.any(|it| it.name.eq_ignore_ascii_case(name) && !it.is_local())
        })
    }

    fn datum(&self, index: usize) -> Lookup<'_> {
        let (Some(declared), Some(Ok(Placed { content, .. }))) =
            (self.declared.get(index), self.contents.get(index))
        else {
            return Lookup::Unknown(Unresolved::ValueNotKnown);
        };
        let can_change = declared.storage != Storage::Const;
        Lookup::Datum { content, can_change, cause: self.causes.of_datum(index) }
    }

    /// Resolve every datum, each after those that it refers to, without recursion.
    pub(super) fn resolve_all(&mut self) -> Result<(), RapidFault> {
        let mut state = vec![State::New; self.declared.len()];
        // A datum with the number of its names that are resolved.
        let mut open: Vec<(usize, usize)> = Vec::new();
        for datum in 0..self.declared.len() {
            self.faults.interrupt.check(datum)?;
            if state[datum] == State::New {
                state[datum] = State::Open;
                open.push((datum, 0));
            }
            while let Some((current, gone_through)) = open.last_mut() {
                let current = *current;
                let declared = &self.declared[current];
                let Some(name) = declared.names.get(*gone_through) else {
                    self.resolve(current)?;
                    state[current] = State::Done;
                    open.pop();
                    // Data that refer to it change with it.
                    if let Some((above, gone_through)) = open.last() {
                        self.add_cause(*above, *gone_through, current);
                    }
                    continue;
                };
                *gone_through += 1;
                let gone_through = *gone_through;
                let lower = lower(name);
                let other = match self.scopes.find(declared.routine, &lower) {
                    Some(Named::Datum(other)) => other,
                    Some(Named::Other(_)) => continue,
                    None => {
                        // Data change with those of other modules.
                        if gone_through > declared.size_names
                            && let Some((_, Some(cause))) = self.elsewhere(&lower)
                        {
                            self.causes.add(current, ALL, cause);
                        }
                        continue;
                    }
                };
                match state[*other] {
                    State::New => {
                        state[*other] = State::Open;
                        open.push((*other, 0));
                    }
                    State::Open if self.faults.is_full() => {}
                    State::Open => {
                        let fault = self.circle(&open, *other);
                        self.faults.add(fault)?;
                    }
                    State::Done => self.add_cause(current, gone_through, *other),
                }
            }
        }
        Ok(())
    }

    /// Record that a datum changes with what one of its names refers to; sizes, whose names come
    /// first, do not change.
    fn add_cause(&mut self, datum: usize, gone_through: usize, other: usize) {
        let of_other = self.causes.of_used_atoms(other, self.declared);
        if let Some(cause) = of_other.filter(|_| gone_through > self.declared[datum].size_names) {
            self.causes.add(datum, ALL, cause);
        }
    }

    fn circle(&self, open: &[(usize, usize)], again: usize) -> RapidFault {
        let from = open.iter().position(|(datum, _)| *datum == again).unwrap_or(0);
        let circle = open[from..].iter().map(|(datum, _)| *datum).chain([again]);
        let names: NamesOf = circle.map(|datum| self.declared[datum].name).collect();
        let Declared { start: byte, line, column, .. } = self.declared[again];
        fault_at(self.text, Place { byte, line, column }, byte, RapidFaultKind::Circular { names })
    }

    fn resolve(&mut self, index: usize) -> Result<(), RapidFault> {
        let declared = &self.declared[index];
        let Some(written) = &declared.written else { return Ok(()) };
        self.contents[index] = match written.evaluate(&declared.evaluator(self.text, self)) {
            Ok(placed) => Ok(placed),
            Err(Stop::Unknown(reason)) => Err(reason),
            Err(Stop::Fault(fault)) => {
                let reason = Reason::Invalid { fault: fault.kind.to_string() };
                // Records that a program defines are not read but for their components.
                if !self.parts.contains_key(&index) {
                    self.faults.add(fault)?;
                }
                Err(reason)
            }
        };
        Ok(())
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum State {
    New,
    Open,
    Done,
}

/// The assigned data, with causes.
#[derive(Default)]
pub(crate) struct Causes<'a> {
    /// By the index of the datum, for ranges of its atoms.
    of_data: BTreeMap<usize, Vec<(Range<usize>, Cause<'a>)>>,
    /// Names in lower case that are not declared in the module.
    of_others: BTreeMap<String, Cause<'a>>,
}

impl<'a> Causes<'a> {
    /// The causes from assignments: each applies to the datum that its name refers to at its place.
    /// A CONST cannot be assigned.
    pub(crate) fn new(
        assignments: &'a [Assignment<'a>],
        declared: &[Declared<'_>],
        scopes: &Scopes,
        blocks: &Blocks<'_>,
    ) -> Self {
        let mut causes = Self::default();
        for Assignment { at, name, components, line } in assignments {
            let lower = lower(name);
            if blocks.is_variable(at.inside_loop, &lower) {
                continue;
            }
            let cause = Cause { name, by: By::Line(*line) };
            match scopes.find(at.routine, &lower) {
                Some(Named::Datum(datum))
                    if declared.get(*datum).is_some_and(|it| it.storage != Storage::Const) =>
                {
                    let atoms = atoms_of(declared[*datum].data_type.described(), components);
                    causes.add(*datum, atoms, cause);
                }
                Some(Named::Datum(_)) => {}
                Some(Named::Other(_)) => {
                    for (part, inside) in scopes.parts(at.routine, &lower, components) {
                        let of = declared.get(part).filter(|it| it.storage != Storage::Const);
                        let Some(of) = of else { continue };
                        let atoms = atoms_of(of.data_type.described(), inside);
                        causes.add(part, atoms, cause);
                    }
                }
                // The load of a tool does not count.
                None if components.first().is_some_and(|it| it.eq_ignore_ascii_case("tload")) => {}
                None => {
                    causes.of_others.entry(lower.into_owned()).or_insert(cause);
                }
            }
        }
        causes
    }

    /// Add the causes from assignments of other modules, to data that they see.
    pub(super) fn add_assigned_elsewhere(
        &mut self,
        own: Option<&str>,
        context: &[&'a Module],
        declared: &[Declared<'a>],
        scopes: &Scopes,
    ) {
        for module in context.iter().filter(|module| own.is_none() || module.name() != own) {
            for name in module.assigned.iter().filter(|name| !module.declares(name)) {
                let data = match scopes.find(0, name) {
                    Some(Named::Datum(datum)) => Vec::from([*datum]),
                    Some(Named::Other(_)) => {
                        let parts = scopes.parts(0, name, &[]);
                        parts.into_iter().map(|(part, _)| part).collect()
                    }
                    None => continue,
                };
                for datum in data {
                    let Some(of) = declared.get(datum) else { continue };
                    if of.storage != Storage::Const && of.scope != Scope::Local {
                        let cause = Cause { name: of.name, by: By::Module(module.name(), None) };
                        self.add(datum, ALL, cause);
                    }
                }
            }
        }
    }

    fn add(&mut self, datum: usize, atoms: Range<usize>, cause: Cause<'a>) {
        let causes = self.of_data.entry(datum).or_default();
        let is_known =
            |(own, _): &(Range<usize>, _)| own.start <= atoms.start && atoms.end <= own.end;
        if !causes.iter().any(is_known) {
            causes.push((atoms, cause));
        }
    }

    pub(crate) fn of_datum(&self, datum: usize) -> Option<Cause<'a>> {
        self.of_atoms(datum, &ALL)
    }

    fn of_atoms(&self, datum: usize, atoms: &Range<usize>) -> Option<Cause<'a>> {
        let mut causes = self.of_data.get(&datum)?.iter();
        let meets = |own: &Range<usize>| own.start < atoms.end && atoms.start < own.end;
        causes.find(|(own, _)| meets(own)).map(|(_, cause)| *cause)
    }

    /// The cause for what counts in moves: of a tool, its load does not.
    fn of_used_atoms(&self, datum: usize, declared: &[Declared<'_>]) -> Option<Cause<'a>> {
        let is_tool = declared.get(datum).is_some_and(|it| it.data_type == DataType::ToolData);
        let load = if is_tool { TOOLDATA.size() - LOADDATA.size() } else { ALL.end };
        self.of_atoms(datum, &(0..load))
    }

    /// The cause for a datum of another module, by its name in lower case: this module assigns it,
    /// its own does, or one that refers to it.
    pub(crate) fn of_other(
        &self,
        lower: &str,
        home: &'a Module,
        context: &[&'a Module],
    ) -> Option<Cause<'a>> {
        // Of a component of a record, another module may assign the whole.
        let whole = lower.split('.').next().unwrap_or(lower);
        let assigns = |module: &&&Module| {
            [lower, whole].into_iter().any(|name| module.assigned.contains(name))
                && (core::ptr::eq(**module, home) || !module.declares(lower))
        };
        let of_context = || {
            let module = context.iter().find(assigns)?;
            let name = home.find(lower).or_else(|| home.parts.get(lower))?.name.as_str();
            Some(Cause { name, by: By::Module(module.name(), None) })
        };
        let own = self.of_others.get(lower).or_else(|| self.of_others.get(whole));
        own.copied().or_else(of_context)
    }

    /// The names in lower case of assigned data that are visible to other modules.
    pub(crate) fn names(
        self,
        declared: &[Declared<'_>],
        parts: &BTreeMap<usize, String>,
    ) -> BTreeSet<String> {
        let data = self
            .of_data
            .keys()
            .filter(|datum| self.of_used_atoms(**datum, declared).is_some())
            .filter_map(|index| Some((index, declared.get(*index)?)))
            .filter(|(_, datum)| datum.routine == 0);
        let data = data.map(|(index, datum)| {
            parts.get(index).cloned().unwrap_or_else(|| datum.name.to_lowercase())
        });
        data.chain(self.of_others.keys().cloned()).collect()
    }
}

/// All atoms of a datum.
const ALL: Range<usize> = 0..usize::MAX;

/// The atoms of a component; all if there is no such component.
pub(crate) fn atoms_of(of: &'static Type, components: &[Name<'_>]) -> Range<usize> {
    match of.part(components) {
        Some((part, begin)) if !components.is_empty() => begin..begin + part.size(),
        _ => ALL,
    }
}
