//! Loops: each pass is followed where its bounds are known.

use alloc::format;
use alloc::rc::Rc;
use alloc::string::ToString;
use alloc::vec::Vec;

use super::state::{Here, Local};
use super::tree::{Block, Node, size};
use super::values::Calls as _;
use super::walker::Walk;
use crate::rapid::data::instructions::Effect;
use crate::rapid::data::statement::{Condition, Counter, Statement, StatementKind};
use crate::rapid::data::unread::Unresolved;
use crate::rapid::data::value::Value;

/// Most passes of a loop that are followed.
const MOST_PASSES: usize = 1000;

/// Most statements in the passes of a loop that no move and no call names the counter of.
const MOST_UNCOUNTED: usize = 200;

impl<'m> Walk<'_, 'm> {
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
        let is_short = passes.len() * size(body) <= MOST_UNCOUNTED;
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
                if self.state.knows_as(&before) {
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
        !self.is_spent() && passes.saturating_mul(size(body)) <= left
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
    block.iter().any(|node| match node {
        Node::Branches { parts, .. } => parts.iter().any(|part| jumps(&part.block)),
        Node::Loop { body, .. } => jumps(body),
        Node::Other(statement) => match &statement.kind {
            StatementKind::Instruction(it) => it.effect == Effect::Jumps,
            _ => false,
        },
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
