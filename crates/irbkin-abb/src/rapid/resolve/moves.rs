//! Moves with the values of their arguments.

use alloc::boxed::Box;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::resolver::Resolver;
use crate::rapid::data::expression::{Expression, Optional};
use crate::rapid::data::module::{Routine, routine_name};
use crate::rapid::data::moves::{Argument, ExtraArgument, Move, MoveKind, MoveOption, Target};
use crate::rapid::data::moving::Places;
use crate::rapid::data::records::{SpeedData, ToolData, ZoneData};
use crate::rapid::data::statement::{Instruction, Statement, StatementKind};
use crate::rapid::data::types::Record;
use crate::rapid::data::unread::Reason;
use crate::rapid::expression::evaluate::{Evaluator, Stop};
use crate::rapid::statements::moves::WrittenMove;
use crate::rapid::text::fault::RapidFault;
use crate::rapid::text::place::Place;

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
            thing: (step.instruction.name, role),
            constant: false,
            at_move: true,
            near: Place { byte: step.start, line: step.line, column: step.column },
        }
    }

    /// The number of an option, with its backslash, if the move has it.
    fn option(
        &self,
        step: &WrittenMove<'a>,
        role: &'static str,
    ) -> Result<Option<Known<f64>>, RapidFault> {
        let option = step.arguments.optional.iter().find(|it| it.is(&role[1..]));
        match option.map(|it| &it.value) {
            None => Ok(None),
            Some(None) => Ok(Some(Err(Reason::Unfinished))),
            Some(Some(number)) => known(self.evaluator(step, role).record(number)).map(Some),
        }
    }

    /// The speed with `\V`.
    fn speed(
        &self,
        step: &WrittenMove<'a>,
        speed: &Expression<'a>,
    ) -> Result<Known<SpeedData>, RapidFault> {
        let speed: Known<SpeedData> = known(self.evaluator(step, "speed").record(speed))?;
        let velocity = self.option(step, "\\V")?;
        Ok(match velocity {
            None => speed,
            Some(velocity) => {
                speed.and_then(|speed| velocity.map(|v_tcp_mm_s| SpeedData { v_tcp_mm_s, ..speed }))
            }
        })
    }

    /// The zone with `\Z`; without one the target is met.
    fn zone(
        &self,
        step: &WrittenMove<'a>,
        zone: Option<&Expression<'a>>,
    ) -> Result<Known<ZoneData>, RapidFault> {
        let zone: Known<ZoneData> = match zone {
            None => Ok(ZoneData::FINE),
            Some(zone) => known(self.evaluator(step, "zone").record(zone))?,
        };
        let radius = self.option(step, "\\Z")?;
        Ok(match radius {
            None => zone,
            Some(radius) => {
                zone.and_then(|zone| radius.map(|pzone_tcp_mm| ZoneData { pzone_tcp_mm, ..zone }))
            }
        })
    }

    fn source(&self, expression: &Expression<'_>) -> String {
        self.text.get(expression.start..expression.end).unwrap_or_default().to_string()
    }

    /// The places of the arguments of a move; `None` if they are of another instruction.
    fn places(&self, step: &WrittenMove<'a>) -> Option<Places> {
        let evaluator = self.evaluator(step, "");
        let is_basic = step.instruction.is_basic();
        let type_of = |it: &Expression<'a>| if is_basic { None } else { evaluator.type_name(it) };
        let types: Vec<Option<String>> = step.arguments.required.iter().map(type_of).collect();
        let types: Vec<Option<&str>> = types.iter().map(Option::as_deref).collect();
        step.instruction.places(&types)
    }

    /// The moves with the values of their arguments. The others are calls of routines that have the
    /// name of an instruction, and instructions with arguments of another form.
    pub(super) fn moves(
        &mut self,
        written: &mut [WrittenMove<'a>],
        statements: &mut [Statement],
        routines: &[Routine],
    ) -> Result<Vec<Move>, RapidFault> {
        let mut moves = Vec::with_capacity(written.len());
        for (index, statement) in statements.iter_mut().enumerate() {
            self.faults.interrupt.check(index)?;
            let place = match &mut statement.kind {
                StatementKind::Instruction(it) => {
                    it.is_motion = it.is_motion && !self.is_routine(&it.word);
                    continue;
                }
                StatementKind::Move(place) => place,
                _ => continue,
            };
            let Some(step) = written.get_mut(*place) else { continue };
            // A routine may have the name of an instruction.
            let is_call = !step.instruction.is_basic() && self.is_routine(step.name);
            let made = if is_call { Ok(None) } else { self.step(step, routines) };
            let kind = match made {
                Ok(Some(made)) => {
                    *place = moves.len();
                    moves.push(made);
                    continue;
                }
                Ok(None) => {
                    let arguments = core::mem::take(&mut step.arguments).owned(step.start);
                    let instruction = Instruction::new(step.name, Some(step.name), arguments);
                    let is_motion = !is_call;
                    StatementKind::Instruction(Box::new(Instruction { is_motion, ..instruction }))
                }
                Err(fault) => {
                    let words = fault.kind.to_string();
                    self.faults.add(fault)?;
                    StatementKind::Invalid { statement: step.name.to_string(), fault: words }
                }
            };
            statement.kind = kind;
            statement.text = self.text[step.start..step.end].to_string();
        }
        Ok(moves)
    }

    /// A move with the values of its arguments; `None` if they are of another instruction.
    fn step(
        &self,
        step: &WrittenMove<'a>,
        routines: &[Routine],
    ) -> Result<Option<Move>, RapidFault> {
        let Some(places) = self.places(step) else { return Ok(None) };
        let Places { via, target, speed, zone, tool } = places;
        let [target, speed] = [target, speed].map(|place| step.arguments.required.get(place));
        let (Some(target), Some(speed)) = (target, speed) else { return Ok(None) };
        let [via, zone, tool] = [via, zone, tool].map(|place| step.arguments.required.get(place?));
        let way = step.instruction.way;
        let target = if matches!(way, MoveKind::MoveAbsJ | MoveKind::MoveExtJ) {
            let Argument { text, span, value } = self.argument(step, "target", target)?;
            Argument { text, span, value: value.map(Target::JointTarget) }
        } else {
            let Argument { text, span, value } = self.argument(step, "target", target)?;
            Argument { text, span, value: value.map(Target::RobTarget) }
        };
        let no_tool = Argument { text: String::new(), span: 0..0, value: Ok(ToolData::TOOL0) };
        let is_wobj = |it: &Optional<'_>| it.is("WObj") && it.value.is_some();
        let wobj = step.arguments.optional.iter().position(is_wobj);
        let options = step.arguments.optional.iter().enumerate();
        let options = options.filter(|(place, _)| Some(*place) != wobj).map(|(_, it)| MoveOption {
            after: it.after,
            name: it.name.to_string(),
            text: it.value.as_ref().map(|value| self.source(value)),
        });
        let wobj = step.arguments.value("WObj").map(|it| self.argument(step, "work object", it));
        Ok(Some(Move {
            kind: way,
            instruction: step.name.to_string(),
            routine: routine_name(routines, step.at.routine),
            line: step.line,
            column: step.column,
            via: via.map(|via| self.argument(step, "circle point", via)).transpose()?,
            target,
            speed: self.source(speed),
            zone: zone.map(|zone| self.source(zone)).unwrap_or_default(),
            tool: match tool {
                Some(tool) => self.argument(step, "tool", tool)?,
                None => no_tool,
            },
            wobj: wobj.transpose()?,
            options: options.collect(),
            extra: self.extra(step, places),
            displaced: step.displaced,
            speed_data: self.speed(step, speed)?,
            zone_data: self.zone(step, zone)?,
            time: self.option(step, "\\T")?,
            settings: step.settings,
        }))
    }

    /// The required arguments that are at none of the places.
    fn extra(&self, step: &WrittenMove<'a>, places: Places) -> Vec<ExtraArgument> {
        let Places { via, target, speed, zone, tool } = places;
        let own = [via, Some(target), Some(speed), zone, tool];
        let all = step.arguments.required.iter().enumerate();
        let extra = all.filter(|(place, _)| !own.contains(&Some(*place)));
        extra.map(|(place, it)| ExtraArgument { place, text: self.source(it) }).collect()
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
