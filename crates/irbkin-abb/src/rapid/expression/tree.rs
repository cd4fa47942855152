//! Expressions as they are written: a tree with the bytes of each part, before names are looked up.

use alloc::boxed::Box;
use alloc::string::String;
use alloc::vec::Vec;

use crate::rapid::data::unread::Reason;
use crate::rapid::text::place::excerpt;

/// An expression and the bytes that it takes.
#[derive(Clone, Debug)]
pub(crate) struct Expression<'a> {
    pub(crate) start: usize,
    pub(crate) end: usize,
    pub(crate) form: Form<'a>,
}

impl<'a> Expression<'a> {
    /// The name, the indices and the components of a reference.
    pub(crate) fn reference(&self) -> Option<(&'a str, &[Self], &[&'a str])> {
        match &self.form {
            Form::Name(name) => Some((name, &[], &[])),
            Form::Reference(it) => Some((it.name, &it.indices, &it.components)),
            _ => None,
        }
    }

    /// Add the names that it refers to, of functions too.
    pub(crate) fn collect_names(&self, names: &mut Vec<&'a str>) {
        match &self.form {
            Form::Name(name) => names.push(name),
            Form::Reference(it) => {
                names.push(it.name);
                it.indices.iter().for_each(|index| index.collect_names(names));
            }
            Form::Call(call) => {
                names.push(call.name);
                call.arguments.required.iter().for_each(|it| it.collect_names(names));
                let optional =
                    call.arguments.optional.iter().filter_map(|(_, value)| value.as_ref());
                optional.for_each(|it| it.collect_names(names));
            }
            Form::Aggregate(parts) => parts.iter().for_each(|it| it.collect_names(names)),
            Form::Negated(operand) => operand.collect_names(names),
            Form::Chain(first, rest) => {
                first.collect_names(names);
                for (_, operand) in rest {
                    operand.collect_names(names);
                }
            }
            // What is not evaluated depends on nothing.
            _ => {}
        }
    }
}

/// The form of an expression.
#[derive(Clone, Debug)]
pub(crate) enum Form<'a> {
    Number(f64),
    /// With its quotes.
    Text(&'a str),
    Bool(bool),
    Aggregate(Vec<Expression<'a>>),
    /// A name by itself, the most frequent reference.
    Name(&'a str),
    Reference(Box<Reference<'a>>),
    Call(Box<Call<'a>>),
    Negated(Box<Expression<'a>>),
    /// Numbers that are added or multiplied, from left to right.
    Chain(Box<Expression<'a>>, Vec<(Operator, Expression<'a>)>),
    Not(Box<Expression<'a>>),
    Compared(Box<[Expression<'a>; 2]>, Relation),
    /// The teach pendant's `*`.
    Star,
    /// Not evaluated, for this reason, whatever its names refer to.
    Unread(Box<Reason>),
}

/// A name, perhaps with indices, perhaps with components.
#[derive(Clone, Debug)]
pub(crate) struct Reference<'a> {
    pub(crate) name: &'a str,
    pub(crate) indices: Vec<Expression<'a>>,
    pub(crate) components: Vec<&'a str>,
}

/// A function with its arguments.
#[derive(Clone, Debug)]
pub(crate) struct Call<'a> {
    pub(crate) name: &'a str,
    pub(crate) arguments: Arguments<'a>,
    /// Components of the result.
    pub(crate) components: Vec<&'a str>,
}

/// The arguments of a function, an instruction or a call.
#[derive(Clone, Debug, Default)]
pub(crate) struct Arguments<'a> {
    pub(crate) required: Vec<Expression<'a>>,
    pub(crate) optional: Vec<(&'a str, Option<Expression<'a>>)>,
}

impl<'a> Arguments<'a> {
    /// The value of the first optional argument that has this name, in any case, and a value.
    pub(crate) fn value(&self, name: &str) -> Option<&Expression<'a>> {
        let mut named = self.optional.iter().filter(|(own, _)| own.eq_ignore_ascii_case(name));
        named.find_map(|(_, value)| value.as_ref())
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Operator {
    Plus,
    Minus,
    Times,
    Over,
    Div,
    Mod,
}

/// A relation of two numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Relation {
    Equal,
    Unequal,
    Less,
    AtMost,
    Greater,
    AtLeast,
}

impl Relation {
    /// Whether it holds.
    pub(crate) fn holds(self, left: f64, right: f64) -> bool {
        match self {
            Self::Equal => left.total_cmp(&right).is_eq(),
            Self::Unequal => left.total_cmp(&right).is_ne(),
            Self::Less => left < right,
            Self::AtMost => left <= right,
            Self::Greater => left > right,
            Self::AtLeast => left >= right,
        }
    }
}

/// The text of an expression, shortened.
pub(crate) fn written(text: &str, expression: &Expression<'_>) -> String {
    excerpt(text.get(expression.start..expression.end).unwrap_or_default())
}
