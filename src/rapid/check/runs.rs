//! The steps of a module in runs: within one, each step certainly follows the one before it.

use alloc::collections::BTreeSet;
use alloc::string::String;
use alloc::vec::Vec;

use crate::rapid::data::instructions::Effect;
use crate::rapid::data::module::Module;
use crate::rapid::data::unread::{NotRead, Skipped};
use crate::rapid::motion::sequence::{Item, Step, ends_with_then, items_where, moving};

/// Steps that follow one another.
pub(super) struct Run<'m> {
    /// Where the robot is before it: after so many moves of an earlier run.
    pub(super) from: Option<(usize, usize)>,
    pub(super) steps: Vec<Step<'m>>,
}

/// Where the robot is.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Here {
    Unknown,
    /// After so many steps of a run.
    After(usize, usize),
    /// Nowhere: the routine was left.
    Left,
}

/// A block that is open.
struct Block {
    /// Where the robot was at its beginning.
    entry: Here,
    /// Where it is at the end of each of its parts.
    ends: Vec<Here>,
    /// Whether it is one instruction, an IF without THEN.
    is_single: bool,
}

/// The runs of all routines of a module, in the order of the text.
///
/// A branch begins where the robot is before it. Behind a branch or a loop that moves, behind a
/// label and in a handler it is unknown where the robot is.
pub(super) fn runs(module: &Module) -> Vec<Run<'_>> {
    let mut walk = Walk {
        runs: Vec::new(),
        open: Vec::new(),
        here: Here::Unknown,
        routine: None,
        moving: moving(module),
    };
    for (_, _, item) in items_where(module, |_| true) {
        walk.add(item);
    }
    walk.runs
}

struct Walk<'m> {
    runs: Vec<Run<'m>>,
    open: Vec<Block>,
    here: Here,
    routine: Option<&'m str>,
    /// Names in lower case of routines that may move the robot.
    moving: BTreeSet<String>,
}

impl<'m> Walk<'m> {
    fn add(&mut self, item: Item<'m>) {
        match item {
            Item::Setting => self.close_single(),
            Item::Move(index, step) => {
                self.enter(step.routine.as_deref());
                self.push(Step::Move(index, step));
                self.close_single();
            }
            Item::Skipped(skipped) => {
                self.enter(skipped.routine.as_deref());
                if !self.flow(skipped) {
                    self.instruction(skipped);
                    self.close_single();
                }
            }
        }
    }

    /// Go on in a routine.
    fn enter(&mut self, routine: Option<&'m str>) {
        if self.routine != routine {
            self.routine = routine;
            self.here = Here::Unknown;
            self.open.clear();
        }
    }

    fn push(&mut self, step: Step<'m>) {
        let last = self.runs.len().wrapping_sub(1);
        if let (Here::After(run, count), Some(own)) = (self.here, self.runs.last_mut())
            && run == last
            && own.steps.len() == count
        {
            own.steps.push(step);
            self.here = Here::After(run, count + 1);
            return;
        }
        let from = match self.here {
            Here::After(run, count) => Some((run, self.moves(run, count))),
            Here::Unknown | Here::Left => None,
        };
        self.here = Here::After(self.runs.len(), 1);
        self.runs.push(Run { from, steps: Vec::from([step]) });
    }

    /// The number of moves among the first steps of a run.
    fn moves(&self, run: usize, count: usize) -> usize {
        let steps = self.runs.get(run).map_or(&[][..], |run| &run.steps[..count]);
        steps.iter().filter(|step| matches!(step, Step::Move(..))).count()
    }

    /// Something that is not read.
    fn instruction(&mut self, skipped: &'m Skipped) {
        match &skipped.what {
            NotRead::Motion { .. } | NotRead::Unfinished { .. } => {
                self.push(Step::NotRead(skipped));
            }
            NotRead::Label { .. } => self.here = Here::Unknown,
            NotRead::Instruction { name } => {
                if Effect::Leaves.is_of(name) || Effect::Jumps.is_of(name) {
                    self.here = Here::Left;
                } else if Effect::Sets.is_of(name) {
                    self.push(Step::NotRead(skipped));
                } else if self.moving.contains(&name.to_lowercase()) {
                    self.push(Step::Call(skipped, name));
                }
            }
            _ => {}
        }
    }

    /// Open, divide or close a block; false for anything else.
    fn flow(&mut self, skipped: &Skipped) -> bool {
        let NotRead::Flow { word } = &skipped.what else { return false };
        match word.as_str() {
            "IF" | "FOR" | "WHILE" | "TEST" => {
                let is_single = word == "IF" && !ends_with_then(&skipped.text);
                self.open.push(Block { entry: self.here, ends: Vec::new(), is_single });
            }
            "ELSEIF" | "ELSE" | "CASE" | "DEFAULT" => {
                if let Some(block) = self.open.last_mut() {
                    block.ends.push(self.here);
                    self.here = block.entry;
                }
            }
            "ENDIF" | "ENDFOR" | "ENDWHILE" | "ENDTEST" => {
                self.close();
                self.close_single();
            }
            // A handler.
            _ => {
                self.open.clear();
                self.here = Here::Unknown;
            }
        }
        true
    }

    fn close_single(&mut self) {
        while self.open.last().is_some_and(|block| block.is_single) {
            self.close();
        }
    }

    /// Close a block: where the robot is behind it is known if nothing in it moves and goes on.
    fn close(&mut self) {
        let Some(Block { entry, mut ends, .. }) = self.open.pop() else { return };
        ends.push(self.here);
        let is_unmoved = ends.iter().all(|end| *end == entry || *end == Here::Left);
        self.here = if is_unmoved { entry } else { Here::Unknown };
    }
}
