//! Control flow: blocks are recognized, conditions are not evaluated.

use alloc::vec::Vec;

use super::declarations::read_name;
use crate::error::{RapidFault, RapidFaultKind};
use crate::rapid::data::moves::MoveKind;
use crate::rapid::expression::reader::DEEPEST_NESTING;
use crate::rapid::text::skipping::skip_balanced;
use crate::rapid::text::tokens::{Token, TokenKind, Tokens};
use crate::rapid::text::words::is_reserved;

/// Words that begin a block, with those that end it.
const BLOCKS: [(&str, &str); 4] =
    [("IF", "ENDIF"), ("FOR", "ENDFOR"), ("WHILE", "ENDWHILE"), ("TEST", "ENDTEST")];

/// Words that divide a block or a routine.
const PARTS: [&str; 7] = ["ELSEIF", "ELSE", "CASE", "DEFAULT", "ERROR", "UNDO", "BACKWARD"];

/// Words between operands.
const OPERATORS: [&str; 6] = ["AND", "OR", "XOR", "NOT", "DIV", "MOD"];

/// Reserved words with which an instruction begins.
const INSTRUCTIONS: [&str; 11] = [
    "IF", "FOR", "WHILE", "TEST", "RETURN", "EXIT", "GOTO", "RAISE", "RETRY", "TRYNEXT", "CONNECT",
];

/// Whether a word in capitals begins, divides or ends a block.
pub(crate) fn is_flow(word: &str) -> bool {
    BLOCKS.iter().any(|(begin, end)| *begin == word || *end == word) || PARTS.contains(&word)
}

/// Whether the next token begins another statement at any place.
pub(crate) fn begins_another(tokens: &Tokens<'_>) -> bool {
    let token = tokens.peek();
    if token.kind != TokenKind::Name {
        return false;
    }
    let word = tokens.text_of(token);
    let is = |other: &str| other.eq_ignore_ascii_case(word);
    MoveKind::named(word).is_some()
        || BLOCKS.iter().any(|(begin, end)| is(begin) || is(end))
        || ["CONST", "PERS", "VAR", "ELSE", "ELSEIF"].into_iter().any(is)
}

/// The open blocks of a routine, and the loops of a module.
pub(crate) struct Blocks<'a> {
    /// Index into BLOCKS and, of a FOR, into the loops.
    open: Vec<(usize, Option<usize>)>,
    /// The variable of each loop, with the loop around it.
    loops: Vec<(&'a str, Option<usize>)>,
}

impl<'a> Blocks<'a> {
    pub(crate) fn new() -> Self {
        Self { open: Vec::new(), loops: Vec::new() }
    }

    /// The words that began the innermost block and that end it.
    pub(crate) fn innermost(&self) -> Option<(&'static str, &'static str)> {
        self.open.last().map(|(block, _)| BLOCKS[*block])
    }

    /// The innermost loop that has a variable.
    pub(crate) fn innermost_loop(&self) -> Option<usize> {
        self.open.iter().rev().find_map(|(_, inside)| *inside)
    }

    /// Whether a name is the variable of a loop or of one around it.
    pub(crate) fn is_variable(&self, mut inside: Option<usize>, name: &str) -> bool {
        while let Some((variable, around)) = inside.and_then(|index| self.loops.get(index)) {
            if variable.to_lowercase() == name {
                return true;
            }
            inside = *around;
        }
        false
    }

    /// Read the line that begins with a word in capitals, which is already read.
    pub(crate) fn read(
        &mut self,
        tokens: &mut Tokens<'a>,
        word: &str,
        token: Token,
    ) -> Result<(), RapidFault> {
        match word {
            _ if BLOCKS.iter().any(|(_, end)| *end == word) => {
                self.open.pop();
                Ok(())
            }
            "IF" => {
                skip_condition(tokens)?;
                // Without THEN it is one instruction, which follows.
                if tokens.take_word("THEN")? {
                    self.begin(tokens, 0, None, token)
                } else {
                    check_instruction(tokens)
                }
            }
            "ELSEIF" => {
                skip_condition(tokens)?;
                if tokens.take_word("THEN")? { Ok(()) } else { Err(tokens.unexpected("THEN")) }
            }
            "FOR" => {
                let variable = read_name(tokens, "the variable of the loop")?;
                skip_to_do(tokens)?;
                self.loops.push((variable, self.innermost_loop()));
                self.begin(tokens, 1, Some(self.loops.len() - 1), token)
            }
            "WHILE" => {
                skip_to_do(tokens)?;
                self.begin(tokens, 2, None, token)
            }
            "TEST" => {
                let at_case = |tokens: &Tokens<'_>| {
                    ["CASE", "DEFAULT", "ENDTEST"].iter().any(|word| tokens.at_word(word))
                };
                skip_balanced(tokens, |tokens, _| at_case(tokens))?;
                if at_case(tokens) {
                    self.begin(tokens, 3, None, token)
                } else {
                    Err(tokens.unexpected("CASE"))
                }
            }
            "CASE" | "DEFAULT" => {
                skip_balanced(tokens, |tokens, _| tokens.peek().is(b':'))?;
                tokens.demand(b':', "a colon")
            }
            // A handler may name the errors that it handles.
            "ERROR" if tokens.peek().is(b'(') => {
                skip_balanced(tokens, |_, last| last.is_some_and(|last| last.is(b')')))
            }
            _ => Ok(()),
        }
    }

    fn begin(
        &mut self,
        tokens: &Tokens<'_>,
        block: usize,
        inside: Option<usize>,
        token: Token,
    ) -> Result<(), RapidFault> {
        if self.open.len() == DEEPEST_NESTING {
            return Err(
                tokens.fault(token.start, RapidFaultKind::TooDeep { bound: DEEPEST_NESTING })
            );
        }
        self.open.push((block, inside));
        Ok(())
    }

    /// The number of open blocks.
    pub(super) fn depth(&self) -> usize {
        self.open.len()
    }

    /// Open the block that a word begins, in any case; false if none is opened.
    pub(super) fn open(&mut self, word: &str) -> bool {
        let block = BLOCKS.iter().position(|(begin, _)| begin.eq_ignore_ascii_case(word));
        let block = block.filter(|_| self.open.len() < DEEPEST_NESTING);
        self.open.extend(block.map(|block| (block, None)));
        block.is_some()
    }

    /// Close the innermost block; its end.
    pub(super) fn close_innermost(&mut self) -> Option<&'static str> {
        self.open.pop().map(|(block, _)| BLOCKS[block].1)
    }

    /// Of a word that ends a block: the number of blocks around the one that it ends, if there is
    /// one, and the word that is expected, if that is another one. `None` for other words.
    pub(super) fn ended_by(&self, word: &str) -> Option<(Option<usize>, Option<&'static str>)> {
        let block = BLOCKS.iter().position(|(_, end)| *end == word)?;
        let outer = self.open.iter().rposition(|(open, _)| *open == block);
        let wanted = match self.open.last() {
            Some((open, _)) if *open == block => None,
            Some((open, _)) => Some(BLOCKS[*open].1),
            None => Some("a declaration or an instruction (no such block is open)"),
        };
        Some((outer, wanted))
    }
}

/// Skip to the end of a condition: a word after an operand that is not an operator begins the next
/// part.
fn skip_condition(tokens: &mut Tokens<'_>) -> Result<(), RapidFault> {
    skip_balanced(tokens, |tokens, last| {
        let next = tokens.peek();
        let is_operator = |token: Token| {
            OPERATORS.iter().any(|word| word.eq_ignore_ascii_case(tokens.text_of(token)))
        };
        let after_operand = last.is_some_and(|last| match last.kind {
            TokenKind::Name => !is_operator(last),
            TokenKind::Number(_)
            | TokenKind::Text
            | TokenKind::Placeholder
            | TokenKind::Symbol(b']' | b')' | b'}') => true,
            _ => false,
        });
        after_operand
            && (next.is(b'%')
                || next.kind == TokenKind::Placeholder
                || next.kind == TokenKind::Name && !is_operator(next))
    })
}

/// Check that an instruction follows, not a declaration or an end.
fn check_instruction(tokens: &mut Tokens<'_>) -> Result<(), RapidFault> {
    let token = tokens.peek();
    let word = tokens.text_of(token);
    let may = match token.kind {
        TokenKind::Name if word.eq_ignore_ascii_case("TASK") => false,
        TokenKind::Name => {
            !is_reserved(word)
                || INSTRUCTIONS.iter().any(|instruction| instruction.eq_ignore_ascii_case(word))
        }
        TokenKind::Symbol(symbol) => symbol == b'%',
        TokenKind::Placeholder => true,
        _ => false,
    };
    if may { Ok(()) } else { Err(tokens.unexpected("THEN or an instruction")) }
}

fn skip_to_do(tokens: &mut Tokens<'_>) -> Result<(), RapidFault> {
    skip_balanced(tokens, |tokens, _| tokens.at_word("DO"))?;
    if tokens.take_word("DO")? { Ok(()) } else { Err(tokens.unexpected("DO")) }
}
