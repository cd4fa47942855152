//! Evaluate expressions where a value of some type is expected.

use alloc::format;
use alloc::string::{String, ToString};

use super::names::{At, Names};
use crate::rapid::data::expression::{Expression, Form, written};
use crate::rapid::data::types::{Atom, Atoms, Record, Shape, Type};
use crate::rapid::data::unread::Reason;
use crate::rapid::data::value::{DataType, Value};
use crate::rapid::text::fault::{RapidFault, RapidFaultKind};
use crate::rapid::text::literals::unquoted;
use crate::rapid::text::place::{Place, fault_at};

/// Why an expression has no value.
pub(crate) enum Stop {
    /// The text is invalid.
    Fault(RapidFault),
    /// The value is unknown.
    Unknown(Reason),
}

impl From<RapidFault> for Stop {
    fn from(fault: RapidFault) -> Self {
        Self::Fault(fault)
    }
}

impl From<Reason> for Stop {
    fn from(reason: Reason) -> Self {
        Self::Unknown(reason)
    }
}

/// The context of an expression.
#[derive(Clone, Copy)]
pub(crate) struct Evaluator<'r, 'a> {
    pub(crate) text: &'a str,
    pub(crate) names: &'r dyn Names,
    pub(crate) at: At,
    /// The evaluated item for messages: "robtarget" and "p10", or "MoveL" and "tool".
    pub(crate) thing: (&'static str, &'a str),
    /// Whether only constants may be referred to: in sizes and indices.
    pub(crate) constant: bool,
    /// Whether data that the program assigns are unknown: in moves.
    pub(crate) at_move: bool,
    /// A place near the expression: lines are counted from it.
    pub(crate) near: Place,
}

/// A component that a value is evaluated for: its type, and its name for messages.
pub(super) struct Component<'p> {
    pub(super) of: &'static Type,
    name: &'static str,
    inside: Option<&'p Component<'p>>,
}

impl core::fmt::Display for Component<'_> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self.inside {
            Some(above) if !above.name.is_empty() => write!(f, "{above}.{}", self.name),
            _ => f.write_str(self.name),
        }
    }
}

impl Evaluator<'_, '_> {
    /// Evaluate to a value of a type.
    pub(crate) fn value(
        &self,
        expression: &Expression<'_>,
        data_type: DataType,
    ) -> Result<Value, Stop> {
        let atoms = self.atoms(expression, data_type.described())?;
        Value::of(data_type, atoms).ok_or_else(|| Reason::Unfinished.into())
    }

    /// Evaluate to a record, a number, a vector or a rotation.
    pub(crate) fn record<T: Record>(&self, expression: &Expression<'_>) -> Result<T, Stop> {
        let atoms = self.atoms(expression, T::TYPE)?;
        T::take(&mut atoms.into_iter()).ok_or_else(|| Reason::Unfinished.into())
    }

    /// The atoms of a value of a type.
    pub(crate) fn atoms(
        &self,
        expression: &Expression<'_>,
        of: &'static Type,
    ) -> Result<Atoms, Stop> {
        let mut atoms = Atoms::new();
        self.fill(expression, &Component { of, name: "", inside: None }, &mut atoms)?;
        Ok(atoms)
    }

    /// The name of the evaluated item, for a message.
    pub(crate) fn thing(&self) -> String {
        format!("{} {}", self.thing.0, self.thing.1)
    }

    pub(crate) fn fault(&self, expression: &Expression<'_>, kind: RapidFaultKind) -> Stop {
        Stop::Fault(fault_at(self.text, self.near, expression.start, kind))
    }

    pub(super) fn wrong_type(
        &self,
        expression: &Expression<'_>,
        place: &Component<'_>,
        found: &str,
    ) -> Stop {
        let (thing, part) = (self.thing(), place.to_string());
        let (found, wanted) = (found.to_string(), place.of.wanted());
        self.fault(expression, RapidFaultKind::ComponentType { thing, part, found, wanted })
    }

    /// Append the atoms of an expression.
    fn fill(
        &self,
        expression: &Expression<'_>,
        place: &Component<'_>,
        atoms: &mut Atoms,
    ) -> Result<(), Stop> {
        let wrong = |found| Err(self.wrong_type(expression, place, found));
        match (&expression.form, &place.of.shape) {
            (Form::Number(value), _) => self.fill_number(expression, *value, place, atoms),
            (Form::Bool(value), Shape::Bool) => {
                atoms.push(Atom::Bool(*value));
                Ok(())
            }
            (Form::Bool(value), _) => wrong(if *value { "TRUE" } else { "FALSE" }),
            (Form::Text(text), Shape::Text) => {
                atoms.push(Atom::Text(unquoted(text)));
                Ok(())
            }
            (Form::Text(_), _) => wrong("a string"),
            (Form::Aggregate(parts), Shape::Record(components)) => {
                self.fill_aggregate(expression, (parts, components), place, atoms)
            }
            (Form::Aggregate(_), _) => wrong("an aggregate"),
            (Form::Value(value), _) => {
                atoms.extend(value.atoms());
                Ok(())
            }
            (Form::Name(name), _) => {
                self.fill_reference(expression, (name, &[], &[]), place, atoms)
            }
            (Form::Reference(it), _) => {
                let whole = (&*it.name, it.indices.as_slice(), it.components.as_slice());
                self.fill_reference(expression, whole, place, atoms)
            }
            (Form::Call(call), _) => self.fill_call(expression, call, place, atoms),
            (Form::Negated(_) | Form::Chain(..), _) => {
                self.fill_operators(expression, place, atoms)
            }
            (Form::Not(_), _) => Err(Reason::Negation.into()),
            (Form::Compared(..), _) => Err(Reason::Operator.into()),
            (Form::Star, _) => Err(Reason::Taught.into()),
            (Form::Unread(reason), _) => Err(Reason::clone(reason).into()),
        }
    }

    /// Append a number. RAPID has no negative zero: it becomes a positive one.
    pub(super) fn fill_number(
        &self,
        expression: &Expression<'_>,
        value: f64,
        place: &Component<'_>,
        atoms: &mut Atoms,
    ) -> Result<(), Stop> {
        atoms.push(match place.of.shape {
            Shape::Num => Atom::Num(value + 0.0),
            Shape::Whole => Atom::Whole(whole(value).ok_or_else(|| {
                let (thing, part) = (self.thing(), place.to_string());
                self.fault(expression, RapidFaultKind::NotWhole { thing, part, value })
            })?),
            _ => return Err(self.wrong_type(expression, place, "a number")),
        });
        Ok(())
    }

    /// Append the parts of an aggregate, one for each component.
    fn fill_aggregate(
        &self,
        expression: &Expression<'_>,
        (parts, components): (&[Expression<'_>], &[(&'static str, &'static Type)]),
        place: &Component<'_>,
        atoms: &mut Atoms,
    ) -> Result<(), Stop> {
        if components.len() != parts.len() {
            let (thing, part) = (self.thing(), place.to_string());
            let (found, wanted) = (parts.len(), components.len());
            let missing = missing(parts, components).unwrap_or_default();
            let kind = RapidFaultKind::ComponentCount { thing, part, found, wanted, missing };
            return Err(self.fault(expression, kind));
        }
        for ((name, of), part) in components.iter().zip(parts) {
            self.fill(part, &Component { of, name, inside: Some(place) }, atoms)?;
        }
        Ok(())
    }

    /// A number, which must be finite.
    pub(super) fn finite(&self, expression: &Expression<'_>, value: f64) -> Result<f64, Stop> {
        if value.is_finite() {
            return Ok(value);
        }
        Err(self
            .fault(expression, RapidFaultKind::NotFinite { text: written(self.text, expression) }))
    }
}

/// The component without which the others fit the parts of an aggregate; of several the last. Of
/// numbers any may be missing.
fn missing(
    parts: &[Expression<'_>],
    components: &[(&'static str, &'static Type)],
) -> Option<&'static str> {
    let is_missing = |place: &usize| {
        let others = components[..*place].iter().chain(&components[place + 1..]);
        parts.len() + 1 == components.len()
            && others.zip(parts).all(|((_, of), part)| may_be(part, of))
    };
    let are_numbers =
        components.iter().all(|(_, of)| matches!(of.shape, Shape::Num | Shape::Whole));
    let place = (0..components.len()).rev().find(is_missing).filter(|_| !are_numbers)?;
    Some(components[place].0)
}

/// Whether an expression may be of a type, by its form.
fn may_be(expression: &Expression<'_>, of: &Type) -> bool {
    match expression.form {
        Form::Number(_) => matches!(of.shape, Shape::Num | Shape::Whole),
        Form::Bool(_) => matches!(of.shape, Shape::Bool),
        Form::Text(_) => matches!(of.shape, Shape::Text),
        Form::Aggregate(_) => matches!(of.shape, Shape::Record(_)),
        _ => true,
    }
}

/// A number of confdata, if it is whole and in range.
pub(super) fn whole(value: f64) -> Option<i32> {
    #[expect(clippy::cast_possible_truncation, reason = "what is lost shows")]
    let whole = value as i32;
    (value - f64::from(whole) == 0.0).then_some(whole)
}

/// A positive whole number as a size or an index.
pub(crate) fn positive_whole(value: f64) -> Option<usize> {
    /// Above, whole numbers cannot be distinguished.
    const MOST: f64 = 9_007_199_254_740_992.0;
    if !(1.0..=MOST).contains(&value) {
        return None;
    }
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "between 1 and 2^53; what is lost shows"
    )]
    let whole = value as u64;
    #[expect(clippy::cast_precision_loss, reason = "below 2^53")]
    let is_whole = value - whole as f64 == 0.0;
    if is_whole { usize::try_from(whole).ok() } else { None }
}
