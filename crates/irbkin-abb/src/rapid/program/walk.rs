//! Go through the routines of a program as they call each other: moves in runs, within which each
//! certainly follows the one before it.

use alloc::borrow::Cow;
use alloc::collections::BTreeSet;
use alloc::rc::Rc;

use super::cases::{Case, Known, Way};
use super::effects::{releases, written_by};
use super::moves::place_behind;
use super::state::{Displacement, Frame, Here, Local, State};
use super::tree::{Block, Node, Part, nodes};
use super::values::Calls as _;
use super::walker::{END_OF_MAIN, Filled, MOVE, Run, Step, Stepped, Uncertain, Walk};
use super::whole::Program;
use crate::prelude::*;
use crate::rapid::data::expression::Expression;
use crate::rapid::data::finding::{Code, Finding};
use crate::rapid::data::instructions::Effect;
use crate::rapid::data::moves::{Move, MoveKind};
use crate::rapid::data::records::GivenTools;
use crate::rapid::data::statement::{
    Assignment, Condition, Counter, Instruction, Statement, StatementKind,
};
use crate::rapid::data::unread::{Reason, Unresolved};
use crate::rapid::data::value::{DataType, Value};
use irbkin::{Interrupt, Interrupted};

const MOST_PASSES: usize = 1000;

/// Most statements in the passes of a loop that no move and no call names the counter of.
const MOST_UNCOUNTED: usize = 200;

/// The runs of a program: of its main routine, then of every routine that was not called; and what
/// is never executed.
///
/// With `takes_last`, a PERS that the program assigns has the value that the text has; `tools` are
/// for those that nothing declares.
pub(in crate::rapid) fn runs<'m>(
    program: &Program<'m>,
    takes_last: bool,
    tools: Option<&GivenTools>,
    interrupt: Interrupt<'_>,
) -> Result<(Vec<Run<'m>>, Vec<Finding>), Interrupted> {
    let mut walk = Walk::new(program, interrupt);
    walk.takes_last = takes_last;
    walk.tools = tools;
    let mains = (0..program.modules.len()).map(|module| (module, "main".to_string()));
    let all = program.routines().into_iter();
    for (module, routine) in mains.chain(all) {
        let name = (module, routine);
        if program.body(module, &name.1).is_some() && !walk.followed.contains(&name) {
            walk.root(name);
        }
    }
    walk.note_left();
    if walk.is_ended { Err(Interrupted) } else { Ok((walk.runs, walk.notes)) }
}

/// The steps of a routine of the first module, in the order of execution, up to what ends it; and
/// the first branch, loop or jump that decides on them.
pub(in crate::rapid) fn steps<'m>(
    program: &Program<'m>,
    routine: &str,
) -> (Vec<Step<'m>>, Option<Uncertain>) {
    let mut walk = Walk::new(program, Interrupt::none());
    walk.is_one = true;
    walk.root((0, routine.to_lowercase()));
    let steps = walk.runs.into_iter().flat_map(|run| run.steps);
    (steps.collect(), walk.uncertain)
}

impl<'m> Walk<'_, 'm> {
    /// Follow a routine that nothing is known to call.
    fn root(&mut self, (module, routine): (usize, String)) {
        self.state = State::new();
        self.state.locals = self.program.locals_of(module, &routine, None);
        self.frame = Frame::of(module, routine);
        self.routine();
        if self.frame.routine == "main" {
            self.halt(END_OF_MAIN);
        }
    }

    /// Follow the routine of the frame, from its beginning to its end.
    pub(super) fn routine(&mut self) {
        let (module, program) = (self.frame.module, self.program);
        let Some(body) = program.body(module, &self.frame.routine) else { return };
        let is_first = self.followed.insert((module, self.frame.routine.clone()));
        let entry = self.state.clone();
        self.block(&body.main);
        let mut ends = core::mem::take(&mut self.frame.exits);
        ends.push(self.state.clone());
        let ends = ends.into_iter().enumerate().collect();
        self.join(entry, ends, (self.question(), 0));
        if !is_first || self.is_one {
            return;
        }
        let end = self.state.clone();
        for handler in &body.handlers {
            self.state = State::new();
            self.state.settings = end.settings;
            self.state.locals = program.locals_of(module, &self.frame.routine, None);
            self.block(handler);
        }
        self.frame.exits.clear();
        self.state = end;
    }

    pub(super) fn block(&mut self, block: &Block<'m>) {
        let mut is_dead = false;
        for node in block {
            self.spend(1);
            if self.ends() {
                return;
            }
            if self.state.here == Here::Left
                && !is_dead
                && let Node::Move(_, step) = node
            {
                is_dead = true;
                let words = "is never executed: the routine is left before";
                let finding = Finding::new(Code::NeverRun, words).at(step, 0);
                self.notes.push(finding.in_module(self.frame.module));
            }
            match node {
                Node::Move(index, step) => self.step(*index, step),
                Node::Setting(setting) => {
                    setting.set(&mut self.state.settings);
                }
                Node::Other(statement) => self.statement(statement),
                Node::Branches { head, tested, parts } => {
                    if self.is_one && parts.iter().any(|part| self.acts(&part.block)) {
                        self.decides(head.line, head.kind.word());
                    }
                    self.branches(head, *tested, parts);
                }
                Node::Loop { head, condition: Condition::Never, body, .. } => {
                    self.never_run(head, body);
                }
                Node::Loop { head, condition, counter: None, body, .. } => {
                    self.repeat_while(head, condition, body);
                }
                Node::Loop { head, counter: Some(counter), is_counted, body, .. } => {
                    self.repeat(head, (counter, *is_counted), body);
                }
            }
        }
    }

    /// A branch: in each case the part whose condition holds, or every part whose condition may.
    fn branches(
        &mut self,
        head: &'m Statement,
        tested: Option<&Expression<'m>>,
        parts: &[Part<'m>],
    ) {
        let tested = tested.map(|it| (&*head.text, it));
        let ways = self.in_each_case(|scope| scope.open(tested, parts));
        let is_open = |part: usize| ways.iter().any(|way| way.value.contains(&part));
        let (open, closed): (Vec<_>, Vec<_>) = (0..=parts.len()).partition(|part| is_open(*part));
        for part in closed.iter().filter_map(|index| parts.get(*index)) {
            match part.condition {
                Condition::Never => self.never_run(part.head, &part.block),
                _ => self.left_out(&part.block),
            }
        }
        if let [only] = open.as_slice() {
            return parts.get(*only).map_or((), |part| self.block(&part.block));
        }
        let texts = parts.iter().map(|part| part.head.text.as_str());
        let text = core::iter::once(head.text.as_str()).chain(texts).collect::<Vec<_>>().join(" ");
        let are_same = ways.iter().all(|way| way.value == ways[0].value);
        let (question, is_new) = if are_same { self.ask(&text) } else { (self.question(), true) };
        let entry = self.state.clone();
        let mut ends = Vec::new();
        for answer in open {
            self.state = entry.clone();
            if is_new {
                let ways = ways.iter().filter(|way| way.value.contains(&answer));
                self.state.assume(&ways.map(|way| way.case.clone()).collect::<Vec<_>>());
            } else {
                self.state.assume(&[Case::of(question, answer)]);
            }
            if let Some(part) = parts.get(answer) {
                self.block(&part.block);
            }
            ends.push((answer, self.state.clone()));
        }
        if !self.join(entry, ends, (question, head.line)) && is_new {
            self.state.asked.forget_number(question);
        }
    }

    /// Whether the condition of a loop holds here, whatever the case.
    pub(super) fn holds(&mut self, head: &Statement, condition: &Condition) -> Option<bool> {
        let holds = self.in_all_cases(|scope| scope.holds(None, &head.text, condition));
        holds.map(|(holds, _)| holds)
    }

    /// A block that the call that is followed does not execute.
    fn left_out(&mut self, block: &Block<'m>) {
        for node in nodes(block) {
            if let Node::Move(index, step) = node {
                self.left.insert((self.frame.module, *index), *step);
            }
        }
    }

    /// Report the moves that no call executes.
    fn note_left(&mut self) {
        let made = self.runs.iter().flat_map(|run| &run.steps).filter_map(|step| match step {
            Step::Move(own) => Some(own.instruction),
            Step::NotFollowed { .. } => None,
        });
        let made: BTreeSet<(usize, usize)> = made.collect();
        for (place, step) in self.left.iter().filter(|(place, _)| !made.contains(place)) {
            let words = "is never executed: no call has the arguments or values that it asks for";
            let finding = Finding::new(Code::NeverRun, words).at(step, 0);
            self.notes.push(finding.in_module(place.0));
        }
    }

    fn never_run(&mut self, head: &Statement, block: &Block<'m>) {
        if block.iter().any(|node| matches!(node, Node::Move(..) | Node::Loop { .. })) {
            let finding = Finding::new(Code::NeverRun, "what follows is never executed");
            self.notes.push(finding.in_module(self.frame.module).at_statement(head, 0));
        }
    }

    fn step(&mut self, index: usize, written: &'m Move) {
        // The robot stays.
        if written.kind == MoveKind::MoveExtJ {
            self.state.place = Err("external axes move before it");
            return;
        }
        let ways = self.in_each_case(|scope| {
            let mut own = Cow::Borrowed(written);
            let is_passed_on = scope.fill(&mut own);
            (own, is_passed_on)
        });
        self.spend(MOVE * ways.len());
        let mut steps = Vec::with_capacity(ways.len());
        for Way { case, words, assumed, value: (own, is_passed_on) } in ways {
            let case_words = self.case(&words);
            let step = self.stepped((index, written), own, is_passed_on, assumed, case_words);
            steps.push((case, step));
        }
        match steps.pop() {
            Some((_, only)) if steps.is_empty() => self.push_move(only),
            Some(last) => {
                self.state.place = Err("the target before it has one of several values");
                steps.push(last);
                self.push_each(steps);
            }
            None => {}
        }
        if let Some(name) = written_by(written) {
            self.put(&name, None);
        }
    }

    /// Which passes of loops are followed, and which of its values a move has, in words.
    fn case(&self, values: &str) -> String {
        let passes = if self.passes.is_empty() { "" } else { "at " };
        let values = if values.is_empty() { String::new() } else { format!("if {values}") };
        let all = format!("{passes}{} {values}", self.passes.join(", "));
        all.trim().to_string()
    }

    /// A step of a move with the values that it has here, which settings and displacements change.
    fn stepped(
        &mut self,
        (index, written): (usize, &'m Move),
        mut own: Cow<'m, Move>,
        is_passed_on: bool,
        assumed: Option<Rc<str>>,
        case: String,
    ) -> Stepped<'m> {
        let assumed = assumed.or_else(|| self.state.assumed_shift.clone());
        if own.settings != self.state.settings {
            own.to_mut().settings = self.state.settings;
        }
        self.state.displace(&mut own);
        self.state.place = place_behind(&own, written);
        let (mut module, mut chain) = (self.frame.module, 0);
        let call = self.frame.site.clone().filter(|_| is_passed_on);
        if call.is_some() {
            module = self.frame.place(written, own.to_mut());
            chain = self.frame.chain;
        }
        let instruction = (self.frame.module, index);
        let displaced_on = match self.state.displacement {
            Displacement::Known(_, line) if own.kind != MoveKind::MoveAbsJ => Some(line),
            _ => None,
        };
        let halt = None;
        let step = match own {
            Cow::Borrowed(step) => Filled::Same(step),
            Cow::Owned(step) => Filled::Other(Box::new(step)),
        };
        let assumed = assumed.map(|it| it.to_string());
        Stepped { module, instruction, step, chain, call, case, assumed, halt, displaced_on }
    }

    /// Something that is no move and no branch.
    fn statement(&mut self, statement: &'m Statement) {
        match &statement.kind {
            StatementKind::Unfinished { .. } | StatementKind::Invalid { .. } => {
                self.not_followed(statement, statement.kind.to_string());
            }
            StatementKind::Label { .. } => {
                if let Some(body) = self.program.body(self.frame.module, &self.frame.routine) {
                    self.forget(&body.main);
                }
                self.state.here = Here::Unknown;
            }
            StatementKind::Assignment(own) => self.assign(statement, own),
            StatementKind::Instruction(instruction) => self.instruct(statement, instruction),
            _ => {}
        }
    }

    fn assign(&mut self, statement: &'m Statement, own: &Assignment) {
        let ways = self.in_each_case(|it| it.assigned(&statement.text, own));
        if ways.iter().any(|way| way.value.is_none()) {
            self.note_out_of_reach(statement, &own.value);
        }
        let text = statement.text.trim_end_matches(';');
        let words = match text.split_once(":=") {
            Some((to, value)) => format!("{} is {}", to.trim(), value.trim()),
            None => format!("{} is counted by {text}", own.name),
        };
        self.put(&own.to.0, Known::of_ways(ways, |content| content, &words));
    }

    /// Report a calculated target that the robot does not reach.
    fn note_out_of_reach(&mut self, statement: &'m Statement, value: &Expression<'_>) {
        let scope = self.scope();
        let certain = || scope.value(&statement.text, value, DataType::JointTarget);
        if let Err(reason @ Reason::Robot { .. }) = scope.choices.without(certain) {
            let found = Finding::unknown(Code::UnknownTarget, &reason, reason.to_string());
            self.notes.push(found.in_module(self.frame.module).at_statement(statement, 0));
        }
    }

    fn instruct(&mut self, statement: &'m Statement, instruction: &Instruction) {
        if releases(self.program, self.frame.module, instruction) {
            self.state.place = Err("the robot may be moved by hand or by a call before it");
        }
        if let Some(own) = instruction.as_assignment() {
            self.assign(statement, &own);
        } else if let Some((name, _)) = &instruction.written {
            self.put(name, None);
        }
        match instruction.effect {
            Effect::Moves => {
                let name = instruction.name.as_deref();
                let home = name.and_then(|name| self.program.procedure(self.frame.module, name));
                match home {
                    Some(_) => self.call(statement, instruction),
                    None => self.not_followed(statement, statement.kind.to_string()),
                }
            }
            Effect::Returns => {
                self.give_back(statement, instruction);
                self.frame.exits.push(self.state.clone());
                self.state.here = Here::Left;
            }
            Effect::Leaves => self.state.here = Here::Left,
            Effect::Jumps => {
                self.decides(statement.line, "GOTO");
                self.state.here = Here::Left;
            }
            Effect::Displaces(shift) => {
                let known =
                    self.in_all_cases(|it| Some(it.displacement(statement, instruction, shift)));
                let unknown = (Displacement::Unknown(statement.line), None);
                (self.state.displacement, self.state.assumed_shift) = known.unwrap_or(unknown);
            }
            Effect::Offsets(shift) => {
                let known = self.in_all_cases(|it| Some(it.offsets(statement, instruction, shift)));
                let unknown = (Err(statement.line), None);
                (self.state.offsets, self.state.assumed_shift) = known.unwrap_or(unknown);
            }
            Effect::Sets => self.not_followed(statement, statement.kind.to_string()),
            Effect::Stops if self.is_one => self.state.here = Here::Left,
            Effect::Waits | Effect::Stops => {
                self.halt(&format!("{} on line {}", statement.kind.word(), statement.line));
            }
            Effect::Nothing => self.call(statement, instruction),
        }
    }

    /// A loop: each pass where its bounds are known and it refers to its variable, else the first.
    pub(super) fn repeat(
        &mut self,
        head: &'m Statement,
        (counter, is_counted): (&Counter, bool),
        body: &Block<'m>,
    ) {
        let name = &counter.variable;
        let before = self.state.locals.get(name).cloned();
        let bounds = counter.bounds.each_ref().map(|bound| self.number(&head.text, bound));
        let step = counter.step.as_ref().map(|step| self.number(&head.text, step));
        let passes = values_of(bounds, step.flatten());
        let is_short = passes.len() * nodes(body).count() <= MOST_UNCOUNTED;
        let is_followed = self.is_one || is_counted || is_short;
        if !passes.is_empty() && self.affords(passes.len(), body) && is_followed {
            let depth = self.passes.len();
            for value in passes {
                self.passes.truncate(depth);
                self.passes.push(format!("{name} = {value}"));
                self.state.asked.forget_word(name);
                let local = Local::single(Value::Num(value));
                Rc::make_mut(&mut self.state.locals).insert(name.clone(), local);
                self.block(body);
                if self.state.here == Here::Left {
                    break;
                }
                if self.is_spent() {
                    let words = "the program has too many passes of loops to follow each";
                    self.not_followed(head, words.to_string());
                    self.forget(body);
                    break;
                }
            }
            self.passes.truncate(depth);
        } else {
            let local = Local { data_type: None, content: Err(Unresolved::LoopVariable) };
            Rc::make_mut(&mut self.state.locals).insert(name.clone(), local);
            self.repeat_first(head, body);
        }
        let locals = Rc::make_mut(&mut self.state.locals);
        match before {
            Some(local) => locals.insert(name.clone(), local),
            None => locals.remove(name),
        };
    }

    /// A loop with a condition: each pass as long as it is known to hold, then the first of those
    /// in which it may.
    pub(super) fn repeat_while(
        &mut self,
        head: &'m Statement,
        condition: &Condition,
        body: &Block<'m>,
    ) {
        if let Condition::Compared(..) = condition {
            let depth = self.passes.len();
            for pass in 1..=MOST_PASSES {
                match self.holds(head, condition) {
                    Some(true) if self.affords(1, body) => {}
                    Some(false) => return,
                    _ => break,
                }
                let before = self.state.clone();
                self.passes.push(format!("pass {pass}"));
                self.block(body);
                self.passes.truncate(depth);
                if self.state.here == Here::Left {
                    return;
                }
                if self.state.globals == before.globals && self.state.locals == before.locals {
                    break;
                }
            }
        }
        self.repeat_first(head, body);
        if matches!(condition, Condition::Always) && !jumps(body) {
            self.state.here = Here::Left;
        }
    }

    /// Whether so many passes of a loop can be followed.
    fn affords(&self, passes: usize, body: &Block<'m>) -> bool {
        let left = self.steps_left.min(self.moves_left);
        !self.is_spent() && passes.saturating_mul(nodes(body).count()) <= left
    }

    /// The first pass of a loop whose passes are not known.
    fn repeat_first(&mut self, head: &'m Statement, body: &Block<'m>) {
        if self.is_one && self.acts(body) {
            self.decides(head.line, head.kind.word());
        }
        self.forget(body);
        let entry = self.state.clone();
        self.block(body);
        let ends = Vec::from([(0, entry.clone()), (1, self.state.clone())]);
        self.join(entry, ends, (self.question(), head.line));
    }
}

/// Whether a block has a jump, which may leave it.
fn jumps(block: &Block<'_>) -> bool {
    nodes(block).any(|node| match node {
        Node::Other(Statement { kind: StatementKind::Instruction(it), .. }) => {
            it.effect == Effect::Jumps
        }
        _ => false,
    })
}

/// The values of a loop between bounds: from, to and step.
fn values_of(bounds: [Option<f64>; 2], step: Option<f64>) -> Vec<f64> {
    let [Some(from), Some(to)] = bounds else { return Vec::new() };
    let step = step.unwrap_or(if to < from { -1.0 } else { 1.0 });
    let mut values = Vec::new();
    let mut value = from;
    while values.len() <= MOST_PASSES && (to - value) * step >= 0.0 && step != 0.0 {
        values.push(value);
        value += step;
    }
    if values.len() > MOST_PASSES { Vec::new() } else { values }
}
