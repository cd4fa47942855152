//! Names with indices and components: their values and their types.

use alloc::borrow::Cow;
use alloc::format;
use alloc::string::{String, ToString};

use super::evaluate::{Component, Evaluator, Stop, positive_whole};
use super::functions::Displacement;
use super::names::Found;
use super::tree::{Expression, Form, written};
use crate::error::RapidFaultKind;
use crate::rapid::data::module::Content;
use crate::rapid::data::types::{Atom, Atoms, ROBTARGET, Shape};
use crate::rapid::data::unread::{Reason, Unresolved};
use crate::rapid::data::value::Value;

impl Evaluator<'_, '_> {
    /// Append the value of a name with indices and components.
    pub(super) fn fill_reference(
        &self,
        expression: &Expression<'_>,
        (name, indices, components): (&str, &[Expression<'_>], &[&str]),
        place: &Component<'_>,
        atoms: &mut Atoms,
    ) -> Result<(), Stop> {
        let text = || written(self.text, expression);
        let value = self.referred(expression, name, indices)?;
        let (mut of, mut begin) = (value.data_type().described(), 0);
        for component in components {
            let (part, before) = of.component(component).ok_or_else(|| {
                let (text, component) = (text(), (*component).to_string());
                let of = of.name;
                self.fault(expression, RapidFaultKind::NoSuchComponent { text, of, component })
            })?;
            (of, begin) = (part, begin + before);
        }
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
            let found = format!("{}, of type {}", text(), of.name);
            return Err(self.wrong_type(expression, place, &found));
        }
        atoms.extend(source.take(of.size()));
        Ok(())
    }

    /// The datum or the element that a reference begins with.
    fn referred(
        &self,
        expression: &Expression<'_>,
        name: &str,
        indices: &[Expression<'_>],
    ) -> Result<Cow<'_, Value>, Stop> {
        let unknown = |why| Err(Stop::Unknown(Reason::Reference { name: name.to_string(), why }));
        let count = |wanted| {
            let (text, found) = (written(self.text, expression), indices.len());
            Err(self.fault(expression, RapidFaultKind::IndexCount { text, found, wanted }))
        };
        let content = match self.names.find(self.at, name) {
            Found::NotHere => return unknown(Unresolved::NotDeclared),
            Found::Unknown(why) => return unknown(why),
            Found::Predefined(_) if !indices.is_empty() => return count(0),
            Found::Predefined(value) => return Ok(Cow::Owned(value)),
            Found::Datum { can_change: true, .. } if self.constant => {
                return unknown(Unresolved::CanChange);
            }
            Found::Datum { cause: Some(cause), .. } if self.at_move => {
                return unknown(cause.of(name));
            }
            Found::Datum { content, .. } => content,
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
                Displacement::named(call.name)?;
                let is_own = matches!(self.names.find(self.at, call.name), Found::NotHere);
                return is_own.then(|| ROBTARGET.name.to_string());
            }
            Form::Name(name) => (*name, &[][..]),
            Form::Reference(reference) => (reference.name, reference.components.as_slice()),
            _ => return None,
        };
        let value = match self.names.find(self.at, name) {
            Found::Predefined(value) => Cow::Owned(value),
            Found::Datum { content: Content::Single(value), .. } => Cow::Borrowed(value),
            Found::Datum { content: Content::Array { values, .. }, .. } => {
                Cow::Borrowed(values.first()?)
            }
            Found::Unknown(Unresolved::OtherType { type_name }) if components.is_empty() => {
                return Some(type_name.to_lowercase());
            }
            _ => return None,
        };
        let whole = value.data_type().described();
        let of = components.iter().try_fold(whole, |of, component| {
            of.component(component).map(|(component, _)| component)
        })?;
        Some(of.name.to_string())
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
            let value = constant.number(index)?;
            let Some(from_one) = positive_whole(value).filter(|from_one| from_one <= size) else {
                let text = format!("{}{{{}}}", name, written(self.text, index));
                return Err(self.fault(index, RapidFaultKind::Index { text, value, size: *size }));
            };
            element = element * size + from_one - 1;
        }
        Ok(element)
    }
}
