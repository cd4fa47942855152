//! Values without names and operators, most of a large module: read straight into their records,
//! without tokens and trees.

use super::evaluate::whole;
use crate::prelude::*;
use crate::rapid::data::expression::{Expression, Form};
use crate::rapid::data::types::{Atom, Atoms, Shape, Type};
use crate::rapid::data::value::{DataType, Value};
use crate::rapid::text::tokens::{LONGEST_STRING, Tokens, behind_blanks};
use crate::rapid::text::tokens::{decimal, unquoted};
use crate::rapid::text::words::end_of_word;

/// A value of a type up to the symbol that ends it.
///
/// `None` for anything that is not such a value, including an invalid text: the tokens are left
/// unchanged, to be read as an expression, which reports the error.
pub(crate) fn read_direct<'a>(
    tokens: &mut Tokens<'a>,
    data_type: DataType,
    ending: u8,
) -> Option<Expression<'a>> {
    let start = tokens.peek().start;
    let mut reader = DirectReader { text: tokens.text, bytes: tokens.content(), at: start };
    let mut atoms = Atoms::new();
    reader.fill(data_type.described(), &mut atoms)?;
    let value = Value::of(data_type, atoms)?;
    let end = reader.at;
    reader.take(ending)?;
    tokens.resume(end);
    Some(Expression { start, end, form: Form::Value(Box::new(value)) })
}

struct DirectReader<'a> {
    text: &'a str,
    /// The text up to the possible end of the value.
    bytes: &'a [u8],
    /// The end of what was read.
    at: usize,
}

impl DirectReader<'_> {
    /// The next byte that is not blank, without consuming it.
    fn peek(&mut self) -> Option<u8> {
        self.at = behind_blanks(self.bytes, self.at);
        self.bytes.get(self.at).copied()
    }

    fn take(&mut self, symbol: u8) -> Option<()> {
        let is = self.peek()? == symbol;
        self.at += usize::from(is);
        is.then_some(())
    }

    fn fill(&mut self, of: &Type, atoms: &mut Atoms) -> Option<()> {
        atoms.push(match of.shape {
            // RAPID has no negative zero.
            Shape::Num => Atom::Num(self.number()? + 0.0),
            Shape::Whole => Atom::Whole(whole(self.number()?)?),
            Shape::Bool => Atom::Bool(self.truth()?),
            Shape::Text => Atom::Text(self.string()?),
            Shape::Record(components) => {
                for (i, (_, component)) in components.iter().enumerate() {
                    self.take(if i == 0 { b'[' } else { b',' })?;
                    self.fill(component, atoms)?;
                }
                return self.take(b']');
            }
        });
        Some(())
    }

    /// A number with at most one sign.
    fn number(&mut self) -> Option<f64> {
        let is_negative = self.peek()? == b'-';
        if is_negative || self.bytes[self.at] == b'+' {
            self.at += 1;
            self.peek()?;
        }
        let first_digit = self.at + usize::from(self.bytes[self.at] == b'.');
        if !self.bytes.get(first_digit)?.is_ascii_digit() {
            return None;
        }
        let value;
        (value, self.at) = decimal(self.text, self.at)?;
        Some(if is_negative { -value } else { value })
    }

    fn truth(&mut self) -> Option<bool> {
        self.peek()?;
        let word = self.text.get(self.at..end_of_word(self.text, self.at))?;
        self.at += word.len();
        let is_true = word.eq_ignore_ascii_case("TRUE");
        (is_true || word.eq_ignore_ascii_case("FALSE")).then_some(is_true)
    }

    /// A string without a quote in it.
    fn string(&mut self) -> Option<String> {
        self.take(b'"')?;
        let inside = self.bytes.get(self.at..)?.iter().take(LONGEST_STRING - 1);
        let length = inside.into_iter().position(|byte| matches!(byte, b'"' | b'\n' | b'\r'))?;
        let end = self.at + length + 1;
        if self.bytes[end - 1] != b'"' || self.bytes.get(end) == Some(&b'"') {
            return None;
        }
        let quoted = self.text.get(self.at - 1..end)?;
        self.at = end;
        Some(unquoted(quoted))
    }
}
