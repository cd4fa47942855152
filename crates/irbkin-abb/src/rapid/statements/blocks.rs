//! Control flow: the lines of branches, loops and handlers.

use super::declarations::read_name;
use crate::prelude::*;
use crate::rapid::data::expression::Expression;
use crate::rapid::data::statement::{Condition, Counter, Flow};
use crate::rapid::expression::reader::{DEEPEST_NESTING, ExpressionReader};
use crate::rapid::text::fault::{RapidFault, RapidFaultKind};
use crate::rapid::text::tokens::{Token, TokenKind, Tokens};
use crate::rapid::text::words::is_reserved;

/// Words that begin a block, with those that end it.
const BLOCKS: [(&str, &str); 4] =
    [("IF", "ENDIF"), ("FOR", "ENDFOR"), ("WHILE", "ENDWHILE"), ("TEST", "ENDTEST")];

/// Words that divide a block or a routine.
const PARTS: [&str; 7] = ["ELSEIF", "ELSE", "CASE", "DEFAULT", "ERROR", "UNDO", "BACKWARD"];

/// Reserved words with which an instruction begins.
const INSTRUCTIONS: [&str; 11] = [
    "IF", "FOR", "WHILE", "TEST", "RETURN", "EXIT", "GOTO", "RAISE", "RETRY", "TRYNEXT", "CONNECT",
];

/// Whether a word in capitals begins, divides or ends a block.
pub(crate) fn is_flow(word: &str) -> bool {
    BLOCKS.iter().any(|(begin, end)| *begin == word || *end == word) || PARTS.contains(&word)
}

/// The open blocks of a routine, and the loops of a module.
#[derive(Default)]
pub(crate) struct Blocks<'a> {
    /// Index into BLOCKS and, of a FOR, into the loops.
    open: Vec<(usize, Option<usize>)>,
    /// The variable of each loop, with the loop around it.
    loops: Vec<(&'a str, Option<usize>)>,
}

impl<'a> Blocks<'a> {
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
    ) -> Result<Flow, RapidFault> {
        let begin = token.start;
        Ok(match word {
            _ if BLOCKS.iter().any(|(_, end)| *end == word) => {
                self.open.pop();
                Flow::End
            }
            "IF" => {
                let condition = Condition::of(operand(tokens, begin)?);
                let is_single = !tokens.take_word("THEN")?;
                if is_single {
                    check_instruction(tokens)?;
                } else {
                    self.begin(tokens, 0, None, token)?;
                }
                Flow::If { condition, is_single }
            }
            "ELSEIF" => {
                let condition = Condition::of(operand(tokens, begin)?);
                demand_word(tokens, "THEN")?;
                Flow::Part(condition)
            }
            "FOR" => {
                let variable = read_name(tokens, "the variable of the loop")?;
                demand_word(tokens, "FROM")?;
                let from = operand(tokens, begin)?;
                demand_word(tokens, "TO")?;
                let to = operand(tokens, begin)?;
                let mut step = None;
                if tokens.take_word("STEP")? {
                    step = Some(operand(tokens, begin)?);
                }
                demand_word(tokens, "DO")?;
                self.loops.push((variable, self.innermost_loop()));
                self.begin(tokens, 1, Some(self.loops.len() - 1), token)?;
                let (variable, bounds) = (variable.to_lowercase(), [from, to]);
                let counter = Some(Box::new(Counter { variable, bounds, step }));
                Flow::Loop { condition: Condition::Other(None), counter }
            }
            "WHILE" => {
                let condition = Condition::of(operand(tokens, begin)?);
                demand_word(tokens, "DO")?;
                self.begin(tokens, 2, None, token)?;
                Flow::Loop { condition, counter: None }
            }
            "TEST" => {
                let tested = operand(tokens, begin)?;
                if !["CASE", "DEFAULT", "ENDTEST"].iter().any(|word| tokens.at_word(word)) {
                    return Err(tokens.lacking("CASE"));
                }
                self.begin(tokens, 3, None, token)?;
                Flow::Test(Some(tested))
            }
            "CASE" => {
                let mut values = Vec::from([operand(tokens, begin)?]);
                while tokens.take_if(b',')? {
                    values.push(operand(tokens, begin)?);
                }
                tokens.demand(b':', "a colon")?;
                Flow::Part(Condition::Case(values))
            }
            "DEFAULT" => {
                tokens.demand(b':', "a colon")?;
                Flow::Part(Condition::Always)
            }
            "ELSE" => Flow::Part(Condition::Always),
            // A handler may name the errors that it handles.
            "ERROR" if tokens.peek().is(b'(') => {
                tokens.take()?;
                ExpressionReader::of_condition(tokens).arguments(None)?;
                tokens.demand(b')', "a comma or )")?;
                Flow::Handler
            }
            _ => Flow::Handler,
        })
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

    pub(super) fn depth(&self) -> usize {
        self.open.len()
    }

    /// Open the block that an invalid line begins by a word, in any case, if it may be opened.
    pub(super) fn open(&mut self, word: &str) -> Option<Flow> {
        let block = BLOCKS.iter().position(|(begin, _)| begin.eq_ignore_ascii_case(word));
        let block = block.filter(|_| self.open.len() < DEEPEST_NESTING)?;
        self.open.push((block, None));
        let condition = Condition::Other(None);
        Some(match BLOCKS[block].0 {
            "IF" => Flow::If { condition, is_single: false },
            "TEST" => Flow::Test(None),
            _ => Flow::Loop { condition, counter: None },
        })
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

/// Read what is between the words of a branch or a loop that begins at a byte.
fn operand(tokens: &mut Tokens<'_>, begin: usize) -> Result<Expression<'static>, RapidFault> {
    Ok(ExpressionReader::of_condition(tokens).expression()?.owned(begin))
}

pub(super) fn demand_word(tokens: &mut Tokens<'_>, word: &'static str) -> Result<(), RapidFault> {
    if tokens.take_word(word)? { Ok(()) } else { Err(tokens.lacking(word)) }
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
    if may { Ok(()) } else { Err(tokens.lacking("THEN or an instruction")) }
}
