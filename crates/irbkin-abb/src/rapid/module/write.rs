//! Modules as RAPID text, and values replaced in a text without any other change.

use alloc::collections::BTreeMap;
use core::fmt::{self, Write as _};
use core::ops::Range;

use super::read::nowhere;
use crate::Error;
use crate::prelude::*;
use crate::rapid::data::module::{Content, Datum, Module, Routine, Scope};
use crate::rapid::data::moves::Move;
use crate::rapid::data::statement::StatementKind;
use crate::rapid::data::types::are_finite;
use crate::rapid::data::value::Value;
use crate::rapid::text::fault::{Missing, RapidFault, RapidFaultKind};

impl fmt::Display for Content {
    /// The value as RAPID writes it, with an array's brackets; nothing without a value.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Uninitialized { .. } => Ok(()),
            Self::Single(value) => value.fmt(f),
            Self::Array { sizes, values } => {
                for (i, value) in values.iter().enumerate() {
                    let begins = |products: usize| i % products == 0;
                    let opened = products(sizes).filter(|size| begins(*size)).count();
                    f.write_str(if i == 0 { "" } else { "," })?;
                    (0..opened).try_for_each(|_| f.write_char('['))?;
                    value.fmt(f)?;
                    let closed = products(sizes).filter(|size| (i + 1) % size == 0).count();
                    (0..closed).try_for_each(|_| f.write_char(']'))?;
                }
                Ok(())
            }
        }
    }
}

/// Elements of the whole array, of an element of its first dimension, and so on; never zero.
fn products(sizes: &[usize]) -> impl Iterator<Item = usize> {
    (0..sizes.len()).map(|i| {
        sizes[i..].iter().fold(1_usize, |product, size| product.saturating_mul(*size)).max(1)
    })
}

impl fmt::Display for Datum {
    /// The declaration with its semicolon.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.write(f, None)
    }
}

impl Datum {
    /// Write the declaration with its semicolon; an expression may replace the value.
    fn write(&self, f: &mut dyn fmt::Write, expression: Option<&str>) -> fmt::Result {
        if self.scope != Scope::Global {
            write!(f, "{} ", self.scope.name())?;
        }
        write!(f, "{} {} {}", self.storage.name(), self.data_type.name(), self.name)?;
        if let Content::Array { sizes, .. } | Content::Uninitialized { sizes } = &self.content {
            for (i, size) in sizes.iter().enumerate() {
                write!(f, "{}{size}", if i == 0 { '{' } else { ',' })?;
            }
            f.write_str(if sizes.is_empty() { "" } else { "}" })?;
        }
        match (&self.content, expression) {
            (Content::Uninitialized { .. }, _) => {}
            (_, Some(expression)) => write!(f, ":={expression}")?,
            (content, None) => write!(f, ":={content}")?,
        }
        f.write_char(';')
    }
}

/// Write an optional argument; a text that begins with a question mark passes on the caller's own
/// argument.
fn write_option(f: &mut fmt::Formatter<'_>, name: &str, text: Option<&str>) -> fmt::Result {
    match text {
        None => write!(f, "\\{name}"),
        Some(text) if text.starts_with('?') => write!(f, "\\{name}{text}"),
        Some(text) => write!(f, "\\{name}:={text}"),
    }
}

impl Move {
    /// The texts of the required arguments in order, each with whether it is the tool.
    fn required(&self) -> Vec<(&str, bool)> {
        let via = self.via.as_ref().map(|via| (&*via.text, false));
        let own = [
            (&*self.target.text, false),
            (&self.speed.text, false),
            (&self.zone.text, false),
            (&self.tool.text, true),
        ];
        let mut own = via.into_iter().chain(own).filter(|(text, _)| !text.is_empty());
        let mut extra = self.extra.iter().peekable();
        let mut required = Vec::with_capacity(self.extra.len() + 5);
        loop {
            let next = extra.next_if(|extra| extra.place <= required.len());
            let next = next.map(|extra| (extra.text.as_str(), false));
            match next.or_else(|| own.next()) {
                Some(argument) => required.push(argument),
                None => break,
            }
        }
        required.extend(extra.map(|extra| (extra.text.as_str(), false)));
        required
    }

    fn write_options(&self, f: &mut fmt::Formatter<'_>, after: usize) -> fmt::Result {
        let mut options = self.options.iter().filter(|option| option.after == after);
        options.try_for_each(|option| write_option(f, &option.name, option.text.as_deref()))
    }
}

impl fmt::Display for Move {
    /// The instruction with its semicolon, each argument as it was written.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ", self.instruction)?;
        self.write_options(f, 0)?;
        if self.options.iter().any(|option| option.after == 0) {
            f.write_str(", ")?;
        }
        let required = self.required();
        let of_wobj = required.iter().position(|(_, is_tool)| *is_tool);
        let of_wobj = of_wobj.unwrap_or(required.len().saturating_sub(1));
        for (i, (text, _)) in required.iter().enumerate() {
            write!(f, "{}{text}", if i == 0 { "" } else { "," })?;
            if let (Some(wobj), true) = (&self.wobj, i == of_wobj) {
                write_option(f, "WObj", Some(&wobj.text))?;
            }
            self.write_options(f, i + 1)?;
        }
        f.write_char(';')
    }
}

/// A line of a module or of a routine, in the module with the routine that it begins.
struct Line<'m> {
    /// Whether it is none of the data of a routine, which come first; line and column of the text.
    place: (bool, usize, usize),
    text: String,
    begins: Option<&'m Routine>,
}

/// The lines of each routine, by its name in lower case; the module has the empty name. What was
/// not read from a text comes last.
fn lines(module: &Module) -> Result<BTreeMap<String, Vec<Line<'_>>>, fmt::Error> {
    let mut lines: BTreeMap<String, Vec<Line<'_>>> = BTreeMap::new();
    let mut add = |routine: Option<&str>, (is_late, line, column), text, begins| {
        let place = (is_late, if line == 0 { usize::MAX } else { line }, column);
        let of = lines.entry(routine.map(str::to_lowercase).unwrap_or_default());
        of.or_default().push(Line { place, text, begins });
    };
    for (i, datum) in module.data.iter().enumerate() {
        let mut text = String::new();
        datum.write(&mut text, module.expressions.get(&i).map(String::as_str))?;
        let routine = datum.routine.as_deref();
        add(routine, (routine.is_none(), datum.line, datum.column), text, None);
    }
    for statement in &module.statements {
        let text = match statement.kind {
            StatementKind::Move(index) => module.moves.get(index).map(ToString::to_string),
            _ => None,
        };
        let text = text.unwrap_or_else(|| statement.text.clone());
        let routine = statement.routine.as_deref();
        add(routine, (true, statement.line, statement.column), text, None);
    }
    for routine in &module.routines {
        let place = (true, routine.line, routine.column);
        add(None, place, routine.header.clone(), Some(routine));
    }
    for of in lines.values_mut() {
        of.sort_by_key(|line| line.place);
    }
    Ok(lines)
}

impl fmt::Display for Module {
    /// The module as a text that reads back as the same module: values as they are, without
    /// comments; values that refer to assigned data, and what was skipped, as written.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let lines = lines(self)?;
        if let Some(name) = &self.name {
            write!(f, "MODULE {name}")?;
            if !self.attributes.is_empty() {
                write!(f, "({})", self.attributes.join(","))?;
            }
            writeln!(f)?;
        }
        let margin = if self.name.is_some() { "    " } else { "" };
        for Line { text, begins, .. } in lines.get("").into_iter().flatten() {
            writeln!(f, "{margin}{text}")?;
            let Some(routine) = begins else { continue };
            for line in lines.get(&routine.name.to_lowercase()).into_iter().flatten() {
                writeln!(f, "{margin}    {}", line.text)?;
            }
            writeln!(f, "{margin}{}", routine.kind.end())?;
        }
        if self.name.is_some() { writeln!(f, "ENDMODULE") } else { Ok(()) }
    }
}

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
    if !are_finite(&new.value.atoms()) {
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
