//! Replaces values in a text, without any other change.

use core::ops::Range;

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use crate::error::{Error, Missing, RapidFault, RapidFaultKind};
use crate::rapid::data::module::{Content, Module};
use crate::rapid::data::value::Value;

/// A value that replaces another.
#[derive(Clone, Debug, PartialEq)]
pub struct NewValue {
    /// Index of the datum in [`Module::data`].
    pub datum: usize,
    /// Index of the element in the values of an array, from 0; `None` for a single value.
    pub element: Option<usize>,
    /// The new value, of the datum's type.
    pub value: Value,
}

/// The text that `module` was read from, with new values. Comments, blanks and everything else are
/// kept byte for byte.
///
/// A declaration without a value gets one.
///
/// # Errors
///
/// [`Error::Rapid`] when there is no such datum or element, a value has another type or is not
/// finite, one place gets two values, or `source` is not the text.
pub fn rewrite(source: &str, module: &Module, new_values: &[NewValue]) -> Result<String, Error> {
    // In another text of the same length, a place may be inside a character.
    let other_text =
        || nowhere(RapidFaultKind::OtherText { found: source.len(), wanted: module.text_length });
    if source.len() != module.text_length {
        return Err(other_text());
    }
    let mut places = Vec::with_capacity(new_values.len());
    for new in new_values {
        places.push((place(module, new)?, new));
    }
    places.sort_by_key(|(span, _)| span.start);
    let mut text = String::with_capacity(source.len());
    let mut copied = 0;
    let mut last_start = None;
    for (span, new) in places {
        if last_start == Some(span.start) || span.start < copied {
            let thing = module.data.get(new.datum).map_or_else(String::new, |datum| {
                format!("{} {}", datum.data_type.name(), datum.name)
            });
            return Err(nowhere(RapidFaultKind::TwoValues { thing }));
        }
        text.push_str(source.get(copied..span.start).ok_or_else(other_text)?);
        text.push_str(if span.is_empty() { " := " } else { "" });
        text.push_str(&new.value.to_string());
        (copied, last_start) = (span.end, Some(span.start));
    }
    text.push_str(source.get(copied..).ok_or_else(other_text)?);
    Ok(text)
}

fn nowhere(kind: RapidFaultKind) -> Error {
    RapidFault::nowhere(kind).into()
}

/// The bytes that a new value replaces.
fn place(module: &Module, new: &NewValue) -> Result<Range<usize>, Error> {
    let Some(datum) = module.data.get(new.datum) else {
        let (index, count) = (new.datum, module.data.len());
        let missing = Missing::Datum { index, count };
        return Err(nowhere(RapidFaultKind::NoSuchValue { missing }));
    };
    let thing = format!("{} {}", datum.data_type.name(), datum.name);
    let fault = |kind| RapidFault { line: datum.line, column: datum.column, kind }.into();
    if new.value.data_type() != datum.data_type {
        let (found, wanted) = (new.value.type_name().to_string(), datum.data_type.name());
        return Err(fault(RapidFaultKind::ComponentType {
            thing,
            part: String::new(),
            found,
            wanted,
        }));
    }
    if !new.value.part().is_finite() {
        return Err(fault(RapidFaultKind::NotFinite { text: format!("{}", new.value) }));
    }
    let missing = |missing| Err(fault(RapidFaultKind::NoSuchValue { missing }));
    match (&datum.content, new.element) {
        (Content::Single(_), None) => Ok(datum.value_span.clone()),
        (Content::Uninitialized { sizes }, None) if sizes.is_empty() => {
            Ok(datum.value_span.clone())
        }
        (Content::Array { .. }, Some(element)) => match datum.element_spans.get(element) {
            Some(span) => Ok(span.clone()),
            None => missing(Missing::Element { thing, element }),
        },
        (_, None) => missing(Missing::Single { thing }),
        (_, Some(element)) => missing(Missing::Element { thing, element }),
    }
}
