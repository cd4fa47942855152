//! Move instructions as they are written.

use alloc::string::ToString;
use alloc::vec::Vec;

use super::faults::{Faults, end_statement};
use crate::rapid::data::expression::Arguments;
use crate::rapid::data::moves::MoveOption;
use crate::rapid::data::moving::MoveInstruction;
use crate::rapid::data::settings::MotionSettings;
use crate::rapid::expression::names::At;
use crate::rapid::expression::reader::{ExpressionReader, note};
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
    pub(crate) arguments: Arguments<'a>,
    /// The optional arguments but for the work object, as they are written.
    pub(crate) options: Vec<MoveOption>,
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
    let mut arguments = Arguments::default();
    arguments.required.reserve_exact(USUAL_ARGUMENTS);
    let mut options = Vec::new();
    loop {
        let next = tokens.peek();
        // A comma may precede an optional argument too.
        let is_first = arguments.required.is_empty() && arguments.optional.is_empty();
        let is_end = is_first && tokens.begins_statement(true);
        if next.is(b';') || is_end || !is_first && !next.is(b',') && !next.is(b'\\') {
            break;
        }
        if !is_first {
            tokens.take_if(b',')?;
        }
        if !tokens.take_if(b'\\')? {
            arguments.required.push(ExpressionReader::new(tokens).argument()?);
            continue;
        }
        let (name, value) = ExpressionReader::new(tokens).optional()?;
        let is_wobj = name.eq_ignore_ascii_case("WObj") && value.is_some();
        if !is_wobj || arguments.value("WObj").is_some() {
            let text = value.as_ref().map(|it| tokens.text[it.start..it.end].to_string());
            let after = arguments.required.len();
            options.push(MoveOption { after, name: name.to_string(), text });
        }
        arguments.optional.push((name, value));
    }
    end_statement(tokens, faults, "a comma or a semicolon")?;
    if tokens.unfinished_since(start) {
        return Ok(None);
    }
    let found = arguments.required.len();
    if instruction.is_basic() && found != instruction.arguments() {
        let kind = RapidFaultKind::ArgumentCount {
            instruction: instruction.name,
            found,
            wanted: instruction.arguments(),
        };
        return Err(tokens.fault(start, kind));
    }
    if !arguments.optional.is_empty() || !instruction.is_basic() {
        note(tokens, name, false, &arguments);
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
        arguments,
        options,
        settings: MotionSettings::default(),
    }))
}
