//! Evaluates expressions where a value of some type is expected.

use alloc::format;
use alloc::string::{String, ToString};

use super::names::{At, Names};
use super::tree::{Expression, Form, Operator, Unread, written};
use crate::error::{RapidFault, RapidFaultKind};
use crate::rapid::data::data_type::DataType;
use crate::rapid::data::parts::PartMut;
use crate::rapid::data::reason::Reason;
use crate::rapid::data::value::{Record, Value};
use crate::rapid::text::literals::unquoted;
use crate::rapid::text::place::fault_at;

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

impl From<Unread> for Reason {
    fn from(unread: Unread) -> Self {
        match unread {
            Unread::Unfinished => Self::Unfinished,
            Unread::OptionalArgument => Self::OptionalArgument,
            Unread::Operator => Self::Operator,
            Unread::Negation => Self::Negation,
        }
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
}

/// The name of a component and of those that contain it, for messages.
#[derive(Clone, Copy)]
pub(super) struct Path<'p> {
    name: &'static str,
    of: Option<&'p Path<'p>>,
}

impl Path<'_> {
    const WHOLE: Self = Path { name: "", of: None };
}

impl core::fmt::Display for Path<'_> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self.of {
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
        let mut value = Value::zero(data_type);
        self.fill(expression, value.part_mut(), &Path::WHOLE)?;
        Ok(value)
    }

    /// Evaluate to a record.
    pub(crate) fn record<T: Record>(&self, expression: &Expression<'_>) -> Result<T, Stop> {
        let mut record = T::ZERO;
        self.fill(expression, record.part_mut(), &Path::WHOLE)?;
        Ok(record)
    }

    /// Evaluate to a number.
    pub(crate) fn number(&self, expression: &Expression<'_>) -> Result<f64, Stop> {
        let mut number = 0.0;
        self.fill(expression, PartMut::Num(&mut number), &Path::WHOLE)?;
        Ok(number)
    }

    /// The name of the evaluated item, for a message.
    pub(crate) fn thing(&self) -> String {
        format!("{} {}", self.thing.0, self.thing.1)
    }

    pub(crate) fn fault(&self, expression: &Expression<'_>, kind: RapidFaultKind) -> Stop {
        Stop::Fault(fault_at(self.text, expression.start, kind))
    }

    pub(super) fn wrong_type(
        &self,
        expression: &Expression<'_>,
        place: &PartMut<'_>,
        path: &Path<'_>,
        found: &str,
    ) -> Stop {
        let (thing, part) = (self.thing(), path.to_string());
        let (found, wanted) = (found.to_string(), place.wanted());
        self.fault(expression, RapidFaultKind::ComponentType { thing, part, found, wanted })
    }

    /// Write the value of an expression to its place, the component of a path.
    fn fill(
        &self,
        expression: &Expression<'_>,
        place: PartMut<'_>,
        path: &Path<'_>,
    ) -> Result<(), Stop> {
        let wrong =
            |place: PartMut<'_>, found| Err(self.wrong_type(expression, &place, path, found));
        match (&expression.form, place) {
            (Form::Number(value), place) => self.fill_number(expression, *value, place, path),
            (Form::Bool(value), PartMut::Bool(place)) => {
                *place = *value;
                Ok(())
            }
            (Form::Bool(value), place) => wrong(place, if *value { "TRUE" } else { "FALSE" }),
            (Form::Text(text), PartMut::Text(place)) => {
                *place = unquoted(text);
                Ok(())
            }
            (Form::Text(_), place) => wrong(place, "a string"),
            (Form::Aggregate(components), place) => {
                self.fill_aggregate(expression, components, place, path)
            }
            (Form::Name(name), place) => {
                self.fill_reference(expression, name, (&[], &[]), place, path)
            }
            (Form::Reference(it), place) => {
                self.fill_reference(expression, it.name, (&it.indices, &it.components), place, path)
            }
            (Form::Call(call), place) => self.fill_call(expression, call, place, path),
            (Form::Negated(_) | Form::Chain(..), place @ (PartMut::Num(_) | PartMut::Whole(_))) => {
                self.fill_number(expression, self.arithmetic(expression)?, place, path)
            }
            (Form::Negated(_) | Form::Chain(..), place) => {
                Err(Reason::Arithmetic { type_name: place.type_name() }.into())
            }
            (Form::Star, _) => Err(Reason::Taught.into()),
            (Form::Unread(unread), _) => Err(Reason::from(*unread).into()),
        }
    }

    /// Write a number to its place. RAPID has no negative zero: it becomes a positive one.
    pub(super) fn fill_number(
        &self,
        expression: &Expression<'_>,
        value: f64,
        place: PartMut<'_>,
        path: &Path<'_>,
    ) -> Result<(), Stop> {
        match place {
            PartMut::Num(place) => *place = value + 0.0,
            PartMut::Whole(place) => {
                let fault = || {
                    let (thing, part) = (self.thing(), path.to_string());
                    self.fault(expression, RapidFaultKind::NotWhole { thing, part, value })
                };
                *place = whole(value).ok_or_else(fault)?;
            }
            place => return Err(self.wrong_type(expression, &place, path, "a number")),
        }
        Ok(())
    }

    fn fill_aggregate(
        &self,
        expression: &Expression<'_>,
        components: &[Expression<'_>],
        place: PartMut<'_>,
        path: &Path<'_>,
    ) -> Result<(), Stop> {
        if let PartMut::Num(_) | PartMut::Whole(_) | PartMut::Bool(_) | PartMut::Text(_) = place {
            return Err(self.wrong_type(expression, &place, path, "an aggregate"));
        }
        let places = place.components();
        let wanted = places.iter().flatten().count();
        if wanted != components.len() {
            let (thing, part) = (self.thing(), path.to_string());
            let found = components.len();
            let kind = RapidFaultKind::ComponentCount { thing, part, found, wanted };
            return Err(self.fault(expression, kind));
        }
        for ((name, place), component) in places.into_iter().flatten().zip(components) {
            self.fill(component, place, &Path { name, of: Some(path) })?;
        }
        Ok(())
    }

    /// A sum, a product or a negated number.
    fn arithmetic(&self, expression: &Expression<'_>) -> Result<f64, Stop> {
        let result = match &expression.form {
            Form::Negated(operand) => -self.number(operand)?,
            Form::Chain(first, rest) => {
                let mut result = self.number(first)?;
                for (operator, operand) in rest {
                    let operand = self.number(operand)?;
                    match operator {
                        Operator::Plus => result += operand,
                        Operator::Minus => result -= operand,
                        Operator::Times => result *= operand,
                        Operator::Over => result /= operand,
                    }
                }
                result
            }
            _ => self.number(expression)?,
        };
        self.finite(expression, result)
    }

    pub(super) fn finite(&self, expression: &Expression<'_>, value: f64) -> Result<f64, Stop> {
        if value.is_finite() {
            return Ok(value);
        }
        Err(self
            .fault(expression, RapidFaultKind::NotFinite { text: written(self.text, expression) }))
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
