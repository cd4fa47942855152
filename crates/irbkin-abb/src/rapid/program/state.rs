//! The knowledge at a place of a program: values, settings, displacements, where the robot is.

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::rc::Rc;
use core::cell::Cell;
use core::ops::Range;

use super::cases::{Case, Known, Questions};
use super::index::DatumId;
use super::whole::Program;
use crate::prelude::*;
use crate::rapid::data::module::Content;
use crate::rapid::data::moves::{Move, Target};
use crate::rapid::data::records::RapidPose;
use crate::rapid::data::settings::MotionSettings;
use crate::rapid::data::unread::{Reason, Unresolved};
use crate::rapid::data::value::{DataType, Value};
use crate::rapid::expression::names::ToolIn;

/// Most assigned data, and most names of a routine, whose contents are followed: copies at branches
/// stay small.
pub(super) const MOST_KNOWN: usize = 1000;

/// Where the robot is.
#[derive(Clone, PartialEq)]
pub(super) enum Here {
    Unknown,
    /// After so many steps of a run.
    After(usize, usize),
    /// In each case after so many steps of a run.
    OneOf(Rc<Vec<(Case, usize, usize)>>),
    /// Nowhere: the routine was left.
    Left,
}

/// Where the robot is, or why that is unknown; while ConfL or ConfJ is off with the written confdata.
pub(super) type Place = Result<Rc<(Target, ToolIn)>, &'static str>;

#[derive(Clone, Copy, PartialEq)]
pub(super) enum Displacement {
    Nothing,
    /// A pose in the work object, from which the targets are seen, set on a line.
    Known(RapidPose, usize),
    /// Set by the instruction on a line, with values that are not known.
    Unknown(usize),
}

/// The offsets of external axes [deg or mm], or the line of the instruction that sets unknown ones.
pub(super) type Offsets = Result<[f64; 6], usize>;

/// A datum or a parameter of a routine.
#[derive(Clone, PartialEq)]
pub(super) struct Local {
    /// `None` for a type that is not read.
    pub(super) data_type: Option<DataType>,
    /// What is known of its content here, or why nothing is.
    pub(super) content: Result<Known, Unresolved>,
}

impl Local {
    pub(super) fn single(value: Value) -> Self {
        let data_type = Some(value.data_type());
        Self { data_type, content: Ok(Known::certain(Content::Single(value), "")) }
    }

    pub(super) fn size(&self) -> usize {
        self.content.as_ref().map_or(1, Known::size)
    }
}

/// The data and the parameters of a routine by their names in lower case.
pub(super) type Locals = BTreeMap<String, Local>;

/// The knowledge at a place.
#[derive(Clone, PartialEq)]
pub(super) struct State {
    pub(super) here: Here,
    pub(super) place: Place,
    pub(super) settings: MotionSettings,
    pub(super) displacement: Displacement,
    pub(super) offsets: Offsets,
    /// What displacement and offsets rest on that the program does not determine, in words.
    pub(super) assumed_shift: Option<Rc<str>>,
    /// Assigned data of which something is known here; all others are unknown.
    pub(super) globals: Rc<BTreeMap<DatumId, Known>>,
    pub(super) locals: Rc<Locals>,
    pub(super) asked: Questions,
}

impl State {
    /// At the beginning of a routine of which nothing is known.
    pub(super) fn new() -> Self {
        Self {
            here: Here::Unknown,
            place: Err("no move before it is known"),
            settings: MotionSettings::default(),
            displacement: Displacement::Nothing,
            offsets: Ok([0.0; 6]),
            assumed_shift: None,
            globals: Rc::default(),
            locals: Rc::default(),
            asked: Questions::default(),
        }
    }

    /// How many contents were copied since it was the other one: all or none.
    pub(super) fn copied(&self, other: &Self) -> usize {
        let globals =
            if Rc::ptr_eq(&self.globals, &other.globals) { 0 } else { self.globals.len() };
        let locals = if Rc::ptr_eq(&self.locals, &other.locals) { 0 } else { self.locals.len() };
        globals + locals
    }

    /// Give a datum another content, or none that is known.
    pub(super) fn set_global(&mut self, datum: DatumId, content: Option<Known>) {
        let content = content
            .filter(|_| self.globals.len() < MOST_KNOWN || self.globals.contains_key(&datum));
        if content.is_none() && !self.globals.contains_key(&datum) {
            return;
        }
        let globals = Rc::make_mut(&mut self.globals);
        match content {
            Some(content) => globals.insert(datum, content),
            None => globals.remove(&datum),
        };
    }

    /// Forget assigned data; all of them without a set.
    pub(super) fn forget_globals(&mut self, assigned: Option<&BTreeSet<DatumId>>) {
        self.asked = Questions::default();
        match assigned {
            None => self.globals = Rc::default(),
            Some(assigned) if self.globals.keys().any(|datum| assigned.contains(datum)) => {
                Rc::make_mut(&mut self.globals).retain(|datum, _| !assigned.contains(datum));
            }
            Some(_) => {}
        }
    }

    pub(super) fn forget_locals(&mut self, is_forgotten: impl Fn(&String) -> bool) {
        let known = self.locals.iter().filter(|(_, local)| local.content.is_ok());
        let lost: Vec<String> =
            known.map(|(name, _)| name).filter(|it| is_forgotten(it)).cloned().collect();
        for name in lost {
            if let Some(local) = Rc::make_mut(&mut self.locals).get_mut(&name) {
                local.content = Err(Unresolved::ValueNotKnown);
            }
        }
    }

    /// Keep what may be so in one of some cases.
    pub(super) fn assume(&mut self, cases: &[Case]) {
        if self.globals.values().any(|known| known.excludes(cases)) {
            let known = Rc::make_mut(&mut self.globals).values_mut();
            known.for_each(|known| known.assume(cases));
        }
        let known = |local: &Local| local.content.as_ref().is_ok_and(|known| known.excludes(cases));
        if self.locals.values().any(known) {
            let known = Rc::make_mut(&mut self.locals).values_mut();
            known.flat_map(|local| &mut local.content).for_each(|known| known.assume(cases));
        }
    }

    /// The knowledge behind parts that begin with `entry` and end with `ends`, of which one is
    /// executed, each with the answer to a question; `line` is theirs. And the number of values that
    /// depend on the answer.
    pub(super) fn joined(
        program: &Program<'_>,
        takes_last: bool,
        entry: Self,
        mut ends: Vec<(usize, Self)>,
        (question, line): (usize, usize),
    ) -> (Self, usize) {
        ends.retain(|(_, end)| end.here != Here::Left);
        let Some((_, mut all)) = ends.first().cloned() else {
            return (Self { here: Here::Left, ..entry }, 0);
        };
        for (_, end) in &ends[1..] {
            if end.here != all.here {
                all.here = Here::Unknown;
            }
            if end.place != all.place {
                all.place = Err("it depends on a branch, a loop or a label");
            }
            all.settings = lenient(all.settings, end.settings);
            if end.displacement != all.displacement {
                all.displacement = Displacement::Unknown(line);
            }
            if end.offsets != all.offsets {
                all.offsets = Err(line);
            }
            all.assumed_shift = all.assumed_shift.or_else(|| end.assumed_shift.clone());
            all.asked.keep_shared(&end.asked);
        }
        let depending = Cell::new(0);
        let behind = |parts: Vec<Option<Known>>, name: &str| {
            let parts: Vec<Known> = parts.into_iter().collect::<Option<_>>()?;
            if parts.iter().all(|part| part.is_always(&parts[0])) {
                return Some(
                    parts.iter().find(|part| part.is_assumed()).unwrap_or(&parts[0]).clone(),
                );
            }
            let parts = ends.iter().map(|(answer, _)| *answer).zip(&parts);
            let unchanged = || format!("{name} is unchanged on line {line}");
            let known = Known::joined(question, parts, unchanged)?;
            depending.update(|count| count + known.size());
            Some(known)
        };
        if ends.iter().any(|(_, end)| !Rc::ptr_eq(&all.globals, &end.globals)) {
            let saved = |datum: DatumId| program.saved(datum).filter(|_| takes_last);
            let of = |datum: DatumId| {
                let known = |(_, end): &(usize, Self)| end.globals.get(&datum).cloned();
                let parts = ends.iter().map(|end| known(end).or_else(|| saved(datum)));
                Some((datum, behind(parts.collect(), program.name(datum))?))
            };
            let data: BTreeSet<DatumId> =
                ends.iter().flat_map(|(_, end)| end.globals.keys().copied()).collect();
            all.globals = Rc::new(data.into_iter().filter_map(of).collect());
        }
        if ends.iter().any(|(_, end)| !Rc::ptr_eq(&all.locals, &end.locals)) {
            let known = Rc::make_mut(&mut all.locals).iter_mut();
            for (name, local) in known.filter(|(_, local)| local.content.is_ok()) {
                let known = |(_, end): &(usize, Self)| end.locals.get(name)?.content.clone().ok();
                let parts = ends.iter().map(known);
                local.content = behind(parts.collect(), name).ok_or(Unresolved::ValueNotKnown);
            }
        }
        (all, depending.get())
    }
}

/// Of two settings the ones with which less is wrong.
fn lenient(a: MotionSettings, b: MotionSettings) -> MotionSettings {
    let default = MotionSettings::default();
    let pick = |is_default| if is_default { b } else { a };
    MotionSettings {
        conf_l: a.conf_l && b.conf_l,
        conf_j: a.conf_j && b.conf_j,
        sing_area: pick(a.sing_area == default.sing_area).sing_area,
        cir_path_mode: pick(a.cir_path_mode == default.cir_path_mode).cir_path_mode,
    }
}

/// A call of a routine.
#[derive(Default)]
pub(in crate::rapid) struct Site {
    /// Its module, line and column.
    pub(in crate::rapid) place: (usize, usize, usize),
    pub(super) routine: Option<String>,
    /// The routine that it calls, as it is written.
    pub(super) called: String,
}

/// An argument as it is written, and the call whose text has it.
#[derive(Clone)]
pub(super) struct Text {
    pub(super) written: String,
    /// Its bytes; none if it refers to an argument of that call.
    pub(super) span: Range<usize>,
    pub(super) site: Rc<Site>,
}

/// The routine that is followed.
#[derive(Clone, Default)]
pub(super) struct Frame {
    pub(super) module: usize,
    /// Its name in lower case.
    pub(super) routine: String,
    /// The first of the calls that lead to it with arguments.
    pub(super) site: Option<Rc<Site>>,
    /// The number of the chain of calls that leads here, from 1; 0 of a routine that nothing calls.
    pub(super) chain: usize,
    /// The number of this call among all.
    pub(super) entry: usize,
    /// Of a function the type of what it returns.
    pub(super) result: Option<DataType>,
    /// The knowledge at each place where it was left.
    pub(super) exits: Vec<State>,
    /// Its optional parameters that no argument was given for, and its others that have one.
    pub(super) absent: BTreeSet<String>,
    pub(super) present: BTreeSet<String>,
    /// Its arguments by the names of its parameters.
    pub(super) texts: BTreeMap<String, Text>,
}

impl Frame {
    pub(super) fn of(module: usize, routine: String) -> Self {
        Self { module, routine, ..Self::default() }
    }

    /// The question what a text is in this call.
    pub(super) fn question(&self, text: &str) -> String {
        format!("{} {} {} {}", self.module, self.routine, self.entry, text.to_lowercase())
    }

    /// A reason with the text of an argument in the place of its parameter.
    pub(super) fn named(&self, reason: Reason) -> Reason {
        match reason {
            Reason::Reference { name, why } => {
                let text = self.texts.get(&name.to_lowercase()).map(|it| it.written.clone());
                Reason::Reference { name: text.unwrap_or(name), why }
            }
            reason => reason,
        }
    }

    /// The argument that a text is or, by its first name that is not one of a function, refers to.
    pub(super) fn argument(&self, text: &str) -> Option<Text> {
        let lower = text.to_lowercase();
        if let Some(argument) = self.texts.get(lower.as_str()) {
            return Some(argument.clone());
        }
        let is_delimiter = |it: char| !(it.is_alphanumeric() || it == '_');
        let mut words = lower.split_inclusive(is_delimiter);
        let named = words.find(|it| it.starts_with(char::is_alphabetic) && !it.ends_with('('))?;
        let site = self.texts.get(named.trim_end_matches(is_delimiter))?.site.clone();
        Some(Text { written: text.to_string(), span: 0..0, site })
    }

    /// Place a move, as it is written here, at the call whose text has its target, unless its own
    /// has it; the module of its place.
    pub(super) fn place(&self, written: &Move, step: &mut Move) -> usize {
        let target = self.argument(&written.target.text);
        let via = written.via.as_ref().and_then(|via| self.argument(&via.text));
        let Some(site) = target.as_ref().or(via.as_ref()).map(|it| it.site.clone()) else {
            return self.module;
        };
        let module;
        (module, step.line, step.column) = site.place;
        step.routine = site.routine.as_deref().map(Into::into);
        step.instruction = site.called.as_str().into();
        step.target_span = 0..0;
        if let Some(target) = target {
            step.target.text = target.written.into();
            step.target_span = target.span;
        }
        module
    }
}
