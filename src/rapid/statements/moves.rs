//! Move instructions as they are written.

use alloc::string::ToString;
use alloc::vec::Vec;

use crate::error::{RapidFault, RapidFaultKind};
use crate::rapid::data::moves::MoveOption;
use crate::rapid::data::moving::MoveInstruction;
use crate::rapid::data::settings::MotionSettings;
use crate::rapid::expression::names::At;
use crate::rapid::expression::reader::ExpressionReader;
use crate::rapid::expression::tree::Expression;
use crate::rapid::text::tokens::Tokens;

/// Initial capacity for the required arguments: most moves have four or five.
const USUAL_ARGUMENTS: usize = 5;

/// A move before its names are looked up.
pub(crate) struct WrittenMove<'a> {
    pub(crate) instruction: &'static MoveInstruction,
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
    pub(crate) overrides: Overrides<'a>,
    pub(crate) settings: MotionSettings,
}

/// The value of an option that replaces a part of the speed or of the zone.
pub(crate) enum Replacement<'a> {
    /// It has no value.
    Nothing,
    Value(Expression<'a>),
}

/// The options that replace a part of the speed or of the zone.
#[derive(Default)]
pub(crate) struct Overrides<'a> {
    /// `\V`.
    pub(crate) velocity: Option<Replacement<'a>>,
    /// `\T`.
    pub(crate) time: Option<Replacement<'a>>,
    /// `\Z`.
    pub(crate) zone: Option<Replacement<'a>>,
}

impl<'a> Overrides<'a> {
    /// The place of an option's value.
    fn place(&mut self, name: &str) -> Option<&mut Option<Replacement<'a>>> {
        let places = [("V", &mut self.velocity), ("T", &mut self.time), ("Z", &mut self.zone)];
        let mut places = places.into_iter();
        places.find(|(own, _)| own.eq_ignore_ascii_case(name)).map(|(_, place)| place)
    }
}

/// Read the arguments of a move up to its semicolon; the instruction's name at byte `start` is
/// already read. `None` for an unfinished one.
pub(crate) fn read_move<'a>(
    tokens: &mut Tokens<'a>,
    instruction: &'static MoveInstruction,
    start: usize,
) -> Result<Option<WrittenMove<'a>>, RapidFault> {
    let (line, column) = tokens.line_and_column(start);
    let (mut required, mut options, mut wobj): (Vec<Expression<'a>>, Vec<MoveOption>, _) =
        (Vec::with_capacity(USUAL_ARGUMENTS), Vec::new(), None);
    let mut overrides = Overrides::default();
    loop {
        // A comma may precede an optional argument too.
        let is_first = required.is_empty() && options.is_empty() && wobj.is_none();
        let after_comma = !is_first && tokens.take_if(b',')?;
        if tokens.take_if(b'\\')? {
            let (name, value) = ExpressionReader::new(tokens).optional()?;
            match value {
                Some(value) if wobj.is_none() && name.eq_ignore_ascii_case("WObj") => {
                    wobj = Some(value);
                }
                value => {
                    let text = value.as_ref().map(|it| tokens.text[it.start..it.end].to_string());
                    options.push(MoveOption {
                        after: required.len(),
                        name: name.to_string(),
                        text,
                    });
                    if let Some(place) = overrides.place(name) {
                        place.get_or_insert(value.map_or(Replacement::Nothing, Replacement::Value));
                    }
                }
            }
        } else if !after_comma && tokens.peek().is(b';') {
            break;
        } else if !after_comma && !required.is_empty() {
            return Err(tokens.unexpected("a comma or a semicolon"));
        } else {
            required.push(ExpressionReader::new(tokens).argument()?);
        }
    }
    tokens.take()?;
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
    Ok(Some(WrittenMove {
        instruction,
        start,
        end: tokens.last_end,
        at: At::default(),
        line,
        column,
        displaced: None,
        required,
        wobj,
        options,
        overrides,
        settings: MotionSettings::default(),
    }))
}
