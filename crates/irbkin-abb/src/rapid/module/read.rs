//! Whole modules and single records read from text, and modules made of data and moves.

use alloc::borrow::Cow;
use alloc::collections::BTreeSet;
use alloc::sync::Arc;

use crate::Error;
use crate::prelude::*;
use crate::rapid::data::module::{Content, Datum, Module, Routine, RoutineKind};
use crate::rapid::data::moves::Move;
use crate::rapid::data::statement::{Statement, StatementKind};
use crate::rapid::data::types::are_finite;
use crate::rapid::data::value::{DataType, Value};
use crate::rapid::resolve::resolved;
use crate::rapid::statements::faults::Faults;
use crate::rapid::statements::reader::StatementReader;
use crate::rapid::text::fault::{Missing, RapidFault, RapidFaultKind};
use crate::rapid::text::place::excerpt;
use crate::rapid::text::words::is_name;
use irbkin::Interrupt;

/// Read the text of a module, or of declarations and moves without one.
///
/// Names that it does not declare are looked up in `context`: the data of these modules that are
/// not `LOCAL`, the first module first. Names that none declares are RAPID's own: `tool0`,
/// `wobj0`, `load0`, the speeds `v5` to `v7000` and `vmax`, the zones `fine` and `z0` to `z200`. A
/// controller has its robot's `vmax`; here it is 10 m/s.
///
/// A datum that a statement of the module assigns, wherever the statement is, has no known value in
/// moves, nor has a datum that refers to it; all others have their declared values there. `name:=`
/// is recognized, and instructions such as `Incr` and `SearchL` that write to an argument. Data
/// passed to another routine as `INOUT` are not, nor are assignments in modules that are not in
/// `context`.
///
/// The time is linear in the size of the text, except for the lookup of names, which is
/// logarithmic.
///
/// # Errors
///
/// [`Error::Rapid`] when the text is invalid.
pub fn parse(text: &str, context: &[&Module]) -> Result<Module, Error> {
    Ok(read_with(text, context, Faults::new(false, Interrupt::none()))?)
}

/// [`parse`], or with tolerance [`read`], which then has no fault but an interrupt.
#[doc(hidden)]
pub fn read_with(
    text: &str,
    context: &[&Module],
    faults: Faults<'_>,
) -> Result<Module, RapidFault> {
    resolved(StatementReader::read(text, context, faults)?, context)
}

/// Read the text of a module in spite of its faults, which are [`Module::faults`]. A text without
/// faults is read as by [`parse`].
///
/// A semicolon that lacks at the end of a line is taken to be there. An invalid statement is
/// skipped, to its semicolon or to the next line that begins as a statement does. A datum or a move with an invalid value is skipped. An end that is missing is taken to be
/// before the next routine or the end of a block around it. The lines that git leaves in a conflict
/// are skipped, and both sides are read: of a name that is declared twice the first declaration
/// counts. An encoded module, which is not text, has a single fault and is empty.
#[must_use]
pub fn read(text: &str, context: &[&Module]) -> Module {
    // With tolerance no fault gets here.
    read_with(text, context, Faults::new(true, Interrupt::none())).unwrap_or_else(|fault| Module {
        faults: Vec::from([fault]),
        text_length: text.len(),
        ..Module::default()
    })
}

/// Decode the text of a file: UTF-16 with a byte order mark, UTF-8, otherwise Latin-1. The byte
/// order mark is removed.
#[must_use]
pub fn decode(bytes: &[u8]) -> Cow<'_, str> {
    match bytes {
        [0xff, 0xfe, units @ ..] => return Cow::Owned(decode_units(units, u16::from_le_bytes)),
        [0xfe, 0xff, units @ ..] => return Cow::Owned(decode_units(units, u16::from_be_bytes)),
        _ => {}
    }
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    match core::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => Cow::Owned(bytes.iter().map(|byte| char::from(*byte)).collect::<String>()),
    }
}

/// Decode UTF-16; invalid units become replacement characters, as does a trailing byte.
fn decode_units(bytes: &[u8], unit: fn([u8; 2]) -> u16) -> String {
    let (pairs, rest) = bytes.as_chunks::<2>();
    let characters = char::decode_utf16(pairs.iter().map(|pair| unit(*pair)))
        .map(|it| it.unwrap_or(char::REPLACEMENT_CHARACTER));
    characters.chain(rest.iter().map(|_| char::REPLACEMENT_CHARACTER)).collect()
}

const BY_SHAPE: [DataType; 6] = [
    DataType::RobTarget,
    DataType::JointTarget,
    DataType::ToolData,
    DataType::WobjData,
    DataType::Pose,
    DataType::LoadData,
];

/// Read a text that is one robtarget, jointtarget, tooldata, wobjdata, pose or loaddata; its shape
/// determines the type.
///
/// # Errors
///
/// [`Error::Rapid`] when the text is invalid, of another kind, or is followed by more text.
pub fn parse_record(text: &str) -> Result<Value, Error> {
    use RapidFaultKind::{ComponentCount, ComponentType, NotWhole};
    let mut broken = None;
    for data_type in BY_SHAPE {
        // The text keeps its own lines, after one that is not reported.
        match parse(&format!("VAR {} value:=\n{text}\n;", data_type.name()), &[]) {
            Ok(module) => {
                let alone = module.moves().is_empty() && module.skipped().is_empty();
                if let ([datum], true) = (module.data(), alone)
                    && let Content::Single(value) = &datum.content
                {
                    return Ok(value.clone());
                }
            }
            Err(Error::Rapid(fault)) => match fault.kind {
                // The text may be a value of another type.
                ComponentCount { .. } | ComponentType { .. } | NotWhole { .. } => {}
                _ => broken = Some(RapidFault { line: fault.line.saturating_sub(1), ..fault }),
            },
            Err(error) => return Err(error),
        }
    }
    let none = || RapidFault::nowhere(RapidFaultKind::NoRecord { text: excerpt(text) });
    Err(broken.unwrap_or_else(none).into())
}

impl Module {
    /// Build a module from data and moves, with a procedure without parameters for each routine
    /// that they name.
    ///
    /// The module is read from its text: the values of moves are looked up by their texts, in the
    /// module and in `context`; values in `moves` are not used.
    ///
    /// # Errors
    ///
    /// [`Error::Rapid`] when a name is not a valid name, a name appears twice, a number is not
    /// finite or the text of an argument is not an expression.
    pub fn new(
        name: Option<String>,
        data: Vec<Datum>,
        moves: Vec<Move>,
        context: &[&Module],
    ) -> Result<Self, Error> {
        check_names(name.as_deref(), &data, &moves)?;
        data.iter().try_for_each(check_numbers)?;
        let routines = routines(&data, &moves);
        let statements = moves.iter().enumerate().map(of_move).collect();
        let module = Self { name, routines, data, moves, statements, ..Self::default() };
        let module = module.without_positions();
        let read = parse(&module.to_string(), context)?;
        let texts =
            |module: &Module| module.moves.iter().map(ToString::to_string).collect::<Vec<_>>();
        let says_the_same = read.clone().without_positions().data.len() == module.data.len()
            && texts(&read) == texts(&module);
        if says_the_same && read.skipped().is_empty() {
            return Ok(read);
        }
        let what = read
            .skipped()
            .first()
            .map_or_else(|| "datum or move for each that was given".to_string(), |it| it.what());
        Err(nowhere(RapidFaultKind::NoSuchValue { missing: Missing::Module { what } }))
    }
}

fn of_move((index, step): (usize, &Move)) -> Statement {
    let routine = step.routine.as_deref().map(Arc::from);
    let (kind, text) = (StatementKind::Move(index), String::new());
    Statement { line: 0, column: 0, routine, kind, text, start: 0 }
}

/// An error of data that are not in a text.
pub(super) fn nowhere(kind: RapidFaultKind) -> Error {
    RapidFault::nowhere(kind).into()
}

fn check_names(module: Option<&str>, data: &[Datum], moves: &[Move]) -> Result<(), Error> {
    let of_data =
        data.iter().flat_map(|datum| [Some(datum.name.as_str()), datum.routine.as_deref()]);
    let of_moves = moves.iter().map(|step| step.routine.as_deref());
    match of_data.chain(of_moves).chain([module]).flatten().find(|name| !is_name(name)) {
        Some(name) => Err(nowhere(RapidFaultKind::NotAName { name: name.to_string() })),
        None => Ok(()),
    }
}

/// Check that every number of a datum is finite, and that an array has as many values as its sizes
/// require.
fn check_numbers(datum: &Datum) -> Result<(), Error> {
    let thing = || format!("{} {}", datum.data_type.name(), datum.name);
    let values = match &datum.content {
        Content::Uninitialized { .. } => &[],
        Content::Single(value) => core::slice::from_ref(value),
        Content::Array { sizes, values } => {
            let wanted = sizes
                .iter()
                .try_fold(1_usize, |product, size| product.checked_mul(*size))
                .unwrap_or(usize::MAX);
            if sizes.is_empty() || wanted != values.len() {
                return Err(nowhere(RapidFaultKind::ArraySize {
                    thing: thing(),
                    dimension: 1,
                    found: values.len(),
                    wanted,
                }));
            }
            values.as_slice()
        }
    };
    for value in values {
        if value.data_type() != datum.data_type {
            let (found, wanted) = (value.type_name().to_string(), datum.data_type.name());
            return Err(nowhere(RapidFaultKind::ComponentType {
                thing: thing(),
                part: String::new(),
                found,
                wanted,
            }));
        }
        if !are_finite(&value.atoms()) {
            return Err(nowhere(RapidFaultKind::NotFinite {
                text: format!("{} {value}", thing()),
            }));
        }
    }
    Ok(())
}

/// A procedure for each name of a routine, in order of appearance.
fn routines(data: &[Datum], moves: &[Move]) -> Vec<Routine> {
    let mut known = BTreeSet::new();
    let of_moves = moves.iter().filter_map(|step| step.routine.as_deref());
    let of_data = data.iter().filter_map(|datum| datum.routine.as_deref());
    let names = of_moves.chain(of_data).filter(|name| known.insert(name.to_lowercase()));
    let procedure = |name: &str| Routine {
        kind: RoutineKind::Proc,
        name: name.to_string(),
        header: format!("PROC {name}()"),
        line: 0,
        column: 0,
        parameters: Vec::new(),
        data_type: None,
    };
    names.map(procedure).collect()
}
