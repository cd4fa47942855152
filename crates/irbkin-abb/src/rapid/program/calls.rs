//! Calls of routines: arguments put in for parameters, and what is assigned to them given back.

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::rc::Rc;
use core::mem;

use super::cases::Known;
use super::effects::{Acts, MOST_CALLED};
use super::state::{Frame, Local, Locals, MOST_KNOWN, Site, Text};
use super::values::Calls;
use super::walker::Walk;
use super::whole::Program;
use crate::prelude::*;
use crate::rapid::data::expression::{Arguments, Call, Expression};
use crate::rapid::data::module::{Content, Parameter, Storage};
use crate::rapid::data::statement::{Instruction, Statement};
use crate::rapid::data::unread::{Reason, Unresolved};
use crate::rapid::data::value::{DataType, Value};

/// The name of what a function returns: no name of RAPID.
const RETURNED: &str = "RETURN";

const DEEPEST_CALLS: usize = 32;

/// The statements that a call takes as long as, beside its routine [1].
const CALL: usize = 4;

impl Program<'_> {
    /// The data and the parameters of a routine at its beginning: parameters are unknown unless
    /// they are `given`, in their order.
    pub(super) fn locals_of(
        &self,
        module: usize,
        routine: &str,
        given: Option<Vec<(String, Local)>>,
    ) -> Rc<Locals> {
        let data = self.locals(module, routine).map(|datum| {
            let content = match (&datum.content, datum.storage) {
                (Content::Uninitialized { sizes }, Storage::Var)
                    if sizes.is_empty() && datum.data_type == DataType::Num =>
                {
                    Ok(Known::certain(Content::Single(Value::Num(0.0)), ""))
                }
                (Content::Uninitialized { .. }, _) => Err(Unresolved::NoValue),
                (_, Storage::Pers) => Err(Unresolved::ValueNotKnown),
                (content, _) => Ok(Known::certain(content.clone(), "")),
            };
            (datum.name.to_lowercase(), Local { data_type: Some(datum.data_type), content })
        });
        let unknown = |parameter: &Parameter| {
            let content = Err(Unresolved::Parameter { routine: routine.to_string() });
            (parameter.name.clone(), Local { data_type: parameter.data_type, content })
        };
        let parameters =
            given.unwrap_or_else(|| self.parameters(module, routine).iter().map(unknown).collect());
        let mut locals: Locals = data.chain(parameters).collect();
        if locals.len() > MOST_KNOWN {
            let unknown = |local: &mut Local| local.content = Err(Unresolved::ValueNotKnown);
            locals.values_mut().for_each(unknown);
        }
        Rc::new(locals)
    }
}

impl Calls for Walk<'_, '_> {
    /// What a function returns, as it is called in a text; `None` if that is not known, or if the
    /// function does more than that.
    fn returned(&self, text: &str, call: &Call<'_>) -> Option<Known> {
        let (program, name) = (self.program, call.name.to_lowercase());
        let (home, data_type) = program.function(self.frame.module, &name)?;
        let does_more = program.effects.of_routine(home, &name).is_some_and(Acts::matters);
        if self.is_open(home, &name)
            || does_more
            || self.above.len() >= DEEPEST_CALLS
            || self.is_spent()
        {
            return None;
        }
        let mut walk = Self::new(program, self.interrupt);
        walk.takes_last = self.takes_last;
        (walk.state, walk.frame) = (self.state.clone(), self.frame.clone());
        walk.above.clone_from(&self.above);
        walk.above.push((self.frame.module, self.frame.routine.clone()));
        walk.questions.set(self.questions.get());
        walk.steps_left = self.steps_left.saturating_sub(self.inside.get());
        let left = walk.steps_left;
        let parameters = program.parameters(home, &name);
        let bound = walk.bound((text, 0, &Rc::default()), parameters, &call.arguments);
        walk.state.locals = program.locals_of(home, &name, Some(bound.given));
        walk.frame = Frame {
            result: Some(data_type),
            entry: walk.question(),
            absent: bound.absent,
            present: bound.present,
            ..Frame::of(home, name)
        };
        walk.routine();
        self.questions.set(walk.questions.get());
        self.inside.update(|count| count + CALL + left - walk.steps_left);
        walk.state.locals.get(RETURNED)?.content.clone().ok()
    }

    fn question(&self) -> usize {
        self.questions.replace(self.questions.get() + 1)
    }
}

impl<'m> Walk<'_, 'm> {
    /// Whether a routine is being followed: a call of it is circular.
    fn is_open(&self, home: usize, name: &str) -> bool {
        let own = (self.frame.module, &self.frame.routine);
        let above = self.above.iter().map(|(module, routine)| (*module, routine));
        above.chain([own]).any(|(module, routine)| (module, routine.as_str()) == (home, name))
    }

    /// Follow an instruction that may be a call.
    pub(super) fn call(&mut self, statement: &'m Statement, instruction: &Instruction) {
        let Some(name) = instruction.name.clone() else {
            // It may assign any datum.
            self.state.forget_globals(None);
            let words = "the name of the routine is calculated".to_string();
            return self.not_followed(statement, words);
        };
        let program = self.program;
        let Some(home) = program.procedure(self.frame.module, &name) else { return };
        let parameters = program.parameters(home, &name);
        let Some(acts) = program.effects.of_routine(home, &name) else { return };
        if !acts.matters() {
            return;
        }
        let why = if self.is_open(home, &name) {
            Some(format!("{name} calls itself"))
        } else if self.above.len() >= DEEPEST_CALLS {
            Some(format!("more than {DEEPEST_CALLS} calls within calls"))
        } else if self.is_spent() {
            Some("the program has too many calls within calls to follow each".to_string())
        } else {
            None
        };
        if let Some(words) = why {
            let assigned = program.effects.assigned_by(&[(home, name)], MOST_CALLED);
            self.state.forget_globals(assigned.as_ref());
            self.state.place = Err("a call before it is not followed");
            if acts.moves {
                self.not_followed(statement, words);
            }
            return;
        }
        let site = Rc::new(Site {
            place: (self.frame.module, statement.line, statement.column),
            routine: statement.routine.as_deref().map(String::from),
            called: statement.kind.word().to_string(),
        });
        let written = (statement.text.as_str(), statement.start, &site);
        let bound = self.bound(written, parameters, &instruction.arguments);
        let first = self.frame.site.clone().unwrap_or(site);
        let site = Some(first).filter(|_| !parameters.is_empty());
        self.enter((statement.start, site), (home, name), bound);
    }

    /// Follow a routine with its arguments.
    fn enter(
        &mut self,
        (start, site): (usize, Option<Rc<Site>>),
        (home, name): (usize, String),
        bound: Bound,
    ) {
        let Bound { given, absent, present, texts, names } = bound;
        let next = self.chains.len() + 1;
        let call = (self.frame.chain, self.frame.module, start);
        let chain = *self.chains.entry(call).or_insert(next);
        let before: Locals = given.iter().cloned().collect();
        let locals = self.program.locals_of(home, &name, Some(given));
        self.spend(CALL + locals.values().map(Local::size).sum::<usize>());
        let frame = Frame {
            module: home,
            routine: name,
            site,
            chain,
            absent,
            present,
            texts,
            entry: self.question(),
            ..Frame::default()
        };
        let own_frame = mem::replace(&mut self.frame, frame);
        self.above.push((own_frame.module, own_frame.routine.clone()));
        let own_locals = mem::replace(&mut self.state.locals, locals);
        self.routine();
        self.above.pop();
        self.frame = own_frame;
        let after = mem::replace(&mut self.state.locals, own_locals);
        for (parameter, name) in names {
            if after.get(&parameter) != before.get(&parameter)
                && let Some(local) = after.get(&parameter)
            {
                self.put(&name, local.content.clone().ok());
            }
        }
    }

    /// Keep what a function returns.
    pub(super) fn give_back(&mut self, statement: &Statement, instruction: &Instruction) {
        let Some(data_type) = self.frame.result else { return };
        let Some(value) = instruction.arguments.required.first() else { return };
        let ways = self.in_each_case(|it| it.value(&statement.text, value, data_type).ok());
        let written = statement.text.get(value.start..value.end).unwrap_or_default();
        let words = format!("{} is {written}", self.frame.routine);
        let known = Known::of_ways(ways, |value| value.map(Content::Single), &words);
        let content = known.ok_or(Unresolved::ValueNotKnown);
        let local = Local { data_type: Some(data_type), content };
        Rc::make_mut(&mut self.state.locals).insert(RETURNED.to_string(), local);
    }

    /// Give a datum or a local another content, or none that is known.
    pub(super) fn put(&mut self, lower: &str, content: Option<Known>) {
        self.state.asked.forget_word(lower);
        if self.state.locals.contains_key(lower) {
            if self.state.locals.len() <= MOST_KNOWN
                && let Some(local) = Rc::make_mut(&mut self.state.locals).get_mut(lower)
            {
                local.content = content.ok_or(Unresolved::ValueNotKnown);
            }
            return;
        }
        if let Some((datum, _)) = self.program.datum(self.frame.module, lower) {
            let is_certain = !self.program.effects.interrupted.contains(&datum);
            self.state.set_global(datum, content.filter(|_| is_certain));
        }
    }

    fn bound(
        &mut self,
        written: (&str, usize, &Rc<Site>),
        parameters: &[Parameter],
        arguments: &Arguments<'_>,
    ) -> Bound {
        let mut bound = Bound::default();
        let mut required = arguments.required.iter();
        for parameter in parameters {
            let argument = if parameter.is_optional {
                let own = arguments.optional.iter().find(|it| it.is(&parameter.name));
                own.map(|it| it.value.as_ref())
            } else {
                required.next().map(Some)
            };
            if let Some(value) = argument {
                self.bind(written, parameter, value, &mut bound);
            } else {
                bound.absent.insert(parameter.name.clone());
                bound.give(parameter, Err(Unresolved::NoValue));
            }
        }
        bound
    }

    fn bind(
        &mut self,
        (whole, start, site): (&str, usize, &Rc<Site>),
        parameter: &Parameter,
        value: Option<&Expression<'_>>,
        bound: &mut Bound,
    ) {
        let name = parameter.name.clone();
        let text = value.and_then(|it| whole.get(it.start..it.end));
        let text = text.unwrap_or_default();
        // \Name?parameter passes on an argument, if there is one.
        let passed = text.strip_prefix('?').map(|passed| passed.trim().to_lowercase());
        match &passed {
            Some(passed) if self.frame.absent.contains(passed) => bound.absent.insert(name),
            Some(passed) if !self.frame.present.contains(passed) => false,
            _ => bound.present.insert(name),
        };
        let (Some(value), Some(data_type)) = (value, parameter.data_type) else {
            return bound.give(parameter, Err(Unresolved::ValueNotKnown));
        };
        if let Some(passed) = passed {
            let local = self.state.locals.get(&passed);
            let content = local.map_or(Err(Unresolved::ValueNotKnown), |it| it.content.clone());
            bound.texts.extend(
                self.frame.texts.get(&passed).map(|it| (parameter.name.clone(), it.clone())),
            );
            return bound.give(parameter, content);
        }
        let name = value.referred().filter(|(_, components)| components.is_empty());
        let ways = self.in_each_case(|scope| match scope.whole(value) {
            Some(content) => Ok(content),
            None => match scope.value(whole, value, data_type) {
                Ok(value) => Ok(Content::Single(value)),
                Err(Reason::Reference { why, .. }) => Err(why),
                Err(_) => Err(Unresolved::ValueNotKnown),
            },
        });
        let unknown = ways.iter().find_map(|way| way.value.as_ref().err().cloned());
        let words = format!("{} is {text}", parameter.name);
        let known = Known::of_ways(ways, Result::ok, &words);
        let content = known.ok_or(unknown.unwrap_or(Unresolved::ValueNotKnown));
        let argument = self.frame.argument(text).unwrap_or_else(|| Text {
            written: text.to_string(),
            span: start + value.start..start + value.end,
            site: site.clone(),
        });
        bound.texts.insert(parameter.name.clone(), argument);
        if let (true, Some((name, _))) = (parameter.is_reference, name) {
            bound.names.push((parameter.name.clone(), name));
        }
        bound.give(parameter, content);
    }
}

/// Arguments put in for parameters.
#[derive(Default)]
struct Bound {
    given: Vec<(String, Local)>,
    absent: BTreeSet<String>,
    present: BTreeSet<String>,
    texts: BTreeMap<String, Text>,
    /// Parameters by reference, with the names of their arguments.
    names: Vec<(String, String)>,
}

impl Bound {
    fn give(&mut self, parameter: &Parameter, content: Result<Known, Unresolved>) {
        let local = Local { data_type: parameter.data_type, content };
        self.given.push((parameter.name.clone(), local));
    }
}
