//! Operators: arithmetic of numbers, vectors and rotations.

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use alloc::string::String;

use super::evaluate::{Component, Evaluator, Stop, whole};
use super::geometry::{cross, difference, product, scaled, sum};
use crate::rapid::data::expression::{Expression, Form, Operator};
use crate::rapid::data::types::{Atom, Atoms, ORIENT, POS, Shape};
use crate::rapid::data::unread::Reason;
use crate::rapid::text::fault::RapidFaultKind;

/// A value that operators take.
enum Quantity {
    Num(f64),
    Pos([f64; 3]),
    Orient([f64; 4]),
}

impl Evaluator<'_, '_> {
    /// Append the value of operators.
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

    /// Two numbers combined.
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
}
