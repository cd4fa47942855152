//! Findings in the order of the text, each once and in one for each cause.

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use super::fixes::{Demand, correct};
use crate::rapid::data::finding::{Code, Finding};

/// The places, codes, words and cases of findings, and whether they rest on something.
pub(super) type Seen = BTreeSet<([usize; 3], Code, bool, String, String)>;

/// Add a finding that is new: routines are followed again for each of their callers.
pub(super) fn add_once(found: &mut Vec<Finding>, seen: &mut Seen, finding: Finding) {
    let place = [finding.module, finding.line, finding.column];
    let is_assumed = finding.assumed.is_some();
    let words = (finding.message.clone(), finding.case.clone());
    if seen.insert((place, finding.code, is_assumed, words.0, words.1)) {
        found.push(finding);
    }
}

/// A move that has cases: its place, and the module and the index of the instruction.
pub(super) type Cased = ([usize; 3], (usize, usize));

/// Findings in the order of the text, each once, with their corrections, by the number of cases of
/// the moves at each place.
pub(super) fn sorted(
    mut found: Vec<Finding>,
    demands: &[Demand],
    cases: &BTreeMap<Cased, usize>,
) -> Vec<Finding> {
    correct(demands, &mut found);
    // Of those that say the same, one that rests on nothing stays.
    found.sort_by_key(|it| (identity(it), it.assumed.is_some()));
    let mut found = of_all_cases(&found, cases);
    // Nothing is said of the way to a target that cannot be met.
    let (mut unmet, mut without_path) = (None, None);
    found.retain(|it| {
        let place = (it.module, it.line, it.column, it.assumed.is_some());
        match it.code {
            Code::OutOfReach | Code::OutsideLimits => unmet = Some(place),
            Code::NoPath => without_path = Some(place),
            Code::UncertainCircle => return without_path != Some(place),
            Code::PathBlocked | Code::Flip => return unmet != Some(place),
            _ => {}
        }
        true
    });
    of_one_cause(found)
}

/// What is the same of findings in several cases.
fn identity(it: &Finding) -> ([usize; 3], Code, Option<usize>, (usize, usize)) {
    ([it.module, it.line, it.column], it.code, it.joint, it.instruction)
}

/// Findings of the cases of a move as the first of them, with the number of the others.
fn of_all_cases(found: &[Finding], cases: &BTreeMap<Cased, usize>) -> Vec<Finding> {
    let mut kept: Vec<Finding> = Vec::new();
    for all in found.chunk_by(|a, b| identity(a) == identity(b)) {
        let first = &all[0];
        if first.case.is_empty() {
            let mut messages = BTreeSet::new();
            kept.extend(all.iter().filter(|it| messages.insert(&it.message)).cloned());
            continue;
        }
        let count = all.iter().map(|it| &it.case).collect::<BTreeSet<_>>().len();
        let place = [first.module, first.line, first.column];
        let total = cases.get(&(place, first.instruction)).copied().unwrap_or(count);
        let mut own = first.clone();
        if count < total || all.iter().any(|it| it.message != first.message) {
            let which = if count > 1 { "first " } else { "" };
            let kind = if first.case.starts_with("at ") { "passes" } else { "cases" };
            own.message =
                format!("{} ({which}{}; {count} of {total} {kind})", first.message, first.case);
        }
        kept.push(own);
    }
    kept
}

/// Findings of one cause as the first of them, with the places and the corrections of the others.
fn of_one_cause(found: Vec<Finding>) -> Vec<Finding> {
    let mut firsts = BTreeMap::new();
    let mut kept: Vec<Finding> = Vec::new();
    for mut finding in found {
        let cause = core::mem::take(&mut finding.cause);
        if !cause.is_empty() {
            let of = (finding.code, cause, finding.assumed.is_some());
            let first = *firsts.entry(of).or_insert(kept.len());
            if let Some(first) = kept.get_mut(first) {
                // Passes of a loop are at one place.
                let place = (finding.module, finding.line, finding.column);
                let own = (first.module, first.line, first.column);
                if *first.related.last().unwrap_or(&own) != place {
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
        if let Some(words) = &finding.assumed {
            finding.message = format!("{} (with {words})", finding.message);
        }
        let more = finding.related.len();
        if more > 0 {
            let moves = if more == 1 { "move" } else { "moves" };
            finding.message = format!("{} (and {more} more {moves})", finding.message);
        }
    }
    kept
}
