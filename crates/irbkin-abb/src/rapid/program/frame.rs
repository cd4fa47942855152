//! The routine that is followed, and the call that it belongs to.

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use core::ops::Range;

use super::state::State;
use crate::rapid::data::moves::Move;
use crate::rapid::data::unread::Reason;
use crate::rapid::data::value::DataType;

/// The call that a routine's moves are placed at where they depend on its arguments.
#[derive(Clone)]
pub(super) struct Site {
    pub(super) module: usize,
    pub(super) line: usize,
    pub(super) column: usize,
    pub(super) routine: Option<String>,
    /// The routine that it calls, as it is written.
    pub(super) called: String,
}

/// The routine that is followed.
#[derive(Clone, Default)]
pub(super) struct Frame {
    pub(super) module: usize,
    /// Its name in lower case.
    pub(super) routine: String,
    pub(super) site: Option<Site>,
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
    /// The text of its arguments, with their modules and bytes, by the names of its parameters.
    pub(super) texts: BTreeMap<String, (String, usize, Range<usize>)>,
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
                let text = self.texts.get(&name.to_lowercase()).map(|(text, ..)| text.clone());
                Reason::Reference { name: text.unwrap_or(name), why }
            }
            reason => reason,
        }
    }

    /// Place a move at the call that it depends on.
    pub(super) fn place(&self, site: &Site, step: &mut Move) {
        (step.line, step.column) = (site.line, site.column);
        step.routine.clone_from(&site.routine);
        step.instruction.clone_from(&site.called);
        step.target.span = 0..0;
        if let Some((text, module, span)) = self.texts.get(&step.target.text.to_lowercase()) {
            step.target.text.clone_from(text);
            if *module == site.module {
                step.target.span = span.clone();
            }
        }
    }
}
