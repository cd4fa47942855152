//! Moves with the values of their arguments.

use alloc::collections::BTreeMap;
use alloc::sync::Arc;

use super::resolver::Resolver;
use crate::prelude::*;
use crate::rapid::data::expression::{Arguments, Expression, Optional};
use crate::rapid::data::moves::{Argument, ExtraArgument, Move, MoveKind, MoveOption, Target};
use crate::rapid::data::moving::Places;
use crate::rapid::data::records::{SpeedData, ToolData, WobjData, ZoneData};
use crate::rapid::data::statement::{Instruction, Statement, StatementKind};
use crate::rapid::data::types::Record;
use crate::rapid::data::unread::Reason;
use crate::rapid::expression::evaluate::{Evaluator, Stop};
use crate::rapid::expression::names::At;
use crate::rapid::statements::moves::WrittenMove;
use crate::rapid::text::fault::RapidFault;
use crate::rapid::text::place::Place;

/// A value, or the reason why it is unknown.
type Known<T> = Result<T, Reason>;

/// Arguments of moves by their places and their texts: what is written the same there is the same.
type Shared<'a, T> = BTreeMap<(At, &'a str), Arc<Argument<T>>>;

/// What many moves have.
#[derive(Default)]
struct Sharing<'a> {
    names: BTreeMap<&'a str, Arc<str>>,
    speeds: Shared<'a, SpeedData>,
    zones: Shared<'a, ZoneData>,
    tools: Shared<'a, ToolData>,
    wobjs: Shared<'a, WobjData>,
}

impl<'a> Resolver<'a> {
    fn argument<T: Record>(
        &self,
        step: &WrittenMove<'a>,
        role: &'static str,
        expression: &Expression<'a>,
    ) -> Result<Argument<T>, RapidFault> {
        let value = known(self.evaluator(step, role).record(expression))?;
        Ok(Argument { text: self.source(expression).into(), value })
    }

    /// An argument that other moves may have, too.
    fn shared<T: Record>(
        &self,
        step: &WrittenMove<'a>,
        role: &'static str,
        expression: &Expression<'a>,
        shared: &mut Shared<'a, T>,
    ) -> Result<Arc<Argument<T>>, RapidFault> {
        let by = (step.at, self.source(expression));
        if let Some(known) = shared.get(&by) {
            return Ok(known.clone());
        }
        let argument = Arc::new(self.argument(step, role, expression)?);
        shared.insert(by, argument.clone());
        Ok(argument)
    }

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

    fn source(&self, expression: &Expression<'_>) -> &'a str {
        self.text.get(expression.start..expression.end).unwrap_or_default()
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
    ) -> Result<Vec<Move>, RapidFault> {
        let mut moves = Vec::with_capacity(written.len());
        let mut sharing = Sharing::default();
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
            let routine = statement.routine.clone();
            let made = if is_call { Ok(None) } else { self.step(step, routine, &mut sharing) };
            let kind = match made {
                Ok(Some(made)) => {
                    *place = moves.len();
                    moves.push(made);
                    step.arguments = Arguments::default();
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
        routine: Option<Arc<str>>,
        sharing: &mut Sharing<'a>,
    ) -> Result<Option<Move>, RapidFault> {
        let Some(places) = self.places(step) else { return Ok(None) };
        let Places { via, target, speed, zone, tool } = places;
        let [target, speed] = [target, speed].map(|place| step.arguments.required.get(place));
        let (Some(target), Some(speed)) = (target, speed) else { return Ok(None) };
        let [via, zone, tool] = [via, zone, tool].map(|place| step.arguments.required.get(place?));
        let way = step.instruction.way;
        let target_span = target.start..target.end;
        let target = if matches!(way, MoveKind::MoveAbsJ | MoveKind::MoveExtJ) {
            let Argument { text, value } = self.argument(step, "target", target)?;
            Argument { text, value: value.map(Target::JointTarget) }
        } else {
            let Argument { text, value } = self.argument(step, "target", target)?;
            Argument { text, value: value.map(Target::RobTarget) }
        };
        let Sharing { names, speeds, zones, tools, wobjs } = sharing;
        let speed = self.shared(step, "speed", speed, speeds)?;
        let velocity = self.option(step, "\\V")?;
        // Without a zone the target is met.
        let zone = match zone {
            Some(zone) => self.shared(step, "zone", zone, zones)?,
            None => Arc::new(Argument { text: "".into(), value: Ok(ZoneData::FINE) }),
        };
        let radius = self.option(step, "\\Z")?;
        let is_wobj = |it: &Optional<'_>| it.is("WObj") && it.value.is_some();
        let wobj = step.arguments.optional.iter().position(is_wobj);
        let options = step.arguments.optional.iter().enumerate();
        let options = options.filter(|(place, _)| Some(*place) != wobj).map(|(_, it)| MoveOption {
            after: it.after,
            name: it.name.to_string(),
            text: it.value.as_ref().map(|value| self.source(value).to_string()),
        });
        let wobj = step.arguments.value("WObj");
        let wobj = wobj.map(|it| self.shared(step, "work object", it, wobjs));
        let via = via.map(|via| self.argument(step, "circle point", via)).transpose()?;
        Ok(Some(Move {
            kind: way,
            instruction: names.entry(step.name).or_insert_with(|| step.name.into()).clone(),
            routine,
            line: step.line,
            column: step.column,
            via: via.map(Box::new),
            target,
            target_span,
            speed: with(speed, velocity, |it, v_tcp_mm_s| SpeedData { v_tcp_mm_s, ..it }),
            zone: with(zone, radius, |it, pzone_tcp_mm| ZoneData { pzone_tcp_mm, ..it }),
            tool: match tool {
                Some(tool) => self.shared(step, "tool", tool, tools)?,
                None => Arc::new(Argument { text: "".into(), value: Ok(ToolData::TOOL0) }),
            },
            wobj: wobj.transpose()?,
            options: options.collect(),
            extra: self.extra(step, places),
            displaced: step.displaced,
            time: self.option(step, "\\T")?.map(Box::new),
            settings: step.settings,
        }))
    }

    /// The required arguments that are at none of the places.
    fn extra(&self, step: &WrittenMove<'a>, places: Places) -> Vec<ExtraArgument> {
        let Places { via, target, speed, zone, tool } = places;
        let own = [via, Some(target), Some(speed), zone, tool];
        let all = step.arguments.required.iter().enumerate();
        let extra = all.filter(|(place, _)| !own.contains(&Some(*place)));
        let own = |(place, it)| ExtraArgument { place, text: self.source(it).to_string() };
        extra.map(own).collect()
    }
}

/// An argument with the number of an option, if the move has it.
fn with<T: Copy>(
    mut argument: Arc<Argument<T>>,
    number: Option<Known<f64>>,
    set: fn(T, f64) -> T,
) -> Arc<Argument<T>> {
    if let Some(number) = number {
        let own = Arc::make_mut(&mut argument);
        own.value = own.value.clone().and_then(|value| Ok(set(value, number?)));
    }
    argument
}

fn known<T>(value: Result<T, Stop>) -> Result<Known<T>, RapidFault> {
    match value {
        Ok(value) => Ok(Ok(value)),
        Err(Stop::Unknown(reason)) => Ok(Err(reason)),
        Err(Stop::Fault(fault)) => Err(fault),
    }
}
