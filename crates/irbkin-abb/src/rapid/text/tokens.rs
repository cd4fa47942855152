//! RAPID text as tokens: names, numbers, strings and symbols, without blanks and comments.

use alloc::borrow::Cow;
use core::cell::Cell;
use core::ops::Range;

use super::place::{Place, excerpt};
use super::words::{end_of_word, is_word_byte};
use crate::prelude::*;
use crate::rapid::text::fault::{RapidFault, RapidFaultKind};

/// Most letters of a placeholder; RAPID's own have two or three.
const LONGEST_PLACEHOLDER: usize = 16;

/// Most bytes of a name and of a string. RAPID's own bounds are 32 and 80 characters. The bound
/// keeps reading linear in the text even if a name is repeated often, as the routine of each
/// statement.
const LONGEST_NAME: usize = 256;
pub(crate) const LONGEST_STRING: usize = 2048;

/// Characters at the end of a file: blanks, and what some systems append to the text.
const END_OF_FILE: [char; 8] = ['\0', '\u{1a}', ' ', '\t', '\r', '\n', '\u{b}', '\u{c}'];

const SYMBOLS: &[u8] = b"[](){},;.:\\*+-/=<>|%?";

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum TokenKind {
    /// An identifier or a reserved word.
    Name,
    /// A number, without a sign.
    Number(f64),
    /// A string with its quotes.
    Text,
    /// `:=`.
    Assign,
    /// `<SMT>` and the like: what an unfinished program does not have yet.
    Placeholder,
    /// A character of RAPID's punctuation.
    Symbol(u8),
    /// No token: taking it is an error.
    Invalid,
    End,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Token {
    pub(crate) kind: TokenKind,
    pub(crate) start: usize,
    pub(crate) end: usize,
}

impl Token {
    pub(crate) fn is(&self, symbol: u8) -> bool {
        self.kind == TokenKind::Symbol(symbol)
    }
}

/// A reader of tokens in sequence, with one token of lookahead.
pub(crate) struct Tokens<'a> {
    pub(crate) text: &'a str,
    next: Token,
    pub(crate) last_end: usize,
    last_placeholder: Option<usize>,
    /// Beginning of the first token or of the header.
    begin: usize,
    /// End of what is read: only blanks, NUL and Ctrl-Z may follow.
    end: usize,
    /// The place that was looked up last.
    place: Cell<Place>,
    /// Calls that RAPID does not have as they are written, and calls of what it does not have.
    pub(crate) calls: Vec<Called>,
}

/// A call of a procedure or of a function that RAPID itself does not have like this.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Called {
    /// The first byte of its statement or, of a function, of its name.
    pub(crate) start: usize,
    pub(crate) name: Range<usize>,
    pub(crate) is_function: bool,
    /// The number of its required arguments.
    pub(crate) required: usize,
    /// Its optional arguments, and whether each has a value.
    pub(crate) optional: Vec<(String, bool)>,
    /// The fault of the arguments of one that RAPID has.
    pub(crate) wrong: Option<String>,
}

impl<'a> Tokens<'a> {
    /// Start at a text, after its `%%% ... %%%`; its first token must be valid.
    pub(crate) fn new(text: &'a str) -> Result<Self, RapidFault> {
        let tokens = Self::of(text);
        match tokens.next.kind {
            TokenKind::Invalid => Err(tokens.unexpected("a token")),
            _ => Ok(tokens),
        }
    }

    /// Start at a text, after its `%%% ... %%%`.
    pub(crate) fn of(text: &'a str) -> Self {
        let next = Token { kind: TokenKind::End, start: 0, end: 0 };
        let end = text.trim_end_matches(END_OF_FILE).len();
        let place = Cell::new(Place::BEGINNING);
        let (last_placeholder, begin, calls) = (None, 0, Vec::new());
        let mut tokens =
            Self { text, next, last_end: 0, last_placeholder, begin, end, place, calls };
        let bom = text.len() - text.trim_start_matches('\u{feff}').len();
        let start = tokens.skip_blanks(bom);
        tokens.begin = start;
        let header = text[start..].strip_prefix("%%%").and_then(|rest| rest.find("%%%"));
        tokens.resume(header.map_or(start, |length| start + 6 + length));
        tokens
    }

    pub(crate) fn peek(&self) -> Token {
        self.next
    }

    pub(crate) fn take(&mut self) -> Result<Token, RapidFault> {
        let token = self.next;
        if token.kind == TokenKind::Invalid {
            return Err(self.unexpected("a token"));
        }
        if token.kind == TokenKind::Placeholder {
            self.last_placeholder = Some(token.start);
        }
        self.resume(token.end);
        Ok(token)
    }

    /// Whether a placeholder was read from a byte on.
    pub(crate) fn unfinished_since(&self, byte: usize) -> bool {
        self.last_placeholder.is_some_and(|placeholder| placeholder >= byte)
    }

    /// Read the name of a required argument with its `:=`, if it is given.
    pub(crate) fn take_argument_name(&mut self) -> Result<(), RapidFault> {
        let behind = self.skip_blanks(self.next.end);
        if self.next.kind == TokenKind::Name && self.text[behind..].starts_with(":=") {
            self.take()?;
            self.take()?;
        }
        Ok(())
    }

    /// Read the name of an optional argument; the backslash is already read.
    pub(crate) fn take_option_name(&mut self) -> Result<&'a str, RapidFault> {
        if self.next.kind != TokenKind::Name || self.begins_statement(false) {
            return Err(self.lacking("the name of an optional argument"));
        }
        let name = self.take()?;
        Ok(self.text_of(name))
    }

    pub(crate) fn take_if(&mut self, symbol: u8) -> Result<bool, RapidFault> {
        let is = self.next.is(symbol);
        if is {
            self.take()?;
        }
        Ok(is)
    }

    /// The names of components, each behind its point.
    pub(crate) fn components(&mut self) -> Result<Vec<Cow<'a, str>>, RapidFault> {
        let mut components = Vec::new();
        while self.take_if(b'.')? {
            if self.next.kind != TokenKind::Name {
                return Err(self.lacking("the name of a component"));
            }
            let component = self.take()?;
            components.push(self.text_of(component).into());
        }
        Ok(components)
    }

    /// Read the symbol, or report what is in its place.
    pub(crate) fn demand(&mut self, symbol: u8, wanted: &'static str) -> Result<(), RapidFault> {
        if self.take_if(symbol)? { Ok(()) } else { Err(self.lacking(wanted)) }
    }

    pub(crate) fn text_of(&self, token: Token) -> &'a str {
        &self.text[token.start..token.end]
    }

    /// Whether the next token is this word, in any case.
    pub(crate) fn at_word(&self, word: &str) -> bool {
        self.next.kind == TokenKind::Name && self.text_of(self.next).eq_ignore_ascii_case(word)
    }

    pub(crate) fn take_word(&mut self, word: &str) -> Result<bool, RapidFault> {
        let is = self.at_word(word);
        if is {
            self.take()?;
        }
        Ok(is)
    }

    /// The error that the next token is not the expected one, or is none.
    pub(crate) fn unexpected(&self, wanted: &'static str) -> RapidFault {
        if let (TokenKind::Invalid, Err(fault)) = (self.next.kind, self.read(self.next.start)) {
            return fault;
        }
        let found = match self.next.kind {
            TokenKind::End => "the end of the text".to_string(),
            _ => excerpt(self.text_of(self.next)),
        };
        self.fault(self.next.start, RapidFaultKind::Unexpected { found, wanted })
    }

    pub(crate) fn fault(&self, byte: usize, kind: RapidFaultKind) -> RapidFault {
        let (line, column) = self.line_and_column(byte);
        RapidFault { line, column, kind }
    }

    /// Line and column of a byte, from 1. Counts from the byte of the previous call, so that calls
    /// for one statement after the other take linear time.
    pub(crate) fn line_and_column(&self, byte: usize) -> (usize, usize) {
        let place = self.place.get().moved(self.text, byte);
        self.place.set(place);
        (place.line, place.column)
    }

    /// The text that is read, without the blanks, NUL and Ctrl-Z at its end.
    pub(crate) fn content(&self) -> &'a [u8] {
        &self.text.as_bytes()[..self.end]
    }

    /// Continue after a byte that begins or ends a token.
    pub(crate) fn resume(&mut self, byte: usize) {
        self.last_end = byte;
        let start = self.skip_blanks(byte);
        let (kind, end) = self.read(start).unwrap_or((TokenKind::Invalid, start));
        self.next = Token { kind, start, end };
    }

    fn skip_blanks(&self, at: usize) -> usize {
        let at = behind_blanks(self.content(), at);
        if at < self.end { at } else { self.text.len() }
    }

    /// The kind and the end of the token that begins at a byte.
    fn read(&self, start: usize) -> Result<(TokenKind, usize), RapidFault> {
        let bytes = self.text.as_bytes();
        let second = bytes.get(start + 1).copied().unwrap_or(0);
        Ok(match bytes.get(start).copied() {
            None => (TokenKind::End, start),
            Some(b'0'..=b'9') => self.read_number(start)?,
            Some(b'.') if second.is_ascii_digit() => self.read_number(start)?,
            Some(b'"') => (TokenKind::Text, self.end_of_string(start)?),
            Some(b':') if second == b'=' => (TokenKind::Assign, start + 2),
            Some(b'<') => match placeholder_end(bytes, start) {
                Some(end) => (TokenKind::Placeholder, end),
                None => (TokenKind::Symbol(b'<'), start + 1),
            },
            // A header with an end is skipped.
            Some(b'%') if start == self.begin && self.text[start..].starts_with("%%%") => {
                let (inside, missing) = ("the header".to_string(), "%%%");
                return Err(self.fault(start, RapidFaultKind::UnexpectedEnd { inside, missing }));
            }
            Some(byte) if byte.is_ascii_punctuation() && SYMBOLS.contains(&byte) => {
                (TokenKind::Symbol(byte), start + 1)
            }
            Some(_) => (TokenKind::Name, self.end_of_name(start)?),
        })
    }

    fn end_of_name(&self, start: usize) -> Result<usize, RapidFault> {
        let end = end_of_word(self.text, start);
        let first = self.text[start..].chars().next().unwrap_or('\0');
        if end > start && first != '_' {
            return self.short(start, end, "name", LONGEST_NAME);
        }
        Err(self.fault(start, RapidFaultKind::UnexpectedCharacter { character: first }))
    }

    fn end_of_string(&self, start: usize) -> Result<usize, RapidFault> {
        let bytes = self.text.as_bytes();
        let mut at = start + 1;
        loop {
            match (bytes.get(at), bytes.get(at + 1)) {
                (Some(b'"'), Some(b'"')) => at += 2,
                (Some(b'"'), _) => return self.short(start, at + 1, "string", LONGEST_STRING),
                (None | Some(b'\n' | b'\r'), _) => {
                    return Err(self.fault(start, RapidFaultKind::UnterminatedString));
                }
                _ => at += 1,
            }
        }
    }

    /// The end of a name or a string, if it is not too long.
    fn short(
        &self,
        start: usize,
        end: usize,
        what: &'static str,
        bound: usize,
    ) -> Result<usize, RapidFault> {
        if end - start <= bound {
            Ok(end)
        } else {
            Err(self.fault(start, RapidFaultKind::TooLong { what, found: end - start, bound }))
        }
    }

    /// A number with its end: decimal, or whole with the prefix 0x, 0o or 0b.
    fn read_number(&self, start: usize) -> Result<(TokenKind, usize), RapidFault> {
        let bytes = self.text.as_bytes();
        if let Some((value, end)) = decimal(self.text, start) {
            return Ok((TokenKind::Number(value), end));
        }
        let mut end = start;
        while bytes.get(end).is_some_and(|&b| b.is_ascii_digit() || b == b'.') {
            end += 1;
        }
        if matches!(bytes.get(end), Some(b'e' | b'E')) {
            end += if matches!(bytes.get(end + 1), Some(b'+' | b'-')) { 2 } else { 1 };
        }
        // Adjacent letters and digits belong to it, so that 12abc is one invalid number and not a
        // number and a name.
        end = end_of_word(self.text, end);
        let text = &self.text[start..end];
        let fault = |kind| self.fault(start, kind);
        let value =
            number(text).ok_or_else(|| fault(RapidFaultKind::BadNumber { text: excerpt(text) }))?;
        if !value.is_finite() {
            return Err(fault(RapidFaultKind::NotFinite { text: excerpt(text) }));
        }
        Ok((TokenKind::Number(value), end))
    }
}

/// The first byte after blanks and comments.
pub(crate) fn behind_blanks(bytes: &[u8], mut at: usize) -> usize {
    while let Some(&byte) = bytes.get(at) {
        match byte {
            b' ' | b'\t' | b'\r' | b'\n' | 0x0b | 0x0c => at += 1,
            b'!' => {
                let line = &bytes[at..];
                let length = line.iter().position(|&b| b == b'\n' || b == b'\r');
                at += length.unwrap_or(line.len());
            }
            // A no-break space, in UTF-8.
            0xc2 if bytes.get(at + 1) == Some(&0xa0) => at += 2,
            _ => break,
        }
    }
    at
}

/// The end of the placeholder that begins at a byte: capital letters between `<` and `>`, without
/// blanks.
///
/// It is not a comparison: RAPID has none with three operands, as `a<B>c` would be.
fn placeholder_end(bytes: &[u8], start: usize) -> Option<usize> {
    let letters = bytes[start + 1..]
        .iter()
        .take(LONGEST_PLACEHOLDER + 1)
        .take_while(|byte| byte.is_ascii_uppercase())
        .count();
    let end = start + 1 + letters;
    ((1..=LONGEST_PLACEHOLDER).contains(&letters) && bytes.get(end) == Some(&b'>'))
        .then_some(end + 1)
}

/// The decimal number that begins at a byte, with its end. The byte is a digit, or a point before a
/// digit. `None` for what is invalid, not finite or not decimal, which [`number`] reads.
pub(crate) fn decimal(text: &str, start: usize) -> Option<(f64, usize)> {
    let bytes = text.as_bytes();
    let behind_digits = |from: usize| {
        let rest = bytes.get(from..).unwrap_or_default();
        from + rest.iter().take_while(|byte| byte.is_ascii_digit()).count()
    };
    let mut end = behind_digits(start);
    if bytes.get(end) == Some(&b'.') {
        end = behind_digits(end + 1);
    }
    if let Some(b'e' | b'E') = bytes.get(end) {
        let is_signed = matches!(bytes.get(end + 1), Some(b'+' | b'-'));
        end = behind_digits(end + 1 + usize::from(is_signed));
    }
    // The next byte may belong to it, as in 0x1F, 1.5.2 and 12abc.
    let follows = bytes.get(end).copied().unwrap_or(b' ');
    if is_word_byte(follows) || !follows.is_ascii() || follows == b'.' {
        return None;
    }
    let value: f64 = text.get(start..end)?.parse().ok()?;
    value.is_finite().then_some((value, end))
}

/// A number as RAPID writes it, without a sign; infinite if it is too large.
pub(crate) fn number(text: &str) -> Option<f64> {
    let radix = match text.as_bytes() {
        [b'0', b'x' | b'X', ..] => 16,
        [b'0', b'o' | b'O', ..] => 8,
        [b'0', b'b' | b'B', ..] => 2,
        // It has digits, and no letters except an exponent's: "inf" and "nan" do not get here.
        _ => return text.parse().ok(),
    };
    let digits =
        text.get(2..).filter(|digits| digits.bytes().all(|b| b.is_ascii_alphanumeric()))?;
    #[expect(clippy::cast_precision_loss, reason = "rounded as any other number is")]
    u64::from_str_radix(digits, radix).ok().map(|value| value as f64)
}

/// A string without its quotes: "" is a quote, \\ a backslash and \ with two hexadecimal digits the
/// character with that number.
pub(crate) fn unquoted(quoted: &str) -> String {
    let inner = quoted.get(1..quoted.len().saturating_sub(1)).unwrap_or_default();
    let mut text = String::new();
    let mut rest = inner;
    while let Some(character) = rest.chars().next() {
        let mut taken = character.len_utf8();
        let mut meant = character;
        let code = rest.get(1..3).filter(|code| code.bytes().all(|byte| byte.is_ascii_hexdigit()));
        match (character, code) {
            ('"', _) => taken = 2,
            ('\\', _) if rest[1..].starts_with('\\') => taken = 2,
            ('\\', Some(code)) => {
                meant = u8::from_str_radix(code, 16).map_or(character, char::from);
                taken = 3;
            }
            _ => {}
        }
        text.push(meant);
        rest = rest.get(taken..).unwrap_or_default();
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_end_behind_their_exponent() {
        for text in
            ["0", "12", ".5", "12.", "12.e3", "9E+09", "1e-7", "0.1e22", "4.9E-324", "1E100"]
        {
            let value: f64 = text.parse().unwrap();
            assert_eq!(decimal(text, 0), Some((value, text.len())), "{text}");
            assert_eq!(decimal(&std::format!("[{text},3]"), 1), Some((value, 1 + text.len())));
        }
    }

    #[test]
    fn numbers_that_are_no_finite_decimals_are_left() {
        for text in ["0x1F", "1.5.2", "12abc", "1_", "1E", "1E+", "1e400", "1\u{e9}", ".", ".e1"] {
            assert_eq!(decimal(text, 0), None, "{text}");
        }
    }
}
