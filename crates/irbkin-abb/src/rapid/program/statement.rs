//! Statements as they are executed, read once: what they do, with their expressions.

use alloc::string::String;
use alloc::vec::Vec;

use super::arguments::{arguments, assignment, called, referred};
use crate::rapid::data::instructions::Effect;
use crate::rapid::data::lookup::written_argument;
use crate::rapid::data::unread::{NotRead, Skipped};
use crate::rapid::expression::reader::ExpressionReader;
use crate::rapid::expression::tree::{Arguments, Expression};
use crate::rapid::text::fault::RapidFault;
use crate::rapid::text::tokens::{TokenKind, Tokens};

/// What a statement does that is no move, no setting and no part of a branch or a loop.
pub(super) enum Action<'m> {
    Nothing,
    /// It is unfinished or invalid: it may move the robot.
    Unread,
    Label,
    Assign {
        target: Expression<'m>,
        value: Expression<'m>,
        /// The datum in lower case, and its component, joined by dots.
        to: (String, String),
    },
    /// An instruction, or a call of a routine.
    Instruct(Instruction<'m>),
}

/// An instruction, or a call of a routine.
pub(super) struct Instruction<'m> {
    pub(super) effect: Effect,
    /// The name in lower case of the routine that it calls, if there is one; `None` if the name is
    /// calculated.
    pub(super) name: Option<String>,
    /// `None` if they are not as RAPID has them.
    pub(super) arguments: Option<Arguments<'m>>,
    /// The datum in lower case that it writes to, and its component, joined by dots.
    pub(super) written: Option<(String, String)>,
}

impl<'m> Action<'m> {
    pub(super) fn of(skipped: &'m Skipped) -> Self {
        match &skipped.what {
            NotRead::Unfinished { .. } | NotRead::Invalid { .. } => Self::Unread,
            NotRead::Label { .. } => Self::Label,
            NotRead::Assignment { .. } => match assignment(&skipped.text) {
                Ok((target, value)) => {
                    referred(&target).map_or(Self::Nothing, |to| Self::Assign { target, value, to })
                }
                Err(_) => Self::Nothing,
            },
            NotRead::Motion { name } | NotRead::Instruction { name } => {
                Self::Instruct(Instruction::of(name, &skipped.text))
            }
            _ => Self::Nothing,
        }
    }
}

impl<'m> Instruction<'m> {
    fn of(name: &str, text: &'m str) -> Self {
        let arguments = arguments(text).ok();
        let place = written_argument(name).and_then(|place| place.checked_sub(1));
        let written = place.and_then(|place| arguments.as_ref()?.required.get(place));
        let written = written.and_then(referred);
        Self { effect: Effect::of(name), name: called(text), arguments, written }
    }
}

/// A condition of a part of a branch, or of a loop, as far as it is evaluated.
pub(super) enum Condition<'m> {
    /// `TRUE`, ELSE, DEFAULT.
    Always,
    /// `FALSE`.
    Never,
    /// Whether an optional parameter, in lower case, must be there: `Present(x)`, `NOT Present(x)`.
    Present(String, bool),
    /// Of two numbers, in a text.
    Compared {
        text: &'m str,
        numbers: [Expression<'m>; 2],
        relation: Relation,
    },
    /// Whether what is tested is one of some numbers.
    Case {
        text: &'m str,
        numbers: Vec<Expression<'m>>,
    },
    Other,
}

/// A relation of two numbers.
pub(super) type Relation = fn(f64, f64) -> bool;

impl<'m> Condition<'m> {
    /// Of the first line of a branch, of a part of it, or of a loop.
    pub(super) fn of(head: &'m str) -> Self {
        Self::read(head).ok().flatten().unwrap_or(Self::Other)
    }

    /// Whether a variable, in lower case, decides on it.
    pub(super) fn depends_on(&self, lower: &str) -> bool {
        matches!(self, Self::Compared { numbers, .. } if depends_on(numbers, lower))
    }

    fn read(text: &'m str) -> Result<Option<Self>, RapidFault> {
        let mut tokens = Tokens::new(text)?;
        if tokens.take_word("ELSE")? || tokens.take_word("DEFAULT")? {
            return Ok(Some(Self::Always));
        }
        if tokens.take_word("CASE")? {
            let mut numbers = Vec::from([ExpressionReader::new(&mut tokens).sum()?]);
            while tokens.take_if(b',')? {
                numbers.push(ExpressionReader::new(&mut tokens).sum()?);
            }
            return Ok(tokens.take_if(b':')?.then_some(Self::Case { text, numbers }));
        }
        tokens.take()?;
        let condition = if tokens.take_word("FALSE")? {
            Self::Never
        } else if tokens.take_word("TRUE")? {
            Self::Always
        } else {
            let mark = tokens.mark();
            let is_wanted = !tokens.take_word("NOT")?;
            if tokens.take_word("Present")? {
                tokens.take()?;
                let name = tokens.take()?;
                tokens.take()?;
                Self::Present(tokens.text_of(name).to_lowercase(), is_wanted)
            } else {
                tokens.rewind(mark);
                let left = ExpressionReader::new(&mut tokens).sum()?;
                let Some(relation) = relation(&mut tokens)? else { return Ok(None) };
                let right = ExpressionReader::new(&mut tokens).sum()?;
                Self::Compared { text, numbers: [left, right], relation }
            }
        };
        let is_alone = tokens.peek().kind == TokenKind::End || tokens.take_word("THEN")?;
        Ok((is_alone || tokens.take_word("DO")?).then_some(condition))
    }
}

/// Whether numbers depend on a name, in lower case, and on nothing else.
pub(super) fn depends_on<'e>(
    numbers: impl IntoIterator<Item = &'e Expression<'e>>,
    lower: &str,
) -> bool {
    let mut names = Vec::new();
    numbers.into_iter().for_each(|number| number.collect_names(&mut names));
    !names.is_empty() && names.iter().all(|name| name.to_lowercase() == lower)
}

/// The relation at the next token, if there is one.
fn relation(tokens: &mut Tokens<'_>) -> Result<Option<Relation>, RapidFault> {
    let relation: Relation = if tokens.take_if(b'=')? {
        |a, b| a.total_cmp(&b).is_eq()
    } else if tokens.take_if(b'<')? {
        if tokens.take_if(b'>')? {
            |a, b| a.total_cmp(&b).is_ne()
        } else if tokens.take_if(b'=')? {
            |a, b| a <= b
        } else {
            |a, b| a < b
        }
    } else if tokens.take_if(b'>')? {
        if tokens.take_if(b'=')? { |a, b| a >= b } else { |a, b| a > b }
    } else {
        return Ok(None);
    };
    Ok(Some(relation))
}

/// What the first line of a TEST tests.
pub(super) fn tested(head: &str) -> Option<Expression<'_>> {
    let mut tokens = Tokens::new(head).ok()?;
    let is_test = tokens.take_word("TEST").ok()?;
    is_test.then(|| ExpressionReader::new(&mut tokens).sum().ok())?
}

/// The variable of a FOR and its bounds.
pub(super) struct Counter<'m> {
    /// Its name in lower case.
    pub(super) variable: String,
    /// From, to and step.
    pub(super) bounds: [Option<Expression<'m>>; 3],
}

impl<'m> Counter<'m> {
    /// Of the first line of a FOR.
    pub(super) fn of(head: &'m str) -> Option<Self> {
        let mut tokens = Tokens::new(head).ok()?;
        if !tokens.take_word("FOR").ok()? {
            return None;
        }
        let name = tokens.take().ok()?;
        let variable = tokens.text_of(name).to_lowercase();
        let mut bounds = [None, None, None];
        for (bound, word) in bounds.iter_mut().zip(["FROM", "TO", "STEP"]) {
            if tokens.take_word(word).ok()? {
                *bound = Some(ExpressionReader::new(&mut tokens).sum().ok()?);
            }
        }
        Some(Self { variable, bounds })
    }
}
