//! Corrections of confdata, of which those that contradict one another are left out.

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::vec::Vec;

use super::confdata::{Finder, Written};
use super::diagnostic::Diagnostic;
use crate::rapid::data::moves::Move;
use crate::report::Configuration;

/// What a move asks of the confdata of its target.
pub(super) struct Demand<'m> {
    pub(super) step: &'m Move,
    pub(super) from: Configuration,
    pub(super) to: Configuration,
    /// The diagnostic that it corrects; `None` if the confdata is right as it is.
    pub(super) diagnostic: Option<usize>,
}

/// A correction of one confdata.
struct Correction {
    written: Written,
    from: Configuration,
    to: Configuration,
    diagnostics: Vec<usize>,
}

/// Give the diagnostics their corrections: none where another move needs the confdata as it is, or
/// needs another one.
pub(super) fn correct(finder: &Finder<'_>, demands: &[Demand<'_>], found: &mut [Diagnostic]) {
    let mut corrections: BTreeMap<usize, Correction> = BTreeMap::new();
    let mut contradicted = BTreeSet::new();
    for demand in demands {
        let Some(diagnostic) = demand.diagnostic else { continue };
        let Some(written) = finder.of(demand.step) else { continue };
        let (begin, from, to) = (written.begin(), demand.from, demand.to);
        let made = || Correction { written, from, to, diagnostics: Vec::new() };
        let correction = corrections.entry(begin).or_insert_with(made);
        if correction.to != to {
            contradicted.insert(begin);
        }
        correction.diagnostics.push(diagnostic);
    }
    if corrections.is_empty() {
        return;
    }
    for demand in demands.iter().filter(|demand| demand.diagnostic.is_none()) {
        if let Some(written) = finder.of(demand.step) {
            contradicted.insert(written.begin());
        }
    }
    for (begin, correction) in corrections {
        if contradicted.contains(&begin) {
            continue;
        }
        let edits = correction.written.edits(correction.from, correction.to);
        for index in correction.diagnostics {
            if let Some(diagnostic) = found.get_mut(index) {
                diagnostic.edits.clone_from(&edits);
            }
        }
    }
}
