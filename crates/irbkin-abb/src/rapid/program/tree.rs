//! The statements of a routine as a tree: branches and loops with what is in them.

use alloc::collections::BTreeMap;
use alloc::string::String;
use alloc::vec::Vec;
use core::mem;

use super::statement::{Action, Condition, Counter, depends_on, tested};
use crate::rapid::data::module::Module;
use crate::rapid::data::moves::Move;
use crate::rapid::data::settings::Setting;
use crate::rapid::data::unread::{NotRead, Skipped};
use crate::rapid::expression::tree::Expression;
use crate::rapid::text::words::{ends_with, words_of};

/// Statements in the order of the text.
pub(super) type Block<'m> = Vec<Node<'m>>;

/// A statement, or a branch or a loop with its own.
pub(super) enum Node<'m> {
    /// A move, by its index in the module.
    Move(usize, &'m Move),
    Setting(&'m Setting),
    Other(&'m Skipped, Action<'m>),
    /// IF or TEST, by its first line; of TEST with what is tested.
    Branches {
        head: &'m Skipped,
        tested: Option<Expression<'m>>,
        parts: Vec<Part<'m>>,
    },
    /// FOR or WHILE, by its first line.
    Loop {
        head: &'m Skipped,
        condition: Condition<'m>,
        /// Of a FOR that refers to its variable, or not.
        counter: Option<Counter<'m>>,
        is_counted: bool,
        body: Block<'m>,
    },
}

/// A part of a branch.
pub(super) struct Part<'m> {
    /// Its first line.
    pub(super) head: &'m Skipped,
    pub(super) condition: Condition<'m>,
    pub(super) block: Block<'m>,
}

/// The number of statements in a block.
pub(super) fn size(block: &Block<'_>) -> usize {
    let of = |node: &Node<'_>| match node {
        Node::Branches { parts, .. } => {
            parts.iter().map(|part| size(&part.block)).sum::<usize>() + 1
        }
        Node::Loop { body, .. } => size(body) + 1,
        _ => 1,
    };
    block.iter().map(of).sum()
}

/// The statements of a routine.
#[derive(Default)]
pub(super) struct Body<'m> {
    pub(super) main: Block<'m>,
    /// The statements behind ERROR, UNDO and BACKWARD.
    pub(super) handlers: Vec<Block<'m>>,
}

/// An item of a module, with its line, its column and its routine.
type Placed<'m> = (usize, usize, Option<&'m str>, Node<'m>);

/// The statements of each routine, by its name in lower case; "" for those outside routines.
pub(super) fn bodies(module: &Module) -> BTreeMap<String, Body<'_>> {
    let mut items: Vec<Placed<'_>> = Vec::new();
    items.extend(
        (module.moves.iter().enumerate())
            .map(|(index, it)| (it.line, it.column, it.routine.as_deref(), Node::Move(index, it))),
    );
    items.extend(
        (module.settings.iter())
            .map(|it| (it.line, it.column, it.routine.as_deref(), Node::Setting(it))),
    );
    items
        .extend((module.skipped.iter()).map(|it| {
            (it.line, it.column, it.routine.as_deref(), Node::Other(it, Action::of(it)))
        }));
    items.sort_by_key(|(line, column, ..)| (*line, *column));
    let mut grown: BTreeMap<String, Grower<'_>> = BTreeMap::new();
    let mut last: Option<(Option<&str>, String)> = None;
    for (_, _, routine, node) in items {
        let name = match last.take() {
            Some((of, name)) if of == routine => name,
            _ => routine.unwrap_or_default().to_lowercase(),
        };
        match grown.get_mut(&name) {
            Some(grower) => grower.add(node),
            None => grown.entry(name.clone()).or_default().add(node),
        }
        last = Some((routine, name));
    }
    grown.into_iter().map(|(name, grower)| (name, grower.finished())).collect()
}

/// A branch or a loop that is open.
struct Open<'m> {
    head: &'m Skipped,
    /// Its parts that are closed.
    parts: Vec<Part<'m>>,
    /// The first line of the part that is open: of a TEST none before its first CASE.
    part_head: Option<&'m Skipped>,
    /// The statements of the part that is open.
    part: Block<'m>,
    /// Whether it is an IF without THEN, of one instruction.
    is_single: bool,
}

impl Open<'_> {
    /// Close the open part.
    fn close_part(&mut self) {
        let block = mem::take(&mut self.part);
        if let Some(head) = self.part_head {
            self.parts.push(Part { head, condition: Condition::of(&head.text), block });
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
    fn add(&mut self, node: Node<'m>) {
        if let Node::Other(skipped, _) = &node
            && let NotRead::Flow { word } = &skipped.what
        {
            return self.flow(skipped, word);
        }
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

    fn flow(&mut self, head: &'m Skipped, word: &str) {
        match word {
            "IF" | "FOR" | "WHILE" | "TEST" => {
                let is_single = word == "IF" && !ends_with(&head.text, "THEN");
                let (parts, part) = (Vec::new(), Vec::new());
                let part_head = (word != "TEST").then_some(head);
                self.open.push(Open { head, parts, part_head, part, is_single });
            }
            "ELSEIF" | "ELSE" | "CASE" | "DEFAULT" => {
                if let Some(open) = self.open.last_mut() {
                    open.close_part();
                    open.part_head = Some(head);
                }
            }
            "ENDIF" | "ENDFOR" | "ENDWHILE" | "ENDTEST" => {
                self.close();
                self.close_single();
            }
            // A handler.
            _ => {
                self.close_all();
                self.body.handlers.push(Vec::new());
            }
        }
    }

    fn close(&mut self) {
        let Some(mut open) = self.open.pop() else { return };
        let head = open.head;
        if matches!(head.what.word(), "FOR" | "WHILE") {
            let (body, counter) = (open.part, Counter::of(&head.text));
            let is_counted = counter.as_ref().is_some_and(|it| mentions(&body, &it.variable));
            let condition = Condition::of(&head.text);
            self.push(Node::Loop { head, condition, counter, is_counted, body });
        } else {
            open.close_part();
            self.push(Node::Branches { head, tested: tested(&head.text), parts: open.parts });
        }
    }

    fn close_single(&mut self) {
        while self.open.last().is_some_and(|open| open.is_single) {
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
    block.iter().any(|node| match node {
        Node::Move(_, step) => {
            let arguments = [Some(&step.target.text), Some(&step.tool.text)];
            let optional =
                [step.via.as_ref().map(|via| &via.text), step.wobj.as_ref().map(|wobj| &wobj.text)];
            arguments.into_iter().chain(optional).flatten().any(|text| has(text))
        }
        Node::Setting(_) => false,
        Node::Other(skipped, _) => has(&skipped.text),
        Node::Branches { tested, parts, .. } => {
            tested.as_ref().is_some_and(|tested| depends_on([tested], word))
                || parts.iter().any(|part| part.condition.depends_on(word))
                || parts.iter().any(|part| mentions(&part.block, word))
        }
        Node::Loop { head, body, .. } => has(&head.text) || mentions(body, word),
    })
}
