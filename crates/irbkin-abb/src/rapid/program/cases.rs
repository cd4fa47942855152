//! Data that have one of several known values: in each case one, by the answers to questions that
//! the text leaves open, such as which part of a branch is executed.

use alloc::rc::Rc;
use core::cell::{Cell, RefCell};

use arrayvec::ArrayVec;

use crate::prelude::*;
use crate::rapid::data::module::Content;

/// Most values of a datum that are followed, and most cases of a statement.
pub(super) const MOST_CASES: usize = 64;

/// Most questions that a value depends on.
const MOST_ANSWERS: usize = 6;

/// The answers under which something holds, by the numbers of the questions in rising order.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Case(ArrayVec<(usize, usize), MOST_ANSWERS>);

impl Case {
    pub(super) fn of(question: usize, answer: usize) -> Self {
        Self(ArrayVec::from_iter([(question, answer)]))
    }

    fn answer(&self, question: usize) -> Option<usize> {
        self.0.iter().find(|(own, _)| *own == question).map(|(_, answer)| *answer)
    }

    /// Both cases, which do not exclude each other; `None` if these are too many answers.
    fn with(&self, other: &Self) -> Option<Self> {
        let mut both = self.clone();
        for (question, answer) in &other.0 {
            let place = both.0.partition_point(|(own, _)| own < question);
            if both.0.get(place).is_none_or(|(own, _)| own != question) {
                both.0.try_insert(place, (*question, *answer)).ok()?;
            }
        }
        Some(both)
    }

    fn excludes(&self, other: &Self) -> bool {
        let is_other = |(question, answer): &(usize, usize)| {
            self.answer(*question).is_some_and(|own| own != *answer)
        };
        !self.0.is_empty() && other.0.iter().any(is_other)
    }
}

const MOST_QUESTIONS: usize = 32;

/// Open questions that have the same answer when they are asked again: with the words in lower case
/// that they depend on, and their numbers.
#[derive(Clone, Default, PartialEq)]
pub(super) struct Questions(Rc<Vec<(String, Vec<String>, usize)>>);

impl Questions {
    /// The number of a question by its text.
    pub(super) fn number(&self, text: &str) -> Option<usize> {
        self.0.iter().find(|(own, ..)| own == text).map(|(.., number)| *number)
    }

    pub(super) fn add(&mut self, text: String, words: Vec<String>, number: usize) {
        let own = Rc::make_mut(&mut self.0);
        if own.len() == MOST_QUESTIONS {
            own.remove(0);
        }
        own.push((text, words, number));
    }

    /// Keep those that are in another state, too.
    pub(super) fn keep_shared(&mut self, other: &Self) {
        if !Rc::ptr_eq(&self.0, &other.0) {
            Rc::make_mut(&mut self.0).retain(|own| other.0.contains(own));
        }
    }

    /// Forget those that depend on a word in lower case.
    pub(super) fn forget_word(&mut self, lower: &str) {
        let has_word = |words: &[String]| words.iter().any(|word| word == lower);
        if self.0.iter().any(|(_, words, _)| has_word(words)) {
            Rc::make_mut(&mut self.0).retain(|(_, words, _)| !has_word(words));
        }
    }

    pub(super) fn forget_number(&mut self, number: usize) {
        if self.0.iter().any(|(.., own)| *own == number) {
            Rc::make_mut(&mut self.0).retain(|(.., own)| *own != number);
        }
    }
}

/// A content, the case in which it is the datum's, and this in words.
#[derive(Clone, Debug, PartialEq)]
struct Candidate {
    case: Case,
    words: Rc<str>,
    /// What it rests on that the program does not determine, in words.
    assumed: Option<Rc<str>>,
    content: Content,
}

/// What is known of a datum: its content, or the one that it has in each case.
#[derive(Clone, Debug)]
pub(super) struct Known(Rc<Vec<Candidate>>);

impl PartialEq for Known {
    fn eq(&self, other: &Self) -> bool {
        Rc::ptr_eq(&self.0, &other.0) || self.0 == other.0
    }
}

impl Known {
    /// The only content, with the assignment in words.
    pub(super) fn certain(content: Content, words: &str) -> Self {
        Self::resting_on(None, content, words)
    }

    /// The only content, with what it rests on.
    pub(super) fn resting_on(assumed: Option<Rc<str>>, content: Content, words: &str) -> Self {
        let own = Candidate { case: Case::default(), words: words.into(), assumed, content };
        Self(Rc::new(Vec::from([own])))
    }

    /// The contents of the ways in which a statement is evaluated; `None` if one is not known.
    pub(super) fn of_ways<T>(
        ways: Vec<Way<T>>,
        content: impl Fn(T) -> Option<Content>,
        words: &str,
    ) -> Option<Self> {
        let is_certain = ways.len() == 1;
        let candidate = |Way { case, words: own, assumed, value }: Way<T>| {
            let words = if is_certain { words } else { &own };
            Some(Candidate { case, words: words.into(), assumed, content: content(value)? })
        };
        Some(Self(Rc::new(ways.into_iter().map(candidate).collect::<Option<_>>()?)))
    }

    /// Whether it has one content, which is another's too.
    pub(super) fn is_always(&self, other: &Self) -> bool {
        match (self.0.as_slice(), other.0.as_slice()) {
            ([own], [other]) => (&own.content, &own.case) == (&other.content, &other.case),
            _ => self == other,
        }
    }

    pub(super) fn is_assumed(&self) -> bool {
        self.0.iter().any(|candidate| candidate.assumed.is_some())
    }

    /// How many values it has, at least one.
    pub(super) fn size(&self) -> usize {
        let of = |candidate: &Candidate| match &candidate.content {
            Content::Array { values, .. } => values.len().max(1),
            _ => 1,
        };
        self.0.iter().map(of).sum()
    }

    /// What is known behind parts that answer a question with their index; `None` if these are too
    /// many contents. A content that no statement gave is named after its datum and a line.
    pub(super) fn joined<'k>(
        question: usize,
        parts: impl Iterator<Item = (usize, &'k Self)>,
        unchanged: impl Fn() -> String,
    ) -> Option<Self> {
        let mut all = Vec::new();
        for (answer, part) in parts {
            let answer = Case::of(question, answer);
            for candidate in part.0.iter().filter(|it| !it.case.excludes(&answer)) {
                let case = candidate.case.with(&answer)?;
                let mut own = Candidate { case, ..candidate.clone() };
                if own.words.is_empty() {
                    own.words = unchanged().into();
                }
                all.push(own);
            }
        }
        (all.len() <= MOST_CASES && !all.is_empty()).then(|| Self(Rc::new(all)))
    }

    /// Whether not all of it may be so in some cases.
    pub(super) fn excludes(&self, cases: &[Case]) -> bool {
        self.0.iter().any(|candidate| cases.iter().all(|case| candidate.case.excludes(case)))
    }

    /// Keep what may be so in one of some cases.
    pub(super) fn assume(&mut self, cases: &[Case]) {
        if self.excludes(cases) {
            let may_be = |own: &Candidate| cases.iter().any(|case| !own.case.excludes(case));
            Rc::make_mut(&mut self.0).retain(may_be);
        }
    }
}

/// A way in which a statement is evaluated.
pub(super) struct Way<T> {
    pub(super) case: Case,
    /// The case in words; empty of the only one.
    pub(super) words: String,
    /// What it rests on that the program does not determine, in words.
    pub(super) assumed: Option<Rc<str>>,
    pub(super) value: T,
}

/// The choices of one way after the other, in the order in which they are made.
#[derive(Default)]
pub(super) struct Choices {
    /// Each with the number of what there is to choose from.
    made: RefCell<Vec<(usize, usize)>>,
    next: Cell<usize>,
    case: RefCell<Case>,
    words: RefCell<Vec<Rc<str>>>,
    assumed: RefCell<Option<Rc<str>>>,
    /// Whether what is not certain is unknown.
    is_off: Cell<bool>,
}

impl Choices {
    /// Evaluate something that has no cases: what is not certain is unknown.
    pub(super) fn without<T>(&self, evaluate: impl FnOnce() -> T) -> T {
        let before = self.is_off.replace(true);
        let value = evaluate();
        self.is_off.set(before);
        value
    }

    /// The content of a datum on this way; `None` if it is not known.
    pub(super) fn content<'k>(&self, known: &'k Known) -> Option<&'k Content> {
        if let [only] = known.0.as_slice() {
            self.rest_on(only);
            return Some(&only.content);
        }
        if self.is_off.get() {
            return None;
        }
        let own = self.case.borrow().clone();
        let possible = known.0.iter().filter(|candidate| !own.excludes(&candidate.case));
        let possible: Vec<&Candidate> = possible.collect();
        let chosen = possible.get(self.choose(possible.len()))?;
        if possible.len() > 1 {
            self.words.borrow_mut().push(chosen.words.clone());
        }
        *self.case.borrow_mut() = own.with(&chosen.case)?;
        self.rest_on(chosen);
        Some(&chosen.content)
    }

    fn rest_on(&self, candidate: &Candidate) {
        if let Some(assumed) = &candidate.assumed {
            self.assume(|| assumed.clone());
        }
    }

    /// Rest on something that the program does not determine.
    pub(super) fn assume(&self, words: impl FnOnce() -> Rc<str>) {
        self.assumed.borrow_mut().get_or_insert_with(words);
    }

    pub(super) fn is_assumed(&self) -> bool {
        self.assumed.borrow().is_some()
    }

    /// An answer to a question that has so many, in words if it is a new one.
    pub(super) fn answer(
        &self,
        question: usize,
        count: usize,
        words: impl Fn(usize) -> String,
    ) -> Option<usize> {
        if let Some(known) = self.case.borrow().answer(question) {
            return Some(known);
        }
        if self.is_off.get() || count == 0 {
            return None;
        }
        let answer = self.choose(count);
        let case = self.case.borrow().with(&Case::of(question, answer))?;
        *self.case.borrow_mut() = case;
        self.words.borrow_mut().push(words(answer).into());
        Some(answer)
    }

    fn choose(&self, count: usize) -> usize {
        if count < 2 {
            return 0;
        }
        let mut made = self.made.borrow_mut();
        let place = self.next.replace(self.next.get() + 1);
        if place == made.len() {
            made.push((0, count));
        }
        made[place].0
    }

    pub(super) fn end<T>(&self, value: T) -> Way<T> {
        let words = self.words.take().join(" and ");
        Way { case: self.case.take(), words, assumed: self.assumed.take(), value }
    }

    /// Begin the next way; false if there is none.
    pub(super) fn advance(&self) -> bool {
        self.next.set(0);
        let mut made = self.made.borrow_mut();
        while let Some((chosen, count)) = made.pop() {
            if chosen + 1 < count {
                made.push((chosen + 1, count));
                return true;
            }
        }
        false
    }
}

/// What a move rests on that has the saved value of a PERS.
pub(super) fn saved_value(name: &str) -> Rc<str> {
    format!("the saved value of {name}").into()
}
