//! Values at a place of a program: names looked up, arguments evaluated, assignments made.

use alloc::collections::BTreeMap;
use core::cell::{Cell, RefCell};
use core::ops::Range;

use super::cases::{Choices, Known, MOST_CASES, Questions, saved_value};
use super::index::DatumId;
use super::state::{Displacement, Frame, State};
use super::tree::Part;
use super::whole::Program;
use crate::prelude::*;
use crate::rapid::calc::wrong::not_solved;
use crate::rapid::data::expression::{Call, Expression, Form, Name};
use crate::rapid::data::finding::{Code, Finding};
use crate::rapid::data::module::{Content, Datum, Storage};
use crate::rapid::data::moves::Target;
use crate::rapid::data::records::GivenTools;
use crate::rapid::data::statement::{Assignment, Condition};
use crate::rapid::data::types::{Atoms, Record};
use crate::rapid::data::unread::{Reason, Unresolved};
use crate::rapid::data::value::{DataType, Value};
use crate::rapid::expression::evaluate::{Evaluator, Stop, positive_whole};
use crate::rapid::expression::names::{At, By, Cause, Lookup, Names, Question, lower, predefined};
use crate::rapid::expression::reader::ExpressionReader;
use crate::rapid::text::fault::{RapidFault, RapidFaultKind};
use crate::rapid::text::place::Place;
use crate::rapid::text::tokens::Tokens;
use crate::rapid::text::words::words_of;

pub(super) trait Calls {
    /// What a function of the program returns, as it is called in a text.
    fn returned(&self, text: &str, call: &Call<'_>) -> Option<Known>;

    /// The number of a question that is asked once.
    fn question(&self) -> usize;
}

/// The names that a place sees, with what is known there.
pub(super) struct Scope<'s, 'm> {
    pub(super) calls: &'s dyn Calls,
    pub(super) program: &'s Program<'m>,
    pub(super) state: &'s State,
    pub(super) frame: &'s Frame,
    /// Whether a PERS that the program assigns has its saved value, which the text has.
    pub(super) takes_last: Cell<bool>,
    /// The tools for those that nothing declares.
    pub(super) tools: Option<&'s GivenTools>,
    pub(super) choices: Choices,
    /// What calls of functions return, by their texts.
    pub(super) returned: RefCell<BTreeMap<String, Option<Known>>>,
    /// The open questions of the state, and those of this scope.
    pub(super) asked: RefCell<Questions>,
}

/// Words of conditions beside names and numbers.
const STEADY_WORDS: [&str; 16] = [
    "if", "elseif", "else", "then", "test", "case", "default", "and", "or", "xor", "not", "div",
    "mod", "true", "false", "present",
];

impl Names for Scope<'_, '_> {
    fn find(&self, _: At, name: &str) -> Lookup<'_> {
        let lower = lower(name);
        let module = self.frame.module;
        let known = |content| Lookup::Datum { content, can_change: false, cause: None };
        let chosen = |several| {
            let content = self.choices.content(several);
            content.map_or(Lookup::Unknown(Unresolved::ValueNotKnown), known)
        };
        match self.state.locals.get(&*lower).map(|local| &local.content) {
            Some(Ok(several)) => return chosen(several),
            Some(Err(why)) => return Lookup::Unknown(why.clone()),
            None => {}
        }
        let Some((id, datum)) = self.program.datum(module, &lower) else {
            if let Some(part) = self.program.part(module, &lower) {
                return known(&part.content);
            }
            if let Some(why) = self.program.unread(module, &lower) {
                return Lookup::Unknown(why.clone());
            }
            return predefined(&lower).map_or(Lookup::NotHere, Lookup::Predefined);
        };
        if let Some(several) = self.state.globals.get(&id) {
            return chosen(several);
        }
        match self.cause(id, datum) {
            Err(_) if self.is_saved(datum) => known(&datum.content),
            Ok(cause) => Lookup::Datum { content: &datum.content, can_change: false, cause },
            Err(why) => Lookup::Unknown(why),
        }
    }

    fn cause_of<'c>(
        &'c self,
        _: At,
        name: &str,
        atoms: Range<usize>,
        cause: Cause<'c>,
    ) -> Option<Cause<'c>> {
        let (id, datum) = self.program.datum(self.frame.module, &lower(name))?;
        let assigned = self.program.effects.assigned.get(&id)?;
        let is_open = assigned.meets(datum.data_type, &atoms) && !self.is_saved(datum);
        is_open.then_some(cause)
    }

    fn returned(&self, text: &str, expression: &Expression<'_>) -> Option<Value> {
        let Form::Call(call) = &expression.form else { return None };
        let own = text.get(expression.start..expression.end)?;
        let before = self.returned.borrow().get(own).cloned();
        let known = before.unwrap_or_else(|| {
            let known = self.calls.returned(text, call);
            self.returned.borrow_mut().insert(own.to_string(), known.clone());
            known
        });
        match self.choices.content(&known?)? {
            Content::Single(value) => Some(value.clone()),
            _ => None,
        }
    }

    fn element(&self, index: &str, size: usize) -> Option<usize> {
        if size > MOST_CASES {
            return None;
        }
        let question = self.question(index);
        let element = self
            .choices
            .answer(question, size, |from_zero| format!("{} is {}", index.trim(), from_zero + 1));
        element.filter(|element| *element < size)
    }

    fn ask(&self, function: &str, question: Question) -> Result<Target, Reason> {
        let refused = |code, words| Reason::Robot { name: function.to_string(), code, words };
        let unknown = |why: &str| refused(Code::UnknownValue, why.to_string());
        let State { displacement, offsets, place, settings, .. } = self.state;
        if (displacement, offsets) != (&Displacement::Nothing, &Ok([0.0; 6])) {
            return Err(unknown("targets are displaced"));
        }
        let (target, at, to) = match question {
            Question::Here(to) => {
                let (target, at) = place.as_deref().map_err(|why| unknown(why))?.clone();
                let are_calculated = to.is_none() && matches!(target, Target::RobTarget(_));
                if are_calculated && !(settings.conf_l && settings.conf_j) {
                    return Err(unknown("ConfL or ConfJ is off"));
                }
                let to =
                    to.map(|(tool, wobj)| (tool.unwrap_or(at.0), wobj.unwrap_or(at.1.clone())));
                (target, at, to)
            }
            Question::Converted(target, at) => {
                let to = matches!(target, Target::JointTarget(_)).then(|| at.clone());
                (target, at, to)
            }
        };
        (self.program.convert)(&target, &at, to.as_ref()).map_err(|error| {
            let Finding { code, message, .. } = not_solved(&error);
            refused(code, message)
        })
    }
}

impl<'s> Scope<'s, '_> {
    /// The number of the question what a text is here.
    pub(super) fn question(&self, text: &str) -> usize {
        let key = self.frame.question(text);
        if let Some(number) = self.asked.borrow().number(&key) {
            return number;
        }
        let number = self.calls.question();
        // Until something is assigned to it, a word means the same that is no signal, no function.
        let is_steady = |word: &str| {
            let lower = lower(word);
            word.starts_with(|c: char| c.is_ascii_digit())
                || STEADY_WORDS.contains(&&*lower)
                || self.state.locals.contains_key(&*lower)
                || self.program.datum(self.frame.module, &lower).is_some()
        };
        if words_of(text).all(is_steady) {
            let words = words_of(text).map(str::to_lowercase).collect();
            self.asked.borrow_mut().add(key, words, number);
        }
        number
    }

    /// Why the declared content of a datum, or a part of it, may not be what it has here; an error
    /// if it is declared by an expression of data that are assigned.
    fn cause(&self, id: DatumId, datum: &'s Datum) -> Result<Option<Cause<'s>>, Unresolved> {
        if datum.storage == Storage::Const {
            return Ok(None);
        }
        if let Some(assigned) = self.program.effects.assigned.get(&id) {
            let (module, line) = assigned.by;
            let of = self.program.modules.get(module);
            let by = if module == self.frame.module {
                By::Line(line)
            } else {
                By::Module(of.and_then(|it| it.name()), Some(line))
            };
            return Ok(Some(Cause { name: &datum.name, by }));
        }
        let home = self.program.modules.get(id.module);
        let is_expression = home.is_some_and(|it| it.expressions.contains_key(&id.datum));
        if is_expression { Err(Unresolved::ValueNotKnown) } else { Ok(None) }
    }

    /// Whether a datum that the program assigns has its saved value, which is taken then.
    fn is_saved(&self, datum: &Datum) -> bool {
        let is_saved = self.takes_last.get() && datum.storage == Storage::Pers;
        if is_saved {
            self.choices.assume(|| saved_value(&datum.name));
        }
        is_saved
    }

    fn evaluator<'a>(&'s self, text: &'a str) -> Evaluator<'s, 'a> {
        Evaluator {
            text,
            near: Place::BEGINNING,
            names: self,
            at: At::default(),
            thing: ("", ""),
            constant: false,
            at_move: true,
        }
    }

    pub(super) fn record<T: Record>(&self, text: &str) -> Result<T, Reason> {
        self.evaluate(text, &argument(text)?)
    }

    pub(super) fn value(
        &self,
        text: &str,
        expression: &Expression<'_>,
        data_type: DataType,
    ) -> Result<Value, Reason> {
        known(self.evaluator(text).value(expression, data_type))
    }

    pub(super) fn evaluate<T: Record>(
        &self,
        text: &str,
        expression: &Expression<'_>,
    ) -> Result<T, Reason> {
        known(self.evaluator(text).record(expression))
    }

    /// The parts of a branch that may be executed here, by their index; their number for none.
    pub(super) fn open(
        &self,
        tested: Option<(&str, &Expression<'_>)>,
        parts: &[Part<'_>],
    ) -> Vec<usize> {
        let mut open = Vec::new();
        for (index, part) in parts.iter().enumerate() {
            let holds = self.holds(tested, &part.head.text, part.condition);
            if holds != Some(false) {
                open.push(index);
            }
            if holds == Some(true) {
                return open;
            }
        }
        open.push(parts.len());
        open
    }

    /// Whether a condition holds here, by arguments, by what was assigned, and by constants.
    pub(super) fn holds(
        &self,
        tested: Option<(&str, &Expression<'_>)>,
        text: &str,
        condition: &Condition,
    ) -> Option<bool> {
        match condition {
            Condition::Always => Some(true),
            Condition::Never => Some(false),
            Condition::Present(name, is_wanted) => {
                let is_there = self.frame.present.contains(name);
                (is_there || self.frame.absent.contains(name)).then_some(is_there == *is_wanted)
            }
            Condition::Compared(numbers, relation) => {
                let [left, right] = numbers.each_ref().map(|it| self.certain_number(text, it));
                Some(relation.holds(left?, right?))
            }
            Condition::Case(numbers) => {
                let (head, own) = tested?;
                let own = self.certain_number(head, own)?;
                let numbers = numbers.iter().map(|it| self.certain_number(text, it));
                let numbers: Vec<f64> = numbers.collect::<Option<_>>()?;
                Some(numbers.iter().any(|number| number.total_cmp(&own).is_eq()))
            }
            Condition::Other(_) => None,
        }
    }

    /// The number that an expression is here, unless a declared value counts that may be another
    /// one when the program starts.
    fn certain_number(&self, text: &str, expression: &Expression<'_>) -> Option<f64> {
        let mut names = Vec::new();
        expression.collect_names(&mut names);
        let is_certain = |name: &Name<'_>| {
            let lower = lower(name);
            let datum = self.program.datum(self.frame.module, &lower);
            self.state.locals.contains_key(&*lower)
                || datum.is_none_or(|(id, datum)| match datum.storage {
                    Storage::Const => true,
                    Storage::Var => self.state.globals.contains_key(&id),
                    // Another task may assign it.
                    Storage::Pers => false,
                })
        };
        if !names.iter().all(is_certain) {
            return None;
        }
        self.evaluate(text, expression).ok().filter(|_| !self.choices.is_assumed())
    }

    /// Whether what the declarations say of a text may not hold: it is passed to a routine that
    /// assigns it.
    pub(super) fn is_stale(&self, text: &str) -> bool {
        let effects = &self.program.effects;
        !effects.by_reference.is_empty()
            && words_of(text).any(|word| {
                let datum = self.program.datum(self.frame.module, &lower(word));
                datum.is_some_and(|(id, _)| effects.by_reference.contains(&id))
            })
    }

    /// The content of the datum or the local that a statement assigns, behind it; `None` if it is
    /// not known there.
    pub(super) fn assigned(
        &self,
        text: &str,
        Assignment { target, value, to: (lower, of_components), .. }: &Assignment,
    ) -> Option<Content> {
        let (_, indices, components) = target.reference()?;
        let (data_type, content, is_array) = if let Some(local) = self.state.locals.get(lower) {
            let content = local.content.as_ref().ok().and_then(|it| self.choices.content(it));
            (local.data_type, content, matches!(content, Some(Content::Array { .. })))
        } else {
            let (id, datum) = self.program.datum(self.frame.module, lower)?;
            let assigned = self.program.effects.assigned.get(&id);
            let is_declared =
                indices.is_empty() && assigned.is_some_and(|it| it.are_within(of_components));
            let declared = Some(&datum.content).filter(|_| is_declared);
            let is_single = match &datum.content {
                Content::Uninitialized { sizes } => sizes.is_empty(),
                content => matches!(content, Content::Single(_)),
            };
            let known = self.state.globals.get(&id);
            let saved = || self.is_saved(datum).then_some(&datum.content);
            let content = known.map_or(declared, |known| self.choices.content(known));
            let is_part = !indices.is_empty() || !components.is_empty();
            let content = if is_part { content.or_else(saved) } else { content };
            (Some(datum.data_type), content, !is_single)
        };
        let data_type = data_type?;
        let part = self.part(text, value, data_type, components)?;
        if indices.is_empty() && components.is_empty() {
            return Value::of(data_type, part).filter(|_| !is_array).map(Content::Single);
        }
        let mut content = content?.clone();
        let place = match &mut content {
            Content::Single(value) if indices.is_empty() => value,
            Content::Array { sizes, values } if sizes.len() == indices.len() => {
                let mut element = 0;
                for (index, size) in indices.iter().zip(sizes.iter()) {
                    let index = positive_whole(self.evaluate(text, index).ok()?);
                    element = element * size + index.filter(|index| index <= size)? - 1;
                }
                values.get_mut(element)?
            }
            _ => return None,
        };
        let (_, begin) = data_type.described().part(components)?;
        let mut atoms = place.atoms();
        for (own, new) in atoms.get_mut(begin..)?.iter_mut().zip(part) {
            *own = new;
        }
        *place = Value::of(data_type, atoms)?;
        Some(content)
    }

    /// The whole array that an expression refers to.
    pub(super) fn whole(&self, expression: &Expression<'_>) -> Option<Content> {
        let Form::Name(name) = &expression.form else { return None };
        match self.find(At::default(), name) {
            Lookup::Datum { content: content @ Content::Array { .. }, cause: None, .. } => {
                Some(content.clone())
            }
            _ => None,
        }
    }

    /// The atoms of a value for a component of a type.
    fn part(
        &self,
        text: &str,
        value: &Expression<'_>,
        data_type: DataType,
        components: &[Name<'_>],
    ) -> Option<Atoms> {
        let (of, _) = data_type.described().part(components)?;
        known(self.evaluator(text).atoms(value, of)).ok()
    }
}

pub(super) fn argument(text: &str) -> Result<Expression<'_>, Reason> {
    let invalid = |_| Reason::NoAggregate;
    let mut tokens = Tokens::new(text).map_err(invalid)?;
    ExpressionReader::new(&mut tokens).argument().map_err(invalid)
}

/// A value, or why it is unknown; text that is not as RAPID has it is unknown, too.
fn known<T>(value: Result<T, Stop>) -> Result<T, Reason> {
    value.map_err(|stop| match stop {
        Stop::Unknown(reason) => reason,
        Stop::Fault(RapidFault { kind: kind @ RapidFaultKind::Index { .. }, .. }) => {
            Reason::NoSuchElement { fault: kind.to_string() }
        }
        Stop::Fault(_) => Reason::NoAggregate,
    })
}
