//! Calls of what nothing declares, and calls with other arguments than the routine has.

use alloc::collections::{BTreeMap, BTreeSet};

use super::findings::listed;
use crate::prelude::*;
use crate::rapid::data::finding::{Code, Finding};
use crate::rapid::data::fit::misfit;
use crate::rapid::data::instructions::Effect;
use crate::rapid::data::module::{Module, Routine};
use crate::rapid::data::statement::{Statement, StatementKind};
use crate::rapid::data::table::Entry;
use crate::rapid::data::value::DataType;
use crate::rapid::expression::names::predefined_names;
use crate::rapid::program::whole::Program;
use crate::rapid::text::fault::RapidFaultKind;
use crate::rapid::text::tokens::Tokens;
use crate::rapid::text::words::words_of;
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
pub(super) fn may_be_elsewhere(modules: &[&Module], is_whole: Option<bool>) -> bool {
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

/// The routine that a name in lower case refers to in a module: its name, and its parameters as its
/// header has them; `...` if they are too long, have comments, which may have commas, or if several
/// modules declare it.
pub(super) fn signature<'m>(
    program: &Program<'m>,
    module: usize,
    lower: &str,
) -> Option<(&'m str, &'m str)> {
    let (_, Routine { name, header, .. }) = program.callee(module, lower)?;
    let inside = header.find('(').zip(header.rfind(')')).and_then(|(a, b)| header.get(a + 1..b));
    let is_read = |it: &&str| it.len() <= LONGEST_PARAMETERS && !it.contains(['!', '<']);
    let inside = inside.filter(is_read).filter(|_| !program.is_ambiguous(module, lower));
    Some((name, inside.unwrap_or("...")))
}

/// The findings on the calls of a program, and on its `names` of data that nothing declares;
/// `of_system` are modules that do not say that they are.
pub(super) fn undeclared(
    program: &Program<'_>,
    sources: &[&str],
    names: Vec<Finding>,
    is_whole: Option<bool>,
    of_system: &[usize],
    interrupt: Interrupt<'_>,
) -> Result<Vec<Finding>, Interrupted> {
    let modules = program.modules.as_slice();
    let marks = ["SYSMODULE", "NOVIEW", "VIEWONLY"];
    let is_mark = |it: &String| marks.iter().any(|of| of.eq_ignore_ascii_case(it));
    let is_of_system =
        |index| of_system.contains(&index) || modules[index].attributes.iter().any(is_mark);
    let mut found = Vec::new();
    // The first finding on each name, and how often it is called.
    let mut unknown: BTreeMap<(String, Option<&str>), (usize, usize)> = BTreeMap::new();
    for (index, (module, source)) in modules.iter().zip(sources).enumerate() {
        let (tokens, unread) = (Tokens::of(source), unread_names(module));
        for (at, call) in module.calls.iter().enumerate() {
            interrupt.check(at)?;
            let written = source.get(call.name.clone()).unwrap_or_default();
            // A call by name may name the module, too.
            let name = written.rsplit(':').next().unwrap_or(written);
            let place = call.start;
            let lower = name.to_lowercase();
            let known = signature(program, index, &lower);
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
                            is_of_system(index).then_some("the system may have it")
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
    let is_own = |it: &Finding| !is_of_system(it.module);
    found.extend(names.into_iter().filter(is_own));
    let are_routines_elsewhere = may_be_elsewhere(modules, is_whole);
    // Without main it is a part of a program, and the data may be in another.
    let mut all = modules.iter().flat_map(|it| &it.routines);
    let has_main = all.any(|it| it.name.eq_ignore_ascii_case("main"));
    let are_data_elsewhere = are_routines_elsewhere || is_whole.is_none() && !has_main;
    let sure = if are_data_elsewhere { known_slips(&found, modules) } else { Vec::new() };
    let (missing, mut others): (Vec<Finding>, _) = found.into_iter().partition(|it| {
        let is_elsewhere = match it.code {
            Code::UnknownName => are_data_elsewhere,
            _ => are_routines_elsewhere,
        };
        is_elsewhere && it.unknown.as_ref().is_some_and(|it| !sure.contains(it))
    });
    let names: Vec<String> = missing.iter().filter_map(|it| it.unknown.clone()).collect();
    others.extend(missing.into_iter().next().map(|first| {
        let message =
            format!("no module that is here declares {}: modules are missing", listed(&names));
        Finding { code: Code::MissingRoutines, unknown: None, message, ..first }
    }));
    Ok(others)
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
    let data = modules.iter().flat_map(|it| &it.data).map(|it| it.name.as_str());
    let known: Vec<&str> = routines.chain(data).chain(Entry::all().map(|it| it.0)).collect();
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

const TYPES: [DataType; 4] =
    [DataType::RobTarget, DataType::JointTarget, DataType::ToolData, DataType::WobjData];

/// The targets, tools, work objects and routines of a program that nothing in its texts names but
/// their declaration. A name in a string counts: `%"rPart"+num%` calls a routine.
pub(super) fn unused(modules: &[&Module], sources: &[&str]) -> Vec<Finding> {
    // How often each name is declared, less how often it is written.
    let mut left: BTreeMap<String, isize> = BTreeMap::new();
    for module in modules {
        let data = module.data().iter().map(|datum| &datum.name);
        for name in data.chain(module.routines().iter().map(|routine| &routine.name)) {
            *left.entry(name.to_lowercase()).or_default() += 1;
        }
    }
    let mut word = String::new();
    for text in sources {
        for line in text.lines() {
            for part in words(line) {
                word.clear();
                word.extend(part.chars().flat_map(char::to_lowercase));
                if let Some(count) = left.get_mut(&word) {
                    *count -= 1;
                }
            }
        }
    }
    let is_unused = |name: &str| left.get(&name.to_lowercase()).is_some_and(|count| *count >= 0);
    let mut found = Vec::new();
    for (index, module) in modules.iter().enumerate() {
        let mut add = |place: (usize, usize), routine: Option<String>, what: String| {
            let finding = Finding::new(Code::Unused, "nothing in the program names it");
            found.push(finding.placed(place, routine, 0, &what).in_module(index));
        };
        for datum in module.data() {
            let own = datum.data_type;
            let is_own = predefined_names(own).contains(&datum.name.to_lowercase());
            if TYPES.contains(&own) && !is_own && is_unused(&datum.name) {
                let what = format!("{} {}", own.name(), datum.name);
                add((datum.line, datum.column), datum.routine.clone(), what);
            }
        }
        for routine in module.routines() {
            if !routine.name.eq_ignore_ascii_case("main") && is_unused(&routine.name) {
                let what = format!("{} {}", routine.kind.name(), routine.name);
                add((routine.line, routine.column), None, what);
            }
        }
    }
    found
}

/// The names in a line, in its strings too; not in its comment.
fn words(line: &str) -> impl Iterator<Item = &str> {
    let mut is_string = false;
    let comment = line.find(|character| {
        is_string ^= character == '"';
        character == '!' && !is_string
    });
    words_of(&line[..comment.unwrap_or(line.len())])
}
