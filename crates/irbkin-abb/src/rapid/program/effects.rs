//! Effects of routines, with the ones that they call: whether they move the robot or set how it
//! moves, and the data that they assign.

use alloc::borrow::Cow;
use alloc::collections::{BTreeMap, BTreeSet};
use core::cell::Cell;
use core::ops::Range;

use super::index::{DatumId, Index};
use super::tree::{Block, Node, nodes};
use crate::prelude::*;
use crate::rapid::data::expression::Arguments;
use crate::rapid::data::instructions::Effect;
use crate::rapid::data::lookup::written_argument;
use crate::rapid::data::module::Parameter;
use crate::rapid::data::moves::Move;
use crate::rapid::data::statement::{Instruction, StatementKind};
use crate::rapid::data::table::Entry;
use crate::rapid::data::value::DataType;
use crate::rapid::resolve::resolver::atoms_of;

/// How often effects are passed on from routine to routine: chains of calls are no longer.
const PASSES: usize = 64;

/// Most routines with the data that they assign that are told apart: many assign any.
pub(super) const MOST_CALLED: usize = 1000;

/// A routine by its module and its name in lower case.
type Name = (usize, String);

/// The effects of a routine, with the routines that it calls.
#[derive(Clone, Default, PartialEq)]
pub(super) struct Acts {
    /// Whether it moves the robot, displaces targets or sets how moves are made.
    pub(super) moves: bool,
    /// Whether it assigns data, or the robot may be elsewhere behind it.
    assigns: bool,
    /// The data that it assigns by itself.
    own: BTreeSet<DatumId>,
    assigned_parameters: BTreeSet<String>,
}

impl Acts {
    /// Whether following it changes what is known.
    pub(super) fn matters(&self) -> bool {
        self.moves || self.assigns || !self.assigned_parameters.is_empty()
    }
}

pub(super) struct Assigned {
    /// The module and the line of the first one.
    pub(super) by: (usize, usize),
    /// The components that are assigned, joined by dots; "" for all.
    components: BTreeSet<String>,
}

impl Assigned {
    /// Whether assignments leave all components but one, and what is in it, as they are declared.
    pub(super) fn are_within(&self, component: &str) -> bool {
        let is_within = |it: &String| {
            it.strip_prefix(component).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
        };
        component.is_empty() || self.components.iter().all(is_within)
    }

    /// Whether an assignment changes some of these atoms of a datum of a type.
    pub(super) fn meets(&self, data_type: DataType, atoms: &Range<usize>) -> bool {
        self.components.iter().any(|it| {
            let components = it.split('.').filter(|part| !part.is_empty());
            let components: Vec<_> = components.map(Cow::Borrowed).collect();
            let own = atoms_of(data_type.described(), &components);
            own.start < atoms.end && atoms.start < own.end
        })
    }
}

struct Call<'m> {
    line: usize,
    to: Name,
    arguments: &'m Arguments<'static>,
}

#[derive(Default)]
pub(super) struct Effects<'m> {
    of_routines: BTreeMap<Name, Acts>,
    calls: BTreeMap<Name, Vec<Call<'m>>>,
    pub(super) assigned: BTreeMap<DatumId, Assigned>,
    /// The data that a routine assigns to which they are passed.
    pub(super) by_reference: BTreeSet<DatumId>,
    /// The data that traps and handlers assign: at a time that is not known.
    pub(super) interrupted: BTreeSet<DatumId>,
    /// The routines that were gone through for the data that others assign.
    pub(super) gone_through: Cell<usize>,
}

impl<'m> Effects<'m> {
    pub(super) fn of(names: &Index<'m>) -> Self {
        let mut effects = Self::default();
        let mut calls = BTreeMap::new();
        for (module, bodies) in names.bodies.iter().enumerate() {
            for (routine, body) in bodies {
                let name = (module, routine.clone());
                let mut reader = Reader::new(names, (module, routine), &mut effects.assigned);
                core::iter::once(&body.main)
                    .chain(&body.handlers)
                    .for_each(|block| reader.block(block));
                let Reader { acts, calls: own, .. } = reader;
                effects.of_routines.insert(name.clone(), acts);
                calls.insert(name, own);
            }
        }
        effects.pass_on(names, &calls);
        effects.calls = calls;
        effects.interrupted = effects.of_interrupts(names);
        effects
    }

    fn of_interrupts(&self, names: &Index<'_>) -> BTreeSet<DatumId> {
        let (mut found, mut called) = (BTreeSet::new(), Vec::new());
        for (module, bodies) in names.bodies.iter().enumerate() {
            for (routine, body) in bodies {
                let trap = names.is_trap(module, routine).then_some(&body.main);
                for block in body.handlers.iter().chain(trap) {
                    let (own, calls, _) = self.of_statements(names, (module, routine), block);
                    found.extend(own);
                    called.extend(calls);
                }
            }
        }
        found.extend(self.assigned_by(&called, usize::MAX).unwrap_or_default());
        found
    }

    pub(super) fn of_routine(&self, module: usize, lower: &str) -> Option<&Acts> {
        self.of_routines.get(&(module, String::from(lower)))
    }

    /// The data, perhaps any, and the names of locals that a block of a routine assigns.
    pub(super) fn of_block(
        &self,
        names: &Index<'_>,
        place: (usize, &str),
        block: &Block<'_>,
    ) -> (Option<BTreeSet<DatumId>>, BTreeSet<String>) {
        let (own, called, locals) = self.of_statements(names, place, block);
        let others = self.assigned_by(&called, MOST_CALLED);
        (others.map(|others| own.into_iter().chain(others).collect()), locals)
    }

    /// The data that a block of a routine assigns by itself, the routines that it calls, and the
    /// names of locals that it assigns.
    fn of_statements(
        &self,
        names: &Index<'_>,
        (module, routine): (usize, &str),
        block: &Block<'_>,
    ) -> (BTreeSet<DatumId>, Vec<Name>, BTreeSet<String>) {
        let mut assigned = BTreeMap::new();
        let mut reader = Reader::new(names, (module, routine), &mut assigned);
        reader.block(block);
        let Reader { mut acts, calls, mut locals, .. } = reader;
        let mut called = Vec::new();
        for call in calls {
            let Some(of) = self.of_routines.get(&call.to) else { continue };
            let parameters = names.parameters(call.to.0, &call.to.1);
            for passed in call.assigned(parameters, of) {
                acts.own.extend(names.datum(module, &passed).map(|(datum, _)| datum));
                locals.insert(passed);
            }
            called.push(call.to);
        }
        locals.extend(acts.assigned_parameters);
        (acts.own, called, locals)
    }

    /// The data that routines assign, with the ones that they call; `None` if these are more than
    /// `most`.
    pub(super) fn assigned_by(&self, called: &[Name], most: usize) -> Option<BTreeSet<DatumId>> {
        let (mut found, mut seen) = (BTreeSet::new(), BTreeSet::new());
        let mut open: Vec<&Name> = called.iter().collect();
        while let Some(name) = open.pop() {
            if !seen.insert(name) {
                continue;
            }
            self.gone_through.update(|count| count + 1);
            let Some(acts) = self.of_routines.get(name).filter(|acts| acts.assigns) else {
                continue;
            };
            if seen.len() + open.len() + found.len() + acts.own.len() > most {
                return None;
            }
            found.extend(&acts.own);
            open.extend(self.calls.get(name).into_iter().flatten().map(|call| &call.to));
        }
        Some(found)
    }

    /// Add what called routines do to those that call them.
    fn pass_on(&mut self, names: &Index<'_>, calls: &BTreeMap<Name, Vec<Call<'_>>>) {
        for _ in 0..PASSES {
            let mut has_changed = false;
            for (name, own) in calls {
                let Some(mut acts) = self.of_routines.get(name).cloned() else { continue };
                for call in own {
                    let Some(of) = self.of_routines.get(&call.to) else { continue };
                    acts.moves |= of.moves;
                    acts.assigns |= of.assigns;
                    let parameters = names.parameters(call.to.0, &call.to.1);
                    for passed in call.assigned(parameters, of) {
                        let (module, routine) = name;
                        let is_local = names.local(*module, routine, &passed).is_some();
                        let own = names.parameters(*module, routine);
                        let is_parameter = own.iter().any(|it| it.name == passed);
                        if is_parameter {
                            acts.assigned_parameters.insert(passed);
                        } else if let Some((datum, _)) =
                            names.datum(*module, &passed).filter(|_| !is_local)
                        {
                            acts.assigns = true;
                            acts.own.insert(datum);
                            self.by_reference.insert(datum);
                            add(&mut self.assigned, datum, (*module, call.line), String::new());
                        }
                    }
                }
                if self.of_routines.get(name) != Some(&acts) {
                    self.of_routines.insert(name.clone(), acts);
                    has_changed = true;
                }
            }
            if !has_changed {
                return;
            }
        }
    }
}

impl Call<'_> {
    /// The names that the called routine assigns.
    fn assigned<'a>(
        &'a self,
        parameters: &'a [Parameter],
        acts: &'a Acts,
    ) -> impl Iterator<Item = String> {
        let Arguments { required, optional } = self.arguments;
        let required = parameters.iter().filter(|it| !it.is_optional).zip(required);
        let optional = optional.iter().filter_map(|own| {
            Some((parameters.iter().find(|it| own.is(&it.name))?, own.value.as_ref()?))
        });
        let is_assigned =
            |it: &Parameter| it.is_reference && acts.assigned_parameters.contains(&it.name);
        let assigned = required.chain(optional).filter(move |(it, _)| is_assigned(it));
        assigned.filter_map(|(_, passed)| Some(passed.referred()?.0))
    }
}

/// A reader of what one routine does by itself.
struct Reader<'e, 'm> {
    names: &'e Index<'m>,
    module: usize,
    routine: &'e str,
    parameters: &'e [Parameter],
    acts: Acts,
    calls: Vec<Call<'m>>,
    /// Assigned data of the routine.
    locals: BTreeSet<String>,
    assigned: &'e mut BTreeMap<DatumId, Assigned>,
}

/// The name in lower case that a move writes to.
pub(super) fn written_by(step: &Move) -> Option<String> {
    let place = written_argument(&step.instruction)?.checked_sub(1)?;
    let argument = step.extra.iter().find(|it| it.place == place)?;
    let is_of_name = |c: char| c.is_alphanumeric() || c == '_';
    Some(argument.text.split(|c| !is_of_name(c)).next()?.to_lowercase())
}

/// Whether the robot may be moved by hand behind an instruction, or by it: of an add-in, or unknown.
pub(super) fn releases(names: &Index<'_>, module: usize, instruction: &Instruction) -> bool {
    let Some(name) = &instruction.name else { return true };
    let is_known = names.procedure(module, name).is_some() || Entry::instruction(name).is_some();
    instruction.effect == Effect::Stops || name == "setleadthrough" || !is_known
}

fn add(
    all: &mut BTreeMap<DatumId, Assigned>,
    datum: DatumId,
    by: (usize, usize),
    components: String,
) {
    let none = || Assigned { by, components: BTreeSet::new() };
    let assigned = all.entry(datum).or_insert_with(none);
    assigned.by = assigned.by.min(by);
    assigned.components.insert(components);
}

impl<'e, 'm> Reader<'e, 'm> {
    fn new(
        names: &'e Index<'m>,
        (module, routine): (usize, &'e str),
        assigned: &'e mut BTreeMap<DatumId, Assigned>,
    ) -> Self {
        let parameters = names.parameters(module, routine);
        let (acts, calls, locals) = (Acts::default(), Vec::new(), BTreeSet::new());
        Self { names, module, routine, parameters, acts, calls, locals, assigned }
    }

    fn block(&mut self, block: &Block<'m>) {
        for node in nodes(block) {
            match node {
                Node::Setting(_) => self.acts.moves = true,
                Node::Move(_, step) => {
                    self.acts.moves = true;
                    if let Some(name) = written_by(step) {
                        self.assign(&name, String::new(), step.line);
                    }
                }
                Node::Other(statement) => self.statement(statement.line, &statement.kind),
                Node::Branches { .. } | Node::Loop { .. } => {}
            }
        }
    }

    fn statement(&mut self, line: usize, kind: &'m StatementKind) {
        match kind {
            StatementKind::Unfinished { .. } | StatementKind::Invalid { .. } => {
                self.acts.moves = true;
            }
            StatementKind::Assignment(assignment) => {
                let (name, components) = &assignment.to;
                self.assign(name, components.clone(), line);
            }
            StatementKind::Instruction(instruction) => {
                self.acts.moves |= matches!(
                    instruction.effect,
                    Effect::Moves | Effect::Displaces(_) | Effect::Offsets(_) | Effect::Sets
                );
                self.acts.assigns |= releases(self.names, self.module, instruction);
                if let Some((name, components)) = &instruction.written {
                    self.assign(name, components.clone(), line);
                }
                self.call(instruction, line);
            }
            _ => {}
        }
    }

    fn assign(&mut self, name: &str, components: String, line: usize) {
        if self.names.local(self.module, self.routine, name).is_some() {
            self.locals.insert(name.into());
            return;
        }
        if self.parameters.iter().any(|it| it.name == name) {
            self.acts.assigned_parameters.insert(name.into());
        } else if let Some((datum, _)) = self.names.datum(self.module, name) {
            self.acts.assigns = true;
            self.acts.own.insert(datum);
            add(self.assigned, datum, (self.module, line), components);
        }
    }

    fn call(&mut self, instruction: &'m Instruction, line: usize) {
        let Some(name) = &instruction.name else {
            // A call by a name that is calculated may do anything.
            self.acts.moves = true;
            return;
        };
        let Some(home) = self.names.procedure(self.module, name) else { return };
        let to = (home, name.clone());
        self.calls.push(Call { line, to, arguments: &instruction.arguments });
    }
}
