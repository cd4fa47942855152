//! Evaluate expressions where a value of some type is expected.

use alloc::borrow::Cow;
use core::ops::Range;

use super::geometry::{cross, difference, product, scaled, sum};
use super::names::{At, Lookup, Names};
use crate::prelude::*;
use crate::rapid::data::expression::{Expression, Form, Name, Operator, written};
use crate::rapid::data::module::Content;
use crate::rapid::data::own_types::DEEPEST_TYPE;
use crate::rapid::data::types::{
    Atom, Atoms, LOADDATA, ORIENT, POS, Record, Shape, TOOLDATA, Type,
};
use crate::rapid::data::unread::{Reason, Unresolved};
use crate::rapid::data::value::{DataType, Value};
use crate::rapid::text::fault::{RapidFault, RapidFaultKind};
use crate::rapid::text::place::{Place, fault_at};
use crate::rapid::text::tokens::unquoted;

/// Why an expression has no value.
pub(crate) enum Stop {
    Fault(RapidFault),
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

    pub(crate) fn atoms(
        &self,
        expression: &Expression<'_>,
        of: &'static Type,
    ) -> Result<Atoms, Stop> {
        let mut atoms = Atoms::new();
        self.fill(expression, &Component { of, name: "", inside: None }, &mut atoms)?;
        Ok(atoms)
    }

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

    fn fill(
        &self,
        expression: &Expression<'_>,
        place: &Component<'_>,
        atoms: &mut Atoms,
    ) -> Result<(), Stop> {
        let wrong = |found| Err(self.wrong_type(expression, place, found));
        match (&expression.form, &place.of.shape) {
            (Form::Number(value), _) => self.fill_number(expression, *value, place, atoms)?,
            (Form::Bool(value), Shape::Bool) => atoms.push(Atom::Bool(*value)),
            (Form::Bool(value), _) => return wrong(if *value { "TRUE" } else { "FALSE" }),
            (Form::Text(text), Shape::Text) => atoms.push(Atom::Text(unquoted(text))),
            (Form::Text(_), _) => return wrong("a string"),
            (Form::Aggregate(parts), Shape::Record(components)) => {
                self.fill_aggregate(expression, (parts, components), place, atoms)?;
            }
            (Form::Aggregate(_), _) => return wrong("an aggregate"),
            (Form::Value(value), _) => atoms.extend(value.atoms()),
            (Form::Name(_) | Form::Reference(_), _) => {
                self.fill_reference(expression, place, atoms)?;
            }
            (Form::Call(call), _) => self.fill_call(expression, call, place, atoms)?,
            (Form::Negated(_) | Form::Chain(..), _) => {
                self.fill_operators(expression, place, atoms)?;
            }
            (Form::Not(_), _) => return Err(Reason::Negation.into()),
            (Form::Compared(..), _) => return Err(Reason::Operator.into()),
            (Form::Star, _) => return Err(Reason::Taught.into()),
            (Form::Unread(reason, _), _) => return Err(Reason::clone(reason).into()),
        }
        Ok(())
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

/// A value that operators take.
enum Quantity {
    Num(f64),
    Pos([f64; 3]),
    Orient([f64; 4]),
}

impl Evaluator<'_, '_> {
    pub(super) fn fill_operators(
        &self,
        expression: &Expression<'_>,
        place: &Component<'_>,
        atoms: &mut Atoms,
    ) -> Result<(), Stop> {
        if let Shape::Num | Shape::Whole = place.of.shape {
            return self.fill_number(expression, self.arithmetic(expression)?, place, atoms);
        }
        if ![POS.name, ORIENT.name].contains(&place.of.name) {
            return Err(Reason::Arithmetic { type_name: place.of.name }.into());
        }
        let wrong = |found| Err(self.wrong_type(expression, place, found));
        let quantity = self.quantity(expression)?;
        let numbers: &[f64] = match &quantity {
            Quantity::Pos(vector) if place.of.name == POS.name => vector,
            Quantity::Orient(rot) if place.of.name == ORIENT.name => rot,
            Quantity::Num(_) => return wrong("a number"),
            Quantity::Pos(_) => return wrong("a pos"),
            Quantity::Orient(_) => return wrong("an orient"),
        };
        for number in numbers {
            atoms.push(Atom::Num(self.finite(expression, *number)? + 0.0));
        }
        Ok(())
    }

    /// A sum, a product or a negated number.
    fn arithmetic(&self, expression: &Expression<'_>) -> Result<f64, Stop> {
        let result = match &expression.form {
            Form::Negated(operand) => -self.record::<f64>(operand)?,
            Form::Chain(first, rest) => {
                let mut result = self.record(first)?;
                for (operator, operand) in rest {
                    result = self.combined(expression, result, *operator, self.record(operand)?)?;
                }
                result
            }
            _ => self.record(expression)?,
        };
        self.finite(expression, result)
    }

    fn combined(
        &self,
        expression: &Expression<'_>,
        a: f64,
        operator: Operator,
        b: f64,
    ) -> Result<f64, Stop> {
        Ok(match operator {
            Operator::Plus => a + b,
            Operator::Minus => a - b,
            Operator::Times => a * b,
            Operator::Over => a / b,
            Operator::Div | Operator::Mod => {
                for value in [a, b] {
                    if whole(value).is_none() {
                        let (thing, part) = (self.thing(), String::new());
                        let kind = RapidFaultKind::NotWhole { thing, part, value };
                        return Err(self.fault(expression, kind));
                    }
                }
                // The manual has no rule for negative numbers.
                if a < 0.0 || b < 0.0 {
                    return Err(Reason::Operator.into());
                }
                if operator == Operator::Div { (a / b).trunc() } else { a % b }
            }
        })
    }

    /// A value of the type that an expression has.
    fn quantity(&self, expression: &Expression<'_>) -> Result<Quantity, Stop> {
        let no_arithmetic = |type_name| Err(Reason::Arithmetic { type_name }.into());
        match &expression.form {
            Form::Aggregate(parts) if parts.len() == 3 => {
                self.record(expression).map(Quantity::Pos)
            }
            Form::Aggregate(_) => self.record(expression).map(Quantity::Orient),
            Form::Negated(operand) => match self.quantity(operand)? {
                Quantity::Num(number) => Ok(Quantity::Num(-number)),
                Quantity::Pos(vector) => Ok(Quantity::Pos(scaled(vector, -1.0))),
                Quantity::Orient(_) => no_arithmetic(ORIENT.name),
            },
            Form::Chain(first, rest) => {
                let mut result = self.quantity(first)?;
                for (operator, operand) in rest {
                    let operand = self.quantity(operand)?;
                    result = self.joined(expression, result, *operator, operand)?;
                }
                Ok(result)
            }
            _ => match self.type_name(expression).as_deref() {
                Some("pos") => self.record(expression).map(Quantity::Pos),
                Some("orient") => self.record(expression).map(Quantity::Orient),
                _ => self.record(expression).map(Quantity::Num),
            },
        }
    }

    /// Two values combined, by the table of operators of the RAPID reference manual.
    fn joined(
        &self,
        expression: &Expression<'_>,
        a: Quantity,
        operator: Operator,
        b: Quantity,
    ) -> Result<Quantity, Stop> {
        use Quantity::{Num, Orient, Pos};
        Ok(match (a, operator, b) {
            (Num(a), _, Num(b)) => Num(self.combined(expression, a, operator, b)?),
            (Pos(a), Operator::Plus, Pos(b)) => Pos(sum(a, b)),
            (Pos(a), Operator::Minus, Pos(b)) => Pos(difference(a, b)),
            (Pos(a), Operator::Times, Pos(b)) => Pos(cross(a, b)),
            (Num(a), Operator::Times, Pos(b)) => Pos(scaled(b, a)),
            (Pos(a), Operator::Times, Num(b)) => Pos(scaled(a, b)),
            (Orient(a), Operator::Times, Orient(b)) => Orient(product(a, b)),
            (Orient(_), ..) | (.., Orient(_)) => {
                return Err(Reason::Arithmetic { type_name: ORIENT.name }.into());
            }
            _ => return Err(Reason::Arithmetic { type_name: POS.name }.into()),
        })
    }

    pub(super) fn fill_reference(
        &self,
        expression: &Expression<'_>,
        place: &Component<'_>,
        atoms: &mut Atoms,
    ) -> Result<(), Stop> {
        let Some((name, indices, components)) = expression.reference() else { return Ok(()) };
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
        match &expression.form {
            Form::Number(_) => return Some("num".to_string()),
            Form::Text(_) => return Some("string".to_string()),
            Form::Bool(_) => return Some("bool".to_string()),
            Form::Call(call) => {
                let result = self.function(&call.name).ok()?.result;
                let (of, _) = self.part(expression, result, &call.components).ok()?;
                return Some(of.name.to_string());
            }
            _ => {}
        }
        let (name, _, components) = expression.reference()?;
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
