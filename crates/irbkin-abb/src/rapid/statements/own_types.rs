//! Types that a program defines: records and aliases.

use super::declarations::read_name;
use super::reader::{Named, StatementReader};
use super::recovery::begins_other;
use crate::prelude::*;
use crate::rapid::data::module::Scope;
use crate::rapid::data::own_types::{Definition, OwnType};
use crate::rapid::data::statement::StatementKind;
use crate::rapid::data::unread::Unresolved;
use crate::rapid::text::fault::RapidFault;
use crate::rapid::text::tokens::{Token, TokenKind};

impl StatementReader<'_> {
    pub(super) fn record(&mut self, first: Token) -> Result<(), RapidFault> {
        self.tokens.take()?;
        let name = read_name(&mut self.tokens, "the name of the record")?;
        let components = self.components(name)?;
        self.add(first, StatementKind::Record { name: name.to_string() });
        self.declare(first, name, Named::Other(Unresolved::Type))?;
        if let Some(components) = components {
            self.define(first, name, Definition::Record(components));
        }
        Ok(())
    }

    /// The types and the names of a record's components, up to its end; `None` if it has others.
    fn components(&mut self, name: &str) -> Result<Option<Vec<(String, String)>>, RapidFault> {
        let (mut components, mut words, mut is_plain) = (Vec::new(), Vec::new(), true);
        while !self.tokens.take_word("ENDRECORD")? {
            if begins_other(&self.tokens) {
                return Err(self.not_ended(format!("RECORD {name}"), "ENDRECORD"));
            }
            let token = self.tokens.take()?;
            match token.kind {
                TokenKind::Name => words.push(self.tokens.text_of(token).to_lowercase()),
                TokenKind::Symbol(b';') => match (words.pop(), words.pop(), words.is_empty()) {
                    (Some(name), Some(of), true) => components.push((of, name)),
                    _ => is_plain = false,
                },
                _ => is_plain = false,
            }
        }
        Ok(is_plain.then_some(components))
    }

    /// An alias of a type, which does not hide a name of data.
    pub(super) fn alias(&mut self, first: Token) -> Result<(), RapidFault> {
        self.tokens.take()?;
        let of = read_name(&mut self.tokens, "a type")?;
        let name = read_name(&mut self.tokens, "the name of the type")?;
        self.tokens.demand(b';', "a semicolon")?;
        self.add(first, StatementKind::Alias { name: name.to_string() });
        self.define(first, name, Definition::Alias(of.to_lowercase()));
        Ok(())
    }

    fn define(&mut self, first: Token, name: &str, of: Definition) {
        let is_local = Scope::named(self.tokens.text_of(first)) == Some(Scope::Local);
        self.types.own.entry(name.to_lowercase()).or_insert(OwnType { of, is_local });
    }
}
