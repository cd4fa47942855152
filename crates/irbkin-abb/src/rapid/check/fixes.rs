//! Corrections of confdata: where it is written, and what corrects it. Corrections that contradict
//! one another are left out.

use alloc::collections::{BTreeMap, BTreeSet};
use core::ops::Range;

use crate::prelude::*;
use crate::rapid::data::expression::{Expression, Form};
use crate::rapid::data::finding::{Edit, Finding};
use crate::rapid::data::module::Content;
use crate::rapid::data::moves::Move;
use crate::rapid::expression::evaluate::positive_whole;
use crate::rapid::expression::functions::displaces;
use crate::rapid::expression::reader::ExpressionReader;
use crate::rapid::program::whole::Program;
use crate::rapid::text::tokens::Tokens;
use irbkin::Configuration;

/// The confdata that a move needs at its target.
pub(super) struct Demand<'a> {
    pub(super) module: usize,
    pub(super) step: &'a Move,
    pub(super) from: Configuration,
    pub(super) to: Configuration,
    /// The finding that it corrects; `None` if the confdata is right as it is.
    pub(super) finding: Option<usize>,
}

/// Give findings their corrections: none where another move needs the confdata as it is, or
/// needs another one.
pub(super) fn correct(demands: &[Demand<'_>], finder: &Finder<'_, '_>, found: &mut [Finding]) {
    if demands.iter().all(|demand| demand.finding.is_none()) {
        return;
    }
    let mut corrections: BTreeMap<_, Vec<(usize, &Demand<'_>, Written)>> = BTreeMap::new();
    let mut right = BTreeSet::new();
    for demand in demands {
        let Some(written) = finder.of(demand.module, demand.step) else { continue };
        let begin = written.begin();
        if let Some(finding) = demand.finding {
            corrections.entry(begin).or_default().push((finding, demand, written));
        } else {
            right.insert(begin);
        }
    }
    for (begin, all) in corrections {
        let (_, Demand { from, to, .. }, written) = &all[0];
        if right.contains(&begin) || all.iter().any(|(_, other, _)| other.to != *to) {
            continue;
        }
        let edits = written.edits(*from, *to);
        for (index, ..) in all {
            if let Some(finding) = found.get_mut(index) {
                finding.edits.clone_from(&edits);
            }
        }
    }
}

/// How many names are followed from a target to its numbers.
const MOST_NAMES: usize = 8;

/// The confdata of a target in a text.
pub(super) struct Written {
    module: usize,
    span: Range<usize>,
    /// Its numbers, if it is written as such.
    numbers: Option<[Range<usize>; 4]>,
}

impl Written {
    /// Where it begins: no two begin at the same byte.
    fn begin(&self) -> (usize, usize) {
        (self.module, self.span.start)
    }

    /// The edits from one configuration to another: only numbers that differ.
    fn edits(&self, from: Configuration, to: Configuration) -> Vec<Edit> {
        let Some(numbers) = &self.numbers else {
            let Configuration { cf1, cf4, cf6, cfx } = to;
            let text = format!("[{cf1},{cf4},{cf6},{cfx}]");
            return Vec::from([Edit { module: self.module, span: self.span.clone(), text }]);
        };
        let pairs =
            numbers.iter().zip(<[i32; 4]>::from(from).into_iter().zip(<[i32; 4]>::from(to)));
        let differing = pairs.filter(|(_, (from, to))| from != to);
        let edit = |(span, (_, to)): (&Range<usize>, (i32, i32))| Edit {
            module: self.module,
            span: span.clone(),
            text: to.to_string(),
        };
        differing.map(edit).collect()
    }
}

pub(super) struct Finder<'a, 'm> {
    pub(super) program: &'a Program<'m>,
    pub(super) sources: &'a [&'a str],
}

/// A place from which names are looked up: a module and a routine of it.
type At<'a> = (usize, Option<&'a str>);

impl Finder<'_, '_> {
    /// The confdata of the target of a move in a module; `None` if it is calculated.
    pub(super) fn of(&self, module: usize, step: &Move) -> Option<Written> {
        self.within(step.target_span.clone(), (module, step.routine.as_deref()), MOST_NAMES)
    }

    /// The confdata of a value that is written in some bytes.
    fn within(&self, span: Range<usize>, at: At<'_>, names: usize) -> Option<Written> {
        let text = self.sources.get(at.0)?.get(span.clone())?;
        let mut tokens = Tokens::new(text).ok()?;
        let value = ExpressionReader::new(&mut tokens).argument().ok()?;
        self.of_value(&value, span.start, at, names)
    }

    /// The confdata of an expression, whose bytes count from `begin`.
    fn of_value(
        &self,
        value: &Expression<'_>,
        begin: usize,
        at: At<'_>,
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
                Some(Written { module: at.0, span: place(confdata), numbers })
            }
            Form::Name(name) => self.of_name(name, &[], at, names),
            Form::Reference(reference) if reference.components.is_empty() => {
                self.of_name(&reference.name, &reference.indices, at, names)
            }
            // A displaced target keeps its confdata.
            Form::Call(call) if displaces(&call.name) => {
                self.of_value(call.arguments.required.first()?, begin, at, names)
            }
            _ => None,
        }
    }

    fn of_name(
        &self,
        name: &str,
        indices: &[Expression<'_>],
        (module, routine): At<'_>,
        names: usize,
    ) -> Option<Written> {
        let names = names.checked_sub(1)?;
        let lower = name.to_lowercase();
        let routine = routine.map(str::to_lowercase).unwrap_or_default();
        let local = self.program.local(module, &routine, &lower);
        let (module, datum) = if let Some(datum) = local {
            (module, datum)
        } else {
            let (id, datum) = self.program.datum(module, &lower)?;
            // The assignment has the confdata, not the declaration.
            if self.program.assigns_confdata(id) {
                return None;
            }
            (id.module, datum)
        };
        let span = match &datum.content {
            Content::Single(_) if indices.is_empty() => datum.value_span.clone(),
            Content::Array { sizes, .. } if sizes.len() == indices.len() => {
                datum.element_spans.get(element(indices, sizes)?)?.clone()
            }
            _ => return None,
        };
        self.within(span, (module, datum.routine.as_deref()), names)
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
        let index = positive_whole(value).filter(|index| index <= size)?;
        place = place * size + index - 1;
    }
    Some(place)
}
