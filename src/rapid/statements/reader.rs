//! The state of the reader of statements: results and position.

use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::blocks::Blocks;
use super::declarations::Declared;
use super::displaced_by::DisplacedBy;
use super::moves::WrittenMove;
use super::scopes::{Named, Scopes};
use crate::error::RapidFault;
use crate::rapid::data::module::Routine;
use crate::rapid::data::settings::{MotionSettings, Setting};
use crate::rapid::data::skipped::{NotRead, Skipped};
use crate::rapid::expression::content::Placed;
use crate::rapid::expression::names::At;
use crate::rapid::text::tokens::{Token, Tokens};

/// A module as it is written, before names are looked up.
pub(crate) struct Written<'a> {
    pub(crate) text: &'a str,
    pub(crate) name: Option<&'a str>,
    pub(crate) attributes: Vec<String>,
    pub(crate) routines: Vec<Routine>,
    pub(crate) declared: Vec<Declared<'a>>,
    /// The content of each declaration, if it is known without looking up a name.
    pub(crate) contents: Vec<Option<Placed>>,
    pub(crate) moves: Vec<WrittenMove<'a>>,
    pub(crate) skipped: Vec<Skipped>,
    pub(crate) settings: Vec<Setting>,
    pub(crate) assignments: Vec<Assignment<'a>>,
    pub(crate) scopes: Scopes,
    pub(crate) blocks: Blocks<'a>,
}

/// A statement that gives a datum another value.
pub(crate) struct Assignment<'a> {
    pub(crate) at: At,
    pub(crate) name: &'a str,
    pub(crate) line: usize,
}

/// The position of the reader in the module.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Stage {
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
pub(crate) struct StatementReader<'a> {
    pub(super) tokens: Tokens<'a>,
    pub(super) written: Written<'a>,
    pub(super) stage: Stage,
    /// Index of the routine, from 1; 0 outside routines.
    pub(super) routine: usize,
    pub(super) displaced_by: DisplacedBy,
    /// What the instructions of the routine have set.
    pub(super) settings: MotionSettings,
}

impl<'a> StatementReader<'a> {
    /// At the beginning of a text.
    pub(super) fn new(text: &'a str) -> Result<Self, RapidFault> {
        let written = Written {
            text,
            name: None,
            attributes: Vec::new(),
            routines: Vec::new(),
            declared: Vec::new(),
            contents: Vec::new(),
            moves: Vec::new(),
            skipped: Vec::new(),
            settings: Vec::new(),
            assignments: Vec::new(),
            scopes: Scopes::new(),
            blocks: Blocks::new(),
        };
        let (tokens, displaced_by) = (Tokens::new(text)?, DisplacedBy::default());
        let settings = MotionSettings::default();
        Ok(Self { tokens, written, stage: Stage::Beginning, routine: 0, displaced_by, settings })
    }

    /// The position, for looking up names.
    pub(super) fn at(&self) -> At {
        At { routine: self.routine, inside_loop: self.written.blocks.innermost_loop() }
    }

    pub(super) fn current_routine(&self) -> Option<&Routine> {
        self.written.routines.get(self.routine.checked_sub(1)?)
    }

    /// The word that ends the innermost block or else the routine.
    pub(super) fn expected_end(&self) -> Option<&'static str> {
        let block = self.written.blocks.innermost().map(|(_, end)| end);
        block.or_else(|| self.current_routine().map(|routine| routine.kind.end()))
    }

    /// Declares a name in the scope of the routine or of the module.
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

    /// List the text from a token to here as not read, or as unfinished if it contains a
    /// placeholder. Returns its line.
    pub(super) fn skip(&mut self, from: Token, what: NotRead) -> usize {
        let (line, column) = self.tokens.line_and_column(from.start);
        let what = if self.tokens.unfinished_since(from.start) {
            NotRead::Unfinished { statement: self.tokens.text_of(from).to_string() }
        } else {
            what
        };
        let text = self.written.text[from.start..self.tokens.last_end].to_string();
        let routine = self.current_routine().map(|routine| routine.name.clone());
        self.written.skipped.push(Skipped { line, column, routine, what, text });
        line
    }

    /// List the text from a token to here as unfinished.
    pub(super) fn skip_unfinished(&mut self, from: Token) {
        let statement = self.tokens.text_of(from).to_string();
        self.skip(from, NotRead::Unfinished { statement });
    }
}
