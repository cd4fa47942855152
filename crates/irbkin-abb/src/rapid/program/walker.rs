//! The state of going through a program, and the steps that it finds.

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::rc::Rc;
use core::cell::{Cell, RefCell};
use core::ops::Deref;

use nalgebra::Vector3;

use super::cases::{Case, Choices, MOST_CASES, Way};
use super::state::{Frame, Here, Site, State};
use super::tree::{Block, Node, nodes};
use super::values::Scope;
use super::whole::Program;
use crate::prelude::*;
use crate::rapid::data::expression::Expression;
use crate::rapid::data::finding::Finding;
use crate::rapid::data::instructions::Effect;
use crate::rapid::data::moves::{Move, MoveKind, Target};
use crate::rapid::data::records::GivenTools;
use crate::rapid::data::statement::{Statement, StatementKind};
use irbkin::Interrupt;

/// Statements, moves, and the way of the tool [mm] that are followed for each hundred bytes of the
/// program, and beyond these so many more statements, moves and a hundred times the way: a routine
/// is followed again for each of its callers. What takes as long as a statement counts as one.
/// Witness: a production cell of 257,241 bytes needs 990 statements and 5 moves.
const STEPS: usize = 1_000;
const MOVES: usize = 20;
const WAY: usize = 5_000;
const SPARE: usize = 10_000;

/// The statements that the values of a move take as long as.
pub(super) const MOVE: usize = 5;

/// Copies of what is known of a datum that take as long as a statement.
const COPIED: usize = 8;

/// What ends the program, in words, unless that runs in a cycle.
pub(in crate::rapid) const END_OF_MAIN: &str = "the end of main";

pub(in crate::rapid) enum Step<'m> {
    Move(Box<Stepped<'m>>),
    /// Something that may move the robot and is not followed, with the reason.
    NotFollowed {
        module: usize,
        statement: &'m Statement,
        words: String,
    },
}

/// A move with the values that it has here.
pub(in crate::rapid) struct Stepped<'m> {
    /// The module of its place, which is the call whose text has its target where that is passed on.
    pub(in crate::rapid) module: usize,
    /// The module and the index of the instruction.
    pub(in crate::rapid) instruction: (usize, usize),
    pub(in crate::rapid) step: Filled<'m>,
    /// The chain of calls to it where its target depends on what they pass on; else 0.
    pub(in crate::rapid) chain: usize,
    /// The first of these calls.
    pub(in crate::rapid) call: Option<Rc<Site>>,
    /// Which of its values these are, in words; empty of the only ones.
    pub(in crate::rapid) case: String,
    /// The first value that it rests on although the program does not determine it, in words.
    pub(in crate::rapid) assumed: Option<String>,
    /// The statement behind it at which the program may wait, in words.
    pub(in crate::rapid) halt: Option<String>,
    /// The line of what displaces its target by a known pose.
    pub(in crate::rapid) displaced_on: Option<usize>,
}

/// A move of a module, or one with other values.
pub(in crate::rapid) enum Filled<'m> {
    Same(&'m Move),
    Other(Box<Move>),
}

impl Deref for Filled<'_> {
    type Target = Move;

    fn deref(&self) -> &Move {
        match self {
            Self::Same(step) => step,
            Self::Other(step) => step,
        }
    }
}

/// Steps that follow one another.
#[derive(Default)]
pub(in crate::rapid) struct Run<'m> {
    /// Where the robot is before it: after so many moves of an earlier run.
    pub(in crate::rapid) from: Option<(usize, usize)>,
    pub(in crate::rapid) steps: Vec<Step<'m>>,
}

/// A branch, a loop or a jump that decides on moves: its line and its word.
pub(in crate::rapid) type Uncertain = (usize, String);

/// A move by the place before it, its instruction and its chain of calls.
type Made = (Option<(usize, usize)>, (usize, usize), usize);

pub(super) struct Walk<'p, 'm> {
    pub(super) program: &'p Program<'m>,
    /// Whether a single routine is followed, whose steps must be certain.
    pub(super) is_one: bool,
    /// The first place that decides on steps.
    pub(super) uncertain: Option<Uncertain>,
    pub(super) takes_last: bool,
    pub(super) tools: Option<&'p GivenTools>,
    pub(super) runs: Vec<Run<'m>>,
    pub(super) notes: Vec<Finding>,
    /// Moves, by module and index, that some call does not execute.
    pub(super) left: BTreeMap<(usize, usize), &'m Move>,
    pub(super) state: State,
    pub(super) frame: Frame,
    /// The routines that were followed, by module and name in lower case.
    pub(super) followed: BTreeSet<(usize, String)>,
    /// Chains of calls: the number of each by that of the chain before its last call, with the
    /// module and the first byte of that call.
    pub(super) chains: BTreeMap<(usize, usize, usize), usize>,
    /// The runs that begin with a move, by what it is made by.
    begun: BTreeMap<Made, Vec<usize>>,
    /// The passes of loops that are followed, each in words.
    pub(super) passes: Vec<String>,
    /// The number of the next open question.
    pub(super) questions: Cell<usize>,
    /// The routines that are being followed and called the one of the frame.
    pub(super) above: Vec<(usize, String)>,
    /// Statements, moves among them, and their way that may still be followed in calls and loops.
    pub(super) steps_left: usize,
    pub(super) moves_left: usize,
    way_left: usize,
    /// The target of the last move [mm], if it is known.
    last_place: Option<[f64; 3]>,
    pub(super) interrupt: Interrupt<'p>,
    /// The statements of functions that were followed.
    pub(super) inside: Cell<usize>,
    /// Whether the caller has ended the walk, which asks at some of its statements.
    pub(super) is_ended: bool,
    statements: usize,
}

impl<'p, 'm> Walk<'p, 'm> {
    pub(super) fn new(program: &'p Program<'m>, interrupt: Interrupt<'p>) -> Self {
        let bytes: usize = program.modules.iter().map(|it| it.text_length).sum();
        Self {
            program,
            is_one: false,
            uncertain: None,
            takes_last: false,
            tools: None,
            runs: Vec::new(),
            notes: Vec::new(),
            left: BTreeMap::new(),
            state: State::new(),
            frame: Frame::default(),
            followed: BTreeSet::new(),
            chains: BTreeMap::new(),
            begun: BTreeMap::new(),
            passes: Vec::new(),
            questions: Cell::new(0),
            above: Vec::new(),
            steps_left: STEPS * bytes / 100 + SPARE,
            moves_left: MOVES * bytes / 100 + SPARE,
            way_left: WAY * bytes / 100 + 100 * SPARE,
            last_place: None,
            interrupt,
            inside: Cell::new(0),
            is_ended: false,
            statements: 0,
        }
    }

    /// Take a move, with the samples on its way, from what is left.
    fn spend_move(&mut self, step: &Move) {
        self.moves_left = self.moves_left.saturating_sub(1);
        let place = match &step.target.value {
            Ok(Target::RobTarget(target)) => Some(target.trans_mm),
            _ => None,
        };
        let from = core::mem::replace(&mut self.last_place, place);
        if let (Some(from), Some(to)) = (from, place)
            && matches!(step.kind, MoveKind::MoveL | MoveKind::MoveC)
        {
            let way = (Vector3::from(to) - Vector3::from(from)).norm();
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "positive")]
            let way = way as usize;
            self.way_left = self.way_left.saturating_sub(way);
        }
    }

    /// Take what takes as long as so many statements from what is left.
    pub(super) fn spend(&mut self, statements: usize) {
        let others = self.program.effects.gone_through.take() + self.inside.take();
        self.steps_left = self.steps_left.saturating_sub(statements + others);
    }

    /// Whether nothing is left for calls and loops.
    pub(super) fn is_spent(&self) -> bool {
        self.steps_left == 0 || self.moves_left == 0 || self.way_left == 0
    }

    /// Whether the caller ends the walk; asked at each statement.
    pub(super) fn ends(&mut self) -> bool {
        self.statements += 1;
        self.is_ended |= self.interrupt.ends(self.statements);
        self.is_ended
    }

    /// The knowledge behind parts that begin with `entry` and end with `ends`, of which one is
    /// executed, by the answer to a question; `line` is theirs. Whether something that is known
    /// depends on the answer.
    pub(super) fn join(
        &mut self,
        entry: State,
        ends: Vec<(usize, State)>,
        (question, line): (usize, usize),
    ) -> bool {
        self.spend(ends.iter().map(|(_, end)| end.copied(&entry) / COPIED).sum());
        let depending;
        (self.state, depending) =
            State::joined(self.program, self.takes_last, entry, ends, (question, line));
        self.spend(depending);
        depending > 0
    }

    /// The number of the question what a text is here, and whether it is a new one.
    pub(super) fn ask(&mut self, text: &str) -> (usize, bool) {
        let next = self.questions.get();
        let scope = self.scope();
        let question = scope.question(text);
        let asked = scope.asked.into_inner();
        self.state.asked = asked;
        (question, question == next)
    }

    /// Record a place that decides on steps.
    pub(super) fn decides(&mut self, line: usize, word: &str) {
        self.uncertain.get_or_insert_with(|| (line, word.to_string()));
    }

    pub(super) fn forget(&mut self, block: &Block<'m>) {
        self.state.place = Err("it depends on a branch, a loop or a label");
        self.spend(nodes(block).count());
        if self.steps_left == 0 {
            self.state.forget_globals(None);
            return self.state.forget_locals(|_| true);
        }
        let place = (self.frame.module, self.frame.routine.as_str());
        let (globals, locals) = self.program.effects.of_block(self.program, place, block);
        self.state.forget_globals(globals.as_ref());
        self.state.forget_locals(|name| locals.contains(name));
    }

    pub(super) fn scope(&self) -> Scope<'_, 'm> {
        Scope {
            calls: self,
            program: self.program,
            state: &self.state,
            frame: &self.frame,
            takes_last: Cell::new(self.takes_last),
            tools: self.tools,
            choices: Choices::default(),
            returned: RefCell::default(),
            asked: RefCell::new(self.state.asked.clone()),
        }
    }

    /// What something is in each case; only what is so in all of them, if these are too many.
    pub(super) fn in_each_case<T>(
        &mut self,
        evaluate: impl Fn(&Scope<'_, 'm>) -> T,
    ) -> Vec<Way<T>> {
        let scope = self.scope();
        let mut ways = Vec::from([scope.choices.end(evaluate(&scope))]);
        while scope.choices.advance() {
            if ways.len() == MOST_CASES {
                let scope = self.scope();
                let value = scope.choices.without(|| evaluate(&scope));
                ways = Vec::from([scope.choices.end(value)]);
                break;
            }
            ways.push(scope.choices.end(evaluate(&scope)));
        }
        let asked = scope.asked.into_inner();
        self.state.asked = asked;
        self.spend(ways.len());
        ways
    }

    /// What something is whatever the case, and what it rests on.
    pub(super) fn in_all_cases<T: PartialEq>(
        &mut self,
        evaluate: impl Fn(&Scope<'_, 'm>) -> Option<T>,
    ) -> Option<(T, Option<Rc<str>>)> {
        let mut ways = self.in_each_case(evaluate).into_iter();
        let first = ways.next()?;
        let are_same = ways.all(|way| (&way.value, &way.assumed) == (&first.value, &first.assumed));
        Some((first.value.filter(|_| are_same)?, first.assumed))
    }

    /// The number that an expression is in all cases, unless it rests on what is not determined.
    pub(super) fn number(&mut self, text: &str, expression: &Expression<'_>) -> Option<f64> {
        let (number, assumed) = self.in_all_cases(|scope| scope.evaluate(text, expression).ok())?;
        assumed.is_none().then_some(number)
    }

    /// The place behind a move that was made before from the same place with the same values.
    fn made_before(
        &self,
        from: Option<(usize, usize)>,
        stepped: &Stepped<'m>,
    ) -> Option<(usize, usize)> {
        let is_same = |(run, count): &(usize, usize)| match self.runs[*run].steps.get(count - 1) {
            Some(Step::Move(own)) => {
                (own.instruction, own.chain) == (stepped.instruction, stepped.chain)
                    && *own.step == *stepped.step
                    && own.assumed == stepped.assumed
            }
            _ => false,
        };
        let next = from.map(|(run, count)| (run, count + 1));
        let by = (from, stepped.instruction, stepped.chain);
        let begun = self.begun.get(&by).into_iter().flatten();
        let mut all = next.into_iter().chain(begun.map(|run| (*run, 1)));
        all.find(is_same).filter(|_| !self.is_one)
    }

    pub(super) fn push_move(&mut self, stepped: Stepped<'m>) {
        let from = match self.state.here {
            Here::After(run, count) => Some((run, count)),
            _ => None,
        };
        if let Some((run, count)) = self.made_before(from, &stepped) {
            self.last_place = None;
            self.state.here = Here::After(run, count);
            return;
        }
        self.spend_move(&stepped.step);
        self.push(Step::Move(Box::new(stepped)));
    }

    pub(super) fn push(&mut self, step: Step<'m>) {
        if self.is_one && self.state.here == Here::Left {
            return;
        }
        let last = self.runs.len().wrapping_sub(1);
        if let (Here::After(run, count), Some(own)) = (&mut self.state.here, self.runs.last_mut())
            && *run == last
            && own.steps.len() == *count
        {
            own.steps.push(step);
            *count += 1;
            return;
        }
        let from = match self.state.here {
            Here::After(run, count) => Some((run, count)),
            Here::Unknown | Here::OneOf(_) | Here::Left => None,
        };
        self.state.here = Here::After(self.begin(from, step), 1);
    }

    /// Begin a run with a step, behind so many steps of another; its number.
    fn begin(&mut self, from: Option<(usize, usize)>, step: Step<'m>) -> usize {
        let number = self.runs.len();
        if let Step::Move(own) = &step {
            self.begun.entry((from, own.instruction, own.chain)).or_default().push(number);
        }
        let from = from.map(|(run, count)| (run, self.moves(run, count)));
        self.runs.push(Run { from, steps: Vec::from([step]) });
        number
    }

    /// A move in several cases, each from where the robot is in it.
    pub(super) fn push_each(&mut self, steps: Vec<(Case, Stepped<'m>)>) {
        let here = core::mem::replace(&mut self.state.here, Here::Unknown);
        let mut ends = Vec::with_capacity(steps.len());
        for (case, step) in steps {
            let from = match &here {
                Here::After(run, count) => Some((*run, *count)),
                Here::OneOf(all) => {
                    all.iter().find(|(own, ..)| *own == case).map(|(_, run, count)| (*run, *count))
                }
                Here::Unknown | Here::Left => None,
            };
            if let Some((run, count)) = self.made_before(from, &step) {
                ends.push((case, run, count));
                continue;
            }
            self.spend_move(&step.step);
            ends.push((case, self.begin(from, Step::Move(Box::new(step))), 1));
        }
        self.state.here = Here::OneOf(Rc::new(ends));
    }

    /// The number of moves among the first steps of a run.
    fn moves(&self, run: usize, count: usize) -> usize {
        let steps = self.runs.get(run).map_or(&[][..], |run| &run.steps[..count]);
        steps.iter().filter(|step| matches!(step, Step::Move(_))).count()
    }

    /// The program may wait here.
    pub(super) fn halt(&mut self, what: &str) {
        let ends = match &self.state.here {
            Here::After(run, count) => Vec::from([(*run, *count)]),
            Here::OneOf(ends) => ends.iter().map(|(_, run, count)| (*run, *count)).collect(),
            Here::Unknown | Here::Left => return,
        };
        for (run, count) in ends {
            let steps = self.runs.get_mut(run).map(|run| &mut run.steps);
            if let Some(Step::Move(last)) = steps.and_then(|steps| steps.get_mut(count - 1)) {
                last.halt.get_or_insert_with(|| what.to_string());
            }
        }
    }

    /// Something that may move the robot and is not followed.
    pub(super) fn not_followed(&mut self, statement: &'m Statement, words: String) {
        let module = self.frame.module;
        self.state.place = Err("what may move the robot before it is not followed");
        self.push(Step::NotFollowed { module, statement, words });
    }

    /// Whether a block moves the robot, sets how it moves, or leaves the routine.
    pub(super) fn acts(&self, block: &Block<'m>) -> bool {
        nodes(block).any(|node| match node {
            Node::Move(_, step) => step.kind != MoveKind::MoveExtJ,
            Node::Setting(_) => true,
            Node::Branches { .. } | Node::Loop { .. } => false,
            Node::Other(statement) => match &statement.kind {
                StatementKind::Unfinished { .. } | StatementKind::Invalid { .. } => true,
                StatementKind::Instruction(instruction) => match instruction.effect {
                    Effect::Moves | Effect::Leaves | Effect::Returns => true,
                    _ => instruction.name.as_ref().is_some_and(|name| {
                        let home = self.program.procedure(self.frame.module, name);
                        let of = home.and_then(|it| self.program.effects.of_routine(it, name));
                        of.is_some_and(|of| of.moves)
                    }),
                },
                _ => false,
            },
        })
    }
}
