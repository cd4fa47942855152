//! Corrections of confdata: where it is written, and what corrects it. Corrections that contradict
//! one another are left out.

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::ops::Range;

use crate::rapid::data::finding::{Edit, Finding};
use crate::rapid::data::module::{Content, Module};
use crate::rapid::data::moves::Move;
use crate::rapid::expression::functions::Displacement;
use crate::rapid::expression::reader::ExpressionReader;
use crate::rapid::expression::tree::{Expression, Form};
use crate::rapid::text::tokens::Tokens;
use crate::report::Configuration;

/// The confdata that a move needs at its target.
pub(super) struct Demand<'m> {
    pub(super) step: &'m Move,
    pub(super) from: Configuration,
    pub(super) to: Configuration,
    /// The finding that it corrects; `None` if the confdata is right as it is.
    pub(super) finding: Option<usize>,
}

/// A correction of one confdata.
struct Correction {
    written: Written,
    from: Configuration,
    to: Configuration,
    findings: Vec<usize>,
}

/// Give findings their corrections: none where another move needs the confdata as it is, or
/// needs another one.
pub(super) fn correct(finder: &Finder<'_>, demands: &[Demand<'_>], found: &mut [Finding]) {
    let mut corrections: BTreeMap<usize, Correction> = BTreeMap::new();
    let mut contradicted = BTreeSet::new();
    for demand in demands {
        let Some(finding) = demand.finding else { continue };
        let Some(written) = finder.of(demand.step) else { continue };
        let (begin, from, to) = (written.begin(), demand.from, demand.to);
        let made = || Correction { written, from, to, findings: Vec::new() };
        let correction = corrections.entry(begin).or_insert_with(made);
        if correction.to != to {
            contradicted.insert(begin);
        }
        correction.findings.push(finding);
    }
    if corrections.is_empty() {
        return;
    }
    for demand in demands.iter().filter(|demand| demand.finding.is_none()) {
        if let Some(written) = finder.of(demand.step) {
            contradicted.insert(written.begin());
        }
    }
    for (begin, correction) in corrections {
        if contradicted.contains(&begin) {
            continue;
        }
        let edits = correction.written.edits(correction.from, correction.to);
        for index in correction.findings {
            if let Some(finding) = found.get_mut(index) {
                finding.edits.clone_from(&edits);
            }
        }
    }
}

/// How many names are followed from a target to its numbers.
const MOST_NAMES: usize = 8;

/// The confdata of a target in the text.
struct Written {
    span: Range<usize>,
    /// Its numbers, if it is written as such.
    numbers: Option<[Range<usize>; 4]>,
}

impl Written {
    /// Where it begins: no two begin at the same byte.
    fn begin(&self) -> usize {
        self.span.start
    }

    /// The edits from one configuration to another: only numbers that differ.
    fn edits(&self, from: Configuration, to: Configuration) -> Vec<Edit> {
        let Some(numbers) = &self.numbers else {
            let Configuration { cf1, cf4, cf6, cfx } = to;
            let text = alloc::format!("[{cf1},{cf4},{cf6},{cfx}]");
            return Vec::from([Edit { span: self.span.clone(), text }]);
        };
        let of = |it: Configuration| [it.cf1, it.cf4, it.cf6, it.cfx];
        let pairs = numbers.iter().zip(of(from).into_iter().zip(of(to)));
        let differing = pairs.filter(|(_, (from, to))| from != to);
        differing.map(|(span, (_, to))| Edit { span: span.clone(), text: to.to_string() }).collect()
    }
}

/// A finder of confdata in a text.
pub(super) struct Finder<'a> {
    source: &'a str,
    module: &'a Module,
    /// Data of routines, by routine and name in lower case.
    locals: BTreeMap<(String, String), usize>,
}

impl<'a> Finder<'a> {
    pub(super) fn new(source: &'a str, module: &'a Module) -> Self {
        let mut locals = BTreeMap::new();
        for (index, datum) in module.data().iter().enumerate() {
            if let Some(routine) = &datum.routine {
                locals.insert((routine.to_lowercase(), datum.name.to_lowercase()), index);
            }
        }
        Self { source, module, locals }
    }

    /// The confdata of a move's target; `None` if it is in another module, or calculated.
    fn of(&self, step: &Move) -> Option<Written> {
        self.within(step.target.span.clone(), step.routine.as_deref(), MOST_NAMES)
    }

    /// The confdata of a value that is written in some bytes.
    fn within(&self, span: Range<usize>, routine: Option<&str>, names: usize) -> Option<Written> {
        let text = self.source.get(span.clone())?;
        let mut tokens = Tokens::new(text).ok()?;
        let value = ExpressionReader::new(&mut tokens).argument().ok()?;
        self.of_value(&value, span.start, routine, names)
    }

    /// The confdata of an expression, whose bytes count from `begin`.
    fn of_value(
        &self,
        value: &Expression<'_>,
        begin: usize,
        routine: Option<&str>,
        names: usize,
    ) -> Option<Written> {
        let place = |part: &Expression<'_>| part.start + begin..part.end + begin;
        match &value.form {
            Form::Aggregate(parts) => {
                let [_, _, confdata, _] = parts.as_slice() else { return None };
                let numbers = match &confdata.form {
                    Form::Aggregate(numbers) => match numbers.as_slice() {
                        [a, b, c, d] if numbers.iter().all(is_number) => {
                            Some([place(a), place(b), place(c), place(d)])
                        }
                        _ => None,
                    },
                    _ => None,
                };
                Some(Written { span: place(confdata), numbers })
            }
            Form::Name(name) => self.of_name(name, &[], routine, names),
            Form::Reference(reference) if reference.components.is_empty() => {
                self.of_name(reference.name, &reference.indices, routine, names)
            }
            // A displaced target keeps its confdata.
            Form::Call(call) if Displacement::named(call.name).is_some() => {
                self.of_value(call.required.first()?, begin, routine, names)
            }
            _ => None,
        }
    }

    fn of_name(
        &self,
        name: &str,
        indices: &[Expression<'_>],
        routine: Option<&str>,
        names: usize,
    ) -> Option<Written> {
        let names = names.checked_sub(1)?;
        let local = routine.and_then(|routine| {
            self.locals.get(&(routine.to_lowercase(), name.to_lowercase())).copied()
        });
        let datum = self.module.data().get(local.or_else(|| self.module.position(name))?)?;
        let span = match &datum.content {
            Content::Single(_) if indices.is_empty() => datum.value_span.clone(),
            Content::Array { sizes, .. } if sizes.len() == indices.len() => {
                datum.element_spans.get(element(indices, sizes)?)?.clone()
            }
            _ => return None,
        };
        self.within(span, datum.routine.as_deref(), names)
    }
}

fn is_number(part: &Expression<'_>) -> bool {
    matches!(part.form, Form::Number(_))
}

/// The place of an element in its array, whose indices are written as numbers.
fn element(indices: &[Expression<'_>], sizes: &[usize]) -> Option<usize> {
    let mut place = 0;
    for (index, size) in indices.iter().zip(sizes) {
        let Form::Number(value) = index.form else { return None };
        let index = (1..=*size).find(|index| {
            #[expect(clippy::cast_precision_loss, reason = "an index")]
            let index = *index as f64;
            index.total_cmp(&value).is_eq()
        })?;
        place = place * size + index - 1;
    }
    Some(place)
}
