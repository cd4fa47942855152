//! Evaluates references: to a datum, an element of an array, or a component of one of them.

use alloc::format;
use alloc::string::ToString;

use super::evaluate::{Evaluator, Path, Stop, positive_whole};
use super::names::Found;
use super::tree::{Expression, written};
use crate::error::RapidFaultKind;
use crate::rapid::data::module::Content;
use crate::rapid::data::parts::{Part, PartMut};
use crate::rapid::data::reason::{Reason, Unresolved};

impl Evaluator<'_, '_> {
    /// Write the value of a name with indices and components to its place.
    pub(super) fn fill_reference(
        &self,
        expression: &Expression<'_>,
        name: &str,
        (indices, components): (&[Expression<'_>], &[&str]),
        place: PartMut<'_>,
        path: &Path<'_>,
    ) -> Result<(), Stop> {
        let text = || written(self.text, expression);
        let mut part = self.referred(expression, name, indices)?;
        for component in components {
            let of = part.type_name();
            part = part.component(component).ok_or_else(|| {
                let (text, component) = (text(), (*component).to_string());
                self.fault(expression, RapidFaultKind::NoSuchComponent { text, of, component })
            })?;
        }
        match (place, part) {
            (place @ (PartMut::Num(_) | PartMut::Whole(_)), Part::Num(number)) => {
                self.fill_number(expression, *number, place, path)
            }
            (place @ (PartMut::Num(_) | PartMut::Whole(_)), Part::Whole(number)) => {
                self.fill_number(expression, f64::from(*number), place, path)
            }
            (place, part) if place.type_name() == part.type_name() => {
                place.assign(part);
                Ok(())
            }
            (place, part) => {
                let found = format!("{}, of type {}", text(), part.type_name());
                Err(self.wrong_type(expression, &place, path, &found))
            }
        }
    }

    /// The datum or the element that a reference begins with.
    fn referred(
        &self,
        expression: &Expression<'_>,
        name: &str,
        indices: &[Expression<'_>],
    ) -> Result<Part<'_>, Stop> {
        let unknown = |why| Err(Stop::Unknown(Reason::Reference { name: name.to_string(), why }));
        let count = |wanted| {
            let (text, found) = (written(self.text, expression), indices.len());
            Err(self.fault(expression, RapidFaultKind::IndexCount { text, found, wanted }))
        };
        let content = match self.names.find(self.at, name) {
            Found::NotHere => return unknown(Unresolved::NotDeclared),
            Found::Unknown(why) => return unknown(why),
            Found::Predefined(_) if !indices.is_empty() => return count(0),
            Found::Predefined(part) => return Ok(part),
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
            Content::Single(value) => Ok(value.part()),
            Content::Array { .. } if indices.is_empty() => unknown(Unresolved::WholeArray),
            Content::Array { sizes, .. } if sizes.len() != indices.len() => count(sizes.len()),
            Content::Array { sizes, values } => {
                let element = values.get(self.element(name, indices, sizes)?);
                element.map_or_else(|| unknown(Unresolved::NoSuchElement), |value| Ok(value.part()))
            }
        }
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
