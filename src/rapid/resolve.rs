//! From names to values: data after those that they refer to, then the moves.

use alloc::boxed::Box;
use alloc::collections::BTreeMap;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec;
use alloc::vec::Vec;
use core::ops::Range;

use super::assigned::{Cause, Causes, found_elsewhere};
use super::blocks::Blocks;
use super::declarations::{Declared, Named, Placed, Scopes};
use super::evaluate::{Evaluator, Stop, positive_whole};
use super::expression::{Expression, Form};
use super::kind::DataType;
use super::module::{Content, Datum, Module, Routine, Skipped, Storage};
use super::moves::{Argument, Move, MoveKind, Target, WrittenMove};
use super::statements::Written;
use super::tokens::fault_at;
use super::values::{LoadData, Record, ToolData, Value, WobjData};
use crate::error::{Names, RapidFault, RapidFaultKind};

/// Most dimensions of an array.
const MOST_DIMENSIONS: usize = 3;

/// What a name stands for, where it is used.
pub(super) enum Found<'r> {
    Datum {
        content: &'r Content,
        can_change: bool,
        /// Why it need not hold that where the program moves.
        cause: Option<Cause<'r>>,
    },
    Predefined(Value),
    /// Nothing declares it.
    NotHere,
    /// Why it has no value.
    Unknown(String),
}

/// Looks names up.
pub(super) struct Resolver<'a> {
    pub(super) text: &'a str,
    declared: &'a [Declared<'a>],
    scopes: &'a Scopes,
    blocks: &'a Blocks<'a>,
    context: &'a [&'a Module],
    /// What is known of each datum so far.
    contents: Vec<Option<Placed>>,
    /// Why data are not known.
    reasons: BTreeMap<usize, String>,
    /// Why data are not known where the program moves.
    causes: Causes<'a>,
}

impl<'a> Resolver<'a> {
    /// What a name stands for in a routine and a loop of it.
    pub(super) fn find(&self, routine: usize, inside_loop: Option<usize>, name: &str) -> Found<'_> {
        let lower = name.to_lowercase();
        if self.blocks.is_variable(inside_loop, &lower) {
            return Found::Unknown("the variable of a loop".to_string());
        }
        match self.scopes.find(routine, &lower) {
            Some(Named::Other(what)) => return Found::Unknown(what.clone()),
            Some(Named::Datum(index)) => {
                let can_change = self
                    .declared
                    .get(*index)
                    .is_none_or(|declared| declared.storage != Storage::Const);
                return match self.contents.get(*index) {
                    Some(Some((content, ..))) => {
                        Found::Datum { content, can_change, cause: self.causes.of_datum(*index) }
                    }
                    _ => Found::Unknown("whose value is not known".to_string()),
                };
            }
            None => {}
        }
        if let Some(value) = predefined(&lower) {
            return Found::Predefined(value);
        }
        match found_elsewhere(&lower, self.context) {
            Some((datum, home)) => {
                let cause = self.causes.of_other(&lower, home, self.context);
                Found::Datum {
                    content: &datum.content,
                    can_change: datum.storage != Storage::Const,
                    cause,
                }
            }
            None => Found::NotHere,
        }
    }

    /// Resolves every datum, each after those that it refers to, without recursion.
    fn resolve_all(&mut self) -> Result<(), RapidFault> {
        let mut state = vec![State::New; self.declared.len()];
        // A datum with the number of its names that were gone through.
        let mut open: Vec<(usize, usize)> = Vec::new();
        for datum in 0..self.declared.len() {
            if state[datum] == State::New {
                state[datum] = State::Open;
                open.push((datum, 0));
            }
            while let Some((current, gone_through)) = open.last_mut() {
                let current = *current;
                let declared = &self.declared[current];
                let Some(name) = declared.names.get(*gone_through) else {
                    self.resolve(current)?;
                    state[current] = State::Done;
                    open.pop();
                    // What refers to it changes with it.
                    if let Some((above, gone_through)) = open.last() {
                        self.add_cause(*above, *gone_through, current);
                    }
                    continue;
                };
                *gone_through += 1;
                let gone_through = *gone_through;
                let lower = name.to_lowercase();
                let other = match self.scopes.find(declared.routine, &lower) {
                    Some(Named::Datum(other)) => other,
                    Some(Named::Other(_)) => continue,
                    None => {
                        if gone_through > declared.size_names {
                            self.add_cause_elsewhere(current, &lower);
                        }
                        continue;
                    }
                };
                match state[*other] {
                    State::New => {
                        state[*other] = State::Open;
                        open.push((*other, 0));
                    }
                    State::Open => return Err(self.circle(&open, *other)),
                    State::Done => self.add_cause(current, gone_through, *other),
                }
            }
        }
        Ok(())
    }

    /// Notes that a datum changes with what a name of it stands for; sizes, the names that come first, do not change.
    fn add_cause(&mut self, datum: usize, gone_through: usize, other: usize) {
        if let Some(cause) =
            self.causes.of_datum(other).filter(|_| gone_through > self.declared[datum].size_names)
        {
            self.causes.add(datum, cause);
        }
    }

    /// Notes that a datum changes with one of another module, where that does.
    fn add_cause_elsewhere(&mut self, datum: usize, lower: &str) {
        let found = found_elsewhere(lower, self.context).filter(|_| predefined(lower).is_none());
        if let Some(cause) =
            found.and_then(|(_, home)| self.causes.of_other(lower, home, self.context))
        {
            self.causes.add(datum, cause);
        }
    }

    fn circle(&self, open: &[(usize, usize)], again: usize) -> RapidFault {
        let from = open.iter().position(|(datum, _)| *datum == again).unwrap_or(0);
        let circle = open[from..].iter().map(|(datum, _)| *datum).chain([again]);
        let names: Names = circle.map(|datum| self.declared[datum].name).collect();
        fault_at(self.text, self.declared[again].start, RapidFaultKind::Circular { names })
    }

    fn resolve(&mut self, index: usize) -> Result<(), RapidFault> {
        if self.contents[index].is_some() {
            return Ok(());
        }
        match self.content(&self.declared[index]) {
            Ok(placed) => self.contents[index] = Some(placed),
            Err(Stop::Fault(fault)) => return Err(fault),
            Err(Stop::Unknown(why)) => {
                self.reasons.insert(index, why);
            }
        }
        Ok(())
    }

    fn evaluator(&self, declared: &Declared<'a>) -> Evaluator<'_, 'a> {
        let thing = (declared.data_type.name(), declared.name);
        Evaluator {
            resolver: self,
            routine: declared.routine,
            inside_loop: None,
            thing,
            constant: false,
            at_move: false,
        }
    }

    fn content(&self, declared: &Declared<'a>) -> Result<Placed, Stop> {
        let evaluator = self.evaluator(declared);
        let sizes = self.sizes(declared)?;
        let Some(expression) = &declared.value else {
            return Ok((
                Content::Uninitialised { sizes },
                declared.value_place..declared.value_place,
                Vec::new(),
            ));
        };
        let span = expression.start..expression.end;
        if sizes.is_empty() {
            return Ok((
                Content::Single(evaluator.value(expression, declared.data_type)?),
                span,
                Vec::new(),
            ));
        }
        let mut elements = Elements {
            evaluator,
            data_type: declared.data_type,
            sizes: &sizes,
            values: Vec::new(),
            spans: Vec::new(),
        };
        elements.add(expression, 0)?;
        let (values, spans) = (elements.values, elements.spans);
        Ok((Content::Array { sizes, values }, span, spans))
    }

    fn sizes(&self, declared: &Declared<'a>) -> Result<Vec<usize>, Stop> {
        let evaluator = Evaluator { constant: true, ..self.evaluator(declared) };
        let thing = || evaluator.thing();
        if let Some(fourth) = declared.sizes.get(MOST_DIMENSIONS) {
            let kind = RapidFaultKind::Dimensions {
                thing: thing(),
                found: declared.sizes.len(),
                bound: MOST_DIMENSIONS,
            };
            return Err(evaluator.fault(fourth, kind));
        }
        let mut sizes = Vec::with_capacity(declared.sizes.len());
        for (i, size) in declared.sizes.iter().enumerate() {
            let value = evaluator.number(size)?;
            let fault = || {
                evaluator.fault(
                    size,
                    RapidFaultKind::ArrayDimension { thing: thing(), dimension: i + 1, value },
                )
            };
            sizes.push(positive_whole(value).ok_or_else(fault)?);
        }
        Ok(sizes)
    }

    /// An argument of a move, of a type.
    fn argument<T: Record>(
        &self,
        step: &WrittenMove<'a>,
        role: &'static str,
        expression: &Expression<'a>,
    ) -> Result<Argument<T>, RapidFault> {
        let thing = (step.kind.name(), role);
        let evaluator = Evaluator {
            resolver: self,
            routine: step.routine,
            inside_loop: step.inside_loop,
            thing,
            constant: false,
            at_move: true,
        };
        let value = match evaluator.value(expression, T::DATA_TYPE).map(T::of) {
            Ok(Some(value)) => Ok(value),
            Ok(None) => Err(format!("it is no {}", T::DATA_TYPE.name())),
            Err(Stop::Fault(fault)) => return Err(fault),
            Err(Stop::Unknown(why)) => Err(why),
        };
        Ok(Argument { text: self.source(expression), value })
    }

    fn source(&self, expression: &Expression<'_>) -> String {
        self.text.get(expression.start..expression.end).unwrap_or_default().to_string()
    }

    fn step(
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
            routine: routine_name(routines, step.routine),
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

#[derive(Clone, Copy, PartialEq, Eq)]
enum State {
    New,
    Open,
    Done,
}

/// The elements of an array, the last index running fastest.
struct Elements<'s, 'r, 'a> {
    evaluator: Evaluator<'r, 'a>,
    data_type: DataType,
    sizes: &'s [usize],
    values: Vec<Value>,
    spans: Vec<Range<usize>>,
}

impl Elements<'_, '_, '_> {
    fn add(&mut self, expression: &Expression<'_>, dimension: usize) -> Result<(), Stop> {
        let Some(&wanted) = self.sizes.get(dimension) else {
            self.values.push(self.evaluator.value(expression, self.data_type)?);
            self.spans.push(expression.start..expression.end);
            return Ok(());
        };
        let fault = |kind| Err(self.evaluator.fault(expression, kind));
        let thing = || self.evaluator.thing();
        match &expression.form {
            Form::Aggregate(elements) if elements.len() == wanted => {
                elements.iter().try_for_each(|element| self.add(element, dimension + 1))
            }
            Form::Aggregate(elements) => fault(RapidFaultKind::ArraySize {
                thing: thing(),
                dimension: dimension + 1,
                found: elements.len(),
                wanted,
            }),
            Form::Number(_) | Form::Bool(_) | Form::Text(_) => {
                let found = match &expression.form {
                    Form::Number(_) => "a number",
                    Form::Text(_) => "a string",
                    _ => "a truth value",
                };
                fault(RapidFaultKind::ComponentType {
                    thing: thing(),
                    part: String::new(),
                    found: found.to_string(),
                    wanted: "an array",
                })
            }
            Form::Reference(reference) => Err(Stop::Unknown(format!(
                "refers to {}, and arrays are not copied",
                reference.name
            ))),
            _ => Err(Stop::Unknown("the value of an array is written as no aggregate".to_string())),
        }
    }
}

/// RAPID's own data that are read.
fn predefined(lower: &str) -> Option<Value> {
    match lower {
        "tool0" => Some(Value::ToolData(ToolData::TOOL0)),
        "wobj0" => Some(Value::WobjData(WobjData::WOBJ0)),
        "load0" => Some(Value::LoadData(LoadData::LOAD0)),
        _ => None,
    }
}

fn routine_name(routines: &[Routine], routine: usize) -> Option<String> {
    routines.get(routine.checked_sub(1)?).map(|routine| routine.name.clone())
}

/// Gives a declaration without names what it holds and lets go of its expression, most of the memory of a large text.
pub(super) fn resolve_at_once(text: &str, declared: &mut Declared<'_>) -> Result<(), RapidFault> {
    if !declared.names.is_empty() {
        return Ok(());
    }
    let (scopes, blocks) = (Scopes::new(), Blocks::new());
    let (contents, reasons, causes) = (Vec::new(), BTreeMap::new(), Causes::none());
    let resolver = Resolver {
        text,
        declared: &[],
        scopes: &scopes,
        blocks: &blocks,
        context: &[],
        contents,
        reasons,
        causes,
    };
    match resolver.content(declared) {
        Ok(placed) => declared.content = Some(Box::new(placed)),
        Err(Stop::Fault(fault)) => return Err(fault),
        // It is told when all names are known.
        Err(Stop::Unknown(_)) => return Ok(()),
    }
    declared.value = None;
    Ok(())
}

/// The module of a text with every name looked up.
pub(super) fn resolved(written: Written<'_>, context: &[&Module]) -> Result<Module, RapidFault> {
    let Written {
        text,
        name,
        attributes,
        routines,
        mut declared,
        mut moves,
        mut skipped,
        assignments,
        scopes,
        blocks,
    } = written;
    let contents =
        declared.iter_mut().map(|datum| datum.content.take().map(|placed| *placed)).collect();
    let (declared_data, blocks, all_scopes) = (&declared, &blocks, &scopes);
    let (reasons, causes) =
        (BTreeMap::new(), Causes::new(&assignments, declared_data, all_scopes, blocks));
    let mut resolver = Resolver {
        text,
        declared: declared_data,
        scopes: all_scopes,
        blocks,
        context,
        contents,
        reasons,
        causes,
    };
    resolver.resolve_all()?;
    let mut resolved_moves = Vec::with_capacity(moves.len());
    for step in &mut moves {
        resolved_moves.extend(resolver.step(step, &routines)?);
    }
    let Resolver { contents, mut reasons, causes, .. } = resolver;
    let mut data = Vec::with_capacity(declared.len());
    let mut places = Vec::with_capacity(declared.len());
    let mut expressions = BTreeMap::new();
    for (i, (datum, placed)) in declared.iter().zip(contents).enumerate() {
        let routine = routine_name(&routines, datum.routine);
        places.push(placed.is_some().then_some(data.len()));
        let Some((content, value_span, element_spans)) = placed else {
            let what = format!("{}: {}", datum.name, reasons.remove(&i).unwrap_or_default());
            let text = text.get(datum.start..datum.end).unwrap_or_default().to_string();
            skipped.push(Skipped { line: datum.line, column: datum.column, routine, what, text });
            continue;
        };
        let Declared { data_type, scope, storage, line, column, .. } = *datum;
        let name = datum.name.to_string();
        if causes.of_datum(i).is_some() && !datum.names.is_empty() {
            expressions
                .insert(data.len(), text.get(value_span.clone()).unwrap_or_default().to_string());
        }
        data.push(Datum {
            name,
            data_type,
            scope,
            storage,
            routine,
            content,
            line,
            column,
            value_span,
            element_spans,
        });
    }
    skipped.sort_by_key(|skipped| (skipped.line, skipped.column));
    let assigned = causes.names(&declared);
    let index = scopes
        .module_data()
        .filter_map(|(name, declared)| Some((name, places.get(declared).copied()??)))
        .collect();
    let name = name.map(ToString::to_string);
    Ok(Module {
        name,
        attributes,
        routines,
        data,
        moves: resolved_moves,
        skipped,
        index,
        assigned,
        expressions,
        text_length: text.len(),
    })
}
