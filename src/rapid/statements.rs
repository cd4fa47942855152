//! A module's statements, one after the other: declarations and moves are read, everything else is skipped and told.

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::assigned::Assignment;
use super::blocks::Blocks;
use super::declarations::{
    Declaration, Declared, Named, Scopes, read_declaration, read_name, storage_at,
};
use super::instructions::DisplacedBy;
use super::module::{Routine, RoutineKind, Scope, Skipped};
use super::moves::{MoveKind, WrittenMove, read_move};
use super::resolve::resolve_at_once;
use super::tokens::{Token, TokenKind, Tokens};
use crate::error::{RapidFault, RapidFaultKind};

/// A module as it is written, before names are looked up.
pub(super) struct Written<'a> {
    pub(super) text: &'a str,
    pub(super) name: Option<&'a str>,
    pub(super) attributes: Vec<String>,
    pub(super) routines: Vec<Routine>,
    pub(super) declared: Vec<Declared<'a>>,
    pub(super) moves: Vec<WrittenMove<'a>>,
    pub(super) skipped: Vec<Skipped>,
    pub(super) assignments: Vec<Assignment<'a>>,
    pub(super) scopes: Scopes,
    pub(super) blocks: Blocks<'a>,
}

/// Where the reader is.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Stage {
    /// Before anything.
    Beginning,
    /// In a text without MODULE.
    Bare,
    /// After MODULE.
    Module,
    /// After ENDMODULE.
    Ended,
}

/// Reads the statements of a text.
pub(super) struct StatementReader<'a> {
    pub(super) tokens: Tokens<'a>,
    pub(super) written: Written<'a>,
    stage: Stage,
    /// Index of the routine, from 1; 0 outside routines.
    pub(super) routine: usize,
    pub(super) displaced_by: DisplacedBy,
}

impl<'a> StatementReader<'a> {
    /// Reads a whole text.
    pub(super) fn read(text: &'a str) -> Result<Written<'a>, RapidFault> {
        let written = Written {
            text,
            name: None,
            attributes: Vec::new(),
            routines: Vec::new(),
            declared: Vec::new(),
            moves: Vec::new(),
            skipped: Vec::new(),
            assignments: Vec::new(),
            scopes: Scopes::new(),
            blocks: Blocks::new(),
        };
        let (tokens, displaced_by) = (Tokens::new(text)?, DisplacedBy::default());
        let mut reader =
            Self { tokens, written, stage: Stage::Beginning, routine: 0, displaced_by };
        while reader.tokens.peek().kind != TokenKind::End {
            reader.statement()?;
        }
        reader.check_end()?;
        Ok(reader.written)
    }

    /// That nothing is open where the text ends.
    fn check_end(&self) -> Result<(), RapidFault> {
        let (inside, missing) = if let Some((word, end)) = self.written.blocks.innermost() {
            (word.to_string(), end)
        } else if let Some(routine) = self.current_routine() {
            (format!("{} {}", routine.kind.word(), routine.name), routine.kind.end())
        } else if self.stage == Stage::Module {
            (format!("MODULE {}", self.written.name.unwrap_or_default()), "ENDMODULE")
        } else {
            return Ok(());
        };
        Err(self
            .tokens
            .fault(self.written.text.len(), RapidFaultKind::UnexpectedEnd { inside, missing }))
    }

    pub(super) fn current_routine(&self) -> Option<&Routine> {
        self.written.routines.get(self.routine.checked_sub(1)?)
    }

    /// The word that ends the innermost block or else the routine.
    pub(super) fn open_end(&self) -> Option<&'static str> {
        let block = self.written.blocks.innermost().map(|(_, end)| end);
        block.or_else(|| self.current_routine().map(|routine| routine.kind.end()))
    }

    fn statement(&mut self) -> Result<(), RapidFault> {
        let token = self.tokens.peek();
        if token.is(b';') {
            return self.tokens.take().map(|_| ());
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
            return Err(self.tokens.unexpected("the end of the text"));
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
            _ => match MoveKind::named(&word) {
                Some(kind) => self.move_instruction(kind, token),
                None if super::blocks::is_flow(&word) => self.flow(&word, token),
                None => self.other(token),
            },
        }
    }

    fn begin_module(&mut self, token: Token) -> Result<(), RapidFault> {
        match self.stage {
            Stage::Beginning => {}
            Stage::Bare => {
                return Err(self
                    .tokens
                    .unexpected("a declaration or an instruction (MODULE begins a text)"));
            }
            Stage::Module | Stage::Ended => {
                return Err(self.tokens.fault(token.start, RapidFaultKind::SecondModule));
            }
        }
        self.tokens.take()?;
        self.stage = Stage::Module;
        self.written.name = Some(read_name(&mut self.tokens, "the module's name")?);
        if !self.tokens.take_if(b'(')? {
            return Ok(());
        }
        loop {
            let attribute = self.tokens.peek();
            if !matches!(attribute.kind, TokenKind::Name | TokenKind::Placeholder) {
                return Err(self.tokens.unexpected("an attribute of the module"));
            }
            self.tokens.take()?;
            self.written.attributes.push(self.tokens.text_of(attribute).to_string());
            if !self.tokens.take_if(b',')? {
                return self.tokens.demand(b')', "a comma or )");
            }
        }
    }

    fn end_module(&mut self) -> Result<(), RapidFault> {
        if let Some(end) = self.open_end() {
            return Err(self.tokens.unexpected(end));
        }
        if self.stage != Stage::Module {
            return Err(self
                .tokens
                .unexpected("a declaration or an instruction (no MODULE is open)"));
        }
        self.stage = Stage::Ended;
        self.tokens.take().map(|_| ())
    }

    /// A datum or a routine, perhaps after LOCAL or TASK.
    fn declaration(&mut self, first: Token) -> Result<(), RapidFault> {
        let scope = match (self.tokens.take_word("LOCAL")?, self.tokens.at_word("TASK")) {
            (true, _) => Scope::Local,
            (false, true) => {
                self.tokens.take()?;
                Scope::Task
            }
            (false, false) => Scope::Global,
        };
        if let Some(storage) = storage_at(&self.tokens) {
            let declaration = read_declaration(&mut self.tokens, first.start, scope, storage)?;
            return self.add_declaration(first, declaration);
        }
        let kinds = [RoutineKind::Proc, RoutineKind::Func, RoutineKind::Trap];
        match kinds.into_iter().find(|kind| self.tokens.at_word(kind.word())) {
            Some(kind) if scope != Scope::Task => self.begin_routine(kind, first),
            _ if self.tokens.at_word("ALIAS") => self.alias(first),
            // A procedure may be named Task.
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
        let (name, named) = match declaration {
            Declaration::Read(mut declared) => {
                declared.routine = self.routine;
                resolve_at_once(self.written.text, &mut declared)?;
                let name = declared.name;
                self.written.declared.push(declared);
                (name, Named::Datum(self.written.declared.len() - 1))
            }
            Declaration::Unread { name, type_name } => {
                self.skip(first, format!("{name}: type {type_name} is not read"));
                (name, Named::Other(format!("of type {type_name}, which is not read")))
            }
            Declaration::Unfinished { name } => {
                self.skip(first, String::new());
                (name, Named::Other("whose declaration is not finished".to_string()))
            }
        };
        self.declare(first, name, named)
    }

    pub(super) fn declare(
        &mut self,
        at: Token,
        name: &str,
        named: Named,
    ) -> Result<(), RapidFault> {
        let routine =
            self.routine.checked_sub(1).and_then(|index| self.written.routines.get(index));
        let declared = self.written.scopes.declare(
            self.routine,
            routine.map(|routine| routine.name.as_str()),
            name,
            named,
        );
        declared.map_err(|kind| self.tokens.fault(at.start, kind))
    }

    fn record(&mut self, first: Token) -> Result<(), RapidFault> {
        self.tokens.take()?;
        let name = read_name(&mut self.tokens, "the name of the record")?;
        while !self.tokens.take_word("ENDRECORD")? {
            if self.tokens.peek().kind == TokenKind::End {
                let kind = RapidFaultKind::UnexpectedEnd {
                    inside: format!("RECORD {name}"),
                    missing: "ENDRECORD",
                };
                return Err(self.tokens.fault(self.tokens.peek().start, kind));
            }
            self.tokens.take()?;
        }
        self.skip(first, format!("RECORD {name} is not read"));
        self.declare(first, name, Named::Other("a type".to_string()))
    }

    /// Another name of a type, which hides no name of data.
    fn alias(&mut self, first: Token) -> Result<(), RapidFault> {
        self.tokens.take()?;
        read_name(&mut self.tokens, "a type")?;
        let name = read_name(&mut self.tokens, "the name of the type")?;
        self.tokens.demand(b';', "a semicolon")?;
        self.skip(first, format!("ALIAS {name} is not read"));
        Ok(())
    }

    fn move_instruction(&mut self, kind: MoveKind, token: Token) -> Result<(), RapidFault> {
        self.tokens.take()?;
        let Some(step) = read_move(&mut self.tokens, kind, token.start)? else {
            self.skip(token, String::new());
            return Ok(());
        };
        let (routine, inside_loop, displaced) =
            (self.routine, self.written.blocks.innermost_loop(), self.displaced_by.line(kind));
        self.written.moves.push(WrittenMove { routine, inside_loop, displaced, ..step });
        Ok(())
    }

    fn flow(&mut self, word: &str, token: Token) -> Result<(), RapidFault> {
        self.tokens.take()?;
        self.written.blocks.read(&mut self.tokens, word, token)?;
        self.skip(token, format!("{word} is not carried out"));
        Ok(())
    }

    /// Tells that what stands from a token to here is not read, because it is not finished where a placeholder stands in it; its line.
    pub(super) fn skip(&mut self, from: Token, mut what: String) -> usize {
        let (line, column) = self.tokens.line_and_column(from.start);
        if self.tokens.unfinished_since(from.start) {
            what = format!("{} is not finished", self.tokens.text_of(from));
        }
        let text = self.written.text[from.start..self.tokens.last_end].to_string();
        let routine = self.current_routine().map(|routine| routine.name.clone());
        self.written.skipped.push(Skipped { line, column, routine, what, text });
        line
    }
}
