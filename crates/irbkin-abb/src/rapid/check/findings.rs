//! Findings in the order of the text, each once and in one for each cause.

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use super::fixes::{Demand, correct};
use crate::rapid::data::finding::{Code, Finding};

/// The places, codes and words of findings.
pub(super) type Seen = BTreeSet<([usize; 3], Code, String)>;

/// Add a finding that is new: routines are followed again for each of their callers.
pub(super) fn add_once(found: &mut Vec<Finding>, seen: &mut Seen, finding: Finding) {
    let place = [finding.module, finding.line, finding.column];
    if seen.insert((place, finding.code, finding.message.clone())) {
        found.push(finding);
    }
}

/// Findings in the order of the text, each once, with their corrections.
pub(super) fn sorted(mut found: Vec<Finding>, demands: &[Demand]) -> Vec<Finding> {
    correct(demands, &mut found);
    found.sort_by_key(|it| (it.module, it.line, it.column, it.code));
    found.dedup_by(|a, b| {
        (a.module, a.line, a.column, a.code, &a.message)
            == (b.module, b.line, b.column, b.code, &b.message)
    });
    // Nothing is said of the way to a target that cannot be met.
    let (mut unmet, mut without_path) = (None, None);
    found.retain(|it| {
        let place = (it.module, it.line, it.column);
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

/// Findings of one cause as the first of them, with the places and the corrections of the others.
fn of_one_cause(found: Vec<Finding>) -> Vec<Finding> {
    let mut firsts = BTreeMap::new();
    let mut kept: Vec<Finding> = Vec::new();
    for mut finding in found {
        let cause = core::mem::take(&mut finding.cause);
        if !cause.is_empty() {
            let first = *firsts.entry((finding.code, cause)).or_insert(kept.len());
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
        let more = finding.related.len();
        if more > 0 {
            let moves = if more == 1 { "move" } else { "moves" };
            finding.message = format!("{} (and {more} more {moves})", finding.message);
        }
    }
    kept
}
