//! A module from data and moves that were not read from a text.

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::parse::parse;
use crate::error::{Error, Missing, RapidFault, RapidFaultKind};
use crate::rapid::data::module::{Content, Datum, Module, Routine, RoutineKind};
use crate::rapid::data::moves::Move;
use crate::rapid::text::words::is_name;

impl Module {
    /// Build a module from data and moves, with a procedure without parameters for each routine
    /// that they name.
    ///
    /// The module is that of its text: the values of moves are looked up by their texts, in the
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
        let (attributes, skipped, settings) = (Vec::new(), Vec::new(), Vec::new());
        let index = BTreeMap::new();
        let (assigned, expressions) = (BTreeSet::new(), BTreeMap::new());
        let module = Self {
            name,
            attributes,
            routines,
            data,
            moves,
            skipped,
            settings,
            index,
            assigned,
            expressions,
            text_length: 0,
        }
        .without_positions();
        let read = parse(&module.to_string(), context)?;
        let texts =
            |module: &Module| module.moves.iter().map(ToString::to_string).collect::<Vec<_>>();
        let says_the_same = read.clone().without_positions().data.len() == module.data.len()
            && texts(&read) == texts(&module);
        if says_the_same && read.skipped.is_empty() {
            return Ok(read);
        }
        let what = read.skipped.first().map_or_else(
            || "datum or move for each that was given".to_string(),
            |it| it.what.to_string(),
        );
        Err(fault(RapidFaultKind::NoSuchValue { missing: Missing::Module { what } }))
    }
}

fn fault(kind: RapidFaultKind) -> Error {
    RapidFault::nowhere(kind).into()
}

fn check_names(module: Option<&str>, data: &[Datum], moves: &[Move]) -> Result<(), Error> {
    let of_data =
        data.iter().flat_map(|datum| [Some(datum.name.as_str()), datum.routine.as_deref()]);
    let of_moves = moves.iter().map(|step| step.routine.as_deref());
    match of_data.chain(of_moves).chain([module]).flatten().find(|name| !is_name(name)) {
        Some(name) => Err(fault(RapidFaultKind::NotAName { name: name.to_string() })),
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
                return Err(fault(RapidFaultKind::ArraySize {
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
            return Err(fault(RapidFaultKind::ComponentType {
                thing: thing(),
                part: String::new(),
                found,
                wanted,
            }));
        }
        if !value.part().is_finite() {
            return Err(fault(RapidFaultKind::NotFinite { text: format!("{} {value}", thing()) }));
        }
    }
    Ok(())
}

/// A procedure for each name of a routine, in order of appearance.
fn routines(data: &[Datum], moves: &[Move]) -> Vec<Routine> {
    let mut known = BTreeSet::new();
    let of_moves = moves.iter().filter_map(|step| step.routine.as_ref());
    let of_data = data.iter().filter_map(|datum| datum.routine.as_ref());
    let names = of_moves.chain(of_data).filter(|name| known.insert(name.to_lowercase()));
    let procedure = |name: &String| Routine {
        kind: RoutineKind::Proc,
        name: name.clone(),
        header: format!("PROC {name}()"),
        line: 0,
        column: 0,
    };
    names.map(procedure).collect()
}
