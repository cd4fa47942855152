//! Where a text goes on behind a fault, and lines that are none of RAPID's.

use super::tokens::{Token, TokenKind, Tokens, behind_blanks};
use crate::prelude::*;
use crate::rapid::text::fault::{RapidFault, RapidFaultKind};
use crate::rapid::text::words::{end_of_word, is_reserved};

/// The error for a missing closing symbol: the bracket is open at the end of the statement, or
/// something else is in its place.
pub(crate) fn not_closed(tokens: &Tokens<'_>, open: Token, close: u8) -> RapidFault {
    let wanted = match close {
        b']' => "a comma or ]",
        b')' => "a comma or )",
        _ => "a comma or }",
    };
    let next = tokens.peek();
    match next.kind {
        TokenKind::Name if !is_reserved(tokens.text_of(next)) && !tokens.is_first_of_line() => {
            tokens.unexpected(wanted)
        }
        // Over several lines the closing one may lack in any of them: most likely in the last.
        TokenKind::Name | TokenKind::Symbol(b';')
            if tokens.text[open.start..tokens.last_end].contains('\n') =>
        {
            tokens.lacking(wanted)
        }
        TokenKind::End | TokenKind::Name | TokenKind::Symbol(b';') => {
            let bracket = tokens.text_of(open).chars().next().unwrap_or('[');
            tokens.fault(open.start, RapidFaultKind::Unclosed { bracket })
        }
        _ => tokens.unexpected(wanted),
    }
}

impl Tokens<'_> {
    /// The error that something lacks behind the previous token: at the end of its line if the next
    /// token is in another one.
    pub(crate) fn lacking(&self, wanted: &'static str) -> RapidFault {
        if self.peek().kind == TokenKind::Invalid || !self.is_first_of_line() {
            return self.unexpected(wanted);
        }
        let found = "the end of the line".to_string();
        self.fault(self.last_end, RapidFaultKind::Unexpected { found, wanted })
    }

    /// Whether the next token is the first one of its line, and not of the text.
    pub(crate) fn is_first_of_line(&self) -> bool {
        let between =
            self.text.as_bytes().get(self.last_end..self.peek().start).unwrap_or_default();
        self.peek().kind != TokenKind::End
            && self.last_end > 0
            && between.iter().any(|byte| matches!(byte, b'\n' | b'\r'))
    }

    /// Whether the next token, where a value may be, begins a line and a statement: the statement
    /// before it is not finished. `is_first` is for the first argument of a call, before which no
    /// comma is.
    pub(crate) fn begins_statement(&self, is_first: bool) -> bool {
        if self.peek().kind != TokenKind::Name || !self.is_first_of_line() {
            return false;
        }
        let is_value = ["NOT", "TRUE", "FALSE"].iter().any(|value| self.at_word(value));
        if is_first && !is_value && is_reserved(self.text_of(self.peek())) {
            return true;
        }
        let indent = |byte: usize| {
            let line = self.text[..byte].rfind(['\n', '\r']).map_or(0, |at| at + 1);
            behind_blanks(&self.text.as_bytes()[..byte], line) - line
        };
        let rest = &self.text[behind_blanks(self.content(), self.peek().end)..];
        match rest.as_bytes().first() {
            Some(b'"' | b'[' | b'0'..=b'9') => true,
            Some(b'*') => {
                let behind = behind_blanks(self.content(), self.text.len() - rest.len() + 1);
                matches!(self.text.as_bytes().get(behind), Some(b',' | b'\\'))
            }
            Some(b'\\' | b';' | b'{' | b':') => {
                let is_colon = rest.starts_with(':') && !rest.starts_with(":=");
                is_first && !is_colon && indent(self.peek().start) <= indent(self.last_end)
            }
            _ => {
                let word = &rest[..end_of_word(rest, 0)];
                !word.is_empty() && !is_reserved(word)
            }
        }
    }
}

/// The first bytes of the lines that git leaves in a conflict.
const CONFLICT_MARKERS: [&str; 4] = ["<<<<<<<", "|||||||", "=======", ">>>>>>>"];

/// Whether the line that begins at a byte is one that git leaves in a conflict.
pub(crate) fn is_conflict_marker(text: &str, byte: usize) -> bool {
    let is_first = matches!(text.as_bytes().get(byte.wrapping_sub(1)), None | Some(b'\n' | b'\r'));
    is_first && CONFLICT_MARKERS.iter().any(|marker| text[byte..].starts_with(marker))
}

pub(crate) fn end_of_line(text: &str, byte: usize) -> usize {
    text[byte..].find(['\n', '\r']).map_or(text.len(), |length| byte + length)
}

/// The next token, if it begins a line and may begin a statement.
pub(crate) fn at_line(tokens: &Tokens<'_>) -> Option<usize> {
    let next = tokens.peek();
    (next.kind == TokenKind::Name && tokens.is_first_of_line()).then_some(next.start)
}

/// Where a statement may begin from a byte on: behind a semicolon, or at the next line that begins
/// as a statement does.
pub(crate) fn next_statement(text: &str, mut at: usize) -> usize {
    let bytes = text.as_bytes();
    while let Some(byte) = bytes.get(at) {
        match byte {
            b';' => return at + 1,
            b'!' => at = end_of_line(text, at),
            b'"' => {
                at += 1 + text[at + 1..].find(['"', '\n', '\r']).unwrap_or(text.len() - at - 1);
                at += usize::from(bytes.get(at) == Some(&b'"'));
            }
            b'\n' | b'\r' if begins_statement(text, at + 1) => return at + 1,
            _ => at += 1,
        }
    }
    text.len()
}

/// Whether the line that begins at a byte may begin a statement.
fn begins_statement(text: &str, line: usize) -> bool {
    let rest = text[line..].trim_start_matches([' ', '\t']);
    rest.starts_with(|first: char| first.is_alphabetic() || matches!(first, '<' | '%'))
        || is_conflict_marker(text, line)
}
