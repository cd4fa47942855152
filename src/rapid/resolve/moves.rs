//! Moves with the values of their arguments.

use alloc::string::{String, ToString};

use super::resolver::Resolver;
use crate::error::RapidFault;
use crate::rapid::data::module::{Routine, routine_name};
use crate::rapid::data::moves::{Argument, Move, MoveKind, Target};
use crate::rapid::data::records::{SpeedData, ZoneData};
use crate::rapid::data::types::Record;
use crate::rapid::data::unread::Reason;
use crate::rapid::expression::evaluate::{Evaluator, Stop};
use crate::rapid::expression::tree::Expression;
use crate::rapid::statements::moves::{Replacement, WrittenMove};

/// A value, or the reason why it is unknown.
type Known<T> = Result<T, Reason>;

impl<'a> Resolver<'a> {
    /// An argument of a move, of a type.
    fn argument<T: Record>(
        &self,
        step: &WrittenMove<'a>,
        role: &'static str,
        expression: &Expression<'a>,
    ) -> Result<Argument<T>, RapidFault> {
        let value = known(self.evaluator(step, role).record(expression))?;
        let span = expression.start..expression.end;
        Ok(Argument { text: self.source(expression), span, value })
    }

    /// The evaluator of an argument of a move.
    fn evaluator<'r>(&'r self, step: &WrittenMove<'a>, role: &'static str) -> Evaluator<'r, 'a> {
        Evaluator {
            text: self.text,
            names: self,
            at: step.at,
            thing: (step.kind.name(), role),
            constant: false,
            at_move: true,
        }
    }

    /// The number of an option, if the move has it.
    fn option(
        &self,
        step: &WrittenMove<'a>,
        role: &'static str,
        option: Option<&Replacement<'a>>,
    ) -> Result<Option<Result<f64, Reason>>, RapidFault> {
        match option {
            None => Ok(None),
            Some(Replacement::Nothing) => Ok(Some(Err(Reason::Unfinished))),
            Some(Replacement::Value(number)) => {
                known(self.evaluator(step, role).number(number)).map(Some)
            }
        }
    }

    /// The speed with `\V`, and the zone with `\Z`.
    fn speed_and_zone(
        &self,
        step: &WrittenMove<'a>,
        [speed, zone]: [&Expression<'a>; 2],
    ) -> Result<(Known<SpeedData>, Known<ZoneData>), RapidFault> {
        let mut speed = known(self.evaluator(step, "speed").record(speed))?;
        if let Some(velocity) = self.option(step, "\\V", step.overrides.velocity.as_ref())? {
            speed = speed
                .and_then(|speed| velocity.map(|v_tcp_mm_s| SpeedData { v_tcp_mm_s, ..speed }));
        }
        let mut zone = known(self.evaluator(step, "zone").record(zone))?;
        if let Some(radius) = self.option(step, "\\Z", step.overrides.zone.as_ref())? {
            zone =
                zone.and_then(|zone| radius.map(|pzone_tcp_mm| ZoneData { pzone_tcp_mm, ..zone }));
        }
        Ok((speed, zone))
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
            let Argument { text, span, value } = self.argument(step, "target", target)?;
            Argument { text, span, value: value.map(Target::JointTarget) }
        } else {
            let Argument { text, span, value } = self.argument(step, "target", target)?;
            Argument { text, span, value: value.map(Target::RobTarget) }
        };
        let (speed_data, zone_data) = self.speed_and_zone(step, [speed, zone])?;
        let time = self.option(step, "\\T", step.overrides.time.as_ref())?;
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
            speed_data,
            zone_data,
            time,
            settings: step.settings,
        }))
    }
}

/// A value, or the reason why it is unknown.
fn known<T>(value: Result<T, Stop>) -> Result<Known<T>, RapidFault> {
    match value {
        Ok(value) => Ok(Ok(value)),
        Err(Stop::Unknown(reason)) => Ok(Err(reason)),
        Err(Stop::Fault(fault)) => Err(fault),
    }
}
