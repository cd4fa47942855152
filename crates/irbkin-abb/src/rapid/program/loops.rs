//! Loops: each pass is followed where its bounds are known.

use alloc::rc::Rc;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::state::{Here, Local};
use super::tree::{Block, Node, size};
use super::walker::{Walk, word_of};
use crate::rapid::data::unread::{Skipped, Unresolved};
use crate::rapid::data::value::Value;
use crate::rapid::expression::reader::ExpressionReader;
use crate::rapid::text::tokens::Tokens;

/// Most passes of a loop that are followed.
const MOST_PASSES: usize = 1000;

impl<'m> Walk<'_, 'm> {
    /// A loop: each pass where its bounds are known and it refers to its variable, else the first.
    pub(super) fn repeat(&mut self, head: &'m Skipped, body: &Block<'m>) {
        let counted = self.bounds(&head.text);
        let name = counted.as_ref().map(|(name, _)| name.clone());
        let before = name.as_ref().and_then(|name| self.state.locals.get(name).cloned());
        if let Some((name, passes)) = &counted
            && !passes.is_empty()
            && !self.is_spent()
            && passes.len().saturating_mul(size(body)) <= self.steps_left.min(self.moves_left)
            && (self.is_one || mentions(body, name))
        {
            for value in passes {
                let local = Local::single(Value::Num(*value));
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
                self.decides(head.line, word_of(head));
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

    /// The variable of a FOR in lower case, and its values; none where a bound is not known.
    fn bounds(&self, head: &str) -> Option<(String, Vec<f64>)> {
        let mut tokens = Tokens::new(head).ok()?;
        if !tokens.take_word("FOR").ok()? {
            return None;
        }
        let name = tokens.take().ok()?;
        let name = tokens.text_of(name).to_lowercase();
        let mut bounds = [None, None, None];
        for (bound, word) in bounds.iter_mut().zip(["FROM", "TO", "STEP"]) {
            if tokens.take_word(word).ok()? {
                let expression = ExpressionReader::new(&mut tokens).sum().ok()?;
                *bound = self.scope().number(head, &expression).ok();
            }
        }
        Some((name, values_of(bounds)))
    }
}

/// Whether the first line of a branch or a loop has a condition that never holds.
pub(super) fn never_holds(head: &str) -> bool {
    let words = head.split_whitespace().skip(1).map(str::to_ascii_uppercase);
    let words: Vec<String> = words.collect();
    words.first().is_some_and(|word| word == "FALSE")
        && words.get(1).is_none_or(|word| word == "THEN" || word == "DO")
}

/// The optional parameter that a condition asks for alone, in lower case, and whether it must be
/// there: `IF Present(x)`, `IF NOT Present(x)`.
pub(super) fn asked_for(head: &str) -> Option<(String, bool)> {
    let (condition, rest) = head.split_once(')')?;
    let (ahead, name) = condition.split_once('(')?;
    let words: Vec<String> = ahead.split_whitespace().map(str::to_ascii_uppercase).collect();
    let is_there = match words.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["IF", "PRESENT"] => true,
        ["IF", "NOT", "PRESENT"] => false,
        _ => return None,
    };
    let is_alone = matches!(rest.trim().to_ascii_uppercase().as_str(), "" | "THEN");
    is_alone.then(|| (name.trim().to_lowercase(), is_there))
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

/// Whether a block has a word, in lower case.
fn mentions(block: &Block<'_>, word: &str) -> bool {
    let has = |text: &str| {
        let words = text.split(|c: char| !(c.is_alphanumeric() || c == '_'));
        words.filter(|it| it.len() == word.len()).any(|it| it.to_lowercase() == word)
    };
    block.iter().any(|node| match node {
        Node::Move(_, step) => {
            let arguments = [Some(&step.target.text), Some(&step.tool.text)];
            let optional =
                [step.via.as_ref().map(|via| &via.text), step.wobj.as_ref().map(|wobj| &wobj.text)];
            arguments.into_iter().chain(optional).flatten().any(|text| has(text))
        }
        Node::Setting(_) => false,
        Node::Other(skipped) => has(&skipped.text),
        Node::Branches { parts, .. } => parts.iter().any(|part| mentions(part, word)),
        Node::Loop { head, body } => has(&head.text) || mentions(body, word),
    })
}
