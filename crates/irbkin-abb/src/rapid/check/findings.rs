//! Findings in the order of the text, each once and in one for each cause.

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use crate::rapid::data::finding::{Code, Finding, Place};
use crate::rapid::data::module::Module;

/// A case of a move: its place, the module and the index of its instruction, the first call that
/// leads to it with arguments, and what is particular in words.
pub(super) type Case = (Place, (usize, usize), Option<Place>, String);

/// Findings in the order of the text, each once.
pub(super) fn sorted(
    mut found: Vec<Finding>,
    cases: &BTreeSet<Case>,
    modules: &[&Module],
) -> Vec<Finding> {
    // Of those that say the same, one that rests on nothing stays.
    found.sort_by_key(|it| (identity(it), it.assumed.is_some()));
    let mut found = of_all_cases(&found, cases);
    // Nothing is said of the way to a target that cannot be met.
    let (mut unmet, mut without_path) = (None, None);
    found.retain(|it| {
        let place = (it.place(), it.assumed.is_some());
        match it.code {
            Code::OutOfReach | Code::OutsideLimits => unmet = Some(place),
            Code::NoPath => without_path = Some(place),
            Code::UncertainCircle => return without_path != Some(place),
            Code::PathBlocked | Code::Flip => return unmet != Some(place),
            _ => {}
        }
        true
    });
    of_one_cause(found, modules)
}

/// What is the same of findings in several cases.
fn identity(it: &Finding) -> (Place, Code, Option<usize>, (usize, usize)) {
    (it.place(), it.code, it.joint, it.instruction)
}

/// Findings of the cases of a move as the first of them, with the number of the others.
fn of_all_cases(found: &[Finding], cases: &BTreeSet<Case>) -> Vec<Finding> {
    let mut kept: Vec<Finding> = Vec::new();
    for all in found.chunk_by(|a, b| identity(a) == identity(b)) {
        let mut own = all[0].clone();
        let place = (own.place(), own.instruction);
        let from = cases.range((place.0, place.1, None, String::new())..);
        let total = from.take_while(|it| (it.0, it.1) == place).count();
        let case = &own.case;
        if case.is_empty() && (total <= 1 || own.calls.is_empty()) {
            let mut messages = BTreeSet::new();
            kept.extend(all.iter().filter(|it| messages.insert(&it.message)).cloned());
            continue;
        }
        let of: BTreeSet<_> = all.iter().map(|it| (it.calls.first(), &it.case)).collect();
        let count = of.len();
        let calls: BTreeSet<Place> = all.iter().flat_map(|it| &it.calls).copied().collect();
        let is_same = total <= 1 || all.iter().all(|it| it.message == own.message);
        if count < total || !is_same {
            let which = if count > 1 { "first " } else { "" };
            let words = match (case.starts_with("at "), calls.len() > 1) {
                _ if case.is_empty() => format!("{count} of {total} calls"),
                (true, false) => format!("{which}{case}; {count} of {total} passes"),
                _ => format!("{which}{case}; {count} of {total} cases"),
            };
            own.message = format!("{} ({words})", own.message);
        }
        own.calls = calls.into_iter().collect();
        kept.push(own);
    }
    kept
}

/// Findings of one cause as the first of them, with the places and the corrections of the others.
fn of_one_cause(found: Vec<Finding>, modules: &[&Module]) -> Vec<Finding> {
    let mut firsts: BTreeMap<_, (usize, BTreeSet<Place>)> = BTreeMap::new();
    let mut kept: Vec<Finding> = Vec::new();
    for mut finding in found {
        let cause = core::mem::take(&mut finding.cause);
        if !cause.is_empty() {
            let of = (finding.code, cause, finding.assumed.is_some());
            let (first, others) = firsts.entry(of).or_insert((kept.len(), BTreeSet::new()));
            if let Some(first) = kept.get_mut(*first) {
                others.insert(finding.place());
                first.edits.append(&mut finding.edits);
                continue;
            }
        }
        kept.push(finding);
    }
    for finding in &mut kept {
        finding.edits.sort_by_key(|edit| (edit.module, edit.span.start));
        finding.edits.dedup();
        let place = finding.place();
        finding.related.extend(finding.calls.iter().filter(|call| **call != place));
        if !finding.related.is_empty() {
            let from = places(&finding.related, finding.module, modules);
            finding.message = format!("{} (called from {from})", finding.message);
        }
        if let Some(words) = &finding.assumed {
            finding.message = format!("{} (with {words})", finding.message);
        }
    }
    for (first, others) in firsts.into_values() {
        let first = &mut kept[first];
        // Passes of a loop are at one place.
        let others: Vec<Place> = others.into_iter().filter(|it| *it != first.place()).collect();
        let what = if first.calls.is_empty() { "move" } else { "call" };
        if !others.is_empty() {
            let ending = if others.len() == 1 { "" } else { "s" };
            first.message = format!("{} (and {} more {what}{ending})", first.message, others.len());
        }
        first.related.splice(0..0, others);
    }
    kept
}

/// The first of some places in words, as they are seen from a module.
fn places(all: &[Place], from: usize, modules: &[&Module]) -> String {
    let one = |(module, line, column): &Place| {
        let other = modules.get(*module).filter(|_| *module != from);
        let name = other.and_then(|it| it.name()).map(|name| format!("{name}:"));
        format!("{}{line}:{column}", name.unwrap_or_default())
    };
    listed(&all.iter().map(one).collect::<Vec<_>>())
}

/// The first of some words.
pub(super) fn listed(words: &[String]) -> String {
    let shown = words[..words.len().min(5)].join(", ");
    if words.len() > 5 { format!("{shown} and {} more", words.len() - 5) } else { shown }
}
