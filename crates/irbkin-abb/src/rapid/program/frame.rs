//! The routine that is followed, and the call that it belongs to.

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::format;
use alloc::rc::Rc;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::ops::Range;

use super::state::State;
use crate::rapid::data::moves::Move;
use crate::rapid::data::unread::Reason;
use crate::rapid::data::value::DataType;

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
