//! Loops: each pass is followed where its bounds are known.

use alloc::rc::Rc;
use alloc::string::ToString;
use alloc::vec::Vec;

use super::state::{Here, Local};
use super::statement::Counter;
use super::tree::{Block, size};
use super::walker::Walk;
use crate::rapid::data::unread::{Skipped, Unresolved};
use crate::rapid::data::value::Value;

/// Most passes of a loop that are followed.
const MOST_PASSES: usize = 1000;

impl<'m> Walk<'_, 'm> {
    /// A loop: each pass where its bounds are known and it refers to its variable, else the first.
    pub(super) fn repeat(
        &mut self,
        head: &'m Skipped,
        (counter, is_counted): (Option<&Counter<'_>>, bool),
        body: &Block<'m>,
    ) {
        let name = counter.map(|counter| counter.variable.clone());
        let before = name.as_ref().and_then(|name| self.state.locals.get(name).cloned());
        let passes = counter.map_or_else(Vec::new, |counter| {
            let of = |bound: &Option<_>| {
                bound.as_ref().and_then(|it| self.scope().number(&head.text, it).ok())
            };
            values_of(counter.bounds.each_ref().map(of))
        });
        if let Some(name) = &name
            && !passes.is_empty()
            && !self.is_spent()
            && passes.len().saturating_mul(size(body)) <= self.steps_left.min(self.moves_left)
            && (self.is_one || is_counted)
        {
            for value in passes {
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
        } else {
            if self.is_one && self.acts(body) {
                self.decides(head.line, head.what.word());
            }
            self.forget(body);
            if let Some(name) = &name {
                let content = Err(Unresolved::LoopVariable);
                let local = Local { data_type: None, content };
                Rc::make_mut(&mut self.state.locals).insert(name.clone(), local);
            }
            let entry = self.state.clone();
            self.block(body);
            let ends = Vec::from([entry.clone(), self.state.clone()]);
            self.join(entry, ends, head.line);
        }
        if let Some(name) = name {
            let locals = Rc::make_mut(&mut self.state.locals);
            match before {
                Some(local) => locals.insert(name, local),
                None => locals.remove(&name),
            };
        }
    }
}

/// The values of a loop between bounds: from, to and step.
fn values_of(bounds: [Option<f64>; 3]) -> Vec<f64> {
    let [Some(from), Some(to), step] = bounds else { return Vec::new() };
    let step = step.unwrap_or(if to < from { -1.0 } else { 1.0 });
    let mut values = Vec::new();
    let mut value = from;
    while values.len() <= MOST_PASSES && (to - value) * step >= 0.0 && step != 0.0 {
        values.push(value);
        value += step;
    }
    if values.len() > MOST_PASSES { Vec::new() } else { values }
}
