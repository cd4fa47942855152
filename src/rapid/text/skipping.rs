//! Skip unread text with balanced brackets.

use alloc::vec::Vec;

use super::tokens::{Token, TokenKind, Tokens};
use crate::error::{RapidFault, RapidFaultKind};

/// The symbol that closes an opening one, and its name in a message.
fn closing(open: u8) -> (u8, &'static str) {
    match open {
        b'[' => (b']', "]"),
        b'(' => (b')', ")"),
        _ => (b'}', "}"),
    }
}

/// The error for a missing closing symbol: the bracket is open at the end of the statement, or
/// something else is in its place.
pub(crate) fn not_closed(tokens: &Tokens<'_>, open: Token, close: u8) -> RapidFault {
    match tokens.peek().kind {
        TokenKind::End | TokenKind::Symbol(b';') => {
            let bracket = tokens.text_of(open).chars().next().unwrap_or('[');
            tokens.fault(open.start, RapidFaultKind::Unclosed { bracket })
        }
        _ => tokens.unexpected(match close {
            b']' => "a comma or ]",
            b')' => "a comma or )",
            _ => "a comma or }",
        }),
    }
}

/// Whether the next token is an operator that is not evaluated.
pub(crate) fn is_unread_operator(tokens: &Tokens<'_>) -> bool {
    let word = |word: &&str| tokens.at_word(word);
    matches!(tokens.peek().kind, TokenKind::Symbol(b'=' | b'<' | b'>') | TokenKind::Placeholder)
        || ["AND", "OR", "XOR"].iter().any(word)
}

/// Words that end a statement at any place: one that is not closed before them is invalid.
fn is_end_of_routine(word: &str) -> bool {
    ["ENDPROC", "ENDFUNC", "ENDTRAP", "ENDMODULE", "PROC", "FUNC", "TRAP", "MODULE"]
        .iter()
        .any(|end| end.eq_ignore_ascii_case(word))
}

/// Skip to the comma, semicolon or closing bracket that ends the argument.
pub(crate) fn skip_to_end_of_argument(tokens: &mut Tokens<'_>) -> Result<(), RapidFault> {
    skip_balanced(tokens, |tokens, _| tokens.peek().is(b',') || tokens.peek().is(b'\\'))
}

/// Skip over balanced brackets until `ends` returns true, or to a semicolon, a closing bracket or
/// the end; none of these is read.
///
/// `ends` gets the last token that was read, and is called outside brackets only.
pub(crate) fn skip_balanced(
    tokens: &mut Tokens<'_>,
    ends: impl Fn(&Tokens<'_>, Option<Token>) -> bool,
) -> Result<(), RapidFault> {
    let mut open: Vec<Token> = Vec::new();
    let mut last = None;
    loop {
        let token = tokens.peek();
        let ended = match token.kind {
            TokenKind::End | TokenKind::Symbol(b';') => true,
            TokenKind::Name => is_end_of_routine(tokens.text_of(token)),
            _ => false,
        };
        match open.last().copied() {
            None if ended || ends(tokens, last) => return Ok(()),
            Some(bracket) if ended => {
                let character = tokens.text_of(bracket).chars().next().unwrap_or('[');
                return Err(
                    tokens.fault(bracket.start, RapidFaultKind::Unclosed { bracket: character })
                );
            }
            _ => {}
        }
        match token.kind {
            TokenKind::Symbol(b'[' | b'(' | b'{') => open.push(token),
            TokenKind::Symbol(symbol @ (b']' | b')' | b'}')) => {
                match open.pop().map(|bracket| closing(tokens.text_of(bracket).as_bytes()[0])) {
                    None => return Ok(()),
                    Some((wanted, _)) if wanted == symbol => {}
                    Some((_, wanted)) => return Err(tokens.unexpected(wanted)),
                }
            }
            _ => {}
        }
        last = Some(tokens.take()?);
    }
}

/// The first bytes of the lines that git leaves in a conflict.
const CONFLICT_MARKERS: [&str; 4] = ["<<<<<<<", "|||||||", "=======", ">>>>>>>"];

/// Whether the line that begins at a byte is one that git leaves in a conflict.
pub(crate) fn is_conflict_marker(text: &str, byte: usize) -> bool {
    let is_first = matches!(text.as_bytes().get(byte.wrapping_sub(1)), None | Some(b'\n' | b'\r'));
    is_first && CONFLICT_MARKERS.iter().any(|marker| text[byte..].starts_with(marker))
}

/// The end of the line of a byte.
pub(crate) fn end_of_line(text: &str, byte: usize) -> usize {
    text[byte..].find(['\n', '\r']).map_or(text.len(), |length| byte + length)
}

/// The next token, if it begins a line and may begin a statement.
pub(crate) fn at_line(tokens: &Tokens<'_>) -> Option<usize> {
    let next = tokens.peek();
    let between = tokens.text.get(tokens.last_end..next.start).unwrap_or_default();
    (next.kind == TokenKind::Name && between.contains(['\n', '\r'])).then_some(next.start)
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
