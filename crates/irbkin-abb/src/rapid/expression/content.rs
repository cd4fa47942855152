//! The content of a declaration: a value, or the elements of an array.

use core::ops::Range;

use super::evaluate::{Evaluator, Stop, positive_whole};
use crate::prelude::*;
use crate::rapid::data::expression::{Expression, Form};
use crate::rapid::data::module::Content;
use crate::rapid::data::unread::Reason;
use crate::rapid::data::value::{DataType, Value};
use crate::rapid::text::fault::RapidFaultKind;

const MOST_DIMENSIONS: usize = 3;

/// The sizes and the value of a declaration, as they are written.
pub(crate) struct WrittenContent<'a> {
    pub(crate) data_type: DataType,
    pub(crate) sizes: Vec<Expression<'a>>,
    pub(crate) value: Option<Expression<'a>>,
    /// The place for a value, if it has none.
    pub(crate) value_place: usize,
}

/// A content with the bytes of its value and of its elements.
pub(crate) struct Placed {
    pub(crate) content: Content,
    pub(crate) value_span: Range<usize>,
    pub(crate) element_spans: Vec<Range<usize>>,
}

impl Placed {
    pub(crate) fn new(content: Content, value_span: Range<usize>) -> Self {
        Self { content, value_span, element_spans: Vec::new() }
    }
}

impl WrittenContent<'_> {
    pub(crate) fn evaluate(&self, evaluator: &Evaluator<'_, '_>) -> Result<Placed, Stop> {
        let sizes = self.sizes(evaluator)?;
        let Some(expression) = &self.value else {
            let span = self.value_place..self.value_place;
            return Ok(Placed::new(Content::Uninitialized { sizes }, span));
        };
        let value_span = expression.start..expression.end;
        if sizes.is_empty() {
            let value = evaluator.value(expression, self.data_type)?;
            return Ok(Placed::new(Content::Single(value), value_span));
        }
        let (values, element_spans) = (Vec::new(), Vec::new());
        let mut elements =
            Elements { evaluator, data_type: self.data_type, sizes: &sizes, values, element_spans };
        elements.add(expression, 0)?;
        let Elements { values, element_spans, .. } = elements;
        Ok(Placed { content: Content::Array { sizes, values }, value_span, element_spans })
    }

    fn sizes(&self, evaluator: &Evaluator<'_, '_>) -> Result<Vec<usize>, Stop> {
        let evaluator = Evaluator { constant: true, ..*evaluator };
        let thing = || evaluator.thing();
        if let Some(fourth) = self.sizes.get(MOST_DIMENSIONS) {
            let kind = RapidFaultKind::Dimensions {
                thing: thing(),
                found: self.sizes.len(),
                bound: MOST_DIMENSIONS,
            };
            return Err(evaluator.fault(fourth, kind));
        }
        let mut sizes = Vec::with_capacity(self.sizes.len());
        for (i, size) in self.sizes.iter().enumerate() {
            let value = evaluator.record(size)?;
            let fault = || {
                let (thing, dimension) = (thing(), i + 1);
                evaluator.fault(size, RapidFaultKind::ArrayDimension { thing, dimension, value })
            };
            sizes.push(positive_whole(value).ok_or_else(fault)?);
        }
        Ok(sizes)
    }
}

/// The elements of an array, the last index running fastest.
struct Elements<'e, 'r, 'a> {
    evaluator: &'e Evaluator<'r, 'a>,
    data_type: DataType,
    sizes: &'e [usize],
    values: Vec<Value>,
    element_spans: Vec<Range<usize>>,
}

impl Elements<'_, '_, '_> {
    fn add(&mut self, expression: &Expression<'_>, dimension: usize) -> Result<(), Stop> {
        let Some(&wanted) = self.sizes.get(dimension) else {
            self.values.push(self.evaluator.value(expression, self.data_type)?);
            self.element_spans.push(expression.start..expression.end);
            return Ok(());
        };
        let fault = |kind| Err(self.evaluator.fault(expression, kind));
        let thing = || self.evaluator.thing();
        let no_array = |found: &str| {
            fault(RapidFaultKind::ComponentType {
                thing: thing(),
                part: String::new(),
                found: found.to_string(),
                wanted: "an array",
            })
        };
        let copied = |name: &str| Err(Reason::CopiedArray { name: name.to_string() }.into());
        match &expression.form {
            Form::Aggregate(elements) if elements.len() == wanted => {
                elements.iter().try_for_each(|element| self.add(element, dimension + 1))
            }
            Form::Aggregate(elements) => fault(RapidFaultKind::ArraySize {
                thing: thing(),
                dimension: dimension + 1,
                found: elements.len(),
                wanted,
            }),
            Form::Number(_) => no_array("a number"),
            Form::Text(_) => no_array("a string"),
            Form::Bool(_) => no_array("a truth value"),
            Form::Name(name) => copied(name),
            Form::Reference(reference) => copied(&reference.name),
            _ => Err(Reason::NoAggregate.into()),
        }
    }
}
