//! Names with indices and components: their values and their types.

use alloc::borrow::Cow;
use alloc::format;
use alloc::string::{String, ToString};
use core::ops::Range;

use super::evaluate::{Component, Evaluator, Stop, positive_whole};
use super::names::Lookup;
use crate::rapid::data::expression::{Expression, Form, Name, written};
use crate::rapid::data::module::Content;
use crate::rapid::data::own_types::DEEPEST_TYPE;
use crate::rapid::data::types::{Atom, Atoms, LOADDATA, Shape, TOOLDATA, Type};
use crate::rapid::data::unread::{Reason, Unresolved};
use crate::rapid::data::value::Value;
use crate::rapid::text::fault::RapidFaultKind;

impl Evaluator<'_, '_> {
    /// Append the value of a name with indices and components.
    pub(super) fn fill_reference(
        &self,
        expression: &Expression<'_>,
        (name, indices, components): (&str, &[Expression<'_>], &[Name<'_>]),
        place: &Component<'_>,
        atoms: &mut Atoms,
    ) -> Result<(), Stop> {
        let (name, components) = self.whole_name(name, components);
        let value = self.referred(expression, &name, indices, components)?;
        self.fill_value(expression, &value, components, place, atoms)
    }

    /// Append a component of a value that an expression has.
    pub(super) fn fill_value(
        &self,
        expression: &Expression<'_>,
        value: &Value,
        components: &[Name<'_>],
        place: &Component<'_>,
        atoms: &mut Atoms,
    ) -> Result<(), Stop> {
        let (of, begin) = self.part(expression, value.data_type().described(), components)?;
        let mut source = value.atoms().into_iter();
        if begin > 0 {
            source.nth(begin - 1);
        }
        let is_number = matches!(place.of.shape, Shape::Num | Shape::Whole);
        if is_number && let (Shape::Num | Shape::Whole, Some(atom)) = (&of.shape, source.next()) {
            let number = match atom {
                Atom::Num(number) => number,
                Atom::Whole(number) => f64::from(number),
                Atom::Bool(_) | Atom::Text(_) => return Ok(()),
            };
            return self.fill_number(expression, number, place, atoms);
        }
        if of.name != place.of.name {
            let found = format!("{}, of type {}", written(self.text, expression), of.name);
            return Err(self.wrong_type(expression, place, &found));
        }
        atoms.extend(source.take(of.size()));
        Ok(())
    }

    /// The name of a datum, and the components in it: a component of a record that the program
    /// defines is a datum of its own.
    fn whole_name<'n>(
        &self,
        name: &'n str,
        components: &'n [Name<'n>],
    ) -> (Name<'n>, &'n [Name<'n>]) {
        let own = (Cow::Borrowed(name), components);
        if components.is_empty()
            || !matches!(
                self.names.find(self.at, name),
                Lookup::NotHere | Lookup::Unknown(Unresolved::OtherType { .. })
            )
        {
            return own;
        }
        let mut joined = name.to_string();
        for (index, component) in components.iter().take(DEEPEST_TYPE).enumerate() {
            joined.push('.');
            joined.push_str(component);
            if let Lookup::Datum { .. } = self.names.find(self.at, &joined) {
                return (Cow::Owned(joined), &components[index + 1..]);
            }
        }
        own
    }

    /// The type of a component of a type, and the atoms before it.
    pub(super) fn part(
        &self,
        expression: &Expression<'_>,
        mut of: &'static Type,
        components: &[Name<'_>],
    ) -> Result<(&'static Type, usize), Stop> {
        let mut begin = 0;
        for component in components {
            let (part, before) = of.component(component).ok_or_else(|| {
                let (text, component) = (written(self.text, expression), component.to_string());
                let of = of.name;
                self.fault(expression, RapidFaultKind::NoSuchComponent { text, of, component })
            })?;
            (of, begin) = (part, begin + before);
        }
        Ok((of, begin))
    }

    /// The datum or the element that a reference begins with.
    fn referred(
        &self,
        expression: &Expression<'_>,
        name: &str,
        indices: &[Expression<'_>],
        components: &[Name<'_>],
    ) -> Result<Cow<'_, Value>, Stop> {
        let unknown = |why| Err(Stop::Unknown(Reason::Reference { name: name.to_string(), why }));
        let count = |wanted| {
            let (text, found) = (written(self.text, expression), indices.len());
            Err(self.fault(expression, RapidFaultKind::IndexCount { text, found, wanted }))
        };
        let content = match self.names.find(self.at, name) {
            Lookup::NotHere => return unknown(Unresolved::NotDeclared),
            Lookup::Unknown(why) => return unknown(why),
            Lookup::Predefined(_) if !indices.is_empty() => return count(0),
            Lookup::Predefined(value) => return Ok(Cow::Owned(value)),
            Lookup::Datum { can_change: true, .. } if self.constant => {
                return unknown(Unresolved::CanChange);
            }
            Lookup::Datum { content, cause: Some(cause), .. } if self.at_move => {
                let atoms = self.used_atoms(expression, content, components)?;
                if let Some(cause) = self.names.cause_of(self.at, name, atoms, cause) {
                    return unknown(cause.of(name));
                }
                content
            }
            Lookup::Datum { content, .. } => content,
        };
        match content {
            Content::Uninitialized { .. } => unknown(Unresolved::NoValue),
            Content::Single(_) if !indices.is_empty() => count(0),
            Content::Single(value) => Ok(Cow::Borrowed(value)),
            Content::Array { .. } if indices.is_empty() => unknown(Unresolved::WholeArray),
            Content::Array { sizes, .. } if sizes.len() != indices.len() => count(sizes.len()),
            Content::Array { sizes, values } => {
                let element = values.get(self.element(name, indices, sizes)?);
                element.map(Cow::Borrowed).map_or_else(|| unknown(Unresolved::NoSuchElement), Ok)
            }
        }
    }

    /// The name in lower case of an expression's type, if that is known without its value.
    pub(crate) fn type_name(&self, expression: &Expression<'_>) -> Option<String> {
        let (name, components) = match &expression.form {
            Form::Number(_) => return Some("num".to_string()),
            Form::Text(_) => return Some("string".to_string()),
            Form::Bool(_) => return Some("bool".to_string()),
            Form::Call(call) => {
                let result = self.function(&call.name).ok()?.result;
                let (of, _) = self.part(expression, result, &call.components).ok()?;
                return Some(of.name.to_string());
            }
            Form::Name(name) => (name, &[][..]),
            Form::Reference(reference) => (&reference.name, reference.components.as_slice()),
            _ => return None,
        };
        let (name, components) = self.whole_name(name, components);
        let value = match self.names.find(self.at, &name) {
            Lookup::Predefined(value) => Cow::Owned(value),
            Lookup::Datum { content: Content::Single(value), .. } => Cow::Borrowed(value),
            Lookup::Datum { content: Content::Array { values, .. }, .. } => {
                Cow::Borrowed(values.first()?)
            }
            Lookup::Unknown(Unresolved::OtherType { type_name }) if components.is_empty() => {
                return Some(type_name.to_lowercase());
            }
            _ => return None,
        };
        let (of, _) = value.data_type().described().part(components)?;
        Some(of.name.to_string())
    }

    /// The atoms of a component that count in a move: of a tool, its load does not.
    fn used_atoms(
        &self,
        expression: &Expression<'_>,
        content: &Content,
        components: &[Name<'_>],
    ) -> Result<Range<usize>, Stop> {
        let value = match content {
            Content::Single(value) => Some(value),
            Content::Array { values, .. } => values.first(),
            Content::Uninitialized { .. } => None,
        };
        let Some(value) = value else { return Ok(0..usize::MAX) };
        let (of, begin) = self.part(expression, value.data_type().described(), components)?;
        let unused = if of.name == TOOLDATA.name { LOADDATA.size() } else { 0 };
        Ok(begin..begin + of.size() - unused)
    }

    /// The place of an element in its array.
    fn element(
        &self,
        name: &str,
        indices: &[Expression<'_>],
        sizes: &[usize],
    ) -> Result<usize, Stop> {
        let constant = Self { constant: true, ..*self };
        let mut element = 0;
        for (index, size) in indices.iter().zip(sizes) {
            let value = match constant.record(index) {
                Err(Stop::Unknown(reason)) if may_be_any(&reason) => {
                    let text = self.text.get(index.start..index.end).unwrap_or_default();
                    let chosen = self.names.element(text, *size).ok_or(reason)?;
                    element = element * size + chosen;
                    continue;
                }
                value => value?,
            };
            let Some(from_one) = positive_whole(value).filter(|from_one| from_one <= size) else {
                let text = format!("{}{{{}}}", name, written(self.text, index));
                return Err(self.fault(index, RapidFaultKind::Index { text, value, size: *size }));
            };
            element = element * size + from_one - 1;
        }
        Ok(element)
    }
}

/// Whether an index that is not known for a reason may be each one: the variable of a loop without
/// known bounds may end before.
fn may_be_any(reason: &Reason) -> bool {
    let is_of_loop = matches!(reason, Reason::Reference { why: Unresolved::LoopVariable, .. });
    !is_of_loop && *reason != Reason::Unfinished
}
