//! Findings in the order of the text, each once and in one for each cause.

use alloc::collections::{BTreeMap, BTreeSet};

use crate::prelude::*;
use crate::rapid::data::finding::{Code, Finding, Place};
use crate::rapid::data::module::Module;

/// A case of a move: its place, the module and the index of its instruction, the first call that
/// leads to it with arguments, and what is particular in words.
pub(super) type Case = (Place, (usize, usize), Option<Place>, String);

pub(super) fn sorted(
    mut found: Vec<Finding>,
    mut cases: Vec<Case>,
    modules: &[&Module],
) -> Vec<Finding> {
    // Of those that say the same, one that rests on nothing stays.
    found.sort_by_key(|it| (identity(it), it.assumed.is_some()));
    cases.sort_unstable();
    cases.dedup();
    let mut found = of_all_cases(&found, &cases);
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
fn of_all_cases(found: &[Finding], cases: &[Case]) -> Vec<Finding> {
    let mut kept: Vec<Finding> = Vec::new();
    for all in found.chunk_by(|a, b| identity(a) == identity(b)) {
        let mut own = all[0].clone();
        let place = (own.place(), own.instruction);
        let before = cases.partition_point(|it| (it.0, it.1) < place);
        let total = cases[before..].iter().take_while(|it| (it.0, it.1) == place).count();
        let case = &own.case;
        if case.is_empty() && (total <= 1 || own.calls.is_empty()) {
            let mut messages = BTreeSet::new();
            kept.extend(all.iter().filter(|it| messages.insert(&it.message)).cloned());
            continue;
        }
        let mut own_cases: Vec<_> = all.iter().map(|it| (it.calls.first(), &it.case)).collect();
        own_cases.sort_unstable();
        own_cases.dedup();
        let count = own_cases.len();
        let mut calls: Vec<Place> = all.iter().flat_map(|it| &it.calls).copied().collect();
        calls.sort_unstable();
        calls.dedup();
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
        own.calls = calls;
        kept.push(own);
    }
    kept
}

/// Findings of one cause as the first of them, with the places and the corrections of the others.
fn of_one_cause(found: Vec<Finding>, modules: &[&Module]) -> Vec<Finding> {
    let mut firsts = BTreeMap::new();
    let mut kept: Vec<Finding> = Vec::new();
    for mut finding in found {
        let cause = core::mem::take(&mut finding.cause);
        if !cause.is_empty() {
            let of = (finding.code, cause, finding.assumed.is_some());
            let first = *firsts.entry(of).or_insert(kept.len());
            if let Some(first) = kept.get_mut(first) {
                // Passes of a loop are at one place.
                let place = finding.place();
                if *first.related.last().unwrap_or(&first.place()) != place {
                    first.related.push(place);
                }
                first.edits.append(&mut finding.edits);
                continue;
            }
        }
        kept.push(finding);
    }
    for finding in &mut kept {
        finding.edits.sort_by_key(|edit| (edit.module, edit.span.start));
        finding.edits.dedup();
        let others = finding.related.len();
        let place = finding.place();
        finding.related.extend(finding.calls.iter().filter(|call| **call != place));
        let calls = &finding.related[others..];
        if !calls.is_empty() {
            let from = places(calls, finding.module, modules);
            finding.message = format!("{} (called from {from})", finding.message);
        }
        if let Some(words) = &finding.assumed {
            finding.message = format!("{} (with {words})", finding.message);
        }
        if others > 0 {
            let what = match finding.code {
                Code::NameTwice => "name",
                _ if finding.calls.is_empty() => "move",
                _ => "call",
            };
            let ending = if others == 1 { "" } else { "s" };
            finding.message = format!("{} (and {others} more {what}{ending})", finding.message);
        }
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
