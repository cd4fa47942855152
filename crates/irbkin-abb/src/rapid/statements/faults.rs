//! The faults of a text, and texts that are none.

use crate::prelude::*;
use crate::rapid::text::fault::RapidFault;
use crate::rapid::text::skipping::at_line;
use crate::rapid::text::tokens::Tokens;
use irbkin::Interrupt;

const MOST_FAULTS: usize = 100;

/// The faults of a text. Without tolerance the first one ends the reading.
#[doc(hidden)]
#[derive(Default)]
pub struct Faults<'a> {
    pub(crate) is_tolerant: bool,
    /// Ends the reading, too.
    pub(crate) interrupt: Interrupt<'a>,
    pub(crate) kept: Vec<RapidFault>,
}

impl<'a> Faults<'a> {
    #[doc(hidden)]
    pub fn new(is_tolerant: bool, interrupt: Interrupt<'a>) -> Self {
        Self { is_tolerant, interrupt, kept: Vec::new() }
    }

    /// Keep a fault, to go on behind it.
    pub(crate) fn add(&mut self, fault: RapidFault) -> Result<(), RapidFault> {
        if !self.is_tolerant {
            return Err(fault);
        }
        if !self.is_full() {
            self.kept.push(fault);
        }
        Ok(())
    }

    pub(crate) fn is_full(&self) -> bool {
        self.kept.len() >= MOST_FAULTS
    }
}

/// Read the semicolon of a statement. If the next token begins another line, the one that lacks is
/// taken to be at the end of this one.
pub(super) fn end_statement(
    tokens: &mut Tokens<'_>,
    faults: &mut Faults<'_>,
    wanted: &'static str,
) -> Result<(), RapidFault> {
    match tokens.demand(b';', wanted) {
        Err(fault) if at_line(tokens).is_some() => faults.add(fault),
        other => other,
    }
}

/// Whether a text is what an encoded module looks like: it does not begin in ASCII, and has control
/// characters among its first ones.
pub(crate) fn is_encoded(text: &str) -> bool {
    let text = text.trim_start_matches('\u{feff}').trim_start();
    let begin = || text.trim_end_matches(['\0', '\u{1a}']).chars().take(16);
    let is_control = |it: char| it.is_control() && !it.is_ascii_whitespace();
    let is_text =
        text.starts_with('!') || begin().take(4).all(|it| it.is_ascii() && !is_control(it));
    !is_text && begin().any(is_control)
}
