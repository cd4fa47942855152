//! Going on over what is not read, with its brackets in pairs.

use alloc::string::String;
use alloc::vec::Vec;

use super::tokens::{Token, TokenKind, Tokens};
use crate::error::{RapidFault, RapidFaultKind};

/// What closes an opening symbol.
fn closing(open: u8) -> u8 {
    match open {
        b'[' => b']',
        b'(' => b')',
        _ => b'}',
    }
}

/// What a closing symbol that does not come tells: the bracket is open where the statement ends, and else something stands in its place.
pub(super) fn not_closed(tokens: &mut Tokens<'_>, open: Token, close: u8) -> RapidFault {
    match tokens.peek().kind {
        TokenKind::End | TokenKind::Symbol(b';') => {
            let bracket = tokens.text_of(open).chars().next().unwrap_or('[');
            tokens.fault(open.start, RapidFaultKind::Unclosed { bracket })
        }
        _ => {
            let mut wanted = String::from("a comma or ");
            wanted.push(char::from(close));
            tokens.unexpected(&wanted)
        }
    }
}

/// Whether the next token is an operator that is not calculated.
pub(super) fn is_unread_operator(tokens: &Tokens<'_>) -> bool {
    let word = |word: &&str| tokens.at_word(word);
    matches!(tokens.peek().kind, TokenKind::Symbol(b'=' | b'<' | b'>') | TokenKind::Placeholder)
        || ["AND", "OR", "XOR", "DIV", "MOD"].iter().any(word)
}

/// Words that end a statement wherever they stand: one that is not closed before them is broken.
fn is_end_of_routine(word: &str) -> bool {
    ["ENDPROC", "ENDFUNC", "ENDTRAP", "ENDMODULE", "PROC", "FUNC", "TRAP", "MODULE"]
        .iter()
        .any(|end| end.eq_ignore_ascii_case(word))
}

/// Goes on to the comma, semicolon or closing bracket that ends the argument.
pub(super) fn skip_to_end_of_argument(tokens: &mut Tokens<'_>) -> Result<(), RapidFault> {
    skip_balanced(tokens, |tokens, _| tokens.peek().is(b',') || tokens.peek().is(b'\\'))
}

/// Goes on over balanced brackets to where `ends` says, to a semicolon, a closing bracket or the end; none of these is taken.
///
/// `ends` is told the last token that was taken, and asked outside brackets only.
pub(super) fn skip_balanced(
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
                match open.pop().map(|bracket| tokens.text_of(bracket).as_bytes()[0]) {
                    None => return Ok(()),
                    Some(bracket) if closing(bracket) == symbol => {}
                    Some(bracket) => {
                        return Err(tokens.unexpected(&String::from(char::from(closing(bracket)))));
                    }
                }
            }
            _ => {}
        }
        last = Some(tokens.take()?);
    }
}
