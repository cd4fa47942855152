//! Instructions that are not read: those that move the robot, displace its targets, or write to
//! their arguments.

use alloc::string::ToString;
use alloc::vec::Vec;

use super::blocks::begins_another;
use super::reader::{Assignment, StatementReader};
use crate::error::RapidFault;
use crate::rapid::data::instructions::{Effect, written_argument};
use crate::rapid::data::settings::Setting;
use crate::rapid::data::unread::NotRead;
use crate::rapid::text::skipping::skip_balanced;
use crate::rapid::text::tokens::{Token, TokenKind};

impl<'a> StatementReader<'a> {
    /// An instruction that is not read, a call, an assignment or a label.
    pub(crate) fn other(&mut self, first: Token) -> Result<(), RapidFault> {
        self.tokens.take()?;
        self.rest_of_other(first)
    }

    pub(crate) fn rest_of_other(&mut self, first: Token) -> Result<(), RapidFault> {
        let name = self.tokens.text_of(first);
        let next = self.tokens.peek();
        let is_assignment = next.kind == TokenKind::Assign || next.is(b'{') || next.is(b'.');
        if next.is(b':') {
            self.tokens.take()?;
            self.skip(first, NotRead::Label { name: name.to_string() });
            return Ok(());
        }
        if first.kind == TokenKind::Placeholder && !is_assignment {
            // With or without a semicolon.
            self.tokens.take_if(b';')?;
            self.skip_unfinished(first);
            return Ok(());
        }
        // Two of them begin a header, which is valid at the beginning only.
        if first.is(b'%') && next.is(b'%') {
            return Err(self.tokens.unexpected("the name of a procedure"));
        }
        if !is_assignment && self.setting(first)? {
            return Ok(());
        }
        let components = if is_assignment { self.assigned_components()? } else { Vec::new() };
        let assigned =
            if is_assignment { Some(name) } else { self.name_in_written_argument(name)? };
        skip_balanced(&mut self.tokens, |tokens, _| begins_another(tokens))?;
        self.tokens.demand(b';', "a semicolon")?;
        let what = {
            let name = name.to_string();
            match is_assignment {
                true => NotRead::Assignment { name },
                false if Effect::Moves.is_of(&name) => NotRead::Motion { name },
                false => NotRead::Instruction { name },
            }
        };
        let line = self.skip(first, what);
        if !is_assignment {
            self.displaced_by.see(name, line);
        }
        if let Some(name) = assigned {
            self.written.assignments.push(Assignment { at: self.at(), name, components, line });
        }
        Ok(())
    }

    /// Read an instruction that sets how moves are made, whose name is already read. False, with
    /// nothing read, for another instruction or one that is not as RAPID has it.
    fn setting(&mut self, first: Token) -> Result<bool, RapidFault> {
        let name = self.tokens.text_of(first);
        if !Effect::Sets.is_of(name) {
            return Ok(false);
        }
        let mark = self.tokens.mark();
        let mut switch = None;
        if self.tokens.take_if(b'\\')? && self.tokens.peek().kind == TokenKind::Name {
            let token = self.tokens.take()?;
            switch = Some(self.tokens.text_of(token));
        }
        if !self.tokens.peek().is(b';') || !self.settings.set(name, switch) {
            self.tokens.rewind(mark);
            return Ok(false);
        }
        self.tokens.take()?;
        let (line, column) = self.tokens.line_and_column(first.start);
        let text = self.written.text[first.start..self.tokens.last_end].to_string();
        let routine = self.current_routine().map(|routine| routine.name.clone());
        self.written.settings.push(Setting { line, column, routine, text });
        Ok(true)
    }

    /// The names of the component that an assignment is to, behind the name and its indices.
    fn assigned_components(&mut self) -> Result<Vec<&'a str>, RapidFault> {
        if self.tokens.peek().is(b'{') {
            skip_balanced(&mut self.tokens, |_, last| last.is_some_and(|last| last.is(b'}')))?;
        }
        let mut components = Vec::new();
        while self.tokens.take_if(b'.')? && self.tokens.peek().kind == TokenKind::Name {
            let component = self.tokens.take()?;
            components.push(self.tokens.text_of(component));
        }
        Ok(components)
    }

    /// The name in the argument that an instruction writes to; reads up to it.
    fn name_in_written_argument(
        &mut self,
        instruction: &str,
    ) -> Result<Option<&'a str>, RapidFault> {
        let Some(place) = written_argument(instruction) else { return Ok(None) };
        let mut required = 0;
        loop {
            if !self.tokens.peek().is(b'\\') && self.tokens.peek().kind != TokenKind::End {
                required += 1;
            }
            if required == place {
                if self.tokens.at_assigned_name() {
                    self.tokens.take()?;
                    self.tokens.take()?;
                }
                let token = self.tokens.peek();
                return Ok((token.kind == TokenKind::Name).then(|| self.tokens.text_of(token)));
            }
            skip_balanced(&mut self.tokens, |tokens, _| {
                tokens.peek().is(b',') || begins_another(tokens)
            })?;
            if !self.tokens.take_if(b',')? {
                return Ok(None);
            }
        }
    }
}
