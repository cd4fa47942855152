//! The statements of a routine as a tree: branches and loops with what is in them.

use alloc::collections::BTreeMap;
use core::mem;

use crate::prelude::*;
use crate::rapid::data::expression::Expression;
use crate::rapid::data::module::Module;
use crate::rapid::data::moves::Move;
use crate::rapid::data::statement::{
    Condition, Counter, Flow, Instruction, Statement, StatementKind,
};
use crate::rapid::text::words::words_of;

pub(in crate::rapid) type Block<'m> = Vec<Node<'m>>;

/// A statement, or a branch or a loop with its own.
pub(in crate::rapid) enum Node<'m> {
    /// A move, by its index in the module.
    Move(usize, &'m Move),
    Setting(&'m Instruction),
    Other(&'m Statement),
    /// IF or TEST, by its first line; of TEST with what is tested.
    Branches {
        head: &'m Statement,
        tested: Option<&'m Expression<'static>>,
        parts: Vec<Part<'m>>,
    },
    /// FOR or WHILE, by its first line.
    Loop {
        head: &'m Statement,
        condition: &'m Condition,
        /// Of a FOR that refers to its variable, or not.
        counter: Option<&'m Counter>,
        is_counted: bool,
        body: Block<'m>,
    },
}

pub(in crate::rapid) struct Part<'m> {
    pub(super) head: &'m Statement,
    pub(super) condition: &'m Condition,
    pub(in crate::rapid) block: Block<'m>,
}

/// The nodes of a block in the order of the text, each before those that are in it.
pub(super) fn nodes<'b, 'm>(block: &'b Block<'m>) -> impl Iterator<Item = &'b Node<'m>> {
    let mut left: Vec<_> = block.iter().rev().collect();
    core::iter::from_fn(move || {
        let node = left.pop()?;
        match node {
            Node::Branches { parts, .. } => {
                left.extend(parts.iter().rev().flat_map(|part| part.block.iter().rev()));
            }
            Node::Loop { body, .. } => left.extend(body.iter().rev()),
            _ => {}
        }
        Some(node)
    })
}

#[derive(Default)]
pub(in crate::rapid) struct Body<'m> {
    pub(in crate::rapid) main: Block<'m>,
    /// The statements behind ERROR, UNDO and BACKWARD.
    pub(super) handlers: Vec<Block<'m>>,
}

/// The statements of each routine, by its name in lower case; "" for those outside routines.
pub(super) fn bodies(module: &Module) -> BTreeMap<String, Body<'_>> {
    let mut grown: BTreeMap<String, Grower<'_>> = BTreeMap::new();
    for of_routine in module.statements.chunk_by(|one, next| one.routine == next.routine) {
        let name = of_routine[0].routine.as_deref().unwrap_or_default();
        let grower = grown.entry(name.to_lowercase()).or_default();
        for statement in of_routine {
            grower.add(module, statement);
        }
    }
    grown.into_iter().map(|(name, grower)| (name, grower.finished())).collect()
}

/// A branch or a loop that is open.
struct Open<'m> {
    head: &'m Statement,
    flow: &'m Flow,
    /// Its parts that are closed.
    parts: Vec<Part<'m>>,
    /// The first line of the part that is open, and its condition: of a TEST none before its first
    /// CASE.
    part_head: Option<(&'m Statement, &'m Condition)>,
    /// The statements of the part that is open.
    part: Block<'m>,
}

impl Open<'_> {
    fn close_part(&mut self) {
        let block = mem::take(&mut self.part);
        if let Some((head, condition)) = self.part_head {
            self.parts.push(Part { head, condition, block });
        }
    }
}

/// A body that grows by one statement after another.
#[derive(Default)]
struct Grower<'m> {
    body: Body<'m>,
    open: Vec<Open<'m>>,
}

impl<'m> Grower<'m> {
    fn add(&mut self, module: &'m Module, statement: &'m Statement) {
        let node = match &statement.kind {
            StatementKind::Flow { flow, .. } => return self.flow(statement, flow),
            StatementKind::Move(index) => match module.moves.get(*index) {
                Some(step) => Node::Move(*index, step),
                None => return,
            },
            StatementKind::Setting(setting) => Node::Setting(setting),
            _ => Node::Other(statement),
        };
        self.push(node);
        self.close_single();
    }

    fn push(&mut self, node: Node<'m>) {
        let handler = self.body.handlers.last_mut();
        match self.open.last_mut() {
            Some(open) => open.part.push(node),
            None => handler.unwrap_or(&mut self.body.main).push(node),
        }
    }

    fn flow(&mut self, head: &'m Statement, flow: &'m Flow) {
        let part_head = match flow {
            Flow::If { condition, .. } => Some((head, condition)),
            Flow::Test(_) | Flow::Loop { .. } => None,
            Flow::Part(condition) => {
                if let Some(open) = self.open.last_mut() {
                    open.close_part();
                    open.part_head = Some((head, condition));
                }
                return;
            }
            Flow::End => {
                self.close();
                return self.close_single();
            }
            Flow::Handler => {
                self.close_all();
                return self.body.handlers.push(Vec::new());
            }
        };
        self.open.push(Open { head, flow, parts: Vec::new(), part_head, part: Vec::new() });
    }

    fn close(&mut self) {
        let Some(mut open) = self.open.pop() else { return };
        let head = open.head;
        if let Flow::Loop { condition, counter } = open.flow {
            let (body, counter) = (open.part, counter.as_deref());
            let is_counted = counter.is_some_and(|it| mentions(&body, &it.variable));
            return self.push(Node::Loop { head, condition, counter, is_counted, body });
        }
        open.close_part();
        let tested = match open.flow {
            Flow::Test(tested) => tested.as_ref(),
            _ => None,
        };
        self.push(Node::Branches { head, tested, parts: open.parts });
    }

    fn close_single(&mut self) {
        let is_single = |open: &Open<'_>| matches!(open.flow, Flow::If { is_single: true, .. });
        while self.open.last().is_some_and(is_single) {
            self.close();
        }
    }

    fn close_all(&mut self) {
        while !self.open.is_empty() {
            self.close();
        }
    }

    fn finished(mut self) -> Body<'m> {
        self.close_all();
        self.body
    }
}

/// Whether a block has a word, in lower case.
fn mentions(block: &Block<'_>, word: &str) -> bool {
    let is_it = |it: &str| it.len() == word.len() && it.to_lowercase() == word;
    let has = |text: &str| words_of(text).any(is_it);
    nodes(block).any(|node| match node {
        Node::Move(_, step) => {
            let arguments = [Some(&step.target.text), Some(&step.tool.text)];
            let optional =
                [step.via.as_ref().map(|via| &via.text), step.wobj.as_ref().map(|wobj| &wobj.text)];
            arguments.into_iter().chain(optional).flatten().any(|text| has(text))
        }
        Node::Setting(_) => false,
        Node::Other(statement) => has(&statement.text),
        Node::Branches { tested, parts, .. } => {
            tested.is_some_and(|tested| depends_on(core::slice::from_ref(tested), word))
                || parts.iter().any(|part| decides(word, part.condition))
        }
        Node::Loop { head, .. } => has(&head.text),
    })
}

/// Whether a variable, in lower case, decides on a condition.
fn decides(variable: &str, condition: &Condition) -> bool {
    matches!(condition, Condition::Compared(numbers, _) if depends_on(&**numbers, variable))
}

/// Whether numbers depend on a name, in lower case, and on nothing else.
fn depends_on(numbers: &[Expression<'_>], lower: &str) -> bool {
    let mut names = Vec::new();
    for number in numbers {
        number.collect_names(&mut names);
    }
    !names.is_empty() && names.iter().all(|name| name.to_lowercase() == lower)
}
