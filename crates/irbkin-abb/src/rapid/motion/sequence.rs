//! The moves of a routine in the order in which they are made.

use alloc::collections::BTreeSet;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use crate::Error;
use crate::rapid::data::module::Module;
use crate::rapid::program::walk::steps;
use crate::rapid::program::walker::Step;
use crate::rapid::program::whole::Program;
use crate::rapid::text::fault::{RapidFault, RapidFaultKind, RoutineFault};

/// The steps of a routine of the first module of a program, and its name; `None` for moves outside
/// routines.
pub(super) fn sequence<'m>(
    program: &Program<'m>,
    routine: Option<&str>,
) -> Result<(Option<String>, Vec<Step<'m>>), Error> {
    let Some(module) = program.modules.first() else {
        return Err(fault(0, RoutineFault::NoMoves { routine: "the program".into() }));
    };
    let name = chosen(module, routine)?;
    let (steps, uncertain) = steps(program, name.as_deref().unwrap_or_default());
    if let Some((line, word)) = uncertain {
        return Err(fault(line, RoutineFault::Branch { word }));
    }
    if steps.iter().any(|step| matches!(step, Step::Move(_))) {
        return Ok((name, steps));
    }
    let routine = name.unwrap_or_else(|| "the text".to_string());
    Err(fault(0, RoutineFault::NoMoves { routine }))
}

fn fault(line: usize, fault: RoutineFault) -> Error {
    let kind = RapidFaultKind::Routine(fault);
    RapidFault { line, column: usize::from(line > 0), kind }.into()
}

/// The routine of a name; without one main, or the only one that moves.
fn chosen(module: &Module, wanted: Option<&str>) -> Result<Option<String>, Error> {
    let names = || module.routines().iter().map(|routine| routine.name.as_str());
    if let Some(wanted) = wanted {
        let found = names().find(|name| name.eq_ignore_ascii_case(wanted));
        let kind = || RoutineFault::Unknown { name: wanted.into(), known: names().collect() };
        return found.map(|name| Some(name.into())).ok_or_else(|| fault(0, kind()));
    }
    if let Some(main) = names().find(|name| name.eq_ignore_ascii_case("main")) {
        return Ok(Some(main.into()));
    }
    let moving: BTreeSet<Option<&str>> =
        module.moves().iter().map(|step| step.routine.as_deref()).collect();
    if moving.is_empty() {
        return Err(fault(0, RoutineFault::NoMoves { routine: "the module".into() }));
    }
    if let (Some(only), 1) = (moving.first(), moving.len()) {
        return Ok(only.map(String::from));
    }
    Err(fault(0, RoutineFault::Which { moving: moving.into_iter().flatten().collect() }))
}
