//! The beginnings and ends of routines, and their parameters.

use alloc::format;
use alloc::string::{String, ToString};

use super::declarations::read_name;
use super::reader::StatementReader;
use super::scopes::{Named, is_placeholder};
use crate::error::{RapidFault, RapidFaultKind};
use crate::rapid::data::module::{Routine, RoutineKind};
use crate::rapid::data::reason::Unresolved;
use crate::rapid::text::tokens::{Token, TokenKind};

impl StatementReader<'_> {
    pub(crate) fn begin_routine(
        &mut self,
        kind: RoutineKind,
        first: Token,
    ) -> Result<(), RapidFault> {
        if let Some(end) = self.expected_end() {
            return Err(self.tokens.unexpected(end));
        }
        self.tokens.take()?;
        if kind == RoutineKind::Func {
            read_name(&mut self.tokens, "the type of the function")?;
        }
        let name = read_name(&mut self.tokens, "the name of the routine")?;
        if is_placeholder(name) {
            return self.unfinished_routine(kind, name, first);
        }
        self.declare(first, name, Named::Other(Unresolved::Routine))?;
        let (line, column) = self.tokens.line_and_column(first.start);
        self.written.scopes.add_routine();
        self.written.routines.push(Routine {
            kind,
            name: name.to_string(),
            header: String::new(),
            line,
            column,
        });
        self.routine = self.written.routines.len();
        (self.displaced_by, self.settings) = Default::default();
        if self.tokens.peek().is(b'(') {
            self.parameters(name)?;
        }
        let header = self.written.text[first.start..self.tokens.last_end].to_string();
        if let Some(routine) = self.written.routines.last_mut() {
            routine.header = header;
        }
        Ok(())
    }

    /// Skip a routine without a name, up to its end: its content could not be distinguished from
    /// that of another one.
    fn unfinished_routine(
        &mut self,
        kind: RoutineKind,
        name: &str,
        first: Token,
    ) -> Result<(), RapidFault> {
        while !self.tokens.take_word(kind.end())? {
            if self.tokens.peek().kind == TokenKind::End {
                let kind = RapidFaultKind::UnexpectedEnd {
                    inside: format!("{} {name}", kind.word()),
                    missing: kind.end(),
                };
                return Err(self.tokens.fault(self.tokens.peek().start, kind));
            }
            self.tokens.take()?;
        }
        self.skip_unfinished(first);
        Ok(())
    }

    /// Read the parameters in parentheses: the name of each is the last word before a comma, a bar
    /// or a backslash.
    fn parameters(&mut self, routine: &str) -> Result<(), RapidFault> {
        let open = self.tokens.take()?;
        let mut last = None;
        loop {
            let token = self.tokens.peek();
            match token.kind {
                TokenKind::End | TokenKind::Symbol(b';') => {
                    return Err(self
                        .tokens
                        .fault(open.start, RapidFaultKind::Unclosed { bracket: '(' }));
                }
                TokenKind::Name => last = Some(token),
                TokenKind::Symbol(b',' | b'|' | b'\\' | b')') => {
                    if let Some(name) = last.take() {
                        let text = self.tokens.text_of(name);
                        self.declare(
                            name,
                            text,
                            Named::Other(Unresolved::Parameter { routine: routine.to_string() }),
                        )?;
                    }
                }
                TokenKind::Placeholder => last = None,
                _ => {}
            }
            self.tokens.take()?;
            if token.is(b')') {
                return Ok(());
            }
        }
    }

    pub(crate) fn end_routine(&mut self, kind: RoutineKind) -> Result<(), RapidFault> {
        if let Some((_, end)) = self.written.blocks.innermost() {
            return Err(self.tokens.unexpected(end));
        }
        match self.current_routine().map(|routine| routine.kind) {
            Some(open) if open == kind => {}
            Some(open) => return Err(self.tokens.unexpected(open.end())),
            None => {
                return Err(self
                    .tokens
                    .unexpected("a declaration or an instruction (no routine is open)"));
            }
        }
        self.routine = 0;
        (self.displaced_by, self.settings) = Default::default();
        self.tokens.take().map(|_| ())
    }
}
