//! A module's statements in sequence: declarations, moves and routines are read, everything else is
//! listed as not read.

use super::blocks::is_flow;
use super::declarations::DatumPart;
use super::declarations::{Declaration, read_declaration, read_name};
use super::faults::{Faults, is_encoded};
use super::reader::{Named, Stage, StatementReader, Written, is_placeholder};
use super::recovery::begins_other;
use super::types::Types;
use crate::prelude::*;
use crate::rapid::data::module::{Module, Parameter, Routine, RoutineKind, Scope, Storage};
use crate::rapid::data::own_types::OwnTypes;
use crate::rapid::data::settings::MotionSettings;
use crate::rapid::data::statement::StatementKind;
use crate::rapid::data::unread::Unresolved;
use crate::rapid::data::value::DataType;
use crate::rapid::text::fault::{RapidFault, RapidFaultKind};
use crate::rapid::text::tokens::{Token, TokenKind, Tokens};
use crate::rapid::text::words::is_reserved;

impl<'a> StatementReader<'a> {
    /// Read a whole text; with tolerance in spite of its faults.
    pub(crate) fn read(
        text: &'a str,
        context: &'a [&'a Module],
        faults: Faults<'a>,
    ) -> Result<Written<'a>, RapidFault> {
        let mut written = Written { text, faults, ..Written::default() };
        if is_encoded(text) {
            let fault = RapidFault { line: 1, column: 1, kind: RapidFaultKind::Encoded };
            written.faults.add(fault)?;
            return Ok(written);
        }
        let mut reader = Self {
            tokens: Tokens::of(text),
            types: Types { own: OwnTypes::new(), context },
            written,
            stage: Stage::Beginning,
            routine: 0,
            displaced_by: None,
            settings: MotionSettings::default(),
        };
        for round in 0.. {
            let first = reader.tokens.peek();
            if first.kind == TokenKind::End {
                break;
            }
            reader.written.faults.interrupt.check(round)?;
            if let Err(fault) = reader.statement() {
                reader.recover(first, fault)?;
            }
        }
        reader.check_end()?;
        reader.written.module.types = reader.types.own;
        reader.written.module.calls = reader.tokens.calls;
        Ok(reader.written)
    }

    fn check_end(&mut self) -> Result<(), RapidFault> {
        let (inside, missing) = if let Some((word, end)) = self.written.blocks.innermost() {
            (word.to_string(), end)
        } else if let Some(routine) = self.current_routine() {
            (format!("{} {}", routine.kind.name(), routine.name), routine.kind.end())
        } else if self.stage == Stage::Module {
            (format!("MODULE {}", self.written.module.name().unwrap_or_default()), "ENDMODULE")
        } else {
            return Ok(());
        };
        let kind = RapidFaultKind::UnexpectedEnd { inside, missing };
        self.complain(self.tokens.fault(self.written.text.len(), kind))?;
        self.close_blocks(0, self.tokens.peek().start);
        Ok(())
    }

    fn statement(&mut self) -> Result<(), RapidFault> {
        let token = self.tokens.peek();
        if token.is(b';') {
            return self.tokens.take().map(|_| ());
        }
        if matches!(token.kind, TokenKind::Symbol(_)) && self.conflict_marker()? {
            return Ok(());
        }
        let word = match token.kind {
            TokenKind::Name => self.tokens.text_of(token).to_ascii_uppercase(),
            TokenKind::Placeholder | TokenKind::Symbol(b'%') => String::new(),
            _ => return Err(self.tokens.unexpected("a declaration or an instruction")),
        };
        if word == "MODULE" {
            return self.begin_module(token);
        }
        if self.stage == Stage::Ended {
            self.complain(self.tokens.unexpected("the end of the text"))?;
            self.stage = Stage::Bare;
        }
        if self.stage == Stage::Beginning {
            self.stage = Stage::Bare;
        }
        match word.as_str() {
            "ENDMODULE" => self.end_module(),
            "LOCAL" | "TASK" | "CONST" | "PERS" | "VAR" | "PROC" | "FUNC" | "TRAP" => {
                self.declaration(token)
            }
            "ENDPROC" => self.end_routine(RoutineKind::Proc),
            "ENDFUNC" => self.end_routine(RoutineKind::Func),
            "ENDTRAP" => self.end_routine(RoutineKind::Trap),
            "RECORD" => self.record(token),
            "ALIAS" => self.alias(token),
            _ if is_flow(&word) => self.flow(&word, token),
            "RETURN" | "RAISE" | "GOTO" | "CONNECT" | "EXIT" | "RETRY" | "TRYNEXT" => {
                self.reserved(&word, token)
            }
            _ if is_reserved(&word) => {
                Err(self.tokens.unexpected("a declaration or an instruction"))
            }
            _ if token.is(b'%') => self.late_bound(token),
            _ => {
                self.tokens.take()?;
                self.instruction(token, token)
            }
        }
    }

    fn begin_module(&mut self, token: Token) -> Result<(), RapidFault> {
        match self.stage {
            Stage::Beginning => {}
            Stage::Bare => {
                let wanted = "a declaration or an instruction (MODULE begins a text)";
                self.complain(self.tokens.unexpected(wanted))?;
            }
            Stage::Module | Stage::Ended => {
                self.complain(self.tokens.fault(token.start, RapidFaultKind::SecondModule))?;
            }
        }
        self.close_all()?;
        self.tokens.take()?;
        self.stage = Stage::Module;
        let name = read_name(&mut self.tokens, "the module's name")?;
        self.written.module.name.get_or_insert_with(|| name.to_string());
        if !self.tokens.take_if(b'(')? {
            return Ok(());
        }
        loop {
            let attribute = self.tokens.peek();
            if !matches!(attribute.kind, TokenKind::Name | TokenKind::Placeholder) {
                return Err(self.tokens.unexpected("an attribute of the module"));
            }
            self.tokens.take()?;
            self.written.module.attributes.push(self.tokens.text_of(attribute).to_string());
            if !self.tokens.take_if(b',')? {
                return self.tokens.demand(b')', "a comma or )");
            }
        }
    }

    fn end_module(&mut self) -> Result<(), RapidFault> {
        self.close_all()?;
        if self.stage != Stage::Module {
            let wanted = "a declaration or an instruction (no MODULE is open)";
            self.complain(self.tokens.unexpected(wanted))?;
        }
        self.stage = Stage::Ended;
        self.tokens.take().map(|_| ())
    }

    /// A datum or a routine, perhaps after LOCAL or TASK.
    fn declaration(&mut self, first: Token) -> Result<(), RapidFault> {
        let word = self.tokens.text_of(self.tokens.peek());
        let scope = Scope::named(word).unwrap_or(Scope::Global);
        if scope != Scope::Global {
            self.tokens.take()?;
        }
        let word = self.tokens.text_of(self.tokens.peek());
        if let Some(storage) = Storage::named(word) {
            let place = (self.routine, scope, storage);
            let (tokens, faults) = (&mut self.tokens, &mut self.written.faults);
            let declaration = read_declaration(tokens, faults, first.start, place, &self.types)?;
            return self.add_declaration(first, declaration);
        }
        match RoutineKind::named(word) {
            Some(kind) if scope != Scope::Task => self.begin_routine(kind, first),
            _ if self.tokens.at_word("ALIAS") => self.alias(first),
            // A procedure may have the name Task.
            _ if scope == Scope::Task => self.rest_of_other(first),
            _ if self.tokens.at_word("RECORD") => self.record(first),
            _ => Err(self.tokens.unexpected("CONST, PERS, VAR, PROC, FUNC or TRAP")),
        }
    }

    fn add_declaration(
        &mut self,
        first: Token,
        declaration: Declaration<'a>,
    ) -> Result<(), RapidFault> {
        match declaration {
            Declaration::Read(declared, content) => {
                self.declare(first, declared.name, Named::Datum(self.written.declared.len()))?;
                self.written.declared.push(declared);
                self.written.contents.push(content);
            }
            Declaration::Unread { name, type_name, parts } => {
                let type_name = type_name.to_string();
                let what = StatementKind::DatumOfType {
                    name: name.to_string(),
                    type_name: type_name.clone(),
                };
                self.add(first, what);
                self.declare(first, name, Named::Other(Unresolved::OtherType { type_name }))?;
                self.add_parts(name, parts);
            }
            Declaration::Unfinished { name } => {
                self.add_unfinished(first);
                self.declare(first, name, Named::Other(Unresolved::Unfinished))?;
            }
        }
        Ok(())
    }

    fn add_parts(&mut self, name: &str, parts: Vec<DatumPart<'a>>) {
        for DatumPart { path, declared, content } in parts {
            let (name, index) = (format!("{name}.{path}"), self.written.declared.len());
            let named = Named::Datum(index);
            if self.written.scopes.declare(self.routine, &name, named) {
                self.written.declared.push(declared);
                self.written.contents.push(content);
                self.written.parts.insert(index, name.to_lowercase());
            }
        }
    }

    fn flow(&mut self, word: &str, token: Token) -> Result<(), RapidFault> {
        self.tokens.take()?;
        if let Some((outer, wanted)) = self.written.blocks.ended_by(word) {
            if let Some(wanted) = wanted {
                let found = self.tokens.text_of(token).to_string();
                let kind = RapidFaultKind::Unexpected { found, wanted };
                self.complain(self.tokens.fault(token.start, kind))?;
            }
            let Some(outer) = outer else { return Ok(()) };
            self.close_blocks(outer + 1, token.start);
        }
        let flow = self.written.blocks.read(&mut self.tokens, word, token)?;
        self.add(token, StatementKind::Flow { word: word.to_string(), flow });
        Ok(())
    }

    fn begin_routine(&mut self, kind: RoutineKind, first: Token) -> Result<(), RapidFault> {
        self.close_all()?;
        self.tokens.take()?;
        let mut data_type = None;
        if kind == RoutineKind::Func {
            data_type = DataType::named(read_name(&mut self.tokens, "the type of the function")?);
        }
        let name = read_name(&mut self.tokens, "the name of the routine")?;
        if is_placeholder(name) {
            return self.unfinished_routine(kind, name, first);
        }
        if let Err(fault) = self.declare(first, name, Named::Other(Unresolved::Routine)) {
            self.complain(fault)?;
        }
        let (line, column) = self.tokens.line_and_column(first.start);
        self.written.scopes.add_routine();
        self.written.module.routines.push(Routine {
            kind,
            name: name.to_string(),
            header: self.written.text[first.start..self.tokens.last_end].to_string(),
            line,
            column,
            parameters: Vec::new(),
            data_type,
        });
        self.routine = self.written.module.routines.len();
        (self.displaced_by, self.settings) = Default::default();
        let mut parameters = Vec::new();
        if self.tokens.peek().is(b'(') && kind != RoutineKind::Trap {
            parameters = self.parameters(name)?;
        } else if kind != RoutineKind::Trap {
            self.complain(self.tokens.lacking("("))?;
        }
        let header = self.written.text[first.start..self.tokens.last_end].to_string();
        if let Some(routine) = self.written.module.routines.last_mut() {
            (routine.header, routine.parameters) = (header, parameters);
        }
        Ok(())
    }

    /// Skip a routine without a name, up to its end: its content could not be distinguished from
    /// another one's.
    fn unfinished_routine(
        &mut self,
        kind: RoutineKind,
        name: &str,
        first: Token,
    ) -> Result<(), RapidFault> {
        while !self.tokens.take_word(kind.end())? {
            if begins_other(&self.tokens) {
                return Err(self.not_ended(format!("{} {name}", kind.name()), kind.end()));
            }
            self.tokens.take()?;
        }
        self.add_unfinished(first);
        Ok(())
    }

    /// The error that something is not ended where the text ends or something else begins.
    pub(super) fn not_ended(&self, inside: String, missing: &'static str) -> RapidFault {
        if self.tokens.peek().kind != TokenKind::End {
            return self.tokens.unexpected(missing);
        }
        let kind = RapidFaultKind::UnexpectedEnd { inside, missing };
        self.tokens.fault(self.tokens.peek().start, kind)
    }

    /// Read the parameters in parentheses: each has perhaps a mode, then a type and a name.
    fn parameters(&mut self, routine: &str) -> Result<Vec<Parameter>, RapidFault> {
        let open = self.tokens.take()?;
        let (mut last, mut count) = (None, 0);
        let (mut found, mut own) = (Vec::new(), Parameter::default());
        loop {
            let token = self.tokens.peek();
            let is_mode = ["INOUT", "VAR", "PERS", "REF"].iter().any(|it| self.tokens.at_word(it));
            match token.kind {
                TokenKind::End | TokenKind::Symbol(b';') => {
                    return Err(self
                        .tokens
                        .fault(open.start, RapidFaultKind::Unclosed { bracket: '(' }));
                }
                TokenKind::Name if is_mode && count == 0 => own.is_reference = true,
                TokenKind::Name if count < 2 => {
                    if count == 0 {
                        own.data_type = DataType::named(self.tokens.text_of(token));
                    }
                    (last, count) = (Some(token), count + 1);
                }
                TokenKind::Symbol(b',' | b'|' | b'\\' | b')') => {
                    if count == 1 && last.is_some() {
                        return Err(self.tokens.unexpected("the name of a parameter"));
                    }
                    if let Some(name) = last.take() {
                        let (text, routine) = (self.tokens.text_of(name), routine.to_string());
                        let named = Named::Other(Unresolved::Parameter { routine });
                        if let Err(fault) = self.declare(name, text, named) {
                            self.complain(fault)?;
                        }
                        found.push(Parameter { name: text.to_lowercase(), ..own.clone() });
                    }
                    count = 0;
                    own = Parameter {
                        is_optional: token.is(b'|')
                            || !token.is(b',') && (own.is_optional || token.is(b'\\')),
                        is_alternative: token.is(b'|') || !token.is(b',') && own.is_alternative,
                        ..Parameter::default()
                    };
                }
                TokenKind::Placeholder => (last, count) = (None, count + 1),
                TokenKind::Symbol(b'{') if last.is_some() => {
                    self.tokens.take()?;
                    while self.tokens.take_if(b'*')? && self.tokens.take_if(b',')? {}
                    self.tokens.demand(b'}', "* or }")?;
                    continue;
                }
                _ => return Err(self.tokens.unexpected("a comma or )")),
            }
            self.tokens.take()?;
            if token.is(b')') {
                return Ok(found);
            }
        }
    }

    fn end_routine(&mut self, kind: RoutineKind) -> Result<(), RapidFault> {
        if let Some((_, end)) = self.written.blocks.innermost() {
            self.complain(self.tokens.unexpected(end))?;
            self.close_blocks(0, self.tokens.peek().start);
        }
        let wanted = match self.current_routine().map(|routine| routine.kind) {
            Some(open) if open == kind => None,
            Some(open) => Some(open.end()),
            None => Some("a declaration or an instruction (no routine is open)"),
        };
        if let Some(wanted) = wanted {
            self.complain(self.tokens.unexpected(wanted))?;
        }
        self.leave_routine();
        self.tokens.take().map(|_| ())
    }

    pub(super) fn leave_routine(&mut self) {
        self.routine = 0;
        (self.displaced_by, self.settings) = Default::default();
    }
}
