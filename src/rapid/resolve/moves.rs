//! Moves with the values of their arguments.

use alloc::string::{String, ToString};

use super::resolver::Resolver;
use crate::error::RapidFault;
use crate::rapid::data::module::{Routine, routine_name};
use crate::rapid::data::moves::{Argument, Move, MoveKind, Target};
use crate::rapid::data::value::Record;
use crate::rapid::expression::evaluate::{Evaluator, Stop};
use crate::rapid::expression::tree::Expression;
use crate::rapid::statements::moves::WrittenMove;

impl<'a> Resolver<'a> {
    /// An argument of a move, of a type.
    fn argument<T: Record>(
        &self,
        step: &WrittenMove<'a>,
        role: &'static str,
        expression: &Expression<'a>,
    ) -> Result<Argument<T>, RapidFault> {
        let evaluator = Evaluator {
            text: self.text,
            names: self,
            at: step.at,
            thing: (step.kind.name(), role),
            constant: false,
            at_move: true,
        };
        let value = match evaluator.record(expression) {
            Ok(value) => Ok(value),
            Err(Stop::Unknown(reason)) => Err(reason),
            Err(Stop::Fault(fault)) => return Err(fault),
        };
        Ok(Argument { text: self.source(expression), value })
    }

    fn source(&self, expression: &Expression<'_>) -> String {
        self.text.get(expression.start..expression.end).unwrap_or_default().to_string()
    }

    /// A move with the values of its arguments; `None` if their number is wrong.
    pub(super) fn step(
        &self,
        written: &mut WrittenMove<'a>,
        routines: &[Routine],
    ) -> Result<Option<Move>, RapidFault> {
        let options = core::mem::take(&mut written.options);
        let step = &*written;
        let (via, rest) = match (step.kind, step.required.split_first()) {
            (MoveKind::MoveC, Some((via, rest))) => {
                (Some(self.argument(step, "circle point", via)?), rest)
            }
            _ => (None, step.required.as_slice()),
        };
        let [target, speed, zone, tool] = rest else { return Ok(None) };
        let target = if step.kind == MoveKind::MoveAbsJ {
            let Argument { text, value } = self.argument(step, "target", target)?;
            Argument { text, value: value.map(Target::JointTarget) }
        } else {
            let Argument { text, value } = self.argument(step, "target", target)?;
            Argument { text, value: value.map(Target::RobTarget) }
        };
        Ok(Some(Move {
            kind: step.kind,
            routine: routine_name(routines, step.at.routine),
            line: step.line,
            column: step.column,
            via,
            target,
            speed: self.source(speed),
            zone: self.source(zone),
            tool: self.argument(step, "tool", tool)?,
            wobj: step
                .wobj
                .as_ref()
                .map(|wobj| self.argument(step, "work object", wobj))
                .transpose()?,
            options,
            displaced: step.displaced,
        }))
    }
}
