//! What an expression is worth, where a value of some type must stand.

use alloc::format;
use alloc::string::{String, ToString};

use super::displaced::{Displacement, displaced};
use super::expression::{Call, Expression, Form, Operator, Reference, written};
use super::kind::{DataType, Kind, Scalars};
use super::module::Content;
use super::resolve::{Found, Resolver};
use super::tokens::fault_at;
use super::values::{RobTarget, Value};
use crate::error::{RapidFault, RapidFaultKind};

/// Why an expression has no value.
pub(super) enum Stop {
    /// The text is broken.
    Fault(RapidFault),
    /// It is not known, in words.
    Unknown(String),
}

impl From<RapidFault> for Stop {
    fn from(fault: RapidFault) -> Self {
        Self::Fault(fault)
    }
}

/// Where an expression stands.
#[derive(Clone, Copy)]
pub(super) struct Evaluator<'r, 'a> {
    pub(super) resolver: &'r Resolver<'a>,
    /// Index of the routine, from 1; 0 for the module.
    pub(super) routine: usize,
    /// The innermost loop around it.
    pub(super) inside_loop: Option<usize>,
    /// The thing for messages: "robtarget" and "p10", or "MoveL" and "tool".
    pub(super) thing: (&'static str, &'a str),
    /// Whether only what never changes may be referred to: sizes and indices.
    pub(super) constant: bool,
    /// Whether it counts what the program assigns: where it moves.
    pub(super) at_move: bool,
}

/// A component of a thing, for messages.
#[derive(Clone, Copy)]
struct Part<'p> {
    name: &'static str,
    of: Option<&'p Part<'p>>,
}

impl Part<'_> {
    fn path(&self) -> String {
        match self.of {
            Some(above) if !above.name.is_empty() => format!("{}.{}", above.path(), self.name),
            _ => self.name.to_string(),
        }
    }
}

const WHOLE_THING: Part<'_> = Part { name: "", of: None };

impl Evaluator<'_, '_> {
    /// The value of a type.
    pub(super) fn value(
        &self,
        expression: &Expression<'_>,
        data_type: DataType,
    ) -> Result<Value, Stop> {
        let scalars = self.scalars(expression, Kind::from(data_type))?;
        Ok(Value::from_scalars(data_type, &scalars))
    }

    pub(super) fn scalars(&self, expression: &Expression<'_>, kind: Kind) -> Result<Scalars, Stop> {
        let mut scalars = Scalars::new();
        self.fill(expression, kind, &WHOLE_THING, &mut scalars)?;
        Ok(scalars)
    }

    /// A number.
    pub(super) fn number(&self, expression: &Expression<'_>) -> Result<f64, Stop> {
        Ok(self.scalars(expression, Kind::Num)?.at::<1>(0)[0])
    }

    /// The thing's name for a message.
    pub(super) fn thing(&self) -> String {
        format!("{} {}", self.thing.0, self.thing.1)
    }

    pub(super) fn fault(&self, expression: &Expression<'_>, kind: RapidFaultKind) -> Stop {
        Stop::Fault(fault_at(self.resolver.text, expression.start, kind))
    }

    fn wrong_type(
        &self,
        expression: &Expression<'_>,
        kind: Kind,
        part: &Part<'_>,
        found: &str,
    ) -> Stop {
        let (thing, part) = (self.thing(), part.path());
        self.fault(
            expression,
            RapidFaultKind::ComponentType {
                thing,
                part,
                found: found.to_string(),
                wanted: kind.wanted(),
            },
        )
    }

    fn fill(
        &self,
        expression: &Expression<'_>,
        kind: Kind,
        part: &Part<'_>,
        scalars: &mut Scalars,
    ) -> Result<(), Stop> {
        match &expression.form {
            Form::Number(value) => match kind {
                Kind::Num => scalars.push(*value),
                Kind::Whole => scalars.push(self.whole(expression, part, *value)?),
                _ => return Err(self.wrong_type(expression, kind, part, "a number")),
            },
            Form::Bool(value) => match kind {
                Kind::Bool => scalars.push(f64::from(u8::from(*value))),
                _ => {
                    return Err(self.wrong_type(
                        expression,
                        kind,
                        part,
                        if *value { "TRUE" } else { "FALSE" },
                    ));
                }
            },
            Form::Text(text) => match kind {
                Kind::Text => scalars.text = unquoted(text),
                _ => return Err(self.wrong_type(expression, kind, part, "a string")),
            },
            Form::Aggregate(components) => {
                self.fill_aggregate(expression, components, kind, part, scalars)?
            }
            Form::Reference(reference) => {
                self.fill_reference(expression, reference, kind, part, scalars)?
            }
            Form::Call(call) => self.fill_call(expression, call, kind, part, scalars)?,
            Form::Negated(_) | Form::Chain(..) => match kind {
                Kind::Num => scalars.push(self.arithmetic(expression)?),
                Kind::Whole => {
                    scalars.push(self.whole(expression, part, self.arithmetic(expression)?)?)
                }
                _ => {
                    return Err(Stop::Unknown(format!(
                        "arithmetic of {} is not calculated",
                        kind.name()
                    )));
                }
            },
            Form::Star => {
                return Err(Stop::Unknown(
                    "* is taught on the controller, its value is not in the text".to_string(),
                ));
            }
            Form::Unread(what) => return Err(Stop::Unknown((*what).to_string())),
        }
        Ok(())
    }

    fn whole(&self, expression: &Expression<'_>, part: &Part<'_>, value: f64) -> Result<f64, Stop> {
        #[expect(clippy::cast_possible_truncation, reason = "what is lost shows")]
        let is_whole = value - f64::from(value as i32) == 0.0;
        if is_whole {
            return Ok(value);
        }
        Err(self.fault(
            expression,
            RapidFaultKind::NotWhole { thing: self.thing(), part: part.path(), value },
        ))
    }

    fn fill_aggregate(
        &self,
        expression: &Expression<'_>,
        components: &[Expression<'_>],
        kind: Kind,
        part: &Part<'_>,
        scalars: &mut Scalars,
    ) -> Result<(), Stop> {
        let table = kind.components();
        if table.is_empty() {
            return Err(self.wrong_type(expression, kind, part, "an aggregate"));
        }
        if table.len() != components.len() {
            let (thing, part) = (self.thing(), part.path());
            let kind = RapidFaultKind::ComponentCount {
                thing,
                part,
                found: components.len(),
                wanted: table.len(),
            };
            return Err(self.fault(expression, kind));
        }
        for ((name, kind), component) in table.iter().zip(components) {
            self.fill(component, *kind, &Part { name, of: Some(part) }, scalars)?;
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

    fn finite(&self, expression: &Expression<'_>, value: f64) -> Result<f64, Stop> {
        if value.is_finite() {
            return Ok(value);
        }
        Err(self.fault(
            expression,
            RapidFaultKind::NotFinite { text: written(self.resolver.text, expression) },
        ))
    }

    fn fill_reference(
        &self,
        expression: &Expression<'_>,
        reference: &Reference<'_>,
        wanted: Kind,
        part: &Part<'_>,
        scalars: &mut Scalars,
    ) -> Result<(), Stop> {
        let text = || written(self.resolver.text, expression);
        let (whole, mut kind) = self.referred(expression, reference)?;
        let mut from = 0;
        for component in &reference.components {
            let Some((before, inner)) = kind.component(component) else {
                let fault = RapidFaultKind::NoSuchComponent {
                    text: text(),
                    of: kind.name(),
                    component: (*component).to_string(),
                };
                return Err(self.fault(expression, fault));
            };
            from += before;
            kind = inner;
        }
        if !wanted.takes(kind) {
            return Err(self.wrong_type(
                expression,
                wanted,
                part,
                &format!("{}, of type {}", text(), kind.name()),
            ));
        }
        for number in &whole.numbers()[from..from + kind.width()] {
            scalars.push(if wanted == Kind::Whole {
                self.whole(expression, part, *number)?
            } else {
                *number
            });
        }
        if matches!(kind, Kind::Text | Kind::WobjData) {
            scalars.text = whole.text;
        }
        Ok(())
    }

    /// The datum or the element that a reference begins with.
    fn referred(
        &self,
        expression: &Expression<'_>,
        reference: &Reference<'_>,
    ) -> Result<(Scalars, Kind), Stop> {
        let name = reference.name;
        let unknown = |why: &str| Stop::Unknown(format!("refers to {name}, {why}"));
        let count = |wanted| {
            let (text, found) = (written(self.resolver.text, expression), reference.indices.len());
            self.fault(expression, RapidFaultKind::IndexCount { text, found, wanted })
        };
        let value = match self.resolver.find(self.routine, self.inside_loop, name) {
            Found::NotHere => return Err(unknown("which is not in this module")),
            Found::Unknown(why) => return Err(unknown(&why)),
            Found::Predefined(_) if !reference.indices.is_empty() => return Err(count(0)),
            Found::Predefined(value) => {
                return Ok((value.scalars(), Kind::from(value.data_type())));
            }
            Found::Datum { can_change: true, .. } if self.constant => {
                return Err(unknown("which can change"));
            }
            Found::Datum { cause: Some(cause), .. } if self.at_move => {
                return Err(unknown(&cause.words(name)));
            }
            Found::Datum { content: Content::Uninitialised { .. }, .. } => {
                return Err(unknown("whose declaration has no value"));
            }
            Found::Datum { content: Content::Single(_), .. } if !reference.indices.is_empty() => {
                return Err(count(0));
            }
            Found::Datum { content: Content::Single(value), .. } => value,
            Found::Datum { content: Content::Array { .. }, .. } if reference.indices.is_empty() => {
                return Err(unknown("which is a whole array"));
            }
            Found::Datum { content: Content::Array { sizes, .. }, .. }
                if sizes.len() != reference.indices.len() =>
            {
                return Err(count(sizes.len()));
            }
            Found::Datum { content: Content::Array { sizes, values }, .. } => {
                let element = self.element(reference, sizes)?;
                values.get(element).ok_or_else(|| unknown("which has no such element"))?
            }
        };
        Ok((value.scalars(), Kind::from(value.data_type())))
    }

    /// The place of an element in its array.
    fn element(&self, reference: &Reference<'_>, sizes: &[usize]) -> Result<usize, Stop> {
        let constant = Self { constant: true, ..*self };
        let mut element = 0;
        for (index, size) in reference.indices.iter().zip(sizes) {
            let value = constant.number(index)?;
            let Some(from_one) = positive_whole(value).filter(|from_one| from_one <= size) else {
                let text = format!("{}{{{}}}", reference.name, written(self.resolver.text, index));
                return Err(self.fault(index, RapidFaultKind::Index { text, value, size: *size }));
            };
            element = element * size + from_one - 1;
        }
        Ok(element)
    }

    fn fill_call(
        &self,
        expression: &Expression<'_>,
        call: &Call<'_>,
        kind: Kind,
        part: &Part<'_>,
        scalars: &mut Scalars,
    ) -> Result<(), Stop> {
        let Some(function) = Displacement::named(call.name) else {
            return Err(Stop::Unknown(format!("{} is not calculated", call.name)));
        };
        // A routine or a datum may have taken the name.
        if !matches!(self.resolver.find(self.routine, self.inside_loop, call.name), Found::NotHere)
        {
            return Err(Stop::Unknown(format!(
                "{} is declared in this module, it is not calculated",
                call.name
            )));
        }
        if kind != Kind::RobTarget {
            return Err(self.wrong_type(
                expression,
                kind,
                part,
                &format!("{}, of type robtarget", function.name()),
            ));
        }
        let [point, x, y, z] = call.required.as_slice() else {
            let (instruction, found) = (function.name(), call.required.len());
            return Err(self.fault(
                expression,
                RapidFaultKind::ArgumentCount { instruction, found, wanted: 4 },
            ));
        };
        let mut target = RobTarget::from_scalars(&self.scalars(point, Kind::RobTarget)?);
        let shift = [self.number(x)?, self.number(y)?, self.number(z)?];
        let mut turns = [0.0; 3];
        for (name, value) in &call.optional {
            let axis = ["Rx", "Ry", "Rz"].iter().position(|axis| axis.eq_ignore_ascii_case(name));
            match (function, axis, value) {
                (Displacement::RelTool, Some(axis), Some(angle)) => {
                    turns[axis] = self.number(angle)?
                }
                _ => {
                    return Err(Stop::Unknown(format!(
                        "{} with {name} is not calculated",
                        call.name
                    )));
                }
            }
        }
        target = displaced(function, &target, shift, turns);
        for number in Value::RobTarget(target).scalars().numbers() {
            scalars.push(self.finite(expression, *number)?);
        }
        Ok(())
    }
}

/// A positive whole number as a size or an index.
pub(super) fn positive_whole(value: f64) -> Option<usize> {
    /// Whole numbers above are not told apart.
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

/// A string without its quotes: "" is a quote, \\ a backslash and \ with two hexadecimal digits the character of that number.
fn unquoted(quoted: &str) -> String {
    let inner = quoted.get(1..quoted.len().saturating_sub(1)).unwrap_or_default();
    let mut text = String::new();
    let mut rest = inner;
    while let Some(character) = rest.chars().next() {
        let mut taken = character.len_utf8();
        let mut meant = character;
        let code = rest.get(1..3).filter(|code| code.bytes().all(|byte| byte.is_ascii_hexdigit()));
        match (character, code) {
            ('"', _) => taken = 2,
            ('\\', _) if rest[1..].starts_with('\\') => taken = 2,
            ('\\', Some(code)) => {
                meant = u8::from_str_radix(code, 16).map_or(character, char::from);
                taken = 3;
            }
            _ => {}
        }
        text.push(meant);
        rest = rest.get(taken..).unwrap_or_default();
    }
    text
}
