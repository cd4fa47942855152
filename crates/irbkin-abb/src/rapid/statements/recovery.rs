//! Going on behind a fault, in a text that is read in spite of its faults.

use super::reader::StatementReader;
use crate::prelude::*;
use crate::rapid::data::statement::{Flow, StatementKind};
use crate::rapid::text::fault::{RapidFault, RapidFaultKind};
use crate::rapid::text::place::excerpt;
use crate::rapid::text::skipping::{at_line, end_of_line, is_conflict_marker, next_statement};
use crate::rapid::text::tokens::{Token, TokenKind, Tokens};
use crate::rapid::text::words::ends_with;

impl StatementReader<'_> {
    /// Keep a fault, to go on as if it were none.
    pub(super) fn complain(&mut self, fault: RapidFault) -> Result<(), RapidFault> {
        self.written.faults.add(fault)
    }

    /// Go on behind a fault in the statement that begins with a token.
    pub(super) fn recover(&mut self, first: Token, fault: RapidFault) -> Result<(), RapidFault> {
        let words = fault.kind.to_string();
        // The bracket may have been meant to close on its line. Text that was read is not read
        // again for each of many faults.
        let is_open =
            matches!(fault.kind, RapidFaultKind::Unclosed { .. }) && !self.written.faults.is_full();
        self.complain(fault)?;
        let text = self.tokens.text;
        let from = if is_open { first.start } else { first.start.max(self.tokens.last_end) };
        let at_line = at_line(&self.tokens).filter(|at| !is_open && *at > first.start);
        let resumed = at_line.unwrap_or_else(|| next_statement(text, from));
        let end = first.start + text[first.start..resumed].trim_end().len();
        self.tokens.resume(end);
        let word = self.tokens.text_of(first);
        let kind = match self.opened(first, end) {
            Some(flow) => StatementKind::Flow { word: word.to_ascii_uppercase(), flow },
            None => StatementKind::Invalid { statement: excerpt(word), fault: words },
        };
        if end > first.start {
            self.add(first, kind);
        }
        self.tokens.resume(resumed);
        Ok(())
    }

    /// Open the block that an invalid statement begins, if it does.
    fn opened(&mut self, first: Token, end: usize) -> Option<Flow> {
        let (word, text) = (self.tokens.text_of(first), &self.tokens.text[first.start..end]);
        let is = |other: &str| word.eq_ignore_ascii_case(other);
        let begins = is("IF") && ends_with(text, "THEN")
            || (is("FOR") || is("WHILE")) && ends_with(text, "DO")
            || is("TEST") && !text.ends_with(';');
        if begins { self.written.blocks.open(word) } else { None }
    }

    /// Report and close what is open where something else begins.
    pub(super) fn close_all(&mut self) -> Result<(), RapidFault> {
        let block = self.written.blocks.innermost().map(|(_, end)| end);
        let routine = || self.current_routine().map(|routine| routine.kind.end());
        if let Some(end) = block.or_else(routine) {
            self.complain(self.tokens.unexpected(end))?;
            self.close_blocks(0, self.tokens.peek().start);
            self.leave_routine();
        }
        Ok(())
    }

    /// Close all blocks but the outer ones, as if their ends were in the text before a byte.
    pub(super) fn close_blocks(&mut self, outer: usize, before: usize) {
        while self.written.blocks.depth() > outer {
            let Some(end) = self.written.blocks.close_innermost() else { return };
            let kind = StatementKind::Flow { word: end.to_string(), flow: Flow::End };
            self.add_at(before, kind, end.to_string());
        }
    }

    pub(super) fn conflict_marker(&mut self) -> Result<bool, RapidFault> {
        let start = self.tokens.peek().start;
        if !is_conflict_marker(self.tokens.text, start) {
            return Ok(false);
        }
        self.complain(self.tokens.fault(start, RapidFaultKind::ConflictMarker))?;
        self.tokens.resume(end_of_line(self.tokens.text, start));
        Ok(true)
    }
}

/// Whether the text ends or something begins that is in no routine and in no record.
pub(super) fn begins_other(tokens: &Tokens<'_>) -> bool {
    let others = ["MODULE", "ENDMODULE", "PROC", "FUNC", "TRAP", "RECORD"];
    tokens.peek().kind == TokenKind::End || others.iter().any(|other| tokens.at_word(other))
}
