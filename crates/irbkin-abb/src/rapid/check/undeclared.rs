//! Calls of what nothing declares, and calls with other arguments than the routine has.

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::findings::listed;
use crate::rapid::data::finding::{Code, Finding};
use crate::rapid::data::fit::misfit;
use crate::rapid::data::instructions::Effect;
use crate::rapid::data::module::{Module, Routine};
use crate::rapid::data::statement::{Statement, StatementKind};
use crate::rapid::data::table::Entry;
use crate::rapid::expression::names::predefined_names;
use crate::rapid::text::fault::RapidFaultKind;
use crate::rapid::text::tokens::Tokens;
use irbkin::{Interrupt, Interrupted};

/// Longest parameters of a routine that calls are compared with [bytes]: each call reads them.
const LONGEST_PARAMETERS: usize = 1000;

/// Most unknown names that are compared with the known ones.
const MOST_COMPARED: usize = 100;

/// The names that could be meant by the unknown name of a finding: of data of the modules, and
/// RAPID's own.
#[must_use]
pub fn candidates(finding: &Finding, modules: &[&Module]) -> Vec<String> {
    if finding.code == Code::UnknownRoutine {
        let routines = modules.iter().flat_map(|module| module.routines());
        let own = Entry::all().map(|it| String::from(it.0));
        return routines.map(|routine| routine.name.clone()).chain(own).collect();
    }
    let data_type = finding.code.data_type();
    let data = modules.iter().flat_map(|module| module.data());
    let fitting = data.filter(|datum| data_type.is_none_or(|wanted| datum.data_type == wanted));
    let mut names: Vec<String> = fitting.map(|datum| datum.name.clone()).collect();
    names.extend(data_type.map(predefined_names).unwrap_or_default());
    names
}

/// Whether an unknown routine is an error, or may be in a module that is missing: without
/// `is_whole`, in one that a calculated name leads to.
fn may_be_elsewhere(modules: &[&Module], is_whole: Option<bool>) -> bool {
    let is_one = |name: &str, of: &[&str]| of.iter().any(|it| it.eq_ignore_ascii_case(name));
    let is_open = |module: &&Module| {
        let is_encoded = module.faults.iter().any(|it| it.kind == RapidFaultKind::Encoded);
        is_encoded
            || module.statements.iter().any(|it| match &it.kind {
                StatementKind::Instruction(it) if it.name.is_none() => is_whole.is_none(),
                StatementKind::Instruction(it) => {
                    is_one(&it.word, &["Load", "StartLoad"])
                        || is_whole.is_none() && is_one(&it.word, &["CallByVar"])
                }
                _ => false,
            })
    };
    is_whole == Some(false) || modules.iter().any(is_open)
}

/// The findings on the calls of a program; `of_system` are modules that do not say that they are.
pub(super) fn undeclared(
    modules: &[&Module],
    sources: &[&str],
    is_whole: Option<bool>,
    of_system: &[usize],
    interrupt: Interrupt<'_>,
) -> Result<Vec<Finding>, Interrupted> {
    let mut routines: BTreeMap<String, Vec<(usize, &Routine)>> = BTreeMap::new();
    for (index, module) in modules.iter().enumerate() {
        for routine in &module.routines {
            routines.entry(routine.name.to_lowercase()).or_default().push((index, routine));
        }
    }
    let mut found = Vec::new();
    // The first finding on each name, and how often it is called.
    let mut unknown: BTreeMap<(String, Option<&str>), (usize, usize)> = BTreeMap::new();
    for (index, (module, source)) in modules.iter().zip(sources).enumerate() {
        let (tokens, unread) = (Tokens::of(source), unread_names(module));
        let of_system = of_system.contains(&index) || is_of_system(module);
        for (at, call) in module.calls.iter().enumerate() {
            interrupt.check(at)?;
            let written = source.get(call.name.clone()).unwrap_or_default();
            // A call by name may name the module, too.
            let name = written.rsplit(':').next().unwrap_or(written);
            let place = call.start;
            let lower = name.to_lowercase();
            let all = routines.get(&lower).map_or(&[][..], Vec::as_slice);
            let own = all.iter().find(|(home, _)| *home == index);
            let other = || all.iter().find(|(_, routine)| !routine.is_local());
            let known = own.or_else(other).map(|(_, routine)| {
                let header = &routine.header;
                let inside = header.find('(').zip(header.rfind(')'));
                let inside = inside.and_then(|(a, b)| header.get(a + 1..b));
                // A comment may have commas.
                let is_read =
                    |it: &&str| it.len() <= LONGEST_PARAMETERS && !it.contains(['!', '<']);
                (&*routine.name, inside.filter(is_read).unwrap_or("..."))
            });
            let bare = || Entry::grouped(name, call.is_function).map(|it| (name, it));
            let finding = match (known, &call.wrong) {
                (None, Some(wrong)) => Some(Finding::new(Code::WrongArguments, wrong.as_str())),
                (known, _) => match known.or_else(bare) {
                    Some(of) => {
                        let given = call.optional.iter().map(|(name, it)| (name.as_str(), *it));
                        let wrong = misfit(of, call.required, given);
                        wrong.map(|wrong| Finding::new(Code::WrongArguments, wrong))
                    }
                    None if unread.contains(&lower) || is_of_add_in(name) => None,
                    None => {
                        // A controller loads the module all the same.
                        let elsewhere = if place < call.name.start {
                            Some("it is looked for when the call is made")
                        } else {
                            of_system.then_some("the system may have it")
                        };
                        let first = unknown.entry((lower, elsewhere)).or_insert((found.len(), 0));
                        first.1 += 1;
                        (first.1 == 1).then(|| unknown_routine(name, elsewhere))
                    }
                },
            };
            let (line, column) = tokens.line_and_column(place);
            // An argument that lacks is a fault of the move already.
            let is_told = || module.faults.iter().any(|it| it.line == line);
            let is_new = |it: &Finding| it.code != Code::WrongArguments || !is_told();
            let Some(finding) = finding.filter(is_new) else {
                continue;
            };
            let what = if call.is_function { name } else { statement(source, place) };
            let behind = module.routines.partition_point(|it| it.line <= line);
            let routine = behind.checked_sub(1).map(|at| module.routines[at].name.clone());
            found.push(finding.placed((line, column), routine, 0, what).in_module(index));
        }
    }
    for (at, count) in unknown.values().filter(|(_, count)| *count > 1) {
        found[*at].message = format!("{} ({count} calls)", found[*at].message);
    }
    if !unknown.is_empty() && may_be_elsewhere(modules, is_whole) {
        let sure = known_slips(&found, modules);
        let (missing, mut others): (Vec<Finding>, _) = found
            .into_iter()
            .partition(|it| it.unknown.as_ref().is_some_and(|it| !sure.contains(it)));
        let names: Vec<String> = missing.iter().filter_map(|it| it.unknown.clone()).collect();
        others.extend(missing.into_iter().next().map(|first| {
            let message =
                format!("no module that is here declares {}: modules are missing", listed(&names));
            Finding { code: Code::MissingRoutines, unknown: None, message, ..first }
        }));
        return Ok(others);
    }
    Ok(found)
}

/// Whether a module is one of the system, by its attributes.
fn is_of_system(module: &Module) -> bool {
    let is_one = |it: &String| {
        ["SYSMODULE", "NOVIEW", "VIEWONLY"].iter().any(|of| of.eq_ignore_ascii_case(it))
    };
    module.attributes.iter().any(is_one)
}

/// The finding on a call of a routine that nothing declares: a note if it may be elsewhere.
fn unknown_routine(name: &str, elsewhere: Option<&str>) -> Finding {
    match elsewhere {
        Some(words) => {
            let words = format!("no module that is here declares it: {words}");
            Finding::new(Code::MissingRoutines, words)
        }
        None => Finding {
            unknown: Some(name.to_string()),
            ..Finding::new(Code::UnknownRoutine, "nothing declares it")
        },
    }
}

/// The statement that begins at a byte, without its semicolon.
fn statement(text: &str, start: usize) -> &str {
    let (mut is_string, rest) = (false, &text[start..]);
    let end = rest.find(|it: char| {
        is_string ^= it == '"';
        matches!(it, '\n' | '\r') || !is_string && matches!(it, ';' | '!')
    });
    rest[..end.unwrap_or(rest.len())].trim_end()
}

/// The unknown names that are known ones with a slip: errors even if modules are missing. Of many
/// names the first are compared.
fn known_slips(found: &[Finding], modules: &[&Module]) -> Vec<String> {
    let unknown = found.iter().filter_map(|it| it.unknown.as_deref()).take(MOST_COMPARED);
    let routines = modules.iter().flat_map(|it| &it.routines).map(|it| it.name.as_str());
    let known: Vec<&str> = routines.chain(Entry::all().map(|it| it.0)).collect();
    let slips = unknown.filter(|name| known.iter().any(|it| is_slip(it, name)));
    slips.map(ToString::to_string).collect()
}

/// The names in lower case behind the first words of what is not read: a routine may be declared
/// there.
fn unread_names(module: &Module) -> BTreeSet<String> {
    let is_invalid = |it: &&Statement| matches!(it.kind, StatementKind::Invalid { .. });
    let invalid = module.statements.iter().filter(is_invalid);
    let second = invalid.filter_map(|it| {
        it.text.split(|c: char| !(c.is_alphanumeric() || c == '_')).nth(1).map(str::to_lowercase)
    });
    second.collect()
}

/// Whether an add-in may have the instruction: its name continues one that moves.
fn is_of_add_in(name: &str) -> bool {
    Effect::of(name) == Effect::Moves && !Entry::all().any(|it| is_slip(it.0, name))
}

/// Whether one letter makes a name another one. Digits and the last letter of a word tell names
/// apart.
fn is_slip(a: &str, b: &str) -> bool {
    let (a, b) = (a.as_bytes(), b.as_bytes());
    let same = |(a, b): &(&u8, &u8)| a.eq_ignore_ascii_case(b);
    let begin = a.iter().zip(b).take_while(same).count();
    let end = a[begin..].iter().rev().zip(b[begin..].iter().rev()).take_while(same).count();
    let is_letter = |name: &[u8], at: usize| name.get(at).is_some_and(u8::is_ascii_alphabetic);
    let (a_rest, b_rest) = (a.len() - begin - end, b.len() - begin - end);
    match (a_rest, b_rest) {
        (1, 1) => is_letter(a, begin) && is_letter(b, begin) && is_letter(a, begin + 1),
        (1, 0) => is_letter(a, begin),
        (0, 1) => is_letter(b, begin),
        _ => false,
    }
}
