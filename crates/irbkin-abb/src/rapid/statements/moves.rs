//! Move instructions as they are written.

use alloc::string::ToString;
use alloc::vec::Vec;

use super::faults::{Faults, end_statement};
use crate::rapid::data::fit::Fit;
use crate::rapid::data::moves::MoveOption;
use crate::rapid::data::moving::MoveInstruction;
use crate::rapid::data::settings::MotionSettings;
use crate::rapid::expression::names::At;
use crate::rapid::expression::reader::ExpressionReader;
use crate::rapid::expression::tree::Expression;
use crate::rapid::expression::whole::note;
use crate::rapid::text::fault::{RapidFault, RapidFaultKind};
use crate::rapid::text::tokens::{Token, Tokens};

/// Initial capacity for the required arguments: most moves have four or five.
const USUAL_ARGUMENTS: usize = 5;

/// A move before its names are looked up.
pub(crate) struct WrittenMove<'a> {
    pub(crate) instruction: &'static MoveInstruction,
    /// Its name, as it is written.
    pub(crate) name: &'a str,
    /// Bytes of the statement with its semicolon.
    pub(crate) start: usize,
    pub(crate) end: usize,
    pub(crate) at: At,
    pub(crate) line: usize,
    pub(crate) column: usize,
    /// Line of the instruction that displaces it.
    pub(crate) displaced: Option<usize>,
    pub(crate) required: Vec<Expression<'a>>,
    pub(crate) wobj: Option<Expression<'a>>,
    pub(crate) options: Vec<MoveOption>,
    /// The names and the values of the options, to be evaluated.
    pub(crate) values: Vec<(&'a str, Option<Expression<'a>>)>,
    pub(crate) settings: MotionSettings,
}

/// Read the arguments of a move up to its semicolon; the instruction's name at byte `start` is
/// already read. `None` for an unfinished one.
pub(crate) fn read_move<'a>(
    tokens: &mut Tokens<'a>,
    faults: &mut Faults<'_>,
    instruction: &'static MoveInstruction,
    (start, name): (usize, Token),
) -> Result<Option<WrittenMove<'a>>, RapidFault> {
    let (line, column) = tokens.line_and_column(start);
    let (mut required, mut options, mut wobj): (Vec<Expression<'a>>, Vec<MoveOption>, _) =
        (Vec::with_capacity(USUAL_ARGUMENTS), Vec::new(), None);
    let mut values = Vec::new();
    let mut fit = Fit::with(instruction.name, Some(instruction.arguments));
    loop {
        let next = tokens.peek();
        // A comma may precede an optional argument too.
        let is_first = required.is_empty() && options.is_empty() && wobj.is_none();
        let is_end = is_first && tokens.begins_statement(true);
        if next.is(b';') || is_end || !is_first && !next.is(b',') && !next.is(b'\\') {
            break;
        }
        if !is_first {
            tokens.take_if(b',')?;
        }
        if !tokens.take_if(b'\\')? {
            required.push(ExpressionReader::new(tokens).argument()?);
            continue;
        }
        let (name, value) = ExpressionReader::new(tokens).optional()?;
        match value {
            Some(value) if wobj.is_none() && name.eq_ignore_ascii_case("WObj") => {
                fit.optional(name, true);
                wobj = Some(value);
            }
            value => {
                fit.optional(name, value.is_some());
                let text = value.as_ref().map(|it| tokens.text[it.start..it.end].to_string());
                options.push(MoveOption { after: required.len(), name: name.to_string(), text });
                values.push((name, value));
            }
        }
    }
    end_statement(tokens, faults, "a comma or a semicolon")?;
    if tokens.unfinished_since(start) {
        return Ok(None);
    }
    if instruction.is_basic() && required.len() != instruction.arguments() {
        let kind = RapidFaultKind::ArgumentCount {
            instruction: instruction.name,
            found: required.len(),
            wanted: instruction.arguments(),
        };
        return Err(tokens.fault(start, kind));
    }
    if fit.wrong.is_some() || !instruction.is_basic() {
        for _ in &required {
            fit.required();
        }
        note(tokens, name, false, fit);
    }
    Ok(Some(WrittenMove {
        instruction,
        name: tokens.text_of(name).trim_matches('"'),
        start,
        end: tokens.last_end,
        at: At::default(),
        line,
        column,
        displaced: None,
        required,
        wobj,
        options,
        values,
        settings: MotionSettings::default(),
    }))
}
