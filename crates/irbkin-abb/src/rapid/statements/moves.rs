//! Move instructions as they are written.

use super::faults::{Faults, end_statement};
use crate::rapid::data::expression::Arguments;
use crate::rapid::data::moves::MoveKind;
use crate::rapid::data::moving::MoveInstruction;
use crate::rapid::data::settings::MotionSettings;
use crate::rapid::data::value::DataType;
use crate::rapid::expression::direct::read_direct;
use crate::rapid::expression::names::At;
use crate::rapid::expression::reader::{ExpressionReader, note};
use crate::rapid::text::fault::{RapidFault, RapidFaultKind};
use crate::rapid::text::tokens::{Token, Tokens};

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
    let data_type = match instruction.way {
        MoveKind::MoveAbsJ | MoveKind::MoveExtJ => DataType::JointTarget,
        _ => DataType::RobTarget,
    };
    let is_basic = instruction.is_basic();
    let target = if is_basic { read_direct(tokens, data_type, b',') } else { None };
    let arguments = ExpressionReader::new(tokens).arguments(target)?;
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
        note(tokens, start, name, false, &arguments);
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
        settings: MotionSettings::default(),
    }))
}
